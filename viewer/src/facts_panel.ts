import { element, grouped, rounded } from "./dom";
import type { Facts } from "./facts";

/** Everything the program said about the result. */
export function factsPanel(facts: Facts): HTMLElement {
  const { input } = facts;
  const body = element(
    "div",
    { class: "body" },
    list([
      ["file", input.path || input.name],
      ["format", [input.format, input.encoding].filter(Boolean).join(", ")],
      [
        "points",
        grouped(input.points) +
          (input.finite_points < input.points ? `, ${grouped(input.finite_points)} finite` : ""),
      ],
      ["shown", grouped(facts.cloud.kept) + (facts.cloud.left_out ? `: ${facts.cloud.left_out}` : "")],
      ["spacing", rounded(facts.spacing)],
      [
        "noise",
        facts.noise === null
          ? "–"
          : `${rounded(facts.noise)} spacings${facts.smoothed ? ", smoothed before looking" : ""}`,
      ],
      ["method", facts.method ?? "labels of the input"],
      ["sigma", sigmaText(facts)],
      ["program", facts.program],
    ]),
  );
  if (facts.notes.length > 0) {
    const notes = element("ul", { class: "notes" });
    for (const note of facts.notes) notes.append(element("li", {}, note));
    body.append(element("h3", {}, "Notes"), notes);
  }
  const options = Object.entries(facts.options);
  if (options.length > 0)
    body.append(
      element("h3", {}, "Options as used"),
      list(options.map(([name, value]) => [name, optionText(value)])),
    );
  const times = Object.entries(facts.times);
  if (times.length > 0)
    body.append(
      element("h3", {}, "Seconds"),
      list(times.map(([stage, seconds]) => [stage, rounded(seconds)])),
    );
  return body;
}

function sigmaText(facts: Facts): string {
  const rule = facts.sigma_rule ? ` (${facts.sigma_rule})` : "";
  return facts.sigma_deg === null ? (facts.sigma_rule ?? "–") : `${rounded(facts.sigma_deg)}°${rule}`;
}

function optionText(value: Facts["options"][string]): string {
  if (typeof value === "boolean") return value ? "yes" : "no";
  return typeof value === "number" ? rounded(value) : (value ?? "–");
}

function list(rows: [string, string][]): HTMLElement {
  return element(
    "dl",
    {},
    ...rows.flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)]),
  );
}
