import { shifted, turned, zoomed, type Pose } from "./camera";

export interface View {
  pose: Pose;
  setPose(pose: Pose): void;
  fit(): void;
}

export interface Pick {
  x: number; // CSS pixels from the left upper corner of the canvas
  y: number;
  tolerance: number; // in CSS pixels
}

const degreesPerHeight = 200;
const clickDistance = 4; // CSS pixels: a pointer that moved less did click

interface Pointer {
  x: number;
  y: number;
}

/**
 * Moves the view by mouse (left: turn, right or middle or with shift: shift, wheel: zoom), touch (one finger:
 * turn, two: shift and zoom) and keyboard (arrows: turn, with shift: shift, + and -: zoom, 0: fit).
 */
export function attachControls(canvas: HTMLCanvasElement, view: View, onPick: (pick: Pick) => void): void {
  const pointers = new Map<number, Pointer>();
  let travelled = 0;

  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    if (pointers.size === 0) travelled = 0;
    pointers.set(event.pointerId, placeOf(event, canvas));
  });

  canvas.addEventListener("pointermove", (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const now = placeOf(event, canvas);
    travelled += Math.hypot(now.x - before.x, now.y - before.y);
    const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
    pointers.set(event.pointerId, now);
    if (travelled < clickDistance) return;
    if (other) view.setPose(pinched(view.pose, before, now, other, canvas));
    else view.setPose(dragged(view.pose, before, now, canvas, event.shiftKey || (event.buttons & 6) !== 0));
  });

  const release = (event: PointerEvent) => {
    const wasAlone = pointers.size === 1 && pointers.delete(event.pointerId);
    pointers.delete(event.pointerId);
    if (event.type === "pointerup" && wasAlone && event.button === 0 && travelled < clickDistance) {
      onPick({ ...placeOf(event, canvas), tolerance: event.pointerType === "mouse" ? 6 : 16 });
    }
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());

  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const pixels = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 30 * event.deltaY : event.deltaY;
      const { x, y } = inHeights(placeOf(event, canvas), canvas);
      view.setPose(zoomed(view.pose, Math.exp(Math.min(Math.max(pixels, -300), 300) / 600), x, y));
    },
    { passive: false },
  );

  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const move = keyMove(event.key, event.shiftKey, view);
    if (!move) return;
    event.preventDefault();
    move();
  });
}

function keyMove(key: string, shift: boolean, view: View): (() => void) | undefined {
  const go = (right: number, up: number) => () =>
    view.setPose(shift ? shifted(view.pose, 0.06 * right, 0.06 * up) : turned(view.pose, 6 * right, 6 * up));
  const moves: Record<string, () => void> = {
    ArrowLeft: go(-1, 0),
    ArrowRight: go(1, 0),
    ArrowUp: go(0, 1),
    ArrowDown: go(0, -1),
    "+": () => view.setPose(zoomed(view.pose, 0.85)),
    "=": () => view.setPose(zoomed(view.pose, 0.85)),
    "-": () => view.setPose(zoomed(view.pose, 1 / 0.85)),
    "0": () => view.fit(),
    Home: () => view.fit(),
  };
  return moves[key];
}

function placeOf(event: MouseEvent, canvas: HTMLCanvasElement): Pointer {
  const box = canvas.getBoundingClientRect();
  return { x: event.clientX - box.left, y: event.clientY - box.top };
}

/** From the middle of the screen, in heights of the screen, y upwards. */
function inHeights({ x, y }: Pointer, canvas: HTMLCanvasElement): Pointer {
  const height = Math.max(1, canvas.clientHeight);
  return { x: (x - canvas.clientWidth / 2) / height, y: (canvas.clientHeight / 2 - y) / height };
}

function dragged(pose: Pose, before: Pointer, now: Pointer, canvas: HTMLCanvasElement, shift: boolean): Pose {
  const a = inHeights(before, canvas);
  const b = inHeights(now, canvas);
  if (shift) return shifted(pose, a.x - b.x, a.y - b.y);
  return turned(pose, degreesPerHeight * (a.x - b.x), degreesPerHeight * (a.y - b.y));
}

function pinched(pose: Pose, before: Pointer, now: Pointer, other: Pointer, canvas: HTMLCanvasElement): Pose {
  const [a, b, o] = [before, now, other].map((pointer) => inHeights(pointer, canvas));
  const apart = Math.max(1e-3, Math.hypot(b.x - o.x, b.y - o.y));
  const wasApart = Math.max(1e-3, Math.hypot(a.x - o.x, a.y - o.y));
  const moved = shifted(pose, (a.x - b.x) / 2, (a.y - b.y) / 2);
  return zoomed(moved, wasApart / apart, (b.x + o.x) / 2, (b.y + o.y) / 2);
}
