"""A GLB keeps what it holds and gains an animation that plays back the curves."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lipwright.animation import Animation
from lipwright.character.builtin import to_gltf
from lipwright.character.character import Character, load_character
from lipwright.character.skeleton import local_matrix, turned, world_matrices
from lipwright.character.vocabulary import POSES
from lipwright.errors import CharacterError, InputError
from lipwright.export.glb import encode
from lipwright.gltf import Gltf, GltfWriter, morph_meshes, parse_glb, read_accessor
from lipwright.performance import Performance, RiggedModel
from lipwright.phones import PhoneTrack
from lipwright.speech import Speech
from lipwright.timeline import Tier
from tests.character.sheets import jawed, widened
from tests.export.validator import issues
from tests.models import model, square

ICT_HEAD = Path(__file__).parents[2] / "../shared/characters/ict_head.glb"


def line(
    controls: tuple[str, ...] = ("jawOpen",), frames: int = 30, start: float = 0.0
) -> Animation:
    values = np.random.default_rng(4).random((frames, len(controls)), dtype=np.float32)
    phones = PhoneTrack(Tier.of(("hh", 0.0, 0.1), ("ay", 0.1, 0.4)))
    words = Tier.of(("hi", 0.0, 0.4))
    return Animation(controls, values, 60.0, start, phones=phones, words=words, engine="bigram")


def written(made: Gltf, channels: Animation) -> Gltf:
    rigged = RiggedModel("face", made.to_glb(), channels)
    speech = Speech(channels.phones, channels.words)
    return parse_glb(encode(Performance(channels, speech, lambda: rigged)))


def played(made: Gltf, node: int, times: np.ndarray) -> np.ndarray:
    """Return the weights of a node's morph targets at times, as a viewer reads them."""
    animation = made.json["animations"][-1]
    (channel,) = (c for c in animation["channels"] if c["target"]["node"] == node)
    sampler = animation["samplers"][channel["sampler"]]
    assert (channel["target"]["path"], sampler["interpolation"]) == ("weights", "LINEAR")
    keys = read_accessor(made, sampler["input"])
    outputs = read_accessor(made, sampler["output"]).reshape(len(keys), -1)
    return np.stack([np.interp(times, keys, column) for column in outputs.T], axis=1)


def test_the_curves_play_back_at_every_frame() -> None:
    channels = line(("mouthPucker", "jawOpen"))
    made = written(model(("jawOpen", "browUp", "mouthPucker")), channels)
    found = played(made, 0, channels.times)
    assert np.abs(found[:, 0] - channels.control("jawOpen")).max() < 1e-5
    assert np.abs(found[:, 2] - channels.control("mouthPucker")).max() < 1e-5
    assert not found[:, 1].any()


def test_targets_that_are_not_driven_keep_their_weight_at_rest() -> None:
    base = model(("jawOpen", "smile"))
    base.json["meshes"][0]["weights"] = [0.1, 0.3]
    found = played(written(base, line()), 0, np.array([0.0, 0.2]))
    assert found[:, 1].tolist() == pytest.approx([0.3, 0.3])


def test_every_mesh_with_a_driven_target_moves_and_no_other() -> None:
    parts = [square("Face", ["jawOpen", "x"]), square("Brow", ["up"]), square("Jaw", ["jawOpen"])]
    made = written(to_gltf(parts, "Head"), line())
    nodes = [channel["target"]["node"] for channel in made.json["animations"][0]["channels"]]
    assert nodes == [0, 2]
    assert np.array_equal(played(made, 0, line().times)[:, :1], played(made, 2, line().times))


def test_what_starts_before_the_sound_is_shifted_and_said() -> None:
    channels = line(start=-0.2)
    made = written(model(), channels)
    animation = made.json["animations"][0]
    keys = read_accessor(made, animation["samplers"][0]["input"])
    assert (keys[0], keys[-1]) == (0, pytest.approx(29 / 60))
    extras = animation["extras"]["lipwright"]
    assert extras["sound_start"] == pytest.approx(0.2)
    assert extras["words"] == [["hi", 0.2, 0.6]]
    assert extras["phones"][1] == ["ay", 0.3, 0.6]
    assert extras["rate"] == 60


def test_what_starts_after_the_sound_stays_there() -> None:
    made = written(model(), line(start=0.5))
    sampler = made.json["animations"][0]["samplers"][0]
    assert read_accessor(made, sampler["input"])[0] == 0.5
    assert made.json["animations"][0]["extras"]["lipwright"]["sound_start"] == 0


def test_frames_inside_a_rest_are_left_out_without_loss() -> None:
    values = np.array([0, 0, 0, 0, 0.5, 1, 1, 1, 1, 1, 0], np.float32)[:, None]
    channels = Animation(("jawOpen",), values, 10.0)
    made = written(model(), channels)
    keys = read_accessor(made, made.json["animations"][0]["samplers"][0]["input"])
    assert np.round(keys * 10).tolist() == [0, 3, 4, 5, 9, 10]
    assert np.abs(played(made, 0, channels.times)[:, 0] - values[:, 0]).max() < 1e-5


def rich_model() -> Gltf:
    """Return a model with a sparse target, an animation, a skin, and things of others."""
    writer = GltfWriter(model(("jawOpen", "mouthPucker")))
    clock = writer.accessor(np.array([0, 1], np.float32), limits=True)
    turns = writer.accessor(np.array([[0, 0, 0, 1], [0, 1, 0, 0]], np.float32))
    sampler = {"input": clock, "output": turns}
    channel = {"sampler": 0, "target": {"node": 1, "path": "rotation"}}
    writer.add("animations", {"name": "Nod", "samplers": [sampler], "channels": [channel]})
    writer.json["extras"] = {"by": "someone", "pi": 3.141592653589793, "tiny": 1e-300}
    writer.json["extensionsUsed"] = ["EXT_of_others"]
    writer.json["extensions"] = {"EXT_of_others": {"deep": [{"er": None}]}}
    writer.view(b"odd")
    return writer.finish()


def test_everything_in_the_file_survives() -> None:
    base = rich_model()
    made = written(base, line())
    assert made.binary[: len(base.binary)] == base.binary
    for key, value in base.json.items():
        if key in ("accessors", "bufferViews", "animations"):
            assert made.json[key][: len(value)] == value
        elif key != "buffers":
            assert made.json[key] == value
    assert [animation["name"] for animation in made.json["animations"]] == ["Nod", "Lipwright"]
    assert any("sparse" in accessor for accessor in base.json["accessors"])


@pytest.mark.parametrize("make", [model, rich_model])
def test_the_validator_finds_nothing_new(make: Any, tmp_path: Path) -> None:
    base = make()
    old, new = issues(base.to_glb(), tmp_path), issues(written(base, line()).to_glb(), tmp_path)
    assert new == old


def spoken(character: str | Path) -> tuple[Performance, Animation]:
    animation = line(POSES, 90, -0.2)
    loaded = load_character(character)
    rigged = loaded.rig(animation)
    return Performance(animation, Speech(animation.phones), lambda: rigged), rigged.channels


def test_the_built_in_head_is_flawless(tmp_path: Path) -> None:
    performance, _ = spoken("head")
    assert issues(encode(performance), tmp_path) == []


@pytest.mark.shared_data
@pytest.mark.skipif(not ICT_HEAD.exists(), reason="the shared folder is absent")
def test_the_scanned_head_is_animated_and_flawless(tmp_path: Path) -> None:
    performance, channels = spoken(ICT_HEAD)
    data = encode(performance)
    assert issues(data, tmp_path) == []
    made, old = parse_glb(data), parse_glb(ICT_HEAD.read_bytes())
    assert made.binary[: len(old.binary)] == old.binary
    skin = morph_meshes(made)[0]
    found = played(made, skin.nodes[0], channels.times + 0.2)[:, skin.targets.index("jawOpen")]
    assert np.abs(found - channels.control("jawOpen")).max() < 1e-4


QUARTER = 0.5**0.5
TURNED = {"rotation": [0, 0, QUARTER, QUARTER]}
MATRIX = {"matrix": [0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 0, 0.02, -0.07, 1]}


def jaw_line(joint: dict[str, Any]) -> tuple[Gltf, Gltf, Animation]:
    """Return a model with a jaw joint that stands so, the written one, and the line."""
    base = jawed({"mouthPucker": widened(-0.4)}, joint)
    if "matrix" in joint:
        for key in ("translation", "rotation", "scale"):
            base.json["nodes"][3].pop(key, None)
    animation = line(POSES, 40, -0.2)
    character = Character("face", lambda: base)
    speech = Speech(animation.phones)
    made = encode(Performance(animation, speech, lambda: character.rig(animation)))
    return base, parse_glb(made), character.rig(animation).channels


@pytest.mark.parametrize("joint", [{}, TURNED, MATRIX])
def test_a_joint_turns_away_from_its_rest(joint: dict[str, Any]) -> None:
    base, made, channels = jaw_line(joint)
    animation = made.json["animations"][0]
    (channel,) = (c for c in animation["channels"] if c["target"]["path"] == "rotation")
    assert channel["target"]["node"] == 3
    sampler = animation["samplers"][channel["sampler"]]
    turns = read_accessor(made, sampler["output"]).astype(np.float64)
    assert np.abs(np.linalg.norm(turns, axis=1) - 1).max() < 1e-6
    rest = world_matrices(base)[3]
    assert np.abs(world_matrices(made)[3] - rest).max() < 1e-6
    across = np.linalg.inv(rest[:3, :3]) @ (1.0, 0.0, 0.0)
    for frame in (0, 11, 39):
        angle = np.radians(20.0 * channels.control("Jaw")[frame])
        expected = (
            local_matrix(base.json["nodes"][3])[:3, :3]
            @ turned(np.eye(3), across / np.linalg.norm(across), angle).T
        )
        node = {**made.json["nodes"][3], "rotation": turns[frame].tolist()}
        assert np.abs(local_matrix(node)[:3, :3] - expected).max() < 1e-5
    assert "matrix" not in made.json["nodes"][3]


@pytest.mark.parametrize("joint", [TURNED, MATRIX])
def test_the_validator_finds_nothing_in_a_turning_jaw(
    joint: dict[str, Any], tmp_path: Path
) -> None:
    assert issues(jaw_line(joint)[1].to_glb(), tmp_path) == []


def test_nothing_to_write_is_an_error() -> None:
    with pytest.raises(InputError, match="face: no frames"):
        written(model(), line(frames=0))
    with pytest.raises(
        CharacterError, match="face: no morph target or joint of it is moved by wiggle"
    ):
        written(model(), line(("wiggle",)))
