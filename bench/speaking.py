"""``say``: from typed text to speech, and to files, as a user waits for it."""

import tempfile
from pathlib import Path

from bench.measure import command, lipwright, milliseconds, peak_mb, say
from lipwright import pipeline

LINE = "Peter Piper picked a peck of pickled peppers."
LONG = " ".join([LINE] * 100)

if __name__ == "__main__":
    say("say: speech from a sentence", **milliseconds(lambda: pipeline.say(LINE), runs=15))
    say(
        "say: speech from 100 sentences", **milliseconds(lambda: pipeline.say(LONG), runs=3, warm=0)
    )
    with tempfile.TemporaryDirectory() as folder:
        base = str(Path(folder) / "line")
        for suffixes in ((".json",), (".json", ".csv", ".glb", ".html")):
            outputs = [part for suffix in suffixes for part in ("-o", base + suffix)]
            name = f"lipwright say -o {' '.join(suffixes)}"
            say(name, **command(lipwright("say", LINE, *outputs)))
        code = f"import sys; sys.argv = ['', 'say', {LINE!r}, '-o', {base + '.json'!r}]"
        code += "; from lipwright.cli import main; main(sys.argv[1:])"
        say("memory of lipwright say", peak_mb=peak_mb(code))
