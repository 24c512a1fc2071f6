import type { Coordinates } from "./neighborhood";

/** Angles between lines are whole numbers of 1/728 degree, as in the program: sums of them are exact. */
export const unitsPerDegree = 728;
export const rightAngle = 65520;

/** One step of average linkage: the cluster named `second` becomes part of the one named `first`. */
export interface Merge {
  first: number; // smallest line of the one cluster, which the merged one keeps as its name
  second: number; // smallest line of the other
  firstSize: number;
  secondSize: number;
  height: number; // mean angle between the lines of the one and those of the other, in units
}

/** The lines through the triangles of a point and two of its neighbours, and their dendrogram. */
export interface GaussMap {
  lines: Float32Array; // unit vectors, three numbers each; a line and its reverse are the same
  merges: Merge[]; // a cluster comes after what it consists of
  minCluster: number; // lines that a significant cluster has
}

/** A dendrogram, cut. */
export interface Cut {
  cluster: Int32Array; // of every line: its place in sizes, or -1 where its cluster is not significant
  sizes: number[]; // of the significant clusters, largest first
}

export interface GaussOptions {
  minSine: number; // triangles with a smaller sine at the point have no usable normal
  triangles: number | null; // so many, the best shaped, and those shaped as well as the last; null: all
  minCluster: number | null; // null: a tenth of the lines, at least 3
}

/** The Gauss map of a point. Mirrors the program's GaussMap and PointLabeler. */
export function gaussMap(
  coordinates: Coordinates,
  point: number,
  neighbors: Uint32Array,
  options: GaussOptions,
): GaussMap {
  const lines = triangleLines(offsetsOf(coordinates, point, neighbors), options);
  const count = lines.length / 3;
  return {
    lines,
    merges: averageLinkage(lineAngles(lines), count),
    minCluster: options.minCluster ?? Math.max(3, Math.floor((count + 9) / 10)),
  };
}

function offsetsOf(coordinates: Coordinates, point: number, neighbors: Uint32Array): Float64Array {
  const offsets = new Float64Array(3 * neighbors.length);
  neighbors.forEach((q, i) => {
    for (let axis = 0; axis < 3; ++axis) {
      offsets[3 * i + axis] = coordinates[3 * q + axis] - coordinates[3 * point + axis];
    }
  });
  return offsets;
}

const f = Math.fround;

/**
 * How well shaped the triangles (0, a_i, a_j) are, i < j: 256 q², a whole number up to 255, where q = 4 √3 area /
 * (sum of the squares of the sides). In single precision step by step: the program's numbers.
 */
export function triangleShapes(offsets: Float64Array): number[] {
  const single = Float32Array.from(offsets);
  const dot = (u: ArrayLike<number>, v: ArrayLike<number>) =>
    f(f(f(u[0] * v[0]) + f(u[1] * v[1])) + f(u[2] * v[2]));
  const shapes: number[] = [];
  for (let i = 0; i < single.length; i += 3) {
    const a = single.subarray(i, i + 3);
    for (let j = i + 3; j < single.length; j += 3) {
      const b = single.subarray(j, j + 3);
      const normal = [0, 1, 2].map((axis) => {
        const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
        return f(f(a[u] * b[v]) - f(a[v] * b[u]));
      });
      const sides = f(f(dot(a, a) + dot(b, b)) - dot(a, b));
      const shape = sides > 0 ? f(f(768 * dot(normal, normal)) / f(sides * sides)) : 0;
      shapes.push(Math.floor(Math.min(shape, 255)));
    }
  }
  return shapes;
}

/** The shape that so many triangles have at least. */
function shapeOfBest(shapes: number[], best: number): number {
  const sorted = [...shapes].sort((a, b) => b - a);
  return best <= sorted.length ? sorted[best - 1] : 0;
}

/** Unit normals of the triangles (0, a_i, a_j), i < j. */
export function triangleLines(
  offsets: Float64Array,
  { minSine, triangles }: Pick<GaussOptions, "minSine" | "triangles">,
): Float32Array {
  const count = offsets.length / 3;
  const shapes = triangles === null ? null : triangleShapes(offsets);
  const leastShape = shapes && triangles !== null ? shapeOfBest(shapes, triangles) : 0;
  let triangle = -1;
  const lengths = Float64Array.from({ length: count }, (_, i) =>
    Math.sqrt(offsets[3 * i] ** 2 + offsets[3 * i + 1] ** 2 + offsets[3 * i + 2] ** 2),
  );
  const lines: number[] = [];
  for (let i = 0; i < count; ++i) {
    for (let j = i + 1; j < count; ++j) {
      ++triangle;
      if (shapes && shapes[triangle] < leastShape) continue;
      const [ax, ay, az] = offsets.subarray(3 * i, 3 * i + 3);
      const [bx, by, bz] = offsets.subarray(3 * j, 3 * j + 3);
      const nx = ay * bz - az * by;
      const ny = az * bx - ax * bz;
      const nz = ax * by - ay * bx;
      const length = Math.sqrt(nx * nx + ny * ny + nz * nz);
      if (!(length > 0) || length < minSine * (lengths[i] * lengths[j])) continue;
      const inverse = 1 / length;
      lines.push(nx * inverse, ny * inverse, nz * inverse);
    }
  }
  return Float32Array.from(lines);
}

/** As the program's, highest power first: not Math.acos, whose last bit is the browser's own. */
const arcCosinePolynomial = [111.76205, -509.00394, 1167.3652, -2057.043, 3706.7136, -8951.011, 65520].map(f);

/** The angle between two lines in units, in single precision step by step: the program's bits. */
export function lineAngle(cosine: number): number {
  const c = Math.min(Math.abs(cosine), 1);
  let p = arcCosinePolynomial[0];
  for (let i = 1; i < arcCosinePolynomial.length; ++i) p = f(f(p * c) + arcCosinePolynomial[i]);
  return Math.floor(f(f(f(Math.sqrt(f(1 - c))) * p) + 0.5));
}

/** All pairs, row by row. */
export function lineAngles(lines: Float32Array): Float64Array {
  const count = lines.length / 3;
  const angles = new Float64Array(count * count);
  for (let i = 0; i < count; ++i) {
    for (let j = i + 1; j < count; ++j) {
      const x = f(lines[3 * i] * lines[3 * j]);
      const y = f(lines[3 * i + 1] * lines[3 * j + 1]);
      const z = f(lines[3 * i + 2] * lines[3 * j + 2]);
      angles[i * count + j] = angles[j * count + i] = lineAngle(f(f(x + y) + z));
    }
  }
  return angles;
}

/**
 * Average-linkage clustering, exact in whole numbers: always the closest pair, equal distances in the order of
 * (smaller name, larger name), where a cluster's name is its smallest item. Found by nearest-neighbour chain,
 * so that merges come in another order than by height. `sums`, the distances, is overwritten.
 */
export function averageLinkage(sums: Float64Array, count: number): Merge[] {
  const sizes = new Uint32Array(count).fill(1); // 0 once it is part of another
  const merges: Merge[] = [];
  const chain: number[] = [];
  while (merges.length < count - 1) {
    if (chain.length === 0) chain.push(0);
    const top = chain[chain.length - 1];
    const next = nearestCluster(sums, sizes, top);
    if (chain.length < 2 || chain[chain.length - 2] !== next) {
      chain.push(next);
      continue;
    }
    // Each is the other's nearest, and stays it whatever else is merged: average linkage is reducible.
    chain.length -= 2;
    merges.push(join(sums, sizes, Math.min(top, next), Math.max(top, next)));
  }
  return merges;
}

/** Least mean distance, then least name. Fractions are compared crosswise; products stay below 2^53. */
function nearestCluster(sums: Float64Array, sizes: Uint32Array, cluster: number): number {
  const row = cluster * sizes.length;
  let best = -1;
  for (let other = 0; other < sizes.length; ++other) {
    if (sizes[other] === 0 || other === cluster) continue;
    if (best < 0 || sums[row + other] * sizes[best] < sums[row + best] * sizes[other]) best = other;
  }
  return best;
}

function join(sums: Float64Array, sizes: Uint32Array, first: number, second: number): Merge {
  const count = sizes.length;
  const height = sums[first * count + second] / (sizes[first] * sizes[second]);
  const merge = { first, second, firstSize: sizes[first], secondSize: sizes[second], height };
  for (let other = 0; other < count; ++other) {
    sums[first * count + other] += sums[second * count + other];
    sums[other * count + first] = sums[first * count + other];
  }
  sizes[first] += sizes[second];
  sizes[second] = 0;
  return merge;
}

/** The clusters when merging stops at a sensitivity, in units. */
export function cut(map: GaussMap, sensitivity: number): Cut {
  const count = map.lines.length / 3;
  const names = Int32Array.from({ length: count }, (_, i) => i);
  // Backwards: a cluster's last merge names it, before its parts take over the name.
  for (const merge of [...map.merges].reverse()) {
    if (merge.height <= sensitivity) names[merge.second] = names[merge.first];
  }
  const sizes = new Uint32Array(count);
  for (const name of names) ++sizes[name];
  const significant = [...sizes.keys()]
    .filter((name) => sizes[name] > 0 && sizes[name] >= map.minCluster)
    .sort((a, b) => sizes[b] - sizes[a] || a - b);
  const places = new Int32Array(count).fill(-1);
  significant.forEach((name, place) => (places[name] = place));
  return { cluster: names.map((name) => places[name]), sizes: significant.map((name) => sizes[name]) };
}
