import type { Graph } from "./graph";

export type Vector = [number, number, number];

export interface KindFacts {
  name: string;
  number: number;
  color: string; // #rrggbb
  count: number; // points of the whole cloud
}

export interface BufferFacts {
  name: string;
  type: "uint8" | "uint16" | "uint32";
  components: number;
  count: number;
  coding: "raw" | "planes" | "delta";
  offset: number; // into the inflated stream
  bytes: number;
}

export interface AttributeFacts {
  name: string;
  buffer: string;
  low: number; // value = low + step * number; the largest number stands for what is not finite
  high: number;
  step: number;
}

/** What the program says about a result: docs/report-format.md. */
export interface Facts {
  format: string;
  version: number;
  title: string;
  program: string;
  command: string;
  method: string | null;
  input: {
    name: string;
    path: string;
    format: string;
    encoding: string;
    points: number;
    finite_points: number;
  };
  spacing: number;
  noise: number | null;
  smoothed: boolean;
  sigma_deg: number | null;
  sigma_rule: string | null;
  options: Record<string, number | string | boolean | null>;
  times: Record<string, number>;
  notes: string[];
  cloud: { kept: number; left_out: string; origin: Vector; step: number };
  kinds: KindFacts[];
  buffers: BufferFacts[];
  attributes: AttributeFacts[];
  graph: Graph | null;
}

/** A whole-number option of the method; null where it has none or the program chose for every point. */
export function wholeOption(facts: Facts, name: string): number | null {
  const value = facts.options[name];
  return typeof value === "number" && Number.isInteger(value) ? value : null;
}
