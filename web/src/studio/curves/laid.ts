/** Where in a line the curves that are edited are laid: between their 0..1 and seconds. */

/** One place; `mark` is the boundary of the two phones in 0..1. */
export interface Laid {
  first: number;
  boundary: number;
  last: number;
  mark: number;
}

/** The instant in 0..1, if the curves lie there. */
export function shareAt(places: Laid[], time: number): number | null {
  const place = places.find(({ first, last }) => time >= first && time < last);
  if (!place) return null;
  const { first, boundary, last, mark } = place;
  if (time < boundary) return ((time - first) / (boundary - first)) * mark;
  return mark + ((time - boundary) / (last - boundary)) * (1 - mark);
}

/** When an instant of 0..1 sounds: of several places the nearest. */
export function timeOf(places: Laid[], share: number, near: number): number | null {
  const times = places.map(({ first, boundary, last, mark }) =>
    share < mark
      ? first + (share / mark) * (boundary - first)
      : boundary + ((share - mark) / (1 - mark)) * (last - boundary),
  );
  if (!times.length) return null;
  return times.reduce((a, b) => (Math.abs(b - near) < Math.abs(a - near) ? b : a));
}
