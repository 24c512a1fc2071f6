import { colorOfCluster, css } from "./colors";
import { prepared, rounded } from "./dom";
import { unitsPerDegree, type Cut, type GaussMap } from "./gauss_map";

interface Branch {
  x: number; // leaves stand at 0, 1, 2 …
  height: number; // degrees
  line: number; // one of its lines
  parts: Branch[];
}

const leftMargin = 26;
const verticalMargin = 7;

/** The angle at the top of the drawing, in degrees. */
export function topOf(map: GaussMap): number {
  const highest = Math.max(0, ...map.merges.map((merge) => merge.height)) / unitsPerDegree;
  return Math.min(90, Math.max(20, 10 * Math.ceil((1.15 * highest) / 10)));
}

/** The angle at a height of the drawing, in degrees. */
export function angleAt(canvas: HTMLCanvasElement, y: number, map: GaussMap): number {
  const height = Math.max(1, canvas.clientHeight - 2 * verticalMargin);
  return Math.min(90, Math.max(0.25, topOf(map) * (1 - (y - verticalMargin) / height)));
}

/** Which lines become one at which angle, in the colours of the clusters below the cut. */
export function drawDendrogram(
  canvas: HTMLCanvasElement,
  map: GaussMap,
  cut: Cut,
  sigmaDeg: number,
  height: number,
): void {
  const width = canvas.clientWidth;
  canvas.style.height = `${height}px`;
  const context = width > 0 ? prepared(canvas, width, height) : null;
  if (!context) return;
  const style = getComputedStyle(canvas);
  const quiet = style.getPropertyValue("--quiet");
  const top = topOf(map);
  const count = cut.cluster.length;
  const xOf = (x: number) => leftMargin + ((x + 0.5) / Math.max(1, count)) * (width - leftMargin - 2);
  const yOf = (angle: number) => verticalMargin + (1 - angle / top) * (height - 2 * verticalMargin);

  drawScale(context, top, yOf, style, width);
  context.lineWidth = 1;
  const draw = (branch: Branch) => {
    const isCut = branch.height > sigmaDeg;
    context.strokeStyle = isCut ? quiet : css(colorOfCluster(cut.cluster[branch.line]));
    for (const part of branch.parts) {
      context.beginPath();
      context.moveTo(xOf(branch.x), yOf(branch.height));
      context.lineTo(xOf(part.x), yOf(branch.height));
      context.stroke();
      // What hangs from a branch above the cut has the colour of its own cluster below it.
      drawStem(
        context,
        xOf(part.x),
        yOf(branch.height),
        yOf(part.height),
        yOf(sigmaDeg),
        quiet,
        css(colorOfCluster(cut.cluster[part.line])),
      );
      draw(part);
    }
  };
  rootsOf(map, count).forEach(draw);
  drawCut(context, Math.max(verticalMargin, yOf(sigmaDeg)), sigmaDeg, width, style);
}

function drawStem(
  on: CanvasRenderingContext2D,
  x: number,
  from: number,
  to: number,
  cut: number,
  above: string,
  below: string,
): void {
  const pieces: [number, number, string][] = [
    [from, Math.min(to, Math.max(from, cut)), above],
    [Math.min(to, Math.max(from, cut)), to, below],
  ];
  for (const [start, end, color] of pieces) {
    if (end <= start) continue;
    on.strokeStyle = color;
    on.beginPath();
    on.moveTo(x, start);
    on.lineTo(x, end);
    on.stroke();
  }
  on.strokeStyle = above;
}

function drawScale(
  on: CanvasRenderingContext2D,
  top: number,
  yOf: (angle: number) => number,
  style: CSSStyleDeclaration,
  width: number,
): void {
  on.font = `10.5px ${style.fontFamily}`;
  on.fillStyle = style.getPropertyValue("--quiet");
  on.strokeStyle = style.getPropertyValue("--rule");
  on.textAlign = "right";
  on.textBaseline = "middle";
  for (let angle = 0; angle <= top; angle += top > 40 ? 20 : 10) {
    on.fillText(`${angle}°`, leftMargin - 5, yOf(angle));
    on.beginPath();
    on.moveTo(leftMargin, yOf(angle));
    on.lineTo(width, yOf(angle));
    on.stroke();
  }
}

function drawCut(
  on: CanvasRenderingContext2D,
  y: number,
  sigmaDeg: number,
  width: number,
  style: CSSStyleDeclaration,
): void {
  on.strokeStyle = on.fillStyle = style.getPropertyValue("--ink");
  on.setLineDash([4, 3]);
  on.beginPath();
  on.moveTo(leftMargin, y);
  on.lineTo(width, y);
  on.stroke();
  on.setLineDash([]);
  on.textAlign = "right";
  on.textBaseline = y < 22 ? "top" : "bottom";
  on.fillText(`σ ${rounded(sigmaDeg)}°`, width, y + (y < 22 ? 2 : -2));
}

/** The tree, its leaves in the order in which its branches come. */
function rootsOf(map: GaussMap, count: number): Branch[] {
  const branches: (Branch | null)[] = Array.from({ length: count }, (_, line) => ({
    x: 0,
    height: 0,
    line,
    parts: [],
  }));
  for (const { first, second, height } of map.merges) {
    const parts = [branches[first], branches[second]].filter((part) => part !== null);
    branches[first] = { x: 0, height: height / unitsPerDegree, line: first, parts };
    branches[second] = null;
  }
  let next = 0;
  const settle = (branch: Branch) => {
    branch.parts.forEach(settle);
    branch.x = branch.parts.length === 0 ? next++ : (branch.parts[0].x + branch.parts[1].x) / 2;
  };
  const roots = branches.filter((branch) => branch !== null);
  roots.forEach(settle);
  return roots;
}
