/** Labelled stretches of time, in order: phones and words. */

export interface Span {
  label: string;
  start: number;
  end: number;
}

/** The index of the span that holds `time` (half-open), or -1. */
export function spanAt(spans: Span[], time: number): number {
  const index = lastStart(spans, time);
  return index >= 0 && time < spans[index].end ? index : -1;
}

/** The index of the last span that starts at or before `time`, or -1. */
export function lastStart(spans: Span[], time: number): number {
  let low = 0;
  let high = spans.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (spans[middle].start <= time) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** The instant that shows what a phone looks like. */
export function middle(span: Span): number {
  return (span.start + span.end) / 2;
}

/** The next (`step` 1) or previous (-1) of `marks`, which are in order, from `time`. */
export function neighbour(marks: number[], time: number, step: 1 | -1): number | undefined {
  const slack = 1e-4;
  if (step > 0) return marks.find((mark) => mark > time + slack);
  return marks.findLast((mark) => mark < time - slack);
}
