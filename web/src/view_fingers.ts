type Place = [number, number];

/** Two fingers that pinch or move turn a little: what counts begins beyond this, radians. */
const UNMEANT = 0.14;

/** The middle of some fingers. */
const middle = (places: readonly Place[]): Place => [
  places.reduce((sum, [x]) => sum + x, 0) / places.length,
  places.reduce((sum, [, y]) => sum + y, 0) / places.length,
];

/** The angle from one direction to another, the short way. */
const turned = (from: number, to: number): number => {
  const by = to - from;
  return Math.atan2(Math.sin(by), Math.cos(by));
};

/** What turns the picture by touch, whatever one finger does: two fingers by their twist, three by moving. */
export function listenToFingers(
  canvas: HTMLCanvasElement,
  /** A twist on the screen, clockwise, radians. */
  twist: (angle: number) => void,
  /** A move of three fingers, shares of the height of the picture. */
  drag: (right: number, down: number) => void,
): void {
  const fingers = new Map<number, Place>();
  let unmeant = 0;
  const direction = (): number => {
    const [[ax, ay], [bx, by]] = [...fingers.values()] as [Place, Place];
    return Math.atan2(by - ay, bx - ax);
  };
  const place = ({ clientX, clientY }: PointerEvent): Place => [clientX, clientY];
  canvas.addEventListener('pointerdown', (event) => {
    if (event.pointerType !== 'touch') return;
    fingers.set(event.pointerId, place(event));
    unmeant = 0;
  });
  canvas.addEventListener('pointermove', (event) => {
    if (!fingers.has(event.pointerId)) return;
    const before = { direction: fingers.size === 2 ? direction() : 0, middle: middle([...fingers.values()]) };
    fingers.set(event.pointerId, place(event));
    if (fingers.size === 2) {
      const angle = turned(before.direction, direction());
      unmeant += angle;
      if (Math.abs(unmeant) > UNMEANT) twist(angle);
    } else if (fingers.size === 3) {
      const [x, y] = middle([...fingers.values()]);
      const height = Math.max(1, canvas.clientHeight);
      drag((x - before.middle[0]) / height, (y - before.middle[1]) / height);
    }
  });
  for (const end of ['pointerup', 'pointercancel'] as const)
    canvas.addEventListener(end, (event) => {
      fingers.delete(event.pointerId);
      unmeant = 0;
    });
}
