"""The studio's server: one WebSocket for all that is said, HTTP for sounds and models.

Requests are answered in the order in which they come, in one thread, so that two tabs can
never be in each other's way; what takes long is done beside. A page that is slow is sent
the newest state, not every one between.
"""

from __future__ import annotations

import asyncio
import contextlib
import sys
import tempfile
import traceback
from collections.abc import AsyncIterator
from hashlib import sha256
from pathlib import Path, PurePath
from typing import Any

import msgspec
from starlette.applications import Starlette
from starlette.requests import Request as HttpRequest
from starlette.responses import FileResponse, JSONResponse, Response
from starlette.routing import Mount, Route, WebSocketRoute
from starlette.staticfiles import StaticFiles
from starlette.websockets import WebSocket, WebSocketDisconnect

from lipwright.errors import InputError, LipwrightError
from lipwright.studio.actors import Actor
from lipwright.studio.asking import Job, Reply, Studio
from lipwright.studio.guard import Guard
from lipwright.studio.messages import Answer, Failed, Progress, Request
from lipwright.studio.page_views import Watcher
from lipwright.studio.session import Session

PAGE = Path(__file__).parent / "page"
LARGEST = 1 << 29
MODELS = (".glb", ".vrm")
_REQUESTS: msgspec.json.Decoder[Request] = msgspec.json.Decoder(Request)
_ENCODER = msgspec.json.Encoder()


class _Id(msgspec.Struct):
    """What is left of a message that makes no sense."""

    id: int = 0


class Page:
    """One tab.

    Parameters
    ----------
    socket : WebSocket
    session : Session
    """

    def __init__(self, socket: WebSocket, session: Session) -> None:
        self._socket = socket
        self.watcher = Watcher(session)
        self._said: asyncio.Queue[bytes | None] = asyncio.Queue()
        self._is_due = False

    def say(self, answer: Answer, number: int = 0) -> None:
        """Send an answer, with the number of its request."""
        self._said.put_nowait(_ENCODER.encode(msgspec.structs.replace(answer, id=number)))

    def due(self) -> None:
        """Send, when the page has taken what is on its way, what became different.

        Behind it comes :class:`Watched`: a page knows from its revision what it has seen.
        """
        self._is_due = True
        self._said.put_nowait(None)

    async def deliver(self) -> None:
        """Send what there is to say, for as long as the page is there."""
        while True:
            said = await self._said.get()
            if said is not None:
                await self._socket.send_text(said.decode())
            # An answer may have come in behind what woke us: then it goes first.
            if self._is_due and self._said.empty():
                self._is_due = False
                for view in self.watcher.all_news():
                    await self._socket.send_text(_ENCODER.encode(view).decode())


class Server:
    """The application for one session.

    Parameters
    ----------
    session : Session
    token : str
    hosts : tuple of str
    """

    def __init__(self, session: Session, token: str, hosts: tuple[str, ...]) -> None:
        self.studio = Studio(session)
        self._session = session
        self._pages: list[Page] = []
        self._jobs: set[asyncio.Task[None]] = set()
        app = Starlette(
            routes=[
                Route("/", self._index),
                Route("/alive", self._alive),
                Route("/sounds/{key}.wav", self._sound),
                Route("/models/{key}.glb", self._model),
                Route("/sounds", self._take_sound, methods=["POST"]),
                Route("/models", self._take_model, methods=["POST"]),
                WebSocketRoute("/talk", self._talk),
                Mount("/assets", StaticFiles(directory=PAGE / "assets", check_dir=False)),
            ],
            lifespan=self._life,
        )
        self.app = Guard(app, token, hosts)

    @contextlib.asynccontextmanager
    async def _life(self, _: Starlette) -> AsyncIterator[None]:
        # A page asks for the model at once: it is made while the browser starts.
        making = asyncio.create_task(asyncio.to_thread(lambda: self._session.actor.key))
        try:
            yield
        finally:
            making.cancel()
            for job in self._jobs:
                job.cancel()
            self._session.close()

    # --- talk ---

    async def _talk(self, socket: WebSocket) -> None:
        await socket.accept()
        page = Page(socket, self._session)
        self._pages.append(page)
        sending = asyncio.create_task(page.deliver())
        try:
            while True:
                self._answer(page, await socket.receive_text())
        except (WebSocketDisconnect, KeyError):  # a frame that is no text is the second
            pass
        finally:
            self._pages.remove(page)
            sending.cancel()
            with contextlib.suppress(asyncio.CancelledError, Exception):
                await sending

    def _answer(self, page: Page, text: str) -> None:
        try:
            request = _REQUESTS.decode(text)
        except msgspec.MsgspecError as error:
            page.say(Failed(error=f"the message makes no sense: {error}"), _number(text))
            return
        try:
            reply = self.studio.ask(page.watcher, request)
        except Exception as error:
            reply = _mistake(error)
        self._send(page, request.id, reply)

    def _send(self, page: Page, number: int, reply: Reply) -> None:
        for answer in reply.own:
            page.say(answer, number)
        for each in self._pages:
            for answer in reply.everyone:
                each.say(answer, number if each is page else 0)
        if reply.changed:
            changed = self.studio.board.news()
            for each in self._pages:
                each.say(changed, number if each is page else 0)
                each.due()
        if reply.job is not None:
            task = asyncio.create_task(self._do(page, number, reply.job))
            self._jobs.add(task)
            task.add_done_callback(self._jobs.discard)

    async def _do(self, page: Page, number: int, job: Job) -> None:
        loop = asyncio.get_running_loop()

        def told(share: float) -> None:
            progress = Progress(share=share, what=job.what)
            loop.call_soon_threadsafe(page.say, progress, number)

        told(0.0)
        try:
            result: Any = await asyncio.to_thread(job.work, told)
        except LipwrightError as error:
            result = error
        except Exception as error:
            self._send(page, number, _mistake(error))
            return
        try:
            self._send(page, number, self.studio.finish(job, result))
        except Exception as error:
            self._send(page, number, _mistake(error))

    # --- files ---

    async def _index(self, _: HttpRequest) -> Response:
        if not (PAGE / "index.html").is_file():
            text = "The studio's page has not been built. Type: python hatch_build.py"
            return Response(text, 500, media_type="text/plain")
        return FileResponse(PAGE / "index.html", headers={"cache-control": "no-store"})

    async def _alive(self, _: HttpRequest) -> Response:
        return JSONResponse({"session": self._session.id})

    async def _sound(self, request: HttpRequest) -> Response:
        try:
            path = self._session.sounds.path(request.path_params["key"])
        except InputError as error:
            return JSONResponse({"error": str(error)}, 404)
        return FileResponse(path, media_type="audio/wav", headers=_FOREVER)

    async def _model(self, request: HttpRequest) -> Response:
        for actor in self._session.actors.values():
            if actor.key == request.path_params["key"]:
                return Response(actor.glb, media_type="model/gltf-binary", headers=_FOREVER)
        return JSONResponse({"error": "no such model"}, 404)

    async def _take_sound(self, request: HttpRequest) -> Response:
        return await self._take(request, self._keep_sound)

    async def _take_model(self, request: HttpRequest) -> Response:
        return await self._take(request, self._keep_model)

    async def _take(self, request: HttpRequest, keep: Any) -> Response:
        """Take a file that is sent, into a folder of its own, and keep what it is."""
        name = PurePath(request.query_params.get("name", "")).name or "unnamed"
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / name
            with path.open("wb") as file:
                async for block in request.stream():
                    file.write(block)
                    if file.tell() > LARGEST:
                        return JSONResponse({"error": f"{name}: larger than 512 MB"}, 413)
            try:
                key = await asyncio.to_thread(keep, path)
            except LipwrightError as error:
                said = str(error).replace(str(path), name)
                return JSONResponse({"error": said}, 422)
        return JSONResponse({"key": key})

    def _keep_sound(self, path: Path) -> str:
        from lipwright.sound_files import read_sound

        return self._session.sounds.add(read_sound(path)).key

    def _keep_model(self, path: Path) -> str:
        if path.suffix.lower() not in MODELS:
            raise InputError(
                f"a file in {path.suffix!r}", where=path.name, expected=" or ".join(MODELS)
            )
        Actor(path.name, str(path)).view("a", self._session.state.own.of.rules.names)
        data = path.read_bytes()
        name = f"{sha256(data).hexdigest()[:8]}-{path.name}"
        self._session.draft.keep("models", name, data)
        return name


_FOREVER = {"cache-control": "private, max-age=31536000, immutable"}


def _number(text: str) -> int:
    with contextlib.suppress(msgspec.MsgspecError):
        return msgspec.json.decode(text, type=_Id).id
    return 0


def _mistake(error: Exception) -> Reply:
    """Answer for a mistake of our own: the session stands as it was."""
    traceback.print_exception(error, file=sys.stderr)
    return Reply((Failed(error=f"a mistake of the studio's own: {error!r}; nothing was lost"),))
