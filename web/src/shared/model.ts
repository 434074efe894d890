/** The model out of its GLB, with its morph targets and driven joints found by name. */

import { Mesh, Quaternion, Vector3, type Material, type Object3D } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

/** How a channel turns a joint: about an axis in the joint's own space, so far at 1. */
export interface Turn {
  node: number;
  axis: [number, number, number];
  degrees: number;
}

interface Joint {
  object: Object3D;
  rest: Quaternion;
  axis: Vector3;
  radians: number;
  value: number;
}

/** Vertices that may be added to spare a program. */
const SPARE = 100_000;

export class Model {
  readonly root: Object3D;
  readonly meshes: Mesh[] = [];
  #names = new Set<string>();
  #joints = new Map<string, Joint>();

  constructor(root: Object3D) {
    this.root = root;
    root.traverse((object) => {
      if (!(object instanceof Mesh)) return;
      object.frustumCulled = false;
      for (const material of [object.material].flat() as Material[]) {
        // What is seen edge-on, as the sides of a mouth from inside, must not show through the skin.
        material.polygonOffset = true;
        material.polygonOffsetFactor = 1;
      }
      if (!object.morphTargetDictionary || !object.morphTargetInfluences) return;
      this.meshes.push(object);
      for (const name of Object.keys(object.morphTargetDictionary)) this.#names.add(name);
    });
    level(this.meshes);
  }

  /** Let a channel turn a joint. */
  drive(name: string, object: Object3D, turn: Turn): void {
    const axis = new Vector3(...turn.axis).normalize();
    const radians = (turn.degrees * Math.PI) / 180;
    this.#joints.set(name, { object, rest: object.quaternion.clone(), axis, radians, value: 0 });
    this.#names.add(name);
  }

  /** The names of the channels that turn joints. */
  get joints(): string[] {
    return [...this.#joints.keys()];
  }

  get names(): string[] {
    return [...this.#names];
  }

  has(name: string): boolean {
    return this.#names.has(name);
  }

  /** Set one morph target in every mesh that has it, or turn the joint of that channel. */
  set(name: string, weight: number): void {
    const joint = this.#joints.get(name);
    if (joint) {
      joint.value = weight;
      this.#turn(joint.object);
      return;
    }
    for (const mesh of this.meshes) {
      const index = mesh.morphTargetDictionary?.[name];
      if (index !== undefined && mesh.morphTargetInfluences)
        mesh.morphTargetInfluences[index] = weight;
    }
  }

  /** Turn a joint away from rest by all channels that turn it: axes times angles are added. */
  #turn(object: Object3D): void {
    const total = new Vector3();
    let rest: Quaternion | null = null;
    for (const joint of this.#joints.values()) {
      if (joint.object !== object) continue;
      total.addScaledVector(joint.axis, joint.radians * joint.value);
      rest = joint.rest;
    }
    const angle = total.length();
    const turn = new Quaternion().setFromAxisAngle(total.normalize(), angle);
    if (rest) object.quaternion.copy(rest).multiply(turn);
  }

  /** What the joints of these channels take along: each vertex's squared displacement at 1. */
  turned(names: string[]): Map<Mesh, Float64Array> {
    const used = names.filter((name) => this.#joints.has(name));
    const result = new Map<Mesh, Float64Array>();
    if (!used.length) return result;
    for (const name of used) this.set(name, 0);
    const before = this.positions();
    for (const name of used) this.set(name, 1);
    const after = this.positions();
    for (const name of used) this.set(name, 0);
    this.root.updateMatrixWorld(true);
    this.root.traverse((object) => {
      if (!(object instanceof Mesh)) return;
      const [from, to] = [before, after].map((places) => places[object.name || object.uuid]);
      const squares = new Float64Array(from.length / 3);
      from.forEach((value, index) => (squares[Math.floor(index / 3)] += (to[index] - value) ** 2));
      if (squares.some((square) => square > 0)) result.set(object, squares);
    });
    return result;
  }

  /** The value that each morph target and each turned joint has now. */
  weights(): Record<string, number> {
    const result: Record<string, number> = {};
    for (const [name, joint] of this.#joints) result[name] = joint.value;
    for (const mesh of this.meshes)
      for (const [name, index] of Object.entries(mesh.morphTargetDictionary ?? {}))
        result[name] = mesh.morphTargetInfluences?.[index] ?? 0;
    return result;
  }

  /** Where the vertices of each mesh are now, morphed, in the world: x, y, z after each other. */
  positions(): Record<string, number[]> {
    const result: Record<string, number[]> = {};
    const place = new Vector3();
    this.root.updateMatrixWorld(true);
    this.root.traverse((object) => {
      if (!(object instanceof Mesh)) return;
      const list: number[] = [];
      const count = object.geometry.getAttribute("position").count;
      for (let index = 0; index < count; index++) {
        object.getVertexPosition(index, place).applyMatrix4(object.matrixWorld);
        list.push(place.x, place.y, place.z);
      }
      result[object.name || object.uuid] = list;
    });
    return result;
  }
}

/** Give meshes as many targets as the richest has: each number needs shaders of its own. */
function level(meshes: Mesh[]): void {
  const most = Math.max(0, ...meshes.map((mesh) => mesh.morphTargetInfluences?.length ?? 0));
  for (const { geometry, morphTargetInfluences } of meshes) {
    const vertices = geometry.getAttribute("position").count;
    const missing = most - (morphTargetInfluences?.length ?? most);
    if (missing * vertices > SPARE) continue;
    for (const targets of Object.values(geometry.morphAttributes))
      for (let number = 0; number < missing; number++) targets?.push(targets[0]);
    for (let number = 0; number < missing; number++) morphTargetInfluences?.push(0);
  }
}

export async function loadModel(
  glb: ArrayBuffer,
  backwards: boolean,
  turns: Record<string, Turn>,
): Promise<Model> {
  const file = await new GLTFLoader().parseAsync(glb, "");
  if (backwards) file.scene.rotation.y = Math.PI;
  const model = new Model(file.scene);
  for (const [name, turn] of Object.entries(turns)) {
    file.scene.traverse((object) => {
      if (file.parser.associations.get(object)?.nodes === turn.node && !(object instanceof Mesh))
        model.drive(name, object, turn);
    });
  }
  return model;
}
