"""A studio that listens, and what talks to it as a browser would."""

from __future__ import annotations

import http.client
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any
from urllib.parse import quote, urlencode

import msgspec
import uvicorn
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Origin

from lipwright.studio.messages import Answer, Failed
from lipwright.studio.running import listen
from lipwright.studio.server import Server
from lipwright.studio.session import Session

TOKEN = "secret-of-the-link"
PATIENCE = 60.0
_ANSWERS: msgspec.json.Decoder[Answer] = msgspec.json.Decoder(Answer)


@dataclass(frozen=True)
class Got:
    """An answer over HTTP."""

    status: int
    headers: Mapping[str, str]
    content: bytes

    def json(self) -> Any:
        return msgspec.json.decode(self.content)


@dataclass(frozen=True)
class Live:
    """Where a studio listens."""

    port: int
    token: str = TOKEN

    @property
    def host(self) -> str:
        return f"127.0.0.1:{self.port}"

    def request(
        self,
        path: str,
        *,
        headers: Mapping[str, str] | None = None,
        token: str | None = None,
        content: bytes | None = None,
        **query: str,
    ) -> Got:
        """Ask for a path; ``headers`` go over those of the studio's own page."""
        sent = {"Host": self.host, **(headers or {})}
        if token is None:
            sent["X-Lipwright-Token"] = self.token
        else:
            query["token"] = token
        where = path + ("?" + urlencode(query) if query else "")
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE)
        try:
            connection.request("GET" if content is None else "POST", where, content, sent)
            answer = connection.getresponse()
            return Got(answer.status, dict(answer.headers), answer.read())
        finally:
            connection.close()

    def upgrade(self, headers: Mapping[str, str], token: str) -> int:
        """Return the status that a WebSocket's first request gets."""
        sent = {
            "Host": self.host,
            "Connection": "Upgrade",
            "Upgrade": "websocket",
            "Sec-WebSocket-Version": "13",
            "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ==",
            **headers,
        }
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE)
        try:
            connection.request("GET", f"/talk?token={quote(token)}", headers=sent)
            return connection.getresponse().status
        finally:
            connection.close()

    @contextmanager
    def page(self) -> Iterator[Talk]:
        """Open a tab."""
        link = f"ws://{self.host}/talk?token={self.token}"
        with connect(link, origin=Origin(f"http://{self.host}"), max_size=None) as socket:
            yield Talk(socket)


class Talk:
    """One tab."""

    def __init__(self, socket: ClientConnection) -> None:
        self.socket = socket
        self._number = 100

    def send(self, kind: str, **said: Any) -> int:
        """Ask; return the number of the request."""
        self._number += 1
        message = {"type": kind, "id": self._number, **said}
        self.socket.send(msgspec.json.encode(message).decode())
        return self._number

    def next(self) -> Any:
        """Return what comes next."""
        return _ANSWERS.decode(self.socket.recv(PATIENCE))

    def hear(self, kind: str, number: int | None = None) -> Any:
        """Return the next message of a kind; any failure on the way is told."""
        while True:
            said = self.next()
            if type(said).__struct_config__.tag == kind and number in (None, said.id):
                return said
            assert not isinstance(said, Failed), said.error

    def ask(self, asked: str, answer: str, **said: Any) -> Any:
        """Ask, and return the answer."""
        return self.hear(answer, self.send(asked, **said))

    def drain(self) -> None:
        """Take what comes, until the studio ends the talk."""
        while True:
            self.next()

    def fail(self, text: str) -> Failed:
        """Send any text, and return the failure that comes of it."""
        self.socket.send(text)
        while not isinstance(said := self.next(), Failed):
            pass
        return said


@contextmanager
def live(session: Session) -> Iterator[Live]:
    """Let a studio listen in a thread of its own."""
    listening = listen()
    where = Live(listening.getsockname()[1])
    server = uvicorn.Server(
        uvicorn.Config(
            Server(session, TOKEN, (where.host,)).app,
            log_level="error",
            ws="websockets-sansio",
            lifespan="on",
            timeout_graceful_shutdown=2,
        )
    )
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listening]}, daemon=True)
    thread.start()
    try:
        yield where
    finally:
        server.should_exit = True
        thread.join(PATIENCE)
        listening.close()
