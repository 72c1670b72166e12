/** What gestures on the picture ask for; places are in pixels of the page, from the picture's upper left. */
export interface Asked {
  zoom(factor: number, left?: number, top?: number): void;
  pan(right: number, down: number): void;
  fit(): void;
  /** Pixels of the map as large as those of the screen. */
  actual(): void;
  fullScreen(): void;
  /** The pointer is over the picture, or no longer. */
  point(at: readonly [number, number] | undefined): void;
  /** Whether dragging and arrow keys move the lamp instead of the picture. */
  readonly lamp: boolean;
  /** Puts the lamp to where the pointer is. */
  lampTo(left: number, top: number): void;
  /** Moves the lamp by steps. */
  lampBy(right: number, up: number): void;
}

/** How much larger one press of a key or button makes the picture. */
export const STEP = 1.5;

/** Pixels that an arrow key moves the picture. */
const STRIDE = 48;

const ARROWS: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

/** Listens to wheel, pointers and keys on the picture. */
export function listen(canvas: HTMLCanvasElement, asked: Asked): void {
  const held = new Map<number, readonly [number, number]>();
  const at = (event: MouseEvent): readonly [number, number] => {
    const { left, top } = canvas.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  };
  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      // Lines and pages are some browsers' units of a wheel's click.
      const pixels = event.deltaY * ([1, 30, 300][event.deltaMode] ?? 1);
      // A pinch on a touchpad comes as a wheel with control, in small numbers.
      asked.zoom(Math.exp(-pixels * (event.ctrlKey ? 0.01 : 0.0022)), ...at(event));
    },
    { passive: false },
  );
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button > 1) return;
    canvas.setPointerCapture(event.pointerId);
    held.set(event.pointerId, at(event));
    if (held.size === 1 && movesLamp(asked, event)) asked.lampTo(...at(event));
  });
  canvas.addEventListener("pointermove", (event) => {
    const now = at(event);
    asked.point(now);
    const before = held.get(event.pointerId);
    if (before === undefined) return;
    const other = [...held].find(([id]) => id !== event.pointerId)?.[1];
    if (other) pinch(asked, other, before, now);
    else if (movesLamp(asked, event)) asked.lampTo(...now);
    else asked.pan(now[0] - before[0], now[1] - before[1]);
    held.set(event.pointerId, now);
  });
  for (const end of ["pointerup", "pointercancel"] as const) {
    canvas.addEventListener(end, ({ pointerId }) => held.delete(pointerId));
  }
  canvas.addEventListener("pointerleave", () => asked.point(undefined));
  canvas.addEventListener("dblclick", (event) => asked.zoom(2, ...at(event)));
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (key(asked, event)) event.preventDefault();
  });
}

/** With Shift or the middle button the picture is moved all the same. */
function movesLamp({ lamp }: Asked, { shiftKey, buttons }: PointerEvent): boolean {
  return lamp && !shiftKey && buttons !== 4;
}

/** Two fingers: the picture follows both. */
function pinch(
  asked: Asked,
  other: readonly [number, number],
  before: readonly [number, number],
  now: readonly [number, number],
): void {
  const [wide, wider] = [before, now].map(([x, y]) => Math.hypot(x - other[0], y - other[1]));
  if (wide && wider) asked.zoom(wider / wide, (now[0] + other[0]) / 2, (now[1] + other[1]) / 2);
  asked.pan((now[0] - before[0]) / 2, (now[1] - before[1]) / 2);
}

/** Does what a key asks for; whether it asked for anything. */
function key(asked: Asked, event: KeyboardEvent): boolean {
  const arrow = ARROWS[event.key];
  if (arrow) {
    const [right, up] = arrow;
    if (asked.lamp && !event.shiftKey) asked.lampBy(right, up);
    else asked.pan(-STRIDE * right, STRIDE * up);
    return true;
  }
  switch (event.key) {
    case "+":
    case "=":
      asked.zoom(STEP);
      return true;
    case "-":
      asked.zoom(1 / STEP);
      return true;
    case "0":
      asked.fit();
      return true;
    case "1":
      asked.actual();
      return true;
    case "f":
      asked.fullScreen();
      return true;
    default:
      return false;
  }
}
