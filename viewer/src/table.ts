import { element, grouped, rounded } from "./dom";
import { lineFacts, type LineFacts } from "./graph";
import type { Model } from "./model";

type Key = "number" | "kind" | "length" | "dihedral_deg" | "closed" | "support";

const columns: { key: Key; name: string; text: (line: LineFacts) => string }[] = [
  { key: "number", name: "line", text: (line) => `${line.number}` },
  { key: "length", name: "length", text: (line) => rounded(line.length) },
  {
    key: "dihedral_deg",
    name: "angle",
    text: (line) => (line.dihedral_deg === null ? "–" : `${Math.round(line.dihedral_deg)}°`),
  },
  { key: "kind", name: "kind", text: (line) => line.kind },
  { key: "closed", name: "closed", text: (line) => (line.closed ? "yes" : "no") },
  { key: "support", name: "points", text: (line) => (line.support === null ? "–" : grouped(line.support)) },
];
const mostRows = 500;

/** The lines, to be sorted by a click on a column and found by a click on a row. */
export function linesPanel(model: Model, onFind: (line: number) => void): HTMLElement {
  const graph = model.result.facts.graph;
  const lines = graph ? lineFacts(graph) : [];
  const rows = element("tbody");
  let sortedBy: Key = "length";
  let isRising = false;

  const heads = columns.map(({ key, name }) => {
    const sort = element("button", { type: "button" }, name);
    sort.addEventListener("click", () => {
      isRising = sortedBy === key ? !isRising : key === "number";
      sortedBy = key;
      fill();
    });
    return { key, cell: element("th", { scope: "col" }, sort) };
  });

  function fill(): void {
    for (const { key, cell } of heads) {
      cell.setAttribute("aria-sort", key !== sortedBy ? "none" : isRising ? "ascending" : "descending");
    }
    const sorted = sortedLines(lines, sortedBy, isRising).slice(0, mostRows);
    rows.replaceChildren(...sorted.map((line) => rowOf(line, () => onFind(line.number))));
    mark();
  }

  function mark(): void {
    for (const row of rows.rows) row.classList.toggle("chosen", row.dataset.line === `${model.line}`);
  }

  model.on(["line"], mark);
  fill();
  const table = element(
    "table",
    { id: "lines" },
    element("thead", {}, element("tr", {}, ...heads.map(({ cell }) => cell))),
    rows,
  );
  const body = element(
    "div",
    { class: "body" },
    element("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": "Lines" }, table),
  );
  if (lines.length > mostRows)
    body.append(element("p", { class: "quiet" }, `The first ${mostRows} of ${grouped(lines.length)} lines.`));
  return body;
}

/** Ties by number. What is not known comes last. */
export function sortedLines(lines: LineFacts[], key: Key, isRising: boolean): LineFacts[] {
  const sign = isRising ? 1 : -1;
  return [...lines].sort((a, b) => {
    const x = a[key];
    const y = b[key];
    if (x === null || y === null) return Number(x === null) - Number(y === null) || a.number - b.number;
    return x < y ? -sign : x > y ? sign : a.number - b.number;
  });
}

function rowOf(line: LineFacts, find: () => void): HTMLTableRowElement {
  const row = element("tr", { "data-line": `${line.number}` });
  columns.forEach(({ text }, column) => {
    if (column > 0) return row.append(element("td", {}, text(line)));
    const show = element("button", { type: "button", "aria-label": `Find line ${line.number}` }, text(line));
    show.addEventListener("click", find);
    row.append(element("td", {}, show));
  });
  return row;
}
