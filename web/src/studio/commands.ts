/** The keys of the page, wherever the focus is but in a field. */

import type { Key } from "../shared/keyboard.ts";
import { middle, neighbour, spanAt } from "../shared/spans.ts";
import { VIEWS } from "../shared/views.ts";
import { toggleWhole } from "./core/layout.ts";
import type { Studio } from "./studio.ts";
import { SPEEDS } from "./line/transport.ts";

/** Seconds by which a key moves the edge of a phone. */
const STEP = 0.005;
const FIELDS = "input:not([type=checkbox]):not([type=range]), select, textarea";

/** What plays the line and shows the face. */
export function playingKeys({ transport, canvas, face, versions }: Studio): Key[] {
  const player = () => transport.player;
  const names = Object.keys(VIEWS);
  const speed = (way: 1 | -1) => {
    const next = SPEEDS[SPEEDS.indexOf(player()?.speed ?? 1) + way];
    if (next) player()?.setSpeed(next);
  };
  const jump = (marks: number[], way: 1 | -1) => {
    const now = player();
    if (!now) return;
    now.pause();
    const mark = neighbour(marks, now.time(), way);
    if (mark === undefined) return;
    now.seek(mark, true);
    canvas.choose(spanAt(canvas.phones, mark));
  };
  const edge = (end: "start" | "end") => {
    const now = player();
    if (!now) return;
    const range = { ...(now.range ?? now.whole), [end]: now.time() };
    if (range.start < range.end) now.setRange(range);
  };
  return [
    { keys: [" "], shown: ["Space"], does: "play, pause", act: () => player()?.toggle() },
    {
      keys: ["ArrowLeft", "ArrowRight"],
      shown: ["←", "→"],
      does: "a frame back, on",
      act: (key) => transport.step(key === "ArrowLeft" ? -1 : 1),
    },
    {
      keys: ["Shift+ArrowLeft", "Shift+ArrowRight"],
      shown: ["Shift ←", "Shift →"],
      does: "ten frames",
      act: (key) => transport.step(key === "ArrowLeft" ? -10 : 10),
    },
    {
      keys: ["ArrowUp", "ArrowDown"],
      shown: ["↑", "↓"],
      does: "phone before, next phone",
      act: (key) => jump(canvas.phones.map(middle), key === "ArrowUp" ? -1 : 1),
    },
    {
      keys: ["Home", "End"],
      shown: ["Home", "End"],
      does: "to the start, to the end",
      act: (key) => {
        const now = player();
        now?.seek(key === "Home" ? now.whole.start : now.whole.end);
      },
    },
    {
      keys: ["l"],
      shown: ["L"],
      does: "loop",
      act: () => player()?.setLooping(!player()?.looping),
    },
    { keys: ["i"], shown: ["I"], does: "loop from here", act: () => edge("start") },
    { keys: ["o"], shown: ["O"], does: "loop up to here", act: () => edge("end") },
    {
      keys: ["Escape"],
      shown: ["Esc"],
      does: "loop the whole",
      act: () => player()?.setRange(null),
    },
    { keys: ["["], shown: ["["], does: "slower", act: () => speed(-1) },
    { keys: ["]"], shown: ["]"], does: "faster", act: () => speed(1) },
    { keys: ["m"], shown: ["M"], does: "mute", act: () => transport.mute() },
    {
      keys: names.map((_, index) => String(index + 1)),
      shown: names.map((_, index) => String(index + 1)),
      does: "front, three-quarter, side, lips, lips from aside",
      act: (key) => face.setView(names[Number(key) - 1]),
    },
    { keys: ["x"], shown: ["X"], does: "A or B", act: () => versions.toggle() },
  ];
}

/** What leads from one part to another, and what concerns all of them. */
export function goingKeys(studio: Studio): Key[] {
  const { canvas } = studio;
  return [
    {
      keys: ["+", "=", "-", "0"],
      shown: ["+", "−", "0"],
      does: "zoom the line, show all of it",
      act: (key) => (key === "0" ? canvas.fit() : canvas.zoom(key === "-" ? 1.25 : 0.8)),
    },
    {
      keys: ["v"],
      shown: ["V"],
      does: "only the chosen curve, all",
      act: () => studio.controls.solo(),
    },
    {
      keys: ["j", "u"],
      shown: ["U", "J"],
      does: "control before, next control",
      act: (key) => studio.controls.step(key === "u" ? -1 : 1),
    },
    {
      keys: ["g"],
      shown: ["G"],
      does: "curves apart, together",
      act: () => studio.stages.toggleLanes(),
    },
    { keys: ["y"], shown: ["Y"], does: "why, here", act: () => studio.whyHere() },
    {
      keys: ["e"],
      shown: ["E"],
      does: "edit the pair that sounds here",
      act: () => studio.going.fromHere(),
    },
    {
      keys: ["r"],
      shown: ["R"],
      does: "correct the phone here",
      act: () => studio.going.toCorrect(),
    },
    {
      keys: [",", "."],
      shown: [",", "."],
      does: "move the end of the chosen phone by 5 ms",
      act: (key) => studio.nudgeEdge(0, key === "," ? -STEP : STEP),
    },
    {
      keys: ["Shift+<", "Shift+>", "Shift+;", "Shift+:"],
      shown: ["Shift", ",", "."],
      does: "move its start",
      act: (key) => studio.nudgeEdge(-1, /[<;]/.test(key) ? -STEP : STEP),
    },
    { keys: ["p"], shown: ["P"], does: "to the table of pairs", act: () => studio.toMatrix() },
    {
      keys: ["c"],
      shown: ["C"],
      does: "to the curves",
      act: () => studio.panel.editor.canvas.focus(),
    },
    { keys: ["t"], shown: ["T"], does: "type a line", act: () => studio.toText() },
    { keys: ["b"], shown: ["B"], does: "blink", act: () => studio.toggleBlink() },
    {
      keys: ["f"],
      shown: ["F"],
      does: "the part under the pointer fills the page, and back",
      act: () => toggleWhole(),
    },
    { keys: ["?"], shown: ["?"], does: "these keys", act: () => studio.help() },
    { keys: ["Ctrl+z"], shown: ["Ctrl", "Z"], does: "undo", act: () => studio.session.undo() },
    {
      keys: ["Ctrl+Shift+z", "Ctrl+y"],
      shown: ["Ctrl", "Shift", "Z"],
      does: "do again",
      act: () => studio.session.redo(),
    },
    { keys: ["Ctrl+s"], shown: ["Ctrl", "S"], does: "save", act: () => void studio.saving.open() },
  ];
}

const REPEATED = /Arrow|^[-+=,.<>;:z]$/;

/** Listen on the whole page; fields and dialogs keep their own keys. */
export function listen(table: Key[]): void {
  const actions = new Map(table.flatMap(({ keys, act }) => keys.map((key) => [key, act])));
  addEventListener("keydown", (event) => {
    if (event.defaultPrevented || document.querySelector("dialog[open]") || event.altKey) return;
    const ctrl = event.ctrlKey || event.metaKey;
    const target = event.target instanceof Element ? event.target : document.body;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (target.matches(FIELDS) && !(ctrl && key === "s")) return;
    if (key === " " && target.matches("button, input, [role=tab]")) return;
    if (target.matches("input[type=range]") && key.startsWith("Arrow")) return;
    const shift = event.shiftKey ? "Shift+" : "";
    const act = ctrl
      ? actions.get(`Ctrl+${shift}${key}`)
      : (shift && actions.get(shift + key)) || actions.get(key);
    if (!act) return;
    event.preventDefault();
    if (!event.repeat || REPEATED.test(key)) act(key);
  });
  // A button that was clicked, rather than reached by Tab, leaves the space bar to the player.
  addEventListener("click", ({ detail, target }) => {
    const button = target instanceof Element ? target.closest("button") : null;
    if (detail > 0 && button && !button.closest("dialog")) button.blur();
  });
}
