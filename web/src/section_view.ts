import * as THREE from 'three';

import type { Section } from './types';

const CAP = 0x5d8fd6;
const LINE = 0xffd166;

/** Twice the area of a curve; above 0 where it runs counter-clockwise, around material. */
function doubledArea(curve: readonly THREE.Vector2[]): number {
  let sum = 0;
  curve.forEach((b, i) => {
    const a = curve.at(i - 1) as THREE.Vector2;
    sum += a.x * b.y - b.x * a.y;
  });
  return sum;
}

function holds(curve: readonly THREE.Vector2[], { x, y }: THREE.Vector2): boolean {
  let inside = false;
  curve.forEach((b, i) => {
    const a = curve.at(i - 1) as THREE.Vector2;
    if (a.y > y !== b.y > y && x < ((b.x - a.x) * (y - a.y)) / (b.y - a.y) + a.x) inside = !inside;
  });
  return inside;
}

/** The cut material and its contour, in the plane of a section. */
export class SectionView {
  readonly group = new THREE.Group();

  /** Shows a section; null shows none. */
  set(section: Section | null): void {
    for (const child of this.group.children) ((child as THREE.Mesh).geometry as THREE.BufferGeometry).dispose();
    this.group.clear();
    if (!section) return;
    const [u, v] = [new THREE.Vector3(...section.u), new THREE.Vector3(...section.v)];
    this.group.matrixAutoUpdate = false;
    this.group.matrix.makeBasis(u, v, u.clone().cross(v)).setPosition(new THREE.Vector3(...section.origin_mm));
    this.group.matrixWorldNeedsUpdate = true;
    const curves = section.curves.map(({ points_mm: flat, closed }) => ({
      closed,
      points: Array.from(
        { length: flat.length / 2 },
        (_, i) => new THREE.Vector2(flat[2 * i] as number, flat[2 * i + 1] as number),
      ),
    }));
    this.cap(curves.filter(({ closed, points }) => closed && points.length > 2).map(({ points }) => points));
    for (const { closed, points } of curves) {
      const geometry = new THREE.BufferGeometry().setFromPoints(points);
      const material = new THREE.LineBasicMaterial({ color: LINE, depthTest: false, transparent: true });
      const line = closed ? new THREE.LineLoop(geometry, material) : new THREE.Line(geometry, material);
      line.renderOrder = 2;
      this.group.add(line);
    }
  }

  /** Fills what each outer curve encloses, less its holes. */
  private cap(curves: THREE.Vector2[][]): void {
    const sized = curves.map((points) => ({ points, area: doubledArea(points) }));
    const outer = sized.filter(({ area }) => area > 0).sort((a, b) => a.area - b.area);
    const holes = new Map<THREE.Vector2[], THREE.Vector2[][]>(outer.map(({ points }) => [points, []]));
    for (const { points, area } of sized) {
      if (area >= 0) continue;
      const around = outer.find((one) => one.area > -area && holds(one.points, points[0] as THREE.Vector2));
      if (around) holes.get(around.points)?.push(points);
    }
    for (const [points, inner] of holes) {
      const triangles = THREE.ShapeUtils.triangulateShape(points, inner);
      const geometry = new THREE.BufferGeometry().setFromPoints([...points, ...inner.flat()]);
      geometry.setIndex(triangles.flat());
      this.group.add(new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({ color: CAP, side: THREE.DoubleSide })));
    }
  }
}
