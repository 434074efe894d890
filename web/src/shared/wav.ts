/** WAV files: what `lipwright` writes, 16-bit PCM, and no other kind. */

export interface Sound {
  rate: number;
  samples: Float32Array<ArrayBuffer>;
}

export function readWav(bytes: ArrayBuffer): Sound {
  const view = new DataView(bytes);
  const tag = (at: number) => String.fromCharCode(...new Uint8Array(bytes, at, 4));
  if (bytes.byteLength < 44 || tag(0) !== "RIFF" || tag(8) !== "WAVE")
    throw new Error("the sound is not a WAV file");
  let rate = 0;
  for (let at = 12; at + 8 <= bytes.byteLength;) {
    const size = view.getUint32(at + 4, true);
    if (tag(at) === "fmt ") {
      if (view.getUint16(at + 8, true) !== 1 || view.getUint16(at + 10, true) !== 1)
        throw new Error("the sound is not one channel of PCM");
      if (view.getUint16(at + 22, true) !== 16) throw new Error("the sound has not 16 bits");
      rate = view.getUint32(at + 12, true);
    } else if (tag(at) === "data") {
      return { rate, samples: toFloat(view, at + 8, size) };
    }
    at += 8 + size + (size % 2);
  }
  throw new Error("the sound has no samples");
}

function toFloat(view: DataView, from: number, size: number): Float32Array<ArrayBuffer> {
  const count = Math.min(size, view.byteLength - from) >> 1;
  const samples = new Float32Array(count);
  for (let index = 0; index < count; index++)
    samples[index] = view.getInt16(from + 2 * index, true) / 32768;
  return samples;
}

/** Lowest and highest sample of each block: what a waveform is drawn from. */
export interface Peaks extends Sound {
  block: number;
  low: Float32Array;
  high: Float32Array;
}

export function peaksOf(sound: Sound, block = 64): Peaks {
  const count = Math.ceil(sound.samples.length / block);
  const low = new Float32Array(count);
  const high = new Float32Array(count);
  sound.samples.forEach((value, index) => {
    const at = Math.floor(index / block);
    if (value < low[at]) low[at] = value;
    if (value > high[at]) high[at] = value;
  });
  return { ...sound, block, low, high };
}

/** Lowest and highest sample from `start` up to `end`, in seconds. */
export function extent(peaks: Peaks, start: number, end: number): [number, number] {
  const fine = peaks.samples.length > 0 && (end - start) * peaks.rate < peaks.block;
  const lows = fine ? peaks.samples : peaks.low;
  const highs = fine ? peaks.samples : peaks.high;
  const scale = fine ? peaks.rate : peaks.rate / peaks.block;
  const first = Math.max(Math.floor(start * scale), 0);
  const last = Math.min(Math.max(Math.ceil(end * scale), first + 1), lows.length);
  let low = 0;
  let high = 0;
  for (let at = first; at < last; at++) {
    if (lows[at] < low) low = lows[at];
    if (highs[at] > high) high = highs[at];
  }
  return [low, high];
}
