/** The page: its parts are made here, and told of each other. */

import "./style.css";
import { publish, type Parts } from "./api.ts";
import { peaks, sample } from "./curves.ts";
import { block, fromBase64, performanceOf, wholeOf, type Performance } from "./document.ts";
import { clockTime } from "./format.ts";
import { blink } from "./idle.ts";
import { describe, listen, type Key } from "./keyboard.ts";
import { Legend } from "./legend.ts";
import { loadModel, type Model } from "./model.ts";
import { notes, summary } from "./notes.ts";
import { Player } from "./player.ts";
import { middle, neighbour, spanAt } from "./spans.ts";
import { Stage, VIEWS } from "./stage.ts";
import { Timeline, type Shown } from "./timeline.ts";
import { Voice } from "./voice.ts";
import { peaksOf, readWav } from "./wav.ts";

const SPEEDS = [0.25, 0.5, 0.75, 1];
const LIDS = ["eyeBlinkLeft", "eyeBlinkRight"];

const element = <Kind extends HTMLElement>(id: string) => document.getElementById(id) as Kind;
const performed = performanceOf(JSON.parse(block("performance")));
const wav = block("sound");
const sound = wav ? readWav(fromBase64(wav)) : null;
const whole = wholeOf(performed, sound ? sound.samples.length / sound.rate : 0);
const player = new Player(whole, sound && new Voice(sound, whole));
const shown: Shown = { hidden: new Set(), highlighted: null };
const timeline = new Timeline(
  element<HTMLCanvasElement>("timeline"),
  performed,
  player,
  sound && peaksOf(sound),
  shown,
);
const legend = new Legend(element("legend"), element("all"), performed.controls, shown, timeline);
let stage: Stage | null = null;
let model: Model | null = null;
let idle = true;
let asked = false;

publish(load(), player);
writeTexts(performed);
addTransport();
addKeys();
watch();

async function load(): Promise<Parts> {
  try {
    const loaded = await loadModel(fromBase64(block("model")), performed.content.backwards);
    const highest = peaks(performed.channels);
    const used = performed.channels.names.filter((_, index) => highest[index] > 0);
    const made = new Stage(element<HTMLCanvasElement>("head"), loaded, used);
    model = loaded;
    stage = made;
    made.onChange(ask);
    made.onChange(showView);
    addViews(made);
    element("blink").hidden = !LIDS.some((lid) => loaded.has(lid));
    const box = element("stage");
    new ResizeObserver(() => made.resize(box.clientWidth, box.clientHeight)).observe(box);
    made.resize(box.clientWidth, box.clientHeight);
    made.setView("three-quarter");
    draw();
    return { player, stage: made, model: loaded, draw, setIdle };
  } catch (error) {
    const problem = element("problem");
    const reason = error instanceof Error ? error.message : String(error);
    problem.textContent = `The model cannot be shown: ${reason}`;
    problem.hidden = false;
    throw error;
  }
}

/** Ask for a new picture, once. */
function ask(): void {
  if (asked) return;
  asked = true;
  requestAnimationFrame(() => {
    asked = false;
    player.update();
    if (draw() || player.playing) ask();
  });
}

/** Draw the present time; returns whether something is still moving of itself. */
function draw(): boolean {
  const time = player.time();
  pose(time);
  legend.update(time);
  timeline.draw();
  const { words, phones, controls } = performed;
  const phone = phones[spanAt(phones, time)]?.label ?? "";
  element("now-word").textContent = words[spanAt(words, time)]?.label ?? "";
  element("now-phone").textContent = phone === "sil" ? "" : phone;
  const frame = Math.round((time - controls.start) * controls.rate);
  element("clock").firstChild!.nodeValue = clockTime(time);
  element("clock").lastElementChild!.textContent = `frame ${frame}`;
  element("caption").textContent = timeline.caption();
  return stage?.draw() ?? false;
}

function pose(time: number): void {
  if (!model) return;
  const { channels } = performed;
  sample(channels, time).forEach((weight, index) => model?.set(channels.names[index], weight));
  const lids = idle ? blink(time) : 0;
  for (const lid of LIDS) if (!channels.names.includes(lid)) model.set(lid, lids);
}

function setIdle(on: boolean): void {
  idle = on;
  element("blink").ariaPressed = String(on);
  ask();
}

function writeTexts(performance: Performance): void {
  const { content } = performance;
  element("title").textContent = content.text || content.model;
  document.title = `${content.text || content.model} – Lipwright`;
  element("title").title = content.text;
  const { made, noted } = summary(performance);
  const about = element("about");
  about.append(made || "How this was made");
  if (noted) {
    const mark = document.createElement("span");
    mark.className = "noted";
    mark.textContent = noted;
    about.append(" · ", mark);
  }
  about.addEventListener("click", () => element<HTMLDialogElement>("notes").showModal());
  for (const [name, words] of notes(performance, whole.end - whole.start)) {
    const term = document.createElement("dt");
    term.textContent = name;
    const words_ = document.createElement("dd");
    words_.textContent = words;
    element("note-list").append(term, words_);
  }
  element("clock").append("", document.createElement("small"));
  const slider = element("timeline");
  slider.ariaValueMin = whole.start.toFixed(3);
  slider.ariaValueMax = whole.end.toFixed(3);
}

function addViews(made: Stage): void {
  Object.entries(VIEWS).forEach(([name, { label }], index) => {
    const button = segment(label, `${label} (${index + 1})`, () => made.setView(name, true));
    button.dataset["view"] = name;
    element("views").append(button);
  });
}

function showView(): void {
  for (const button of element("views").querySelectorAll("button"))
    button.ariaPressed = String(button.dataset["view"] === stage?.view);
}

function addTransport(): void {
  const click = (id: string, act: () => void) => element(id).addEventListener("click", act);
  click("play", () => player.toggle());
  click("home", () => player.seek(whole.start));
  click("back", () => step(-1));
  click("on", () => step(1));
  click("loop", () => player.setLooping(!player.looping));
  click("mute", toggleMute);
  click("all", () => legend.toggleAll());
  click("blink", () => setIdle(!idle));
  click("keys", help);
  for (const speed of SPEEDS) {
    const button = segment(`${speed}×`, `Speed ${speed}`, () => player.setSpeed(speed));
    button.dataset["speed"] = String(speed);
    element("speeds").append(button);
  }
  element("mute").hidden = !sound;
  player.onChange(showTransport);
  showTransport();
}

function showTransport(): void {
  document.body.classList.toggle("playing", player.playing);
  element("play-label").textContent = player.playing ? "Pause" : "Play";
  element("loop").ariaPressed = String(player.looping);
  element("mute").ariaPressed = String(player.voice?.muted ?? true);
  for (const button of element("speeds").querySelectorAll("button"))
    button.ariaPressed = String(Number(button.dataset["speed"]) === player.speed);
}

function segment(label: string, title: string, act: () => void): HTMLButtonElement {
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = label;
  button.title = title;
  button.addEventListener("click", act);
  return button;
}

function toggleMute(): void {
  player.setMuted(!player.voice?.muted);
}

function help(): void {
  element<HTMLDialogElement>("help").showModal();
}

/** Pause, and go by whole frames. */
function step(frames: number): void {
  player.pause();
  const { rate, start } = performed.controls;
  const frame = Math.round((player.time() - start) * rate) + frames;
  player.seek(start + frame / rate, true);
}

function jump(marks: number[], way: 1 | -1): void {
  player.pause();
  const mark = neighbour(marks, player.time(), way);
  if (mark !== undefined) player.seek(mark, true);
}

function changeSpeed(way: 1 | -1): void {
  const next = SPEEDS[SPEEDS.indexOf(player.speed) + way];
  if (next) player.setSpeed(next);
}

/** Set one end of the part that is looped. */
function mark(end: "start" | "end"): void {
  const range = { ...(player.range ?? whole), [end]: player.time() };
  if (range.start < range.end) player.setRange(range);
}

function addKeys(): void {
  const { phones, words } = performed;
  const middles = phones.map(middle);
  const starts = words.map(({ start }) => start);
  const names = Object.keys(VIEWS);
  const table: Key[] = [
    { keys: [" ", "k"], shown: ["Space"], does: "play, pause", act: () => player.toggle() },
    {
      keys: ["ArrowLeft", "ArrowRight"],
      shown: ["←", "→"],
      does: "a frame back, on",
      act: (key) => step(key === "ArrowLeft" ? -1 : 1),
    },
    {
      keys: ["Shift+ArrowLeft", "Shift+ArrowRight"],
      shown: ["Shift ←", "Shift →"],
      does: "ten frames",
      act: (key) => step(key === "ArrowLeft" ? -10 : 10),
    },
    {
      keys: ["ArrowUp", "ArrowDown"],
      shown: ["↑", "↓"],
      does: "phone before, next phone",
      act: (key) => jump(middles, key === "ArrowUp" ? -1 : 1),
    },
    {
      keys: ["PageUp", "PageDown", "Shift+ArrowUp", "Shift+ArrowDown"],
      shown: ["Page ↑", "Page ↓"],
      does: "word before, next word",
      act: (key) => jump(starts, key.endsWith("Up") ? -1 : 1),
    },
    { keys: ["Home"], shown: ["Home"], does: "to the start", act: () => player.seek(whole.start) },
    { keys: ["End"], shown: ["End"], does: "to the end", act: () => player.seek(whole.end) },
    { keys: ["l"], shown: ["L"], does: "loop", act: () => player.setLooping(!player.looping) },
    { keys: ["i"], shown: ["I"], does: "loop from here", act: () => mark("start") },
    { keys: ["o"], shown: ["O"], does: "loop up to here", act: () => mark("end") },
    { keys: ["Escape"], shown: ["Esc"], does: "loop the whole", act: () => player.setRange(null) },
    { keys: ["["], shown: ["["], does: "slower", act: () => changeSpeed(-1) },
    { keys: ["]"], shown: ["]"], does: "faster", act: () => changeSpeed(1) },
    { keys: ["m"], shown: ["M"], does: "mute", act: toggleMute },
    {
      keys: names.map((_, index) => String(index + 1)),
      shown: names.map((_, index) => String(index + 1)),
      does: "front, three-quarter, side, mouth, mouth from aside",
      act: (key) => stage?.setView(names[Number(key) - 1], true),
    },
    {
      keys: ["a", "d", "w", "s"],
      shown: ["A", "D", "W", "S"],
      does: "turn the head",
      act: (key) => turn(key),
    },
    {
      keys: ["q", "e"],
      shown: ["Q", "E"],
      does: "farther, nearer",
      act: (key) => stage?.turn(0, 0, key === "q" ? 1.08 : 1 / 1.08),
    },
    { keys: ["b"], shown: ["B"], does: "blink", act: () => setIdle(!idle) },
    {
      keys: ["+", "=", "-", "0"],
      shown: ["+", "−", "0"],
      does: "zoom the timeline, show all of it",
      act: (key) => (key === "0" ? timeline.fit() : timeline.zoom(key === "-" ? 1.25 : 0.8)),
    },
    { keys: ["v"], shown: ["V"], does: "all curves, none", act: () => legend.toggleAll() },
    {
      keys: ["n"],
      shown: ["N"],
      does: "how this was made",
      act: () => element<HTMLDialogElement>("notes").showModal(),
    },
    { keys: ["?"], shown: ["?"], does: "these keys", act: help },
  ];
  listen(table);
  describe(element("key-list"), table);
}

function turn(key: string): void {
  const [azimuth, elevation] = { a: [-6, 0], d: [6, 0], w: [0, 5], s: [0, -5] }[key] ?? [0, 0];
  stage?.turn(azimuth, elevation);
}

function watch(): void {
  player.onChange(ask);
  timeline.onChange(ask);
  const canvas = element("timeline");
  const fit = () => timeline.resize(canvas.clientWidth, canvas.clientHeight);
  new ResizeObserver(fit).observe(canvas);
  fit();
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    timeline.restyle();
    legend.restyle();
  });
}
