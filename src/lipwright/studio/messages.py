"""What the page and the server say to each other, over one WebSocket, in JSON.

Requests carry an ``id``; the answer carries the same. What nobody asked for has ``id`` 0:
other pages' changes, and what a page watches, after each change. ``Packed`` is base64 of
little-endian float32. Sounds and models go over HTTP. The page's types are made from this
module: :mod:`lipwright.studio.typescript`.
"""

from __future__ import annotations

from typing import Annotated, Literal

import msgspec

from lipwright.engines.bigram.edits import Edit
from lipwright.studio.changes import AnyChange, Keys, PairName, Target, Value

Packed = Annotated[str, msgspec.Meta(description="base64 of little-endian float32")]
Curves = dict[str, Keys]
PairState = Literal["drawn", "stand-in", "no curve"]
Document = Literal["set", "overrides", "edits", "labels"]
VariantKind = Literal["now", "opened", "set", "preset", "character", "engine", "unedited"]
StageName = Literal["placed", "stitched", "smoothed", "constrained", "limited"]


class Message(msgspec.Struct, frozen=True, tag_field="type", rename="camel"):
    """Any message; ``id`` ties an answer to its request."""

    id: int = 0


class Part(msgspec.Struct, frozen=True, rename="camel"):
    """A part of a message."""


# --- what the page asks ---


class Start(Message, frozen=True, tag="start"):
    """The first word of a page; answered by :class:`Hello`.

    ``session`` is that of the last Hello, where there was one: a studio that was started again
    then goes on where it ended, without asking.
    """

    session: str = ""


class EditRequest(Message, frozen=True, tag="edit", kw_only=True):
    """Change something; answered by :class:`Changed`, to every page.

    ``merge`` is one name for one drag: neighbours of the same name are one step of undo.
    """

    change: AnyChange
    merge: str = ""


class Undo(Message, frozen=True, tag="undo"):
    """Take back steps; answered by :class:`Changed`."""

    steps: int = 1


class Redo(Message, frozen=True, tag="redo"):
    """Do steps again; answered by :class:`Changed`."""

    steps: int = 1


class Draft(Message, frozen=True, tag="draft", kw_only=True):
    """Take the draft that :class:`Hello` offers, or throw it away; answered by Hello."""

    take: bool


class Variant(Part, frozen=True):
    """One of two versions that are held side by side.

    ``now`` is what is open; ``opened`` is before all changes; ``unedited`` is without the
    line's edits; the others take ``value``: a set, a preset, a character, an engine.
    """

    kind: VariantKind = "now"
    value: str = ""


class Watch(Message, frozen=True, tag="watch", kw_only=True):
    """Say what the page shows: all of it is sent now, and again when it changes.

    Parameters
    ----------
    pair : tuple of two str, optional
        Sent as :class:`BigramView`.
    phone : str
        Sent as :class:`PhoneView`; nothing for none.
    line : str
        Sent as :class:`LineView` and :class:`MotionView`; nothing for none.
    start, end : float
        Seconds of the line that are seen: of a long line no more is sent than these and as
        much again on both sides. The same at 0 is all of it.
    stages : tuple of str
        Which stages' curves are sent.
    other : Variant, optional
        A second version, sent as a MotionView of its own, ``version`` ``"b"``.
    """

    pair: PairName | None = None
    phone: str = ""
    line: str = ""
    start: float = 0.0
    end: float = 0.0
    stages: tuple[StageName, ...] = ()
    other: Variant | None = None


class Say(Message, frozen=True, tag="say", kw_only=True):
    """Speak a text as a new line; answered by :class:`Made`."""

    text: str
    voice: str = "en-us"
    speed: float = 175.0


class Hear(Message, frozen=True, tag="hear", kw_only=True):
    """Make a line of a sound that was sent; answered by :class:`Made`.

    With ``text`` its words are put in time; with ``labels`` (a file's content and name) times
    are taken as they are; with neither words are recognised, or phones heard ``by_ear``.
    """

    sound: str
    title: str = ""
    text: str = ""
    labels: str = ""
    labels_name: str = ""
    language: str = "en-us"
    by_ear: bool = False


class Example(Message, frozen=True, tag="example", kw_only=True):
    """Speak a pair's example word; answered by :class:`ExampleView`. It is no step of undo."""

    pair: PairName


class Why(Message, frozen=True, tag="why", kw_only=True):
    """Ask why a control of a line has its value at an instant; answered by WhyView."""

    line: str
    control: str
    time: float


class CoverageRequest(Message, frozen=True, tag="coverage", kw_only=True):
    """Ask which pairs are needed; answered by :class:`CoverageView`, and colours the matrix.

    Of all lines that are open; or of a ``text``; or of ``every`` pair once.
    """

    text: str = ""
    every: bool = False


class ChooseCharacter(Message, frozen=True, tag="character", kw_only=True):
    """Choose who speaks: a built-in name, or the key of a model that was sent.

    Answered by :class:`CharacterView`, to every page.
    """

    name: str


class TryPose(Message, frozen=True, tag="pose", kw_only=True):
    """Ask how the face holds some poses; answered by :class:`PoseView`."""

    weights: dict[str, float]


class Preview(Message, frozen=True, tag="preview", kw_only=True):
    """Ask what saving would change; answered by :class:`PreviewView`.

    ``line`` for edits and labels. ``name`` for a new file: a plain file name, which comes to
    lie in the folder where the studio was started.
    """

    document: Document
    line: str = ""
    name: str = ""


class Save(Message, frozen=True, tag="save", kw_only=True):
    """Write what was previewed; answered by :class:`Saved`, to every page.

    ``digest`` is the preview's: where the file is another by now, nothing is written, and the
    answer is a new :class:`PreviewView`.
    """

    document: Document
    digest: str
    line: str = ""
    name: str = ""


class Reread(Message, frozen=True, tag="reread", kw_only=True):
    """Take a file as it is on disk now, and lay our changes over it; answered by Hello.

    With ``keep`` false our changes of that document are dropped (as a step of undo).
    """

    document: Document
    line: str = ""
    keep: bool = True


# --- what the server says ---


class Span(Part, frozen=True):
    """A label in time, seconds."""

    label: str
    start: float
    end: float


class PoseInfo(Part, frozen=True):
    """A pose of the set, as its stages know it."""

    name: str
    priority: int
    meets: Literal["cut", "widen"]
    limit: float
    window: float
    softness: float


class Rule(Part, frozen=True):
    """A live control: what :class:`~lipwright.studio.changes.SetRule` changes."""

    kind: Literal["pose", "threshold", "setting", "gain"]
    names: tuple[str, ...]
    field: str
    value: Value
    default: Value
    opened: Value
    about: str
    unit: str = ""
    least: float = 0.0
    most: float = 0.0
    choices: tuple[str, ...] = ()


class ClassInfo(Part, frozen=True):
    """A class of phones, with a word in which it sounds."""

    label: str
    word: str


class Cell(Part, frozen=True):
    """A pair in the matrix.

    ``need`` is its share, 0..1, of the pairs that are needed; ``edits`` how many edits of lines
    lie in it; ``changed`` whether it is another than when it was opened.
    """

    pair: PairName
    state: PairState
    overridden: bool
    changed: bool
    need: float = 0.0
    edits: int = 0
    word: str = ""


class LineName(Part, frozen=True):
    """A line in the list."""

    id: str
    title: str
    duration: float
    edits: int
    lost: int


class FileInfo(Part, frozen=True):
    """A document that can be saved; no ``path`` where it is still to be named."""

    document: Document
    line: str
    path: str
    suggested: str
    dirty: bool
    about: str = ""


class DraftInfo(Part, frozen=True):
    """What a studio that ended early left behind."""

    steps: int
    saved_at: str
    summary: str


class History(Part, frozen=True):
    """What can be taken back and done again, in words; nothing where there is nothing."""

    undo: str
    redo: str
    undo_steps: int
    redo_steps: int


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


class PairSpan(Part, frozen=True):
    """A pair of a line: ``phone`` is the number of its first phone among the classes."""

    pair: PairName
    first: float
    boundary: float
    last: float


class ClassSpan(Part, frozen=True):
    """A class in time; ``phone`` is which of the line's phones it is, -1 for a silence."""

    label: str
    start: float
    end: float
    phone: int
    word: str
    word_number: int
    phone_in_word: int
    occurrence: int


class EditView(Part, frozen=True):
    """An edit of a line, and where it acts; a lost one has no place."""

    edit: Edit
    name: str
    lost: bool
    start: float
    end: float


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


class PeaksView(Message, frozen=True, tag="peaks", kw_only=True):
    """A line's waveform: least and greatest sample by turns; sent once to each page."""

    line: str
    sound: str
    peaks: Packed
    per_second: float


class StageCurve(Part, frozen=True):
    """Keys of one control after one stage, seconds and weights.

    ``breaks`` says where pieces begin: of ``placed`` each piece is the curve of one pair,
    ``pairs`` its number in the line; of the others there is one piece.
    """

    control: str
    times: Packed
    values: Packed
    breaks: tuple[int, ...]
    pairs: tuple[int, ...]


class Stage(Part, frozen=True):
    """One stage's curves."""

    name: StageName
    curves: tuple[StageCurve, ...]


class Frames(Part, frozen=True):
    """Values over time: frame ``k`` is at ``start + k / rate``; names vary fastest."""

    names: tuple[str, ...]
    rate: float
    start: float
    count: int
    values: Packed


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


class Joint(Part, frozen=True):
    """A channel that turns a joint: its node, axis, and degrees at 1."""

    channel: str
    node: int
    axis: tuple[float, float, float]
    degrees: float


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


class OriginView(Part, frozen=True):
    """A pair with a curve at the instant, the one that won first; ``keys`` in its 0..1."""

    pair: PairName
    source: str
    start: float
    end: float
    value: float
    keys: Keys
    override: str
    own: float | None


class ReasonView(Part, frozen=True):
    """What one stage did."""

    stage: str
    before: float
    after: float
    text: str


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


class NeedView(Part, frozen=True):
    """A pair that is needed; ``covered`` is the share that is drawn once this one is."""

    pair: PairName
    amount: float
    share: float
    state: PairState
    word: str
    covered: float


class EditedPair(Part, frozen=True):
    """A pair that lines' edits correct again and again."""

    pair: PairName
    edits: int
    lines: int


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


Request = (
    Start
    | EditRequest
    | Undo
    | Redo
    | Draft
    | Watch
    | Say
    | Hear
    | Example
    | Why
    | CoverageRequest
    | ChooseCharacter
    | TryPose
    | Preview
    | Save
    | Reread
)
Answer = (
    Hello
    | Changed
    | BigramView
    | PhoneView
    | LineView
    | PeaksView
    | MotionView
    | CharacterView
    | PoseView
    | Made
    | Progress
    | ExampleView
    | WhyView
    | CoverageView
    | PreviewView
    | Saved
    | Watched
    | Failed
)
