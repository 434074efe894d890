"""The HTML page, as a file: what is in it, and what could break out of it."""

from __future__ import annotations

import base64
import json
import re
from dataclasses import replace
from html.parser import HTMLParser
from typing import Any

import numpy as np
import pytest

from lipwright.animation import Animation
from lipwright.errors import CharacterError, LipwrightError
from lipwright.export import html
from lipwright.gltf import Gltf, morph_meshes, parse_glb
from lipwright.performance import Performance, RiggedModel
from lipwright.phones import PhoneTrack
from lipwright.sound import Sound
from lipwright.timeline import Tier
from tests.export.tiny_face import pop, tiny_face

HOSTILE = '</script><img src=x onerror="alert(1)"><!--<script>'


class _Blocks(HTMLParser):
    """The content of each element, as a browser would split the page."""

    def __init__(self) -> None:
        super().__init__()
        self.found: dict[str, str] = {}
        self.tags: list[str] = []
        self._inside = ""

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self._inside = dict(attrs).get("id") or ""

    def handle_endtag(self, tag: str) -> None:
        self._inside = ""

    def handle_data(self, data: str) -> None:
        if self._inside:
            self.found[self._inside] = self.found.get(self._inside, "") + data


def blocks(page: bytes) -> dict[str, str]:
    parser = _Blocks()
    parser.feed(page.decode())
    return parser.found


def content(page: bytes) -> dict[str, Any]:
    value: dict[str, Any] = json.loads(blocks(page)["lipwright-performance"])
    return value


def with_model(performance: Performance, glb: bytes) -> Performance:
    channels = performance.rig().channels
    return replace(performance, rig=lambda: RiggedModel("other", glb, channels))


def test_the_page_holds_the_animation_the_model_and_the_sound() -> None:
    page = html.encode(pop())
    data = content(page)
    assert data["controls"] == ["open", "PBM", "FV"]
    assert (data["rate"], data["start"], data["engine"]) == (60, -0.1, "bigram")
    assert data["phones"][1] == ["aa", 0.2, 0.5]
    assert data["words"] == [["pop", 0.0, 0.7]]
    assert data["report"]["stand_ins"] == ["p-aa"]
    frames = np.array(data["frames"])
    assert np.abs(frames - pop().animation.values).max() <= 0.5e-4
    assert base64.b64decode(blocks(page)["lipwright-sound"])[:4] == b"RIFF"


def test_channels_that_never_move_are_left_out() -> None:
    channels = content(html.encode(pop()))["channels"]
    assert channels["names"] == ["open", "PBM"]
    assert {len(row) for row in channels["frames"]} == {2}


def test_the_model_keeps_the_morph_targets_that_the_page_moves() -> None:
    model = parse_glb(base64.b64decode(blocks(html.encode(pop()))["lipwright-model"]))
    assert {mesh.name: set(mesh.targets) for mesh in morph_meshes(model)} == {
        "Skin": {"eyeBlinkLeft", "eyeBlinkRight"},
        "UpperLip": {"open", "PBM"},
        "LowerLip": {"open", "PBM"},
    }


def test_a_morph_target_that_the_model_holds_stays() -> None:
    model = parse_glb(tiny_face())
    model.json["meshes"][0]["weights"] = [0.0, 0.0, 0.5]
    page = html.encode(with_model(pop(), model.to_glb()))
    kept = parse_glb(base64.b64decode(blocks(page)["lipwright-model"]))
    assert "browInnerUp" in morph_meshes(kept)[0].targets


def test_a_model_that_looks_backwards_is_noted() -> None:
    model = parse_glb(tiny_face())
    model.json["extensions"] = {"VRM": {}}
    assert content(html.encode(with_model(pop(), model.to_glb())))["backwards"]
    assert not content(html.encode(pop()))["backwards"]


def test_without_sound_there_is_no_sound() -> None:
    assert "lipwright-sound" not in blocks(html.encode(pop(sound=False)))
    assert blocks(html.encode(pop()))["lipwright-sound"]


def test_the_page_asks_for_nothing_and_allows_no_foreign_script() -> None:
    page = html.encode(pop()).decode()
    assert "default-src 'none'" in page
    assert re.search(r"script-src 'sha256-[^' ]+';", page)
    elements = re.sub(r"<script.*?</script>", "", page, flags=re.DOTALL)
    assert not re.findall(r'(?:src|href)="(?!data:)[^"]*"', elements)
    assert not re.findall(r"@import|url\((?!data:)", elements)


def test_a_hostile_label_stays_a_label() -> None:
    plain = pop()
    phones = PhoneTrack(Tier.of((HOSTILE, 0.0, 0.5)))
    words = Tier.of((f"{HOSTILE}&amp;\u2028\0", 0.0, 0.5))
    animation = replace(plain.animation, phones=phones, words=words, report={HOSTILE: HOSTILE})
    speech = replace(plain.speech, text=HOSTILE, notes=(HOSTILE,))
    page = html.encode(replace(plain, animation=animation, speech=speech))
    data = content(page)
    assert data["phones"][0][0] == HOSTILE
    assert data["words"][0][0] == f"{HOSTILE}&amp;\u2028\0"
    assert (data["text"], data["notes"], data["report"]) == (HOSTILE, [HOSTILE], {HOSTILE: HOSTILE})
    parser, usual = _Blocks(), _Blocks()
    parser.feed(page.decode())
    usual.feed(html.encode(plain).decode())
    assert parser.tags == usual.tags


@pytest.mark.parametrize(
    ("seconds", "rate", "expected"),
    [(0.5, 16_000, 16_000), (0.5, 96_000, 48_000), (0.5, 4_000, 8_000), (121, 44_100, 24_000)],
)
def test_sound_has_a_rate_that_browsers_play(seconds: float, rate: int, expected: int) -> None:
    plain = pop()
    sound = Sound(np.zeros(round(seconds * rate), np.float32), rate)
    page = html.encode(replace(plain, speech=replace(plain.speech, sound=sound)))
    wav = base64.b64decode(blocks(page)["lipwright-sound"])
    assert int.from_bytes(wav[24:28], "little") == expected
    assert len(wav) == pytest.approx(74 + 2 * seconds * expected, abs=4)


def test_an_animation_without_frames_or_controls_is_still_a_page() -> None:
    empty = Animation((), np.zeros((0, 0), np.float32), 60.0)
    performance = replace(
        pop(sound=False), animation=empty, rig=lambda: RiggedModel("tiny", tiny_face(), empty)
    )
    assert content(html.encode(performance))["frames"] == []


def test_the_same_performance_gives_the_same_bytes() -> None:
    assert html.encode(pop()) == html.encode(pop())


def test_a_compressed_model_is_refused() -> None:
    document = {"asset": {"version": "2.0"}, "extensionsRequired": ["KHR_draco_mesh_compression"]}
    with pytest.raises(CharacterError, match=r"compressed .*KHR_draco.* without compression"):
        html.encode(with_model(pop(), Gltf(document, b"").to_glb()))


def test_a_player_that_was_not_built_is_named(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Any
) -> None:
    monkeypatch.setattr("lipwright.export.html.resources.files", lambda _: tmp_path)
    with pytest.raises(LipwrightError, match=r"not been built.*hatch_build\.py"):
        html.encode(pop())
    (tmp_path / "player.html").write_text("<html></html>", "utf-8")
    with pytest.raises(LipwrightError, match="damaged"):
        html.encode(pop())
