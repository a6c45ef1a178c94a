import * as THREE from 'three';

export type MeasureKind = 'distance' | 'angle' | 'points';
export interface Measurement {
  distance_mm: number | null;
  sigma_mm: number | null;
  angle_deg: number | null;
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
    const ball = new THREE.Mesh(new THREE.SphereGeometry(size, 20, 14), new THREE.MeshBasicMaterial({ color: COLOR, depthTest: false }));
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
    if (kind === 'angle' && c) {
      const angle = a.clone().sub(b).angleTo(c.clone().sub(b));
      return { distance_mm: null, sigma_mm: null, angle_deg: (angle * 180) / Math.PI };
    }
    const combined = Math.hypot(...this.sigmas);
    return { distance_mm: a.distanceTo(b), sigma_mm: Number.isFinite(combined) ? combined : null, angle_deg: null };
  }
}
