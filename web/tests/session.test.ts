import assert from "node:assert/strict";
import { test, type TestContext } from "node:test";
import { Session, type Topic } from "../src/studio/core/session.ts";
import type { Frames, Hello, MotionView, Request } from "../src/studio/protocol.ts";

class Socket extends EventTarget {
  static last: Socket;
  sent: Record<string, unknown>[] = [];
  constructor() {
    super();
    Socket.last = this;
  }
  send(text: string): void {
    this.sent.push(JSON.parse(text));
  }
  say(answer: object): void {
    this.dispatchEvent(new MessageEvent("message", { data: JSON.stringify(answer) }));
  }
  /** The last request of a kind. */
  asked(type: Request["type"]): Record<string, unknown> {
    return this.sent.filter((request) => request["type"] === type).at(-1) ?? {};
  }
}

const cell = (first: string, second: string, changed = false) => ({
  pair: [first, second] as [string, string],
  state: "drawn" as const,
  overridden: false,
  changed,
  need: 0,
  edits: 0,
  word: "",
});

const hello = (session: string): Hello => ({
  type: "hello",
  id: 1,
  version: "",
  session,
  revision: 0,
  setName: "english",
  setAbout: "",
  preset: "default",
  presets: [],
  target: "overrides",
  spline: "soften",
  classes: [],
  poses: [],
  rules: [],
  cells: [cell("f", "ah"), cell("l", "ow")],
  lines: [{ id: "1", title: "", duration: 1, edits: 0, lost: 0 }],
  files: [],
  history: { undo: "", redo: "", undoSteps: 0, redoSteps: 0 },
  character: {
    type: "character",
    id: 0,
    version: "a",
    name: "head",
    title: "",
    model: "models/a.glb",
    backwards: false,
    joints: [],
    known: [],
    notes: [],
  },
  characters: [],
  sets: [],
  voices: [],
  engines: [],
  draft: null,
});

function packed(...values: number[]): string {
  return Buffer.from(Float32Array.from(values).buffer).toString("base64");
}

const frames = (...values: number[]): Frames => ({
  names: ["open"],
  rate: 10,
  start: 0,
  count: values.length,
  values: packed(...values),
});

const motion = (line: string, version: "a" | "b", value: number): MotionView => ({
  type: "motion",
  id: 0,
  revision: 1,
  line,
  version,
  controls: frames(value),
  channels: frames(value),
  stages: [],
  character: "head",
  notes: [],
  milliseconds: 1,
});

/** A session whose server greets it, and the topics that it announced since. */
async function opened(t: TestContext) {
  t.mock.timers.enable({ apis: ["setTimeout"] });
  Object.assign(globalThis, {
    WebSocket: Socket,
    location: { search: "?token=t", protocol: "http:", host: "here:1" },
  });
  const complaints: string[] = [];
  const session = new Session((error) => complaints.push(error.message));
  const heard: Topic[] = [];
  for (const topic of ["cells", "line", "motion", "history", "rules"] as const)
    session.on(topic, () => heard.push(topic));
  Socket.last.dispatchEvent(new Event("open"));
  Socket.last.say({ ...hello("s1"), id: Socket.last.asked("start")["id"] });
  await new Promise(setImmediate);
  heard.length = 0;
  return { session, heard, complaints };
}

test("what is to be shown is said once, however many parts asked for it", async (t) => {
  const { session } = await opened(t);
  Socket.last.sent.length = 0;
  session.watch({ pair: ["l", "ow"] });
  session.watch({ line: "1", start: 0, end: 20 });
  await new Promise(setImmediate);
  assert.equal(Socket.last.sent.length, 1);
  const { pair, line, end } = Socket.last.sent[0];
  assert.deepEqual([pair, line, end], [["l", "ow"], "1", 20]);
});

test("the motion of a line that is no longer shown is not taken", async (t) => {
  const { session, heard } = await opened(t);
  session.watch({ line: "1" });
  Socket.last.say(motion("1", "a", 0.25));
  assert.deepEqual([...(session.motion.a?.controls.values ?? [])], [0.25]);
  Socket.last.say(motion("2", "a", 0.75));
  assert.deepEqual([...(session.motion.a?.controls.values ?? [])], [0.25]);
  Socket.last.say(motion("1", "b", 0.5));
  assert.equal(session.motion.b, null);
  session.watch({ line: "2" });
  assert.equal(session.motion.a, null);
  assert.ok(heard.includes("motion"));
});

test("of what changed only that is new, and only those who show it are told", async (t) => {
  const { session, heard } = await opened(t);
  const history = { undo: "draw l-ow", redo: "", undoSteps: 1, redoSteps: 0 };
  const same = { rules: null, poses: null, lines: null, files: null };
  const changed = { type: "changed", id: 0, revision: 1, history, ...same };
  Socket.last.say({ ...changed, cells: [cell("l", "ow", true)] });
  assert.equal(session.cells.get("l-ow")?.changed, true);
  assert.equal(session.cells.get("f-ah")?.changed, false);
  assert.equal(session.history.undo, "draw l-ow");
  assert.deepEqual(heard, ["history", "cells"]);
});

test("after a lost server a page goes on: its session, what waited, what it shows", async (t) => {
  const { session } = await opened(t);
  session.watch({ line: "1" });
  await new Promise(setImmediate);
  const change = { type: "removeLine" as const, line: "1" };
  void session.edit(change);
  Socket.last.dispatchEvent(new Event("close"));
  t.mock.timers.tick(150);
  Socket.last.dispatchEvent(new Event("open"));
  assert.equal(Socket.last.asked("start")["session"], "s1");
  assert.deepEqual(Socket.last.asked("edit"), {});
  Socket.last.say({ ...hello("s1"), id: Socket.last.asked("start")["id"] });
  await new Promise(setImmediate);
  assert.deepEqual(Socket.last.asked("edit")["change"], change);
  assert.equal(Socket.last.asked("watch")["line"], "1");
});

test("what the server refuses is said, and nothing waits for it", async (t) => {
  const { session, complaints } = await opened(t);
  const edited = session.edit({ type: "removeLine", line: "9" });
  Socket.last.say({ type: "failed", id: Socket.last.asked("edit")["id"], error: "no line 9" });
  assert.equal(await edited, null);
  assert.deepEqual(complaints, ["no line 9"]);
});
