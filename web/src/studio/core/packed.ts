/** Numbers as the server packs them: base64 of little-endian float32. */

import type { Curves } from "../../shared/curves.ts";
import type { Frames, Packed } from "../protocol.ts";

export function unpack(packed: Packed): Float32Array<ArrayBuffer> {
  const bytes = fromBase64(packed);
  return new Float32Array(bytes.buffer);
}

function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  const fast = Uint8Array as unknown as { fromBase64?: (text: string) => Uint8Array<ArrayBuffer> };
  if (fast.fromBase64) return fast.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let index = 0; index < binary.length; index++) bytes[index] = binary.charCodeAt(index);
  return bytes;
}

/** Frames as curves that can be sampled. */
export function framesOf({ names, rate, start, values }: Frames): Curves {
  return { names, rate, start, values: unpack(values) };
}
