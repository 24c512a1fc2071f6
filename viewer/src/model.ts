import type { Coloring } from "./colors";
import { isFeature, kinds } from "./labels";
import type { Result } from "./result";

/** What of the model has changed. */
export type Change = "labels" | "appearance" | "point" | "line";

/** What the reader of a report has chosen. Panels and the stage listen to it. */
export class Model {
  coloring: Coloring = "kind";
  readonly hidden = new Set<number>(); // kinds
  showsLines = true;
  point = -1; // whose Gauss map is shown
  neighbors: Uint32Array = new Uint32Array(0); // of that point
  line = -1; // chosen in the table
  private readonly listeners: { change: Change; listener: () => void }[] = [];

  constructor(readonly result: Result) {}

  on(changes: Change[], listener: () => void): void {
    for (const change of changes) this.listeners.push({ change, listener });
  }

  setSigma(sigmaDeg: number | null): void {
    if (sigmaDeg !== null && !(sigmaDeg > 0 && sigmaDeg <= 90)) return;
    this.result.setSigma(sigmaDeg);
    this.tell("labels");
  }

  setColoring(coloring: Coloring): void {
    this.coloring = coloring;
    this.tell("appearance");
  }

  show(kind: number, isShown: boolean): void {
    if (isShown) this.hidden.delete(kind);
    else this.hidden.add(kind);
    this.tell("appearance");
  }

  showOnlySharp(isOnly: boolean): void {
    for (const { number } of this.result.facts.kinds) {
      if (isOnly && !isFeature(number) && number !== kinds.border) this.hidden.add(number);
      else this.hidden.delete(number);
    }
    this.tell("appearance");
  }

  showLines(isShown: boolean): void {
    this.showsLines = isShown;
    this.tell("appearance");
  }

  /** -1 for none. */
  choosePoint(point: number): void {
    this.point = point >= 0 && point < this.result.count ? point : -1;
    this.neighbors = this.point < 0 ? new Uint32Array(0) : this.result.neighborsOf(this.point);
    this.tell("point");
  }

  /** -1 for none. */
  chooseLine(line: number): void {
    this.line = line;
    this.tell("line");
  }

  private tell(change: Change): void {
    for (const each of this.listeners) if (each.change === change) each.listener();
  }
}
