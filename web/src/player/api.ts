/** What a test, or another script on the page, may ask of it: `window.lipwright`. */

import type { Model } from "../shared/model.ts";
import type { Player } from "../shared/player.ts";
import type { Stage } from "../shared/stage.ts";

export interface Lipwright {
  /** Fulfilled once the model is on the stage; rejected if it cannot be shown. */
  ready: Promise<void>;
  play(): void;
  pause(): void;
  /** Go to a time, in seconds on the sound's clock, and draw it at once. */
  seek(seconds: number): void;
  /** The present time; while there is sound it is what is heard. */
  time(): number;
  playing(): boolean;
  setSpeed(speed: number): void;
  setLooping(looping: boolean): void;
  /** front, three-quarter, side, mouth or mouth-side; at once. */
  setView(name: string): void;
  /** Whether the eyes blink of themselves. */
  setIdle(on: boolean): void;
  /** The value of each morph target and each turned joint as they are drawn now. */
  morphs(): Record<string, number>;
  /** The vertices of each mesh as they are drawn now: x, y, z after each other, in the world. */
  positions(): Record<string, number[]>;
}

declare global {
  interface Window {
    lipwright: Lipwright;
  }
}

export interface Parts {
  player: Player;
  stage: Stage;
  model: Model;
  draw: () => void;
  setIdle: (on: boolean) => void;
}

/** Publish the functions; before the model is there they do what can be done without it. */
export function publish(loading: Promise<Parts>, player: Player): void {
  let parts: Parts | null = null;
  const ready = loading.then((loaded) => {
    parts = loaded;
  });
  const loaded = (): Parts => {
    if (!parts) throw new Error("not ready: await lipwright.ready first");
    return parts;
  };
  window.lipwright = {
    ready,
    play: () => player.play(),
    pause: () => player.pause(),
    seek(seconds) {
      player.seek(seconds);
      parts?.draw();
    },
    time: () => player.time(),
    playing: () => player.playing,
    setSpeed: (speed) => player.setSpeed(speed),
    setLooping: (looping) => player.setLooping(looping),
    setView(name) {
      loaded().stage.setView(name);
      loaded().draw();
    },
    setIdle(on) {
      loaded().setIdle(on);
      loaded().draw();
    },
    morphs: () => loaded().model.weights(),
    positions: () => loaded().model.positions(),
  };
}
