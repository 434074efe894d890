/** The model out of its GLB, with its morph targets found by name. */

import { Mesh, Vector3, type Material, type Object3D } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

/** Vertices that may be added to spare a program. */
const SPARE = 100_000;

export class Model {
  readonly root: Object3D;
  readonly meshes: Mesh[] = [];
  #names = new Set<string>();

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

  get names(): string[] {
    return [...this.#names];
  }

  has(name: string): boolean {
    return this.#names.has(name);
  }

  /** Set one morph target in every mesh that has it. */
  set(name: string, weight: number): void {
    for (const mesh of this.meshes) {
      const index = mesh.morphTargetDictionary?.[name];
      if (index !== undefined && mesh.morphTargetInfluences)
        mesh.morphTargetInfluences[index] = weight;
    }
  }

  /** The weight that each morph target has now. */
  weights(): Record<string, number> {
    const result: Record<string, number> = {};
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

export async function loadModel(glb: ArrayBuffer, backwards: boolean): Promise<Model> {
  const file = await new GLTFLoader().parseAsync(glb, "");
  if (backwards) file.scene.rotation.y = Math.PI;
  return new Model(file.scene);
}
