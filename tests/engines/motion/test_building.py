"""A database in a folder: built, opened, added to, interrupted, refused."""

import json
import os
import shutil
import tempfile
from collections.abc import Callable
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lipwright.engines.motion import storage
from lipwright.engines.motion.building import append, build, held_already, takes_of
from lipwright.engines.motion.database import Database, Settings, open_database
from lipwright.engines.motion.graph import graph_of
from lipwright.engines.motion.info import info
from lipwright.engines.motion.learnt import keep_learnt
from lipwright.engines.motion.preparing import Prepared, prepare
from lipwright.engines.motion.search import Costs, optimal
from lipwright.engines.motion.take import Take
from lipwright.errors import LipwrightError, OutputError
from lipwright.phones import PhoneTrack
from lipwright.sound import Sound
from lipwright.timeline import Tier
from tests.engines.motion.small import CHANNELS, prepared

CLUSTERED = Settings(clusters=3, motion_points=4)
TAKES = [prepared("abcab", 1), prepared("bca", 2, sound=False), prepared("cabba", 3)]


def contents(database: Database) -> dict[str, Any]:
    """Everything in a database, as bytes."""
    found: dict[str, Any] = {}
    for holder in (database, database.merged):
        for field in fields(holder) if holder is not None else ():
            value = getattr(holder, field.name)
            if field.name not in ("folder", "merged"):
                found[field.name] = value.tobytes() if isinstance(value, np.ndarray) else value
    return found


def take(**changes: Any) -> Take:
    rng = np.random.default_rng(0)
    phones = PhoneTrack(Tier.of(("sil", 0, 0.1), ("B", 0.1, 0.2), ("AA1", 0.2, 0.4)))
    sound = Sound(np.zeros(8000, np.float32), 16000)
    values = rng.random((10, 3)).astype(np.float32)
    made = Take("one", CHANNELS, values, 25.0, 0.0, phones, Tier(), sound)
    return replace(made, **changes)


def test_what_was_built_is_opened(tmp_path: Path) -> None:
    built = build(tmp_path / "db", TAKES, CLUSTERED, np.ones(3, np.float32))
    opened = open_database(tmp_path / "db")
    assert contents(opened) == contents(built)
    assert opened.labels == ("a", "b", "c")
    assert "".join(opened.labels[label] for label in opened.label) == "abcabbcacabba"
    assert opened.take.tolist() == [0] * 5 + [1] * 3 + [2] * 5
    assert opened.take_has_sound.tolist() == [True, False, True]
    assert opened.take_name(1) == "bca-2"
    assert opened.rest.tolist() == [1, 1, 1]
    assert opened.settings == CLUSTERED
    frames = np.concatenate([one.values for one in TAKES])
    assert opened.motion(0, len(frames)) == pytest.approx(frames, abs=1e-5)
    assert not opened.features[opened.take_first[1] : opened.take_first[2]].any()


def test_the_same_takes_give_the_same_bytes(tmp_path: Path) -> None:
    for name in ("one", "two"):
        build(tmp_path / name, TAKES, CLUSTERED)
    one, two = tmp_path / "one", tmp_path / "two"
    files = sorted(path.relative_to(one) for path in one.rglob("*") if path.is_file())
    assert files == sorted(path.relative_to(two) for path in two.rglob("*") if path.is_file())
    assert all((one / name).read_bytes() == (two / name).read_bytes() for name in files)


@pytest.mark.parametrize("settings", [Settings(), CLUSTERED])
def test_adding_takes_gives_what_building_all_at_once_gives(
    tmp_path: Path, settings: Settings
) -> None:
    whole = build(tmp_path / "whole", TAKES, settings, np.ones(3, np.float32))
    build(tmp_path / "grown", TAKES[:1], settings, np.ones(3, np.float32))
    append(tmp_path / "grown", TAKES[1:2])
    grown = append(tmp_path / "grown", TAKES[2:])
    assert contents(grown) == contents(whole)


def test_adding_takes_with_odd_times_is_exact(tmp_path: Path) -> None:
    rng = np.random.default_rng(8)
    takes = []
    for number in range(20):
        edges = np.cumsum(rng.uniform(0.05, 0.2, 4)).tolist()
        phones = PhoneTrack(Tier.of(*zip("bts", edges[:-1], edges[1:], strict=True)))
        values = rng.random((30, 3)).astype(np.float32)
        takes.append(prepare(take(name=f"{number}", phones=phones, values=values)))
    whole = build(tmp_path / "whole", takes)
    build(tmp_path / "grown", takes[:11])
    assert contents(append(tmp_path / "grown", takes[11:])) == contents(whole)


def test_adding_nothing_changes_nothing(tmp_path: Path) -> None:
    build(tmp_path / "db", TAKES)
    before = (tmp_path / "db" / "database.json").read_bytes()
    append(tmp_path / "db", [])
    assert (tmp_path / "db" / "database.json").read_bytes() == before


def test_adding_nothing_clears_what_a_killed_writer_left(tmp_path: Path) -> None:
    build(tmp_path / "db", TAKES)
    for name in (".building-x", "arrays-7"):
        (tmp_path / "db" / name).mkdir()
        (tmp_path / "db" / name / "frames.npy").write_bytes(b"part")
    append(tmp_path / "db", [])
    assert {path.name for path in (tmp_path / "db").iterdir()} == {"arrays-1", "database.json"}
    assert len(open_database(tmp_path / "db").label) == 13


def test_takes_that_are_held_already_are_those_that_are_the_same(tmp_path: Path) -> None:
    held = build(tmp_path / "db", TAKES)
    assert held_already(held, TAKES) == {"abcab-1", "bca-2", "cabba-3"}
    one, mute, _ = TAKES
    assert one.features is not None
    spans = replace(one.cut, spans=one.cut.spans + 0.1)
    labels = replace(one.cut, labels=tuple("abcac"))
    for other in (
        replace(one, name="another"),
        replace(one, values=one.values + 1),
        replace(one, features=one.features + 1),
        replace(one, features=None),
        replace(mute, features=one.features),
        replace(one, cut=spans),
        replace(one, cut=labels),
        replace(one, start=1.0),
        replace(one, channels=CHANNELS[::-1]),
        prepared("ab", name=one.name),
    ):
        assert held_already(held, [other]) == frozenset()


def test_what_was_learnt_from_the_old_takes_does_not_stand_beside_new_ones(tmp_path: Path) -> None:
    keep_learnt(build(tmp_path / "db", TAKES))
    assert (tmp_path / "db" / "learnt.json").exists()
    # As many frames and units, and as much variance.
    others = [replace(take, channels=("jawOpen", "mouthSmile", "mouthClose")) for take in TAKES]
    build(tmp_path / "db", others)
    assert not (tmp_path / "db" / "learnt.json").exists()


def test_what_is_to_be_told_of_it_stays_when_takes_are_added(tmp_path: Path) -> None:
    build(tmp_path / "db", [prepared("abc")], about="made by code")
    assert append(tmp_path / "db", [prepared("cab")]).about == "made by code"
    assert build(tmp_path / "other", [prepared("abc")]).about == ""


def test_what_it_was_built_from_comes_back(tmp_path: Path) -> None:
    for old, back in zip(TAKES, takes_of(build(tmp_path / "db", TAKES)), strict=True):
        assert (back.name, back.cut.labels, back.start) == (old.name, old.cut.labels, old.start)
        assert (back.values == old.values).all()
        assert (back.cut.spans == old.cut.spans).all()
        assert (back.features is None) == (old.features is None)


class Killed(BaseException):
    """What nothing in the program catches to go on."""


def killed_at(step: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Stop at the so-many-th change on disk, and clear up nothing, as a killed process does."""
    left, dead = [step], list[bool]()

    def counted(work: Callable[..., Any]) -> Callable[..., Any]:
        def run(*arguments: Any, **named: Any) -> Any:
            if left[0] == 0:
                dead.append(True)
                raise Killed
            left[0] -= 1
            return work(*arguments, **named)

        return run

    def living(work: Callable[..., Any]) -> Callable[..., Any]:
        """What clears up does nothing once the process is dead."""
        return lambda *args, **named: None if dead else work(*args, **named)

    monkeypatch.setattr(tempfile, "mkdtemp", counted(tempfile.mkdtemp))
    monkeypatch.setattr(np, "save", counted(np.save))
    monkeypatch.setattr(os, "fsync", lambda _: None)  # waits, and changes nothing
    monkeypatch.setattr(Path, "rename", counted(Path.rename))
    monkeypatch.setattr(Path, "replace", counted(Path.replace))
    for holder, name in ((shutil, "rmtree"), (Path, "unlink")):
        monkeypatch.setattr(holder, name, living(counted(getattr(holder, name))))


@pytest.mark.parametrize("exists", [False, True])
def test_killed_at_any_step_it_leaves_the_old_one_or_the_new_one(
    tmp_path: Path, exists: bool
) -> None:
    old = contents(build(tmp_path / "old", TAKES[:2]))
    new = contents(build(tmp_path / "new", TAKES))
    outcomes = []
    for step in range(200):
        folder = tmp_path / f"db{step}"
        if exists:
            shutil.copytree(tmp_path / "old", folder)
        with pytest.MonkeyPatch.context() as patched:
            killed_at(step, patched)
            try:
                build(folder, TAKES)
                finished = True
            except Killed:
                finished = False
        try:
            found = contents(open_database(folder))
        except LipwrightError:
            assert not exists
            outcomes.append("none")
        else:
            assert found in (old, new)
            outcomes.append("new" if found == new else "old")
        if finished:
            break
        if step % 9 == 0 or outcomes[-1] == "new":
            assert contents(build(folder, TAKES)) == new
            assert len(list(folder.iterdir())) == 2  # nothing is left lying about
    first = "old" if exists else "none"
    assert outcomes == sorted(outcomes, key=lambda one: one == "new")
    assert outcomes.count(first) > 25
    assert outcomes[-1] == "new"
    assert not exists or outcomes[-2] == "new"  # killed while the old one was cleared away


def test_a_failing_build_leaves_the_old_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    old = contents(build(tmp_path / "db", TAKES[:2]))

    def full(*_: Any, **__: Any) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(np, "save", full)
    with pytest.raises(LipwrightError, match=r"db: cannot be written \(No space left on device\)"):
        append(tmp_path / "db", TAKES[2:])
    assert contents(open_database(tmp_path / "db")) == old
    assert len(list((tmp_path / "db").iterdir())) == 2


def test_a_header_that_cannot_be_written_leaves_the_old_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    old = contents(build(tmp_path / "db", TAKES[:2]))

    def full(*_: Any) -> None:
        raise OutputError("the disk is full")

    monkeypatch.setattr(storage, "write_atomically", full)
    with pytest.raises(LipwrightError, match="the disk is full"):
        append(tmp_path / "db", TAKES[2:])
    assert contents(open_database(tmp_path / "db")) == old
    assert len(list((tmp_path / "db").iterdir())) == 2


def test_a_reader_keeps_what_it_opened(tmp_path: Path) -> None:
    reader = build(tmp_path / "db", TAKES[:1])
    before = reader.frames.copy()
    append(tmp_path / "db", TAKES[1:])
    assert (reader.frames == before).all()


def test_only_what_is_learnt_is_kept_and_labels_are_spelled_one_way() -> None:
    made = prepare(take(), learn=["mouthSmile", "jawOpen"])
    assert made.channels == ("mouthSmile", "jawOpen")
    assert (made.values == take().values[:, [2, 0]]).all()
    assert made.cut.labels == ("sil", "b", "aa")


def test_sound_is_asked_for_only_where_there_is_some() -> None:
    heard = np.ones((10, 9), np.float32)
    given = prepare(take(), features=lambda _: heard).features
    assert given is not None
    assert (given == heard).all()
    assert prepare(take(sound=None), features=lambda _: heard).features is None
    assert prepare(take()).features is None


def test_a_prepared_take_becomes_a_database_that_speaks(tmp_path: Path) -> None:
    made = prepare(take(), features=lambda one: np.zeros((len(one.values), 9), np.float32))
    held = build(tmp_path / "db", [made])
    graph = graph_of(held)
    wanted = [held.labels.index(label) for label in ("b", "aa", "sil")]
    path = optimal(graph, np.array(wanted), Costs(graph))
    assert (path.units.tolist(), path.jumps) == ([1, 2, 0], 1)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"values": np.zeros((10, 2), np.float32)}, r"'one': motion of shape \(10, 2\)"),
        ({"values": np.zeros((0, 3), np.float32)}, "some frames of 3 channels"),
        ({"values": np.full((10, 3), np.nan, np.float32)}, "frame 0 of 'jawOpen' is no number"),
        ({"rate": 0.0}, "0.0 frames per second"),
        ({"start": float("nan")}, "from nan s"),
        ({"channels": ("a", "b", "a")}, "has the channel 'a' twice"),
        ({"start": 9.0}, "no phone falls into its motion"),
        ({"phones": PhoneTrack(Tier())}, r"no phone falls into its motion \(phones: none\)"),
        ({"phones": PhoneTrack(Tier.of(("xx", 0, 1)))}, "'xx': not phones of 'arpabet'"),
    ],
)
def test_a_take_that_cannot_be_used_is_refused(changes: dict[str, Any], words: str) -> None:
    with pytest.raises(LipwrightError, match=words):
        prepare(take(**changes))


def test_missing_channels_and_wrong_sound_are_refused() -> None:
    with pytest.raises(LipwrightError, match="'one': lacks 'jawLeft'; expected every channel"):
        prepare(take(), learn=["jawOpen", "jawLeft"])
    with pytest.raises(LipwrightError, match="lacks any channel"):
        prepare(take(), learn=[])
    with pytest.raises(LipwrightError, match=r"parameters of shape \(9, 9\); expected 10 by 9"):
        prepare(take(), features=lambda _: np.zeros((9, 9), np.float32))


def other(**changes: Any) -> list[Prepared]:
    return [TAKES[0], replace(TAKES[1], **changes)]


@pytest.mark.parametrize(
    ("takes", "words"),
    [
        ([], "no take"),
        ([TAKES[0], TAKES[0]], "take 'abcab-1': is there twice"),
        (other(rate=60.0), "take 'bca-2': 60 frames per second; expected 25"),
        (other(channels=("x", "y", "z")), r"other channels than take 'abcab-1' \('jawOpen'\)"),
        (other(channels=CHANNELS[::-1]), "another order"),
        (other(phone_set="common"), "phones of 'common'; expected phones of 'arpabet'"),
    ],
)
def test_takes_that_do_not_go_together_are_refused(
    takes: list[Prepared], words: str, tmp_path: Path
) -> None:
    with pytest.raises(LipwrightError, match=words):
        build(tmp_path / "db", takes)
    assert not (tmp_path / "db").exists()


def test_settings_and_rest_that_make_no_sense_are_refused(tmp_path: Path) -> None:
    with pytest.raises(LipwrightError, match="variance = 0"):
        build(tmp_path / "db", TAKES, Settings(variance=0))
    with pytest.raises(LipwrightError, match="clusters = -1"):
        build(tmp_path / "db", TAKES, Settings(clusters=-1))
    with pytest.raises(LipwrightError, match=r"rest face of shape \(2,\); expected 3 channels"):
        build(tmp_path / "db", TAKES, rest=np.zeros(2, np.float32))


def test_no_database_is_put_where_something_else_is(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("mine")
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "notes.txt").write_text("mine")
    for name, words in (
        ("file", "is a file"),
        ("full", "holds 'notes.txt' and is no motion database"),
        ("none/db", "does not exist"),
    ):
        with pytest.raises(LipwrightError, match=words):
            build(tmp_path / name, TAKES)
    assert (tmp_path / "full" / "notes.txt").read_text() == "mine"
    (tmp_path / "empty").mkdir()
    assert len(build(tmp_path / "empty", TAKES).label) == 13


def header(change: Callable[[dict[str, Any]], None]) -> Callable[[Path], None]:
    def damage(folder: Path) -> None:
        said = json.loads((folder / "database.json").read_text("utf-8"))
        change(said)
        (folder / "database.json").write_text(json.dumps(said), "utf-8")

    return damage


def cut_short(folder: Path) -> None:
    path = next(folder.glob("arrays-*/frames.npy"))
    path.write_bytes(path.read_bytes()[:-8])


def swapped(folder: Path) -> None:
    np.save(next(folder.glob("arrays-*/label.npy")), np.zeros(13))


@pytest.mark.parametrize(
    ("damage", "words"),
    [
        (lambda folder: shutil.rmtree(folder), "no such folder"),
        (lambda folder: (folder / "database.json").unlink(), "has no database.json"),
        (lambda folder: (folder / "database.json").write_text(""), "is empty"),
        (lambda folder: (folder / "database.json").write_text("{"), "broken JSON"),
        (header(lambda said: said.update(version=9)), "version 9; expected version 1 or older"),
        (header(lambda said: said.update(format="x")), "lipwright/motion-database"),
        (header(lambda said: said.update(rate="fast")), "at rate"),
        (header(lambda said: said.update(rate=0.0)), "0.0 frames per second"),
        (header(lambda said: said.update(units=0)), "a count below 1"),
        (header(lambda said: said.update(units=12)), "13; expected numbers of type <i2, 12"),
        (header(lambda said: said.update(arrays="../other")), r"arrays in '../other'"),
        (header(lambda said: said["settings"].update(speed=1)), "unknown field `speed`"),
        (cut_short, r"frames.npy: cannot be read.*damaged: build it again"),
        (swapped, "label.npy: numbers of type <f8, 13; expected numbers of type <i2, 13"),
        (lambda folder: next(folder.glob("*/take.npy")).unlink(), "take.npy: is missing"),
        (lambda folder: next(folder.glob("*/keys.npy")).write_bytes(b""), "keys.npy: cannot be"),
        (lambda folder: next(folder.glob("*/after.npy")).write_bytes(b"no"), "after.npy: cannot"),
        (lambda folder: next(folder.glob("*/take_names.npy")).unlink(), "names.npy: is missing"),
    ],
)
def test_a_damaged_database_is_refused(
    tmp_path: Path, damage: Callable[[Path], None], words: str
) -> None:
    build(tmp_path / "db", TAKES, CLUSTERED)
    damage(tmp_path / "db")
    with pytest.raises(LipwrightError, match=words) as refused:
        open_database(tmp_path / "db")
    assert "\n" not in str(refused.value)


def test_a_file_is_no_database(tmp_path: Path) -> None:
    (tmp_path / "db").write_text("x")
    with pytest.raises(LipwrightError, match="is a file; expected a motion database's folder"):
        open_database(tmp_path / "db")


def test_what_it_holds_is_counted(tmp_path: Path) -> None:
    held = build(tmp_path / "db", TAKES, CLUSTERED)
    told = info(held)
    assert (told.takes, told.takes_with_sound, told.units, told.nodes) == (3, 2, 13, 3)
    assert told.minutes == pytest.approx(len(held.frames) / 25 / 60)
    assert told.units_per_phone == {"a": 5, "b": 5, "c": 3}
    assert told.thin == ("a", "b", "c")
    # ab bc ca ab, bc ca, ca ab bb ba
    assert (told.bigrams.different, told.bigrams.once, told.bigrams.possible) == (5, 2, 9)
    # abc bca cab, bca, cab abb bba
    assert (told.trigrams.different, told.trigrams.once) == (5, 3)
    assert told.trigrams.share == pytest.approx(5 / 27)
    assert sum(told.variance) == pytest.approx(1.0)


def test_silence_next_to_silence_is_not_missed(tmp_path: Path) -> None:
    held = build(tmp_path / "db", [prepare(take())])
    told = info(held)
    assert held.labels == ("aa", "b", "sil")
    assert told.bigrams.possible == 8
    # Of 27 threes, 5 have two silences side by side.
    assert told.trigrams.possible == 22
