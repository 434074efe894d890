"""A build that is killed at some instant: what is left, and what the second run makes of it.

The process really ends, with nothing cleared up: it kills itself at the chosen instant.
"""

import json
import random
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lipwright import motion_takes, pipeline
from lipwright.engines.motion.database import open_database
from lipwright.errors import InputError, MissingExtraError
from lipwright.motion_takes import build_motion
from lipwright.phones import PhoneTrack
from lipwright.speech import Speech
from lipwright.timeline import Tier

TAKES = {
    "one": "sil p iy t er b ao t sil",
    "two": "sil m ay f aa dh er sil",
}
LINE = Speech(PhoneTrack(Tier.of(("sil", 0, 0.1), ("b", 0.1, 0.2), ("iy", 0.2, 0.3))))
PROGRAM = """
import importlib, json, os, signal, sys
from lipwright.motion_takes import build_motion

where, mark, after, arguments, named = json.loads(sys.argv[1])
module, _, name = where.partition(":")
holder = importlib.import_module(module)
*outer, name = name.split(".")
for one in outer:
    holder = getattr(holder, one)
work = getattr(holder, name)

def deadly(*args, **kwargs):
    if mark not in repr((args, kwargs)):
        return work(*args, **kwargs)
    if after:
        work(*args, **kwargs)
    # On Windows this ends a process as suddenly.
    os.kill(os.getpid(), getattr(signal, "SIGKILL", signal.SIGTERM))

setattr(holder, name, deadly)
build_motion(*arguments, **named)
"""
WORKERS = """
import os, signal, sys
from lipwright.motion_takes import build_motion

def kill(share):
    os.kill(os.getpid(), getattr(signal, "SIGKILL", signal.SIGTERM))

if __name__ == "__main__":
    build_motion(*sys.argv[1:], workers=2, progress=kill)
"""
STORAGE, PATH = "lipwright.engines.motion.storage", "pathlib:Path"


@dataclass(frozen=True)
class Instant:
    """When it is killed: before, or after, a call with something in its arguments."""

    where: str
    mark: str
    after: bool = False
    replaced: bool = False
    """Whether the new database is there by then."""


LAST = "the takes beside it are to go"
INSTANTS = {
    "a take is half written": Instant("os:fsync", ""),
    "a take is kept, another is not": Instant("lipwright.motion_takes:_one", "two"),
    "the arrays' folder is made": Instant("tempfile:mkdtemp", ".building-", after=True),
    "some arrays are written": Instant(f"{STORAGE}:_save", "label.npy"),
    "the arrays are in their place": Instant(f"{PATH}.rename", "arrays-", after=True),
    "the header lies beside its place": Instant(f"{PATH}.replace", "database.json"),
    "the header is in its place": Instant(
        f"{PATH}.replace", "database.json", after=True, replaced=True
    ),
    "the old arrays are to go": Instant("shutil:rmtree", "arrays-1", replaced=True),
    "what is learnt is to be kept": Instant(f"{PATH}.replace", "learnt.json", replaced=True),
    LAST: Instant("shutil:rmtree", ".takes", replaced=True),
}
FIRST = ("a take is half written", "the arrays are in their place")
ADDED = ("the arrays are in their place", "the header is in its place", LAST)
ANEW = [when for when in INSTANTS if when != LAST]


def record(folder: Path, *names: str) -> Path:
    """Takes of random motion with labels."""
    folder.mkdir()
    for name in names:
        phones, rng = TAKES[name].split(), random.Random(name)
        rows = [f"{k / 10:.1f} {(k + 1) / 10:.1f} {phone}" for k, phone in enumerate(phones)]
        (folder / f"{name}.lab").write_text("\n".join(rows) + "\n")
        shapes = ("jawOpen", "mouthClose", "mouthPucker", "mouthFunnel", "mouthSmileLeft")
        table = [",".join(("time", *shapes))]
        for frame in range(5 * len(phones)):
            values = (f"{rng.random() / 2:.4f}" for _ in shapes)
            table.append(",".join((f"{frame / 50:.3f}", *values)))
        (folder / f"{name}.csv").write_text("\n".join(table) + "\n")
    return folder


@pytest.fixture(scope="module")
def takes(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folders of takes, and ``old``: a database of one of them."""
    root = tmp_path_factory.mktemp("recorded")
    record(root / "both", "one", "two")
    record(root / "more", "two")
    build_motion(record(root / "some", "one"), root / "old", workers=1)
    return root


def contents(folder: Path) -> dict[str, Any]:
    """The bytes of all files, by name; the arrays' folder is called the same in all states."""
    found: dict[str, Any] = {}
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).as_posix()
        top, _, rest = name.partition("/")
        if path.is_file():
            found[f"arrays/{rest}" if rest else top] = path.read_bytes()
    header = json.loads(found["database.json"])
    assert (folder / header.pop("arrays")).is_dir()
    return found | {"database.json": header}


def spoken(folder: Path) -> bytes:
    made = pipeline.animate(LINE, engine="motion", database=folder).animation
    assert np.isfinite(made.values).all()
    return made.values.tobytes()


def killed(at: Instant, arguments: list[str], **named: Any) -> None:
    """Build in another process until it is killed."""
    given = json.dumps([at.where, at.mark, at.after, arguments, named | {"workers": 1}])
    ended = subprocess.run([sys.executable, "-c", PROGRAM, given], capture_output=True, timeout=60)
    assert ended.returncode in (-9, 15), ended.stderr.decode()
    assert ended.stderr == b""


def survives(at: Instant, source: Path, old: Path | None, home: Path, **named: Any) -> None:
    """Check a killed build, and the second run, against one that was not disturbed."""
    for name in ("db", "whole") if old is not None else ():
        shutil.copytree(old or "", home / name)
    build_motion(source, home / "whole", workers=1, **named)
    killed(at, [str(source), str(home / "db")], **named)
    if at.replaced:
        assert spoken(home / "db") == spoken(home / "whole")
    elif old is not None:
        assert spoken(home / "db") == spoken(old)
    else:
        with pytest.raises(InputError, match="lipwright motion build"):
            open_database(home / "db")
    built = build_motion(source, home / "db", workers=1, **named)
    assert built.refused == ()
    assert {report.name for report in built.reports} == {path.stem for path in source.iterdir()}
    assert contents(home / "db") == contents(home / "whole")
    assert sorted(path.name for path in home.iterdir()) == ["db", "whole"]
    assert len(list((home / "db").iterdir())) == 3  # arrays, header, what is learnt


@pytest.mark.parametrize("when", ANEW)
def test_killed_while_a_database_is_built_anew(when: str, takes: Path, tmp_path: Path) -> None:
    survives(INSTANTS[when], takes / "both", takes / "old", tmp_path)


@pytest.mark.parametrize("when", FIRST)
def test_killed_while_the_first_is_built(when: str, takes: Path, tmp_path: Path) -> None:
    survives(INSTANTS[when], takes / "both", None, tmp_path)


@pytest.mark.parametrize("when", ADDED)
def test_killed_while_takes_are_added(when: str, takes: Path, tmp_path: Path) -> None:
    survives(INSTANTS[when], takes / "more", takes / "old", tmp_path, add=True)


def test_the_second_run_prepares_only_what_is_missing(takes: Path, tmp_path: Path) -> None:
    killed(INSTANTS["some arrays are written"], [str(takes / "both"), str(tmp_path / "db")])
    part = tmp_path / ".db.takes"
    one, two = sorted(part.iterdir())
    one.write_bytes(one.read_bytes()[:50])
    shares: list[float] = []
    build_motion(takes / "both", tmp_path / "db", workers=1, progress=shares.append)
    assert len(shares) == 1  # the damaged one
    assert not two.exists()


def test_takes_that_are_there_already_are_told(takes: Path, tmp_path: Path) -> None:
    shutil.copytree(takes / "old", tmp_path / "db")
    before = contents(tmp_path / "db")
    built = build_motion(takes / "some", tmp_path / "db", workers=1, add=True)
    assert built.notes == ("one: is in the database already",)
    assert contents(tmp_path / "db") == before
    changed = shutil.copytree(takes / "some", tmp_path / "changed") / "one.lab"
    changed.write_text(changed.read_text().replace(" p\n", " b\n"))
    with pytest.raises(InputError, match="'one': is there twice"):
        build_motion(changed.parent, tmp_path / "db", workers=1, add=True)
    assert contents(tmp_path / "db") == before


def test_takes_that_were_refused_are_tried_again(
    takes: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def lacking(*_: Any) -> None:
        raise MissingExtraError("something is not installed")

    with monkeypatch.context() as patched:
        patched.setattr(motion_takes, "_prepare", lacking)
        with pytest.raises(InputError, match="something is not installed"):
            build_motion(takes / "both", tmp_path / "db", workers=1)
    assert list(tmp_path.iterdir()) == []
    assert build_motion(takes / "both", tmp_path / "db", workers=1).takes == 2


def test_the_processes_of_a_killed_build_end_too(takes: Path, tmp_path: Path) -> None:
    script = tmp_path / "program.py"
    script.write_text(WORKERS)
    given = [sys.executable, str(script), str(takes / "both"), str(tmp_path / "db")]
    # They hold its standard output open: this waits until the last of them has ended.
    ended = subprocess.run(given, capture_output=True, timeout=60)
    assert ended.returncode in (-9, 15), ended.stderr.decode()
