"""What ``say`` labels in any language is read back from a file as it was."""

import pytest

from lipwright.phones import SILENCE
from lipwright.phones.languages import languages
from lipwright.schedule.labels.notation import normalised
from lipwright.schedule.labels.rows import Row
from tests.phones.languages.test_classes import TABLE


@pytest.mark.parametrize("language", languages())
@pytest.mark.parametrize("phone_set", ["ipa", ""])
def test_labels_of_a_language_are_known_as_ipa(language: str, phone_set: str) -> None:
    labels = [*TABLE[language], SILENCE]
    rows = [Row(label, float(k), k + 1.0, "a line") for k, label in enumerate(labels)]
    read, name = normalised(rows, phone_set, "a file")
    assert name == "ipa"
    assert [row.label for row in read] == labels
