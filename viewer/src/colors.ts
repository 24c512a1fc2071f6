import { isFeature, kinds } from "./labels";
import type { Attribute, Result } from "./result";
import type { Vector } from "./facts";

/** Colours for things that only need to be different, as in the program's pictures; they repeat. */
const numberColors: Vector[] = [
  [213, 94, 0],
  [0, 68, 158],
  [0, 140, 104],
  [204, 121, 167],
  [230, 170, 0],
  [86, 180, 233],
  [122, 76, 160],
  [90, 60, 30],
];
export const insignificantColor: Vector = [150, 150, 150];

/** Dark violet over green to yellow: evenly rising brightness. */
const shareColors: Vector[] = [
  [68, 1, 84],
  [71, 44, 122],
  [59, 81, 139],
  [44, 113, 142],
  [33, 144, 141],
  [39, 173, 129],
  [92, 200, 99],
  [170, 220, 50],
  [253, 231, 37],
];

/** Found and true, found and not true, true and not found, neither. */
export const truthColors: Record<"hit" | "false" | "missed" | "rest", Vector> = {
  hit: [0, 140, 104],
  false: [213, 94, 0],
  missed: [204, 121, 167],
  rest: [228, 228, 224],
};

export function colorOfCluster(cluster: number): Vector {
  return cluster < 0 ? insignificantColor : numberColors[cluster % numberColors.length];
}

/** \param share 0 to 1 */
export function colorOfShare(share: number): Vector {
  const place = Math.min(Math.max(share, 0), 1) * (shareColors.length - 1);
  const lower = Math.min(Math.floor(place), shareColors.length - 2);
  const mix = (axis: number) =>
    shareColors[lower][axis] + (place - lower) * (shareColors[lower + 1][axis] - shareColors[lower][axis]);
  return [mix(0), mix(1), mix(2)];
}

export function css([r, g, b]: Vector): string {
  return `rgb(${Math.round(r)} ${Math.round(g)} ${Math.round(b)})`;
}

/** Of #rrggbb. */
export function fromHex(color: string): Vector {
  const number = Number.parseInt(color.slice(1), 16);
  return [(number >> 16) & 255, (number >> 8) & 255, number & 255];
}

/** How points are coloured: by kind, clusters, truth, the file's own colours, or the attribute of a name. */
export type Coloring = "kind" | "clusters" | "truth" | "rgb" | { attribute: string };

/** What can be coloured by, with its name for people. */
export function coloringsOf(result: Result): { coloring: Coloring; name: string }[] {
  const colorings: { coloring: Coloring; name: string }[] = [{ coloring: "kind", name: "kind" }];
  if (result.clusters) colorings.push({ coloring: "clusters", name: "directions" });
  if (result.truth) colorings.push({ coloring: "truth", name: "agreement with truth" });
  if (result.rgb) colorings.push({ coloring: "rgb", name: "colour of the file" });
  for (const { name } of result.attributes) colorings.push({ coloring: { attribute: name }, name });
  return colorings;
}

export function truthOf(kind: number, truth: number): keyof typeof truthColors {
  if (isFeature(kind)) return isFeature(truth) ? "hit" : "false";
  return isFeature(truth) ? "missed" : "rest";
}

/**
 * Writes four bytes a point: its colour, and how it is drawn: 0 not at all, 1 as it is, 2 in front (sharp).
 * \param shown whether points of each kind are shown, by number
 */
export function paint(
  result: Result,
  coloring: Coloring,
  shown: (kind: number) => boolean,
  out: Uint8Array,
): void {
  const drawn = Uint8Array.from({ length: 256 }, (_, kind) =>
    shown(kind) ? (isFeature(kind) || kind === kinds.border ? 2 : 1) : 0,
  );
  const colorOf = colorFunction(result, coloring);
  for (let i = 0; i < result.count; ++i) {
    const [r, g, b] = colorOf(i);
    out[4 * i] = r;
    out[4 * i + 1] = g;
    out[4 * i + 2] = b;
    out[4 * i + 3] = drawn[result.kind[i]];
  }
}

function colorFunction(result: Result, coloring: Coloring): (point: number) => Vector {
  if (coloring === "clusters" && result.clusters) {
    const { clusters } = result;
    return (i) => (clusters[i] === 0 ? insignificantColor : colorOfCluster(clusters[i] - 1));
  }
  if (coloring === "truth" && result.truth) {
    const { kind, truth } = result;
    return (i) => truthColors[truthOf(kind[i], truth[i])];
  }
  if (coloring === "rgb" && result.rgb) {
    const { rgb } = result;
    return (i) => [rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]];
  }
  if (typeof coloring === "object") {
    const attribute = result.attributes.find(({ name }) => name === coloring.attribute);
    if (attribute) return shareFunction(attribute);
  }
  const ofKind: Vector[] = new Array<Vector>(256).fill(insignificantColor);
  for (const { number, color } of result.facts.kinds) ofKind[number] = fromHex(color);
  return (i) => ofKind[result.kind[i]];
}

function shareFunction({ low, high, value }: Attribute): (point: number) => Vector {
  const table = Array.from({ length: 256 }, (_, i) => colorOfShare(i / 255));
  const scale = high > low ? 255 / (high - low) : 0;
  return (i) => {
    const share = Math.round((value(i) - low) * scale);
    return Number.isFinite(share) ? table[Math.min(Math.max(share, 0), 255)] : insignificantColor;
  };
}
