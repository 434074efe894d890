"""The parts that messages of the studio are put together from."""

from __future__ import annotations

from typing import Annotated, Literal

import msgspec

from lipwright.engines.bigram.edits import Edit
from lipwright.studio.changes import Keys, PairName, Value

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


class Variant(Part, frozen=True):
    """One of two versions that are held side by side.

    ``now`` is what is open; ``opened`` is before all changes; ``unedited`` is without the
    line's edits; the others take ``value``: a set, a preset, a character, an engine.
    """

    kind: VariantKind = "now"
    value: str = ""


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


class SpanSplice(Part, frozen=True):
    """In a list of spans, from place ``at`` on, ``gone`` of them give way to ``new`` ones."""

    at: int
    gone: int
    new: tuple[Span, ...]


class PairSplice(Part, frozen=True):
    """The same of pairs."""

    at: int
    gone: int
    new: tuple[PairSpan, ...]


class ClassSplice(Part, frozen=True):
    """The same of classes."""

    at: int
    gone: int
    new: tuple[ClassSpan, ...]


class EditView(Part, frozen=True):
    """An edit of a line, and where it acts; a lost one has no place."""

    edit: Edit
    name: str
    lost: bool
    start: float
    end: float


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


class Joint(Part, frozen=True):
    """A channel that turns a joint: its node, axis, and degrees at 1."""

    channel: str
    node: int
    axis: tuple[float, float, float]
    degrees: float


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
