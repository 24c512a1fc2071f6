import type { Axes } from "./camera";
import { colorOfCluster, css } from "./colors";
import { prepared } from "./dom";
import type { Vector } from "./facts";
import type { Cut, GaussMap } from "./gauss_map";

const names = ["x", "y", "z"];

/** Draws the Gauss map on a sphere, seen from where the cloud is seen: the far half faint. */
export function drawSphere(canvas: HTMLCanvasElement, map: GaussMap, cut: Cut, axes: Axes): void {
  const size = canvas.clientWidth;
  canvas.style.height = `${size}px`;
  const context = size > 0 ? prepared(canvas, size, size) : null;
  if (!context) return;
  const radius = size * 0.42;
  const place = (direction: Vector) => ({
    x: size / 2 + radius * dot(axes.right, direction),
    y: size / 2 - radius * dot(axes.up, direction),
  });
  const style = getComputedStyle(canvas);
  drawBall(context, size / 2, radius, style);
  for (const isFront of [false, true]) {
    drawPlanes(context, axes, place, isFront, style.getPropertyValue("--quiet"));
    drawLines(context, map, cut, axes, place, isFront, radius / 30);
  }
  drawNames(context, axes, size / 2, radius, style);
}

function drawBall(
  on: CanvasRenderingContext2D,
  middle: number,
  radius: number,
  style: CSSStyleDeclaration,
): void {
  const light = on.createRadialGradient(
    middle - 0.35 * radius,
    middle - 0.45 * radius,
    0,
    middle,
    middle,
    radius,
  );
  light.addColorStop(0, style.getPropertyValue("--raised"));
  light.addColorStop(1, style.getPropertyValue("--stage"));
  on.fillStyle = light;
  on.strokeStyle = style.getPropertyValue("--rule");
  on.beginPath();
  on.arc(middle, middle, radius, 0, 2 * Math.PI);
  on.fill();
  on.stroke();
}

type Place = (direction: Vector) => { x: number; y: number };

/** The circles of the coordinate planes, on one half of the sphere. */
function drawPlanes(
  on: CanvasRenderingContext2D,
  axes: Axes,
  place: Place,
  isFront: boolean,
  color: string,
): void {
  on.strokeStyle = color;
  on.globalAlpha = isFront ? 0.45 : 0.15;
  for (let normal = 0; normal < 3; ++normal) {
    on.beginPath();
    let isDown = false;
    for (let step = 0; step <= 96; ++step) {
      const angle = (step * Math.PI) / 48;
      const direction: Vector = [0, 0, 0];
      direction[(normal + 1) % 3] = Math.cos(angle);
      direction[(normal + 2) % 3] = Math.sin(angle);
      const isHere = dot(axes.toward, direction) >= 0 === isFront;
      const { x, y } = place(direction);
      if (isHere && isDown) on.lineTo(x, y);
      else on.moveTo(x, y);
      isDown = isHere;
    }
    on.stroke();
  }
  on.globalAlpha = 1;
}

/** Every line is seen at both its ends, one of which faces the viewer. Several in one place are a larger dot. */
function drawLines(
  on: CanvasRenderingContext2D,
  map: GaussMap,
  cut: Cut,
  axes: Axes,
  place: Place,
  isFront: boolean,
  size: number,
): void {
  const dots = new Map<string, { x: number; y: number; cluster: number; count: number }>();
  cut.cluster.forEach((cluster, i) => {
    const line: Vector = [map.lines[3 * i], map.lines[3 * i + 1], map.lines[3 * i + 2]];
    const sign = dot(axes.toward, line) >= 0 === isFront ? 1 : -1;
    const { x, y } = place([sign * line[0], sign * line[1], sign * line[2]]);
    const key = `${cluster} ${Math.round(x)} ${Math.round(y)}`;
    const dotHere = dots.get(key) ?? { x, y, cluster, count: 0 };
    dots.set(key, { ...dotHere, count: dotHere.count + 1 });
  });
  on.globalAlpha = isFront ? 0.92 : 0.22;
  for (const { x, y, cluster, count } of [...dots.values()].sort((a, b) => a.cluster - b.cluster)) {
    on.fillStyle = css(colorOfCluster(cluster));
    on.beginPath();
    on.arc(x, y, size * (1 + 0.35 * Math.log2(count)), 0, 2 * Math.PI);
    on.fill();
  }
  on.globalAlpha = 1;
}

/** At the ends of the coordinate axes that face the viewer. */
function drawNames(
  on: CanvasRenderingContext2D,
  axes: Axes,
  middle: number,
  radius: number,
  style: CSSStyleDeclaration,
): void {
  on.font = `10.5px ${style.fontFamily}`;
  on.fillStyle = style.getPropertyValue("--quiet");
  on.textAlign = "center";
  on.textBaseline = "middle";
  names.forEach((name, axis) => {
    for (const sign of [1, -1]) {
      if (sign * axes.toward[axis] < 0.05) continue;
      // Clear of the dots, which gather where faces are parallel to the coordinate planes.
      const away = 1 + 0.16 / Math.max(0.3, Math.hypot(axes.right[axis], axes.up[axis]));
      const x = middle + radius * away * sign * axes.right[axis];
      const y = middle - radius * away * sign * axes.up[axis];
      on.fillText(`${sign > 0 ? "+" : "−"}${name}`, x, y);
    }
  });
}

function dot(a: Vector, b: Vector): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
