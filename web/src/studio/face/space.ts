/** What draws in space: a part of the page of its own. */

export { loadModel } from "../../shared/model.ts";
export { Stage } from "../../shared/stage.ts";
