/** Vertical fringes over a bust-like relief: the picture that the scanner sees. */
export function fringePaths(width: number, height: number): { d: string; strength: number }[] {
  const bump = (x: number, y: number, cx: number, cy: number, rx: number, ry: number) => {
    const r = ((x - cx) / rx) ** 2 + ((y - cy) / ry) ** 2;
    return r < 1 ? Math.sqrt(1 - r) : 0;
  };
  const relief = (x: number, y: number) =>
    Math.max(
      bump(x, y, 0.5, 0.33, 0.13, 0.25),
      0.72 * bump(x, y, 0.5, 0.62, 0.07, 0.2),
      0.86 * bump(x, y, 0.5, 1.02, 0.31, 0.36),
    ) +
    0.2 * bump(x, y, 0.52, 0.37, 0.028, 0.07);
  const paths: { d: string; strength: number }[] = [];
  const count = 64;
  for (let i = 0; i <= count; i++) {
    const u = i / count;
    let d = '';
    let lit = 0;
    for (let j = 0; j <= 90; j++) {
      const v = j / 90;
      const depth = relief(u, v);
      lit = Math.max(lit, depth);
      const x = (u + 0.055 * depth) * width;
      d += `${j === 0 ? 'M' : 'L'}${x.toFixed(1)} ${(v * height).toFixed(1)}`;
    }
    paths.push({ d, strength: 0.16 + 0.84 * Math.min(1, lit) });
  }
  return paths;
}
