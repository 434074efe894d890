/** The studio: its parts are made here, and told of each other. */

import { sample } from "../shared/curves.ts";
import { spanAt } from "../shared/spans.ts";
import type { Peaks } from "../shared/wav.ts";
import { byId, h, icon, put, write } from "./core/dom.ts";
import { dragName, Stream } from "./core/drag.ts";
import { makeSeen } from "./core/layout.ts";
import { Measure } from "./core/measure.ts";
import { nameOf, Session, type Pair } from "./core/session.ts";
import { followTheme, isDark, toggleTheme } from "./core/theme.ts";
import { CurvePanel } from "./curves/panel.ts";
import { offerDraft } from "./dialogs/offer.ts";
import { SaveDialog } from "./dialogs/save.ts";
import { Face } from "./face/face.ts";
import { Versions } from "./face/versions.ts";
import { LineCanvas, type Looks } from "./line/canvas.ts";
import { roomOf } from "./line/rows.ts";
import { Transport } from "./line/transport.ts";
import { Controls } from "./panels/controls.ts";
import { Coverage } from "./panels/coverage.ts";
import { Edits } from "./panels/edits.ts";
import { InLine } from "./panels/in-line.ts";
import { Matrix } from "./panels/matrix.ts";
import { Settings } from "./panels/settings.ts";
import { Sliders } from "./panels/sliders.ts";
import { Tabs } from "./panels/tabs.ts";
import { WhyPanel } from "./panels/why.ts";
import { Going } from "./parts/going.ts";
import { Header } from "./parts/header.ts";
import { Lines } from "./parts/lines.ts";
import { StageButtons } from "./parts/stage-buttons.ts";

/** Milliseconds that a complaint is read. */
const READ = 6000;
/** Milliseconds after which an edge that is moved again is another step of undo. */
const PAUSE = 700;
/** Milliseconds that a running number must stand to be read. */
const LEGIBLE = 90;

export class Studio {
  readonly looks: Looks = {
    hidden: new Set(),
    control: "open",
    on: new Set(),
    figures: false,
    apart: false,
  };
  readonly measure = new Measure();
  readonly session: Session;
  readonly panel: CurvePanel;
  readonly canvas: LineCanvas;
  readonly transport: Transport;
  readonly lines: Lines;
  readonly face: Face;
  readonly versions: Versions;
  readonly header: Header;
  readonly stages: StageButtons;
  readonly controls: Controls;
  readonly why: WhyPanel;
  readonly edits: Edits;
  readonly matrix: Matrix;
  readonly inLine: InLine;
  readonly sliders: Sliders;
  readonly saving: SaveDialog;
  readonly navigator: Tabs;
  readonly inspector: Tabs;
  readonly going = new Going(this);
  #boundaries: Stream;
  #edge = { phone: 0, at: Number.NEGATIVE_INFINITY, merge: "" };
  /** What is done as soon as the pair that was asked for is here. */
  #then: (() => void) | null = null;
  #asked = false;
  #written = 0;
  #hush = 0;

  constructor() {
    const complain = (error: Error) => this.complain(error);
    const dark = () => isDark();
    const touched = () => this.measure.touch();
    const open = (pair: Pair) => this.openPair(pair);
    followTheme(() => this.restyle());
    const session = new Session(complain);
    this.session = session;
    this.#boundaries = new Stream(session);
    this.panel = new CurvePanel(session, {
      say: (words) => this.say(words),
      hear: (pair) => void this.lines.hear(pair),
      touched: () => {
        touched();
        this.going.besideKey();
      },
      see: () => this.going.toKey(),
      dark,
    });
    this.face = new Face(session, complain);
    this.versions = new Versions(session, this.face);
    this.canvas = new LineCanvas(byId<HTMLCanvasElement>("timeline"), this.looks, {
      dragged: (phone, time) => this.#dragEdge(phone, time),
      why: (control, time) => void this.askWhy(control, time),
      phone: (index) => this.#choosePhone(index),
      open: (phone) => this.going.fromPhone(phone),
      moved: () => this.#turned(),
    });
    this.transport = new Transport(session, () => this.#played(), complain);
    const said = () => this.navigator.show("in-line");
    this.lines = new Lines(session, this.transport, said, complain);
    this.stages = new StageButtons(this.looks, this.canvas, () => this.#looksChanged());
    this.controls = new Controls(session, this.looks, () => this.#looksChanged(), dark);
    this.why = new WhyPanel(session, {
      open: (pair, control, keys) => this.openKey(pair, control, keys),
      shown: () => this.canvas.refresh(),
      dark,
      figures: () => this.looks.figures,
      complain,
    });
    this.matrix = new Matrix(session, open, (phone) => this.panel.openPhone(phone));
    this.inLine = new InLine(session, {
      open: (pair, time) => this.going.toPair(pair, time),
      loop: (start, end) => this.lines.loop(start, end),
      seen: () => this.canvas.scale,
    });
    new Coverage(session, open, complain);
    this.edits = new Edits(session, {
      control: () => this.looks.control,
      draw: (place, pose) => {
        this.panel.openEdit(place);
        this.panel.choosePose(pose);
        this.panel.editor.canvas.focus();
      },
      go: (view) => this.going.toEdit(view),
      touched,
    });
    new Settings(session, touched);
    const tried = (channels: Record<string, number> | null) => (this.face.tried = channels);
    this.sliders = new Sliders(session, tried, dark, complain);
    this.saving = new SaveDialog(session, complain);
    this.header = new Header(session, {
      save: () => void this.saving.open(),
      help: () => this.help(),
      theme: () => {
        toggleTheme();
        this.restyle();
      },
      target: () => this.panel.show(),
      complain,
    });
    this.navigator = new Tabs(byId("navigator"), "pairs", () => this.inLine.update());
    this.inspector = new Tabs(byId("inspector"), "controls", () => this.ask());
    offerDraft(session, complain);
    this.#listen();
    this.#watchSizes();
  }

  /** Ask for a new picture, once. */
  ask(): void {
    if (this.#asked) return;
    this.#asked = true;
    requestAnimationFrame(() => {
      this.#asked = false;
      this.transport.player?.update();
      const moving = this.draw();
      this.measure.draw();
      if (moving || this.transport.player?.playing) this.ask();
    });
  }

  /** Draw the present time; returns whether the camera still moves. */
  draw(): boolean {
    const time = this.transport.player?.time() ?? 0;
    this.canvas.draw();
    this.inLine.mark(time);
    this.panel.setPlayhead(time);
    this.#now(time);
    this.#write(time);
    return this.face.draw(time);
  }

  /** Write numbers; while they run, no more often than they can be read. */
  #write(time: number): void {
    const now = performance.now();
    if (this.transport.player?.playing && now - this.#written < LEGIBLE) return;
    this.#written = now;
    this.controls.at(time);
    this.transport.clock();
    write(byId("caption"), this.canvas.caption());
  }

  openPair(pair: Pair): void {
    this.#then = null;
    makeSeen("editor");
    this.panel.openPair(pair);
    this.matrix.choose(pair);
    this.inLine.choose(pair);
  }

  /** Open a pair at the keys that speak at an instant. */
  openKey(pair: Pair, control: string, keys: [number, number][]): void {
    this.openPair(pair);
    const choose = () => {
      this.panel.chooseKeys(control, keys);
      this.panel.editor.canvas.focus();
    };
    if (this.session.pair && nameOf(this.session.pair.pair) === nameOf(pair)) choose();
    else this.#then = choose;
  }

  async askWhy(control: string, time: number): Promise<void> {
    this.controls.choose(control);
    this.canvas.asked = { control, time };
    makeSeen("side");
    this.inspector.show("why");
    await this.why.ask(control, time);
    this.ask();
  }

  whyHere(): void {
    void this.askWhy(this.looks.control, this.transport.player?.time() ?? 0);
  }

  /** Move an edge of the chosen phone: its end, or with `before` −1 its start. */
  nudgeEdge(before: 0 | -1, by: number): void {
    const { canvas } = this;
    if (canvas.chosen === null) return;
    const edge = canvas.chosen + before;
    const from = edge < 0 ? canvas.phones[0].start : canvas.phones[edge].end;
    const [least, most] = roomOf(canvas.phones, edge);
    const to = Math.round(Math.min(Math.max(from + by, least), most) * 1000) / 1000;
    canvas.moveEdge(from, to);
    this.#dragEdge(edge, to);
  }

  toMatrix(): void {
    this.navigator.show("pairs");
    byId("matrix").querySelector<HTMLElement>('[tabindex="0"]')?.focus();
  }

  toText(): void {
    byId<HTMLInputElement>("text").focus();
    byId<HTMLInputElement>("text").select();
  }

  toggleBlink(): void {
    this.face.idle = !this.face.idle;
  }

  help(): void {
    byId<HTMLDialogElement>("help").showModal();
  }

  restyle(): void {
    this.panel.editor.restyle();
    this.panel.show();
    this.canvas.restyle();
    this.controls.make(true);
    this.sliders.make();
    this.stages.show();
    this.header.restyle();
    this.ask();
  }

  /** Words for those who do not see the page. */
  say(words: string): void {
    write(byId("said"), words);
  }

  complain(error: Error): void {
    const place = byId("complaint");
    place.textContent = error.message;
    place.hidden = false;
    clearTimeout(this.#hush);
    this.#hush = window.setTimeout(() => (place.hidden = true), READ);
  }

  /** The line's controls at an instant. */
  sampled(time: number): Record<string, number> {
    const controls = this.session.motion.a?.controls;
    if (!controls) return {};
    const values = sample(controls, time);
    return Object.fromEntries(controls.names.map((name, index) => [name, values[index]]));
  }

  #listen(): void {
    const { session } = this;
    session.on("hello", () => this.#greet());
    session.on("line", () => this.#showLine());
    session.on("peaks", () => this.#showPeaks());
    session.on("pair", () => this.#pairCame());
    session.on("motion", () => {
      const { a, b } = session.motion;
      this.canvas.showMotion(a?.controls ?? null, a?.view ?? null, b?.controls ?? null);
      this.measure.arrive();
      this.ask();
    });
    this.canvas.onChange(() => this.ask());
    this.face.onChange(() => this.ask());
    this.face.onClick(() => this.going.fromFace());
    byId("edit-phone").addEventListener("click", () => this.navigator.show("edits"));
    const hear = byId("hear-word");
    put(hear, icon("sound"), h("span", { class: "hidden" }, "Hear this word, looped"));
    hear.title = "Hear this word, looped";
    put(byId("clear"), icon("reset"));
  }

  #greet(): void {
    const { hello, watched } = this.session;
    if (hello && !watched.pair) {
      const first = hello.cells.find(({ pair }) => nameOf(pair) === "f-ah") ?? hello.cells[0];
      if (first) this.openPair(first.pair);
    }
    this.#looksChanged();
  }

  #pairCame(): void {
    const { pair, watched } = this.session;
    if (!pair || !watched.pair || nameOf(pair.pair) !== nameOf(watched.pair)) return;
    this.#then?.();
    this.#then = null;
  }

  #showLine(): void {
    const show = () => {
      this.canvas.showLine(this.session.line, this.transport.player);
      this.#showPeaks();
      this.lines.loopWaiting();
      this.ask();
    };
    if (!this.session.line) byId("edit-phone").hidden = true;
    void this.transport.show(this.session.line).then(show);
    show();
  }

  #showPeaks(): void {
    const { line, peaks } = this.session;
    const sent = line && peaks.get(line.line);
    const coarse: Peaks | null = sent
      ? { rate: sent.perSecond, block: 1, samples: new Float32Array(), ...sent }
      : null;
    this.canvas.showPeaks(this.transport.peaks ?? coarse);
  }

  #looksChanged(): void {
    const stages = this.stages.needed;
    if (stages.join() !== (this.session.watched.stages ?? []).join())
      this.session.watch({ stages });
    this.canvas.refresh();
    this.ask();
  }

  #watchSizes(): void {
    const { canvas } = this.canvas;
    const fit = () => this.canvas.resize(canvas.clientWidth, canvas.clientHeight);
    new ResizeObserver(fit).observe(canvas);
    fit();
  }

  #played(): void {
    if (this.transport.player?.playing) this.sliders.clear();
    this.canvas.refresh();
    this.ask();
  }

  #turned(): void {
    const { start, end } = this.canvas.scale;
    this.lines.see(start, end);
    this.inLine.turn();
  }

  #now(time: number): void {
    const { line } = this.session;
    const word = line ? (line.words[spanAt(line.words, time)]?.label ?? "") : "";
    const phone = line ? (line.phones[spanAt(line.phones, time)]?.label ?? "") : "";
    const key = `${word} ${phone}`;
    const host = byId("now");
    if (host.dataset["said"] === key) return;
    host.dataset["said"] = key;
    put(host, word, phone && phone !== "sil" ? h("span", {}, `/${phone}/`) : null);
  }

  #dragEdge(phone: number, time: number): void {
    const { line } = this.session;
    if (!line) return;
    this.measure.touch();
    const now = performance.now();
    if (this.#edge.phone !== phone || now - this.#edge.at > PAUSE)
      this.#edge = { phone, at: now, merge: dragName("edge") };
    this.#edge.at = now;
    const change = { type: "moveBoundary" as const, line: line.line, phone, time };
    this.#boundaries.push(change, this.#edge.merge);
  }

  #choosePhone(index: number): void {
    const phone = this.session.line?.phones[index];
    const button = byId("edit-phone");
    this.edits.choose(index);
    button.hidden = !phone || !this.edits.place;
    if (phone) write(button, `Correct /${phone.label}/…`);
  }
}
