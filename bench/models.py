"""Characters and GLB: making head and crab, mapping an animation, writing a file."""

from functools import partial

from bench.measure import milliseconds, say
from lipwright import pipeline
from lipwright.character.builtin import to_glb
from lipwright.character.crab import build_crab
from lipwright.character.head import build_head
from lipwright.export import encode

LINE = "Peter Piper picked a peck of pickled peppers."

if __name__ == "__main__":
    say("make the head's mesh", **milliseconds(build_head, runs=7))
    parts = build_head()
    data = to_glb(parts, "head")
    figures = milliseconds(lambda: to_glb(parts, "head"), runs=7)
    say("write the head as GLB", **figures, megabytes=round(len(data) / 1e6, 2))
    say("make the crab's mesh", **milliseconds(build_crab, runs=7))
    crab = build_crab()
    figures = milliseconds(lambda: to_glb(crab, "crab"), runs=7)
    say("write the crab as GLB", **figures, megabytes=round(len(to_glb(crab, "crab")) / 1e6, 2))
    performance = pipeline.animate(pipeline.say(LINE))
    say("map a sentence onto the head", **milliseconds(performance.rig, runs=7))
    for suffix in (".json", ".csv", ".glb", ".html"):
        size = round(len(encode(performance, suffix)) / 1e6, 2)
        figures = milliseconds(partial(encode, performance, suffix), runs=7)
        say(f"encode a sentence as {suffix}", **figures, megabytes=size)
