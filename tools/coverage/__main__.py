"""``python -m tools.coverage``: writes ``docs/coverage.md`` and its pictures anew."""

from __future__ import annotations

from pathlib import Path
from statistics import median

from lipwright.engines.bigram.coverage import Coverage
from lipwright.engines.bigram.coverage_picture import picture
from lipwright.files import write_all
from tools.coverage.count import by_dictionary, by_synthesiser, utterances
from tools.coverage.figure import figure
from tools.coverage.published import FIRST, FIRST_SHARE, KINDS, NEVER, TABLE

DOCS = Path(__file__).parents[2] / "docs"
PAGE = DOCS / "coverage.md"
MATRIX = DOCS / "pictures" / "coverage.svg"
FIGURE = DOCS / "pictures" / "coverage-ranks.svg"
TEMPLATE = Path(__file__).with_name("page.md")


def outputs() -> dict[Path, str]:
    """Return what each file must hold."""
    spoken, written = by_synthesiser(), by_dictionary()
    return {
        PAGE: page(spoken, written),
        MATRIX: picture(spoken, "Pairs of phones in 200 English utterances"),
        FIGURE: figure(spoken, written),
    }


def page(spoken: Coverage, written: Coverage) -> str:
    """Return the page: the template with its figures filled in."""
    lengths = [len(text.split()) for text in utterances()]
    text = TEMPLATE.read_text(encoding="utf-8")
    for name, value in {
        "UTTERANCES": f"{len(lengths)}",
        "WORDS": f"{sum(lengths):,}",
        "LONGEST": f"{max(lengths)}",
        "MEDIAN": f"{median(lengths):g}",
        "TABLE": table(spoken, written),
        "SUMMARY": summary(spoken, written),
        "SHARED": shared(spoken, written),
    }.items():
        text = text.replace(f"<{name}>", value)
    return text


def table(spoken: Coverage, written: Coverage) -> str:
    """Return the 21 most frequent pairs of the publication and of both counts."""
    ours = [of.needs()[: len(TABLE)] for of in (spoken, written)]
    lines = [
        "| rank | Table 2 | % | espeak-ng | % | CMU dictionary | % |",
        "|---|---|---|---|---|---|---|",
    ]
    for rank, row in enumerate(zip(TABLE, *ours, strict=True), 1):
        (first, second, percent), *counted = row
        cells = [f"{first}-{second}", f"{percent:.2f}"]
        for need in counted:
            cells += ["-".join(need.pair), f"{100 * need.share:.2f}"]
        lines.append(f"| {rank} | {' | '.join(cells)} |")
    return "\n".join(lines)


def summary(spoken: Coverage, written: Coverage) -> str:
    """Return the other figures of section 3.1.1 beside ours."""
    first = sum(percent for _, _, percent in TABLE)
    both = (spoken, written)
    rows = [
        ("pairs counted", "not said", *(f"{of.total:,.0f}" for of in both)),
        (
            f"share of the {len(TABLE)} most frequent pairs",
            f"{first:.1f} %",
            *(f"{100 * of.share_of_first(len(TABLE)):.1f} %" for of in both),
        ),
        (
            f"share of the first {FIRST}",
            f"{100 * FIRST_SHARE:.1f} %",
            *(f"{100 * of.share_of_first(FIRST):.1f} %" for of in both),
        ),
        (
            f"pairs that make up {100 * FIRST_SHARE:.1f} %",
            f"{FIRST}",
            *(f"{of.pairs_for(FIRST_SHARE)}" for of in both),
        ),
        (
            f"of the {KINDS} never occur",
            f"{NEVER}",
            *(f"{KINDS - len(of.needed)}" for of in both),
        ),
    ]
    lines = ["| | published | espeak-ng | CMU dictionary |", "|---|---|---|---|"]
    return "\n".join(lines + [f"| {' | '.join(row)} |" for row in rows])


def shared(spoken: Coverage, written: Coverage) -> str:
    """Say how many of the publication's pairs are among ours, and where the others stand."""
    found = []
    for name, of in (("espeak-ng", spoken), ("the dictionary", written)):
        ranks = {need.pair: rank for rank, need in enumerate(of.needs(), 1)}
        theirs = [(first, second) for first, second, _ in TABLE]
        outside = [pair for pair in theirs if ranks.get(pair, KINDS) > len(TABLE)]
        rest = ", ".join(f"{'-'.join(pair)} {ranks.get(pair, 'never')}" for pair in outside)
        found.append(f"{len(TABLE) - len(outside)} are among those of {name} (the others: {rest})")
    return "; ".join(found)


if __name__ == "__main__":
    made = outputs()
    write_all((path, content.encode()) for path, content in made.items())
    print(*(path.name for path in made), sep="\n")
