/** A draft that an earlier studio left behind: offered once, taken or thrown away with a word. */

import { byId, h, put } from "../core/dom.ts";
import type { Session } from "../core/session.ts";
import type { Hello } from "../protocol.ts";

export function offerDraft(session: Session, complain: (error: Error) => void): void {
  const host = byId("offer");
  const answer = (take: boolean) => {
    session.ask<Hello>({ type: "draft", take }).catch(complain);
  };
  session.on("hello", () => {
    const draft = session.hello?.draft;
    host.hidden = !draft;
    if (!draft) return;
    const steps = `${draft.steps} unsaved ${draft.steps === 1 ? "change" : "changes"}`;
    put(
      host,
      h(
        "span",
        {},
        `An earlier studio ended with ${steps}, on ${when(draft.savedAt)}: ${draft.summary}`,
      ),
      h("span", { class: "spring" }),
      h(
        "button",
        { type: "button", class: "primary", onclick: () => answer(true) },
        "Go on with them",
      ),
      h("button", { type: "button", onclick: () => answer(false) }, "Throw them away"),
    );
  });
}

/** An instant, as people where the page is read write it. */
function when(instant: string): string {
  const date = new Date(instant);
  if (Number.isNaN(date.getTime())) return instant;
  return date.toLocaleString(undefined, { dateStyle: "medium", timeStyle: "short" });
}
