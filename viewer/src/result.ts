import { unfolded, type Columns } from "./data";
import { wholeOption, type Facts } from "./facts";
import { unitsPerDegree } from "./gauss_map";
import {
  KindCounts,
  kinds,
  localSensitivity,
  relabel,
  sensitivityOf,
  spectrumFrom,
  type Spectrum,
} from "./labels";
import { NeighborSearch, type Coordinates } from "./neighborhood";

/** A number per point that the cloud can be coloured by. */
export interface Attribute {
  name: string;
  low: number;
  high: number;
  value(point: number): number; // NaN where it is not finite
}

/** One result: what the program embedded, and the labels at the sensitivity of the moment. */
export class Result {
  readonly count: number; // points that the page holds
  readonly position: Uint32Array; // in steps of facts.cloud.step from facts.cloud.origin
  readonly kind: Uint8Array; // at `sigmaDeg`
  readonly clusters: Uint8Array | null;
  readonly truth: Uint8Array | null; // true kinds
  readonly rgb: Uint8Array | null;
  readonly attributes: Attribute[];
  readonly spectrum: Spectrum | null;
  /** What the labels hold for; null where the program chose for every point, or has no sensitivity. */
  sigmaDeg: number | null;

  private readonly index: Uint32Array | null;
  private readonly counts: KindCounts | null;
  private readonly ownKind: Uint8Array;
  private readonly ownClusters: Uint8Array | null;
  private search: NeighborSearch | null = null;
  private seenCoordinates: Coordinates | null = null;

  constructor(
    readonly facts: Facts,
    private readonly columns: Columns,
  ) {
    this.position = this.column("position", Uint32Array) ?? new Uint32Array(0);
    this.count = this.position.length / 3;
    this.ownKind = this.column("kind", Uint8Array) ?? new Uint8Array(this.count).fill(kinds.undecided);
    this.ownClusters = this.column("clusters", Uint8Array);
    this.kind = this.ownKind.slice();
    this.clusters = this.ownClusters?.slice() ?? null;
    this.truth = this.column("truth", Uint8Array);
    this.rgb = this.column("rgb", Uint8Array);
    this.index = this.column("index", Uint32Array);
    this.spectrum = this.readSpectrum();
    const table = this.column("counts", Uint32Array);
    this.counts =
      table &&
      new KindCounts(
        table,
        facts.kinds.map((kind) => kind.number),
      );
    this.attributes = this.readAttributes();
    this.sigmaDeg = facts.sigma_deg;
  }

  /** Number of the point in the file. */
  numberInFile(point: number): number {
    return this.index ? this.index[point] : point;
  }

  /** The point of that number in the file, or -1 where the page does not hold it. */
  pointOfNumber(number: number): number {
    if (!this.index) return Number.isInteger(number) && number >= 0 && number < this.count ? number : -1;
    return this.index.indexOf(number);
  }

  /** In the coordinates of the file. */
  coordinates(point: number): [number, number, number] {
    const { origin, step } = this.facts.cloud;
    const at = (axis: number) => origin[axis] + step * this.position[3 * point + axis];
    return [at(0), at(1), at(2)];
  }

  /** Labels every point at a sensitivity, or (null) as the program did. */
  setSigma(sigmaDeg: number | null): void {
    this.sigmaDeg = sigmaDeg ?? this.facts.sigma_deg;
    if (sigmaDeg !== null && sigmaDeg !== this.facts.sigma_deg && this.spectrum) {
      relabel(this.spectrum, sensitivityOf(sigmaDeg), this.kind, this.clusters ?? new Uint8Array(this.count));
      return;
    }
    this.kind.set(this.ownKind);
    if (this.ownClusters) this.clusters?.set(this.ownClusters);
  }

  /** Of the whole cloud, thinned or not. */
  countOfKinds(): Map<number, number> {
    const { sigmaDeg, facts } = this;
    const isOwn = sigmaDeg === facts.sigma_deg;
    const counted = (kind: number) => (sigmaDeg === null ? 0 : (this.countAt(sigmaDeg, kind) ?? 0));
    return new Map(facts.kinds.map(({ number, count }) => [number, isOwn ? count : counted(number)]));
  }

  /** Sharp points of the whole cloud at a sensitivity; null where only the program's own labels are known. */
  featuresAt(sigmaDeg: number): number | null {
    return this.counts ? this.counts.features(sensitivityOf(sigmaDeg)) : null;
  }

  /** Points of a kind, as featuresAt(). */
  countAt(sigmaDeg: number, kind: number): number | null {
    return this.counts ? this.counts.at(sensitivityOf(sigmaDeg), kind) : null;
  }

  /** What the label of a point holds for, in degrees; null where the method has no sensitivity. */
  sigmaAt(point: number): number | null {
    if (this.sigmaDeg !== null || !this.spectrum) return this.sigmaDeg;
    return localSensitivity(this.spectrum, point) / unitsPerDegree;
  }

  /** The nearest points of a point, in the cloud that the method looked at. */
  neighborsOf(point: number): Uint32Array {
    this.search ??= new NeighborSearch(this.seen());
    return this.search.nearest(point, wholeOption(this.facts, "neighbors") ?? 16);
  }

  /** What the method looked at: smoothed positions where it did. In steps. */
  seen(): Coordinates {
    const offset = this.column("seen_offset", Uint32Array);
    if (!offset) return this.position;
    this.seenCoordinates ??= Float64Array.from(this.position, (p, i) => p + unfolded(offset[i]));
    return this.seenCoordinates;
  }

  private column<T extends abstract new (...args: never[]) => unknown>(
    name: string,
    type: T,
  ): InstanceType<T> | null {
    const found = this.columns.get(name);
    return found instanceof type ? (found as InstanceType<T>) : null;
  }

  private readSpectrum(): Spectrum | null {
    const steps = this.columns.get("spectrum_count");
    const rises = this.column("spectrum_rise", Uint16Array);
    const kind = this.column("spectrum_kind", Uint8Array);
    const clusters = this.column("spectrum_clusters", Uint8Array);
    return steps && rises && kind && clusters ? spectrumFrom(steps, rises, kind, clusters) : null;
  }

  private readAttributes(): Attribute[] {
    return this.facts.attributes.flatMap(({ name, buffer, low, high, step }) => {
      const values = this.columns.get(buffer);
      if (!values || values.length !== this.count || buffer === "clusters") return []; // clusters follow sigma
      const notFinite = values instanceof Uint8Array ? 255 : 65535;
      return [{ name, low, high, value: (i) => (values[i] === notFinite ? NaN : low + step * values[i]) }];
    });
  }
}
