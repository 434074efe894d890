/** A recording becomes a line: with its words, with labels, or by ear alone. */

import { byId, h, put } from "../core/dom.ts";
import type { Session } from "../core/session.ts";
import type { Made } from "../protocol.ts";

const SOUNDS = ".wav,.flac,.ogg,.opus,.mp3,.aiff,.aif,.m4a,.mp4";
const LABELS = /\.(textgrid|lab|ctm|phn|txt|json)$/i;

export class RecordingDialog {
  #session: Session;
  #dialog = byId<HTMLDialogElement>("hearing");
  #made: (line: string) => void;

  constructor(session: Session, made: (line: string) => void) {
    this.#session = session;
    this.#made = made;
  }

  /** Ask for a sound file, then for what is said in it. */
  pick(): void {
    const input = h("input", { type: "file", accept: SOUNDS });
    input.addEventListener("change", () => {
      const file = input.files?.[0];
      if (file) void this.open([file]);
    });
    input.click();
  }

  open(files: File[]): void {
    const sound = files.find(({ name }) => !LABELS.test(name));
    if (!sound) return;
    const labels = files.find(({ name }) => LABELS.test(name)) ?? null;
    const text = h("input", {
      id: "hear-text",
      placeholder: "empty: the words are recognised (English)",
    });
    const language = h("input", { value: "en", id: "hear-language" });
    const byEar = h("input", { type: "checkbox" });
    const title = "Its corrections stay: those that find their phone act, others are listed";
    const instead = h("input", { type: "checkbox", id: "hear-instead", title });
    const shown = this.#session.line;
    const said = h("p", { role: "status" });
    const picked = h("input", { type: "file", accept: ".TextGrid,.lab,.ctm,.phn,.txt,.json" });
    const make = h("button", { type: "submit", class: "primary" }, "Make a line of it");
    const row = (words: string, field: Node) =>
      h("label", { class: "form-row" }, h("span", {}, words), field);
    const form = h(
      "form",
      { id: "hear-form" },
      row("what is said", text),
      row("language", language),
      row("phones by ear", byEar),
      row("labels", labels ? h("span", {}, labels.name) : picked),
      shown ? row(`in place of “${shown.title}”`, instead) : null,
      said,
      h("div", { class: "actions" }, make),
    );
    form.addEventListener("submit", async (event) => {
      event.preventDefault();
      make.disabled = true;
      said.textContent = "listening…";
      try {
        const chosen = labels ?? picked.files?.[0] ?? null;
        const key = await this.#session.connection.send("sounds", sound);
        const answer = await this.#session.ask<Made>({
          type: "hear",
          sound: key,
          title: sound.name,
          text: text.value.trim(),
          labels: chosen ? await chosen.text() : "",
          labelsName: chosen?.name ?? "",
          language: language.value.trim(),
          byEar: byEar.checked,
          line: instead.checked && shown ? shown.line : "",
        });
        this.#dialog.close();
        this.#made(answer.line);
      } catch (error) {
        said.textContent = (error as Error).message;
        make.disabled = false;
      }
    });
    put(
      this.#dialog,
      h(
        "form",
        { method: "dialog" },
        h("h2", { id: "hearing-title" }, sound.name),
        h("button", { class: "quiet icon", title: "Close (Esc)" }, "✕"),
      ),
      form,
    );
    this.#dialog.showModal();
    text.focus();
  }
}
