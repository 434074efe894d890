/** The page: its parts are made here, and told of each other. */

import "./style.css";
import { publish, type Parts } from "./api.ts";
import { keysOf, SPEEDS, step, toggleMute } from "./commands.ts";
import { peaks, sample } from "../shared/curves.ts";
import { block, fromBase64, performanceOf, wholeOf, type Performance } from "./document.ts";
import { clockTime } from "../shared/format.ts";
import { blink } from "../shared/idle.ts";
import { describe, listen } from "../shared/keyboard.ts";
import { Legend } from "./legend.ts";
import { loadModel, type Model } from "../shared/model.ts";
import { notes, summary } from "./notes.ts";
import { Player } from "../shared/player.ts";
import { spanAt } from "../shared/spans.ts";
import { Stage } from "../shared/stage.ts";
import { VIEWS } from "../shared/views.ts";
import type { Shown } from "../shared/paint.ts";
import { Timeline } from "./timeline.ts";
import { Voice } from "../shared/voice.ts";
import { peaksOf, readWav } from "../shared/wav.ts";

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
    const { backwards, joints } = performed.content;
    const loaded = await loadModel(fromBase64(block("model")), backwards, joints);
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
  about.addEventListener("click", () => show("notes"));
  for (const [name, words] of notes(performance, whole.end - whole.start)) {
    const term = document.createElement("dt");
    term.textContent = name;
    const content = document.createElement("dd");
    content.textContent = words;
    element("note-list").append(term, content);
  }
  element("clock").append("", document.createElement("small"));
  const slider = element("timeline");
  slider.ariaValueMin = whole.start.toFixed(3);
  slider.ariaValueMax = whole.end.toFixed(3);
}

function addViews(made: Stage): void {
  Object.entries(VIEWS).forEach(([name, view], index) => {
    const button = segment(view.label, `${view.name} (${index + 1})`, () => {
      made.setView(name, true);
    });
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
  click("back", () => step(player, performed.controls, -1));
  click("on", () => step(player, performed.controls, 1));
  click("loop", () => player.setLooping(!player.looping));
  click("mute", () => toggleMute(player));
  click("all", () => legend.toggleAll());
  click("blink", () => setIdle(!idle));
  click("keys", () => show("help"));
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
  button.title = button.ariaLabel = title;
  button.addEventListener("click", act);
  return button;
}

function show(dialog: "help" | "notes"): void {
  element<HTMLDialogElement>(dialog).showModal();
}

function addKeys(): void {
  const table = keysOf({
    performed,
    player,
    timeline,
    legend,
    stage: () => stage,
    toggleBlink: () => setIdle(!idle),
    show,
  });
  listen(table);
  describe(element("key-list"), table);
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
