/** Life that is not speech: a blink now and then. The same time always gives the same lids. */

const CLOSING = 0.08;
const CLOSED = 0.04;
const OPENING = 0.16;

/** A number in 0..1 that looks random and depends on `index` alone. */
function scatter(index: number): number {
  const value = Math.sin(index * 12.9898 + 4.1414) * 43758.5453;
  return value - Math.floor(value);
}

/** How far the lids are closed at `time`, 0..1: about every four seconds, never regular. */
export function blink(time: number): number {
  const period = 4;
  const index = Math.floor(time / period);
  const since = time - (index + 0.25 + 0.5 * scatter(index)) * period;
  if (since < 0 || since > CLOSING + CLOSED + OPENING) return 0;
  if (since < CLOSING) return ease(since / CLOSING);
  if (since < CLOSING + CLOSED) return 1;
  return ease(1 - (since - CLOSING - CLOSED) / OPENING);
}

function ease(share: number): number {
  return share * share * (3 - 2 * share);
}
