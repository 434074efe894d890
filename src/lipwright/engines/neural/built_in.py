"""The models that come with Lipwright, and any other's file, by name.

``whole`` hears a recording both ways, 0.65 s from each side; ``live`` hears as a
listener does. Both are made by ``python -m tools.neural_model`` from synthesised speech.
"""

from __future__ import annotations

from pathlib import Path

from lipwright.engines.neural.live_model import FORMAT, LiveModel, read_live_model
from lipwright.engines.neural.model import Model, read_model
from lipwright.errors import InputError
from lipwright.files import read_bytes

WHOLE, LIVE = "whole", "live"
_HEAD = 200
"""Bytes in which a file says what it is."""
FOLDER = Path(__file__).parents[2] / "data" / "neural"


def model_file(model: str | Path) -> Path:
    """Return the file of a model: one of ours by its name, else a path."""
    return FOLDER / f"{model}.json" if str(model) in (WHOLE, LIVE) else Path(model)


def load_model(model: str | Path) -> Model | LiveModel:
    """Return a model: ``"whole"``, ``"live"``, or that in a file.

    Raises
    ------
    InputError
        If the file cannot be read.
    FileFormatError
        If it is no model, of another version, cut short, or its parts do not fit.
    """
    path = model_file(model)
    head = read_bytes(path)[:_HEAD]
    return read_live_model(path) if FORMAT.encode() in head else read_model(path)


def live_model(model: str | Path = LIVE) -> LiveModel:
    """Return a model that a stream can use.

    Raises
    ------
    InputError
        Also if it is one of the publication's kind.
    """
    found = load_model(model)
    if isinstance(found, LiveModel):
        return found
    raise InputError(
        "a model of the publication's kind, which cannot stream",
        where=str(model),
        cure="train one with --hears live",
    )
