import { button, element, grouped, prepared, rounded } from "./dom";
import type { KindFacts } from "./facts";
import { isFeature } from "./labels";
import type { Model } from "./model";

const lowest = 0.25; // degrees
const highest = 90;
const margin = 8; // of the plot at both sides: half the thumb of a slider, so that the two agree
const plotHeight = 96;

/** The slider and, above it, how many points are sharp at every sensitivity. */
export function sensitivityPanel(model: Model): HTMLElement {
  const { result } = model;
  const shown = element("output", { id: "sigma", for: "sigma-slider" });
  const features = element("span", { id: "sharp-count" });
  const plot = element("canvas", { class: "plot", "aria-hidden": "true" });
  const slider = element("input", {
    id: "sigma-slider",
    class: "slider",
    type: "range",
    min: `${lowest}`,
    max: `${highest}`,
    step: "0.25",
    "aria-label": "Sensitivity σ in degrees",
  });
  const exact = element("input", {
    id: "sigma-exact",
    type: "number",
    min: "0",
    max: `${highest}`,
    step: "any",
    "aria-label": "Sensitivity σ in degrees, exactly",
  });
  const back = button("", () => model.setSigma(null), { id: "sigma-back" });
  back.textContent =
    result.facts.sigma_deg === null
      ? "As detected: σ per point"
      : `As detected: ${rounded(result.facts.sigma_deg)}°`;

  slider.addEventListener("input", () => model.setSigma(slider.valueAsNumber));
  exact.addEventListener("change", () => model.setSigma(exact.valueAsNumber));
  attachDragging(plot, (sigma) => model.setSigma(sigma));

  let isDrawing = false;
  const draw = () => {
    isDrawing = false;
    drawPlot(plot, model);
  };
  const update = () => {
    const sigma = result.sigmaDeg;
    const counts = result.countOfKinds();
    const sharp = [...counts].reduce((sum, [kind, count]) => sum + (isFeature(kind) ? count : 0), 0);
    shown.textContent = sigma === null ? "σ per point" : `σ ${rounded(sigma)}°`;
    features.textContent = `${grouped(sharp)} sharp point${sharp === 1 ? "" : "s"}`;
    if (sigma !== null) {
      slider.value = `${sigma}`;
      if (document.activeElement !== exact) exact.value = `${Number(sigma.toFixed(5))}`;
    }
    slider.setAttribute("aria-valuetext", `${shown.textContent}, ${features.textContent}`);
    back.disabled = sigma === result.facts.sigma_deg;
    if (!isDrawing) requestAnimationFrame(draw);
    isDrawing = true;
  };
  model.on(["labels"], update);
  update();
  new ResizeObserver(draw).observe(plot);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
  return element(
    "div",
    { class: "body" },
    element("div", { class: "sigma" }, shown, features),
    element("div", {}, plot, slider),
    element("div", { class: "row" }, exact, back),
  );
}

function attachDragging(plot: HTMLCanvasElement, onSigma: (sigma: number) => void): void {
  const follow = (event: PointerEvent) => {
    const box = plot.getBoundingClientRect();
    const share = (event.clientX - box.left - margin) / Math.max(1, box.width - 2 * margin);
    onSigma(lowest + Math.min(Math.max(share, 0), 1) * (highest - lowest));
  };
  plot.addEventListener("pointerdown", (event) => {
    plot.setPointerCapture(event.pointerId);
    follow(event);
  });
  plot.addEventListener("pointermove", (event) => {
    if (plot.hasPointerCapture(event.pointerId)) follow(event);
  });
}

/** Edges, corners and peaks on top of each other; the automatic choice and the present one. */
function drawPlot(canvas: HTMLCanvasElement, { result }: Model): void {
  const width = canvas.clientWidth;
  if (width === 0) return;
  canvas.style.height = `${plotHeight}px`;
  const context = prepared(canvas, width, plotHeight);
  if (!context) return;
  const style = getComputedStyle(canvas);
  const ink = style.getPropertyValue("--ink");
  const quiet = style.getPropertyValue("--quiet");
  const top = 18;
  const bottom = plotHeight - 15;
  const xOf = (sigma: number) => margin + ((sigma - lowest) / (highest - lowest)) * (width - 2 * margin);
  const columns = Math.max(2, Math.round(width - 2 * margin));
  const sigmas = Array.from({ length: columns + 1 }, (_, i) => lowest + (i / columns) * (highest - lowest));
  const most = Math.max(1, ...sigmas.map((sigma) => result.featuresAt(sigma) ?? 0));
  const yOf = (count: number) => bottom - (count / most) * (bottom - top);

  let below = sigmas.map(() => 0);
  for (const kind of result.facts.kinds.filter(({ number }) => isFeature(number))) {
    const above = sigmas.map((sigma, i) => below[i] + (result.countAt(sigma, kind.number) ?? 0));
    fillBand(context, kind, sigmas.map(xOf), below.map(yOf), above.map(yOf));
    below = above;
  }

  context.font = `11px ${style.fontFamily}`;
  context.fillStyle = quiet;
  context.strokeStyle = style.getPropertyValue("--rule");
  context.beginPath();
  context.moveTo(margin, bottom + 0.5);
  context.lineTo(width - margin, bottom + 0.5);
  context.stroke();
  context.textBaseline = "top";
  for (const sigma of [0, 15, 30, 45, 60, 75, 90]) {
    context.textAlign = sigma === 0 ? "left" : sigma === 90 ? "right" : "center";
    context.fillText(`${sigma}°`, xOf(Math.max(sigma, lowest)), bottom + 4);
  }
  context.textAlign = "left";
  context.fillText(grouped(most), margin, 2);

  if (result.facts.sigma_deg !== null) {
    const isAutomatic = result.facts.sigma_rule === "auto";
    drawMark(
      context,
      xOf(result.facts.sigma_deg),
      quiet,
      [3, 3],
      isAutomatic ? "automatic" : "as detected",
      width,
    );
  }
  if (result.sigmaDeg !== null) drawMark(context, xOf(result.sigmaDeg), ink, [], "", width);

  function drawMark(
    on: CanvasRenderingContext2D,
    x: number,
    color: string,
    dash: number[],
    name: string,
    room: number,
  ): void {
    on.strokeStyle = on.fillStyle = color;
    on.setLineDash(dash);
    on.beginPath();
    on.moveTo(x, top - 3);
    on.lineTo(x, bottom);
    on.stroke();
    on.setLineDash([]);
    on.textAlign = x > room * 0.7 ? "right" : "left";
    on.fillText(name, x + (x > room * 0.7 ? -4 : 4), 2);
  }
}

function fillBand(
  on: CanvasRenderingContext2D,
  kind: KindFacts,
  xs: number[],
  below: number[],
  above: number[],
): void {
  on.fillStyle = kind.color;
  on.beginPath();
  xs.forEach((x, i) => on.lineTo(x, above[i]));
  for (let i = xs.length - 1; i >= 0; --i) on.lineTo(xs[i], below[i]);
  on.fill();
}
