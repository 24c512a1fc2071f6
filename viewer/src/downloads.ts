import { button, element } from "./dom";
import type { Graph } from "./graph";
import { pathOf } from "./graph";
import { isFeature } from "./labels";
import type { Result } from "./result";

/** Buttons that save what the page shows as files. */
export function downloadsPanel(result: Result): HTMLElement {
  const name = baseName(result.facts.title);
  const points = element(
    "div",
    { class: "row" },
    button("Points, PLY", () => save(pointsPly(result), `${name}-labels.ply`), { id: "save-ply" }),
    button("Points, CSV", () => save(pointsCsv(result), `${name}-labels.csv`), { id: "save-csv" }),
  );
  const body = element("div", { class: "body" }, points);
  const { graph } = result.facts;
  if (graph) {
    const lines = element(
      "div",
      { class: "row" },
      button("Lines, JSON", () => save(new Blob([JSON.stringify(graph)]), `${name}-lines.json`), {
        id: "save-json",
      }),
      button("Lines, OBJ", () => save(new Blob([linesObj(graph)]), `${name}-lines.obj`), { id: "save-obj" }),
    );
    body.append(lines);
  }
  const step = result.facts.cloud.step.toPrecision(2);
  const told = [
    "Points carry the labels at the σ that is set.",
    `Positions are rounded to ${step}; what the program itself writes is exact.`,
  ];
  body.append(element("p", { class: "quiet" }, told.join(" ")));
  return body;
}

export function save(blob: Blob, name: string): void {
  const url = URL.createObjectURL(blob);
  const link = element("a", { href: url, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}

/** A name that every file system takes. */
export function baseName(title: string): string {
  const name = title.replace(/\.[^.]*$/, "").replace(/[^\p{L}\p{N}._-]+/gu, "_");
  return name.replace(/^[._]+/, "").slice(0, 80) || "keenline";
}

export function pointsCsv(result: Result): Blob {
  const pieces = [`x,y,z,feature,kind${result.clusters ? ",clusters" : ""}\n`];
  let piece = "";
  for (let i = 0; i < result.count; ++i) {
    const columns = [...result.coordinates(i), isFeature(result.kind[i]) ? 1 : 0, result.kind[i]];
    if (result.clusters) columns.push(result.clusters[i]);
    piece += `${columns.join(",")}\n`;
    if (i % 10000 === 9999) (pieces.push(piece), (piece = ""));
  }
  return new Blob([...pieces, piece], { type: "text/csv" });
}

export function pointsPly(result: Result): Blob {
  const properties = ["double x", "double y", "double z", "uchar feature", "uchar kind"];
  if (result.clusters) properties.push("uchar clusters");
  const header = [
    "ply",
    "format binary_little_endian 1.0",
    `element vertex ${result.count}`,
    ...properties.map((property) => `property ${property}`),
    "end_header\n",
  ].join("\n");
  const row = 26 + (result.clusters ? 1 : 0);
  const bytes = new DataView(new ArrayBuffer(row * result.count));
  for (let i = 0; i < result.count; ++i) {
    result.coordinates(i).forEach((c, axis) => bytes.setFloat64(i * row + 8 * axis, c, true));
    bytes.setUint8(i * row + 24, isFeature(result.kind[i]) ? 1 : 0);
    bytes.setUint8(i * row + 25, result.kind[i]);
    if (result.clusters) bytes.setUint8(i * row + 26, result.clusters[i]);
  }
  return new Blob([header, bytes.buffer]);
}

export function linesObj(graph: Graph): string {
  let text = "";
  let next = 1;
  for (const line of graph.polylines) {
    for (const vertex of line.vertices) text += `v ${vertex.join(" ")}\n`;
    const numbers = line.vertices.map((_, i) => next + i);
    if (pathOf(line).length > line.vertices.length) numbers.push(next);
    text += `l ${numbers.join(" ")}\n`;
    next += line.vertices.length;
  }
  return text;
}
