/** Coordinates of points, three numbers each, in steps of the grid that positions are stored on. */
export type Coordinates = Uint32Array | Float64Array;

/** Finds the nearest points of a point: those of the cells around it, ring by ring. */
export class NeighborSearch {
  private readonly low: [number, number, number] = [Infinity, Infinity, Infinity];
  private readonly cells: [number, number, number] = [1, 1, 1];
  private readonly side: number;
  private readonly starts: Uint32Array; // of every cell in `order`, and the end of the last
  private readonly order: Uint32Array; // points, cell by cell, in a cell by their number

  constructor(private readonly coordinates: Coordinates) {
    const count = coordinates.length / 3;
    const high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < coordinates.length; ++i) {
      const axis = i % 3;
      if (coordinates[i] < this.low[axis]) this.low[axis] = coordinates[i];
      if (coordinates[i] > high[axis]) high[axis] = coordinates[i];
    }
    const extent = high.map((h, axis) => Math.max(0, h - this.low[axis]));
    this.side = cellSide(extent, count);
    for (let axis = 0; axis < 3; ++axis) this.cells[axis] = Math.floor((extent[axis] || 0) / this.side) + 1;

    this.starts = new Uint32Array(this.cells[0] * this.cells[1] * this.cells[2] + 1);
    const cellOf = new Uint32Array(count);
    for (let p = 0; p < count; ++p) {
      cellOf[p] = this.cellAt(this.place(p, 0), this.place(p, 1), this.place(p, 2));
      ++this.starts[cellOf[p] + 1];
    }
    for (let c = 1; c < this.starts.length; ++c) this.starts[c] += this.starts[c - 1];
    this.order = new Uint32Array(count);
    const next = this.starts.slice();
    for (let p = 0; p < count; ++p) this.order[next[cellOf[p]]++] = p;
  }

  /**
   * The `count` nearest other points, ordered by (distance, number). Points that coincide with it are not its
   * neighbours. Fewer where there are no more.
   */
  nearest(point: number, count: number): Uint32Array {
    const nearest = new Nearest(count);
    const rings = Math.max(...this.cells);
    for (let ring = 0; ring < rings; ++ring) {
      // What lies outside the rings so far is at least as far as the nearest rim of their block of cells.
      const reach = (ring - 1) * this.side + this.roomInCell(point);
      if (ring > 0 && nearest.isFull() && nearest.farthest() < reach * reach) break;
      this.visitRing(point, ring, nearest);
    }
    return nearest.points();
  }

  private place(point: number, axis: number): number {
    return Math.floor((this.coordinates[3 * point + axis] - this.low[axis]) / this.side);
  }

  private cellAt(x: number, y: number, z: number): number {
    return (z * this.cells[1] + y) * this.cells[0] + x;
  }

  /** Distance from the point to the nearest wall of its cell. */
  private roomInCell(point: number): number {
    let room = Infinity;
    for (let axis = 0; axis < 3; ++axis) {
      const within =
        this.coordinates[3 * point + axis] - this.low[axis] - this.place(point, axis) * this.side;
      room = Math.min(room, within, this.side - within);
    }
    return Math.max(0, room);
  }

  private visitRing(point: number, ring: number, nearest: Nearest): void {
    const center = [0, 1, 2].map((axis) => this.place(point, axis));
    const from = center.map((c) => Math.max(0, c - ring));
    const to = center.map((c, axis) => Math.min(this.cells[axis] - 1, c + ring));
    for (let z = from[2]; z <= to[2]; ++z) {
      for (let y = from[1]; y <= to[1]; ++y) {
        const onShell = Math.abs(z - center[2]) === ring || Math.abs(y - center[1]) === ring;
        for (let x = from[0]; x <= to[0]; ++x) {
          if (onShell || Math.abs(x - center[0]) === ring)
            this.visitCell(point, this.cellAt(x, y, z), nearest);
        }
      }
    }
  }

  private visitCell(point: number, cell: number, nearest: Nearest): void {
    const c = this.coordinates;
    for (let i = this.starts[cell]; i < this.starts[cell + 1]; ++i) {
      const q = this.order[i];
      const x = c[3 * q] - c[3 * point];
      const y = c[3 * q + 1] - c[3 * point + 1];
      const z = c[3 * q + 2] - c[3 * point + 2];
      const squared = x * x + y * y + z * z;
      if (squared > 0) nearest.offer(squared, q);
    }
  }
}

/** Cells so large that there are about as many as points. */
function cellSide(extent: number[], count: number): number {
  const largest = Math.max(...extent);
  if (!(largest > 0)) return 1;
  // A flat cloud has cells in two directions only, a straight one in one.
  let side = largest;
  const cells = (s: number) => extent.reduce((product, e) => product * (Math.floor(e / s) + 1), 1);
  while (cells(side / 2) <= Math.max(8, count)) side /= 2;
  return side;
}

/** The best so far, in order. Neighbourhoods are small: insertion is as good as a heap. */
class Nearest {
  private readonly squared: number[] = [];
  private readonly found: number[] = [];

  constructor(private readonly count: number) {}

  isFull(): boolean {
    return this.found.length === this.count;
  }

  farthest(): number {
    return this.squared[this.squared.length - 1];
  }

  offer(squared: number, point: number): void {
    let place = this.found.length;
    while (place > 0 && this.isBefore(squared, point, place - 1)) --place;
    if (place >= this.count) return;
    this.squared.splice(place, 0, squared);
    this.found.splice(place, 0, point);
    if (this.found.length > this.count) {
      this.squared.pop();
      this.found.pop();
    }
  }

  points(): Uint32Array {
    return Uint32Array.from(this.found);
  }

  private isBefore(squared: number, point: number, place: number): boolean {
    return squared < this.squared[place] || (squared === this.squared[place] && point < this.found[place]);
  }
}
