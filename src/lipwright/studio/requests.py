"""What the page asks of the studio."""

from __future__ import annotations

from lipwright.studio.changes import AnyChange, PairName
from lipwright.studio.message_parts import Document, Message, StageName, Variant


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
    """Speak a text as a new line, or a ``line`` anew; answered by :class:`Made`."""

    text: str
    voice: str = "en-us"
    speed: float = 175.0
    line: str = ""


class Hear(Message, frozen=True, tag="hear", kw_only=True):
    """Make a line of a sound that was sent; answered by :class:`Made`.

    With ``text`` its words are put in time; with ``labels`` (a file's content and name) times
    are taken as they are; with neither words are recognised, or phones heard ``by_ear``. With
    ``line`` it takes the place of that line, whose edits stay: those that find their phone act.
    """

    sound: str
    title: str = ""
    text: str = ""
    labels: str = ""
    labels_name: str = ""
    language: str = "en-us"
    by_ear: bool = False
    line: str = ""


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
