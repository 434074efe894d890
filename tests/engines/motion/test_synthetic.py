"""The database that comes with Lipwright: small, whole, synthetic, and what its tool makes."""

from collections import Counter
from itertools import pairwise

import numpy as np
import pytest
from tools.synthetic_motion import making
from tools.synthetic_motion.speaking import Spoken, sentences, spoken
from tools.synthetic_motion.styles import draw, engine_of

from lipwright.engines.bigram import load_set
from lipwright.engines.motion.building import takes_of
from lipwright.engines.motion.database import open_database
from lipwright.engines.motion.preparing import Prepared
from lipwright.engines.motion.synthetic import FOLDER
from lipwright.phones import load_phone_set

DATA = open_database(FOLDER)
ENGLISH = load_set("english")
CLOSING = {**dict.fromkeys("pbm", "PBM"), **dict.fromkeys("fv", "FV")}


def number(take: Prepared) -> int:
    """A take's sentence, from 1; its name says it."""
    return int(take.name.split()[1])


def line(take: Prepared) -> Spoken:
    n = number(take)
    return spoken(n, sentences()[n - 1], np.random.default_rng([making.SEED, 0, n]))


def test_it_is_a_few_hundred_kilobytes_of_poses_and_says_what_it_is() -> None:
    assert sum(path.stat().st_size for path in FOLDER.rglob("*")) <= 620_000
    assert DATA.channels == ENGLISH.rules.names
    assert DATA.about.startswith("the database is synthetic: ")
    assert DATA.take_has_sound.all()
    assert all(take.name.startswith("synthetic ") for take in takes_of(DATA))
    assert DATA.values.min() >= 0
    assert DATA.values.max() <= 1


def test_every_english_phone_is_there_several_times() -> None:
    wanted = set(load_phone_set("arpabet").labels) - {"ax"} | {"sil"}
    assert set(DATA.labels) == wanted
    counts = dict(zip(DATA.labels, np.diff(DATA.label_first).tolist(), strict=True))
    assert min(counts.values()) >= 10, counts
    said = [pair for take in takes_of(DATA) for pair in pairwise(take.cut.labels)]
    assert len(Counter(said)) > 550


def test_lips_close_in_every_take_whatever_its_style() -> None:
    for take in takes_of(DATA):
        for label, (start, end) in zip(take.cut.labels, take.cut.spans, strict=True):
            if label in CLOSING:
                near = take.values[int(start) : int(np.ceil(end)) + 1]
                assert near[:, DATA.channels.index(CLOSING[label])].max() >= 0.9, take.name


def test_styles_differ() -> None:
    styles = [draw(ENGLISH, np.random.default_rng(seed)) for seed in range(4)]
    assert len({style.gains["open"] for style in styles}) == 4
    take = line(takes_of(DATA)[0])
    engines = [engine_of(ENGLISH, style) for style in styles]
    opened = [engine.sample(engine.solve(take.phones), 0.0, 60, 25.0)[:, 0] for engine in engines]
    assert np.std(opened, axis=0).max() > 0.05


@pytest.mark.parametrize("place", [0, 11, -1])
def test_it_is_what_the_tool_makes(place: int) -> None:
    kept = takes_of(DATA)[place]
    made = making.moved(line(kept), ENGLISH)
    assert made.cut.labels == kept.cut.labels
    np.testing.assert_allclose(made.cut.spans, kept.cut.spans - kept.cut.spans[0, 0], atol=0.01)
    np.testing.assert_allclose(made.values, kept.values, atol=0.01)
