import assert from "node:assert/strict";
import { test, type TestContext } from "node:test";
import { Player } from "../src/shared/player.ts";
import type { Voice } from "../src/shared/voice.ts";

/** A loudspeaker that notes what it is told, and whose time is moved by hand. */
class Loudspeaker {
  muted = false;
  now = 10;
  told: string[] = [];
  tick(): number {
    return this.now;
  }
  start(at: number, speed: number, loop: { start: number; end: number } | null): number {
    this.told.push(`from ${at} at ${speed}${loop ? ` loop ${loop.start} to ${loop.end}` : ""}`);
    return this.now;
  }
  stop(): void {
    this.told.push("stop");
  }
  grain(at: number): void {
    this.told.push(`grain ${at}`);
  }
}

function playing(t: TestContext) {
  t.mock.timers.enable({ apis: ["setTimeout"] });
  const speaker = new Loudspeaker();
  const player = new Player({ start: 0, end: 2 }, speaker as unknown as Voice);
  return { speaker, player };
}

test("the time is the loudspeaker's, and playing ends at the end", (t) => {
  const { speaker, player } = playing(t);
  player.play();
  speaker.now += 1.5;
  assert.equal(player.time(), 1.5);
  speaker.now += 1;
  player.update();
  assert.equal(player.time(), 2);
  assert.ok(!player.playing);
});

test("playing at the end starts anew", (t) => {
  const { speaker, player } = playing(t);
  player.seek(2);
  player.play();
  assert.equal(speaker.told.at(-1), "from 0 at 1");
});

test("seeking while playing goes on from there; while paused it sounds for a moment", (t) => {
  const { speaker, player } = playing(t);
  player.play();
  player.seek(1, true);
  assert.ok(player.playing);
  assert.deepEqual(speaker.told, ["from 0 at 1", "stop", "from 1 at 1"]);
  player.pause();
  player.seek(0.5, true);
  assert.equal(speaker.told.at(-1), "grain 0.5");
  player.setMuted(true);
  player.seek(0.25, true);
  assert.equal(speaker.told.at(-1), "grain 0.5");
});

test("a chosen part is looped from its start, at the chosen speed", (t) => {
  const { speaker, player } = playing(t);
  player.setSpeed(0.5);
  player.setRange({ start: 0.5, end: 1 });
  assert.ok(player.looping);
  player.play();
  assert.equal(speaker.told.at(-1), "from 0.5 at 0.5 loop 0.5 to 1");
  speaker.now += 1.5;
  player.update();
  assert.ok(player.playing);
  assert.equal(player.time(), 0.75);
  player.setLooping(false);
  speaker.now += 9;
  player.update();
  assert.ok(!player.playing);
});

test("played from behind the part that is looped, it comes back to it at the end", (t) => {
  const { speaker, player } = playing(t);
  player.setRange({ start: 0.5, end: 1 });
  player.play();
  player.seek(1.5);
  speaker.now += 0.4;
  player.update();
  assert.ok(Math.abs(player.time() - 1.9) < 1e-9);
  speaker.now += 0.2;
  player.update();
  assert.equal(player.time(), 0.5);
  assert.ok(player.playing);
});

test("a loudspeaker whose time stands still is left, and the time goes on", (t) => {
  const { player } = playing(t);
  player.play();
  t.mock.timers.tick(1000);
  assert.equal(player.voice, null);
  assert.ok(player.playing);
  const before = player.time();
  const until = performance.now() + 20;
  while (performance.now() < until);
  assert.ok(player.time() > before);
});
