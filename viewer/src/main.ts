import { Color } from "three";
import { facing, fitted } from "./camera";
import { paint } from "./colors";
import { attachControls, type Pick } from "./controls";
import { readEmbedded } from "./data";
import { byId, element, grouped, rounded } from "./dom";
import { downloadsPanel, baseName, save } from "./downloads";
import type { Vector } from "./facts";
import { factsPanel } from "./facts_panel";
import { pathOf } from "./graph";
import { isFeature } from "./labels";
import { attachLegend, coloringPanel, layersPanel } from "./layers";
import { Measure } from "./measure";
import { Model } from "./model";
import { pickPoint } from "./pick";
import { PointPanel } from "./point_panel";
import { Result } from "./result";
import { sensitivityPanel } from "./sensitivity";
import { Space } from "./space";
import { Stage, standardPose } from "./stage";
import type { Stroke } from "./strokes";
import { linesPanel } from "./table";
import { fillToolbar } from "./toolbar";
import { linkText, parseLink } from "./view_link";

const neighborColor: Vector = [240, 200, 0];
const markColor: Vector = [240, 200, 0];
const creaseColor: Vector = [30, 34, 40];
const creaseColorInDark: Vector = [245, 246, 247];
const borderColor: Vector = [0, 140, 104];

/** The whole page: the model, the stage on which it is seen, and the panels that change it. */
class Page {
  private readonly model: Model;
  private readonly space: Space;
  private readonly stage: Stage | null;
  private readonly measure: Measure;
  private readonly point: PointPanel;
  private readonly isDark = matchMedia("(prefers-color-scheme: dark)");

  constructor(private readonly result: Result) {
    this.model = new Model(result);
    this.space = new Space(result.facts, result.position);
    this.measure = new Measure(result);
    this.stage = this.openStage();
    this.point = new PointPanel(
      this.model,
      () => this.stage?.pose ?? standardPose,
      () => this.findPoint(),
    );
    this.fillHeader();
    this.fillPanel();
    attachLegend(this.model, byId("legend"));
    if (this.stage) this.attachStage(this.stage);
    else byId("absent").hidden = byId("legend").hidden = false;
    addEventListener("hashchange", () => this.restore());
    this.restore();
  }

  private openStage(): Stage | null {
    const canvas = byId("canvas") as HTMLCanvasElement;
    try {
      return new Stage(canvas, this.space, this.splatRadius(), () => this.afterDrawing());
    } catch {
      canvas.hidden = true;
      byId("absent").append(
        "This browser offers no WebGL 2, so the cloud cannot be drawn. Everything else works.",
      );
      return null;
    }
  }

  /** So that splats of neighbours cover what lies between them, also where the cloud is thinned. */
  private splatRadius(): number {
    const { spacing, input, cloud } = this.result.facts;
    const thinned = Math.sqrt(Math.max(1, input.finite_points / Math.max(1, cloud.kept)));
    const radius = 0.95 * spacing * Math.min(thinned, 4) * this.space.unit;
    return Number.isFinite(radius) && radius > 0 ? Math.min(Math.max(radius, 1e-5), 0.05) : 0.02;
  }

  private attachStage(stage: Stage): void {
    attachControls(byId("canvas") as HTMLCanvasElement, stage, (pick) => this.pick(stage, pick));
    const tools = fillToolbar(byId("tools"), stage, {
      home: () => this.home(stage),
      measure: () => {
        this.measure.toggle();
        tools.measure.setAttribute("aria-pressed", `${this.measure.isOn}`);
        byId("stage").classList.toggle("measuring", this.measure.isOn);
        this.tellMeasure();
      },
      picture: () => void this.savePicture(stage),
      link: () => this.makeLink(stage),
    });
    byId("canvas").addEventListener("keydown", (event) => {
      if (event.key === "Escape") this.model.choosePoint(-1);
    });
    this.model.on(["labels", "appearance", "point"], () => this.repaint(stage));
    this.model.on(["appearance", "line"], () => this.redrawLines(stage));
    this.model.on(["point"], () => this.redrawMarks(stage));
    this.isDark.addEventListener("change", () => this.applyTheme(stage));
    this.applyTheme(stage);
    this.home(stage);
    this.repaint(stage);
  }

  private fillHeader(): void {
    const { title, input } = this.result.facts;
    document.title = `${title} – keenline`;
    byId("title").textContent = title;
    const update = () => {
      const counts = this.result.countOfKinds();
      const sharp = [...counts].reduce((sum, [kind, count]) => sum + (isFeature(kind) ? count : 0), 0);
      const words = [
        `${grouped(input.points)} point${input.points === 1 ? "" : "s"}`,
        `${grouped(sharp)} sharp`,
      ];
      const lines = this.result.facts.graph?.polylines.length;
      if (lines !== undefined) words.push(`${grouped(lines)} lines`);
      if (this.result.sigmaDeg !== null) words.push(`σ ${rounded(this.result.sigmaDeg)}°`);
      byId("summary").textContent = words.join(" · ");
      byId("canvas").setAttribute("aria-label", `Point cloud of ${words.join(", ")}`);
    };
    this.model.on(["labels"], update);
    update();
  }

  private fillPanel(): void {
    const { facts, spectrum } = this.result;
    const panel = byId("panel");
    const add = (id: string, title: string, content: HTMLElement, isOpen = true) => {
      const details = element("details", { id }, element("summary", {}, element("h2", {}, title)), content);
      details.open = isOpen;
      panel.append(details);
    };
    if (spectrum) add("sensitivity", "Sensitivity", sensitivityPanel(this.model));
    add("layers", "Layers", layersPanel(this.model));
    add("coloring", "Colour by", coloringPanel(this.model));
    add("point", facts.method === "gauss" ? "Gauss map of a point" : "Point", this.point.element);
    if (facts.graph)
      add(
        "line-table",
        "Lines",
        linesPanel(this.model, (line) => this.findLine(line)),
      );
    add("facts", "Facts", factsPanel(facts), false);
    add("downloads", "Download", downloadsPanel(this.result), false);
  }

  private home(stage: Stage): void {
    const { azimuthDeg, elevationDeg } = standardPose;
    stage.setPose({ ...stage.pose, azimuthDeg, elevationDeg });
    stage.fit();
  }

  private applyTheme(stage: Stage): void {
    const [r, g, b] = this.isDark.matches ? [16, 19, 22] : [241, 242, 243];
    stage.setBackground(new Color(r / 255, g / 255, b / 255));
    this.redrawLines(stage);
    this.redrawMarks(stage);
  }

  private repaint(stage: Stage): void {
    const colors = stage.cloud.paint;
    paint(this.result, this.model.coloring, (kind) => !this.model.hidden.has(kind), colors);
    for (const neighbor of this.model.neighbors) colors.set([...neighborColor, 2], 4 * neighbor);
    stage.cloud.repaint();
    stage.requestPicture();
  }

  private redrawLines(stage: Stage): void {
    const graph = this.model.showsLines ? this.result.facts.graph : null;
    const crease = this.isDark.matches ? creaseColorInDark : creaseColor;
    const strokes = (graph?.polylines ?? []).map((line, number): Stroke => {
      const isChosen = number === this.model.line;
      const color = isChosen ? markColor : line.kind === "border" ? borderColor : crease;
      return {
        path: pathOf(line).map((vertex) => this.space.ofPosition(vertex)),
        color,
        width: isChosen ? 2.4 : 1,
      };
    });
    stage.lines.set(strokes);
    stage.requestPicture();
  }

  /** From the chosen point to its neighbours, and what is measured. */
  private redrawMarks(stage: Stage): void {
    const { point, neighbors } = this.model;
    const ink = this.isDark.matches ? creaseColorInDark : creaseColor;
    const strokes: Stroke[] = [...neighbors].map((neighbor) => ({
      path: [this.space.ofPoint(point), this.space.ofPoint(neighbor)],
      color: ink,
      width: 0.5,
    }));
    if (this.measure.points.length === 2) {
      strokes.push({ path: this.measure.points.map((p) => this.space.ofPoint(p)), color: ink, width: 1.2 });
    }
    stage.marks.set(strokes);
    stage.requestPicture();
  }

  private pick(stage: Stage, pick: Pick): void {
    const point = this.pointAt(stage, pick);
    if (!this.measure.isOn) {
      this.model.choosePoint(point);
      return;
    }
    if (point >= 0) this.measure.add(point);
    this.redrawMarks(stage);
    this.tellMeasure();
  }

  /** What was hit, or else what was missed by little. */
  private pointAt(stage: Stage, pick: Pick): number {
    const canvas = byId("canvas");
    const screen = { width: canvas.clientWidth, height: canvas.clientHeight };
    const isShown = (i: number) => stage.cloud.paint[4 * i + 3] > 0;
    const thickness = 3 * this.splatRadius();
    const nearest = (tolerance: number) =>
      pickPoint(
        stage.cloud.positions,
        stage.projection(),
        screen,
        { ...pick, tolerance },
        thickness,
        isShown,
      );
    const hit = nearest(Math.max(pick.tolerance, stage.splatPixels()));
    return hit >= 0 ? hit : nearest(4 * pick.tolerance);
  }

  private tellMeasure(): void {
    byId("told").textContent = this.measure.words();
    if (this.stage) this.redrawMarks(this.stage);
  }

  /** Keeps what lies over the cloud where it belongs. */
  private afterDrawing(): void {
    this.point.redraw();
    const measured = byId("measured");
    const isMeasured = this.measure.points.length === 2;
    const [a, b] = this.measure.points.map((p) => this.space.ofPoint(p));
    const place = isMeasured
      ? this.stage?.placeOf([(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2])
      : null;
    measured.hidden = !place;
    if (!place) return;
    measured.textContent = rounded(this.measure.length());
    measured.style.left = `${place.x}px`;
    measured.style.top = `${place.y}px`;
  }

  private findPoint(): void {
    const { point, neighbors } = this.model;
    if (point < 0) return;
    // From outside: a point of the far side would be behind the near one.
    if (this.stage) this.stage.setPose(facing(this.stage.pose, this.space.ofPoint(point)));
    this.show(
      [point, ...neighbors].map((p) => this.space.ofPoint(p)),
      8,
    );
  }

  private findLine(line: number): void {
    this.model.chooseLine(line);
    const vertices = this.result.facts.graph?.polylines[line]?.vertices ?? [];
    this.show(
      vertices.map((vertex) => this.space.ofPosition(vertex)),
      1.6,
    );
  }

  /** Moves to some positions, with so many times the room that they need. */
  private show(positions: Vector[], room: number): void {
    if (!this.stage || positions.length === 0) return;
    const side = (choose: (a: number, b: number) => number) =>
      positions.reduce((a, b): Vector => [choose(a[0], b[0]), choose(a[1], b[1]), choose(a[2], b[2])]);
    const low = side(Math.min);
    const high = side(Math.max);
    const canvas = byId("canvas");
    const pose = fitted(this.stage.pose, low, high, canvas.clientWidth / Math.max(1, canvas.clientHeight));
    this.stage.setPose({ ...pose, height: Math.max(pose.height * room, 10 * this.splatRadius()) });
  }

  private async savePicture(stage: Stage): Promise<void> {
    const blob = await stage.picture();
    if (blob) save(blob, `${baseName(this.result.facts.title)}.png`);
  }

  private makeLink(stage: Stage): void {
    const { model, result } = this;
    const link = linkText({
      pose: stage.pose,
      sigmaDeg:
        result.sigmaDeg !== result.facts.sigma_deg && result.sigmaDeg !== null ? result.sigmaDeg : undefined,
      coloring: model.coloring,
      hidden: [...model.hidden],
      showsLines: model.showsLines,
      pointNumber: model.point < 0 ? undefined : result.numberInFile(model.point),
    });
    history.replaceState(null, "", `#${link}`);
    this.tell("The address of this page now holds the view.");
    navigator.clipboard?.writeText(location.href).then(
      () => this.tell("A link to this view is in the address bar and on the clipboard."),
      () => undefined,
    );
  }

  /** For a while. */
  private tell(words: string): void {
    const told = byId("told");
    told.textContent = words;
    setTimeout(() => told.textContent === words && (told.textContent = ""), 6000);
  }

  private restore(): void {
    const view = parseLink(location.hash);
    const { model } = this;
    if (view.sigmaDeg !== undefined) model.setSigma(view.sigmaDeg);
    if (view.coloring) model.setColoring(view.coloring);
    if (view.hidden)
      for (const { number } of this.result.facts.kinds) model.show(number, !view.hidden.includes(number));
    if (view.showsLines !== undefined) model.showLines(view.showsLines);
    if (view.pointNumber !== undefined) model.choosePoint(this.result.pointOfNumber(view.pointNumber));
    if (view.pose) this.stage?.setPose(view.pose);
  }
}

async function open(): Promise<void> {
  const { facts, columns } = await readEmbedded(document);
  new Page(new Result(facts, columns));
  document.body.dataset.ready = "yes";
}

open().catch((error: unknown) => {
  byId("summary").textContent = error instanceof Error ? error.message : String(error);
  document.body.dataset.ready = "failed";
});
