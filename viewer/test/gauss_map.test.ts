import assert from "node:assert/strict";
import { test } from "node:test";
import {
  averageLinkage,
  cut,
  gaussMap,
  lineAngle,
  lineAngles,
  rightAngle,
  triangleLines,
  triangleShapes,
  unitsPerDegree,
} from "../src/gauss_map";
import { random } from "./random";

/** Merges the closest of all pairs, over and over, from the distances of the items themselves. */
function slowLinkage(distances: Float64Array, count: number) {
  let clusters = Array.from({ length: count }, (_, i) => [i]);
  const merges = [];
  while (clusters.length > 1) {
    let best: { sum: number; pairs: number; a: number[]; b: number[] } | null = null;
    for (const a of clusters) {
      for (const b of clusters) {
        if (a[0] >= b[0]) continue;
        let sum = 0;
        for (const i of a) for (const j of b) sum += distances[i * count + j];
        const pairs = a.length * b.length;
        if (!best || sum * best.pairs < best.sum * pairs) best = { sum, pairs, a, b };
      }
    }
    const { sum, pairs, a, b } = best!;
    merges.push({
      first: a[0],
      second: b[0],
      firstSize: a.length,
      secondSize: b.length,
      height: sum / pairs,
    });
    clusters = [...clusters.filter((c) => c !== a && c !== b), [...a, ...b].sort((x, y) => x - y)];
    clusters.sort((x, y) => x[0] - y[0]);
  }
  return merges;
}

const byHeight = (merges: { height: number; first: number; second: number }[]) =>
  [...merges].sort((a, b) => a.height - b.height || a.first - b.first || a.second - b.second);

test("average linkage merges what the closest-pair rule merges", () => {
  const next = random(7);
  for (let round = 0; round < 60; ++round) {
    const count = 2 + Math.floor(next() * 14);
    const range = round % 2 === 0 ? 6 : 60000; // few values: many ties
    const distances = new Float64Array(count * count);
    for (let i = 0; i < count; ++i)
      for (let j = 0; j < i; ++j)
        distances[i * count + j] = distances[j * count + i] = Math.floor(next() * range);
    assert.deepEqual(
      byHeight(averageLinkage(distances.slice(), count)),
      byHeight(slowLinkage(distances, count)),
    );
  }
});

test("angles are those of the definition, within a unit", () => {
  for (let degrees = 0.05; degrees <= 90; degrees += 0.05) {
    const exact = degrees * unitsPerDegree;
    assert.ok(
      Math.abs(lineAngle(Math.fround(Math.cos((degrees * Math.PI) / 180))) - exact) <= 1.5,
      `${degrees}`,
    );
  }
  assert.equal(lineAngle(0), rightAngle);
  assert.equal(lineAngle(1), 0);
  assert.equal(lineAngle(-1), 0);
  assert.deepEqual([...lineAngles(Float32Array.of(1, 0, 0, 0, -1, 0))], [0, rightAngle, rightAngle, 0]);
});

test("triangles without a usable normal make no lines", () => {
  const offsets = Float64Array.of(1, 0, 0, 2, 0, 0, 0, 3, 0);
  assert.deepEqual([...triangleLines(offsets, { minSine: 0.001, triangles: null })], [0, 0, 1, 0, 0, 1]);
  const slender = Float64Array.of(1, 0, 0, 1, 0.01, 0);
  assert.equal(triangleLines(slender, { minSine: 0.1, triangles: null }).length, 0);
});

test("the best triangles are those nearest to equilateral", () => {
  const corner = (degrees: number) => [
    Math.cos((degrees * Math.PI) / 180),
    Math.sin((degrees * Math.PI) / 180),
    0,
  ];
  // Shapes: of 60 degrees, of 30, of 90.
  const offsets = Float64Array.from([...corner(0), ...corner(60), ...corner(90)]);
  const [sixty, ninety, thirty] = triangleShapes(offsets);
  assert.ok(sixty >= 254 && ninety === 192 && thirty < ninety);
  const count = (triangles: number | null) => triangleLines(offsets, { minSine: 0.001, triangles }).length / 3;
  assert.deepEqual([1, 2, 3, 4, null].map(count), [1, 2, 3, 3, 3]);
});

test("a point on a plane has one cluster, on a crease two", () => {
  // Around the origin: half circles of eight neighbours in the planes z = 0, x > 0 and x = 0, z > 0.
  const ring = (x: number, z: number) =>
    Array.from({ length: 8 }, (_, i) => {
      const angle = ((i + 0.5) * Math.PI) / 8 - Math.PI / 2;
      return [
        1000 + Math.round(x * 100 * Math.cos(angle)),
        1000 + Math.round(100 * Math.sin(angle)),
        1000 + Math.round(z * 100 * Math.cos(angle)),
      ];
    }).flat();
  const neighbors = Uint32Array.from({ length: 16 }, (_, i) => i + 1);
  const options = { minSine: 0.001, triangles: null, minCluster: null };
  const plane = gaussMap(
    Uint32Array.of(1000, 1000, 1000, ...ring(1, 0), ...ring(-1, 0)),
    0,
    neighbors,
    options,
  );
  assert.deepEqual(cut(plane, 20 * unitsPerDegree).sizes, [plane.lines.length / 3]);
  const crease = gaussMap(
    Uint32Array.of(1000, 1000, 1000, ...ring(1, 0), ...ring(0, 1)),
    0,
    neighbors,
    options,
  );
  const faces = cut(crease, 1 * unitsPerDegree);
  assert.deepEqual(faces.sizes.slice(0, 2), [28, 28]); // the 8 · 7 / 2 triangles of either face
  assert.equal(cut(crease, rightAngle).sizes.length, 1);
  assert.equal(cut(crease, rightAngle).sizes[0], crease.lines.length / 3);
});

test("without lines there is nothing to cut", () => {
  const none = gaussMap(Uint32Array.of(0, 0, 0), 0, new Uint32Array(0), {
    minSine: 0.001,
    triangles: null,
    minCluster: null,
  });
  assert.deepEqual(cut(none, 1000).sizes, []);
});
