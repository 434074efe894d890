/** The player of the line that is shown: its loudspeaker, buttons and clock. */

import type { Range } from "../../shared/clock.ts";
import { clockTime } from "../../shared/format.ts";
import { Player } from "../../shared/player.ts";
import { Voice } from "../../shared/voice.ts";
import { peaksOf, readWav, type Peaks, type Sound } from "../../shared/wav.ts";
import { byId, h, write } from "../core/dom.ts";
import type { Session } from "../core/session.ts";
import type { LineView } from "../protocol.ts";

export const SPEEDS = [0.1, 0.25, 0.5, 1];
/** Sounds that are kept: the last few lines. */
const KEPT = 6;

export class Transport {
  player: Player | null = null;
  peaks: Peaks | null = null;
  #session: Session;
  #sounds = new Map<string, Sound>();
  #shown = { line: "", sound: "", start: 0, end: 0 };
  #voice: Voice | null = null;
  #changed: () => void;
  #complain: (error: Error) => void;

  constructor(session: Session, changed: () => void, complain: (error: Error) => void) {
    this.#session = session;
    this.#changed = changed;
    this.#complain = complain;
    this.#buttons();
  }

  /** Be ready to play a line; the same one keeps its time. */
  async show(line: LineView | null): Promise<void> {
    const { start = 0, end = 0, sound = "", line: id = "" } = line ?? {};
    const before = this.#shown;
    const same = before.line === id && before.sound === sound;
    if (same && before.start === start && before.end === end) return;
    this.#shown = { line: id, sound, start, end };
    if (!line) return this.#make(null, null, 0);
    const known = this.#sounds.get(sound) ?? null;
    const whole = { start: Math.min(0, start), end: Math.max(end, line.duration, start + 0.05) };
    if (!same) this.player?.setRange(null);
    this.#make(whole, known, same ? (this.player?.time() ?? 0) : whole.start);
    if (sound && !known) await this.#fetch(sound, whole);
  }

  async #fetch(address: string, whole: Range): Promise<void> {
    try {
      const sound = readWav(await this.#session.connection.fetch(address));
      this.#sounds.set(address, sound);
      for (const old of [...this.#sounds.keys()].slice(0, -KEPT)) this.#sounds.delete(old);
      if (this.#shown.sound !== address) return;
      this.#make(whole, sound, this.player?.time() ?? whole.start);
    } catch (error) {
      this.#complain(error as Error);
    }
  }

  #make(whole: Range | null, sound: Sound | null, time: number): void {
    const before = this.player;
    const again = before?.playing ?? false;
    before?.pause();
    void this.#voice?.close();
    this.#voice = whole && sound ? new Voice(sound, whole) : null;
    this.player = whole ? new Player(whole, this.#voice) : null;
    this.peaks = sound ? peaksOf(sound) : null;
    if (this.player && before) {
      this.player.setSpeed(before.speed);
      this.player.setMuted(before.voice?.muted ?? false);
      if (before.range) this.player.setRange(before.range);
      this.player.setLooping(before.looping);
    }
    this.player?.seek(time);
    this.player?.onChange(() => this.#show());
    if (again) this.player?.play();
    this.#show();
  }

  #buttons(): void {
    const click = (id: string, act: () => void) => byId(id).addEventListener("click", act);
    click("play", () => this.player?.toggle());
    click("home", () => this.player?.seek(this.player.whole.start));
    click("loop", () => this.player?.setLooping(!this.player.looping));
    click("mute", () => this.mute());
    for (const speed of SPEEDS)
      byId("speeds").append(
        h(
          "button",
          {
            type: "button",
            "data-speed": speed,
            "aria-label": `Speed ${speed}`,
            title: `Speed ${speed}`,
            onclick: () => this.player?.setSpeed(speed),
          },
          speed === 1 ? "1×" : String(speed).replace("0.", "."),
        ),
      );
  }

  mute(): void {
    this.player?.setMuted(!this.player.voice?.muted);
  }

  /** Go by frames of a sixtieth of a second. */
  step(frames: number): void {
    if (!this.player) return;
    this.player.pause();
    this.player.seek(Math.round(this.player.time() * 60 + frames) / 60, true);
  }

  #show(): void {
    const { player } = this;
    document.body.classList.toggle("playing", player?.playing ?? false);
    write(byId("play-label"), player?.playing ? "Pause" : "Play");
    byId("loop").ariaPressed = String(player?.looping ?? false);
    byId("mute").ariaPressed = String(player?.voice?.muted ?? false);
    for (const button of byId("speeds").querySelectorAll("button"))
      button.ariaPressed = String(Number(button.dataset["speed"]) === (player?.speed ?? 1));
    this.#changed();
  }

  clock(): void {
    write(byId("clock"), this.player ? clockTime(this.player.time()) : "");
  }
}
