import assert from "node:assert/strict";
import { test } from "node:test";
import { BufferGeometry, Float32BufferAttribute, Group, Mesh, Quaternion, Vector3 } from "three";
import { Model } from "../src/shared/model.ts";

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

test("a joint turns within its own space, away from its rest, and tells what it takes along", () => {
  const [root, jaw] = [new Group(), new Group()];
  const chin = meshWith("PBM");
  chin.name = "chin";
  chin.position.set(0, 0, 0.1);
  jaw.quaternion.setFromAxisAngle(new Vector3(0, 0, 1), Math.PI / 2);
  root.add(jaw.add(chin));
  const model = new Model(root);
  const rest = jaw.quaternion.clone();
  model.drive("Jaw", jaw, { node: 0, axis: [0, -1, 0], degrees: 30 });
  model.set("Jaw", 0.5);
  // The joint's own -y is the world's x: what lies in front of it goes down.
  const [x, y] = model.positions()["chin"];
  assert.ok(Math.abs(x) < 1e-9);
  assert.ok(Math.abs(y + 0.1 * Math.sin(Math.PI / 12)) < 1e-9);
  const turn = new Quaternion().setFromAxisAngle(new Vector3(0, -1, 0), Math.PI / 12);
  assert.ok(jaw.quaternion.angleTo(rest.clone().multiply(turn)) < 1e-6);
  assert.equal(model.weights()["Jaw"], 0.5);
  const moved = model.turned(["Jaw"]).get(chin);
  assert.ok(Math.abs(Math.sqrt(moved?.[0] ?? 0) - 0.2 * Math.sin(Math.PI / 12)) < 1e-9);
  assert.ok(jaw.quaternion.angleTo(rest) < 1e-6);
});
