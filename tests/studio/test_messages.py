"""The page's types are the server's, and every request has its answer."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lipwright.engines.bigram.edits import Edit, find
from lipwright.studio import messages
from lipwright.studio.changes import ClearPair, DrawCurve, PutEdit
from lipwright.studio.lines import tier_of
from lipwright.studio.messages import (
    BigramView,
    Changed,
    CharacterView,
    CoverageView,
    ExampleView,
    Failed,
    Hello,
    LineView,
    Made,
    MotionView,
    PeaksView,
    PhoneView,
    PoseView,
    Variant,
    Watch,
    WhyView,
)
from lipwright.studio.typescript import typescript
from tests.studio.made import ask, opened, sound, talk
from tests.studio.test_session import TRIANGLE

PROTOCOL = Path(__file__).parents[2] / "web" / "src" / "studio" / "protocol.ts"
STAGES: tuple[messages.StageName, ...] = (
    "placed",
    "stitched",
    "smoothed",
    "constrained",
    "limited",
)


def unpacked(values: str) -> np.ndarray:
    from base64 import b64decode

    return np.frombuffer(b64decode(values), "<f4")


def test_the_pages_types_are_made_from_the_servers() -> None:
    assert PROTOCOL.read_text("utf-8") == typescript()


def test_hello_says_all_that_is_open(desk: Path) -> None:
    session = opened("english", "low.json")
    (hello,) = ask(*talk(session), messages.Start())
    assert isinstance(hello, Hello)
    assert len(hello.cells) == 483
    assert len(hello.classes) == 22
    assert [pose.name for pose in hello.poses][:2] == ["open", "W"]
    assert hello.target == "overrides"
    assert [line.title for line in hello.lines] == ["low.json"]
    assert {(one.document, one.suggested) for one in hello.files} >= {
        ("set", "my-english.json"),
        ("overrides", "english-overrides.json"),
        ("edits", "low.edits.json"),
    }
    rule = next(r for r in hello.rules if r.names == ("open",) and r.field == "limit")
    assert (rule.value, rule.default, rule.unit) == (15.0, 15.0, "per second")


def test_a_set_of_ones_own_is_drawn_in_by_default(desk: Path) -> None:
    (hello,) = ask(*talk(opened("mine.json")), messages.Start())
    assert isinstance(hello, Hello)
    assert hello.target == "set"


def test_what_is_watched_comes_at_once_and_when_it_changes(desk: Path) -> None:
    session = opened("english", "low.json")
    studio, watcher = talk(session)
    first = ask(studio, watcher, Watch(pair=("f", "ah"), phone="ah", line="1", stages=STAGES))
    assert [type(one) for one in first[:-1]] == [LineView, MotionView, BigramView, PhoneView]
    draw = messages.EditRequest(change=DrawCurve("overrides", ("f", "ah"), "open", TRIANGLE))
    changed, motion, bigram = ask(studio, watcher, draw)
    assert isinstance(changed, Changed)
    assert [(cell.pair, cell.overridden, cell.changed) for cell in changed.cells] == [
        (("f", "ah"), True, True)
    ]
    assert changed.rules is None
    assert isinstance(bigram, BigramView)
    assert bigram.override_curves is not None
    assert bigram.override_curves["open"] == TRIANGLE
    assert bigram.set_curves is not None
    assert bigram.set_curves["open"] != TRIANGLE
    assert isinstance(motion, MotionView)
    elsewhere = messages.EditRequest(change=DrawCurve("overrides", ("z", "z"), "open", TRIANGLE))
    assert [type(one) for one in ask(studio, watcher, elsewhere)] == [Changed, MotionView]


def test_the_stages_that_are_sent_are_the_engines(desk: Path) -> None:
    session = opened("english", "low.json")
    sent = ask(*talk(session), Watch(line="1", stages=STAGES))
    motion = next(one for one in sent if isinstance(one, MotionView))
    own = session.motion("1")
    assert own.engine is not None
    assert own.solved is not None
    keys = own.engine.keys(own.solved)["open"]
    limited = next(stage for stage in motion.stages if stage.name == "limited")
    curve = next(one for one in limited.curves if one.control == "open")
    assert unpacked(curve.times) == pytest.approx(keys.times, abs=1e-6)
    assert unpacked(curve.values) == pytest.approx(keys.values, abs=1e-6)
    placed = next(stage for stage in motion.stages if stage.name == "placed")
    closing = next(one for one in placed.curves if one.control == "PBM")
    line = next(one for one in sent if isinstance(one, LineView))
    named = [line.pairs[pair].pair for pair in closing.pairs]
    assert all("bmp" in pair for pair in named)
    frames = unpacked(motion.controls.values).reshape(motion.controls.count, -1)
    np.testing.assert_array_equal(frames, own.animation.values)


def test_of_a_long_line_only_what_is_seen_is_sent(desk: Path) -> None:
    session = opened("english", "low.json")
    whole, part = (
        next(one for one in ask(*talk(session), wanted) if isinstance(one, MotionView))
        for wanted in (
            Watch(line="1", stages=STAGES),
            Watch(line="1", stages=STAGES, start=1.25, end=1.26),
        )
    )
    assert part.controls.count < whole.controls.count
    shift = round((part.controls.start - whole.controls.start) * 60) * len(part.controls.names)
    cut = unpacked(part.controls.values)
    np.testing.assert_array_equal(cut, unpacked(whole.controls.values)[shift : shift + len(cut)])


def test_a_waveform_is_sent_once(desk: Path) -> None:
    studio, watcher = talk(opened("low.wav", "low.json"))
    sent = ask(studio, watcher, Watch(line="1"))
    peaks = next(one for one in sent if isinstance(one, PeaksView))
    low, high = unpacked(peaks.peaks).reshape(-1, 2).T
    assert len(high) == pytest.approx(1.4 * peaks.per_second, abs=1)
    assert high.max() == pytest.approx(0.3, abs=0.01)
    assert (low <= high).all()
    assert not any(isinstance(one, PeaksView) for one in ask(studio, watcher, Watch(line="1")))


def test_an_edit_made_from_what_the_page_sees_finds_that_very_phone(desk: Path) -> None:
    session = opened("english", "low.json")
    sent = ask(*talk(session), Watch(line="1"))
    view = next(one for one in sent if isinstance(one, LineView))
    line = session.state.lines["1"]
    phones, words = tier_of(line.phones).intervals, tier_of(line.words)
    spoken = [one for one in view.classes if one.phone >= 0]
    assert len(spoken) == 8
    for one in spoken:
        label = view.phones[one.phone].label
        edit = Edit(one.word, one.phone_in_word, "open", one.occurrence, label)
        (found,), lost = find([edit], phones, words)
        assert lost == ()
        assert found.phone == phones[one.phone]


def test_edits_are_shown_with_their_place_and_lost_ones_without(desk: Path) -> None:
    session = opened("english", "low.json")
    studio, watcher = talk(session)
    for edit in (Edit("low", 2, "open", gain=2), Edit("gone", 1, "open", gain=2)):
        ask(studio, watcher, messages.EditRequest(change=PutEdit("1", edit)))
    view = next(one for one in ask(studio, watcher, Watch(line="1")) if isinstance(one, LineView))
    assert [(one.edit.word, one.lost, one.start) for one in view.edits] == [
        ("low", False, 0.9),
        ("gone", True, 0.0),
    ]
    (hello,) = ask(studio, watcher, messages.Start())
    assert isinstance(hello, Hello)
    assert (hello.lines[0].edits, hello.lines[0].lost) == (2, 1)
    edited = {cell.pair: cell.edits for cell in hello.cells if cell.edits}
    assert edited == {("l", "ow"): 1, ("ow", "sil"): 1}


def test_why_leads_from_the_face_to_the_key_and_says_who_spoke(desk: Path) -> None:
    session = opened("english", "low.json")
    studio, watcher = talk(session)
    draw = DrawCurve("overrides", ("ow", "sil"), "W", ((0, 0), (0.5, 0.9), (1, 0)))
    ask(studio, watcher, messages.EditRequest(change=draw))
    (why,) = ask(studio, watcher, messages.Why(line="1", control="W", time=1.19))
    assert isinstance(why, WhyView)
    assert (why.word, why.phone) == ("low", "ow")
    won = why.origins[0]
    assert won.pair == ("ow", "sil")
    assert won.keys[0] in draw.keys  # type: ignore[operator]
    assert "english overrides" in won.override
    assert won.own is not None
    assert why.alone is not None


def test_every_kind_of_second_version_moves(desk: Path) -> None:
    session = opened("english", "low.json", "low.wav")
    studio, watcher = talk(session)
    draw = DrawCurve("overrides", ("l", "ow"), "W", ((0, 0), (0.9, 0.05), (1, 0)))
    ask(studio, watcher, messages.EditRequest(change=draw))
    ask(studio, watcher, messages.EditRequest(change=PutEdit("1", Edit("low", 2, "open", level=1))))
    seen = {}
    for kind, value in (
        ("now", ""), ("opened", ""), ("unedited", ""), ("set", "mandarin"),
        ("preset", "published"), ("character", "crab"), ("engine", "motion"),
    ):  # fmt: skip
        sent = ask(studio, watcher, Watch(line="1", other=Variant(kind, value)))  # type: ignore[arg-type]
        assert not any(isinstance(one, Failed) for one in sent), sent
        (other,) = (one for one in sent if isinstance(one, MotionView) and one.version == "b")
        (who,) = (one for one in sent if isinstance(one, CharacterView))
        assert who.version == "b"
        assert unpacked(other.channels.values).max() > 0.2
        seen[kind] = (other.controls.values, other.character)
    assert seen["character"][1] == "crab"
    values = [values for values, _ in seen.values()]
    assert len(set(values)) == len(values)


def test_the_net_that_comes_with_lipwright_is_a_second_version(desk: Path) -> None:
    session = opened("english", "low.json", "low.wav")
    studio, watcher = talk(session)
    sent = ask(studio, watcher, Watch(line="1", other=Variant("engine", "neural")))
    (other,) = (one for one in sent if isinstance(one, MotionView) and one.version == "b")
    assert any("is it speech?" in note for note in other.notes)  # the line's sound is a tone


@pytest.mark.parametrize(
    "other",
    [
        Variant("set", "klingon"),
        Variant("preset", "brisk"),
        Variant("character", "nobody"),
        Variant("engine", "steam"),
    ],
)
def test_a_second_version_that_is_not_there_is_refused(desk: Path, other: Variant) -> None:
    session = opened("english", "low.json")
    studio, watcher = talk(session)
    ask(studio, watcher, Watch(line="1"))
    (failed,) = ask(studio, watcher, Watch(line="1", other=other))
    assert isinstance(failed, Failed)
    assert other.value in failed.error


def test_text_is_spoken_as_a_line_and_examples_are_none(desk: Path) -> None:
    session = opened("english")
    studio, watcher = talk(session)
    answers = ask(studio, watcher, messages.Say(text="My map."))
    made = answers[0]
    assert isinstance(made, Made)
    assert session.state.lines[made.line].title == "My map."
    example, *_ = ask(studio, watcher, messages.Example(pair=("bmp", "ah")))
    assert isinstance(example, ExampleView)
    assert example.end > example.start
    sent = ask(studio, watcher, Watch(line=example.line))
    view = next(one for one in sent if isinstance(one, LineView))
    assert any(pair.pair == ("bmp", "ah") and pair.first == example.start for pair in view.pairs)
    assert session.history.undo_steps == 1


@pytest.mark.parametrize(("way", "count"), [("words", 1), ("labels", 8)])
def test_a_sound_that_was_sent_becomes_a_line(desk: Path, way: str, count: int) -> None:
    from lipwright import say

    session = opened("english")
    studio, watcher = talk(session)
    if way == "words":
        key = session.sounds.add(say("map").sound).key  # type: ignore[arg-type]
        hear = messages.Hear(sound=key, text="map", title="map.wav")
    else:
        key = session.sounds.add(sound()).key
        labels = (desk / "low.json").read_text("utf-8")
        hear = messages.Hear(sound=key, labels=labels, labels_name="low.json")
    made = ask(studio, watcher, hear)[0]
    assert isinstance(made, Made)
    line = session.state.lines[made.line]
    assert line.sound is not None
    assert line.sound.key == key
    spoken = line.words if way == "words" else [row for row in line.phones if row[0] != "sil"]
    assert len(spoken) == count


def test_a_line_that_is_made_anew_keeps_its_edits_and_its_name(desk: Path) -> None:
    session = opened("english", "low.json")
    studio, watcher = talk(session)
    for edit in (Edit("low", 2, "open", level=0.9), Edit("map", 2, "open", level=0.9)):
        ask(studio, watcher, messages.EditRequest(change=PutEdit("1", edit)))
    made = ask(studio, watcher, messages.Say(text="So low.", line="1"))[0]
    assert isinstance(made, Made)
    assert made.line == "1"
    line = session.state.lines["1"]
    assert (line.text, len(line.edits)) == ("So low.", 2)
    assert session.lost(line) == 1
    low = next(row for row in line.phones if row[0] == "oʊ" and row[1] > line.words[1][1])
    assert session.motion("1").animation.at([0.5 * (low[1] + low[2])])[0, 0] > 0.6
    session.undo(1)
    assert session.lost(session.state.lines["1"]) == 0
    (failed,) = ask(studio, watcher, messages.Say(text="So low.", line="9"))
    assert isinstance(failed, Failed)


def test_labels_that_are_broken_are_refused_by_their_own_name(desk: Path) -> None:
    session = opened("english")
    key = session.sounds.add(sound()).key
    hear = messages.Hear(sound=key, labels="no labels at all", labels_name="x.TextGrid")
    studio, watcher = talk(session)
    reply = studio.ask(watcher, hear)
    assert reply.job is not None
    with pytest.raises(ValueError, match=r"^x\.TextGrid"):
        reply.job.work(lambda share: None)


def test_coverage_names_what_is_missing_worst_first_and_what_is_edited_most(desk: Path) -> None:
    session = opened("mine.json", "low.json")
    studio, watcher = talk(session)
    ask(studio, watcher, messages.EditRequest(change=ClearPair("set", ("l", "ow"))))
    ask(studio, watcher, messages.EditRequest(change=PutEdit("1", Edit("low", 2, "open", gain=2))))
    view = ask(studio, watcher, messages.CoverageRequest())[0]
    assert isinstance(view, CoverageView)
    assert [need.pair for need in view.missing] == [("l", "ow")]
    assert view.missing[0].covered == 1
    assert {one.pair for one in view.edited} == {("l", "ow"), ("ow", "sil")}
    needs = {cell.pair: cell.need for cell in view.cells}
    assert needs["l", "ow"] == pytest.approx(1 / 9, abs=1e-5)
    spoken = ask(studio, watcher, messages.CoverageRequest(text="Low.\nMap."))[0]
    assert isinstance(spoken, CoverageView)
    assert spoken.lines == 2
    every = ask(studio, watcher, messages.CoverageRequest(every=True))[0]
    assert isinstance(every, CoverageView)
    assert every.share == pytest.approx(482 / 483)


def test_another_character_speaks_and_poses_can_be_tried(desk: Path) -> None:
    session = opened("english", "low.json")
    studio, watcher = talk(session)
    (pose,) = ask(studio, watcher, messages.TryPose(weights={"open": 0.5, "PBM": 0.2}))
    assert isinstance(pose, PoseView)
    assert pose.channels["PBM"] == pytest.approx(0.2)
    ask(studio, watcher, Watch(line="1"))
    view, changed, motion = ask(studio, watcher, messages.ChooseCharacter(name="crab"))
    assert isinstance(view, CharacterView)
    assert view.name == "crab"
    assert isinstance(changed, Changed)
    assert isinstance(motion, MotionView)
    assert motion.character == "crab"


@pytest.mark.parametrize(
    ("request_", "words"),
    [
        (Watch(pair=("f", "xx")), "'xx' is not a phone"),
        (Watch(line="7"), "no line '7'"),
        (messages.Why(line="1", control="opn", time=0), "no control 'opn'"),
        (messages.Hear(sound="nothing"), "no sound 'nothing'"),
        (messages.Hear(sound="../../x"), "no sound"),
        (messages.ChooseCharacter(name="nobody"), "no character 'nobody'"),
        (messages.Draft(take=True), "no draft is left"),
        (messages.Preview(document="edits", line="7"), "no line '7'"),
        (messages.Reread(document="overrides"), "no such file"),
    ],
)
def test_what_cannot_be_done_is_said_in_one_line(
    desk: Path, request_: messages.Request, words: str
) -> None:
    session = opened("english", "low.json")
    studio, watcher = talk(session)
    (failed,) = ask(studio, watcher, request_)
    assert isinstance(failed, Failed)
    assert words in failed.error
    assert "\n" not in failed.error
