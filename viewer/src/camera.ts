import { Matrix4, OrthographicCamera, PerspectiveCamera, Vector3, type Camera } from "three";
import type { Vector } from "./facts";

/** Where the viewer stands and looks. z is up. */
export interface Pose {
  target: Vector; // what is in the middle of the screen
  height: number; // what of the plane through the target, facing the viewer, fits the screen from top to bottom
  azimuthDeg: number; // where the viewer stands: from the x axis counter-clockwise
  elevationDeg: number; // above the xy plane, -90 to 90
  isPerspective: boolean;
}

export interface Axes {
  right: Vector;
  up: Vector;
  toward: Vector; // to the viewer
}

const fieldOfViewDeg = 30;

export function axesOf(pose: Pose): Axes {
  const a = (pose.azimuthDeg * Math.PI) / 180;
  const e = (pose.elevationDeg * Math.PI) / 180;
  return {
    right: [-Math.sin(a), Math.cos(a), 0],
    up: [-Math.sin(e) * Math.cos(a), -Math.sin(e) * Math.sin(a), Math.cos(e)],
    toward: [Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)],
  };
}

/** \param aspect width / height \param reach how far things lie from the target at most */
export function cameraOf(pose: Pose, aspect: number, reach: number): Camera {
  const distance = pose.height / 2 / Math.tan((fieldOfViewDeg * Math.PI) / 360);
  const camera = pose.isPerspective
    ? new PerspectiveCamera(
        fieldOfViewDeg,
        aspect,
        Math.max(distance - reach, distance / 200),
        distance + reach,
      )
    : parallelCamera(pose.height, aspect, distance, reach);
  const { right, up, toward } = axesOf(pose);
  camera.matrixAutoUpdate = false;
  camera.matrix
    .makeBasis(new Vector3(...right), new Vector3(...up), new Vector3(...toward))
    .setPosition(...moved(pose.target, toward, distance));
  camera.matrixWorld.copy(camera.matrix);
  camera.matrixWorldInverse.copy(camera.matrix).invert();
  camera.updateProjectionMatrix();
  return camera;
}

function parallelCamera(height: number, aspect: number, distance: number, reach: number): OrthographicCamera {
  const up = height / 2;
  return new OrthographicCamera(-up * aspect, up * aspect, up, -up, distance - reach, distance + reach);
}

/** From the space of things to clip coordinates. */
export function projectionOf(camera: Camera): Matrix4 {
  return new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
}

export function moved(from: Vector, direction: Vector, by: number): Vector {
  return [from[0] + by * direction[0], from[1] + by * direction[1], from[2] + by * direction[2]];
}

/** Turned by degrees; the poles stop it. */
export function turned(pose: Pose, azimuthDeg: number, elevationDeg: number): Pose {
  const azimuth = (((pose.azimuthDeg + azimuthDeg + 180) % 360) + 360) % 360;
  const elevation = Math.min(90, Math.max(-90, pose.elevationDeg + elevationDeg));
  return { ...pose, azimuthDeg: azimuth - 180, elevationDeg: elevation };
}

/** Shifted by shares of the screen's height. */
export function shifted(pose: Pose, right: number, up: number): Pose {
  const axes = axesOf(pose);
  const sideways = moved(pose.target, axes.right, right * pose.height);
  return { ...pose, target: moved(sideways, axes.up, up * pose.height) };
}

/** Nearer by a factor below 1. What is at (x, y), in heights from the middle of the screen, stays there. */
export function zoomed(pose: Pose, factor: number, x = 0, y = 0): Pose {
  const height = Math.min(1e3, Math.max(1e-5, pose.height * factor));
  const kept = 1 - height / pose.height;
  return { ...shifted(pose, x * kept, y * kept), height };
}

/** Seen from where a position lies, as seen from the middle of things; never from straight above or below. */
export function facing(pose: Pose, [x, y, z]: Vector): Pose {
  const degrees = 180 / Math.PI;
  const elevation = Math.atan2(z, Math.hypot(x, y)) * degrees;
  return {
    ...pose,
    azimuthDeg: Math.atan2(y, x) * degrees,
    elevationDeg: Math.min(65, Math.max(-65, elevation)),
  };
}

/** The whole box fits, seen from where the viewer stands. */
export function fitted(pose: Pose, low: Vector, high: Vector, aspect: number): Pose {
  const axes = axesOf(pose);
  const half: Vector = [(high[0] - low[0]) / 2, (high[1] - low[1]) / 2, (high[2] - low[2]) / 2];
  const slope = pose.isPerspective ? 2 * Math.tan((fieldOfViewDeg * Math.PI) / 360) : 0;
  let height = 1e-5;
  for (let corner = 0; corner < 8; ++corner) {
    const at: Vector = [0, 1, 2].map((axis) => (corner & (1 << axis) ? half[axis] : -half[axis])) as Vector;
    const along = (axis: Vector) => axis[0] * at[0] + axis[1] * at[1] + axis[2] * at[2];
    // What is nearer to the viewer than the target takes more room.
    const beside = Math.max(Math.abs(along(axes.up)), Math.abs(along(axes.right)) / aspect);
    height = Math.max(height, 2 * beside + slope * along(axes.toward));
  }
  const target: Vector = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2];
  return { ...pose, target, height: 1.12 * height };
}
