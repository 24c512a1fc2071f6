import { colorOfShare, coloringsOf, css, fromHex, truthColors, truthOf, type Coloring } from "./colors";
import { element, grouped, prepared, rounded } from "./dom";
import type { Vector } from "./facts";
import type { Model } from "./model";

/** The list of layers with their counts. */
export function layersPanel(model: Model): HTMLElement {
  const list = element("ul", { class: "layers" });
  const rows = model.result.facts.kinds.map(({ name, number, color }) => {
    const row = layerRow(name, color, (isShown) => model.show(number, isShown));
    list.append(row.item);
    return { ...row, number };
  });
  const lineCount = model.result.facts.graph?.polylines.length ?? 0;
  const lines = layerRow("lines", "var(--ink)", (isShown) => model.showLines(isShown), "stroke");
  if (model.result.facts.graph) list.append(lines.item);
  lines.count.textContent = grouped(lineCount);

  const update = () => {
    const counts = model.result.countOfKinds();
    for (const { item, box, count, number } of rows) {
      const points = counts.get(number) ?? 0;
      count.textContent = grouped(points);
      item.classList.toggle("none", points === 0);
      box.checked = !model.hidden.has(number);
    }
    lines.box.checked = model.showsLines;
  };
  model.on(["labels", "appearance"], update);
  update();

  const onlySharp = element("button", { type: "button" }, "Only sharp points");
  onlySharp.addEventListener("click", () => model.showOnlySharp(true));
  const all = element("button", { type: "button" }, "All");
  all.addEventListener("click", () => model.showOnlySharp(false));
  return element("div", { class: "body" }, list, element("div", { class: "row" }, onlySharp, all));
}

function layerRow(name: string, color: string, onChange: (isShown: boolean) => void, form = "") {
  const box = element("input", { type: "checkbox" });
  box.addEventListener("change", () => onChange(box.checked));
  const swatch = element("span", { class: `swatch ${form}`, "aria-hidden": "true" });
  swatch.style.background = color;
  const count = element("span", { class: "count" });
  const item = element("li", {}, element("label", {}, box, swatch, element("span", {}, name), count));
  return { item, box, count };
}

/** What the cloud is coloured by. */
export function coloringPanel(model: Model): HTMLElement {
  const choices = coloringsOf(model.result);
  const select = element("select", { "aria-label": "Colour by" });
  for (const { name } of choices) select.append(element("option", {}, name));
  select.addEventListener("change", () => model.setColoring(choices[select.selectedIndex].coloring));
  const update = () => {
    select.selectedIndex = choices.findIndex(({ coloring }) => isSame(coloring, model.coloring));
  };
  model.on(["appearance"], update);
  update();
  return element("div", { class: "body" }, select);
}

export function isSame(a: Coloring, b: Coloring): boolean {
  return typeof a === "object" && typeof b === "object" ? a.attribute === b.attribute : a === b;
}

/** What the colours on the stage mean. */
export function attachLegend(model: Model, place: HTMLElement): void {
  const update = () => place.replaceChildren(...legendOf(model));
  model.on(["labels", "appearance"], update);
  update();
}

function legendOf(model: Model): Node[] {
  const { result, coloring } = model;
  if (coloring === "kind") {
    const counts = result.countOfKinds();
    const present = result.facts.kinds.filter(
      ({ number }) => (counts.get(number) ?? 0) > 0 && !model.hidden.has(number),
    );
    return present.length > 0 ? [keys(present.map(({ name, color }) => [name, fromHex(color)]))] : [];
  }
  if (coloring === "truth" && result.truth) return [truthLegend(result.kind, result.truth)];
  if (typeof coloring === "object") {
    const attribute = result.attributes.find(({ name }) => name === coloring.attribute);
    return attribute ? [element("div", {}, attribute.name), ...scale(attribute.low, attribute.high)] : [];
  }
  return [];
}

function truthLegend(kind: Uint8Array, truth: Uint8Array): HTMLElement {
  const counts = { hit: 0, false: 0, missed: 0, rest: 0 };
  for (let i = 0; i < kind.length; ++i) ++counts[truthOf(kind[i], truth[i])];
  return keys([
    [`found and true ${grouped(counts.hit)}`, truthColors.hit],
    [`false ${grouped(counts.false)}`, truthColors.false],
    [`missed ${grouped(counts.missed)}`, truthColors.missed],
  ]);
}

function keys(entries: [string, Vector][]): HTMLElement {
  const list = element("ul");
  for (const [name, color] of entries) {
    const swatch = element("span", { class: "swatch", "aria-hidden": "true" });
    swatch.style.background = css(color);
    list.append(element("li", { class: "key" }, swatch, name));
  }
  return list;
}

function scale(low: number, high: number): HTMLElement[] {
  const width = 220;
  const canvas = element("canvas", { "aria-hidden": "true" });
  canvas.style.width = `${width}px`;
  canvas.style.height = "9px";
  const context = prepared(canvas, width, 9);
  for (let x = 0; context && x < width; ++x) {
    context.fillStyle = css(colorOfShare(x / (width - 1)));
    context.fillRect(x, 0, 1, 9);
  }
  const ends = element(
    "div",
    { class: "ends" },
    element("span", {}, rounded(low)),
    element("span", {}, rounded(high)),
  );
  return [canvas, ends];
}
