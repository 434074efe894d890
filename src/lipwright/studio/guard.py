"""Who may talk to the studio: its own page, with the token of its link, and nobody else.

A page of another origin that a browser has open could send requests to 127.0.0.1 as well.
It is refused by the Host header (a name that was bent to this address), by Origin and
Sec-Fetch-Site (which browsers set and pages cannot), and by the token, which it cannot know.
"""

from __future__ import annotations

import secrets
from collections.abc import Iterable
from urllib.parse import parse_qs

from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

HEADER = b"x-lipwright-token"
HEADERS = (
    (
        b"content-security-policy",
        b"default-src 'self'; connect-src 'self' ws: blob: data:; img-src 'self' data: blob:; "
        b"media-src 'self' blob:; style-src 'self' 'unsafe-inline'; worker-src 'self' blob:; "
        b"frame-ancestors 'none'; base-uri 'none'; form-action 'none'",
    ),
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"no-referrer"),
    (b"cross-origin-resource-policy", b"same-origin"),
    (b"cross-origin-opener-policy", b"same-origin"),
)
OPEN = "/assets/"


class Guard:
    """Lets through what comes from the studio's own page.

    Parameters
    ----------
    app : ASGIApp
    token : str
    hosts : iterable of str
        Names and ports under which the studio is reached: ``"127.0.0.1:5173"``.
    """

    def __init__(self, app: ASGIApp, token: str, hosts: Iterable[str]) -> None:
        self._app, self._token, self._hosts = app, token, frozenset(hosts)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request, or refuse it."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        reason = self._refusal(scope)
        if not reason:
            await self._app(scope, receive, _with_headers(send))
        elif scope["type"] == "websocket":
            await receive()
            await send({"type": "websocket.close", "code": 4403, "reason": reason})
        else:
            refused = JSONResponse({"error": reason}, 403)
            await refused(scope, receive, _with_headers(send))

    def _refusal(self, scope: Scope) -> str:
        headers: dict[bytes, bytes] = dict(scope["headers"])
        if headers.get(b"host", b"").decode("latin-1") not in self._hosts:
            return "another host: open the link that the studio printed"
        origin = headers.get(b"origin")
        if (
            origin is not None
            and origin.decode("latin-1").removeprefix("http://") not in self._hosts
        ):
            return "another origin"
        if headers.get(b"sec-fetch-site", b"none") not in (b"same-origin", b"none"):
            return "another site"
        path: str = scope["path"]
        if path.startswith(OPEN) and scope["type"] == "http":
            return ""
        given = headers.get(HEADER, b"").decode("latin-1") or _query_token(scope)
        if not secrets.compare_digest(given.encode(), self._token.encode()):
            return "no token, or a wrong one: open the link that the studio printed"
        return ""


def _query_token(scope: Scope) -> str:
    query = parse_qs(scope.get("query_string", b"").decode("latin-1"))
    found: list[str] = query.get("token", [""])
    return found[0]


def _with_headers(send: Send) -> Send:
    async def sent(message: Message) -> None:
        if message["type"] == "http.response.start":
            message["headers"] = [*message.get("headers", ()), *HEADERS]
        await send(message)

    return sent
