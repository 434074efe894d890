"""A program of its own: decodes m4a, mp4 and other media from standard input with PyAV.

PyAV bundles GPL codecs, so it never enters Lipwright's process. Written to standard
output: one line of JSON, ``{"rate": 44100}``, then the mono samples as little-endian
float32. What cannot be decoded ends with exit status 1 and one line on standard error.
"""

from __future__ import annotations

import json
import sys
from typing import Any


def main() -> int:
    """Decode standard input to standard output."""
    import av

    try:
        with av.open(sys.stdin.buffer) as container:
            if not container.streams.audio:
                print("it has no sound track", file=sys.stderr)
                return 1
            _decode(container)
    except (av.FFmpegError, ValueError) as error:
        print(getattr(error, "strerror", None) or error, file=sys.stderr)
        return 1
    return 0


def _decode(container: Any) -> None:
    import av

    rate = container.streams.audio[0].rate
    to_planes = av.AudioResampler(format="fltp", rate=rate)
    sys.stdout.buffer.write(json.dumps({"rate": rate}).encode() + b"\n")
    for frame in container.decode(audio=0):
        for planes in to_planes.resample(frame):
            mono = planes.to_ndarray().mean(axis=0)
            sys.stdout.buffer.write(mono.astype("<f4").tobytes())
    sys.stdout.buffer.flush()


if __name__ == "__main__":
    sys.exit(main())
