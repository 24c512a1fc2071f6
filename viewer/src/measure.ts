import { distance } from "./graph";
import { rounded } from "./dom";
import type { Vector } from "./facts";
import type { Result } from "./result";

/** The distance of two points that are clicked one after the other; a third click begins anew. */
export class Measure {
  isOn = false;
  points: number[] = [];

  constructor(private readonly result: Result) {}

  toggle(): void {
    this.isOn = !this.isOn;
    this.points = [];
  }

  add(point: number): void {
    if (this.points.length === 2) this.points = [];
    this.points.push(point);
  }

  /** What there is to tell. */
  words(): string {
    if (!this.isOn) return "";
    if (this.points.length === 0) return "Measure: click the first point.";
    if (this.points.length === 1) return "Click the second point.";
    return `Distance ${rounded(this.length())}${this.legs()}`;
  }

  length(): number {
    const [a, b] = this.ends();
    return distance(a, b);
  }

  private legs(): string {
    const [a, b] = this.ends();
    return ` (Δx ${rounded(b[0] - a[0])}, Δy ${rounded(b[1] - a[1])}, Δz ${rounded(b[2] - a[2])})`;
  }

  private ends(): Vector[] {
    return this.points.map((point) => this.result.coordinates(point));
  }
}
