/** What is drawn anew over one phone of a line, as the curve editor shows it. */

import { sample } from "../../shared/curves.ts";
import type { Session } from "../core/session.ts";
import type { Edit, LineView } from "../protocol.ts";
import type { Subject } from "./editor.ts";
import type { Curves, Key } from "./keys.ts";

/** A phone of a line, as an edit hangs on it. */
export interface PhonePlace {
  /** Among the line's classes. */
  index: number;
  word: string;
  occurrence: number;
  phone: number;
  /** The class, as it is shown, and the line's own label, as the file has it. */
  label: string;
  own: string;
}

/** Keys with which one begins to draw over a result. */
const START = 5;
const SHOWN = 24;

export function placeOf(line: LineView, index: number): PhonePlace | null {
  const found = line.classes[index];
  if (!found || found.phone < 0 || !found.phoneInWord) return null;
  return {
    index,
    word: found.word,
    occurrence: Math.max(found.occurrence, 1),
    phone: found.phoneInWord,
    label: found.label,
    own: line.phones[found.phone]?.label ?? "",
  };
}

/** The edit of a pose at a phone, or one that changes nothing yet. */
export function editOf(line: LineView, place: PhonePlace, pose: string): Edit {
  const found = line.edits.find(
    ({ edit }) =>
      edit.pose === pose &&
      edit.phone === place.phone &&
      (edit.occurrence ?? 1) === place.occurrence &&
      edit.word.toLowerCase() === place.word.toLowerCase(),
  );
  const nothing = { gain: 1, level: null, hold: 0, keys: null, unlocked: false };
  const { word, occurrence, phone, own } = place;
  return {
    ...nothing,
    label: own,
    ...found?.edit,
    word: found?.edit.word ?? word,
    occurrence,
    phone,
    pose,
  };
}

export function editSubject(session: Session, place: PhonePlace): Subject | null {
  const line = session.line;
  const phone = line?.classes[place.index];
  if (!line || !phone) return null;
  const curves: Curves = {};
  for (const pose of session.poseNames()) {
    const keys = editOf(line, place, pose).keys;
    if (keys) curves[pose] = keys;
  }
  return {
    name: `edit ${line.line} ${place.index}`,
    domain: { first: 0, last: 1, rests: false },
    curves,
    ghosts: resultOf(session, phone.start, phone.end, Object.keys(curves).length ? SHOWN : START),
    poses: session.poseNames(),
    boundary: null,
    stretches: [{ label: place.own || phone.label, from: 0, to: 1 }],
    spline: "linear",
    softness: new Map(),
  };
}

/** The line's result over a phone, as keys. */
function resultOf(session: Session, start: number, end: number, count: number): Curves {
  const controls = session.motion.a?.controls;
  if (!controls) return {};
  const keys = new Map<string, Key[]>(controls.names.map((name) => [name, []]));
  for (let at = 0; at < count; at++) {
    const share = at / (count - 1);
    sample(controls, start + share * (end - start)).forEach((value, index) => {
      const round = (number: number) => Math.round(number * 1000) / 1000;
      keys.get(controls.names[index])?.push([round(share), round(value)]);
    });
  }
  return Object.fromEntries([...keys].filter(([, list]) => list.some(([, value]) => value > 0)));
}
