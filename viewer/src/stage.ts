import { Color, Scene, Vector4, WebGLRenderer, type Matrix4 } from "three";
import { cameraOf, fitted, projectionOf, type Pose } from "./camera";
import { Cloud, largestSplat } from "./cloud";
import type { View } from "./controls";
import { EyeDome } from "./eye_dome";
import type { Vector } from "./facts";
import type { Space } from "./space";
import { Strokes } from "./strokes";

export const standardPose: Pose = {
  target: [0, 0, 0],
  height: 2,
  azimuthDeg: -60,
  elevationDeg: 25,
  isPerspective: true,
};

const slowFrame = 60; // ms; above, fewer points are drawn while the view moves
const fewestPoints = 30000; // that are drawn while it moves
const restAfter = 150; // ms without a movement until all points are drawn again

/** The canvas and what is on it. Draws when something has changed, and only then. */
export class Stage implements View {
  readonly cloud: Cloud;
  readonly lines: Strokes;
  readonly marks: Strokes; // always in front: selected points, measured distances
  private readonly renderer: WebGLRenderer;
  private readonly eyeDome = new EyeDome();
  private readonly things = new Scene();
  private readonly foreground = new Scene();
  private currentPose = standardPose;
  private background = new Color();
  private isWaiting = false;
  private budget: number; // points that can be drawn while the view moves
  private coarseness = 1; // pixels of the screen to a pixel of the picture, while the view moves
  private lastMove = -Infinity;
  private isTiming = false;

  /** \param onDraw called after every picture \throw where there is no WebGL 2 */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly space: Space,
    private readonly splatRadius: number,
    private readonly onDraw: () => void,
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: false, alpha: false });
    this.renderer.autoClear = false;
    this.cloud = new Cloud(space.ofAll(), splatRadius);
    this.lines = new Strokes(3 * splatRadius, 0);
    this.marks = new Strokes(0, 1);
    this.marks.object.material.depthTest = false;
    this.things.add(this.cloud.object, this.lines.object);
    this.foreground.add(this.marks.object);
    this.budget = this.cloud.count;
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
  }

  get pose(): Pose {
    return this.currentPose;
  }

  setPose(pose: Pose): void {
    this.currentPose = pose;
    this.lastMove = performance.now();
    this.requestPicture();
  }

  fit(): void {
    this.setPose(fitted(this.currentPose, this.space.low, this.space.high, this.aspect()));
  }

  setBackground(color: Color): void {
    this.background = color;
    this.requestPicture();
  }

  /** From the space of things to clip coordinates. */
  projection(): Matrix4 {
    return projectionOf(cameraOf(this.currentPose, this.aspect(), this.reach()));
  }

  /** In CSS pixels from the left upper corner; null behind the viewer. */
  placeOf(position: Vector): { x: number; y: number } | null {
    const clip = new Vector4(...position, 1).applyMatrix4(this.projection());
    if (clip.w <= 0) return null;
    return {
      x: (0.5 + clip.x / clip.w / 2) * this.canvas.clientWidth,
      y: (0.5 - clip.y / clip.w / 2) * this.canvas.clientHeight,
    };
  }

  /** Radius of a splat about where the view is directed to, in CSS pixels. */
  splatPixels(): number {
    const pixels = (this.splatRadius / this.currentPose.height) * this.canvas.clientHeight;
    const largest = largestSplat / 2;
    return pixels > largest ? largest + 0.25 * (pixels - largest) : pixels;
  }

  requestPicture(): void {
    if (this.isWaiting) return;
    this.isWaiting = true;
    requestAnimationFrame(() => this.frame());
  }

  /** The view as a PNG, all points drawn. */
  picture(): Promise<Blob | null> {
    this.setResolution(1);
    this.draw(this.cloud.count);
    return new Promise((resolve) => this.canvas.toBlob(resolve, "image/png"));
  }

  private frame(): void {
    this.isWaiting = false;
    const now = performance.now();
    const isMoving = now - this.lastMove < restAfter;
    this.setResolution(isMoving ? this.coarseness : 1);
    this.draw(isMoving ? this.budget : this.cloud.count);
    if (isMoving) this.timePicture(now);
    const isPoor = this.budget < this.cloud.count || this.coarseness > 1;
    if (isMoving && isPoor) setTimeout(() => this.requestPicture(), restAfter + 10);
    this.onDraw();
  }

  /** Asks the card now and then whether it is done with what was begun, and learns how much it can draw. */
  private timePicture(begun: number): void {
    if (this.isTiming) return;
    const gl = this.renderer.getContext() as WebGL2RenderingContext;
    const done = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    if (!done) return;
    this.isTiming = true;
    gl.flush();
    const look = () => {
      if (gl.getSyncParameter(done, gl.SYNC_STATUS) !== gl.SIGNALED && performance.now() - begun < 5000) {
        setTimeout(look, 4);
        return;
      }
      gl.deleteSync(done);
      this.isTiming = false;
      this.adaptBudget(performance.now() - begun);
    };
    setTimeout(look, 0);
  }

  private adaptBudget(took: number): void {
    const least = Math.min(fewestPoints, this.cloud.count);
    if (took > 2 * slowFrame && this.budget <= least) this.coarseness = 2; // pixels cost more than points
    if (took > slowFrame) this.budget = Math.max(least, (this.budget * slowFrame) / took);
    else if (took < slowFrame / 2) this.budget = Math.min(1.25 * this.budget, this.cloud.count);
  }

  private draw(shown: number): void {
    const ratio = this.renderer.getPixelRatio();
    const { width, height } = this.canvas;
    this.cloud.prepare(shown, height, ratio);
    this.lines.prepare(width, height, ratio);
    this.marks.prepare(width, height, ratio);
    const camera = cameraOf(this.currentPose, this.aspect(), this.reach());
    this.eyeDome.render(this.renderer, this.things, camera, this.splatRadius, this.background);
    this.renderer.render(this.foreground, camera);
  }

  private aspect(): number {
    return Math.max(1, this.canvas.clientWidth) / Math.max(1, this.canvas.clientHeight);
  }

  /** How far from the target anything lies. */
  private reach(): number {
    const { low, high } = this.space;
    const farthest = [0, 1, 2].map((axis) =>
      Math.max(
        Math.abs(low[axis] - this.currentPose.target[axis]),
        Math.abs(high[axis] - this.currentPose.target[axis]),
      ),
    );
    return 1.05 * Math.hypot(...farthest) + 0.01;
  }

  private resize(): void {
    this.renderer.setSize(Math.max(1, this.canvas.clientWidth), Math.max(1, this.canvas.clientHeight), false);
    this.requestPicture();
  }

  private setResolution(coarseness: number): void {
    const ratio = Math.min(window.devicePixelRatio || 1, 2) / coarseness;
    if (ratio !== this.renderer.getPixelRatio()) this.renderer.setPixelRatio(ratio);
  }
}
