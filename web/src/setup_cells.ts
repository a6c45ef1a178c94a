/** Points of one setup in cubic cells, to ask whether any lies near a place. */
class Cells {
  private readonly cells = new Map<number, number[]>();

  constructor(
    private readonly positions: Float32Array,
    private readonly side: number,
  ) {
    for (let i = 0; i < positions.length; i += 3) {
      const key = this.key(positions[i] as number, positions[i + 1] as number, positions[i + 2] as number, 0, 0, 0);
      const cell = this.cells.get(key);
      if (cell) cell.push(i);
      else this.cells.set(key, [i]);
    }
  }

  /** Cells are numbered within a cube of 2048 a side around the origin. */
  private key(x: number, y: number, z: number, dx: number, dy: number, dz: number): number {
    const at = (value: number, step: number) => Math.floor(value / this.side) + step + 1024;
    return (at(x, dx) * 2048 + at(y, dy)) * 2048 + at(z, dz);
  }

  near(x: number, y: number, z: number): boolean {
    const reach2 = this.side * this.side;
    for (let dx = -1; dx <= 1; dx++)
      for (let dy = -1; dy <= 1; dy++)
        for (let dz = -1; dz <= 1; dz++)
          for (const i of this.cells.get(this.key(x, y, z, dx, dy, dz)) ?? []) {
            const [ex, ey, ez] = [
              (this.positions[i] as number) - x,
              (this.positions[i + 1] as number) - y,
              (this.positions[i + 2] as number) - z,
            ];
            if (ex * ex + ey * ey + ez * ez <= reach2) return true;
          }
    return false;
  }
}

/** A vertex is measured by a setup that has a point within three distances of neighbouring points. */
const REACH = 3;

/** For each vertex, the bits of the setups that measured points near it. */
export function setupsAt(positions: Float32Array, triangles: Uint32Array, clouds: readonly Float32Array[]): Uint8Array {
  let doubled = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => 3 * (triangles[t + k] as number)) as [number, number, number];
    const [ux, uy, uz] = [0, 1, 2].map((k) => (positions[b + k] as number) - (positions[a + k] as number)) as [
      number,
      number,
      number,
    ];
    const [vx, vy, vz] = [0, 1, 2].map((k) => (positions[c + k] as number) - (positions[a + k] as number)) as [
      number,
      number,
      number,
    ];
    doubled += Math.hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx);
  }
  const flags = new Uint8Array(positions.length / 3);
  clouds.slice(0, 8).forEach((cloud, setup) => {
    const spacing = Math.sqrt(doubled / 2 / Math.max(1, cloud.length / 3));
    const cells = new Cells(cloud, REACH * spacing || 1);
    for (let v = 0; v < flags.length; v++)
      if (cells.near(positions[3 * v] as number, positions[3 * v + 1] as number, positions[3 * v + 2] as number))
        flags[v] = (flags[v] as number) | (1 << setup);
  });
  return flags;
}
