import assert from "node:assert/strict";
import { test } from "node:test";
import { BufferGeometry, Float32BufferAttribute, Group, Mesh } from "three";
import { Model } from "../src/model.ts";

/** A point that each target moves up, by 1, 2, 3 ... */
function meshWith(...names: string[]): Mesh {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute([0, 0, 0], 3));
  geometry.morphTargetsRelative = true;
  geometry.morphAttributes.position = names.map(
    (_, number) => new Float32BufferAttribute([0, number + 1, 0], 3),
  );
  return new Mesh(geometry);
}

test("meshes have equally many targets, and only their own move them", () => {
  const root = new Group();
  const [face, tongue] = [meshWith("open", "PBM", "wide"), meshWith("open")];
  for (const mesh of [face, tongue]) mesh.updateMorphTargets();
  face.morphTargetDictionary = { open: 0, PBM: 1, wide: 2 };
  tongue.morphTargetDictionary = { open: 0 };
  [face.name, tongue.name] = ["face", "tongue"];
  const model = new Model(root.add(face, tongue));
  assert.equal(tongue.morphTargetInfluences?.length, 3);
  assert.equal(tongue.geometry.morphAttributes.position?.length, 3);
  for (const name of model.names) model.set(name, 1);
  assert.deepEqual(model.positions(), { face: [0, 6, 0], tongue: [0, 1, 0] });
  assert.deepEqual(model.weights(), { open: 1, PBM: 1, wide: 1 });
});
