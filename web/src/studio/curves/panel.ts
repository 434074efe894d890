/**
 * The panel around the curve editor: which curves are in it (a pair's, a single phone's, or what
 * is drawn anew over one phone of a line), and where its changes go.
 */

import { byId, h, iconButton, put, write } from "../core/dom.ts";
import { dragName, Stream } from "../core/drag.ts";
import { nameOf, type Pair, type Session } from "../core/session.ts";
import type { Change, Edit } from "../protocol.ts";
import { shareAt, timeOf, type Laid } from "./laid.ts";
import { keysOf, listenOn } from "./commands.ts";
import { CurveEditor, type Subject } from "./editor.ts";
import { editOf, editSubject, type PhonePlace } from "./line-edit.ts";
import type { Curves, Key } from "./keys.ts";
import { PoseList } from "./poses.ts";
import { pairSubject, phoneSubject } from "./subjects.ts";
import { KeyStrip } from "./strip.ts";

export type Mode = "pair" | "phone" | "edit";

export interface PanelHooks {
  say(words: string): void;
  hear(pair: Pair): void;
  /** Go to where the chosen key acts in the line. */
  see(): void;
  /** Something was changed here: what is measured from it begins now. */
  touched(): void;
  dark(): boolean;
}

const HOW =
  "Comma and full stop choose keys, arrows move them, Enter types numbers, question mark lists all keys.";

/** Seconds that a pair takes where the line does not have it. */
const USUAL = 0.22;

export class CurvePanel {
  readonly editor: CurveEditor;
  mode: Mode = "pair";
  place: PhonePlace | null = null;
  #session: Session;
  #hooks: PanelHooks;
  #stream: Stream;
  #strip: KeyStrip;
  #poses: PoseList;
  #word = byId<HTMLInputElement>("pair-word");

  constructor(session: Session, hooks: PanelHooks) {
    this.#session = session;
    this.#hooks = hooks;
    this.#stream = new Stream(session);
    this.editor = new CurveEditor(byId<HTMLCanvasElement>("curves"), {
      changed: (names, curves, merge) => this.#changed(names, curves, merge),
      moved: (boundary, merge) => this.#moved(boundary, merge),
      chosen: () => this.#refresh(),
      say: hooks.say,
      drag: () => dragName("keys"),
      enter: () => this.#strip.focus(),
    });
    this.#strip = new KeyStrip(byId("strip"), this.editor);
    this.#poses = new PoseList(
      byId("poses"),
      (name, on) => this.#tick(name, on),
      (name) => this.choosePose(name),
    );
    listenOn(this.editor.canvas, this.keys());
    this.#tools();
    session.on(["pair", "phone", "rules", "line", "motion", "hello"], () => this.show());
    this.#word.addEventListener("change", () => this.#nameWord());
  }

  keys() {
    return keysOf(this.editor, {
      next: (way) => this.#nextPose(way),
      enter: () => this.#strip.focus(),
      see: () => this.#hooks.see(),
    });
  }

  /** Show a pair, as soon as it is here. */
  openPair(pair: Pair): void {
    this.mode = "pair";
    this.#session.watch({ pair, phone: "" });
    this.show();
  }

  openPhone(phone: string): void {
    this.mode = "phone";
    this.#session.watch({ phone });
    this.show();
  }

  openEdit(place: PhonePlace): void {
    this.mode = "edit";
    this.place = place;
    this.show();
  }

  /** Choose the keys of a pose that lie where these do. */
  chooseKeys(pose: string, keys: Key[]): void {
    const own = this.editor.curves[pose] ?? [];
    const lies = ([time, value]: Key) =>
      keys.some(([t, v]) => Math.abs(t - time) < 1e-6 && Math.abs(v - value) < 1e-6);
    this.editor.choose(
      pose,
      own.flatMap((key, index) => (lies(key) ? [index] : [])),
    );
  }

  choosePose(name: string): void {
    this.editor.activate(name);
    this.#refresh();
  }

  /** Show what the server has, unless what is here is newer. */
  show(): void {
    this.#heading();
    if (this.editor.dragging || this.#stream.busy) return;
    this.editor.show(this.#subject());
    this.#refresh();
  }

  /** The pair that is shown lies at this share of itself under the playhead. */
  setPlayhead(time: number): void {
    const share = shareAt(this.#places(), time);
    if (share === this.editor.playhead) return;
    this.editor.playhead = share;
    this.editor.refresh();
  }

  get busy(): boolean {
    return this.#stream.busy;
  }

  #subject(): Subject | null {
    const session = this.#session;
    const view = session.pair;
    if (this.mode === "pair")
      return view && same(view.pair, session.watched.pair)
        ? pairSubject(session, view, this.#duration())
        : null;
    if (this.mode === "phone") return session.phone ? phoneSubject(session, session.phone) : null;
    return this.place ? editSubject(session, this.place) : null;
  }

  #duration(): number {
    const pair = this.#session.watched.pair;
    const here = this.#session.line?.pairs.find((each) => pair && same(each.pair, pair));
    return here ? Math.max(here.last - here.first, 0.02) : USUAL;
  }

  /** Whether what is edited sounds at an instant of the line. */
  isOver(time: number): boolean {
    return shareAt(this.#places(), time) !== null;
  }

  /** When the chosen key acts in the line, nearest to an instant; null where it does not. */
  timeOfKey(near: number): number | null {
    const { editor } = this;
    const [index] = editor.chosen.get(editor.active) ?? [];
    const share = editor.curves[editor.active]?.[index ?? -1]?.[0] ?? 0.5;
    return timeOf(this.#places(), share, near);
  }

  /** Where in the line the curves that are edited are laid. */
  #places(): Laid[] {
    const { line, pair: view, watched } = this.#session;
    if (!line || this.mode === "phone") return [];
    if (this.mode === "edit") {
      const phone = this.place && line.classes[this.place.index];
      if (!phone) return [];
      const { start: first, end: last } = phone;
      return [{ first, boundary: (first + last) / 2, last, mark: 0.5 }];
    }
    const linear = this.#session.setting("warp") === "linear";
    return line.pairs
      .filter((each) => same(each.pair, watched.pair))
      .map(({ first, boundary, last }) => ({
        first,
        boundary,
        last,
        mark: linear ? (boundary - first) / (last - first) : (view?.boundary ?? 0.5),
      }));
  }

  // What is written around it

  #heading(): void {
    const session = this.#session;
    const view = this.mode === "pair" ? session.pair : null;
    document.body.dataset["mode"] = this.mode;
    const [badge, note] = this.#badge();
    write(byId("pair-name"), this.#title());
    this.editor.canvas.ariaLabel = `Curves of ${this.#title()}. ${HOW}`;
    const label = byId("pair-state");
    write(label, badge);
    label.title = note;
    label.className = `badge ${badge.replace(" ", "-")}`;
    if (view && document.activeElement !== this.#word) this.#word.value = view.word;
    const clear = byId<HTMLButtonElement>("clear");
    clear.title = clear.ariaLabel =
      session.target === "overrides"
        ? "Back to the set’s own curves of this pair"
        : "Take this pair out of the set";
    clear.disabled = !(view && (session.target === "overrides" ? view.overrideCurves : true));
    const milliseconds = Math.round(this.#duration() * 1000);
    const found = session.line?.pairs.some(
      (each) => session.watched.pair && same(each.pair, session.watched.pair),
    );
    write(
      byId("as-at"),
      this.mode === "pair" ? `spline at ${milliseconds} ms${found ? ", as in the line" : ""}` : "",
    );
  }

  #title(): string {
    if (this.mode === "phone") return `/${this.#session.phone?.phone ?? ""}/ alone`;
    if (this.mode === "edit" && this.place)
      return `/${this.place.own || this.place.label}/ in “${this.place.word || "silence"}”`;
    const pair = this.#session.watched.pair;
    return pair ? `${pair[0]} – ${pair[1]}` : "";
  }

  #badge(): [string, string] {
    const view = this.#session.pair;
    if (this.mode === "phone") {
      const overridden = this.#session.phone?.overridden ?? false;
      return [overridden ? "override" : "single", "Fills pairs that the set lacks"];
    }
    if (this.mode === "edit") return ["this line", "Drawn over the result of this line only"];
    if (!view) return ["", ""];
    if (view.overrideCurves) return ["override", `Drawn in ${view.source}`];
    if (view.state === "stand-in")
      return ["stands in", "The set lacks this pair: it is made of its two phones' own curves"];
    if (view.state === "no curve") return ["no curve", "Neither the pair nor its phones are drawn"];
    return ["set", `Drawn in the set ${view.source}`];
  }

  #refresh(): void {
    const subject = this.editor.subject;
    const { curves, active } = this.editor;
    const names = this.#session.poseNames();
    const states = names.map((name) => ({
      name,
      on: name in curves,
      active: name === active,
      peak: Math.max(0, ...(curves[name] ?? []).map(([, value]) => value)),
      differs: Boolean(subject?.ghosts[name]) || false,
    }));
    this.#poses.update(states, this.#hooks.dark());
    this.#strip.update();
    write(byId("readout"), this.editor.readout());
  }

  #nextPose(way: 1 | -1): void {
    const names = this.#session.poseNames();
    const next = names[names.indexOf(this.editor.active) + way];
    if (!next) return;
    this.choosePose(next);
    const keys = this.editor.curves[next];
    this.#hooks.say(keys ? `${next}, ${keys.length} keys` : `${next}, no curve`);
  }

  #tools(): void {
    const { editor } = this;
    const snap = iconButton("magnet", "Snap to 0, 1 and the phone boundary", () => {
      editor.snapping = !editor.snapping;
      snap.ariaPressed = String(editor.snapping);
    });
    snap.ariaPressed = "true";
    snap.id = "snap";
    put(
      byId("curve-tools"),
      iconButton("plus", "Add a key", () => editor.insertHere(), "K"),
      iconButton("trash", "Take keys away", () => editor.remove(), "Del"),
      h("span", { class: "gap" }),
      iconButton("mirror", "Mirror in time", () => editor.mirror(), "H"),
      iconButton("copy", "Copy keys or curve", () => editor.copy(), "Ctrl C"),
      iconButton("paste", "Paste", () => editor.paste(), "Ctrl V"),
      h("span", { class: "gap" }),
      snap,
      iconButton("fit", "See all of it", () => editor.fit(), "0"),
    );
    byId("hear-word").addEventListener("click", () => {
      const pair = this.#session.watched.pair;
      if (pair) this.#hooks.hear(pair);
    });
    byId("clear").addEventListener("click", () => this.#clear());
    editor.canvas.addEventListener("pointermove", () => {
      write(byId("readout"), editor.readout());
    });
    editor.canvas.addEventListener("pointerleave", () => write(byId("readout"), ""));
  }

  // Where changes go

  #tick(name: string, on: boolean): void {
    const view = this.#session.pair;
    const middle: Key[] = [
      [0, 0],
      [0.5, 0.5],
      [1, 0],
    ];
    let start: Key[] = middle;
    if (this.mode === "pair") start = view?.starts[name] ?? middle;
    else if (this.mode === "edit") start = this.editor.subject?.ghosts[name] ?? middle;
    this.editor.active = name;
    this.editor.draw(name, on ? start : null);
    this.#hooks.say(on ? `${name} has a curve` : `${name} is taken out`);
  }

  #changed(names: string[], curves: Curves, merge: string): void {
    this.#hooks.touched();
    const drag = merge || dragName("once");
    for (const change of this.#changes(names, curves)) this.#stream.push(change, drag);
    this.#settle();
  }

  #changes(names: string[], curves: Curves): Change[] {
    const { target, watched } = this.#session;
    const [name] = names;
    if (this.mode === "phone") {
      const phone = watched.phone ?? "";
      return names.map((pose) => ({
        type: "drawPhone",
        target,
        phone,
        pose,
        keys: curves[pose] ?? null,
      }));
    }
    if (this.mode === "edit") return this.#edits(names, curves);
    const pair = watched.pair;
    if (!pair) return [];
    if (names.length > 1) return [{ type: "drawPair", target, pair, curves }];
    return [{ type: "drawCurve", target, pair, pose: name, keys: curves[name] ?? null }];
  }

  #edits(names: string[], curves: Curves): Change[] {
    const line = this.#session.line;
    const place = this.place;
    if (!line || !place) return [];
    return names.map((pose) => {
      const edit: Edit = { ...editOf(line, place, pose), keys: curves[pose] ?? null };
      const empty = !edit.keys && edit.gain === 1 && edit.level === null && !edit.hold;
      return { type: empty ? "removeEdit" : "putEdit", line: line.line, edit };
    });
  }

  /** Once all changes have arrived, show what the server made of them. */
  #settle(): void {
    const wait = () => {
      if (this.#stream.busy) setTimeout(wait, 15);
      else this.show();
    };
    wait();
  }

  #moved(boundary: number, merge: string): void {
    const pair = this.#session.watched.pair;
    if (this.mode !== "pair" || !pair) return;
    this.#hooks.touched();
    const target = this.#session.target;
    this.#stream.push({ type: "moveMark", target, pair, boundary }, merge || dragName("mark"));
    this.#settle();
  }

  #nameWord(): void {
    const pair = this.#session.watched.pair;
    const word = this.#word.value.trim();
    if (pair && word && word !== this.#session.pair?.word)
      void this.#session.edit({ type: "nameWord", target: this.#session.target, pair, word });
  }

  #clear(): void {
    const pair = this.#session.watched.pair;
    if (!pair) return;
    void this.#session.edit({ type: "clearPair", target: this.#session.target, pair });
    this.#hooks.say(`${nameOf(pair)} is as it was beneath`);
  }
}

function same(a: readonly string[], b: readonly string[] | null | undefined): boolean {
  return a[0] === b?.[0] && a[1] === b[1];
}
