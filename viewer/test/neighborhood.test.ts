import assert from "node:assert/strict";
import { test } from "node:test";
import { NeighborSearch, type Coordinates } from "../src/neighborhood";
import { random } from "./random";

function slowNearest(c: Coordinates, point: number, count: number): Uint32Array {
  const squared = (q: number) =>
    [0, 1, 2].reduce((sum, axis) => sum + (c[3 * q + axis] - c[3 * point + axis]) ** 2, 0);
  const others = Array.from({ length: c.length / 3 }, (_, q) => ({ q, d: squared(q) })).filter(
    ({ d }) => d > 0,
  );
  return Uint32Array.from(others.sort((a, b) => a.d - b.d || a.q - b.q).slice(0, count), ({ q }) => q);
}

const next = random(3);
const clouds: Record<string, Coordinates> = {
  "spread in space": Uint32Array.from({ length: 3 * 400 }, () => next() * 2 ** 21),
  "a plane": Uint32Array.from({ length: 3 * 400 }, (_, i) => (i % 3 === 2 ? 77 : next() * 2 ** 21)),
  "a line": Uint32Array.from({ length: 3 * 200 }, (_, i) => (i % 3 === 0 ? next() * 2 ** 21 : 5)),
  "a grid full of ties": Uint32Array.from(
    { length: 3 * 343 },
    (_, i) => Math.floor(Math.floor(i / 3) / 7 ** (i % 3)) % 7,
  ),
  "many that coincide": Uint32Array.from({ length: 3 * 300 }, () => Math.floor(next() * 4)),
  "a dense clump and a few far away": Uint32Array.from({ length: 3 * 300 }, (_, i) =>
    i < 870 ? next() * 500 : next() * 2 ** 21,
  ),
  "fractions below zero": Float64Array.from({ length: 3 * 300 }, () => next() * 100 - 50),
};

for (const [name, cloud] of Object.entries(clouds)) {
  test(`the nearest are those of a full search: ${name}`, () => {
    const search = new NeighborSearch(cloud);
    for (let point = 0; point < cloud.length / 3; point += 7)
      for (const count of [1, 16, 40])
        assert.deepEqual(search.nearest(point, count), slowNearest(cloud, point, count));
  });
}

test("where there are fewer points, all are neighbours", () => {
  assert.deepEqual(new NeighborSearch(Uint32Array.of(9, 9, 9)).nearest(0, 16), new Uint32Array(0));
  assert.deepEqual(new NeighborSearch(Uint32Array.of(9, 9, 9, 9, 9, 9)).nearest(0, 16), new Uint32Array(0));
  assert.deepEqual(
    new NeighborSearch(Uint32Array.of(0, 0, 0, 5, 0, 0, 1, 0, 0)).nearest(0, 16),
    Uint32Array.of(2, 1),
  );
});
