"""Starting the studio: where it listens, what is opened, how it ends.

A studio that is opened again with the same files takes the port and the token that it had,
where the port is free: a page that is still there goes on by itself.
"""

from __future__ import annotations

import asyncio
import secrets
import socket
import sys
import webbrowser
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import msgspec

from lipwright.errors import InputError, LipwrightError, MissingExtraError, OutputError
from lipwright.files import write_atomically
from lipwright.studio.desk import Place
from lipwright.studio.drafts import Draft, draft_folder
from lipwright.studio.opening import (
    Given,
    chosen_set,
    edits_owner,
    read_files,
    sort_names,
)
from lipwright.studio.session import Session

HOST = "127.0.0.1"
PATIENCE = 1.0


class Seat(msgspec.Struct, frozen=True):
    """Where a studio listens, and the token of its link."""

    port: int
    token: str

    @property
    def link(self) -> str:
        """The address of the page."""
        return f"http://{HOST}:{self.port}/?token={self.token}"


def open_session(
    given: Given, folder: Path | None = None, told: Callable[[str], None] = lambda _: None
) -> Session:
    """Return what was named on the command line, opened.

    Raises
    ------
    InputError
        If a file cannot be opened; the message names it.
    """
    found = sort_names(given)
    draft = Draft(draft_folder(given.key()))
    paths: dict[Place, str] = {}
    files: dict[Place, bytes] = {}
    for name, content in read_files(found).items():
        place: Place = ("set", "") if name == "set" else ("overrides", "")
        paths[place] = chosen_set(found) if name == "set" else found.overrides
        files[place] = content
    for path in found.edits:
        edits: Place = ("edits", edits_owner(path, found, given))
        paths[edits], files[edits] = path, Path(path).read_bytes()
    return Session(given, found, draft, folder or Path.cwd(), files, paths, told)


def run(
    given: Given,
    port: int | None = None,
    *,
    browser: bool = True,
    told: Callable[[str], None] = print,
    note: Callable[[str], None] = lambda _: None,
) -> None:
    """Open the studio and serve it until it is interrupted.

    Parameters
    ----------
    given : Given
    port : int, optional
        Where to listen; else where it did the last time, else any that is free.
    browser : bool
        Whether to open the page.
    told : function
        Called with lines for the user.
    note : function
        Called with what is worked on, where that takes long.

    Raises
    ------
    MissingExtraError
        If the extra ``studio`` is not installed.
    InputError
        If a file cannot be opened, or the port is taken.
    LipwrightError
        If the page has not been built.
    """
    try:
        import uvicorn

        from lipwright.studio.server import PAGE, Server
    except ImportError:
        raise MissingExtraError.of("the studio", "studio") from None
    folder = draft_folder(given.key())
    known = _known_seat(folder)
    if known is not None and _is_alive(known):
        told(f"The studio is open already: {known.link}")
        if browser:
            webbrowser.open(known.link)
        return
    with listen(port, known) as listening:
        session = open_session(given, None, note)
        if not (PAGE / "index.html").is_file():
            raise LipwrightError(
                "the studio's page has not been built",
                cure="install Lipwright again, or type in its source folder: python hatch_build.py",
            )
        token = known.token if known else secrets.token_urlsafe(24)
        seat = Seat(listening.getsockname()[1], token)
        _keep_seat(folder, seat)
        config = uvicorn.Config(
            Server(session, seat.token, (f"{HOST}:{seat.port}", f"localhost:{seat.port}")).app,
            log_level="warning",
            ws="websockets-sansio",
            ws_max_size=1 << 26,
            timeout_graceful_shutdown=2,
            lifespan="on",
        )
        told(f"The studio is open: {seat.link}\nEnd it with Ctrl-C.")
        if browser:
            webbrowser.open(seat.link)
        with suppress(KeyboardInterrupt):
            asyncio.run(uvicorn.Server(config).serve(sockets=[listening]))
    left = session.desk.dirty(session.state)
    kept = "what was not saved is kept, and offered when the same is opened again"
    told(f"The studio is closed{f'; {kept}' if left else ''}.")


def listen(port: int | None = None, known: Seat | None = None) -> socket.socket:
    """Return a socket that listens: at a port, else where it did the last time, else anywhere.

    Raises
    ------
    InputError
        If the port is taken, or may not be used.
    """
    wanted = [port] if port is not None else [*([known.port] if known else []), 0]
    for number in wanted:
        # asyncio sends small answers at once only where the protocol is named.
        listening = socket.socket(socket.AF_INET, socket.SOCK_STREAM, socket.IPPROTO_TCP)
        if sys.platform != "win32":
            listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listening.bind((HOST, number))
            listening.listen(128)  # a page that comes before all is open waits
            return listening
        except (OSError, OverflowError):
            listening.close()
    raise InputError(
        f"port {port} is taken, or may not be used",
        expected="a free port",
        cure="choose another with --port, or leave it out",
    )


def _seat_file(folder: Path) -> Path:
    return folder / "seat.json"


def _known_seat(folder: Path) -> Seat | None:
    with suppress(OSError, msgspec.MsgspecError):
        return msgspec.json.decode(_seat_file(folder).read_bytes(), type=Seat)
    return None


def _keep_seat(folder: Path, seat: Seat) -> None:
    path = _seat_file(folder)
    with suppress(OutputError):  # without it a page cannot go on by itself, that is all
        write_atomically(path, msgspec.json.encode(seat))
        with suppress(OSError):
            path.chmod(0o600)


def _is_alive(seat: Seat) -> bool:
    from http.client import HTTPConnection, HTTPException

    connection = HTTPConnection(HOST, seat.port, timeout=PATIENCE)
    try:
        connection.request("GET", "/alive", headers={"x-lipwright-token": seat.token})
        return connection.getresponse().status == 200
    except (OSError, HTTPException):
        return False
    finally:
        connection.close()
