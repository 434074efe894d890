"""The studio: what an edit costs, over the wire and on the server alone, and what a page weighs.

A key of a pair is moved, again and again, in a line of about 5 s with all stages shown, in
the middle of a recording of 10 minutes of which a part is shown, and under overrides with
gains. The page's own figures (first view, to the picture on screen) are taken in Chromium.
"""

from __future__ import annotations

import gzip
import os
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from itertools import pairwise
from time import perf_counter

import msgspec

from bench.measure import say, spread
from lipwright import pipeline
from lipwright.speech import Speech
from lipwright.studio import messages
from lipwright.studio.asking import Studio
from lipwright.studio.changes import AddLine, DrawCurve, LineData, MoveBoundary, SetRule
from lipwright.studio.lines import line_of
from lipwright.studio.opening import Given
from lipwright.studio.page_views import Watcher
from lipwright.studio.running import open_session
from lipwright.studio.server import PAGE
from lipwright.studio.session import Session

LINE = "Peter Piper picked a peck of pickled peppers, and the fat cat is low on the mat."
STAGES: tuple[messages.StageName, ...] = (
    "placed",
    "stitched",
    "smoothed",
    "constrained",
    "limited",
)
RUNS = 60
LONG = 600.0


@contextmanager
def thrown_away() -> Iterator[None]:
    """A state folder of our own."""
    with tempfile.TemporaryDirectory() as folder:
        os.environ["LIPWRIGHT_STATE"] = folder
        yield


def edit(number: int) -> bytes:
    """A key of the pair f-ah, a little elsewhere each time, as it comes over the wire."""
    keys = ((0.0, 0.0), (0.4, 0.3 + 0.4 * (number % 10) / 10), (1.0, 0.0))
    change = DrawCurve("overrides", ("f", "ah"), "open", keys)
    return msgspec.json.encode(messages.EditRequest(id=number, change=change, merge="drag"))


def drag(phone: int, time: float, number: int) -> bytes:
    """The end of a phone, a little elsewhere each time."""
    change = MoveBoundary("long", phone, time + 0.001 * (number % 10))
    return msgspec.json.encode(messages.EditRequest(id=number, change=change, merge="drag"))


def milliseconds(
    session: Session, watch: messages.Watch, made: Callable[[int], bytes] = edit
) -> dict[str, float]:
    """An edit, from bytes in to all bytes out."""
    studio, watcher = Studio(session), Watcher(session)
    decoder: msgspec.json.Decoder[messages.Request] = msgspec.json.Decoder(messages.Request)
    studio.ask(watcher, watch)
    took = []
    for number in range(RUNS):
        data = made(number)
        begun = perf_counter()
        reply = studio.ask(watcher, decoder.decode(data))
        said = [*reply.own, studio.board.news(), *watcher.news()]
        for one in said:
            msgspec.json.encode(one)
        took.append(1e3 * (perf_counter() - begun))
    return spread(took)


def long_line(line: LineData) -> LineData:
    """The line again and again, up to ten minutes."""
    length = line.phones[-1][2]
    times = int(LONG / length)

    def rows(of: tuple[tuple[str, float, float], ...]) -> tuple[tuple[str, float, float], ...]:
        return tuple(
            (label, round(start + n * length, 6), round(end + n * length, 6))
            for n in range(times)
            for label, start, end in of
        )

    return msgspec.structs.replace(
        line, id="long", phones=rows(line.phones), words=rows(line.words), sound=None
    )


def over_the_wire(session: Session) -> dict[str, float]:
    """The same from a page's socket and back."""
    from tests.studio.live import live

    with live(session) as where, where.page() as tab:
        tab.ask("start", "hello")
        tab.ask("watch", "watched", pair=["f", "ah"], line="1", stages=STAGES)
        took = []
        for number in range(RUNS):
            begun = perf_counter()
            tab.socket.send(edit(number).decode())
            tab.hear("motion")
            took.append(1e3 * (perf_counter() - begun))
        return spread(took)


def in_chromium(session: Session) -> None:
    """First view, edits from the hand to the picture, and pictures per second while playing."""
    from tests.chromium import chromium
    from tests.studio.live import live
    from tests.studio.tab import tab

    with live(session) as where, chromium() as browser:
        for name in ("cold", "warm"):
            begun = perf_counter()
            with tab(browser, where) as page:
                whole = round(1e3 * (perf_counter() - begun))
                paint = page.ask(
                    "performance.getEntriesByName('first-contentful-paint')[0]?.startTime ?? 0"
                )
                say(f"the page in Chromium, {name}", first_paint_ms=round(paint), all_ms=whole)
                if name == "cold":
                    continue
                page.pair("f", "ah")
                page.pose("open")
                place = page.ask("studio.keyAt('open', 1)")
                page.page.mouse.move(place["x"], place["y"])
                page.page.mouse.down()
                for step in range(40):  # as fast as a screen takes them from a hand
                    page.page.mouse.move(place["x"], place["y"] - step)
                    page.page.wait_for_timeout(16)
                page.page.mouse.up()
                page.settle()
                say("from the hand to the picture", **spread(page.ask("studio.latencies()")))
                page.ask("studio.play()")
                page.page.wait_for_timeout(1500)
                pictures = round(page.ask("studio.pictures()"), 1)
                page.ask("studio.seek(0.3)")
                page.ask("studio.play()")
                behind = page.ask(BEHIND)
                say("while playing", pictures_per_second=pictures, face_behind_sound=spread(behind))


BEHIND = """async () => {
    const found = [];
    for (let picture = 0; picture < 40; picture++) {
        await new Promise(requestAnimationFrame);
        const now = studio.time(), shown = studio.morphs();
        let best = Infinity, at = 0;
        for (let back = -20; back <= 150; back += 2) {
            const wanted = studio.controls(now - back / 1000);
            let apart = 0;
            for (const name of ["W", "wide", "PBM", "FV", "tRoof"]) {
                apart += Math.abs((wanted[name] ?? 0) - (shown[name] ?? 0));
            }
            if (apart < best) [best, at] = [apart, back];
        }
        if (best < 0.02) found.push(at);
    }
    return found;
}"""
"""How many ms before the sound's present place lies what the face shows: in each picture."""


def page_weight() -> dict[str, int]:
    """Kilobytes of the page's files, gzipped."""
    sizes = {path.suffix: 0 for path in PAGE.rglob("*") if path.suffix in (".js", ".css", ".html")}
    for path in PAGE.rglob("*"):
        if path.suffix in sizes:
            sizes[path.suffix] += len(gzip.compress(path.read_bytes(), 9))
    return {suffix.lstrip("."): round(size / 1000) for suffix, size in sorted(sizes.items())}


def main() -> None:
    """Print all figures."""
    speech: Speech = pipeline.say(LINE)
    with thrown_away():
        begun = perf_counter()
        session = open_session(Given(("english",)))
        say("opening the English set", ms=round(1e3 * (perf_counter() - begun)))
        line = line_of(speech, session.sounds, "1")
        session.edit(AddLine(line))
        session.edit(AddLine(long_line(line)))
        whole = messages.Watch(pair=("f", "ah"), line="1", stages=STAGES)
        part = messages.Watch(pair=("f", "ah"), line="long", start=300.0, end=310.0, stages=STAGES)
        seconds = f"{speech.duration:.1f} s"
        say(f"an edit of a key, line of {seconds}, on the server", **milliseconds(session, whole))
        say("the same, in 10 minutes, 10 s shown", **milliseconds(session, part))
        long = session.state.lines["long"]
        phone, time = next(
            (number, former[2])
            for number, (former, later) in enumerate(pairwise(long.phones))
            if former[2] > 305.0 and "sil" not in (former[0], later[0])
        )
        say(
            "a phone's edge in 10 minutes, 10 s shown",
            **milliseconds(session, part, partial(drag, phone, time)),
        )
        say(f"the same, line of {seconds}, over the socket", **over_the_wire(session))
        session.edit(SetRule("overrides", "gain", ("wide",), "", 0.9))
        say(f"the same, line of {seconds}, under gains", **milliseconds(session, whole))
        in_chromium(session)
    weight = page_weight()
    say("the page, kB gzipped", **weight, all=sum(weight.values()))


if __name__ == "__main__":
    main()
