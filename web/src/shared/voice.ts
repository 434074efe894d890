/**
 * The loudspeaker. The whole performance is one buffer (silence where there is no sound yet), so
 * that a place in the buffer is a time of the performance, and its clock is what has been heard.
 */

import type { Range } from "./clock.ts";
import type { Sound } from "./wav.ts";

const LEAD = 0.02;
const GRAIN = 0.07;

export class Voice {
  #sound: Sound;
  #whole: Range;
  #context: AudioContext | null = null;
  #buffer: AudioBuffer | null = null;
  #gain: GainNode | null = null;
  #source: AudioBufferSourceNode | null = null;
  #muted = false;

  constructor(sound: Sound, whole: Range) {
    this.#sound = sound;
    this.#whole = whole;
  }

  get muted(): boolean {
    return this.#muted;
  }

  set muted(muted: boolean) {
    this.#muted = muted;
    if (this.#gain) this.#gain.gain.value = muted ? 0 : 1;
  }

  /** Seconds of sound that have left the loudspeaker since it was switched on. */
  tick(): number {
    const context = this.#context;
    if (!context) return 0;
    const now = context.currentTime;
    const stamp = context.getOutputTimestamp?.();
    if (stamp?.contextTime && stamp.performanceTime) {
      const heard = stamp.contextTime + (performance.now() - stamp.performanceTime) / 1000;
      if (heard > now - 1) return Math.min(heard, now);
    }
    return now - (context.outputLatency || context.baseLatency || 0);
  }

  /** Sound from `at` on; returns the tick at which it will be heard. */
  start(at: number, speed: number, loop: Range | null): number {
    const context = this.#switchOn();
    const source = this.#connect(context);
    source.playbackRate.value = speed;
    if (loop && at < loop.end) {
      source.loop = true;
      source.loopStart = loop.start - this.#whole.start;
      source.loopEnd = loop.end - this.#whole.start;
    }
    const when = context.currentTime + LEAD;
    source.start(when, at - this.#whole.start);
    return when;
  }

  stop(): void {
    this.#source?.stop();
    this.#source?.disconnect();
    this.#source = null;
  }

  /** A moment of the sound around `at`, as an ear needs it while scrubbing. */
  grain(at: number): void {
    const context = this.#switchOn();
    const source = this.#connect(context);
    const from = Math.max(at - this.#whole.start - GRAIN / 2, 0);
    source.start(0, from, GRAIN);
  }

  /** Give the loudspeaker back: a browser has only a few. */
  async close(): Promise<void> {
    this.stop();
    const context = this.#context;
    this.#context = null;
    await context?.close();
  }

  /** Whether sound runs now: the loudspeaker is on, and its time goes on. */
  get running(): boolean {
    return this.#context?.state === "running" && this.#source !== null;
  }

  #connect(context: AudioContext): AudioBufferSourceNode {
    this.stop();
    const source = context.createBufferSource();
    source.buffer = this.#buffer;
    source.connect(this.#gain as GainNode);
    this.#source = source;
    return source;
  }

  /** Browsers allow sound only after a key or a click: everything is made at the first one. */
  #switchOn(): AudioContext {
    if (!this.#context) {
      const { rate, samples } = this.#sound;
      const { start, end } = this.#whole;
      const lead = Math.round(-start * rate);
      const context = new AudioContext({ latencyHint: "interactive" });
      const length = Math.max(Math.ceil((end - start) * rate), lead + samples.length, 1);
      this.#buffer = context.createBuffer(1, length, rate);
      this.#buffer.copyToChannel(samples, 0, lead);
      this.#gain = context.createGain();
      this.#gain.gain.value = this.#muted ? 0 : 1;
      this.#gain.connect(context.destination);
      this.#context = context;
    }
    if (this.#context.state !== "running") void this.#context.resume();
    return this.#context;
  }
}
