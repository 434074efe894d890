/** Named curves sampled at a fixed rate. */

export interface Curves {
  names: string[];
  /** Frames per second. */
  rate: number;
  /** Seconds of the first frame on the sound's clock. */
  start: number;
  /** One row for each frame, one value for each name, row after row. */
  values: Float32Array;
}

export function curves(names: string[], rate: number, start: number, frames: number[][]): Curves {
  const values = new Float32Array(frames.length * names.length);
  frames.forEach((frame, row) => values.set(frame, row * names.length));
  return { names, rate, start, values };
}

export function frameCount(of: Curves): number {
  return of.names.length ? of.values.length / of.names.length : 0;
}

/** From the first frame to the end of the last, in seconds. */
export function endOf(of: Curves): number {
  return of.start + frameCount(of) / of.rate;
}

/** The values at `time`: linear between frames, held before the first and after the last. */
export function sample(of: Curves, time: number): Float32Array {
  const width = of.names.length;
  const result = new Float32Array(width);
  const last = frameCount(of) - 1;
  if (last < 0) return result;
  const place = Math.min(Math.max((time - of.start) * of.rate, 0), last);
  const before = Math.floor(place);
  const after = Math.min(before + 1, last);
  const share = place - before;
  for (let name = 0; name < width; name++) {
    const a = of.values[before * width + name];
    result[name] = a + share * (of.values[after * width + name] - a);
  }
  return result;
}

/** The largest value that each curve reaches. */
export function peaks(of: Curves): Float32Array {
  const width = of.names.length;
  const result = new Float32Array(width);
  of.values.forEach((value, index) => {
    result[index % width] = Math.max(result[index % width], Math.abs(value));
  });
  return result;
}
