/** The keys of the curve editor: they act while it has the focus. */

import type { Key } from "../../shared/keyboard.ts";
import type { CurveEditor } from "./editor.ts";

const FINE = 0.001;
const STEP = 0.01;
const LEAP = 0.1;

/** The table: `Shift+` a leap, `Alt+` a thousandth. */
export function keysOf(
  editor: CurveEditor,
  hooks: { next: (way: 1 | -1) => void; enter: () => void; see: () => void },
): Key[] {
  const arrows = (by: number) => (key: string) => {
    const x = { ArrowLeft: -by, ArrowRight: by }[key] ?? 0;
    const y = { ArrowDown: -by, ArrowUp: by }[key] ?? 0;
    editor.nudge(x, y);
  };
  const all = ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown"];
  return [
    { keys: all, shown: ["←", "→", "↑", "↓"], does: "move keys by 0.01", act: arrows(STEP) },
    {
      keys: all.map((key) => `Shift+${key}`),
      shown: ["Shift", "←"],
      does: "by 0.1",
      act: arrows(LEAP),
    },
    {
      keys: all.map((key) => `Alt+${key}`),
      shown: ["Alt", "←"],
      does: "by 0.001",
      act: arrows(FINE),
    },
    {
      keys: [",", "."],
      shown: [",", "."],
      does: "key before, next key",
      act: (key) => editor.step(key === "," ? -1 : 1),
    },
    {
      keys: ["Shift+<", "Shift+>", "Shift+;", "Shift+:"],
      shown: ["Shift", ",", "."],
      does: "choose it as well",
      act: (key) => editor.step(/[<;]/.test(key) ? -1 : 1, true),
    },
    {
      keys: ["PageUp", "PageDown"],
      shown: ["Page ↑", "Page ↓"],
      does: "pose before, next pose",
      act: (key) => hooks.next(key === "PageUp" ? -1 : 1),
    },
    { keys: ["k", "Insert"], shown: ["K"], does: "add a key", act: () => editor.insertHere() },
    {
      keys: ["Delete", "Backspace"],
      shown: ["Del"],
      does: "take keys away",
      act: () => editor.remove(),
    },
    { keys: ["Enter"], shown: ["Enter"], does: "type numbers", act: () => hooks.enter() },
    { keys: ["Ctrl+a"], shown: ["Ctrl", "A"], does: "all keys", act: () => editor.chooseAll() },
    {
      keys: ["Ctrl+Shift+a"],
      shown: ["Ctrl", "Shift", "A"],
      does: "all keys of all poses",
      act: () => editor.chooseAll(Object.keys(editor.curves)),
    },
    {
      keys: ["Ctrl+c"],
      shown: ["Ctrl", "C"],
      does: "copy keys or curve",
      act: () => editor.copy(),
    },
    {
      keys: ["Ctrl+Shift+c"],
      shown: ["Ctrl", "Shift", "C"],
      does: "copy all curves",
      act: () => editor.copy(true),
    },
    {
      keys: ["Ctrl+x"],
      shown: ["Ctrl", "X"],
      does: "cut",
      act: () => {
        editor.copy();
        if (!editor.count) editor.chooseAll();
        editor.remove();
      },
    },
    { keys: ["Ctrl+v"], shown: ["Ctrl", "V"], does: "paste", act: () => editor.paste() },
    { keys: ["h"], shown: ["H"], does: "mirror in time", act: () => editor.mirror() },
    {
      keys: ["+", "=", "-", "Shift++"],
      shown: ["+", "−"],
      does: "stronger, weaker by 5 %",
      act: (key) => editor.scaleValues(key === "-" ? 1 / 1.05 : 1.05),
    },
    {
      keys: ["w", "n"],
      shown: ["N", "W"],
      does: "narrower, wider in time",
      act: (key) => editor.scaleTimes(key === "n" ? 1 / 1.05 : 1.05),
    },
    { keys: ["s"], shown: ["S"], does: "see the key in the line", act: () => hooks.see() },
    {
      keys: ["0"],
      shown: ["0"],
      does: "see all of it",
      act: () => editor.fit(),
    },
    {
      keys: ["Escape"],
      shown: ["Esc"],
      does: "give up, choose nothing",
      act: () => {
        if (editor.dragging) editor.cancel();
        else editor.chooseNone();
      },
    },
  ];
}

/** Let a table of keys act while an element has the focus. */
export function listenOn(element: HTMLElement, table: Key[]): void {
  const actions = new Map(table.flatMap(({ keys, act }) => keys.map((key) => [key, act])));
  element.addEventListener("keydown", (event) => {
    const name = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const ctrl = event.ctrlKey || event.metaKey ? "Ctrl+" : "";
    const prefix = `${ctrl}${event.altKey ? "Alt+" : ""}${event.shiftKey ? "Shift+" : ""}`;
    const act = actions.get(prefix + name);
    if (!act) return;
    event.preventDefault();
    event.stopPropagation();
    act(name);
  });
}
