export type Point = [number, number];

const CELL = 3;
const AROUND: readonly Point[] = [
  [1, 0],
  [1, 1],
  [0, 1],
  [-1, 1],
  [-1, 0],
  [-1, -1],
  [0, -1],
  [1, -1],
];

/** The outer outline of what a round brush covers along a stroke, pixels. */
export function brushOutline(stroke: readonly Point[], radius: number): Point[] {
  if (stroke.length === 0) return [];
  const reach = Math.ceil(radius / CELL) + 2;
  const xs = stroke.map(([x]) => x);
  const ys = stroke.map(([, y]) => y);
  const left = Math.min(...xs) / CELL - reach;
  const top = Math.min(...ys) / CELL - reach;
  const width = Math.ceil(Math.max(...xs) / CELL - left) + reach;
  const height = Math.ceil(Math.max(...ys) / CELL - top) + reach;
  const covered = new Uint8Array(width * height);
  const dab = ([x, y]: Point) => {
    const cx = x / CELL - left;
    const cy = y / CELL - top;
    const r = radius / CELL;
    for (let j = Math.floor(cy - r); j <= cy + r; j++)
      for (let i = Math.floor(cx - r); i <= cx + r; i++)
        if ((i - cx) ** 2 + (j - cy) ** 2 <= r * r) covered[j * width + i] = 1;
  };
  dab(stroke[0] as Point);
  for (let k = 1; k < stroke.length; k++) {
    const [a, b] = [stroke[k - 1] as Point, stroke[k] as Point];
    const steps = Math.max(1, Math.ceil(Math.hypot(b[0] - a[0], b[1] - a[1]) / (radius / 2)));
    for (let n = 1; n <= steps; n++) dab([a[0] + ((b[0] - a[0]) * n) / steps, a[1] + ((b[1] - a[1]) * n) / steps]);
  }
  // Moore's neighbour tracing, clockwise from the first covered cell.
  const start = covered.indexOf(1);
  if (start < 0) return [];
  const is = (i: number, j: number) => i >= 0 && j >= 0 && i < width && j < height && covered[j * width + i] === 1;
  const outline: Point[] = [];
  let [i, j] = [start % width, Math.floor(start / width)];
  const [i0, j0] = [i, j];
  let from = 4;
  for (let guard = 0; guard < covered.length; guard++) {
    outline.push([(i + left) * CELL, (j + top) * CELL]);
    let found = false;
    for (let turn = 1; turn <= 8 && !found; turn++) {
      const way = (from + turn) % 8;
      const [di, dj] = AROUND[way] as Point;
      if (!is(i + di, j + dj)) continue;
      i += di;
      j += dj;
      from = (way + 4) % 8;
      found = true;
    }
    if (!found || (i === i0 && j === j0)) break;
  }
  return outline;
}
