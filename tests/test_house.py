"""The house's own rules: which way imports point, what is public, what stays light."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

import lipwright

PACKAGE = Path(lipwright.__file__).parent
LAYERS = [
    ("errors",),
    ("files",),
    ("timeline",),
    ("phones", "curves", "markers"),
    ("sound", "sound_files", "sound_headers", "sound_child", "gltf"),
    ("animation", "speech"),
    ("performance",),
    ("schedule", "engines", "character", "export", "evaluate"),
    ("casting", "marker_faces", "told_in_poses"),
    ("acting",),
    ("hearing", "measuring"),
    (
        "pipeline",
        "corpus",
        "marker_takes",
        "motion_takes",
        "neural_takes",
        "recorded",
        "recorded_database",
    ),
    ("studio",),
    ("cli",),
]
APART = ("schedule", "engines", "character", "export", "evaluate")
LEVEL = {name: level for level, names in enumerate(LAYERS) for name in names}


def part(module: str) -> str:
    """The folder or module of the package that a dotted name lies in."""
    return module.split(".")[1] if module.count(".") else ""


def imports() -> list[tuple[str, str, str]]:
    """``(file, part, imported part)`` of every import, those inside functions included."""
    found = []
    for path in sorted(PACKAGE.rglob("*.py")):
        inside = path.relative_to(PACKAGE)
        if inside.name in ("__init__.py", "__main__.py") and len(inside.parts) == 1:
            continue
        own = inside.parts[0].removesuffix(".py")
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            names = []
            if isinstance(node, ast.Import):
                names = [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom) and node.module:
                names = [node.module]
                if node.module == "lipwright":
                    names = [f"lipwright.{alias.name}" for alias in node.names]
            found += [
                (inside.as_posix(), own, part(name))
                for name in names
                if name.startswith("lipwright.")
            ]
    return found


def test_every_module_has_its_place() -> None:
    assert {own for _, own, _ in imports()} <= set(LEVEL)


def test_imports_point_one_way() -> None:
    wrong = [
        (file, other)
        for file, own, other in imports()
        if own != other and other != "__version__" and LEVEL[other] > LEVEL[own]
    ]
    assert wrong == []


def test_schedules_engines_characters_and_exports_do_not_know_each_other() -> None:
    wrong = [
        (file, other)
        for file, own, other in imports()
        if own in APART and other in APART and own != other
    ]
    assert wrong == []


def test_every_public_name_is_there() -> None:
    assert sorted(lipwright.__all__) == list(lipwright.__all__)
    for name in lipwright.__all__:
        assert getattr(lipwright, name) is not None
    with pytest.raises(AttributeError, match="no attribute 'speek'"):
        lipwright.speek  # noqa: B018
    assert set(lipwright.__all__) == set(lipwright._HOMES)


@pytest.mark.parametrize(
    ("statement", "heavy"),
    [
        ("import lipwright", ["numpy", "msgspec", "click"]),
        ("import lipwright.cli", ["numpy", "msgspec", "rich"]),
        (
            "import lipwright.pipeline, lipwright.engines.bigram, lipwright.engines.neural.engine",
            ["scipy", "sklearn", "pocketsphinx", "soundfile", "starlette", "espeakng_loader"],
        ),
    ],
)
def test_importing_brings_only_what_is_needed(statement: str, heavy: list[str]) -> None:
    code = f"import sys; {statement}; print(' '.join(m for m in {heavy!r} if m in sys.modules))"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == ""


def test_modules_are_small() -> None:
    longest = {
        path.relative_to(PACKAGE).as_posix(): len(path.read_text("utf-8").splitlines())
        for path in PACKAGE.rglob("*.py")
    }
    assert {name: count for name, count in longest.items() if count > 400} == {}
