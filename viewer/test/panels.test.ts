import assert from "node:assert/strict";
import { test } from "node:test";
import { Matrix4 } from "three";
import { colorOfShare, fromHex, truthOf } from "../src/colors";
import { scattered } from "../src/cloud";
import { baseName, linesObj } from "../src/downloads";
import { lineFacts, pathOf, type Graph } from "../src/graph";
import { pickPoint } from "../src/pick";
import { sortedLines } from "../src/table";
import { linkText, parseLink, type LinkedView } from "../src/view_link";

const graph: Graph = {
  crs: null,
  corners: [],
  polylines: [
    {
      vertices: [
        [0, 0, 0],
        [3, 4, 0],
      ],
      dihedral_deg: [90, 91, 150],
      support: 7,
    },
    {
      vertices: [
        [0, 0, 0],
        [1, 0, 0],
        [0, 1, 0],
      ],
      closed: true,
      kind: "border",
    },
  ],
};

test("what the table says of lines follows from them", () => {
  const [open, closed] = lineFacts(graph);
  assert.deepEqual(open, {
    number: 0,
    kind: "crease",
    length: 5,
    dihedral_deg: 91,
    closed: false,
    support: 7,
  });
  assert.equal(closed.length, 2 + Math.SQRT2);
  assert.equal(closed.dihedral_deg, null);
  assert.equal(pathOf(graph.polylines[1]).length, 4);
});

test("lines are sorted both ways, what is not known last", () => {
  const lines = lineFacts(graph);
  assert.deepEqual(
    sortedLines(lines, "length", true).map((l) => l.number),
    [1, 0],
  );
  assert.deepEqual(
    sortedLines(lines, "length", false).map((l) => l.number),
    [0, 1],
  );
  assert.deepEqual(
    sortedLines(lines, "support", true).map((l) => l.number),
    [0, 1],
  );
  assert.deepEqual(
    sortedLines(lines, "support", false).map((l) => l.number),
    [0, 1],
  );
});

test("lines as OBJ: closed ones return to their first vertex", () => {
  assert.match(linesObj(graph), /^v 0 0 0\nv 3 4 0\nl 1 2\nv 0 0 0\nv 1 0 0\nv 0 1 0\nl 3 4 5 3\n$/);
});

test("names of files are harmless", () => {
  assert.equal(baseName("scan.las"), "scan");
  for (const name of ["../../etc/passwd", "<img onerror=x>.ply", "a/b\\c:d.ply", "", "...", "\u0000.ply"])
    assert.match(baseName(name), /^[\p{L}\p{N}][\p{L}\p{N}._-]*$/u, name);
});

test("a link says what it was made of", () => {
  const view: LinkedView = {
    pose: { target: [0.1, -2, 3e-5], height: 0.5, azimuthDeg: -60, elevationDeg: 25, isPerspective: false },
    sigmaDeg: 12.5,
    coloring: { attribute: "a & b=c" },
    hidden: [0, 255],
    showsLines: false,
    pointNumber: 12,
  };
  assert.deepEqual(parseLink(`#${linkText(view)}`), view);
  assert.deepEqual(parseLink(""), {});
});

test("of points under the pointer the foremost is meant, unless another one beside it is nearer to the pointer", () => {
  // Without a projection: x and y from -1 to 1, z away from the viewer.
  const points = Float32Array.of(0, 0, 0.5, 0.01, 0, -0.5, 0.002, 0, -0.49, 0.9, 0, -1);
  const pick = (tolerance: number, thickness: number, isShown = (_: number) => true) =>
    pickPoint(
      points,
      new Matrix4(),
      { width: 200, height: 200 },
      { x: 100, y: 100, tolerance },
      thickness,
      isShown,
    );
  assert.equal(pick(5, 0.001), 1);
  assert.equal(pick(5, 0.1), 2);
  assert.equal(
    pick(5, 0.1, (point) => point === 0),
    0,
  );
  assert.equal(
    pick(5, 0.1, () => false),
    -1,
  );
});

test("the first few of a scattered order are spread over all", () => {
  for (const count of [0, 1, 2, 3, 10, 97, 1000]) {
    const order = scattered(count);
    assert.deepEqual(
      [...order].sort((a, b) => a - b),
      Array.from({ length: count }, (_, i) => i),
    );
  }
  const first = [...scattered(10000).subarray(0, 100)].sort((a, b) => a - b);
  const gaps = first.slice(1).map((number, i) => number - first[i]);
  assert.ok(Math.max(...gaps) < 300, `${Math.max(...gaps)}`);
});

test("colours", () => {
  assert.deepEqual(fromHex("#d55e00"), [213, 94, 0]);
  assert.deepEqual(colorOfShare(0), [68, 1, 84]);
  assert.deepEqual(colorOfShare(1), [253, 231, 37]);
  assert.deepEqual(colorOfShare(-5), colorOfShare(0));
  assert.equal(truthOf(2, 3), "hit");
  assert.equal(truthOf(5, 0), "rest");
  assert.equal(truthOf(4, 0), "false");
  assert.equal(truthOf(1, 2), "missed");
});
