"""docs/coverage.md and its pictures are what the tool makes, and say what was counted."""

import pytest
from tools.coverage.__main__ import outputs
from tools.coverage.count import utterances
from tools.coverage.published import TABLE


def test_the_page_and_its_pictures_are_what_the_tool_makes() -> None:
    for path, content in outputs().items():
        assert path.read_text("utf-8") == content, path.name


def test_there_are_200_utterances_of_varying_length() -> None:
    lengths = [len(text.split()) for text in utterances()]
    assert len(lengths) == 200
    assert len(set(utterances())) == 200
    assert min(lengths) == 1
    assert 35 <= max(lengths) <= 45


def test_the_published_table_is_in_order() -> None:
    percents = [percent for _, _, percent in TABLE]
    assert len(TABLE) == 21
    assert percents == sorted(percents, reverse=True)
    assert sum(percents) == pytest.approx(36.79)
