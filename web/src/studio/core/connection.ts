/** The line to the server: requests and their answers, and what comes unasked. */

import type { Answer, Request } from "../protocol.ts";

/** What ends each request; anything else of the same id comes on the way. */
const ENDS: Record<Request["type"], Answer["type"][]> = {
  start: ["hello"],
  edit: ["changed"],
  undo: ["changed"],
  redo: ["changed"],
  draft: ["hello"],
  watch: ["watched"],
  say: ["made"],
  hear: ["made"],
  example: ["example"],
  why: ["why"],
  coverage: ["coverage"],
  character: ["character"],
  pose: ["pose"],
  preview: ["preview"],
  save: ["saved", "preview"],
  reread: ["hello"],
};

/** Milliseconds before it is tried again; the last one again and again. */
const WAITS = [150, 300, 600, 1000];

interface Waiting {
  request: Request;
  resolve: (answer: never) => void;
  reject: (error: Error) => void;
}

export class Connection {
  readonly token = new URLSearchParams(location.search).get("token") ?? "";
  online = false;
  #socket: WebSocket | null = null;
  #waiting = new Map<number, Waiting>();
  #last = 0;
  #tries = 0;
  #hear: (answer: Answer) => void;
  #change: () => void;
  #begin: () => void;

  /**
   * `hear` is told of all answers, `change` when the line is lost or found, and `begin` whenever
   * a line stands: it must ask with `start`.
   */
  constructor(hear: (answer: Answer) => void, change: () => void, begin: () => void) {
    this.#hear = hear;
    this.#change = change;
    this.#begin = begin;
    this.#open();
  }

  /** How many requests are still without an answer. */
  get pending(): number {
    return this.#waiting.size;
  }

  /** Ask; fulfilled with the answer that ends the request, rejected with the server's words. */
  ask<Kind extends Answer>(request: Request): Promise<Kind> {
    const id = ++this.#last;
    const numbered = { ...request, id };
    return new Promise<Kind>((resolve, reject) => {
      this.#waiting.set(id, { request: numbered, resolve, reject });
      if (this.online) this.#socket?.send(JSON.stringify(numbered));
    });
  }

  /** Ask again what the server that was lost has not answered: changes say what is to be. */
  repeat(): void {
    for (const { request } of this.#waiting.values())
      if (request.type !== "start") this.#socket?.send(JSON.stringify(request));
  }

  /** Send a file; the answer is what it is asked for by. */
  async send(kind: "sounds" | "models", file: File): Promise<string> {
    const address = `${kind}?name=${encodeURIComponent(file.name)}`;
    const said = await fetch(address, { method: "POST", headers: this.#headers, body: file });
    const answer = await said.json();
    if (!said.ok) throw new Error(answer.error ?? `the server answered ${said.status}`);
    return answer.key;
  }

  async fetch(address: string): Promise<ArrayBuffer> {
    const said = await fetch(address, { headers: this.#headers });
    if (!said.ok) throw new Error(`${address}: the server answered ${said.status}`);
    return said.arrayBuffer();
  }

  get #headers(): Record<string, string> {
    return { "X-Lipwright-Token": this.token };
  }

  #open(): void {
    const secure = location.protocol === "https:" ? "wss" : "ws";
    const address = `${secure}://${location.host}/talk?token=${encodeURIComponent(this.token)}`;
    const socket = new WebSocket(address);
    this.#socket = socket;
    socket.addEventListener("open", () => {
      this.online = true;
      this.#tries = 0;
      this.#forget("start");
      this.#begin();
      this.#change();
    });
    socket.addEventListener("message", ({ data }) => this.#receive(JSON.parse(String(data))));
    socket.addEventListener("close", () => {
      if (this.online) {
        this.online = false;
        this.#change();
      }
      const wait = WAITS[Math.min(this.#tries++, WAITS.length - 1)];
      setTimeout(() => this.#open(), wait);
    });
  }

  #forget(type: Request["type"]): void {
    for (const [id, { request }] of this.#waiting)
      if (request.type === type) this.#waiting.delete(id);
  }

  #receive(answer: Answer): void {
    const waiting = this.#waiting.get(answer.id);
    const ends = waiting && [...ENDS[waiting.request.type], "failed"].includes(answer.type);
    if (ends) this.#waiting.delete(answer.id);
    this.#hear(answer);
    if (!waiting || !ends) return;
    if (answer.type === "failed") waiting.reject(new Error(answer.error));
    else waiting.resolve(answer as never);
  }
}
