/** Play, pause, seek, loop, speed: the clock and the loudspeaker kept together. */

import { Clock, type Range } from "./clock.ts";
import type { Voice } from "./voice.ts";

const PATIENCE = 800;

export class Player {
  readonly whole: Range;
  #clock: Clock;
  #voice: Voice | null;
  #looping = false;
  #range: Range | null = null;
  #listeners: (() => void)[] = [];

  constructor(whole: Range, voice: Voice | null) {
    this.whole = whole;
    this.#voice = voice;
    this.#clock = new Clock(whole, voice ? () => voice.tick() : wall);
  }

  /** Call `listener` whenever anything but the time itself has changed, or the time has jumped. */
  onChange(listener: () => void): void {
    this.#listeners.push(listener);
  }

  get playing(): boolean {
    return this.#clock.playing;
  }

  get looping(): boolean {
    return this.#looping;
  }

  /** What is repeated when looping: the whole where nothing is chosen. */
  get range(): Range | null {
    return this.#range;
  }

  get speed(): number {
    return this.#clock.speed;
  }

  get voice(): Voice | null {
    return this.#voice;
  }

  time(): number {
    return this.#clock.time();
  }

  play(): void {
    if (this.playing) return;
    const loop = this.#loop();
    if (loop && !within(this.time(), loop)) this.#clock.seek(loop.start);
    else if (this.#clock.ended) this.#clock.seek(this.whole.start);
    this.#clock.loop = loop;
    this.#start();
    this.#announce();
  }

  pause(): void {
    if (!this.playing) return;
    this.#stop();
    this.#announce();
  }

  toggle(): void {
    if (this.playing) this.pause();
    else this.play();
  }

  /** Go to a time; when paused, let its sound be heard for a moment if `aloud`. */
  seek(time: number, aloud = false): void {
    this.#while(() => this.#clock.seek(time));
    if (aloud && !this.playing && !this.#voice?.muted) this.#voice?.grain(this.time());
  }

  setSpeed(speed: number): void {
    this.#while(() => {
      this.#clock.speed = speed;
    });
  }

  setLooping(looping: boolean): void {
    this.#while(() => {
      this.#looping = looping;
    });
  }

  /** Choose what is repeated, and repeat it; null chooses the whole. */
  setRange(range: Range | null): void {
    this.#while(() => {
      this.#range = range && range.end - range.start > 0.02 ? range : null;
      if (this.#range) this.#looping = true;
    });
  }

  setMuted(muted: boolean): void {
    if (this.#voice) this.#voice.muted = muted;
    this.#announce();
  }

  /** Pause or begin again at the end; to be called once for each picture. */
  update(): void {
    if (!this.playing || !this.#clock.ended) return;
    const { loop } = this.#clock;
    if (loop) this.seek(loop.start);
    else this.pause();
  }

  #loop(): Range | null {
    return this.#looping ? (this.#range ?? this.whole) : null;
  }

  #while(change: () => void): void {
    const playing = this.playing;
    if (playing) this.#stop();
    change();
    const loop = this.#loop();
    this.#clock.loop = loop;
    if (playing && this.#clock.ended && loop) this.#clock.seek(loop.start);
    if (playing) this.#start();
    this.#announce();
  }

  #start(): void {
    const { speed, loop } = this.#clock;
    if (!this.#voice) return this.#clock.play(wall());
    const anchor = this.#voice.start(this.time(), speed, loop);
    this.#clock.play(anchor);
    setTimeout(() => this.#checkSound(anchor), PATIENCE);
  }

  #stop(): void {
    this.#clock.pause();
    this.#voice?.stop();
  }

  /** A browser without any sound device never moves its clock: go on in silence. */
  #checkSound(anchor: number): void {
    const voice = this.#voice;
    if (!this.playing || !voice || voice.tick() > anchor) return;
    this.#stop();
    this.#voice = null;
    this.#clock.count(wall);
    this.#start();
    this.#announce();
  }

  #announce(): void {
    for (const listener of this.#listeners) listener();
  }
}

function wall(): number {
  return performance.now() / 1000;
}

function within(time: number, range: Range): boolean {
  return time >= range.start && time < range.end - 1e-6;
}
