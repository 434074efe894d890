"""Flite speaks (Debian: ``flite``): voices made from the recordings of four people."""

from __future__ import annotations

import subprocess
import tempfile
import wave
from pathlib import Path

import numpy as np

from lipwright.errors import LabelError, MissingExtraError
from lipwright.phones import PhoneTrack, load_phone_set
from lipwright.sound import Sound
from lipwright.speech import Speech
from lipwright.timeline import Interval, Tier

_USUAL_PITCH = {"awb": 110.0, "kal16": 105.0, "rms": 105.0, "slt": 170.0}


def speak(text: str, voice: str, rate: float, pitch: float) -> Speech:
    """Return a line with its phones, in ARPAbet.

    Parameters
    ----------
    text : str
    voice : str
        ``"awb"``, ``"kal16"``, ``"rms"`` or ``"slt"``.
    rate, pitch : float
        As in :class:`~tools.neural_model.lines.Line`.

    Raises
    ------
    MissingExtraError
        If flite is not installed.
    """
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "a.wav"
        hertz = _USUAL_PITCH[voice] * (0.75 + pitch / 200)
        given = ["--setf", f"duration_stretch={175 / rate:.3f}"]
        given += ["--setf", f"int_f0_target_mean={hertz:.0f}"]
        command = ["flite", "-voice", voice, *given, "-psdur", "-o", str(path), "-t", text]
        try:
            said = subprocess.run(command, capture_output=True, check=True, text=True).stdout
        except FileNotFoundError:
            raise MissingExtraError("flite is missing", cure="apt-get install flite") from None
        with wave.open(str(path), "rb") as file:
            samples = np.frombuffer(file.readframes(file.getnframes()), "<i2")
            samples_per_second = file.getframerate()
    phones, start = [], 0.0
    for word in said.split():
        label, end = word.rsplit(":", 1)
        if float(end) > start:
            phones.append(Interval(_arpabet(label), start, float(end)))
            start = float(end)
    track = PhoneTrack(Tier(tuple(phones)), "arpabet")
    sound = Sound(samples.astype(np.float32) / np.float32(32768), samples_per_second)
    return Speech(track, sound=sound, source="flite")


def _arpabet(label: str) -> str:
    try:
        return load_phone_set("arpabet").normalise(label)
    except LabelError:
        return "sil"
