import type { Matrix4 } from "three";

export interface Screen {
  width: number;
  height: number;
}

/**
 * The point that a click means: of those within `tolerance` pixels the foremost, or one little behind it and
 * nearer to the click; -1 where there is none.
 * \param isShown whether a point can be seen
 * \param thickness how far behind the foremost point others are still on the same side
 */
export function pickPoint(
  positions: Float32Array,
  projection: Matrix4,
  screen: Screen,
  click: { x: number; y: number; tolerance: number },
  thickness: number,
  isShown: (point: number) => boolean,
): number {
  const m = projection.elements;
  const candidates: { point: number; away: number; depth: number }[] = [];
  let foremost = Infinity;
  for (let point = 0; point < positions.length / 3; ++point) {
    const x = positions[3 * point];
    const y = positions[3 * point + 1];
    const z = positions[3 * point + 2];
    const w = m[3] * x + m[7] * y + m[11] * z + m[15];
    if (w <= 0) continue;
    const right = (0.5 + (m[0] * x + m[4] * y + m[8] * z + m[12]) / w / 2) * screen.width - click.x;
    if (Math.abs(right) > click.tolerance) continue;
    const down = (0.5 - (m[1] * x + m[5] * y + m[9] * z + m[13]) / w / 2) * screen.height - click.y;
    const away = Math.hypot(right, down);
    if (away > click.tolerance || !isShown(point)) continue;
    const depth = depthOf(m, x, y, z, w);
    candidates.push({ point, away, depth });
    foremost = Math.min(foremost, depth);
  }
  const inFront = candidates.filter(({ depth }) => depth <= foremost + thickness);
  return inFront.reduce((best, c) => (c.away < best.away ? c : best), { point: -1, away: Infinity }).point;
}

/** In the space of things: w is that in perspective; in parallel projection it follows from z. */
function depthOf(m: number[], x: number, y: number, z: number, w: number): number {
  const row = Math.hypot(m[2], m[6], m[10]);
  const isPerspective = m[3] !== 0 || m[7] !== 0 || m[11] !== 0;
  return isPerspective ? w : (m[2] * x + m[6] * y + m[10] * z) / row;
}
