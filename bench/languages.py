"""Languages: which of their sounds the classes show as they are, and which stand in.

A paragraph of running speech each. ``--table`` prints the table of docs/languages.md.
"""

import sys
from collections.abc import Iterator
from dataclasses import dataclass

from bench.measure import say
from lipwright import pipeline
from lipwright.phones import ReductionReport, load_reduction
from lipwright.phones.ipa import nearest
from lipwright.phones.languages import language_name, languages, sample_text

VOICES = {"en": "en-us"}
SETS = {"cmn": "mandarin"}


@dataclass
class Language:
    code: str
    report: ReductionReport

    @property
    def stand_ins(self) -> list[tuple[str, str, float, float]]:
        """Label, classes, share of the phones, distance; the most frequent first."""
        total = sum(self.report.counts.values())
        rows = []
        for label, classes in self.report.stand_ins.items():
            found = nearest(label)
            distance = found.distance if found is not None else 0.0
            rows.append((label, classes, self.report.counts[label] / total, distance))
        return sorted(rows, key=lambda row: -row[2])


def measured() -> Iterator[Language]:
    for code in languages():
        speech = pipeline.say(sample_text(code), voice=VOICES.get(code, code))
        reduction = load_reduction(speech.phones.phone_set, SETS.get(code, "common"))
        yield Language(code, reduction.rows(speech.phones)[1])


def print_lines() -> None:
    for language in measured():
        say(
            "classes of a language",
            language=language.code,
            phones=sum(language.report.counts.values()),
            labels=len(language.report.counts),
            exact_of_phones=round(language.report.share_exact, 4),
            exact_of_time=round(language.report.share_exact_of_time, 4),
            stand_ins={
                label: {"as": classes, "share": round(share, 4), "distance": round(distance, 2)}
                for label, classes, share, distance in language.stand_ins
            },
        )


def print_table() -> None:
    print("| language | labels | exact, of phones | of time | stand-ins (share of phones) |")
    print("|---|---|---|---|---|")
    rows = sorted(measured(), key=lambda language: language.report.share_exact)
    for language in rows:
        told = ", ".join(f"{a} as {b} {share:.1%}" for a, b, share, _ in language.stand_ins)
        print(
            f"| {language_name(language.code)} `{language.code}`"
            f" | {len(language.report.counts)} | {language.report.share_exact:.1%}"
            f" | {language.report.share_exact_of_time:.1%} | {told or '—'} |"
        )


if __name__ == "__main__":
    print_table() if "--table" in sys.argv[1:] else print_lines()
