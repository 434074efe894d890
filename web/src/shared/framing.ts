/** Where to look: the head, and the mouth in it, found from what moves. No picture is made here. */

import { Box3, Mesh, Vector3, type Object3D } from "three";

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

/** Share of the view that a head fills. */
const FILLED = 0.83;
/** Share of the greatest squared displacement that the chin surely has, and the neck has not. */
const MUCH = 0.3;

/** For each mesh that a turning joint takes along, the squared displacement of each vertex. */
export type Turned = Map<Mesh, Float64Array>;

export function framing(
  model: Object3D,
  morphed: Mesh[],
  used: string[],
  turned: Turned = new Map(),
): Framing {
  model.updateMatrixWorld(true);
  const meshes = [...new Set([...morphed, ...turned.keys()])];
  const box = new Box3().setFromObject(model);
  const size = box.getSize(new Vector3());
  const lips = used.filter((name) => LIPS.test(name));
  const moved = spread(meshes, lips.length ? lips : used, lips.length ? new Map() : turned);
  if (!moved) {
    const whole = frameOf(box);
    return { head: whole, mouth: whole };
  }
  const half = Math.max(moved.deviation.x, moved.deviation.y, 0.01 * size.y);
  // The lips are in front of most of what they take along.
  moved.mean.z += moved.deviation.z;
  const mouth = { centre: moved.mean, halfWidth: 1.75 * half, halfHeight: 1.75 * half };
  const head = headOf(model, meshes, used, turned, moved.mean.y - 1.8 * half);
  // Of a figure's height the head is a small part; of a face alone the chin may not move.
  const top = size.y > 30 * half ? moved.mean.y + 9 * half : head.max.y;
  head.max.y = Math.min(head.max.y, top);
  return { head: frameOf(head.max.y - head.min.y > 4 * half ? head : box), mouth };
}

/** What of a model lies above its chin: the lowest that moves much with the mouth, or `below`. */
function headOf(
  model: Object3D,
  meshes: Mesh[],
  used: string[],
  turned: Turned,
  below: number,
): Box3 {
  const moves = meshes.map((mesh) => displacement(mesh, used, turned));
  const most = moves.reduce((high, weights) => weights.reduce((a, b) => Math.max(a, b), high), 0);
  const place = new Vector3();
  let chin = below;
  meshes.forEach((mesh, number) => {
    moves[number].forEach((weight, index) => {
      if (weight < MUCH * most) return;
      chin = Math.min(chin, mesh.getVertexPosition(index, place).applyMatrix4(mesh.matrixWorld).y);
    });
  });
  const head = new Box3();
  model.traverse((object) => {
    if (!(object instanceof Mesh)) return;
    const rest = object.geometry.getAttribute("position");
    for (let index = 0; index < rest.count; index++) {
      object.getVertexPosition(index, place).applyMatrix4(object.matrixWorld);
      if (place.y >= chin) head.expandByPoint(place);
    }
  });
  return head;
}

/** A box with air around it, a little more below. */
function frameOf(box: Box3): Frame {
  const size = box.getSize(new Vector3());
  const centre = box.getCenter(new Vector3());
  centre.y -= 0.02 * size.y;
  return {
    centre,
    halfWidth: (0.5 * Math.max(size.x, size.z)) / FILLED,
    halfHeight: (0.5 * size.y) / FILLED,
  };
}

/** Mean and deviation of the vertices' places, weighted by the square of how far they move. */
function spread(
  meshes: Mesh[],
  names: string[],
  turned: Turned,
): { mean: Vector3; deviation: Vector3 } | null {
  const mean = new Vector3();
  const square = new Vector3();
  const place = new Vector3();
  let total = 0;
  for (const mesh of meshes) {
    const weights = displacement(mesh, names, turned);
    weights.forEach((weight, index) => {
      if (weight === 0) return;
      mesh.getVertexPosition(index, place).applyMatrix4(mesh.matrixWorld);
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

function displacement(mesh: Mesh, names: string[], turned: Turned): Float64Array {
  const geometry = mesh.geometry;
  const rest = geometry.getAttribute("position");
  const result = Float64Array.from(turned.get(mesh) ?? new Float64Array(rest.count));
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
