"""Lipwright turns speech, typed or recorded, into editable facial animation.

>>> import lipwright
>>> speech = lipwright.say("Hello there.")
>>> performance = lipwright.animate(speech)
>>> performance.animation.controls[:3]
('open', 'W', 'wide')

``lipwright.save(performance, "hello.html")`` writes a page with a speaking head.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from lipwright.acting import bind_markers
    from lipwright.animation import Animation
    from lipwright.character import load_character
    from lipwright.engines.bigram import BigramEngine, BigramSet, load_set
    from lipwright.engines.neural import Stream
    from lipwright.errors import InputError, LipwrightError, MissingExtraError, OutputError
    from lipwright.hearing import sound_alone
    from lipwright.motion_takes import build_motion
    from lipwright.neural_takes import train_model
    from lipwright.performance import Performance
    from lipwright.phones import PhoneTrack
    from lipwright.pipeline import align, animate, from_labels, hear, recognise, save, say
    from lipwright.sound import Sound
    from lipwright.sound_files import read_sound
    from lipwright.speech import Speech
    from lipwright.timeline import Interval, Tier

__version__ = "0.1.0"

# Where each public name lives: it is imported when first asked for, so that
# "import lipwright" costs next to nothing.
_HOMES = {
    "Animation": "animation",
    "BigramEngine": "engines.bigram",
    "BigramSet": "engines.bigram",
    "InputError": "errors",
    "Interval": "timeline",
    "LipwrightError": "errors",
    "MissingExtraError": "errors",
    "OutputError": "errors",
    "Performance": "performance",
    "PhoneTrack": "phones",
    "Sound": "sound",
    "Speech": "speech",
    "Stream": "engines.neural",
    "Tier": "timeline",
    "align": "pipeline",
    "animate": "pipeline",
    "bind_markers": "acting",
    "build_motion": "motion_takes",
    "from_labels": "pipeline",
    "hear": "pipeline",
    "load_character": "character",
    "load_set": "engines.bigram",
    "read_sound": "sound_files",
    "recognise": "pipeline",
    "save": "pipeline",
    "say": "pipeline",
    "sound_alone": "hearing",
    "train_model": "neural_takes",
}

__all__ = [
    "Animation",
    "BigramEngine",
    "BigramSet",
    "InputError",
    "Interval",
    "LipwrightError",
    "MissingExtraError",
    "OutputError",
    "Performance",
    "PhoneTrack",
    "Sound",
    "Speech",
    "Stream",
    "Tier",
    "align",
    "animate",
    "bind_markers",
    "build_motion",
    "from_labels",
    "hear",
    "load_character",
    "load_set",
    "read_sound",
    "recognise",
    "save",
    "say",
    "sound_alone",
    "train_model",
]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'lipwright' has no attribute {name!r}")
    return getattr(import_module(f"lipwright.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
