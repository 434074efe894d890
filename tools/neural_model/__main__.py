"""``python -m tools.neural_model WORK``: makes ``src/lipwright/data/neural/*.json`` anew.

It needs espeak-ng (extra ``tts``), PyTorch, and of Debian: flite, festival,
festvox-kallpc16k, festvox-kdlpc16k, festvox-us-slt-hts. On two cores it takes an hour or two; what
lies in the folder WORK already is not made again. The seed fixes what is spoken, how it is
spoilt and what is shown; PyTorch's sums may differ in their last digits from one machine to
another, and with them the weights.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

from lipwright.engines.neural.built_in import FOLDER
from tools.neural_model.closing import with_closing
from tools.neural_model.converted import converted
from tools.neural_model.hearing import hear_lines, order_of, read_heard
from tools.neural_model.learning import learn
from tools.neural_model.lines import lines
from tools.neural_model.shape import LIVE, WHOLE
from tools.neural_model.shown import lessons_of
from tools.neural_model.spoken import RATE, read_spoken, speak_all, write_spoken

SEED = 1
LINES = {"english": 2600, "others": 2200, "flite": 3000, "festival": 1000}
TIMES = 2
"""How often each line is spoilt, each time otherwise."""
STEPS = 7000
APART = 12
"""Of so many voices one is left out while learning, to choose by it when a closure is shown."""
SHAPES = {"whole": WHOLE, "live": LIVE}


def main(work: Path, names: list[str]) -> None:
    """Speak, spoil, learn, write."""
    work.mkdir(parents=True, exist_ok=True)
    speech = work / "spoken.pkl"
    if not speech.exists():
        tell("speaking")
        write_spoken(speech, speak_all(lines(np.random.default_rng(SEED), LINES)))
    files = [work / f"heard-{number}.npz" for number in range(TIMES)]
    for number, file in enumerate(files):
        if not file.exists():
            tell(f"hearing, time {number + 1} of {TIMES}")
            hear_lines(speech, SEED + number).save(file)
    spoken = read_spoken(speech)
    about = {
        "seconds": round(sum(len(line.samples) for line in spoken) / RATE, 1),
        "sounds": len(spoken),
        "times": TIMES,
        "steps": STEPS,
        "seed": SEED,
        "notes": [],
    }
    if names == ["data"]:
        return
    strange = set(sorted({line.voice for line in spoken})[::APART])
    unheard = np.array([*(line.voice in strange for line in spoken), False])
    del spoken
    orders = [order_of(len(unheard) - 1, SEED + number) for number in range(TIMES)]
    heard = [
        read_heard(file).only(~unheard[order]) for file, order in zip(files, orders, strict=True)
    ]
    others = read_heard(files[0]).only(unheard[orders[0]])
    FOLDER.mkdir(exist_ok=True)
    for name in names or list(SHAPES):
        tell(f"learning {name}")
        shape = SHAPES[name]
        lessons = lessons_of(heard, shape, np.random.default_rng(SEED))
        model = converted(learn(lessons, shape, steps=STEPS, seed=SEED), about)
        with_closing(model, shape, others).save(FOLDER / f"{name}.json")


def tell(what: str) -> None:
    """Say what is being done."""
    print(what, file=sys.stderr, flush=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2:])
