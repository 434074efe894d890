"""What each format is like in the wild: encodings, tiers, headers, scores, comments."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipwright.errors import LabelError
from lipwright.phones import PhoneTrack
from lipwright.schedule.labels import read_labels, textgrid
from lipwright.speech import Speech
from lipwright.timeline import Interval, Tier
from tests.schedule.labels.speeches import plain

P_AA = [("p", 0.0, 0.5), ("aa", 0.5, 1.0)]


def read(tmp_path: Path, name: str, content: str | bytes) -> list[tuple[str, float, float]]:
    path = tmp_path / name
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return plain(read_labels(path).phones.tier)


# TextGrid


def grid(*tiers: str) -> str:
    head = 'File type = "ooTextFile"\nObject class = "TextGrid"\n\nxmin = 0 \nxmax = 1 \n'
    return f"{head}tiers? <exists> \nsize = {len(tiers)} \nitem []: \n{''.join(tiers)}"


def intervals(name: str, *labels: str, kind: str = "IntervalTier") -> str:
    rows = "".join(
        f"        intervals [{k + 1}]:\n            xmin = {k / len(labels)} \n"
        f'            xmax = {(k + 1) / len(labels)} \n            text = "{label}" \n'
        for k, label in enumerate(labels)
    )
    head = f'    item [1]:\n        class = "{kind}" \n        name = "{name}" \n'
    span = "        xmin = 0 \n        xmax = 1 \n"
    return f"{head}{span}        intervals: size = {len(labels)} \n{rows}"


POINTS = (
    '    item [1]:\n        class = "TextTier"\n        name = "phones"\n        xmin = 0\n'
    "        xmax = 1\n        points: size = 1\n        points [1]:\n            number = 0.3\n"
    '            mark = "peak 2 "" here"\n'
)
SHORT = (
    'File type = "ooTextFile"\n"TextGrid"\n\n0\n1\n<exists>\n2\n"IntervalTier"\n"words"\n0\n1\n1\n'
    '0\n1\n"pa é"\n"IntervalTier"\n"phones"\n0\n1\n2\n0\n0.5\n"P"\n0.5\n1\n"AA1"\n'
)
LONG = grid(intervals("words", "pa é"), intervals("phones", "P", "AA1"))


@pytest.mark.parametrize("text", [SHORT, LONG], ids=["short", "long"])
@pytest.mark.parametrize(
    "encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "latin-1"]
)
@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r"])
def test_textgrids_of_every_encoding(
    tmp_path: Path, text: str, encoding: str, newline: str
) -> None:
    content = text.replace("\n", newline).encode(encoding)
    assert read(tmp_path, "a.TextGrid", content) == P_AA
    assert read_labels(tmp_path / "a.TextGrid").words.labels == ("pa é",)


def test_a_big_endian_mark_is_read(tmp_path: Path) -> None:
    assert read(tmp_path, "a.TextGrid", b"\xfe\xff" + LONG.encode("utf-16-be")) == P_AA


@pytest.mark.parametrize(
    "tiers",
    [
        (intervals("Phones", "P", "AA1"),),
        (intervals("mary - words", "pa"), intervals("mary - phones", "P", "AA1")),
        (intervals("ORT-MAU", "pa"), intervals("KAN-MAU", "p a"), intervals("MAU", "P", "AA1")),
        (intervals("anything", "P", "AA1"),),
        (intervals("words", "pa"), intervals("layer 2", "P", "AA1")),
        (POINTS, intervals("phones", "P", "AA1")),
        (intervals("notes", "good take, hello"), intervals("mine", "P", "AA1")),
    ],
)
def test_the_tier_of_phones_is_found(tmp_path: Path, tiers: tuple[str, ...]) -> None:
    assert read(tmp_path, "a.TextGrid", grid(*tiers)) == P_AA


def test_unlabelled_intervals_are_silence(tmp_path: Path) -> None:
    rows = read(tmp_path, "a.TextGrid", grid(intervals("phones", "", "P", "sp", "AA1")))
    assert [row[0] for row in rows] == ["sil", "p", "sil", "aa"]


BROKEN_GRIDS = {
    "cut": (LONG[:-150], r"line \d+: ends too early; expected .*The file was cut"),
    "open quote": (LONG[:-4], r"line 3\d: a quote that is never closed"),
    "comma": (LONG.replace("xmax = 0.5", "xmax = 0,5"), r"line 27: 0,5; .*Write decimals with a"),
    "other": (LONG.replace('"TextGrid"', '"Pitch 1"'), r"a file of type 'ooTextFile', 'Pitch 1'"),
    "two": (
        grid(intervals("a - phones", "P"), intervals("b - phones", "P")),
        r"2 tiers of phones among 'a - phones', 'b - phones'; expected one tier called 'phones'",
    ),
    "none": (grid(intervals("words", "pa")), r"no tiers of phones among 'words'"),
    "points only": (grid(POINTS), r"no tiers of phones among no tier of intervals"),
    "backwards": (
        LONG.replace("xmax = 0.5", "xmax = -0.5"),
        r"line 26: 'p' runs from 0 to -0\.5 s; expected an end after its start",
    ),
}


@pytest.mark.parametrize(("text", "words"), BROKEN_GRIDS.values(), ids=BROKEN_GRIDS)
def test_a_broken_textgrid_names_line_and_mistake(tmp_path: Path, text: str, words: str) -> None:
    with pytest.raises(LabelError, match=rf"a\.TextGrid.*({words})"):
        read(tmp_path, "a.TextGrid", text)


def test_a_binary_textgrid_says_how_to_save_it(tmp_path: Path) -> None:
    with pytest.raises(LabelError, match=r"is a binary TextGrid.*Save it in Praat with"):
        read(tmp_path, "a.TextGrid", b"ooBinaryFile\x08TextGrid\0\0")


texts = st.text(st.characters(exclude_categories=["Cs", "Cc"]), min_size=1).filter(
    lambda text: text.strip() == text and "\ufffd" not in text
)


@given(st.lists(st.tuples(texts, st.floats(0.001, 10)), min_size=1, max_size=8))
def test_any_text_survives_a_textgrid(words: list[tuple[str, float]]) -> None:
    rows, reached = [], 0.0
    for label, length in words:
        rows.append(Interval(label, reached, reached + length))
        reached += length
    speech = Speech(PhoneTrack(Tier.of(("aa", 0.0, reached))), Tier(tuple(rows)))
    parsed = textgrid.parse(textgrid.encode(speech), "a.TextGrid")
    assert [(row.label, row.start, row.end) for row in parsed.words] == [
        (row.label, row.start, row.end) for row in rows
    ]


# HTK and Festival


@pytest.mark.parametrize(
    "text",
    [
        "0 5000000 p\n5000000 10000000 aa\n",
        "0.0 0.5 p\n0.5 1.0 aa\n",
        "\n0 5000000 P -512.3\r\n5000000 10000000 AA1 -30.5 \n",
    ],
)
def test_htk_times_are_100_ns_or_seconds(tmp_path: Path, text: str) -> None:
    assert read(tmp_path, "a.lab", text) == P_AA
    assert all(phone.confidence is None for phone in read_labels(tmp_path / "a.lab").phones)


def test_htk_words_stand_beside_their_first_phone(tmp_path: Path) -> None:
    text = (
        "0 1000000 sil -9.1 SENT-START\n1000000 2000000 p -3.5 pa\n2000000 3000000 aa -2\n"
        '3000000 4000000 sp -2\n4000000 5000000 aa 0.5 "1984"\n5000000 6000000 p\n'
    )
    read(tmp_path, "a.lab", text)
    assert plain(read_labels(tmp_path / "a.lab").words) == [("pa", 0.1, 0.3), ("1984", 0.4, 0.6)]


@pytest.mark.parametrize("name", ["a.lab", "a.xlabel", "a.seg"])
def test_festival_labels_are_ends_after_a_header(tmp_path: Path, name: str) -> None:
    text = "separator ;\nnfields 1\n#\n\t0.50000 \t100 \tp ;\n   1.0 100 aa\n 1.5 100 pau\n"
    assert read(tmp_path, name, text) == [*P_AA, ("sil", 1.0, 1.5)]


def test_festival_labels_without_a_time_name_the_line(tmp_path: Path) -> None:
    with pytest.raises(LabelError, match=r"a\.lab, line 3 column 1: 'p' is not a time"):
        read(tmp_path, "a.lab", "#\n0.5 100 p\np 100 0.6\n")


# CTM


def test_ctm_has_durations_comments_and_confidences(tmp_path: Path) -> None:
    text = ";; made by hand\nline 1 0.00 0.50 P_B 0.25\nline 1 0.50 0.50 AA1_E 1.0\n"
    assert read(tmp_path, "a.ctm", text) == P_AA
    assert [phone.confidence for phone in read_labels(tmp_path / "a.ctm").phones] == [0.25, 1.0]


def test_of_several_recordings_the_one_of_the_files_name_is_read(tmp_path: Path) -> None:
    text = "one 1 0.0 0.5 P\none 1 0.5 0.5 AA\ntwo 1 0.0 0.5 S\n"
    assert read(tmp_path, "one.ctm", text) == P_AA
    with pytest.raises(
        LabelError, match=r"2 recordings \(one, two, \.\.\.\); .*one called 'three'"
    ):
        read(tmp_path, "three.ctm", text)


# TIMIT


def test_timit_counts_samples_at_16_khz_or_at_the_rate_that_is_given(tmp_path: Path) -> None:
    assert read(tmp_path, "a.phn", "0 8000 p\n8000 16000 aa\n") == P_AA
    labels = read_labels(tmp_path / "a.phn", rate=8000)
    assert labels.phones.tier.end == 2.0


@pytest.mark.parametrize(("phn", "wrd"), [("a.phn", "a.wrd"), ("A.PHN", "A.WRD")])
def test_timits_words_lie_beside_its_phones(tmp_path: Path, phn: str, wrd: str) -> None:
    (tmp_path / wrd).write_text("0 9000 just\n7000 16000 saw\n")
    assert read(tmp_path, phn, "0 8000 p\n8000 16000 aa\n") == P_AA
    for name in (phn, wrd):
        labels = read_labels(tmp_path / name)
        assert plain(labels.words) == [("just", 0.0, 0.5), ("saw", 0.5, 1.0)]
        assert plain(labels.phones.tier) == P_AA


def test_words_alone_name_the_file_that_is_missing(tmp_path: Path) -> None:
    with pytest.raises(LabelError, match=r"a\.wrd: holds words only; expected a\.phn with its"):
        read(tmp_path, "a.wrd", "0 8000 pa\n")


# Audacity


def test_audacitys_labels_have_tabs(tmp_path: Path) -> None:
    text = "0.000000\t0.500000\tP\n\\\t100.0\t200.0\n0.500000\t1.000000\tAA1\n1.0\t1.5\t\n"
    assert read(tmp_path, "a.txt", text) == [*P_AA, ("sil", 1.0, 1.5)]


@pytest.mark.shared_data
def test_all_of_timit_is_read_with_its_words() -> None:
    folder = Path(__file__).parents[3] / "../shared/data/timit"
    if not folder.is_dir():
        pytest.skip("the recordings are not beside the project")
    files = sorted(folder.glob("*/*.phn"))
    assert len(files) == 60
    for path in files:
        labels = read_labels(path)
        assert len(labels.words)
        assert labels.phones.phone_set == "arpabet"
        assert "pcl" not in labels.phones.tier.labels
