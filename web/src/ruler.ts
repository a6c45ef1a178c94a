import * as THREE from 'three';

export type MeasureKind = 'distance' | 'angle' | 'points';
export interface Measurement {
  distance_mm: number | null;
  /** Expanded uncertainty of the distance, k = 2. */
  u95_mm: number | null;
  angle_deg: number | null;
  /** Expanded uncertainty of the angle, k = 2. */
  u95_deg: number | null;
}

const COLOR = 0xff8a4c;

/** Points that were clicked on the surface, and what is measured between them. */
export class Ruler {
  readonly group = new THREE.Group();
  private ends: THREE.Vector3[] = [];
  private sigmas: number[] = [];

  clear(): void {
    this.ends = [];
    this.sigmas = [];
    this.group.clear();
  }

  /** Adds a point; returns a measurement once two points, or three for an angle, are there. */
  add(point: THREE.Vector3, sigma: number, kind: MeasureKind, size: number): Measurement | null {
    const wanted = kind === 'distance' ? 2 : 3;
    if (this.ends.length === wanted) this.clear();
    this.ends.push(point.clone());
    this.sigmas.push(sigma);
    const ball = new THREE.Mesh(
      new THREE.SphereGeometry(size, 20, 14),
      new THREE.MeshBasicMaterial({ color: COLOR, depthTest: false }),
    );
    ball.position.copy(point);
    ball.renderOrder = 3;
    this.group.add(ball);
    if (this.ends.length < wanted || kind === 'points') return null;
    const line = new THREE.Line(
      new THREE.BufferGeometry().setFromPoints(this.ends),
      new THREE.LineBasicMaterial({ color: COLOR, depthTest: false }),
    );
    line.renderOrder = 3;
    this.group.add(line);
    const [a, b, c] = this.ends as [THREE.Vector3, THREE.Vector3, THREE.Vector3 | undefined];
    const known = (value: number): number | null => (Number.isFinite(value) ? 2 * value : null);
    const [sa, sb, sc] = this.sigmas as [number, number, number | undefined];
    if (kind === 'angle' && c) {
      const [u, v] = [a.clone().sub(b), c.clone().sub(b)];
      const angle = u.angleTo(v);
      // The angle moves with the part of each error across its leg, in the plane of both legs.
      const axis = u.clone().cross(v).normalize();
      const ga = axis.clone().cross(u).divideScalar(-u.lengthSq());
      const gc = axis.clone().cross(v).divideScalar(v.lengthSq());
      const sigma = Math.hypot(sa * ga.length(), (sc as number) * gc.length(), sb * ga.add(gc).length());
      const u95 = known(sigma);
      return {
        distance_mm: null,
        u95_mm: null,
        angle_deg: (angle * 180) / Math.PI,
        u95_deg: u95 === null ? null : (u95 * 180) / Math.PI,
      };
    }
    return { distance_mm: a.distanceTo(b), u95_mm: known(Math.hypot(sa, sb)), angle_deg: null, u95_deg: null };
  }
}
