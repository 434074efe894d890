"""Character files for tests: written beside what they name."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from tests.models import model

LOW: dict[str, Any] = {"pair": ["l", "ow"], "curves": {"W": [[0, 0], [0.6, 0.2], [1, 0]]}}


def write_character(path: Path, **content: Any) -> Path:
    """Write a character file; it is called what the file is called."""
    head = {"format": "lipwright/character", "version": 1, "name": path.stem}
    path.write_text(json.dumps({**head, **content}), "utf-8")
    return path


def write_overrides(path: Path, **content: Any) -> Path:
    """Write a file of bigram overrides."""
    head = {"format": "lipwright/bigram-overrides", "version": 1, "name": path.stem}
    path.write_text(json.dumps({**head, **content}), "utf-8")
    return path


def write_mapping(path: Path, **content: Any) -> Path:
    """Write a mapping file."""
    head = {"format": "lipwright/mapping", "version": 1, "name": path.stem, "controls": {}}
    path.write_text(json.dumps({**head, **content}), "utf-8")
    return path


def write_model(path: Path, *targets: str) -> Path:
    """Write a model with morph targets."""
    path.write_bytes(model(targets or ("jawOpen", "mouthPucker")).to_glb())
    return path
