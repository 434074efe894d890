/** The page of the studio. */

import { describe } from "../shared/keyboard.ts";
import type { StudioApi } from "./api.ts";
import { goingKeys, listen, playingKeys } from "./commands.ts";
import { byId, h } from "./core/dom.ts";
import { makeSplitters } from "./core/layout.ts";
import type { Pair } from "./core/session.ts";
import { Studio } from "./studio.ts";

makeSplitters();
const studio = new Studio();
const [playing, going] = [playingKeys(studio), goingKeys(studio)];
listen([...playing, ...going]);
writeHelp();
window.studio = api();

function writeHelp(): void {
  for (const [title, table] of [
    ["Playing", playing],
    ["Looking and going", going],
    ["In the curves", studio.panel.keys()],
  ] as const) {
    const list = h("dl");
    describe(list, table);
    byId("key-lists").append(h("section", {}, h("h3", {}, title), list));
  }
  const pointer = h(
    "p",
    {},
    "In the curves: double-click adds a key, drag over empty ground chooses several, Shift adds to what is chosen;" +
      " while dragging, Shift goes slowly, Ctrl keeps to one direction, Alt leaves snapping. The wheel zooms, the right button pans." +
      " In the line: drag scrubs with sound, Shift-drag loops a part, the edges of phones can be dragged; click a curve to ask why." +
      " Double-click a phone to edit its pair, a word to loop it. In the table of pairs: arrows, Enter opens, S opens the single curve.",
  );
  byId("key-lists").after(pointer);
}

/** Fulfilled after the next picture has been drawn. */
function nextPicture(): Promise<void> {
  return new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve, 0)));
}

function api(): StudioApi {
  const { session, face, transport, canvas, panel, measure } = studio;
  return {
    ready: face.ready,
    async idle() {
      do await nextPicture();
      while (!session.settled || panel.busy);
      studio.draw();
    },
    seek(seconds) {
      transport.player?.seek(seconds);
      studio.draw();
    },
    time: () => transport.player?.time() ?? 0,
    play: () => transport.player?.play(),
    pause: () => transport.player?.pause(),
    playing: () => transport.player?.playing ?? false,
    sounding: () => transport.player?.voice?.running ?? false,
    setView(name) {
      face.setView(name, false);
      studio.draw();
    },
    setIdle(on) {
      face.idle = on;
      studio.draw();
    },
    morphs: () => face.model?.weights() ?? {},
    positions: () => face.model?.positions() ?? {},
    controls: (seconds) => studio.sampled(seconds),
    editor: () => ({
      pair: (session.watched.pair ?? null) as Pair | null,
      pose: panel.editor.active,
      curves: panel.editor.curves,
    }),
    keyAt: (pose, index) => panel.editor.placeOf(pose, index),
    curveAt: (control, seconds) => canvas.placeOf(control, seconds),
    edgeAt: (phone) => canvas.placeOfEdge(phone),
    latencies: () => measure.latencies,
    pictures: () => measure.pictures,
  };
}
