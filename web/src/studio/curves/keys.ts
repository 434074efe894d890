/**
 * What can be done to the keys of curves: pure functions, from keys to new keys. Of a curve that
 * rests at both ends the first and the last key stay at zero, as the bigram set wants them.
 */

export type Key = [number, number];
export type Curves = Record<string, Key[]>;

/** Where keys may lie, and whether a curve must begin and end at zero. */
export interface Domain {
  first: number;
  last: number;
  rests: boolean;
}

/** Which keys of which curve are chosen. */
export type Chosen = ReadonlyMap<string, ReadonlySet<number>>;

/** A weight at which a pose is clearly seen. */
const CLEAR = 0.3;
/** Two keys of a curve are never closer than this. */
export const GAP = 0.001;

const round = (value: number) => Math.round(value * 1000) / 1000;
const clamp = (value: number, low: number, high: number) => Math.min(Math.max(value, low), high);

export function valueAt(keys: Key[], time: number): number {
  if (!keys.length || time < keys[0][0] || time > keys[keys.length - 1][0]) return 0;
  const after = keys.findIndex(([at]) => at >= time);
  const [t1, v1] = keys[after];
  if (after === 0 || t1 === time) return v1;
  const [t0, v0] = keys[after - 1];
  return v0 + ((time - t0) / (t1 - t0)) * (v1 - v0);
}

/** Whether a key is held at zero. */
export function isHeld(keys: Key[], index: number, domain: Domain): boolean {
  return domain.rests && (index === 0 || index === keys.length - 1);
}

/** How far the chosen keys may go together: no further than their neighbours and the edges. */
export function room(
  curves: Curves,
  chosen: Chosen,
  domain: Domain,
): { times: [number, number]; values: [number, number] } {
  const times: [number, number] = [-Infinity, Infinity];
  const values: [number, number] = [-Infinity, Infinity];
  for (const [name, picked] of chosen) {
    const keys = curves[name] ?? [];
    for (const index of picked) {
      const [time, value] = keys[index];
      const before = index === 0 ? domain.first : keys[index - 1][0] + GAP;
      const after = index === keys.length - 1 ? domain.last : keys[index + 1][0] - GAP;
      if (!picked.has(index - 1)) times[0] = Math.max(times[0], before - time);
      if (!picked.has(index + 1)) times[1] = Math.min(times[1], after - time);
      if (isHeld(keys, index, domain)) continue;
      values[0] = Math.max(values[0], -value);
      values[1] = Math.min(values[1], 1 - value);
    }
  }
  return { times, values };
}

/** Move all chosen keys by as much, or as far as there is room. */
export function move(
  curves: Curves,
  chosen: Chosen,
  domain: Domain,
  byTime: number,
  byValue: number,
): Curves {
  const { times, values } = room(curves, chosen, domain);
  const time = clamp(byTime, Math.min(times[0], 0), Math.max(times[1], 0));
  const value = clamp(byValue, Math.min(values[0], 0), Math.max(values[1], 0));
  return change(curves, chosen, (key, index, keys) => [
    round(key[0] + time),
    isHeld(keys, index, domain) ? key[1] : round(key[1] + value),
  ]);
}

function change(
  curves: Curves,
  chosen: Chosen,
  by: (key: Key, index: number, keys: Key[]) => Key,
): Curves {
  const result = { ...curves };
  for (const [name, picked] of chosen) {
    const keys = curves[name];
    if (keys)
      result[name] = keys.map((key, index) => (picked.has(index) ? by(key, index, keys) : key));
  }
  return result;
}

/** Put a key where it was typed: both its time and weight, as far as they may. */
export function place(keys: Key[], index: number, to: Key, domain: Domain): Key[] {
  const before = index === 0 ? domain.first : keys[index - 1][0] + GAP;
  const after = index === keys.length - 1 ? domain.last : keys[index + 1][0] - GAP;
  const value = isHeld(keys, index, domain) ? 0 : clamp(to[1], 0, 1);
  const result = keys.slice();
  result[index] = [round(clamp(to[0], before, after)), round(value)];
  return result;
}

/** Add a key; beyond the ends of a curve that rests, the end goes along. */
export function insert(keys: Key[], key: Key, domain: Domain): { keys: Key[]; index: number } {
  const time = round(clamp(key[0], domain.first, domain.last));
  const value = round(clamp(key[1], 0, 1));
  const near = keys.findIndex(([at]) => Math.abs(at - time) < GAP);
  if (near >= 0) return { keys: place(keys, near, [time, value], domain), index: near };
  const index = keys.findIndex(([at]) => at > time);
  const at = index < 0 ? keys.length : index;
  const result: Key[] = [...keys.slice(0, at), [time, value], ...keys.slice(at)];
  if (!domain.rests) return { keys: result, index: at };
  if (at === keys.length) {
    if (time > domain.last - GAP) return { keys: place(result, at, [time, 0], domain), index: at };
    return { keys: [...result, [round(Math.min(domain.last, time + 0.15)), 0]], index: at };
  }
  if (at === 0) {
    if (time < domain.first + GAP) return { keys: place(result, 0, [time, 0], domain), index: 0 };
    return { keys: [[round(Math.max(domain.first, time - 0.15)), 0], ...result], index: 1 };
  }
  return { keys: result, index: at };
}

/**
 * Take the chosen keys away. The resting ends stay unless all of the curve is chosen; of fewer
 * than two keys no curve is left.
 */
export function remove(curves: Curves, chosen: Chosen, domain: Domain): Curves {
  const result = { ...curves };
  for (const [name, picked] of chosen) {
    const keys = curves[name];
    if (!keys) continue;
    const all = picked.size >= keys.length;
    const kept = all
      ? []
      : keys.filter((_, index) => !picked.has(index) || isHeld(keys, index, domain));
    if (kept.length >= 2 && kept.some(([, value]) => value > 0)) result[name] = kept;
    else delete result[name];
  }
  return result;
}

/** Turn the chosen keys round in time: about the middle of the domain if a curve is whole. */
export function mirror(curves: Curves, chosen: Chosen, domain: Domain): Curves {
  const { span, whole } = extentOf(curves, chosen);
  const about = whole ? domain.first + domain.last : span[0] + span[1];
  const picked = whole ? everything(curves, chosen.keys()) : chosen;
  return tidy(
    change(curves, picked, ([time, value]) => [round(about - time), value]),
    picked,
    domain,
  );
}

/** Multiply the weights of the chosen keys, all between 0 and 1. */
export function scaleValues(curves: Curves, chosen: Chosen, domain: Domain, by: number): Curves {
  return change(curves, chosen, (key, index, keys) =>
    isHeld(keys, index, domain) ? key : [key[0], round(clamp(key[1] * by, 0, 1))],
  );
}

/** Stretch the chosen keys in time about their middle. */
export function scaleTimes(curves: Curves, chosen: Chosen, domain: Domain, by: number): Curves {
  const { span } = extentOf(curves, chosen);
  const middle = (span[0] + span[1]) / 2;
  const to = ([time, value]: Key): Key => [
    round(clamp(middle + (time - middle) * by, domain.first, domain.last)),
    value,
  ];
  return tidy(change(curves, chosen, to), chosen, domain);
}

/** Draw the same weights over a curve again; keys of `pasted` win where both lie. */
export function paste(keys: Key[], pasted: Key[], domain: Domain): Key[] {
  if (!pasted.length) return keys;
  const [from, to] = [pasted[0][0] - GAP, pasted[pasted.length - 1][0] + GAP];
  const around = keys.filter(([time]) => time <= from || time >= to);
  return settle([...around, ...pasted], domain);
}

/** All keys of some curves. */
export function everything(curves: Curves, names: Iterable<string>): Map<string, Set<number>> {
  const result = new Map<string, Set<number>>();
  for (const name of names) {
    const keys = curves[name];
    if (keys?.length) result.set(name, new Set(keys.map((_, index) => index)));
  }
  return result;
}

function extentOf(curves: Curves, chosen: Chosen): { span: [number, number]; whole: boolean } {
  const span: [number, number] = [Infinity, -Infinity];
  let whole = true;
  for (const [name, picked] of chosen) {
    const keys = curves[name] ?? [];
    if (picked.size < keys.length) whole = false;
    for (const index of picked) {
      span[0] = Math.min(span[0], keys[index][0]);
      span[1] = Math.max(span[1], keys[index][0]);
    }
  }
  return { span, whole };
}

function tidy(curves: Curves, chosen: Chosen, domain: Domain): Curves {
  const result = { ...curves };
  for (const name of chosen.keys()) if (result[name]) result[name] = settle(result[name], domain);
  return result;
}

/** Keys in order, none on another, resting where they must. */
export function settle(unordered: Key[], domain: Domain): Key[] {
  const keys = unordered.slice().sort((a, b) => a[0] - b[0]);
  const result: Key[] = [];
  for (const key of keys)
    if (!result.length || key[0] - result[result.length - 1][0] > GAP - 1e-9) result.push(key);
  if (!domain.rests || !result.length) return result;
  const [first, last] = [result[0], result[result.length - 1]];
  if (first[1] !== 0)
    if (first[0] - GAP > domain.first)
      result.unshift([round(Math.max(first[0] - 0.1, domain.first)), 0]);
    else result[0] = [first[0], 0];
  if (last[1] !== 0)
    if (last[0] + GAP < domain.last) result.push([round(Math.min(last[0] + 0.1, domain.last)), 0]);
    else result[result.length - 1] = [last[0], 0];
  return result;
}

/** The nearest of some places that pull, or what was given where none is near enough. */
export function snap(value: number, places: number[], within: number): number {
  let best = value;
  let least = within;
  for (const place of places) {
    const far = Math.abs(place - value);
    if (far <= least) [best, least] = [place, far];
  }
  return best;
}

/** Of the poses that are clearly seen the first, or else the strongest: sets begin with the lips. */
export function mostSeen(curves: Curves): string {
  const names = Object.keys(curves);
  const peak = (name: string) => Math.max(0, ...curves[name].map(([, value]) => value));
  const strongest = names.reduce((best, name) => (peak(name) > peak(best) ? name : best), names[0]);
  return names.find((name) => peak(name) >= CLEAR) ?? strongest ?? "";
}

/** Whether two curves have the same keys. */
export function same(a: Key[] | undefined, b: Key[] | undefined): boolean {
  if (!a || !b || a.length !== b.length) return a === b;
  return a.every(([time, value], index) => time === b[index][0] && value === b[index][1]);
}
