"""Reductions: whole for what they know, exact in time, and all that is unknown named at once."""

import json
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipwright.errors import LabelError
from lipwright.phones import PhoneTrack, load_phone_set, load_reduction
from lipwright.timeline import Interval, Tier

TABLE_1 = {
    "ah": "ae ah ax",
    "aa": "aa",
    "ao": "ao",
    "eh": "ey eh",
    "er": "er",
    "ih": "ih iy",
    "w": "w uw uh",
    "ow": "ow",
    "aw": "aw",
    "oy": "oy",
    "ay": "ay",
    "h": "hh",
    "r": "r",
    "l": "l",
    "z": "s z",
    "sh": "sh ch jh zh y",
    "th": "th dh",
    "f": "f v",
    "d": "d t n ng",
    "kg": "k g",
    "bmp": "p b m",
}


def test_arpabet_is_reduced_as_table_1_says() -> None:
    reduction = load_reduction("arpabet")
    for common, labels in TABLE_1.items():
        for label in labels.split():
            pieces, exact = reduction.of(label)
            assert [piece.label for piece in pieces] == [common]
            assert exact


@pytest.mark.parametrize("source", ["arpabet", "sampa"])
def test_every_label_of_a_set_has_a_class(source: str) -> None:
    classes = load_phone_set("common").labels
    for label in load_phone_set(source).labels:
        pieces, _ = load_reduction(source).of(label)
        assert pieces
        assert all(piece.label in classes for piece in pieces)


@pytest.mark.parametrize(
    ("label", "common", "exact"),
    [("{", "ah", True), ("tS", "sh", True), ("y:", "w", False), ("C", "kg", False)],
)
def test_sampa_goes_by_way_of_ipa_where_english_has_no_such_sound(
    label: str, common: str, exact: bool
) -> None:
    pieces, is_exact = load_reduction("sampa").of(label)
    assert [piece.label for piece in pieces] == [common]
    assert is_exact == exact


def write(tmp_path: Path) -> str:
    path = tmp_path / "own.json"
    document = {
        "format": "lipwright/reduction",
        "version": 1,
        "source": "own",
        "target": "common",
        "map": {"ar": [{"label": "aa", "share": 3}, {"label": "r"}], "m": "bmp"},
    }
    path.write_text(json.dumps(document))
    return str(path)


def test_a_label_may_become_several_with_shares_of_its_time(tmp_path: Path) -> None:
    track = PhoneTrack(Tier.of(("sil", 0.0, 1.0), ("ar", 1.0, 2.0), ("m", 2.0, 2.5)), "own")
    rows, report = load_reduction(write(tmp_path)).rows(track)
    assert rows == [("sil", 0.0, 1.0), ("aa", 1.0, 1.75), ("r", 1.75, 2.0), ("bmp", 2.0, 2.5)]
    assert report.exact == {"ar": "aa r", "m": "bmp"}
    assert report.stand_ins == {}


def test_all_unknown_labels_are_named_at_once(tmp_path: Path) -> None:
    track = PhoneTrack(Tier.of(("x", 0, 1), ("m", 1, 2), ("y", 2, 3), ("x", 3, 4)), "own")
    with pytest.raises(
        LabelError, match=r"'x', 'y': no class in the reduction own to common\. Add it"
    ):
        load_reduction(write(tmp_path)).rows(track)


def test_a_reduction_that_does_not_exist_is_refused() -> None:
    with pytest.raises(LabelError, match="no reduction from 'klingon' to 'common'"):
        load_reduction("klingon")


@given(
    st.lists(
        st.tuples(st.sampled_from(load_phone_set("arpabet").labels), st.floats(0.01, 1)),
        max_size=20,
    )
)
def test_a_reduction_keeps_the_time_of_every_phone(phones: list[tuple[str, float]]) -> None:
    intervals, reached = [], 0.0
    for label, length in phones:
        intervals.append(Interval(label, reached, reached + length))
        reached += length
    track = PhoneTrack(Tier(tuple(intervals)))
    rows, _ = load_reduction("arpabet").rows(track)
    assert [row[1:] for row in rows] == [(phone.start, phone.end) for phone in track]


def test_a_set_reduces_to_itself() -> None:
    track = PhoneTrack(Tier.of(("bmp", 0, 1)), "common")
    assert load_reduction("common").rows(track)[0] == [("bmp", 0, 1)]


def test_what_only_stands_in_is_told(tmp_path: Path) -> None:
    track = PhoneTrack(Tier.of(("n", 0, 0.1), ("ü", 0.1, 0.3)), "pinyin")
    assert load_reduction("pinyin", "common").rows(track)[1].stand_ins == {"ü": "w"}
    assert load_reduction("pinyin", "mandarin").rows(track)[1].stand_ins == {}
    path = tmp_path / "mine.json"
    table = {"format": "lipwright/reduction", "version": 1, "source": "arpabet"}
    table |= {"target": "common", "map": {"AA": "aa", "ZH": "sh"}, "nearest": ["ZH"]}
    path.write_text(json.dumps(table), "utf-8")
    found = load_reduction(str(path))
    assert [found.of(label)[1] for label in ("AA", "ZH")] == [True, False]


@pytest.mark.parametrize(
    ("source", "target", "own", "label", "usual"),
    [
        ("pinyin", "mandarin", {"x": "sh"}, "er", "er"),
        ("pinyin", "mandarin", {"x": "sh"}, "ü", "yu"),
        ("arpabet", "common", {"zh": "z"}, "uw", "w"),
    ],
)
def test_a_users_file_names_only_what_differs(
    tmp_path: Path, source: str, target: str, own: dict[str, str], label: str, usual: str
) -> None:
    path = tmp_path / "own.json"
    head = {"format": "lipwright/reduction", "version": 1, "source": source, "target": target}
    path.write_text(json.dumps({**head, "map": own}), "utf-8")
    reduction = load_reduction(str(path))
    for changed, piece in own.items():
        assert [each.label for each in reduction.of(changed)[0]] == [piece]
    assert [each.label for each in reduction.of(label)[0]] == [usual]
    with pytest.raises(LabelError, match="no class in the reduction"):
        reduction.of("§")
