"""``set coverage``: what a corpus needs of a bigram set, and what to draw next."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import click

from lipwright.cli import options
from lipwright.cli.report import note

if TYPE_CHECKING:
    from lipwright.corpus import Corpus
    from lipwright.engines.bigram.coverage import Coverage, Need, Step

HEAD = 20
WORD = 36
SHOWN_NOTES = 3
HALVES = (0.5, 0.9, 0.99)
STATES = {"drawn": "drawn", "stand-in": "single curves", "no curve": "no curve at all"}


_corpus = options.stack(
    click.option(
        "--text", metavar="WORDS",
        help="Count the pairs that this text needs; a name of a file means what is in it.",
    ),
    click.option(
        "--text-file", "text_files", type=click.Path(path_type=Path), metavar="FILE",
        multiple=True, help="The same of a file of any size; - is standard input. May be repeated.",
    ),
    click.option(
        "--language", metavar="CODE",
        help="The language of the text; without a text, of a sample paragraph.",
    ),
    click.option("--voice", metavar="VOICE", help="Who says the text.  [default: en-us]"),
    click.option(
        "--each-line", is_flag=True, help="Each line of a text is an utterance of its own."
    ),
    click.option(
        "--labels", type=click.Path(path_type=Path), multiple=True, metavar="FILE",
        help="Count the pairs of phone times that exist. May be repeated.",
    ),
    click.option(
        "--phone-set", metavar="NAME", help="The notation of the labels, where it is not clear."
    ),
)  # fmt: skip


@click.command()
@click.argument("name", metavar="[SET]", default=None, required=False)
@click.option("--set", "named", metavar="SET", help="The same, as elsewhere.  [default: english]")
@click.option(
    "--overrides", type=click.Path(path_type=Path), metavar="FILE",
    help="A file whose bigrams are added to the set.",
)  # fmt: skip
@options.whose
@_corpus
@click.option(
    "--reduction", type=click.Path(path_type=Path), metavar="FILE",
    help="What phones become in the set's classes.",
)  # fmt: skip
@click.option("--within-words", is_flag=True, help="Leave out pairs across words.")
@click.option("--no-silence", is_flag=True, help="Leave out pairs into and out of silence.")
@click.option(
    "--by", type=click.Choice(["count", "time"]), default="count", show_default=True,
    help="Weigh pairs by how often they occur, or by how long they last.",
)  # fmt: skip
@click.option("--all", "everything", is_flag=True, help="List every pair.")
@click.option("--picture", type=click.Path(path_type=Path), metavar="FILE.svg", help="Draw it.")
@options.as_json
def coverage(
    name: str | None,
    named: str | None,
    overrides: Path | None,
    character: str | None,
    text: str | None,
    text_files: tuple[Path, ...],
    language: str | None,
    voice: str | None,
    each_line: bool,
    labels: tuple[Path, ...],
    phone_set: str | None,
    reduction: Path | None,
    within_words: bool,
    no_silence: bool,
    by: Literal["count", "time"],
    everything: bool,
    picture: Path | None,
    as_json: bool,
) -> None:
    """Say which pairs SET has, which ones lines need, and which to draw next.

    Without a text, labels or a language every pair of the set counts once.
    """
    from lipwright import corpus as corpora
    from lipwright.casting import files_read, set_for
    from lipwright.cli.progress import progress
    from lipwright.engines.bigram.coverage_picture import write_picture
    from lipwright.files import check_picture

    if text is not None and _is_file(text):
        text_files = (Path(text), *text_files)
        text = None
    if name and named and name != named:
        raise click.UsageError(f"two sets, {name!r} and {named!r}: give one")
    given_set = named or name
    chosen = given_set or set_for(None, character).name
    if picture is not None:
        read = files_read(character or "head", given_set)
        check_picture(picture, (*read, overrides, reduction, *text_files, *labels))
    if text is None and not text_files and language is not None:
        from lipwright.phones.languages import sample_text

        text = sample_text(language)
    speaker = voice or language or "en-us"
    given = text is not None or text_files or labels
    corpus = corpora.Corpus(text, text_files, labels, speaker, each_line, phone_set)
    with progress("counting") as report:
        found = corpora.coverage(
            given_set,
            corpus if given else None,
            overrides=overrides,
            character=character,
            reduction=reduction,
            within_words=within_words,
            silence=not no_silence,
            by=by,
            progress=report,
        )
    if picture is not None:
        write_picture(picture, found, _title(chosen, corpus if given else None, found))
    if as_json:
        click.echo(json.dumps(facts(chosen, found), ensure_ascii=False))
        return
    click.echo("\n".join(_lines(chosen, found, everything=everything, of_lines=bool(given))))
    if picture is not None:
        click.echo(f"  {picture}  (picture)")
    _tell(found)


def _is_file(text: str) -> bool:
    try:
        return Path(text).is_file()
    except (OSError, ValueError):  # longer than names may be, or with a zero byte
        return False


def _title(name: str, corpus: Corpus | None, found: Coverage) -> str:
    if corpus is None:
        return f"Set {Path(name).stem}: {found.share:.1%} of all pairs drawn"
    files = [Path(path).name for path in (*corpus.text_files, *corpus.labels)]
    source = files[0] if len(files) == 1 else f"{len(files)} files" if files else "Typed text"
    return f"{source}: {found.share:.1%} of running speech drawn in the set {Path(name).stem}"


def facts(name: str, found: Coverage) -> dict[str, Any]:
    """Return the answer for programs; docs/coverage.md says what each key holds."""
    return {
        "set": name,
        "share": found.share,
        "by": found.by,
        "within_words": found.within_words,
        "silence": found.silence,
        "lines": found.lines,
        "phones": found.phones,
        "total": found.total,
        "possible": len(found.possible),
        "classes": list(found.classes),
        "needed": {"-".join(pair): amount for pair, amount in found.needed.items()},
        "missing": ["-".join(pair) for pair in found.missing],
        "without_single_curve": list(found.bare),
        "pairs": [_pair_facts(need) for need in found.needs()],
        "order": [
            {"pair": "-".join(s.need.pair), "gain": s.need.share, "covered": s.covered}
            for s in found.order()
        ],
        "undrawn": ["-".join(pair) for pair in sorted(found.undrawn)],
        "nearest_phones": {
            label: {"as": near.classes, "share": near.share}
            for label, near in found.nearest_phones.items()
        },
        "notes": list(found.notes),
    }


def _pair_facts(need: Need) -> dict[str, Any]:
    return {
        "pair": "-".join(need.pair),
        "first": need.pair[0],
        "second": need.pair[1],
        "amount": need.amount,
        "share": need.share,
        "cumulative": need.cumulative,
        "state": need.state,
        "word": need.word,
        "nearest": need.nearest,
    }


def _lines(name: str, found: Coverage, *, everything: bool, of_lines: bool) -> list[str]:
    needed, missing = len(found.needed), len(found.missing)
    drawn = f"{needed - missing} of {needed} pairs, {found.share:.1%}"
    lines = [f"{Path(name).name}: {drawn} by {_measure(found)}"]
    if of_lines:
        lines += _summary(found)
        lines += _table(found, None if everything else HEAD)
    steps = found.order()
    if steps:
        lines += _order(found, steps, None if everything else HEAD, of_lines=of_lines)
    if found.bare:
        lines.append(f"no single-phone curve either: {' '.join(found.bare)}")
    return lines


def _measure(found: Coverage) -> str:
    return "time" if found.by == "time" else "frequency"


def _summary(found: Coverage) -> list[str]:
    scope = "within words" if found.within_words else "across words"
    silence = "silence counted" if found.silence else "silence left out"
    total = f"{found.total:.1f} s" if found.by == "time" else f"{found.total:,.0f} pairs"
    kinds = f"{len(found.needed)} of {len(found.possible)} kinds"
    parts = [f"{found.pairs_for(share)} make {share:.0%}" for share in HALVES]
    return [
        f"{found.phones:,} phones, {total} of {kinds}, {scope}, {silence}",
        f"of the most frequent: {', '.join(parts)}" if found.needed else "no pair is left to count",
    ]


def _table(found: Coverage, head: int | None) -> list[str]:
    if not found.needed:
        return []
    unit = "seconds" if found.by == "time" else "count"
    wide = _width(found)
    rows = [
        "",
        f"{'':>4}  {'pair':<{wide}}{unit:>9}{'share':>9}{'so far':>8}  {'in the set':<18}as in",
    ]
    needs = found.needs()
    for rank, need in enumerate(needs[:head], 1):
        amount = f"{need.amount:,.2f}" if found.by == "time" else f"{need.amount:,}"
        rows.append(
            f"{rank:>4}  {'-'.join(need.pair):<{wide}}{amount:>9}{need.share:>9.2%}"
            f"{need.cumulative:>8.1%}  {_state(need):<18}{need.word[:WORD]}"
        )
    return rows + _rest(len(needs), head)


def _width(found: Coverage) -> int:
    return max(9, *(len("-".join(pair)) + 2 for pair in found.needed))


def _state(need: Need) -> str:
    mark = " *" if need.nearest >= 0.5 else ""
    return STATES[need.state] + mark


def _order(
    found: Coverage, steps: tuple[Step, ...], head: int | None, *, of_lines: bool
) -> list[str]:
    what = "running speech" if of_lines else "all pairs"
    wide = _width(found)
    rows = [
        "",
        f"to draw, in this order ({found.share:.1%} of {what} is drawn now):",
        f"{'':>4}  {'pair':<{wide}}{'gain':>9}{'then':>8}  {'made now from':<18}as in",
    ]
    for rank, step in enumerate(steps[:head], 1):
        need = step.need
        rows.append(
            f"{rank:>4}  {'-'.join(need.pair):<{wide}}{need.share:>9.2%}{step.covered:>8.1%}"
            f"  {_state(need):<18}{need.word[:WORD]}"
        )
    return rows + _rest(len(steps), head)


def _rest(count: int, head: int | None) -> list[str]:
    return [] if head is None or count <= head else [f"      … and {count - head} more: --all"]


def _tell(found: Coverage) -> None:
    """Say what is only nearly so."""
    near = found.nearest_phones
    if near:
        share = sum(phone.share for phone in near.values())
        shown = ", ".join(f"{n} as {p.classes} {p.share:.1%}" for n, p in list(near.items())[:8])
        more = f", and {len(near) - 8} more" if len(near) > 8 else ""
        note(f"{share:.1%} of the phones have no class of their own (*): {shown}{more}")
    for text in found.notes[:SHOWN_NOTES]:
        note(f"left out: {text}")
    if len(found.notes) > SHOWN_NOTES:
        note(f"left out: {len(found.notes) - SHOWN_NOTES} more sentences")
