"""What the studio says to its pages."""

from __future__ import annotations

from typing import Literal

from lipwright.studio.changes import PairName, Target
from lipwright.studio.message_parts import (
    Cell,
    ClassInfo,
    ClassSpan,
    ClassSplice,
    Curves,
    Document,
    DraftInfo,
    EditedPair,
    EditView,
    FileInfo,
    Frames,
    History,
    Joint,
    LineName,
    Message,
    NeedView,
    OriginView,
    Packed,
    PairSpan,
    PairSplice,
    PairState,
    PoseInfo,
    ReasonView,
    Rule,
    Span,
    SpanSplice,
    Stage,
)


class Hello(Message, frozen=True, tag="hello", kw_only=True):
    """All that is open."""

    version: str
    session: str
    revision: int
    set_name: str
    set_about: str
    preset: str
    presets: tuple[str, ...]
    target: Target
    spline: str
    classes: tuple[ClassInfo, ...]
    poses: tuple[PoseInfo, ...]
    rules: tuple[Rule, ...]
    cells: tuple[Cell, ...]
    lines: tuple[LineName, ...]
    files: tuple[FileInfo, ...]
    history: History
    character: CharacterView
    characters: tuple[str, ...]
    sets: tuple[str, ...]
    voices: tuple[str, ...]
    engines: tuple[str, ...]
    draft: DraftInfo | None = None


class Changed(Message, frozen=True, tag="changed", kw_only=True):
    """What became different: ``cells`` only those; the others whole, or None if the same."""

    revision: int
    history: History
    cells: tuple[Cell, ...] = ()
    rules: tuple[Rule, ...] | None = None
    poses: tuple[PoseInfo, ...] | None = None
    lines: tuple[LineName, ...] | None = None
    files: tuple[FileInfo, ...] | None = None


class BigramView(Message, frozen=True, tag="bigram", kw_only=True):
    """A pair as it is drawn.

    ``curves`` are what is animated, gains and all. Drawing begins with ``override_curves``, else
    ``under`` (what overrides lie on), in the overrides; with ``set_curves``, else ``stand_in``, in
    the set. ``starts`` has a useful beginning for each pose.
    """

    revision: int
    pair: PairName
    state: PairState
    source: str
    boundary: float
    word: str
    curves: Curves
    set_curves: Curves | None
    override_curves: Curves | None
    under: Curves
    stand_in: Curves
    starts: Curves


class PhoneView(Message, frozen=True, tag="phone", kw_only=True):
    """The single-phone curve of a class."""

    revision: int
    phone: str
    word: str
    curves: Curves
    overridden: bool


class LineView(Message, frozen=True, tag="line", kw_only=True):
    """A line, without its motion; ``sound`` is the address of its WAV, nothing where silent."""

    revision: int
    line: str
    title: str
    text: str
    source: str
    duration: float
    start: float
    end: float
    words: tuple[Span, ...]
    phones: tuple[Span, ...]
    classes: tuple[ClassSpan, ...]
    pairs: tuple[PairSpan, ...]
    edits: tuple[EditView, ...]
    notes: tuple[str, ...]
    sound: str


class LinePart(Message, frozen=True, tag="line part", kw_only=True):
    """What became different in a line whose rest was sent before: so that a drag stays light.

    In each list, from place ``at`` on, ``gone`` items give way to ``new`` ones.
    """

    revision: int
    line: str
    duration: float
    start: float
    end: float
    words: SpanSplice
    phones: SpanSplice
    classes: ClassSplice
    pairs: PairSplice
    edits: tuple[EditView, ...]


class PeaksView(Message, frozen=True, tag="peaks", kw_only=True):
    """A line's waveform: least and greatest sample by turns; sent once to each page."""

    line: str
    sound: str
    peaks: Packed
    per_second: float


class MotionView(Message, frozen=True, tag="motion", kw_only=True):
    """How a line moves: the curves of its controls, and the channels of the character's rig."""

    revision: int
    line: str
    version: Literal["a", "b"]
    controls: Frames
    channels: Frames
    stages: tuple[Stage, ...]
    character: str
    notes: tuple[str, ...] = ()
    milliseconds: float = 0.0


class CharacterView(Message, frozen=True, tag="character", kw_only=True):
    """Who speaks: ``model`` is the GLB's address; ``version`` ``"b"`` for the second one."""

    version: Literal["a", "b"]
    name: str
    title: str
    model: str
    backwards: bool
    joints: tuple[Joint, ...]
    known: tuple[str, ...]
    notes: tuple[str, ...] = ()


class PoseView(Message, frozen=True, tag="pose", kw_only=True):
    """The rig's channels for poses that were tried."""

    channels: dict[str, float]


class Made(Message, frozen=True, tag="made", kw_only=True):
    """A line that was made."""

    line: str


class Progress(Message, frozen=True, tag="progress", kw_only=True):
    """How far long work is, 0..1."""

    share: float
    what: str


class ExampleView(Message, frozen=True, tag="example", kw_only=True):
    """An example: ``line`` can be watched as others can; loop ``start`` to ``end``."""

    pair: PairName
    word: str
    line: str
    start: float
    end: float


class WhyView(Message, frozen=True, tag="why", kw_only=True):
    """Why a control has its value."""

    line: str
    control: str
    time: float
    phone: str
    word: str
    value: float
    origins: tuple[OriginView, ...]
    reasons: tuple[ReasonView, ...]
    edits: tuple[str, ...]
    alone: float | None
    text: str


class CoverageView(Message, frozen=True, tag="coverage", kw_only=True):
    """Which pairs are needed, most first; ``missing`` those to draw, worst first."""

    source: str
    share: float
    lines: int
    needed: tuple[NeedView, ...]
    missing: tuple[NeedView, ...]
    edited: tuple[EditedPair, ...]
    notes: tuple[str, ...]
    cells: tuple[Cell, ...]


class PreviewView(Message, frozen=True, tag="preview", kw_only=True):
    """What saving would do to a file, as unified diffs.

    ``diff`` is from what is on disk to what would be written. ``theirs`` is what changed on
    disk since it was opened, nothing where nothing did; ``both`` are the pairs, poses or
    settings that they and we changed. ``refused`` is why it cannot be written.
    """

    document: Document
    line: str
    path: str
    is_new: bool
    diff: str
    theirs: str
    both: tuple[str, ...]
    refused: str
    digest: str


class Saved(Message, frozen=True, tag="saved", kw_only=True):
    """A file was written."""

    document: Document
    line: str
    path: str
    files: tuple[FileInfo, ...]


class Watched(Message, frozen=True, tag="watched", kw_only=True):
    """All that a page watches has been sent."""

    revision: int


class Failed(Message, frozen=True, tag="failed", kw_only=True):
    """What was asked could not be done, in one line; nothing has changed."""

    error: str
