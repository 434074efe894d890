import assert from "node:assert/strict";
import { test } from "node:test";
import { extent, peaksOf, readWav } from "../src/shared/wav.ts";

function wav(samples: number[], { bits = 16, channels = 1, extra = false } = {}): ArrayBuffer {
  const chunk = (name: string, body: Buffer) => {
    const size = Buffer.alloc(4);
    size.writeUInt32LE(body.length);
    return Buffer.concat([Buffer.from(name), size, body, Buffer.alloc(body.length % 2)]);
  };
  const format = Buffer.alloc(16);
  format.writeUInt16LE(1, 0);
  format.writeUInt16LE(channels, 2);
  format.writeUInt32LE(8000, 4);
  format.writeUInt16LE(bits, 14);
  const data = Buffer.from(Int16Array.from(samples).buffer);
  const parts = [Buffer.from("WAVE"), chunk("fmt ", format)];
  if (extra) parts.push(chunk("LIST", Buffer.from("odd")));
  parts.push(chunk("data", data));
  const body = chunk("RIFF", Buffer.concat(parts));
  return body.buffer.slice(body.byteOffset, body.byteOffset + body.length) as ArrayBuffer;
}

test("samples and rate are read, past chunks that mean nothing here", () => {
  const sound = readWav(wav([0, 16384, -32768], { extra: true }));
  assert.equal(sound.rate, 8000);
  assert.deepEqual([...sound.samples], [0, 0.5, -1]);
});

test("what is not 16-bit PCM of one channel is refused with the reason", () => {
  assert.throws(() => readWav(new ArrayBuffer(50)), /not a WAV/);
  assert.throws(() => readWav(wav([1], { channels: 2 })), /one channel/);
  assert.throws(() => readWav(wav([1], { bits: 8 })), /16 bits/);
});

test("the waveform shows the lowest and the highest sample of a stretch", () => {
  const samples = new Float32Array(8000);
  samples[4000] = 0.75;
  samples[4100] = -0.5;
  const peaks = peaksOf({ rate: 8000, samples });
  assert.deepEqual(extent(peaks, 0.4, 0.6), [-0.5, 0.75]);
  assert.deepEqual(extent(peaks, 0, 0.4), [0, 0]);
  assert.deepEqual(extent(peaks, 2, 3), [0, 0]);
  assert.deepEqual(extent(peaks, 0.5, 0.5005), [0, 0.75]);
  assert.deepEqual(extent(peaks, 0.501, 0.502), [0, 0]);
});
