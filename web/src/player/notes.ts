/** What the engine has to say about its work: a line in the header, the rest in a dialog. */

import { frameCount } from "../shared/curves.ts";
import type { Performance } from "./document.ts";
import { clockTime } from "../shared/format.ts";

type Note = [string, string];

/** A few words for the header: the engine, its set, and how many notes there are. */
export function summary({ content }: Performance): { made: string; noted: string } {
  const set = content.report["set"];
  const made = [content.engine, typeof set === "string" ? set : ""].filter(Boolean).join(" · ");
  const count = content.notes.length + standIns(content.report).length;
  return { made, noted: count ? `${count} ${count === 1 ? "note" : "notes"}` : "" };
}

/** Everything that is known, as pairs of a name and plain words. */
export function notes(performance: Performance, length: number): Note[] {
  const { content, controls, channels } = performance;
  const result: Note[] = [];
  if (content.text) result.push(["text", content.text]);
  for (const note of content.notes) result.push(["note", note]);
  result.push(["engine", content.engine || "unknown"]);
  for (const [name, value] of Object.entries(content.report))
    for (const words of inWords(value)) result.push([name.replaceAll("_", " "), words]);
  result.push(["length", clockTime(length)]);
  result.push(["frames", `${frameCount(controls)}, ${controls.rate} per second`]);
  result.push(["model", `${content.model}, ${channels.names.length} morph targets driven`]);
  return result;
}

/** Entries of the report whose name says that something was put in for something else. */
function standIns(report: Record<string, unknown>): unknown[] {
  const names = Object.keys(report).filter((name) => /stand.?in|missing|guess|note/i.test(name));
  return names.flatMap((name) => {
    const value = report[name];
    if (Array.isArray(value)) return value;
    return typeof value === "object" && value ? Object.keys(value) : [];
  });
}

function inWords(value: unknown): string[] {
  if (value === null || value === undefined || value === "") return [];
  if (Array.isArray(value)) return value.length ? [value.map(plain).join(", ")] : [];
  if (typeof value !== "object") return [String(value)];
  const pairs = Object.entries(value).map(([name, each]) => `${name}: ${plain(each)}`);
  return pairs.length ? [pairs.join(", ")] : [];
}

function plain(value: unknown): string {
  if (Array.isArray(value)) return value.map(plain).join(" ");
  return typeof value === "object" && value ? JSON.stringify(value) : String(value);
}
