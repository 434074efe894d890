"""What the page and the server say to each other, over one WebSocket, in JSON.

Requests carry an ``id``; the answer carries the same. What nobody asked for has ``id`` 0:
other pages' changes, and what a page watches, after each change. ``Packed`` is base64 of
little-endian float32. Sounds and models go over HTTP. The page's types are made from this
module: :mod:`lipwright.studio.typescript`.
"""

from __future__ import annotations

from lipwright.studio.answers import (
    BigramView,
    Changed,
    CharacterView,
    CoverageView,
    ExampleView,
    Failed,
    Hello,
    LinePart,
    LineView,
    Made,
    MotionView,
    PeaksView,
    PhoneView,
    PoseView,
    PreviewView,
    Progress,
    Saved,
    Watched,
    WhyView,
)
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
    Part,
    PoseInfo,
    ReasonView,
    Rule,
    Span,
    SpanSplice,
    Stage,
    StageCurve,
    StageName,
    Variant,
    VariantKind,
)
from lipwright.studio.requests import (
    ChooseCharacter,
    CoverageRequest,
    Draft,
    EditRequest,
    Example,
    Hear,
    Preview,
    Redo,
    Reread,
    Save,
    Say,
    Start,
    TryPose,
    Undo,
    Watch,
    Why,
)

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
    | LinePart
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

__all__ = [
    "Answer",
    "BigramView",
    "Cell",
    "Changed",
    "CharacterView",
    "ChooseCharacter",
    "ClassInfo",
    "ClassSpan",
    "ClassSplice",
    "CoverageRequest",
    "CoverageView",
    "Curves",
    "Document",
    "Draft",
    "DraftInfo",
    "EditRequest",
    "EditView",
    "EditedPair",
    "Example",
    "ExampleView",
    "Failed",
    "FileInfo",
    "Frames",
    "Hear",
    "Hello",
    "History",
    "Joint",
    "LineName",
    "LinePart",
    "LineView",
    "Made",
    "Message",
    "MotionView",
    "NeedView",
    "OriginView",
    "Packed",
    "PairSpan",
    "PairSplice",
    "PairState",
    "Part",
    "PeaksView",
    "PhoneView",
    "PoseInfo",
    "PoseView",
    "Preview",
    "PreviewView",
    "Progress",
    "ReasonView",
    "Redo",
    "Request",
    "Reread",
    "Rule",
    "Save",
    "Saved",
    "Say",
    "Span",
    "SpanSplice",
    "Stage",
    "StageCurve",
    "StageName",
    "Start",
    "TryPose",
    "Undo",
    "Variant",
    "VariantKind",
    "Watch",
    "Watched",
    "Why",
    "WhyView",
]
