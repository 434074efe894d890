"""Held mouth shapes as files: golden content, and readers that find the frames again."""

import json
import math
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import pytest

from lipwright import export
from lipwright.errors import InputError
from lipwright.evaluate import read_rhubarb
from lipwright.export.cue_times import seconds
from lipwright.performance import Cues, Performance, Picture
from tests.export.performances import performance


def held(shapes: str = "XADX", fps: float = 24.0, sound_file: str = "a & b.wav") -> Performance:
    """Return shapes of three frames each."""
    frames = tuple(range(0, 3 * len(shapes), 3))
    pictures = {label: Picture("image/png", b"") for label in sorted(set(shapes))}
    cues = Cues("duck", tuple(shapes), frames, 3 * len(shapes), fps, "X", lambda: pictures)
    return replace(performance(), cues=lambda: cues, flat=True, sound_file=sound_file)


TSV = "0.00\tX\n0.13\tA\n0.25\tD\n0.38\tX\n0.50\tX\n"
DAT = "MohoSwitch1\n1 X\n4 A\n7 D\n10 X\n13 X\n"
XML = """\
<?xml version="1.0" encoding="utf-8"?>
<rhubarbResult>
  <metadata>
    <soundFile>a &amp; b.wav</soundFile>
    <duration>0.50</duration>
  </metadata>
  <mouthCues>
    <mouthCue start="0.00" end="0.13">X</mouthCue>
    <mouthCue start="0.13" end="0.25">A</mouthCue>
    <mouthCue start="0.25" end="0.38">D</mouthCue>
    <mouthCue start="0.38" end="0.50">X</mouthCue>
  </mouthCues>
</rhubarbResult>
"""
JSON = """\
{
  "metadata": {
    "soundFile": "a & b.wav",
    "duration": 0.50
  },
  "mouthCues": [
    { "start": 0.00, "end": 0.13, "value": "X" },
    { "start": 0.13, "end": 0.25, "value": "A" },
    { "start": 0.25, "end": 0.38, "value": "D" },
    { "start": 0.38, "end": 0.50, "value": "X" }
  ]
}
"""
GOLDEN = {".tsv": TSV, ".dat": DAT, ".xml": XML, ".rhubarb.json": JSON}


@pytest.mark.parametrize("suffix", GOLDEN)
def test_the_files_are_as_their_readers_know_them(suffix: str) -> None:
    assert export.encode(held(), suffix).decode() == GOLDEN[suffix]


def test_a_double_suffix_goes_before_a_single_one(tmp_path: Path) -> None:
    names = ("Line.Rhubarb.JSON", "line.json", "rhubarb.json", "line.wav")
    export.save(replace(held(), sound_file=""), *(tmp_path / name for name in names))
    rhubarb = json.loads((tmp_path / names[0]).read_bytes())
    assert rhubarb["metadata"]["soundFile"] == "line.wav"
    for lossless in names[1:3]:
        assert json.loads((tmp_path / lossless).read_bytes())["format"] == "lipwright/animation"
    assert export.sound_beside("b/line.rhubarb.json") == Path("b/line.wav")
    assert export.sound_beside("b/line.tsv") == Path("b/line.wav")


def test_what_is_measured_reads_our_table(tmp_path: Path) -> None:
    export.save(held("XABCDEFGHX"), tmp_path / "line.tsv")
    line = read_rhubarb(tmp_path / "line.tsv")
    assert line.duration == pytest.approx(1.26)
    closed = line.at([0.2])[0][line.controls.index("PBM")]
    assert closed == 1


@pytest.mark.parametrize("fps", [8.0, 12.0, 23.976, 24.0, 25.0, 29.97, 30.0, 48.0, 50.0, 60.0])
def test_readers_find_the_frame_whether_they_cut_or_round(fps: float) -> None:
    for frame in range(5000):
        time = float(seconds(frame, fps))
        assert math.floor(time * fps + 1e-6) == frame
        assert round(time * fps) == frame


def test_names_that_xml_and_json_must_quote() -> None:
    odd = held(sound_file='<"ä"\x01>.wav')
    tree = ElementTree.fromstring(export.encode(odd, ".xml"))
    assert tree.findtext("metadata/soundFile") == '<"ä"\N{REPLACEMENT CHARACTER}>.wav'
    read = json.loads(export.encode(odd, ".rhubarb.json"))
    assert read["metadata"]["soundFile"] == '<"ä"\x01>.wav'


def test_a_performance_without_shapes_says_so() -> None:
    with pytest.raises(InputError, match="no mouth shapes to hold"):
        export.encode(performance(), ".tsv")
