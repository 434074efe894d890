/** Corrections of one line: of the phone that is chosen, and all that there are. */

import { byId, h, iconButton, put } from "../core/dom.ts";
import { dragName, Stream } from "../core/drag.ts";
import type { Session } from "../core/session.ts";
import { editOf, placeOf, type PhonePlace } from "../curves/line-edit.ts";
import type { Edit, EditView } from "../protocol.ts";

interface Hooks {
  control(): string;
  draw(place: PhonePlace, pose: string): void;
  go(view: EditView): void;
  touched(): void;
}

const NUMBERS = [
  {
    field: "gain",
    words: "times",
    least: 0,
    most: 2,
    step: 0.05,
    about: "its curves here, multiplied",
  },
  {
    field: "level",
    words: "reaches",
    least: 0,
    most: 1,
    step: 0.01,
    about: "a weight in the middle",
  },
  {
    field: "hold",
    words: "held",
    least: 0,
    most: 0.2,
    step: 0.005,
    about: "seconds longer on both sides",
  },
] as const;

export class Edits {
  #session: Session;
  #hooks: Hooks;
  #stream: Stream;
  #host = byId("edits");
  #chosen = h("div");
  #list = h("div");
  #place: PhonePlace | null = null;
  #pose = "";

  constructor(session: Session, hooks: Hooks) {
    this.#session = session;
    this.#hooks = hooks;
    this.#stream = new Stream(session);
    put(this.#host, this.#chosen, this.#list);
    session.on(["line", "line list"], () => this.update());
    session.on("motion", () => this.#count());
    this.update();
  }

  /** Offer corrections of a phone, by its number in the line. */
  choose(phone: number, pose = this.#hooks.control()): void {
    const line = this.#session.line;
    const index = line?.classes.findIndex((each) => each.phone === phone) ?? -1;
    this.#place = line && index >= 0 ? placeOf(line, index) : null;
    this.#pose = pose || this.#session.poseNames()[0];
    this.update();
  }

  get place(): PhonePlace | null {
    return this.#place;
  }

  update(): void {
    if (!this.#host.contains(document.activeElement) || !this.#stream.busy) this.#offer();
    this.#count();
    const line = this.#session.line;
    const edits = line?.edits ?? [];
    const lost = edits.filter((edit) => edit.lost);
    const found = edits.filter((edit) => !edit.lost);
    put(
      this.#list,
      lost.length ? h("p", { class: "section lost" }, "Found no phone in this line") : null,
      h("ul", { class: "list" }, ...lost.map((view) => this.#item(view))),
      found.length ? h("p", { class: "section" }, "Corrections of this line") : null,
      h("ul", { class: "list" }, ...found.map((view) => this.#item(view))),
    );
  }

  #count(): void {
    const edits = this.#session.line?.edits ?? [];
    const lost = edits.filter((edit) => edit.lost).length;
    const count = h("span", { class: lost ? "count bad" : "count" }, `${lost || edits.length}`);
    put(byId("tab-edits"), "Edits", edits.length ? count : null);
  }

  #offer(): void {
    const line = this.#session.line;
    const place = this.#place;
    if (!line || !place) {
      const words = line
        ? "Choose a phone in the line below to make its pose stronger, hold it, or draw it anew here only."
        : "Corrections hang on words and phones, not on seconds: they outlive a new recording.";
      return put(this.#chosen, h("p", { class: "empty" }, words));
    }
    const edit = editOf(line, place, this.#pose);
    const poses = h("select", { "aria-label": "Pose to correct" });
    for (const name of this.#session.poseNames())
      poses.append(h("option", { value: name, selected: name === this.#pose }, name));
    poses.addEventListener("change", () => {
      this.#pose = poses.value;
      this.#offer();
    });
    const draw = h(
      "button",
      { type: "button", onclick: () => this.#hooks.draw(place, this.#pose) },
      edit.keys ? "Its curve…" : "Draw anew…",
    );
    put(
      this.#chosen,
      h(
        "p",
        { class: "section" },
        `/${place.own || place.label}/ in “${place.word}”, in this line only`,
      ),
      h("div", { class: "ask" }, poses, draw),
      ...NUMBERS.map((number) => this.#number(place, edit, number)),
      edit.keys ? this.#unlocked(edit) : null,
    );
  }

  #number(
    place: PhonePlace,
    edit: Edit,
    { field, words, least, most, step, about }: (typeof NUMBERS)[number],
  ): HTMLElement {
    const nothing = field === "gain" ? 1 : field === "hold" ? 0 : null;
    const now = edit[field] ?? nothing;
    const said = h("output", {}, now === null ? "–" : String(now));
    const input = h("input", {
      type: "range",
      min: least,
      max: most,
      step,
      value: now ?? 0.5,
      "aria-label": `${words}: ${about}`,
      title: about,
    });
    let drag = dragName(field);
    input.addEventListener("input", () => {
      said.textContent = input.value;
      this.#put(place, { [field]: Number(input.value) }, drag);
    });
    input.addEventListener("change", () => {
      drag = dragName(field);
    });
    const back = iconButton("reset", `${words}: as it was`, () => {
      this.#put(place, { [field]: nothing }, dragName(field));
    });
    back.disabled = now === nothing;
    const row = h("div", { class: "slider edit-slider" }, h("span", {}, words), input, said, back);
    return row;
  }

  #unlocked(edit: Edit): HTMLElement {
    const tick = h("input", { type: "checkbox" });
    tick.checked = edit.unlocked ?? false;
    tick.addEventListener("change", () => {
      const change = { ...edit, unlocked: tick.checked };
      const line = this.#session.line?.line ?? "";
      void this.#session.edit({ type: "putEdit", line, edit: change });
    });
    return h(
      "label",
      { class: "hint", title: "Poses that exclude each other do not bound it" },
      tick,
      " leave its curve as drawn, whatever else is there",
    );
  }

  #put(place: PhonePlace, part: Partial<Edit>, drag: string): void {
    const line = this.#session.line;
    if (!line) return;
    this.#hooks.touched();
    const edit = { ...editOf(line, place, this.#pose), ...part };
    const empty = edit.gain === 1 && edit.level === null && !edit.hold && !edit.keys;
    this.#stream.push({ type: empty ? "removeEdit" : "putEdit", line: line.line, edit }, drag);
  }

  #item(view: EditView): HTMLElement {
    const { edit, lost } = view;
    const words = [
      edit.gain !== undefined && edit.gain !== 1 ? `× ${edit.gain}` : "",
      edit.level !== null && edit.level !== undefined ? `to ${edit.level}` : "",
      edit.hold ? `held ${Math.round(1000 * edit.hold)} ms` : "",
      edit.keys ? "drawn" : "",
      edit.unlocked ? "unlocked" : "",
    ];
    const line = this.#session.line?.line ?? "";
    return h(
      "li",
      { class: lost ? "lost" : "" },
      h(
        "button",
        { type: "button", disabled: lost, onclick: () => this.#hooks.go(view) },
        h("span", { class: "pair" }, edit.pose),
        h("span", { class: "word" }, `${edit.label || edit.phone} in “${edit.word}”`),
        h("span", { class: "number" }, words.filter(Boolean).join(", ")),
      ),
      iconButton("close", `Take away: ${view.name}`, () => {
        void this.#session.edit({ type: "removeEdit", line, edit });
      }),
    );
  }
}
