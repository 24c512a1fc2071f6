import assert from "node:assert/strict";
import { test } from "node:test";
import { deflateSync } from "node:zlib";
import { bytesFromBase64, decodeColumns, inflate, type Numbers } from "../src/data";
import { encodeColumns, type Column } from "./encode";

const extremes: Numbers[] = [
  Uint8Array.of(0, 255, 0, 1, 128, 127, 3, 200),
  Uint16Array.of(0, 65535, 0, 1, 32768, 32767, 500, 499),
  Uint32Array.of(0, 4294967295, 0, 1, 2147483648, 2147483647, 70000, 69999),
];

test("every type, coding and number of components comes back", () => {
  const columns: Column[] = [];
  for (const values of extremes)
    for (const components of [1, 2, 4])
      for (const coding of ["raw", "planes", "delta"] as const)
        columns.push({ name: `${columns.length}`, values, components, coding });
  const { buffers, bytes } = encodeColumns(columns);
  const decoded = decodeColumns(buffers, bytes);
  for (const { name, values } of columns) assert.deepEqual(decoded.get(name), values);
});

test("the layout is the documented one", () => {
  const delta = {
    name: "d",
    type: "uint16",
    components: 2,
    count: 2,
    coding: "delta",
    offset: 1,
    bytes: 8,
  } as const;
  // Component 0: 5, then -3 (folded 10, 5); component 1: 256, then +1 (folded 512, 2). Low bytes before high ones.
  const bytes = Uint8Array.of(99, 10, 5, 0, 0, 0, 2, 2, 0);
  assert.deepEqual(decodeColumns([delta], bytes).get("d"), Uint16Array.of(5, 256, 2, 257));
});

test("columns of no points are empty", () => {
  const { buffers, bytes } = encodeColumns([
    { name: "position", values: new Uint32Array(0), components: 3, coding: "delta" },
  ]);
  assert.equal(decodeColumns(buffers, bytes).get("position")?.length, 0);
});

test("data that are cut short are refused", () => {
  const { buffers, bytes } = encodeColumns([{ name: "kind", values: Uint8Array.of(1, 2, 3) }]);
  assert.throws(() => decodeColumns(buffers, bytes.subarray(0, 2)), /“kind”/);
});

test("base64 of any length, and zlib", async () => {
  for (const length of [0, 1, 2, 3, 4, 1000, 1 << 20, (1 << 20) + 1]) {
    const bytes = Buffer.from(Uint8Array.from({ length }, (_, i) => (i * 31 + (i >> 8)) & 255));
    assert.ok(bytes.equals(bytesFromBase64(`\n${bytes.toString("base64")}\n`)), `${length} bytes`);
  }
  const text = Buffer.from("sharp features");
  assert.ok(text.equals(await inflate(bytesFromBase64(deflateSync(text).toString("base64")))));
});
