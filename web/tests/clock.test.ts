import assert from "node:assert/strict";
import { test } from "node:test";
import { Clock } from "../src/shared/clock.ts";

function ticking(start = 0, end = 2) {
  const ticks = { now: 100 };
  const clock = new Clock({ start, end }, () => ticks.now);
  return { ticks, clock };
}

function near(found: number, expected: number): void {
  assert.ok(Math.abs(found - expected) < 1e-9, `${found} is not ${expected}`);
}

test("time stands until it is played, then follows the tick", () => {
  const { ticks, clock } = ticking(-0.2);
  ticks.now = 101;
  near(clock.time(), -0.2);
  clock.play(101);
  ticks.now = 101.5;
  near(clock.time(), 0.3);
  clock.pause();
  ticks.now = 103;
  near(clock.time(), 0.3);
});

test("before the sound is heard, time stands", () => {
  const { ticks, clock } = ticking();
  clock.seek(1);
  clock.play(100.04);
  near(clock.time(), 1);
  ticks.now = 100.05;
  near(clock.time(), 1.01);
});

test("at a quarter of the speed, time takes four times as long", () => {
  const { ticks, clock } = ticking();
  clock.speed = 0.25;
  clock.play(100);
  ticks.now = 102;
  near(clock.time(), 0.5);
});

test("it ends at the end", () => {
  const { ticks, clock } = ticking();
  clock.play(100);
  ticks.now = 109;
  near(clock.time(), 2);
  assert.ok(clock.ended);
});

test("a loop comes back to its start, again and again", () => {
  const { ticks, clock } = ticking();
  clock.loop = { start: 0.5, end: 1 };
  clock.seek(0.75);
  clock.play(100);
  ticks.now = 100.3;
  near(clock.time(), 0.55);
  ticks.now = 101.3;
  near(clock.time(), 0.55);
  assert.ok(!clock.ended);
});

test("seeking goes no further than the performance", () => {
  const { clock } = ticking(-0.2);
  clock.seek(-3);
  near(clock.time(), -0.2);
  clock.seek(3);
  near(clock.time(), 2);
});
