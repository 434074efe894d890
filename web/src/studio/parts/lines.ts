/** Which line is shown: the list, the field to type in, recordings and models that are dropped. */

import { byId, h, icon, put } from "../core/dom.ts";
import type { Pair, Session } from "../core/session.ts";
import { acceptDrops } from "../dialogs/drop.ts";
import { RecordingDialog } from "../dialogs/recording.ts";
import type { Transport } from "../line/transport.ts";
import type { ExampleView, Made } from "../protocol.ts";

/** Lines longer than this, in seconds, are sent by parts. */
const LONG = 40;
/** Milliseconds after which a part is asked for that has come into view. */
const PAUSE = 60;

export class Lines {
  #session: Session;
  #transport: Transport;
  #recording: RecordingDialog;
  #said: () => void;
  #complain: (error: Error) => void;
  /** What is to be looped as soon as its line is here. */
  #waiting: { line: string; start: number; end: number } | null = null;
  /** The line of an example: it is in no list. */
  #example: string | null = null;
  #turn = 0;

  /** `said` is called when a line has been made here. */
  constructor(
    session: Session,
    transport: Transport,
    said: () => void,
    complain: (error: Error) => void,
  ) {
    this.#session = session;
    this.#said = said;
    this.#transport = transport;
    this.#complain = complain;
    this.#recording = new RecordingDialog(session, (line) => {
      this.open(line);
      said();
    });
    session.on("hello", () => this.#voices());
    session.on(["hello", "line list"], () => this.#list());
    session.on("line", () => this.#show());
    this.#buttons();
    acceptDrops({
      model: (file) => void this.#sendModel(file),
      sound: (files) => void this.#recording.open(files),
    });
  }

  open(line: string): void {
    const duration = this.#session.lines.find(({ id }) => id === line)?.duration ?? 0;
    this.#session.watch({ line, start: 0, end: duration > LONG ? LONG / 2 : 0 });
  }

  /** Speak a text as a new line, or in place of the one that is shown. */
  async say(text: string, instead = false): Promise<void> {
    if (!text.trim()) return;
    const own = instead ? (this.#session.watched.line ?? "") : "";
    const voice = byId<HTMLSelectElement>("voice").value;
    try {
      const words = { text: text.trim(), line: own, ...(voice ? { voice } : {}) };
      const ask = { type: "say" as const, ...words };
      const { line } = await this.#session.ask<Made>(ask);
      this.open(line);
      this.#said();
    } catch (error) {
      this.#complain(error as Error);
    }
  }

  /** Speak a pair's word, and loop the pair in it. */
  async hear(pair: Pair): Promise<void> {
    try {
      const view = await this.#session.ask<ExampleView>({ type: "example", pair });
      this.#example = view.line;
      this.#waiting = { line: view.line, start: view.start, end: view.end };
      if (this.#session.watched.line === view.line) this.loopWaiting();
      else this.open(view.line);
    } catch (error) {
      this.#complain(error as Error);
    }
  }

  /** Loop the example that was asked for, once its sound is here. */
  loopWaiting(): void {
    const loop = this.#waiting;
    const { player } = this.#transport;
    if (!loop || !player?.voice || this.#session.line?.line !== loop.line) return;
    this.#waiting = null;
    this.loop(loop.start, loop.end);
  }

  loop(start: number, end: number): void {
    this.#transport.player?.setRange({ start, end });
    this.#transport.player?.play();
  }

  /** Of a long line only what is seen is asked for, a moment after it has moved. */
  see(start: number, end: number): void {
    const { line } = this.#session;
    if (!line || line.duration <= LONG) return;
    clearTimeout(this.#turn);
    this.#turn = window.setTimeout(() => {
      const { watched } = this.#session;
      if (watched.start !== start || watched.end !== end) this.#session.watch({ start, end });
    }, PAUSE);
  }

  #voices(): void {
    const voices = this.#session.hello?.voices ?? [];
    const select = byId<HTMLSelectElement>("voice");
    select.hidden = voices.length < 2;
    if (select.options.length === voices.length) return;
    put(select, ...voices.map((voice) => h("option", {}, voice)));
    if (voices.includes("en-us")) select.value = "en-us";
  }

  #list(): void {
    const { lines, watched } = this.#session;
    const select = byId<HTMLSelectElement>("line");
    const none = h("option", { value: "" }, "no line yet");
    put(select, ...lines.map(({ id, title }) => h("option", { value: id }, title)));
    if (!lines.length) put(select, none);
    select.disabled = !lines.length;
    byId("remove-line").hidden = !lines.length;
    const known = watched.line === this.#example || lines.some(({ id }) => id === watched.line);
    if (!known) this.open(lines[0]?.id ?? "");
    select.value = this.#session.watched.line ?? "";
  }

  #show(): void {
    const { line } = this.#session;
    const select = byId<HTMLSelectElement>("line");
    select.querySelector("[data-example]")?.remove();
    if (line && line.line === this.#example)
      select.append(
        h("option", { value: line.line, "data-example": "" }, `example: ${line.title}`),
      );
    select.value = line?.line ?? "";
    const text = byId<HTMLInputElement>("text");
    if (line?.text && document.activeElement !== text) text.value = line.text;
    this.#offerInstead();
  }

  /** Another text may be said in place of the line. */
  #offerInstead(): void {
    const { line } = this.#session;
    const text = byId<HTMLInputElement>("text").value.trim();
    byId("say-instead").hidden = !line || line.line === this.#example || text === line.text;
  }

  #buttons(): void {
    const remove = byId("remove-line");
    put(remove, icon("close"), h("span", { class: "hidden" }, "Take this line away"));
    remove.title = "Take this line away";
    remove.addEventListener("click", () => {
      const { line } = this.#session.watched;
      if (line) void this.#session.edit({ type: "removeLine", line });
    });
    byId("open-sound").addEventListener("click", () => this.#recording.pick());
    byId<HTMLFormElement>("say").addEventListener("submit", (event) => {
      event.preventDefault();
      void this.say(byId<HTMLInputElement>("text").value);
      byId("text").blur();
    });
    const field = byId<HTMLInputElement>("text");
    const instead = () => {
      void this.say(field.value, true);
      field.blur();
    };
    byId("say-instead").addEventListener("click", instead);
    field.addEventListener("input", () => this.#offerInstead());
    field.addEventListener("keydown", (event) => {
      if (event.key === "Escape") field.blur();
      else if (event.key === "Enter" && event.shiftKey) {
        event.preventDefault();
        instead();
      }
    });
    const select = byId<HTMLSelectElement>("line");
    select.addEventListener("change", () => {
      this.open(select.value);
      select.blur();
    });
  }

  async #sendModel(file: File): Promise<void> {
    try {
      const name = await this.#session.connection.send("models", file);
      await this.#session.ask({ type: "character", name });
    } catch (error) {
      this.#complain(error as Error);
    }
  }
}
