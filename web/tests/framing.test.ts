import assert from "node:assert/strict";
import { test } from "node:test";
import { BufferGeometry, Float32BufferAttribute, Group, Mesh } from "three";
import { distance, framing } from "../src/shared/framing.ts";

/** A column of points from the floor to `height`; at the lips four of them are moved by "PBM". */
function figure(height: number, lips: number): { root: Group; mesh: Mesh } {
  const places = [-0.1, 0, 0, 0.1, height, 0, 0, 0, 0.1];
  const moves = new Array(9).fill(0);
  for (const [x, y] of [
    [-0.025, 0],
    [0.025, 0],
    [0, 0.008],
    [0, -0.008],
  ]) {
    places.push(x, lips + y, 0.1);
    moves.push(0, 0.01, 0);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(places, 3));
  geometry.morphAttributes.position = [new Float32BufferAttribute(moves, 3)];
  const mesh = new Mesh(geometry);
  mesh.morphTargetDictionary = { PBM: 0 };
  const root = new Group();
  root.add(mesh);
  return { root, mesh };
}

test("the mouth is where the lips move", () => {
  const { root, mesh } = figure(0.3, 0.1);
  const { mouth } = framing(root, [mesh], ["PBM"]);
  assert.ok(Math.abs(mouth.centre.y - 0.1) < 1e-6);
  assert.ok(Math.abs(mouth.centre.x) < 1e-6);
  assert.ok(mouth.halfHeight > 0.015 && mouth.halfHeight < 0.06);
});

test("a head is framed as a whole, of a figure only the head", () => {
  const head = figure(0.3, 0.1);
  assert.ok(framing(head.root, [head.mesh], ["PBM"]).head.halfHeight > 0.12);
  const body = figure(1.8, 1.6);
  const framed = framing(body.root, [body.mesh], ["PBM"]).head;
  assert.ok(framed.centre.y > 1.55 && framed.centre.y < 1.75);
  assert.ok(framed.halfHeight < 0.3);
});

test("a head fills most of its frame, from the chin up", () => {
  const { root, mesh } = figure(0.3, 0.1);
  const { head } = framing(root, [mesh], ["PBM"]);
  const filled = (0.3 - (head.centre.y - head.halfHeight)) / (2 * head.halfHeight);
  assert.ok(filled > 0.85 && filled < 0.95, `${filled} up to the crown`);
  assert.ok(head.centre.y - head.halfHeight > 0.04, "the shoulders are left out");
});

test("a model whose targets do not move is framed as a whole", () => {
  const { root, mesh } = figure(0.3, 0.1);
  const { head, mouth } = framing(root, [mesh], []);
  assert.deepEqual(head, mouth);
});

test("a narrow window needs more distance", () => {
  const { head } = framing(figure(0.3, 0.1).root, [], []);
  assert.ok(distance(head, 22, 0.4) > distance(head, 22, 1.6));
});
