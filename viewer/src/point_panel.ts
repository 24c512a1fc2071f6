import { axesOf, type Pose } from "./camera";
import { colorOfCluster, css } from "./colors";
import { angleAt, drawDendrogram } from "./dendrogram";
import { button, element, grouped, rounded } from "./dom";
import { wholeOption } from "./facts";
import { cut, gaussMap, type Cut, type GaussMap } from "./gauss_map";
import { sensitivityOf } from "./labels";
import type { Model } from "./model";
import type { Result } from "./result";
import { drawSphere } from "./sphere";

/** More lines than this need more memory and time than a page should take. */
const mostNeighbors = 90;
const paperSigmaDeg = 20;

/** The Gauss map of the chosen point, cut where the slider stands. */
export class PointPanel {
  readonly element: HTMLElement;
  private readonly told = element("p", { id: "point-told", role: "status" });
  private readonly clusters = element("p", { class: "quiet", id: "point-clusters" });
  private readonly facts = element("dl");
  private readonly sphere = element("canvas", { role: "img", "aria-label": "Gauss map on the unit sphere" });
  private readonly dendrogram = element("canvas", {
    class: "dendrogram",
    role: "img",
    "aria-label": "Dendrogram of the lines",
  });
  private readonly maps = element("div", { class: "maps" }, this.sphere, this.dendrogram);
  private readonly number = element("input", {
    type: "number",
    min: "0",
    step: "1",
    id: "point-number",
    "aria-label": "Number of a point in the file",
  });
  private readonly isGauss: boolean;
  private map: GaussMap | null = null;
  private isWaiting = false;

  /** \param pose where the cloud is seen from */
  constructor(
    private readonly model: Model,
    private readonly pose: () => Pose,
    onFind: () => void,
  ) {
    this.isGauss = model.result.facts.method === "gauss";
    this.number.addEventListener("change", () =>
      this.model.choosePoint(this.model.result.pointOfNumber(this.number.valueAsNumber)),
    );
    const find = button("Find", onFind, { id: "point-find" });
    const clear = button("Clear", () => this.model.choosePoint(-1));
    this.element = element(
      "div",
      { class: "body" },
      this.told,
      this.maps,
      this.clusters,
      this.facts,
      element(
        "div",
        { class: "row" },
        element("label", { for: "point-number", class: "quiet" }, "Point"),
        this.number,
        find,
        clear,
      ),
    );
    this.attachDragging();
    model.on(["point"], () => this.choose());
    model.on(["labels"], () => this.update());
    new ResizeObserver(() => this.redraw()).observe(this.maps);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.redraw());
    this.choose();
  }

  /** When the cloud is seen from elsewhere, or the colours have changed. */
  redraw(): void {
    if (this.isWaiting || !this.map) return;
    this.isWaiting = true;
    requestAnimationFrame(() => {
      this.isWaiting = false;
      this.draw();
    });
  }

  private choose(): void {
    const { result, point, neighbors } = this.model;
    const wanted = wholeOption(result.facts, "neighbors") ?? 16;
    const isPossible = this.isGauss && point >= 0 && neighbors.length >= wanted && wanted <= mostNeighbors;
    this.map = isPossible ? gaussMap(result.seen(), point, neighbors, optionsOf(result)) : null;
    this.update();
  }

  private update(): void {
    const { result, point, neighbors } = this.model;
    const isChosen = point >= 0;
    this.maps.hidden = !this.map;
    this.facts.hidden = !isChosen;
    this.clusters.hidden = !isChosen || !this.isGauss;
    if (!isChosen) {
      const what = this.isGauss ? "what the method sees there" : "what is known of it";
      this.told.textContent = `Click a point of the cloud to see ${what}.`;
      return;
    }
    this.number.value = `${result.numberInFile(point)}`;
    const number = grouped(result.numberInFile(point));
    this.told.textContent = `Point ${number}: ${nameOfKind(result, result.kind[point])}`;
    const sizes = this.map ? this.cutNow(this.map).sizes : [];
    this.clusters.replaceChildren(
      ...(this.map
        ? clusterWords(sizes, this.map)
        : [
            neighbors.length > mostNeighbors
              ? "Too many neighbours to show here."
              : "Too few neighbours to decide.",
          ]),
    );
    this.facts.replaceChildren(...this.factsOf(result, point));
    this.redraw();
  }

  private factsOf(result: Result, point: number): HTMLElement[] {
    const rows: [string, string][] = [
      [
        "position",
        result
          .coordinates(point)
          .map((c) => positionText(c))
          .join(", "),
      ],
    ];
    const { kept } = result.facts.cloud;
    if (kept < result.facts.input.finite_points)
      rows.push(["seen among", `the ${grouped(kept)} points shown; the program saw all`]);
    for (const attribute of result.attributes) rows.push([attribute.name, rounded(attribute.value(point))]);
    if (result.clusters) rows.push(["directions", `${result.clusters[point]}`]);
    if (result.truth) rows.push(["truth", nameOfKind(result, result.truth[point])]);
    return rows.flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)]);
  }

  private sigmaDeg(): number {
    return this.model.result.sigmaAt(this.model.point) ?? paperSigmaDeg;
  }

  private cutNow(map: GaussMap): Cut {
    return cut(map, sensitivityOf(this.sigmaDeg()));
  }

  private draw(): void {
    if (!this.map) return;
    const now = this.cutNow(this.map);
    drawSphere(this.sphere, this.map, now, axesOf(this.pose()));
    drawDendrogram(this.dendrogram, this.map, now, this.sigmaDeg(), this.sphere.clientHeight);
  }

  private attachDragging(): void {
    const follow = (event: PointerEvent) => {
      if (!this.map) return;
      this.model.setSigma(
        angleAt(this.dendrogram, event.clientY - this.dendrogram.getBoundingClientRect().top, this.map),
      );
    };
    this.dendrogram.addEventListener("pointerdown", (event) => {
      this.dendrogram.setPointerCapture(event.pointerId);
      follow(event);
    });
    this.dendrogram.addEventListener("pointermove", (event) => {
      if (this.dendrogram.hasPointerCapture(event.pointerId)) follow(event);
    });
  }
}

function optionsOf({ facts }: Result) {
  const minSine = facts.options["min-sine"];
  return {
    minSine: typeof minSine === "number" ? minSine : 0.001,
    triangles: wholeOption(facts, "triangles"),
    minCluster: wholeOption(facts, "min-cluster"),
  };
}

function nameOfKind(result: Result, number: number): string {
  return result.facts.kinds.find((kind) => kind.number === number)?.name ?? `${number}`;
}

function clusterWords(sizes: number[], { lines, minCluster }: GaussMap): Node[] {
  const clusters = `${sizes.length} cluster${sizes.length === 1 ? "" : "s"}`;
  const words = `${clusters} of at least ${minCluster} of ${lines.length / 3} lines`;
  const keys = sizes.map((size, place) => {
    const swatch = element("span", { class: "swatch", "aria-hidden": "true" });
    swatch.style.background = css(colorOfCluster(place));
    return element("span", { class: "key" }, swatch, `${size}`);
  });
  return [element("span", { id: "cluster-count" }, words), element("span", { class: "row" }, ...keys)];
}

function positionText(coordinate: number): string {
  return String(Number(coordinate.toPrecision(10)));
}
