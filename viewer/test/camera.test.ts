import assert from "node:assert/strict";
import { test } from "node:test";
import { Vector4 } from "three";
import {
  axesOf,
  cameraOf,
  facing,
  fitted,
  projectionOf,
  shifted,
  turned,
  zoomed,
  type Pose,
} from "../src/camera";
import type { Vector } from "../src/facts";
import { standardPose } from "../src/stage";

const poses: Pose[] = [true, false].flatMap((isPerspective) =>
  [-90, -30, 0, 25, 90].map((elevationDeg) => ({
    ...standardPose,
    isPerspective,
    elevationDeg,
    azimuthDeg: 70,
  })),
);
const dot = (a: Vector, b: Vector) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Where a position is on the screen, -1 to 1. */
function placeOf(pose: Pose, aspect: number, position: Vector): { x: number; y: number; z: number } {
  const clip = new Vector4(...position, 1).applyMatrix4(projectionOf(cameraOf(pose, aspect, 10)));
  return { x: clip.x / clip.w, y: clip.y / clip.w, z: clip.z / clip.w };
}

test("the axes are those of the program's pictures", () => {
  const { right, up, toward } = axesOf({ ...standardPose, azimuthDeg: -90, elevationDeg: 0 });
  for (const [axis, expected] of [
    [right, [1, 0, 0]],
    [up, [0, 0, 1]],
    [toward, [0, -1, 0]],
  ]) {
    axis.forEach((a, i) => assert.ok(Math.abs(a - expected[i]) < 1e-12));
  }
  for (const pose of poses) {
    const axes = axesOf(pose);
    for (const axis of Object.values(axes)) assert.ok(Math.abs(dot(axis, axis) - 1) < 1e-12);
    assert.ok(Math.abs(dot(axes.right, axes.up)) + Math.abs(dot(axes.up, axes.toward)) < 1e-12);
  }
});

test("what was fitted is on the screen, and fills it", () => {
  const low: Vector = [-1, 0.2, 3];
  const high: Vector = [1, 0.9, 3.5];
  for (const pose of poses) {
    for (const aspect of [0.5, 1, 2]) {
      const there = fitted(pose, low, high, aspect);
      let farthest = 0;
      for (let corner = 0; corner < 8; ++corner) {
        const at = [0, 1, 2].map((axis) => (corner & (1 << axis) ? high : low)[axis]) as Vector;
        const { x, y, z } = placeOf(there, aspect, at);
        assert.ok(Math.abs(z) < 1);
        farthest = Math.max(farthest, Math.abs(x), Math.abs(y));
      }
      assert.ok(farthest < 1 && farthest > 0.75, `${farthest}`);
    }
  }
});

test("zooming keeps what is under the pointer, shifting moves it as far as the pointer went", () => {
  for (const pose of poses) {
    const aspect = 1.6;
    const under = shifted(pose, 0.3, -0.2).target; // 0.3 heights to the right, 0.2 down
    const before = placeOf(pose, aspect, under);
    assert.ok(Math.abs(before.x * aspect - 0.6) < 1e-9 && Math.abs(before.y + 0.4) < 1e-9);
    const after = placeOf(zoomed(pose, 0.5, 0.3, -0.2), aspect, under);
    assert.ok(Math.abs(after.x - before.x) < 1e-9 && Math.abs(after.y - before.y) < 1e-9);
  }
});

test("turning stops at the poles and goes around them otherwise", () => {
  assert.equal(turned(standardPose, 0, 500).elevationDeg, 90);
  assert.equal(turned({ ...standardPose, azimuthDeg: 170 }, 30, 0).azimuthDeg, -160);
});

test("facing a position, it is in front of the middle", () => {
  for (const position of [
    [1, 0, 0],
    [-1, 2, 0.5],
    [0, 0, -1],
  ] as Vector[])
    assert.ok(dot(axesOf(facing(standardPose, position)).toward, position) > 0);
});
