/** Whether pictures are drawn by the processor alone: then what costs most is left out. */

let known: boolean | null = null;

export function drawsInSoftware(): boolean {
  known ??= look();
  return known;
}

function look(): boolean {
  const context = document.createElement("canvas").getContext("webgl2");
  if (!context) return true;
  const names = context.getExtension("WEBGL_debug_renderer_info");
  const renderer = names ? String(context.getParameter(names.UNMASKED_RENDERER_WEBGL)) : "";
  context.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(renderer);
}

/** A context for opaque pictures in the plane; without a graphics card it is better drawn in memory. */
export function planeContext(canvas: HTMLCanvasElement): CanvasRenderingContext2D {
  const options = { willReadFrequently: drawsInSoftware(), alpha: false };
  return canvas.getContext("2d", options) as CanvasRenderingContext2D;
}
