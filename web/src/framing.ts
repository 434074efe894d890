/** Where to look: the head, and the mouth in it, found from what moves. No picture is made here. */

import { Box3, Vector3, type Mesh, type Object3D } from "three";

/** What a camera can frame: a centre and the half-size that should fit. */
export interface Frame {
  centre: Vector3;
  halfWidth: number;
  halfHeight: number;
}

export interface Framing {
  head: Frame;
  mouth: Frame;
}

/** Morph targets that move the lips and little else. */
const LIPS = /mouth|lip|pucker|funnel|pbm|fv|wide|shch|viseme|^w$|^[aeiou]{1,2}$/i;

export function framing(model: Object3D, meshes: Mesh[], used: string[]): Framing {
  model.updateMatrixWorld(true);
  const box = new Box3().setFromObject(model);
  const size = box.getSize(new Vector3());
  const centre = box.getCenter(new Vector3());
  // The face is what matters: a little of the shoulders is left out.
  centre.y += 0.05 * size.y;
  const whole = { centre, halfWidth: 0.45 * size.x, halfHeight: 0.47 * size.y };
  const lips = used.filter((name) => LIPS.test(name));
  const moved = spread(meshes, lips.length ? lips : used);
  if (!moved) return { head: whole, mouth: whole };
  const half = Math.max(moved.deviation.x, moved.deviation.y, 0.01 * size.y);
  // The lips are in front of most of what they take along.
  moved.mean.z += moved.deviation.z;
  const mouth = { centre: moved.mean, halfWidth: 2.6 * half, halfHeight: 1.9 * half };
  if (size.y < 30 * half) return { head: whole, mouth };
  const head = moved.mean.clone().add(new Vector3(0, 2 * half, 0));
  return { head: { centre: head, halfWidth: 6 * half, halfHeight: 8 * half }, mouth };
}

/** Mean and deviation of the vertices' places, weighted by the square of how far they move. */
function spread(meshes: Mesh[], names: string[]): { mean: Vector3; deviation: Vector3 } | null {
  const mean = new Vector3();
  const square = new Vector3();
  const place = new Vector3();
  let total = 0;
  for (const mesh of meshes) {
    const weights = displacement(mesh, names);
    const rest = mesh.geometry.getAttribute("position");
    weights.forEach((weight, index) => {
      if (weight === 0) return;
      place.fromBufferAttribute(rest, index).applyMatrix4(mesh.matrixWorld);
      total += weight;
      mean.addScaledVector(place, weight);
      square.addScaledVector(place.clone().multiply(place), weight);
    });
  }
  if (total === 0) return null;
  mean.divideScalar(total);
  square.divideScalar(total).sub(mean.clone().multiply(mean));
  const root = (value: number) => Math.sqrt(Math.max(value, 0));
  return { mean, deviation: new Vector3(root(square.x), root(square.y), root(square.z)) };
}

function displacement(mesh: Mesh, names: string[]): Float64Array {
  const geometry = mesh.geometry;
  const rest = geometry.getAttribute("position");
  const result = new Float64Array(rest.count);
  const targets = geometry.morphAttributes.position ?? [];
  for (const name of names) {
    const target = targets[mesh.morphTargetDictionary?.[name] ?? -1];
    if (!target) continue;
    for (let index = 0; index < rest.count; index++)
      result[index] += target.getX(index) ** 2 + target.getY(index) ** 2 + target.getZ(index) ** 2;
  }
  return result;
}

/** How far a camera must stand so that the frame fits, for the given field of view and aspect. */
export function distance(frame: Frame, fieldOfView: number, aspect: number): number {
  const tangent = Math.tan((fieldOfView * Math.PI) / 360);
  return Math.max(frame.halfHeight, frame.halfWidth / aspect) / tangent;
}
