import type { Pose } from "./camera";
import type { Coloring } from "./colors";

/** What a link restores. What is absent stays as it is. */
export interface LinkedView {
  pose?: Pose;
  sigmaDeg?: number;
  coloring?: Coloring;
  hidden?: number[]; // kinds
  showsLines?: boolean;
  pointNumber?: number; // in the file
}

/** Without the "#". */
export function linkText(view: LinkedView): string {
  const words = new URLSearchParams();
  if (view.pose) {
    const { target, height, azimuthDeg, elevationDeg, isPerspective } = view.pose;
    words.set(
      "view",
      [azimuthDeg, elevationDeg, height, ...target].map((n) => Number(n.toPrecision(7))).join(","),
    );
    if (!isPerspective) words.set("parallel", "1");
  }
  if (view.sigmaDeg !== undefined) words.set("sigma", `${view.sigmaDeg}`);
  if (typeof view.coloring === "object") words.set("attribute", view.coloring.attribute);
  else if (view.coloring) words.set("color", view.coloring);
  if (view.hidden && view.hidden.length > 0) words.set("hidden", view.hidden.join(","));
  if (view.showsLines === false) words.set("lines", "0");
  if (view.pointNumber !== undefined) words.set("point", `${view.pointNumber}`);
  return words.toString();
}

/** What cannot be understood is passed over: links come from anywhere. */
export function parseLink(text: string): LinkedView {
  const words = new URLSearchParams(text.replace(/^#/, ""));
  const view: LinkedView = {};
  const [azimuthDeg, elevationDeg, height, x, y, z] = numbers(words.get("view"));
  const isPose = [azimuthDeg, elevationDeg, height, x, y, z].every(Number.isFinite) && height > 0;
  if (isPose && Math.abs(elevationDeg) <= 90) {
    view.pose = {
      azimuthDeg,
      elevationDeg,
      height,
      target: [x, y, z],
      isPerspective: !words.has("parallel"),
    };
  }
  const sigma = Number(words.get("sigma") ?? NaN);
  if (sigma > 0 && sigma <= 90) view.sigmaDeg = sigma;
  const color = words.get("color");
  const attribute = words.get("attribute");
  if (color === "kind" || color === "clusters" || color === "truth" || color === "rgb") view.coloring = color;
  else if (attribute !== null) view.coloring = { attribute };
  if ([...words.keys()].length > 0) {
    view.hidden = numbers(words.get("hidden")).filter((n) => Number.isInteger(n) && n >= 0 && n <= 255);
    view.showsLines = words.get("lines") !== "0";
  }
  const point = words.get("point");
  if (point !== null && /^\d{1,10}$/.test(point)) view.pointNumber = Number(point);
  return view;
}

function numbers(list: string | null): number[] {
  return list ? list.split(",").map(Number) : [];
}
