"""The file of a live model: it comes back bit for bit, and what is broken is refused."""

from __future__ import annotations

import base64
import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lipwright.engines.neural import load_model
from lipwright.engines.neural.convolution import MOST, on_grid
from lipwright.engines.neural.live_model import LiveModel, read_live_model
from lipwright.engines.neural.stream import hear_all
from lipwright.errors import FileFormatError, InputError
from tests.engines.neural.tiny import UNITS, tiny, voice

MODEL = tiny()


@pytest.mark.parametrize("model", [MODEL, tiny(ahead=4, centred=True)], ids=["back", "centred"])
def test_a_file_gives_the_same_model(model: LiveModel, tmp_path: Path) -> None:
    model.save(tmp_path / "m")
    read = read_live_model(tmp_path / "m")
    assert read.to_bytes() == model.to_bytes()
    one, other = (hear_all(voice(0.5), 16000, which).values for which in (model, read))
    assert one.tobytes() == other.tobytes()


def change(document: dict[str, Any], *path: Any, to: Any) -> None:
    for step in path[:-1]:
        document = document[step]
    document[path[-1]] = to


BROKEN: dict[str, tuple[Callable[[dict[str, Any]], None], str]] = {
    "another version": (lambda d: change(d, "version", to=2), "version 2"),
    "another format": (lambda d: change(d, "format", to="lipwright/set"), "lipwright/set"),
    "a part that is missing": (lambda d: d.pop("doubt"), "doubt"),
    "a part that is unknown": (lambda d: change(d, "more", to=1), "more"),
    "weights cut short": (
        lambda d: change(d, "first", "weights", to=d["first"]["weights"][:-8]),
        "bytes of weights",
    ),
    "weights that are none": (lambda d: change(d, "first", "bias", to="!"), "no base64"),
    "weights of 8 bits": (lambda d: change(d, "first", "bits", to=8), "weights of 8 bits"),
    "a layer of another size": (
        lambda d: change(d, "blocks", 0, "back", "units", to=7),
        "block 1: 8 x 7 weights; expected 8 x 8",
    ),
    "fewer outputs than controls": (
        lambda d: change(d, "controls", to=["open", "PBM", "W"]),
        "another number of ranges",
    ),
    "controls twice": (lambda d: change(d, "controls", to=["open", "open"]), "the same name"),
    "a range upside down": (lambda d: change(d, "low", to=[2.0, 0.0]), "a range that is none"),
    "far ahead": (lambda d: change(d, "ahead", to=1000), "1000 frames ahead"),
    "too deep": (lambda d: change(d, "depth", to=500), "a depth of 500 dB"),
    "answers long after": (lambda d: change(d, "own", to=-400), "an answer -400 frames away"),
    "instants to come": (lambda d: change(d, "instants", to=[0, 2]), "the instants [0, 2]"),
    "bands long ago": (lambda d: change(d, "bands", to=[-500, 0]), "the bands [-500, 0]"),
    "no layers": (lambda d: change(d, "layers", to=[]), "no layers"),
    "nothing said of its training": (lambda d: d["about"].pop("seconds"), "seconds"),
    "a dilation of 0": (lambda d: change(d, "blocks", 1, "dilation", to=0), "dilation"),
    "a closing of nothing": (
        lambda d: change(d, "closing", "control", to="lips"),
        "a closing that does not fit",
    ),
}


@pytest.mark.parametrize("name", BROKEN)
def test_a_broken_file_is_refused_in_one_line(name: str, tmp_path: Path) -> None:
    breaks, words = BROKEN[name]
    document = json.loads(MODEL.to_bytes())
    breaks(document)
    (tmp_path / "m").write_text(json.dumps(document))
    with pytest.raises(FileFormatError) as caught:
        read_live_model(tmp_path / "m")
    assert words in str(caught.value)
    assert str(tmp_path / "m") in str(caught.value)


@pytest.mark.parametrize("kept", [0, 10, 150, 2000])
def test_a_file_cut_short_is_refused(kept: int, tmp_path: Path) -> None:
    (tmp_path / "m").write_bytes(MODEL.to_bytes()[:kept])
    with pytest.raises(InputError):
        load_model(tmp_path / "m")


def test_weights_beyond_what_sums_can_hold_are_refused(tmp_path: Path) -> None:
    document = json.loads(MODEL.to_bytes())
    big = np.full(UNITS, 2**30, "<i4").tobytes()
    zeros = base64.b64encode(bytes(4 * 160 * UNITS)).decode()
    document["first"].update(bits=32, bias=base64.b64encode(big).decode(), weights=zeros)
    (tmp_path / "m").write_text(json.dumps(document))
    with pytest.raises(FileFormatError, match="beyond what sums can hold"):
        read_live_model(tmp_path / "m")


def test_what_layers_pass_on_is_bounded_and_on_the_grid() -> None:
    rng = np.random.default_rng(0)
    heard = on_grid(rng.normal(0, 100, (50, 160)))
    assert np.abs(heard).max() == MOST
    made = MODEL.net(heard, MODEL.net.rest())
    assert np.array_equal(made, on_grid(made))
    assert made.min() >= 0


@pytest.mark.parametrize(("centred", "delay"), [(False, 0), (True, 4)])
def test_what_passes_by_is_the_newest_instant_or_the_middle_one(centred: bool, delay: int) -> None:
    """Blocks that add nothing leave the first layer's answer, so much later."""
    net = tiny(centred=centred).net
    assert net.delay == delay
    silent = tuple(
        replace(
            block, back=replace(block.back, weights=0 * block.back.weights, bias=np.zeros(UNITS))
        )
        for block in net.blocks
    )
    heard = on_grid(np.random.default_rng(2).random((30, 160)))
    alone = replace(net, blocks=())(heard, [])
    passed = replace(net, blocks=silent)(heard, net.rest())
    assert np.array_equal(passed[delay:], alone[: len(alone) - delay])


@pytest.mark.parametrize("cut", [1, 3, 11])
def test_a_centred_net_hears_pieces_as_one(cut: int) -> None:
    net = tiny(centred=True).net
    heard = on_grid(np.random.default_rng(3).random((30, 160)))
    memory = net.rest()
    pieces = [net(heard[start : start + cut], memory) for start in range(0, 30, cut)]
    assert np.concatenate(pieces).tobytes() == net(heard, net.rest()).tobytes()


def test_sums_do_not_depend_on_their_order() -> None:
    """Units in another order, and layers with them, are the same net to the last bit."""
    rng = np.random.default_rng(1)
    heard = on_grid(rng.random((40, 160)))
    order = rng.permutation(160)
    first = MODEL.net.first
    other = replace(MODEL.net, first=replace(first, weights=first.weights[order]))
    one, two = MODEL.net(heard, MODEL.net.rest()), other(heard[:, order], other.rest())
    assert one.tobytes() == two.tobytes()
