import type { Facts } from "../src/facts";
import type { Column } from "./encode";

export const kindFacts: Facts["kinds"] = [
  ["flat", 0, "#e4e4e0"],
  ["curved", 1, "#8bbcde"],
  ["edge", 2, "#d55e00"],
  ["corner", 3, "#00449e"],
  ["peak", 4, "#cc79a7"],
  ["border", 5, "#008c68"],
  ["undecided", 255, "#606060"],
].map(([name, number, color]) => ({ name, number, color, count: 0 }) as Facts["kinds"][number]);

/** Facts of a cloud without anything special. */
export function factsOf(points: number): Omit<Facts, "buffers"> {
  return {
    format: "keenline report",
    version: 1,
    title: "fixture.ply",
    program: "keenline test",
    command: "detect",
    method: "gauss",
    input: {
      name: "fixture.ply",
      path: "fixture.ply",
      format: "ply",
      encoding: "ascii 1.0",
      points,
      finite_points: points,
    },
    spacing: 0.1,
    noise: 0,
    smoothed: false,
    sigma_deg: 20,
    sigma_rule: "auto",
    options: { neighbors: 16, "min-sine": 0.001, triangles: "auto", "min-cluster": "auto" },
    times: { read: 0.01, detect: 0.2 },
    notes: [],
    cloud: { kept: points, left_out: "", origin: [0, 0, 0], step: 1 / 1024 },
    kinds: kindFacts,
    attributes: [],
    graph: null,
  };
}

/** Points of a plane grid and of one across it: an edge where they meet. Sharp there below 60 degrees. */
export function creaseColumns(side: number): { columns: Column[]; points: number } {
  const position: number[] = [];
  const isEdge: boolean[] = [];
  for (let i = 0; i < side; ++i) {
    for (let j = 0; j < side; ++j) {
      position.push(100 * i, 100 * j, 0);
      isEdge.push(i === 0);
      if (i > 0) {
        position.push(0, 100 * j, 100 * i);
        isEdge.push(false);
      }
    }
  }
  const points = isEdge.length;
  const edges = isEdge.filter(Boolean).length;
  const counts = new Uint32Array(65521 * 7);
  for (let s = 0; s <= 65520; ++s) counts.set(s < 60 * 728 ? [points - edges, 0, edges] : [points], 7 * s);
  const columns: Column[] = [
    { name: "position", values: Uint32Array.from(position), components: 3, coding: "delta" },
    { name: "kind", values: Uint8Array.from(isEdge, (edge) => (edge ? 2 : 0)) },
    { name: "clusters", values: Uint8Array.from(isEdge, (edge) => (edge ? 2 : 1)) },
    { name: "spectrum_count", values: Uint8Array.from(isEdge, (edge) => (edge ? 2 : 1)) },
    {
      name: "spectrum_rise",
      values: Uint16Array.from(isEdge.filter(Boolean), () => 60 * 728),
      coding: "planes",
    },
    { name: "spectrum_kind", values: Uint8Array.from(isEdge.flatMap((edge) => (edge ? [2, 0] : [0]))) },
    { name: "spectrum_clusters", values: Uint8Array.from(isEdge.flatMap((edge) => (edge ? [2, 1] : [1]))) },
    { name: "counts", values: counts, components: 7, coding: "delta" },
  ];
  return { columns, points };
}
