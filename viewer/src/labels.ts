import { unitsPerDegree } from "./gauss_map";

export const kinds = { flat: 0, curved: 1, edge: 2, corner: 3, peak: 4, border: 5, undecided: 255 } as const;

/** Edges, corners and peaks are sharp features. */
export function isFeature(kind: number): boolean {
  return kind >= kinds.edge && kind <= kinds.peak;
}

/** The label of every point at every sensitivity: point i has the steps offsets[i] … offsets[i + 1] - 1. */
export interface Spectrum {
  offsets: Uint32Array;
  from: Uint16Array; // sensitivity from which a step holds, up to that of the next; the first from 0
  kind: Uint8Array;
  clusters: Uint8Array;
}

/** \param rises of all steps but the first of each point: how much later than the one before they begin */
export function spectrumFrom(
  stepsPerPoint: ArrayLike<number>,
  rises: Uint16Array,
  kind: Uint8Array,
  clusters: Uint8Array,
): Spectrum {
  const offsets = new Uint32Array(stepsPerPoint.length + 1);
  const from = new Uint16Array(kind.length);
  for (let i = 0, rise = 0; i < stepsPerPoint.length; ++i) {
    offsets[i + 1] = offsets[i] + stepsPerPoint[i];
    for (let step = offsets[i] + 1; step < offsets[i + 1]; ++step)
      from[step] = from[step - 1] + rises[rise++];
  }
  return { offsets, from, kind, clusters };
}

/** A sensitivity in whole units, rounded down: what labels depend on. */
export function sensitivityOf(sigmaDeg: number): number {
  return Math.floor(sigmaDeg * unitsPerDegree);
}

/**
 * The sensitivity of one point by persistence: its kind stays the same over the widest range there, as a ratio,
 * between 8 and 45 degrees; of equally wide ranges the higher one. Mirrors the program's local_sensitivity().
 */
export function localSensitivity({ offsets, from, kind }: Spectrum, point: number): number {
  const lowest = sensitivityOf(8);
  const highest = sensitivityOf(45);
  let widest = 0;
  let sensitivity = highest;
  let rangeBegin = lowest;
  let stepBegin = lowest;
  for (let step = offsets[point]; step < offsets[point + 1]; ++step) {
    const isLast = step + 1 === offsets[point + 1] || from[step + 1] > highest;
    const end = isLast ? highest : from[step + 1];
    if (end <= lowest) continue; // over before the range begins
    if (isLast || kind[step + 1] !== kind[step]) {
      if (end / rangeBegin >= widest) {
        widest = end / rangeBegin;
        sensitivity = (stepBegin + end) / 2;
      }
      rangeBegin = end;
    }
    if (isLast) break;
    stepBegin = end;
  }
  return Math.floor(sensitivity);
}

/** Writes the labels at a sensitivity. */
export function relabel(
  spectrum: Spectrum,
  sensitivity: number,
  kind: Uint8Array,
  clusters: Uint8Array,
): void {
  const { offsets, from } = spectrum;
  for (let i = 0; i < kind.length; ++i) {
    let step = offsets[i];
    const last = offsets[i + 1] - 1;
    while (step < last && from[step + 1] <= sensitivity) ++step;
    kind[i] = spectrum.kind[step];
    clusters[i] = spectrum.clusters[step];
  }
}

/** How many points of the whole cloud are of each kind, at every sensitivity. */
export class KindCounts {
  /** \param table a row per sensitivity, a column per kind in the order of `numbers` */
  constructor(
    private readonly table: Uint32Array,
    private readonly numbers: number[],
  ) {}

  at(sensitivity: number, kind: number): number {
    const column = this.numbers.indexOf(kind);
    return column < 0 ? 0 : this.table[sensitivity * this.numbers.length + column];
  }

  features(sensitivity: number): number {
    return this.numbers.filter(isFeature).reduce((sum, kind) => sum + this.at(sensitivity, kind), 0);
  }
}
