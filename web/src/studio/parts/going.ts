/** The ways from one part of the studio to another. */

import { spanAt } from "../../shared/spans.ts";
import type { Pair } from "../core/session.ts";
import type { EditView } from "../protocol.ts";
import type { Studio } from "../studio.ts";

export class Going {
  #studio: Studio;

  constructor(studio: Studio) {
    this.#studio = studio;
  }

  /** From a pair in the list of the line: to its curves, and to where it sounds. */
  toPair(pair: Pair, time: number): void {
    this.#studio.openPair(pair);
    this.#see(time, true);
  }

  /** From a phone of the line to the pair that begins with it. */
  fromPhone(phone: number): void {
    const { line } = this.#studio.session;
    const index = line?.classes.findIndex((each) => each.phone === phone) ?? -1;
    this.#edit(line?.pairs[index]?.pair ?? line?.pairs[index - 1]?.pair);
  }

  /** From the playhead to the pair that sounds there. */
  fromHere(): void {
    const time = this.#time;
    const pairs = this.#studio.session.line?.pairs ?? [];
    this.#edit(pairs.find(({ first, boundary }) => time >= first && time < boundary)?.pair);
  }

  /** From the playhead to the corrections of the phone there. */
  toCorrect(): void {
    const { canvas, navigator } = this.#studio;
    canvas.choose(spanAt(canvas.phones, this.#time));
    navigator.show("edits");
    document.querySelector<HTMLInputElement>("#edits input[type=range]")?.focus();
  }

  /** From a correction to its phone. */
  toEdit({ start, end, edit }: EditView): void {
    const { canvas, controls, session } = this.#studio;
    const middle = (start + end) / 2;
    this.#see(middle, true);
    controls.choose(edit.pose);
    canvas.choose(spanAt(session.line?.phones ?? [], middle));
  }

  /** From the chosen key to where it acts in the line. */
  toKey(): void {
    const time = this.#studio.panel.timeOfKey(this.#time);
    if (time !== null) this.#see(time, true);
  }

  /** A key is being changed: it is seen on the face, unless its pair is there already. */
  besideKey(): void {
    const { panel, transport } = this.#studio;
    if (transport.player?.playing || panel.isOver(this.#time)) return;
    const time = panel.timeOfKey(this.#time);
    if (time !== null) this.#see(time, false);
  }

  /** From the face to the reasons of what is seen most on it. */
  fromFace(): void {
    const time = this.#time;
    const [strongest] = Object.entries(this.#studio.sampled(time)).sort((a, b) => b[1] - a[1]);
    if (strongest && strongest[1] > 0) void this.#studio.askWhy(strongest[0], time);
  }

  get #time(): number {
    return this.#studio.transport.player?.time() ?? 0;
  }

  #see(time: number, aloud: boolean): void {
    this.#studio.transport.player?.seek(time, aloud);
    this.#studio.canvas.reveal(time, time);
  }

  #edit(pair: Pair | undefined): void {
    if (!pair) return;
    this.#studio.openPair(pair);
    this.#studio.panel.editor.canvas.focus();
  }
}
