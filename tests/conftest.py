"""Speech for tests: made once by the synthesiser, never a recording."""

from pathlib import Path

import numpy as np
import pytest
import soundfile
from hypothesis import settings

from lipwright.schedule.say import say
from lipwright.speech import Speech

# A busy machine must not fail a test; what failed is printed so that it can be run again.
settings.register_profile("lipwright", deadline=None, print_blob=True)
settings.load_profile("lipwright")

LINE = "She had your dark suit in greasy wash water all year."


@pytest.fixture(scope="session")
def spoken() -> Speech:
    """A sentence, spoken."""
    return say(LINE)


@pytest.fixture(scope="session")
def line_wav(spoken: Speech, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The sentence as a WAV file in a folder with a space and an accent in its name."""
    assert spoken.sound is not None
    path = tmp_path_factory.mktemp("a b") / "línea.wav"
    soundfile.write(path, spoken.sound.samples.astype(np.float64), spoken.sound.rate)
    return path
