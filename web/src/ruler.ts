import * as THREE from 'three';

export type MeasureKind = 'distance' | 'angle' | 'points';
export interface Measurement {
  points: readonly [number, number, number][];
  /** Of the points; NaN where not known. */
  sigmas_mm: readonly number[];
  distance_mm: number | null;
  /** Expanded uncertainty of the distance, k = 2. */
  u95_mm: number | null;
  angle_deg: number | null;
  /** Expanded uncertainty of the angle, k = 2. */
  u95_deg: number | null;
}

/** Points that were clicked on a mesh: two for a distance, three for an angle. */
export interface HandMeasurement {
  label: string;
  mesh: string;
  points_mm: [number, number, number][];
  sigmas_mm: (number | null)[];
}

const COLOR = 0xff8a4c;

/** The distance of two points, or the angle at the second of three, with its uncertainty from those of the points, mm. */
export function measured(points: readonly THREE.Vector3[], sigmas: readonly number[]): Measurement {
  const [a, b, c] = points as [THREE.Vector3, THREE.Vector3, THREE.Vector3 | undefined];
  const [sa, sb, sc] = sigmas as [number, number, number | undefined];
  const known = (value: number): number | null => (Number.isFinite(value) ? 2 * value : null);
  const places = points.map((point) => point.toArray() as [number, number, number]);
  if (!c)
    return {
      points: places,
      sigmas_mm: sigmas,
      distance_mm: a.distanceTo(b),
      u95_mm: known(Math.hypot(sa, sb)),
      angle_deg: null,
      u95_deg: null,
    };
  const [u, v] = [a.clone().sub(b), c.clone().sub(b)];
  // The angle moves with the part of each error across its leg, in the plane of both legs.
  const axis = u.clone().cross(v).normalize();
  const ga = axis.clone().cross(u).divideScalar(-u.lengthSq());
  const gc = axis.clone().cross(v).divideScalar(v.lengthSq());
  const u95 = known(Math.hypot(sa * ga.length(), (sc as number) * gc.length(), sb * ga.add(gc).length()));
  return {
    points: places,
    sigmas_mm: sigmas,
    distance_mm: null,
    u95_mm: null,
    angle_deg: (u.angleTo(v) * 180) / Math.PI,
    u95_deg: u95 === null ? null : (u95 * 180) / Math.PI,
  };
}

/** Points that are being clicked on the surface, and what was measured between others before, each with its letter. */
export class Ruler {
  readonly group = new THREE.Group();
  readonly labels = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  private readonly kept = new THREE.Group();
  private readonly present = new THREE.Group();
  private ends: THREE.Vector3[] = [];
  private sigmas: number[] = [];
  private anchors: { at: THREE.Vector3; text: SVGTextElement }[] = [];

  constructor() {
    this.group.add(this.kept, this.present);
    this.labels.setAttribute('class', 'view-labels');
    this.labels.setAttribute('aria-hidden', 'true');
  }

  /** Drops the points that do not make a measurement yet. */
  clear(): void {
    this.ends = [];
    this.sigmas = [];
    this.present.clear();
  }

  /** Shows measurements with their letters; balls are of a size, mm. */
  show(list: readonly { label: string; result: Measurement }[], size: number): void {
    this.kept.clear();
    this.labels.replaceChildren();
    this.anchors = list.map(({ label, result }) => {
      const points = result.points.map((point) => new THREE.Vector3(...point));
      for (const point of points) this.kept.add(ball(point, size));
      this.kept.add(line(points));
      const text = document.createElementNS('http://www.w3.org/2000/svg', 'text');
      text.textContent = label;
      this.labels.append(text);
      const at =
        result.angle_deg === null
          ? (points[0] as THREE.Vector3).clone().lerp(points[1] as THREE.Vector3, 0.5)
          : (points[1] as THREE.Vector3).clone();
      return { at, text };
    });
  }
  /** Puts the letters where their measurements are in the picture, pixels. */
  place(camera: THREE.Camera, width: number, height: number): void {
    for (const { at, text } of this.anchors) {
      const seen = at.clone().project(camera);
      text.setAttribute('x', ((0.5 + seen.x / 2) * width).toFixed(1));
      text.setAttribute('y', ((0.5 - seen.y / 2) * height - 8).toFixed(1));
    }
  }

  /** Adds a point; returns a measurement once two points, or three for an angle, are there. */
  add(point: THREE.Vector3, sigma: number, kind: MeasureKind, size: number): Measurement | null {
    const wanted = kind === 'distance' ? 2 : 3;
    if (this.ends.length === wanted) this.clear();
    this.ends.push(point.clone());
    this.sigmas.push(sigma);
    this.present.add(ball(point, size));
    if (this.ends.length < wanted || kind === 'points') return null;
    const result = measured(this.ends, [...this.sigmas]);
    this.clear();
    return result;
  }
}

function ball(point: THREE.Vector3, size: number): THREE.Mesh {
  const one = new THREE.Mesh(
    new THREE.SphereGeometry(size, 20, 14),
    new THREE.MeshBasicMaterial({ color: COLOR, depthTest: false }),
  );
  one.position.copy(point);
  one.renderOrder = 3;
  return one;
}

function line(points: THREE.Vector3[]): THREE.Line {
  const one = new THREE.Line(
    new THREE.BufferGeometry().setFromPoints(points),
    new THREE.LineBasicMaterial({ color: COLOR, depthTest: false }),
  );
  one.renderOrder = 3;
  return one;
}
