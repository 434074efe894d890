/** What the user may tell the player, and with which keys. */

import type { Curves } from "../shared/curves.ts";
import type { Performance } from "./document.ts";
import type { Key } from "../shared/keyboard.ts";
import type { Legend } from "./legend.ts";
import type { Player } from "../shared/player.ts";
import { middle, neighbour } from "../shared/spans.ts";
import type { Stage } from "../shared/stage.ts";
import { VIEWS } from "../shared/views.ts";
import type { Timeline } from "./timeline.ts";

export const SPEEDS = [0.25, 0.5, 0.75, 1];

/** Whom the keys speak to. */
export interface Parts {
  performed: Performance;
  player: Player;
  timeline: Timeline;
  legend: Legend;
  /** The stage, once the model is on it. */
  stage: () => Stage | null;
  toggleBlink: () => void;
  show: (dialog: "help" | "notes") => void;
}

/** Pause, and go by whole frames. */
export function step(player: Player, { rate, start }: Curves, frames: number): void {
  player.pause();
  const frame = Math.round((player.time() - start) * rate) + frames;
  player.seek(start + frame / rate, true);
}

export function toggleMute(player: Player): void {
  player.setMuted(!player.voice?.muted);
}

function jump(player: Player, marks: number[], way: 1 | -1): void {
  player.pause();
  const mark = neighbour(marks, player.time(), way);
  if (mark !== undefined) player.seek(mark, true);
}

function changeSpeed(player: Player, way: 1 | -1): void {
  const next = SPEEDS[SPEEDS.indexOf(player.speed) + way];
  if (next) player.setSpeed(next);
}

/** Set one end of the part that is looped. */
function mark(player: Player, end: "start" | "end"): void {
  const range = { ...(player.range ?? player.whole), [end]: player.time() };
  if (range.start < range.end) player.setRange(range);
}

function turn(stage: Stage | null, key: string): void {
  const [azimuth, elevation] = { a: [-6, 0], d: [6, 0], w: [0, 5], s: [0, -5] }[key] ?? [0, 0];
  stage?.turn(azimuth, elevation);
}

/** The table of keys. */
export function keysOf(parts: Parts): Key[] {
  const { performed, player, timeline, legend, stage } = parts;
  const { phones, words, controls } = performed;
  const { whole } = player;
  const middles = phones.map(middle);
  const starts = words.map(({ start }) => start);
  const names = Object.keys(VIEWS);
  return [
    { keys: [" ", "k"], shown: ["Space"], does: "play, pause", act: () => player.toggle() },
    {
      keys: ["ArrowLeft", "ArrowRight"],
      shown: ["←", "→"],
      does: "a frame back, on",
      act: (key) => step(player, controls, key === "ArrowLeft" ? -1 : 1),
    },
    {
      keys: ["Shift+ArrowLeft", "Shift+ArrowRight"],
      shown: ["Shift ←", "Shift →"],
      does: "ten frames",
      act: (key) => step(player, controls, key === "ArrowLeft" ? -10 : 10),
    },
    {
      keys: ["ArrowUp", "ArrowDown"],
      shown: ["↑", "↓"],
      does: "phone before, next phone",
      act: (key) => jump(player, middles, key === "ArrowUp" ? -1 : 1),
    },
    {
      keys: ["PageUp", "PageDown", "Shift+ArrowUp", "Shift+ArrowDown"],
      shown: ["Page ↑", "Page ↓"],
      does: "word before, next word",
      act: (key) => jump(player, starts, key.endsWith("Up") ? -1 : 1),
    },
    { keys: ["Home"], shown: ["Home"], does: "to the start", act: () => player.seek(whole.start) },
    { keys: ["End"], shown: ["End"], does: "to the end", act: () => player.seek(whole.end) },
    { keys: ["l"], shown: ["L"], does: "loop", act: () => player.setLooping(!player.looping) },
    { keys: ["i"], shown: ["I"], does: "loop from here", act: () => mark(player, "start") },
    { keys: ["o"], shown: ["O"], does: "loop up to here", act: () => mark(player, "end") },
    { keys: ["Escape"], shown: ["Esc"], does: "loop the whole", act: () => player.setRange(null) },
    { keys: ["["], shown: ["["], does: "slower", act: () => changeSpeed(player, -1) },
    { keys: ["]"], shown: ["]"], does: "faster", act: () => changeSpeed(player, 1) },
    { keys: ["m"], shown: ["M"], does: "mute", act: () => toggleMute(player) },
    {
      keys: names.map((_, index) => String(index + 1)),
      shown: names.map((_, index) => String(index + 1)),
      does: "front, three-quarter, side, mouth, mouth from aside",
      act: (key) => stage()?.setView(names[Number(key) - 1], true),
    },
    {
      keys: ["a", "d", "w", "s"],
      shown: ["A", "D", "W", "S"],
      does: "turn the head",
      act: (key) => turn(stage(), key),
    },
    {
      keys: ["q", "e"],
      shown: ["Q", "E"],
      does: "farther, nearer",
      act: (key) => stage()?.turn(0, 0, key === "q" ? 1.08 : 1 / 1.08),
    },
    { keys: ["b"], shown: ["B"], does: "blink", act: () => parts.toggleBlink() },
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
      act: () => parts.show("notes"),
    },
    { keys: ["?"], shown: ["?"], does: "these keys", act: () => parts.show("help") },
  ];
}
