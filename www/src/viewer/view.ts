/** Width and height. */
export interface Size {
  readonly width: number;
  readonly height: number;
}

/** What of a frame is seen: the point in the middle of the canvas, and how large a pixel of the frame is there. */
export interface View {
  /** In pixels of the frame. */
  readonly x: number;
  /** In pixels of the frame. */
  readonly y: number;
  /** Pixels of the canvas for one of the frame. */
  readonly scale: number;
}

/** A rectangle on a canvas. */
export interface Place extends Size {
  readonly left: number;
  readonly top: number;
}

/** Pixels of the canvas that one pixel of the frame takes at most. */
const LARGEST = 48;

/** The view that shows the whole frame. */
export function fit(frame: Size, canvas: Size): View {
  const scale = Math.min(canvas.width / frame.width, canvas.height / frame.height);
  return { x: frame.width / 2, y: frame.height / 2, scale: scale > 0 ? scale : 1 };
}

/** Where the frame lies on the canvas. */
export function placeOf({ x, y, scale }: View, frame: Size, canvas: Size): Place {
  return {
    left: canvas.width / 2 - x * scale,
    top: canvas.height / 2 - y * scale,
    width: frame.width * scale,
    height: frame.height * scale,
  };
}

/** The point of the frame that a point of the canvas shows. */
export function toFrame({ x, y, scale }: View, canvas: Size, left: number, top: number): [number, number] {
  return [x + (left - canvas.width / 2) / scale, y + (top - canvas.height / 2) / scale];
}

/** The view so many times as large; the point of the frame under a point of the canvas stays there. */
export function zoom(
  view: View,
  frame: Size,
  canvas: Size,
  factor: number,
  left = canvas.width / 2,
  top = canvas.height / 2,
): View {
  const smallest = Math.min(fit(frame, canvas).scale, 1) / 2;
  const scale = Math.min(Math.max(view.scale * factor, smallest), Math.max(LARGEST, smallest));
  const [x, y] = toFrame(view, canvas, left, top);
  const moved = { x: x - (left - canvas.width / 2) / scale, y: y - (top - canvas.height / 2) / scale, scale };
  return kept(moved, frame);
}

/** The view with the frame moved by so many pixels of the canvas. */
export function pan(view: View, frame: Size, right: number, down: number): View {
  return kept({ ...view, x: view.x - right / view.scale, y: view.y - down / view.scale }, frame);
}

/** The view for a canvas of another size; one that showed the whole frame still does. */
export function resized(view: View, frame: Size, before: Size, after: Size): View {
  return isFit(view, frame, before) ? fit(frame, after) : view;
}

/** Whether the whole frame is shown as large as it can be. */
export function isFit(view: View, frame: Size, canvas: Size): boolean {
  const whole = fit(frame, canvas);
  return (
    Math.abs(view.scale / whole.scale - 1) < 1e-6 &&
    Math.abs(view.x - whole.x) < 1e-6 &&
    Math.abs(view.y - whole.y) < 1e-6
  );
}

/** The middle of the canvas stays on the frame, so that it cannot be lost. */
function kept({ x, y, scale }: View, frame: Size): View {
  return {
    x: Math.min(Math.max(x, 0), frame.width),
    y: Math.min(Math.max(y, 0), frame.height),
    scale,
  };
}
