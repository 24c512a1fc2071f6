import assert from "node:assert/strict";
import { test } from "node:test";
import { decodeColumns } from "../src/data";
import { kinds, localSensitivity, relabel, sensitivityOf, spectrumFrom } from "../src/labels";
import { Result } from "../src/result";
import { encodeColumns, type Column } from "./encode";
import { creaseColumns, factsOf } from "./fixture";

test("a step holds from its sensitivity up to the next", () => {
  const spectrum = spectrumFrom(
    Uint8Array.of(1, 3),
    Uint16Array.of(100, 65000),
    Uint8Array.of(0, 2, 1, 0),
    Uint8Array.of(1, 2, 9, 1),
  );
  const kind = new Uint8Array(2);
  const clusters = new Uint8Array(2);
  for (const [sensitivity, expected] of [
    [0, 2],
    [99, 2],
    [100, 1],
    [65099, 1],
    [65100, 0],
    [65520, 0],
  ]) {
    relabel(spectrum, sensitivity, kind, clusters);
    assert.deepEqual([...kind], [0, expected], `${sensitivity}`);
  }
  assert.deepEqual([...clusters], [1, 1]);
});

test("of one point: the middle of the widest range of a kind between 8 and 45 degrees", () => {
  const lasting = (...steps: [number, number][]) => {
    const rises = steps.slice(1).map(([from], i) => (from - steps[i][0]) * 728);
    const kind = Uint8Array.from(steps, ([, k]) => k);
    return spectrumFrom(
      Uint8Array.of(steps.length),
      Uint16Array.from(rises),
      kind,
      new Uint8Array(steps.length),
    );
  };
  const degrees = (...steps: [number, number][]) => localSensitivity(lasting(...steps), 0) / 728;
  assert.equal(degrees([0, 0]), 26.5);
  assert.equal(degrees([0, 1], [10, 2], [30, 0]), 20);
  assert.equal(degrees([0, 1], [4, 2], [12, 0]), 28.5); // of 4 to 12 only 8 to 12 counts
  assert.equal(degrees([0, 1], [8, 2], [60, 0]), 26.5);
  assert.equal(degrees([0, 1], [16, 2], [32, 0]), 24); // 8 to 16 and 16 to 32: equally wide, the higher
});

test("what the method looked at is where the points are, and the offset", () => {
  const columns: Column[] = [
    { name: "position", values: Uint32Array.of(10, 20, 30, 0, 0, 0), components: 3, coding: "delta" },
    { name: "seen_offset", values: Uint32Array.of(0, 1, 2, 3, 4, 5), components: 3, coding: "planes" },
  ];
  const { buffers, bytes } = encodeColumns(columns);
  const result = new Result({ ...factsOf(2), buffers }, decodeColumns(buffers, bytes));
  assert.deepEqual([...result.seen()], [10, 19, 31, -2, 2, -3]);
});

test("sensitivities are rounded down", () => {
  assert.equal(sensitivityOf(90), 65520);
  assert.equal(sensitivityOf(32.34375), 23546);
  assert.equal(sensitivityOf(20 - 1e-9), 20 * 728 - 1);
});

test("labels follow sigma, counts are the program's, and its own labels come back", () => {
  const { columns, points } = creaseColumns(5);
  const { buffers, bytes } = encodeColumns(columns);
  const facts = { ...factsOf(points), buffers };
  facts.kinds = facts.kinds.map((kind) => ({
    ...kind,
    count: kind.name === "edge" ? 5 : kind.name === "flat" ? points - 5 : 0,
  }));
  const result = new Result(facts, decodeColumns(buffers, bytes));
  const edges = () => result.kind.filter((k) => k === kinds.edge).length;
  assert.equal(edges(), 5);
  result.setSigma(59.99);
  assert.equal(edges(), 5);
  assert.equal(result.featuresAt(59.99), 5);
  result.setSigma(60);
  assert.equal(edges(), 0);
  assert.equal(result.countOfKinds().get(kinds.edge), 0);
  assert.equal(result.countOfKinds().get(kinds.flat), points);
  result.setSigma(null);
  assert.equal(edges(), 5);
  assert.equal(result.sigmaDeg, 20);
});
