/** Files that are dropped on the page: recordings become lines, models speak them. */

import { byId, write } from "../core/dom.ts";

const MODELS = /\.(glb|vrm)$/i;

export function acceptDrops(hooks: {
  model: (file: File) => void;
  sound: (files: File[]) => void;
}): void {
  const shade = byId("drop");
  let depth = 0;
  const over = (on: boolean) => {
    shade.hidden = !on;
    if (on)
      write(
        shade.firstElementChild as Element,
        "A recording becomes a line; a GLB or VRM speaks it",
      );
  };
  addEventListener("dragenter", (event) => {
    if (!event.dataTransfer?.types.includes("Files")) return;
    depth++;
    over(true);
  });
  addEventListener("dragleave", () => {
    depth = Math.max(depth - 1, 0);
    if (!depth) over(false);
  });
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    event.preventDefault();
    depth = 0;
    over(false);
    const files = [...(event.dataTransfer?.files ?? [])];
    const model = files.find(({ name }) => MODELS.test(name));
    if (model) hooks.model(model);
    else if (files.length) hooks.sound(files);
  });
}
