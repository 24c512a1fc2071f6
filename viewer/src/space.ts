import type { Facts, Vector } from "./facts";

/**
 * Where things are drawn: the cloud's box has its middle in the origin and its longest side is 2, whatever the
 * cloud's own scale and place. Graphics cards compute in single precision; the cloud's coordinates need not fit.
 */
export class Space {
  private readonly stepsPerUnit: number;
  private readonly middle: Vector; // in steps
  readonly low: Vector;
  readonly high: Vector;
  /** A distance of 1 in the unit of the cloud. */
  readonly unit: number;

  constructor(
    private readonly facts: Facts,
    private readonly position: Uint32Array,
  ) {
    const low: Vector = [Infinity, Infinity, Infinity];
    const high: Vector = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < position.length; ++i) {
      const axis = i % 3;
      if (position[i] < low[axis]) low[axis] = position[i];
      if (position[i] > high[axis]) high[axis] = position[i];
    }
    const isEmpty = position.length === 0;
    this.middle = isEmpty ? [0, 0, 0] : each((axis) => (low[axis] + high[axis]) / 2);
    const extent = Math.max(...each((axis) => high[axis] - low[axis]));
    this.stepsPerUnit = extent > 0 ? extent / 2 : 1;
    this.low = isEmpty ? [-1, -1, -1] : each((axis) => (low[axis] - this.middle[axis]) / this.stepsPerUnit);
    this.high = isEmpty ? [1, 1, 1] : each((axis) => (high[axis] - this.middle[axis]) / this.stepsPerUnit);
    this.unit = 1 / (facts.cloud.step * this.stepsPerUnit);
  }

  /** Of a point of the cloud. */
  ofPoint(point: number): Vector {
    return each((axis) => (this.position[3 * point + axis] - this.middle[axis]) / this.stepsPerUnit);
  }

  /** Of a position in the coordinates of the file. */
  ofPosition(position: Vector): Vector {
    const { origin, step } = this.facts.cloud;
    return each((axis) => ((position[axis] - origin[axis]) / step - this.middle[axis]) / this.stepsPerUnit);
  }

  /** Of all points, three numbers each. */
  ofAll(): Float32Array {
    const all = new Float32Array(this.position.length);
    for (let i = 0; i < all.length; ++i) all[i] = (this.position[i] - this.middle[i % 3]) / this.stepsPerUnit;
    return all;
  }
}

function each(value: (axis: number) => number): Vector {
  return [value(0), value(1), value(2)];
}
