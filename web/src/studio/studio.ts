/** The studio: its parts are made here, and told of each other. */

import { spanAt } from "../shared/spans.ts";
import { sample } from "../shared/curves.ts";
import type { Peaks } from "../shared/wav.ts";
import { byId, h, icon, iconButton, put, swatch, write } from "./core/dom.ts";
import { dragName, Stream } from "./core/drag.ts";
import { Measure } from "./core/measure.ts";
import { nameOf, Session, type Pair } from "./core/session.ts";
import { followTheme, isDark, toggleTheme } from "./core/theme.ts";
import { CurvePanel } from "./curves/panel.ts";
import { acceptDrops } from "./dialogs/drop.ts";
import { offerDraft } from "./dialogs/offer.ts";
import { RecordingDialog } from "./dialogs/recording.ts";
import { SaveDialog } from "./dialogs/save.ts";
import { Face } from "./face/face.ts";
import { Versions } from "./face/versions.ts";
import { LineCanvas, type Looks } from "./line/canvas.ts";
import { ABOUT, STAGES, stageStroke, type StageName } from "./line/palette.ts";
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
import type { ExampleView, Made } from "./protocol.ts";

/** Lines longer than this are sent by parts. */
const LONG = 40;
const SAID = 6000;

export class Studio {
  readonly session: Session;
  readonly measure = new Measure();
  readonly looks: Looks = {
    hidden: new Set(),
    control: "open",
    on: new Set(),
    figures: false,
    apart: false,
  };
  readonly panel: CurvePanel;
  readonly canvas: LineCanvas;
  readonly transport: Transport;
  readonly face: Face;
  readonly versions: Versions;
  readonly controls: Controls;
  readonly why: WhyPanel;
  readonly saving: SaveDialog;
  readonly edits: Edits;
  readonly matrix: Matrix;
  readonly inLine: InLine;
  readonly sliders: Sliders;
  readonly navigator: Tabs;
  readonly inspector: Tabs;
  #boundaries: Stream;
  #recording: RecordingDialog;
  #asked = false;
  #hush = 0;
  #pendingLoop: { line: string; start: number; end: number } | null = null;
  #turn = 0;
  #fallbackPeaks: Peaks | null = null;

  constructor() {
    const complain = (error: Error) => this.complain(error);
    const dark = () => isDark();
    followTheme(() => this.restyle());
    this.session = new Session(complain);
    const session = this.session;
    this.#boundaries = new Stream(session);
    this.panel = new CurvePanel(session, {
      say: (words) => this.say(words),
      hear: (pair) => void this.hearExample(pair),
      touched: () => this.measure.touch(),
      dark,
    });
    this.face = new Face(session, complain);
    this.versions = new Versions(session, this.face);
    this.canvas = new LineCanvas(byId<HTMLCanvasElement>("timeline"), this.looks, {
      dragged: (phone, time) => this.#dragEdge(phone, time),
      why: (control, time) => void this.askWhy(control, time),
      phone: (index) => this.#choosePhone(index),
      open: (phone) => this.#openPhonePair(phone),
      moved: () => this.#windowMoved(),
    });
    this.transport = new Transport(session, () => this.#played(), complain);
    this.controls = new Controls(session, this.looks, () => this.#looksChanged(), dark);
    this.why = new WhyPanel(session, {
      open: (pair, control, keys) => this.openKey(pair, control, keys),
      shown: () => this.canvas.refresh(),
      dark,
      figures: () => this.looks.figures,
      complain,
    });
    const open = (pair: Pair) => this.openPair(pair);
    this.matrix = new Matrix(session, open, (phone) => this.panel.openPhone(phone));
    this.inLine = new InLine(
      session,
      (pair, time) => {
        this.openPair(pair);
        this.transport.player?.seek(time, true);
        this.canvas.reveal(time, time);
      },
      (start, end) => this.#loop(start, end),
    );
    new Coverage(session, open, complain);
    this.edits = new Edits(session, {
      control: () => this.looks.control,
      draw: (place, pose) => {
        this.panel.openEdit(place);
        this.panel.choosePose(pose);
        this.panel.editor.canvas.focus();
      },
      go: ({ start, end, edit }) => {
        this.transport.player?.seek((start + end) / 2, true);
        this.canvas.reveal(start, end);
        this.controls.choose(edit.pose);
        const phones = session.line?.phones ?? [];
        this.canvas.choosePhone(spanAt(phones, (start + end) / 2));
      },
      touched: () => this.measure.touch(),
    });
    new Settings(session, () => this.measure.touch());
    this.sliders = new Sliders(
      session,
      (channels) => {
        this.face.tried = channels;
        this.ask();
      },
      dark,
      complain,
    );
    this.saving = new SaveDialog(session, complain);
    this.#recording = new RecordingDialog(session, (line) => void this.openLine(line));
    this.navigator = new Tabs(byId("navigator"), "pairs");
    this.inspector = new Tabs(byId("inspector"), "controls");
    offerDraft(session, complain);
    this.#listen();
    this.#buttons();
    this.#stageButtons();
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
    this.controls.at(time);
    this.inLine.mark(time);
    this.panel.setPlayhead(time);
    this.transport.clock();
    write(byId("caption"), this.canvas.caption());
    this.#now(time);
    return this.face.draw(time);
  }

  openPair(pair: Pair): void {
    this.panel.openPair(pair);
    this.matrix.choose(pair);
    this.inLine.choose(pair);
  }

  /** Open a pair at the keys that speak at an instant. */
  openKey(pair: Pair, control: string, keys: [number, number][]): void {
    this.openPair(pair);
    const { editor } = this.panel;
    const choose = () => {
      const own = editor.curves[control] ?? [];
      const indexes = own.flatMap(([time, value], index) =>
        keys.some(([t, v]) => Math.abs(t - time) < 1e-6 && Math.abs(v - value) < 1e-6)
          ? [index]
          : [],
      );
      editor.choose(control, indexes);
      editor.canvas.focus();
    };
    if (this.session.pair && nameOf(this.session.pair.pair) === nameOf(pair)) choose();
    else this.#once = choose;
  }

  #once: (() => void) | null = null;

  async openLine(line: string): Promise<void> {
    this.session.watch({ line, start: 0, end: 0 });
    const own = this.session.lines.find(({ id }) => id === line);
    if (own && own.duration > LONG) this.session.watch({ end: LONG / 2 });
  }

  async sayText(text: string): Promise<void> {
    if (!text.trim()) return;
    try {
      const voice = byId<HTMLSelectElement>("voice").value;
      const ask = { type: "say" as const, text: text.trim(), ...(voice ? { voice } : {}) };
      const { line } = await this.session.ask<Made>(ask);
      await this.openLine(line);
    } catch (error) {
      this.complain(error as Error);
    }
  }

  /** Speak a pair's word, and loop the pair in it. */
  async hearExample(pair: Pair): Promise<void> {
    try {
      const view = await this.session.ask<ExampleView>({ type: "example", pair });
      this.#pendingLoop = { line: view.line, start: view.start, end: view.end };
      if (this.session.watched.line === view.line) void this.#loopExample();
      else await this.openLine(view.line);
    } catch (error) {
      this.complain(error as Error);
    }
  }

  async askWhy(control: string, time: number): Promise<void> {
    this.controls.choose(control);
    this.canvas.asked = { control, time };
    this.inspector.show("why");
    await this.why.ask(control, time);
    this.ask();
  }

  whyHere(): void {
    void this.askWhy(this.looks.control, this.transport.player?.time() ?? 0);
  }

  /** Edit the pair that sounds at the playhead. */
  editHere(): void {
    const time = this.transport.player?.time() ?? 0;
    const pair = this.session.line?.pairs.find(
      ({ first, boundary }) => time >= first && time < boundary,
    );
    if (!pair) return;
    this.openPair(pair.pair);
    this.panel.editor.canvas.focus();
  }

  toMatrix(): void {
    this.navigator.show("pairs");
    byId("matrix").querySelector<HTMLElement>('[tabindex="0"]')?.focus();
  }

  toText(): void {
    byId<HTMLInputElement>("text").focus();
    byId<HTMLInputElement>("text").select();
  }

  toggleLanes(): void {
    this.looks.apart = !this.looks.apart;
    this.#looksChanged();
  }

  toggleBlink(): void {
    this.face.idle = !this.face.idle;
    this.ask();
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
    this.#stageButtons();
    put(
      byId("theme"),
      icon(isDark() ? "sun" : "moon"),
      h("span", { class: "hidden" }, "Light or dark"),
    );
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
    this.#hush = window.setTimeout(() => (place.hidden = true), SAID);
  }

  #listen(): void {
    const { session } = this;
    session.on("online", () => {
      byId("offline").hidden = session.connection.online;
    });
    session.on("hello", () => this.#greet());
    session.on(["hello", "line list"], () => this.#listLines());
    session.on("character", () => this.#listCharacters());
    session.on("history", () => this.#history());
    session.on("line", () => this.#showLine());
    session.on("peaks", () => this.#showPeaks());
    session.on("pair", () => {
      const { pair } = session;
      if (!pair || !this.#once || nameOf(pair.pair) !== nameOf(session.watched.pair as Pair))
        return;
      this.#once();
      this.#once = null;
    });
    session.on("motion", () => {
      const { a } = session.motion;
      this.canvas.showMotion(a?.controls ?? null, a?.view ?? null);
      this.measure.arrive();
      this.ask();
    });
    session.on("progress", () => {
      const { progress } = session;
      write(
        byId("progress"),
        progress ? `${progress.what} ${Math.round(100 * progress.share)} %` : "",
      );
    });
    this.canvas.onChange(() => this.ask());
    this.face.onChange(() => this.ask());
    acceptDrops({
      model: (file) => void this.#sendModel(file),
      sound: (files) => this.#recording.open(files),
    });
  }

  async #sendModel(file: File): Promise<void> {
    try {
      const name = await this.session.connection.send("models", file);
      await this.session.ask({ type: "character", name });
    } catch (error) {
      this.complain(error as Error);
    }
  }

  #greet(): void {
    const { hello } = this.session;
    if (!hello) return;
    write(byId("set-name"), `set ${hello.setName}`);
    byId("set-name").title = hello.setAbout;
    document.title = `${hello.setName} – Lipwright studio`;
    byId<HTMLSelectElement>("target").value = this.session.target;
    this.#listCharacters();
    const voices = byId<HTMLSelectElement>("voice");
    if (voices.options.length !== hello.voices.length)
      put(voices, ...hello.voices.map((voice) => h("option", {}, voice)));
    if (!voices.value && hello.voices.includes("en-us")) voices.value = "en-us";
    voices.hidden = hello.voices.length < 2;
    if (!this.session.watched.pair) {
      const first = hello.cells.find(({ pair }) => nameOf(pair) === "f-ah") ?? hello.cells[0];
      if (first) this.openPair(first.pair);
    }
    this.#looksChanged();
  }

  #listCharacters(): void {
    const { hello, character } = this.session;
    const now = character.a;
    if (!hello || !now) return;
    const select = byId<HTMLSelectElement>("character");
    const title = (name: string) => (name === now.name ? now.title || name : name);
    const names = [...new Set([now.name, ...hello.characters])];
    put(select, ...names.map((name) => h("option", { value: name }, title(name))));
    select.value = now.name;
    select.title = now.notes.join("\n");
  }

  #listLines(): void {
    const { lines, watched } = this.session;
    const select = byId<HTMLSelectElement>("line");
    put(
      select,
      ...lines.map(({ id, title }) => h("option", { value: id }, title)),
      lines.length ? null : h("option", { value: "" }, "no line yet"),
    );
    select.value = watched.line ?? "";
    select.disabled = !lines.length;
    byId("remove-line").hidden = !lines.length;
    if (watched.line && !lines.some(({ id }) => id === watched.line))
      this.session.watch({ line: "" });
    if (!watched.line && lines.length) void this.openLine(lines[0].id);
  }

  #showLine(): void {
    const { line } = this.session;
    byId<HTMLSelectElement>("line").value = line?.line ?? "";
    void this.transport.show(line).then(() => this.#ready());
    this.#ready();
    const text = byId<HTMLInputElement>("text");
    if (line?.text && document.activeElement !== text) text.value = line.text;
  }

  #ready(): void {
    this.canvas.showLine(this.session.line, this.transport.player);
    this.#showPeaks();
    void this.#loopExample();
    this.ask();
  }

  async #loopExample(): Promise<void> {
    const loop = this.#pendingLoop;
    const player = this.transport.player;
    if (!loop || !player || this.session.line?.line !== loop.line || !player.voice) return;
    this.#pendingLoop = null;
    this.#loop(loop.start, loop.end);
  }

  #loop(start: number, end: number): void {
    this.transport.player?.setRange({ start, end });
    this.transport.player?.play();
  }

  #showPeaks(): void {
    const { line } = this.session;
    const sent = line && this.session.peaks.get(line.line);
    this.#fallbackPeaks = sent
      ? { rate: sent.perSecond, block: 1, samples: new Float32Array(), ...sent }
      : null;
    this.canvas.showPeaks(this.transport.peaks ?? this.#fallbackPeaks);
  }

  #history(): void {
    const { undo, redo, undoSteps } = this.session.history;
    const set = (id: string, words: string, name: string, keys: string) => {
      const button = byId<HTMLButtonElement>(id);
      button.disabled = !words;
      button.title = words ? `${name}: ${words} (${keys})` : name;
    };
    set("undo", undo, "Undo", "Ctrl Z");
    set("redo", redo, "Do again", "Ctrl Shift Z");
    byId("undo").dataset["steps"] = String(undoSteps);
  }

  #buttons(): void {
    const click = (id: string, act: () => void) => byId(id).addEventListener("click", act);
    const named = (id: string, shape: string, words: string) =>
      put(byId(id), icon(shape), h("span", { class: "hidden" }, words));
    named("undo", "undo", "Undo");
    named("redo", "redo", "Do again");
    named("theme", isDark() ? "sun" : "moon", "Light or dark");
    named("hear-word", "sound", "Hear this word, looped");
    byId("hear-word").title = "Hear this word, looped";
    put(byId("clear"), icon("reset"));
    click("undo", () => this.session.undo());
    click("redo", () => this.session.redo());
    click("save", () => void this.saving.open());
    click("theme", () => {
      toggleTheme();
      this.restyle();
    });
    click("keys", () => this.help());
    click("open-sound", () => this.#recording.pick());
    put(byId("remove-line"), icon("close"), h("span", { class: "hidden" }, "Take this line away"));
    byId("remove-line").title = "Take this line away";
    click("remove-line", () => {
      const { line } = this.session.watched;
      if (line) void this.session.edit({ type: "removeLine", line });
    });
    click("edit-phone", () => this.navigator.show("edits"));
    byId<HTMLFormElement>("say").addEventListener("submit", (event) => {
      event.preventDefault();
      void this.sayText(byId<HTMLInputElement>("text").value);
      byId("text").blur();
    });
    const select = (id: string, act: (value: string) => void) => {
      const element = byId<HTMLSelectElement>(id);
      element.addEventListener("change", () => {
        act(element.value);
        element.blur();
      });
    };
    select("line", (line) => void this.openLine(line));
    select("target", (target) => {
      this.session.target = target as "overrides" | "set";
      this.panel.show();
    });
    select("character", (name) => {
      this.session.ask({ type: "character", name }).catch((error) => this.complain(error));
    });
    put(
      byId("view-tools"),
      iconButton("lanes", "Curves apart, or together", () => this.toggleLanes(), "G"),
      iconButton("minus", "Zoom out", () => this.canvas.zoom(1.25), "−"),
      iconButton("plus", "Zoom in", () => this.canvas.zoom(0.8), "+"),
      iconButton("fit", "Show all of the line", () => this.canvas.fit(), "0"),
    );
  }

  #stageButtons(): void {
    const buttons = STAGES.map((name) => {
      const { colour, dash } = stageStroke(name, isDark(), this.looks.figures);
      return h(
        "button",
        {
          type: "button",
          title: `${name}: ${ABOUT[name]}`,
          "aria-pressed": String(this.looks.on.has(name)),
          onclick: () => this.toggleStage(name),
        },
        swatch(colour, dash),
        name,
      );
    });
    const figures = h(
      "button",
      {
        type: "button",
        title: "Colours of the publication's figures, or ones that all eyes tell apart",
        "aria-pressed": String(this.looks.figures),
        "aria-label": "Colours of the publication",
        onclick: () => {
          this.looks.figures = !this.looks.figures;
          this.#stageButtons();
          this.#looksChanged();
        },
      },
      "◐",
    );
    put(byId("stages"), ...buttons, figures);
  }

  toggleStage(name: StageName): void {
    const { on } = this.looks;
    if (!on.delete(name)) on.add(name);
    this.#stageButtons();
    this.#looksChanged();
  }

  #looksChanged(): void {
    const stages = STAGES.filter(
      (name) => this.looks.on.has(name) || (name === "placed" && this.looks.on.has("stitched")),
    );
    const watched = this.session.watched.stages ?? [];
    if (stages.join() !== watched.join()) this.session.watch({ stages });
    this.canvas?.refresh();
    this.ask();
  }

  #watchSizes(): void {
    const canvas = this.canvas.canvas;
    const fit = () => this.canvas.resize(canvas.clientWidth, canvas.clientHeight);
    new ResizeObserver(fit).observe(canvas);
    fit();
  }

  #played(): void {
    if (this.transport?.player?.playing) this.sliders?.clear();
    this.canvas?.refresh();
    this.ask();
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

  #edge = { phone: 0, merge: "" };

  #dragEdge(phone: number, time: number): void {
    const { line } = this.session;
    if (!line) return;
    this.measure.touch();
    if (this.#edge.phone !== phone || !this.#edge.merge)
      this.#edge = { phone, merge: dragName("edge") };
    this.#boundaries.push({ type: "moveBoundary", line: line.line, phone, time }, this.#edge.merge);
    if (!this.canvas.dragging) this.#edge.merge = "";
  }

  #choosePhone(index: number): void {
    const { line } = this.session;
    const phone = line?.phones[index];
    const button = byId("edit-phone");
    this.edits.choose(index);
    button.hidden = !phone || !this.edits.place;
    if (phone) write(button, `Correct /${phone.label}/…`);
  }

  /** Open the pair that begins with a phone. */
  #openPhonePair(phone: number): void {
    const { line } = this.session;
    const index = line?.classes.findIndex((each) => each.phone === phone) ?? -1;
    const pair = line?.pairs[index] ?? line?.pairs[index - 1];
    if (!pair) return;
    this.openPair(pair.pair);
    this.panel.editor.canvas.focus();
  }

  /** Of a long line only what is seen is asked for, a moment after it has moved. */
  #windowMoved(): void {
    const { line, watched } = this.session;
    if (!line || line.duration <= LONG) return;
    clearTimeout(this.#turn);
    this.#turn = window.setTimeout(() => {
      const { start, end } = this.canvas.scale;
      if (watched.start !== start || watched.end !== end) this.session.watch({ start, end });
    }, 60);
  }

  /** The line's controls at an instant. */
  sampled(time: number): Record<string, number> {
    const controls = this.session.motion.a?.controls;
    if (!controls) return {};
    const values = sample(controls, time);
    return Object.fromEntries(controls.names.map((name, index) => [name, values[index]]));
  }
}
