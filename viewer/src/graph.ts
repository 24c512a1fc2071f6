import type { Vector } from "./facts";

/** As the program's drawings in JSON: corners, and the polylines between them. */
export interface Graph {
  crs: string | null;
  corners: { position: Vector; residual?: number }[];
  polylines: Polyline[];
}

export interface Polyline {
  vertices: Vector[];
  closed?: boolean;
  kind?: "crease" | "border";
  corners?: [number | null, number | null];
  length?: number;
  support?: number;
  dihedral_deg?: number[];
}

/** What the table says of a line. */
export interface LineFacts {
  number: number;
  kind: string;
  length: number;
  dihedral_deg: number | null; // the median along the line; 180 is flat
  closed: boolean;
  support: number | null;
}

export function lineFacts(graph: Graph): LineFacts[] {
  return graph.polylines.map((line, number) => ({
    number,
    kind: line.kind ?? "crease",
    length: line.length ?? lengthOf(line),
    dihedral_deg: median(line.dihedral_deg ?? []),
    closed: line.closed ?? false,
    support: line.support ?? null,
  }));
}

/** The vertices in order; of a closed line the first once more at the end. */
export function pathOf(line: Polyline): Vector[] {
  return line.closed && line.vertices.length > 0 ? [...line.vertices, line.vertices[0]] : line.vertices;
}

export function distance(a: Vector, b: Vector): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

function lengthOf(line: Polyline): number {
  const path = pathOf(line);
  return path.slice(1).reduce((sum, vertex, i) => sum + distance(path[i], vertex), 0);
}

function median(values: number[]): number | null {
  if (values.length === 0) return null;
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.floor((sorted.length - 1) / 2)];
}
