"""A corpus against a set: texts, files of any size and labels, counted together."""

from pathlib import Path

import pytest

from lipwright.corpus import Corpus, coverage
from lipwright.errors import FileFormatError, InputError, LabelError, TextError
from lipwright.files import text_blocks


def test_texts_files_and_labels_count_together(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("A map.")
    (tmp_path / "a.lab").write_text("0 1000000 m\n1000000 2000000 ae\n2000000 3000000 p\n")
    one = coverage(corpus=Corpus("A map.")).needed["bmp", "ah"]
    whole = Corpus("A map.", [tmp_path / "a.txt"], [tmp_path / "a.lab", tmp_path / "a.lab"])
    found = coverage(corpus=whole)
    assert one == 1
    assert found.needed["bmp", "ah"] == 4
    assert found.lines == 4


def test_a_long_text_counts_as_its_sentences_do(tmp_path: Path) -> None:
    sentence = "The map is on the table. "
    (tmp_path / "long.txt").write_text(sentence * 150)
    shares: list[float] = []
    found = coverage(corpus=Corpus(text_files=[tmp_path / "long.txt"]), progress=shares.append)
    one = coverage(corpus=Corpus(sentence))
    inner = {pair: n for pair, n in one.needed.items() if "sil" not in pair}
    assert {pair: found.needed[pair] for pair in inner} == {p: 150 * n for p, n in inner.items()}
    assert shares == sorted(shares)
    assert len(shares) == found.lines > 1
    assert shares[-1] == pytest.approx(1, abs=0.01)


def test_each_line_is_an_utterance() -> None:
    lines = "a map\na map\na map"
    apart = coverage(corpus=Corpus(lines, each_line=True))
    assert apart.needed["bmp", "sil"] == 3
    assert coverage(corpus=Corpus(lines)).needed["bmp", "sil"] < 3


def test_overrides_count_as_drawn(tmp_path: Path) -> None:
    from tests.engines.bigram.test_own_classes import split

    path, reduction = split(tmp_path)
    override = tmp_path / "mine-too.json"
    override.write_text(
        '{"format": "lipwright/bigram-overrides", "version": 1, "name": "gnome", "bigrams": '
        '[{"pair": ["m", "ah"], "curves": {"PBM": [[0, 0], [0.2, 1], [1, 0]]}}]}'
    )
    (tmp_path / "a.lab").write_text("0 1000000 m\n1000000 2000000 ae\n2000000 3000000 p\n")
    corpus = Corpus(labels=[tmp_path / "a.lab"])
    plain = coverage(path, corpus, reduction=reduction)
    more = coverage(path, corpus, reduction=reduction, overrides=override)
    assert plain.missing == (("sil", "m"), ("m", "ah"))
    assert more.missing == (("sil", "m"),)
    assert plain.classes[-2:] == ("bp", "m")


@pytest.mark.parametrize(
    ("corpus", "error", "words"),
    [
        (Corpus(""), TextError, "the text: nothing to say"),
        (Corpus("* * *"), TextError, "nothing to say"),
        (Corpus(text_files=["empty.txt"]), TextError, "empty.txt: nothing to say"),
        (Corpus(text_files=["nowhere.txt"]), InputError, "no such file"),
        (Corpus(text_files=["latin.txt"]), FileFormatError, "byte 70003 is not UTF-8"),
        (Corpus("Hi", voice="atlantean"), TextError, "no voice 'atlantean'"),
        (Corpus(labels=["nowhere.lab"]), InputError, "no such file"),
        (Corpus(labels=["odd.lab"]), LabelError, "odd.lab: .*'qq'"),
    ],
)
def test_corpora_that_cannot_be_counted(
    corpus: Corpus,
    error: type[Exception],
    words: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("empty.txt").write_text(" \n\n")
    Path("latin.txt").write_bytes(b"Hello. " * 10000 + b"caf\xe9 and so on")
    Path("odd.lab").write_text("0 1000000 m\n1000000 2000000 qq\n")
    with pytest.raises(error, match=words):
        coverage(corpus=corpus)


def test_labels_without_words_cannot_be_counted_within_them(tmp_path: Path) -> None:
    (tmp_path / "a.lab").write_text("0 1000000 m\n1000000 2000000 ae\n")
    with pytest.raises(LabelError, match=r"a\.lab: has phones but no words"):
        coverage(corpus=Corpus(labels=[tmp_path / "a.lab"]), within_words=True)


def test_a_reduction_to_classes_that_do_not_exist(tmp_path: Path) -> None:
    reduction = tmp_path / "mine.json"
    reduction.write_text(
        '{"format": "lipwright/reduction", "version": 1, "source": "ipa", "target": "common", '
        '"map": {"m": "nasal"}}'
    )
    with pytest.raises(LabelError, match="'nasal': not classes of the set 'english'"):
        coverage(corpus=Corpus("A map."), reduction=reduction)


def test_blocks_of_a_file_join_to_its_text(tmp_path: Path) -> None:
    text = "Ünï–ço∂é 漢字 " * 20000
    (tmp_path / "a.txt").write_text(text, encoding="utf-8-sig")
    blocks = list(text_blocks(tmp_path / "a.txt"))
    assert len(blocks) > 3
    assert "".join(blocks) == text
