import assert from "node:assert/strict";
import { test, type TestContext } from "node:test";
import { Connection } from "../src/studio/core/connection.ts";
import { Stream } from "../src/studio/core/drag.ts";
import type { Session } from "../src/studio/core/session.ts";
import type { Answer, Change, Request } from "../src/studio/protocol.ts";

/** A line to a server that a test speaks for. */
class Socket extends EventTarget {
  static made: Socket[] = [];
  sent: (Request & { id: number })[] = [];
  address: string;
  constructor(address: string) {
    super();
    this.address = address;
    Socket.made.push(this);
  }
  send(text: string): void {
    this.sent.push(JSON.parse(text));
  }
  open(): void {
    this.dispatchEvent(new Event("open"));
  }
  close(): void {
    this.dispatchEvent(new Event("close"));
  }
  answer(answer: object): void {
    this.dispatchEvent(new MessageEvent("message", { data: JSON.stringify(answer) }));
  }
}

function connected(t: TestContext) {
  t.mock.timers.enable({ apis: ["setTimeout"] });
  Object.assign(globalThis, {
    WebSocket: Socket,
    location: { search: "?token=a%20b", protocol: "http:", host: "here:1" },
  });
  Socket.made = [];
  const heard: Answer[] = [];
  let begun = 0;
  const connection = new Connection(
    (answer) => heard.push(answer),
    () => undefined,
    () => begun++,
  );
  const socket = () => Socket.made[Socket.made.length - 1];
  return { connection, heard, socket, begun: () => begun };
}

const draw: Change = {
  type: "drawCurve",
  target: "overrides",
  pair: ["f", "ah"],
  pose: "FV",
  keys: [
    [0, 0],
    [1, 0],
  ],
};

test("an answer ends the request of its id; what comes before it is heard", async (t) => {
  const { connection, heard, socket } = connected(t);
  assert.equal(socket().address, "ws://here:1/talk?token=a%20b");
  socket().open();
  const asked = connection.ask({ type: "watch", pair: ["f", "ah"] });
  const [{ id }] = socket().sent;
  socket().answer({ type: "bigram", id });
  assert.equal(connection.pending, 1);
  socket().answer({ type: "watched", id, revision: 3 });
  assert.deepEqual(await asked, { type: "watched", id, revision: 3 });
  assert.deepEqual(
    heard.map(({ type }) => type),
    ["bigram", "watched"],
  );
});

test("what the server refuses is rejected with its words", async (t) => {
  const { connection, socket } = connected(t);
  socket().open();
  const asked = connection.ask({ type: "say", text: "" });
  socket().answer({ type: "failed", id: socket().sent[0].id, error: "no text" });
  await assert.rejects(asked, /no text/);
});

test("a change that a lost server has not answered is said again to the next one, once", (t) => {
  const { connection, socket, begun } = connected(t);
  socket().open();
  void connection.ask({ type: "edit", change: draw });
  const [lost] = socket().sent;
  socket().close();
  assert.ok(!connection.online);
  t.mock.timers.tick(150);
  socket().open();
  assert.equal(begun(), 2);
  assert.deepEqual(socket().sent, []);
  connection.repeat();
  assert.deepEqual(socket().sent, [lost]);
  socket().answer({ type: "changed", id: lost.id });
  assert.equal(connection.pending, 0);
});

test("what is asked while the server is away is asked when it is back", (t) => {
  const { connection, socket } = connected(t);
  void connection.ask({ type: "edit", change: draw });
  socket().open();
  connection.repeat();
  assert.equal(socket().sent.length, 1);
});

test("of a drag's changes the first goes at once, and then only the last", async () => {
  const sent: { keys: unknown; merge: string }[] = [];
  const answers: (() => void)[] = [];
  const session = {
    edit(change: Change & { keys: unknown }, merge: string) {
      sent.push({ keys: change.keys, merge });
      return new Promise<void>((resolve) => answers.push(resolve));
    },
  } as unknown as Session;
  const stream = new Stream(session);
  const keys = (value: number): [number, number][] => [
    [0, 0],
    [0.5, value],
    [1, 0],
  ];
  for (const value of [0.1, 0.2, 0.3]) stream.push({ ...draw, keys: keys(value) }, "drag-1");
  stream.push({ ...draw, keys: keys(0.9) }, "drag-2");
  assert.ok(stream.busy);
  for (let step = 0; step < 3; step++) {
    answers[step]();
    await new Promise(setImmediate);
  }
  assert.deepEqual(sent, [
    { keys: keys(0.1), merge: "drag-1" },
    { keys: keys(0.3), merge: "drag-1" },
    { keys: keys(0.9), merge: "drag-2" },
  ]);
  assert.ok(!stream.busy);
});
