import * as THREE from 'three';

import type { Triple } from './types';

/** What the picture draws of a measurement. */
export interface Drawn {
  text: string;
  points: readonly Triple[];
  from: Triple;
  to: Triple;
}

const COLOR = 0xff8a4c;
/** Size of a line of text, pixels. */
const LINE = 18;
const LETTER = 7.6;

interface Anchor {
  at: THREE.Vector3;
  width: number;
  leader: SVGLineElement;
  text: SVGTextElement;
}
interface Box {
  x: number;
  y: number;
  width: number;
}

const element = <T extends SVGElement>(name: string): T =>
  document.createElementNS('http://www.w3.org/2000/svg', name) as T;

/** Whether two labels, each given by its middle, cover each other. */
const covers = (a: Box, b: Box): boolean =>
  Math.abs(a.x - b.x) < (a.width + b.width) / 2 + 6 && Math.abs(a.y - b.y) < LINE;

/** Measurements in the scene, each with its label, and the points of the one that is being clicked. */
export class Ruler {
  readonly group = new THREE.Group();
  readonly labels = element<SVGSVGElement>('svg');
  private readonly kept = new THREE.Group();
  private readonly present = new THREE.Group();
  private anchors: Anchor[] = [];

  constructor() {
    this.group.add(this.kept, this.present);
    this.labels.setAttribute('class', 'view-labels');
    this.labels.setAttribute('aria-hidden', 'true');
  }

  /** Shows points that do not make a measurement yet; balls are of a size, mm. */
  showPending(points: readonly THREE.Vector3[], size: number): void {
    this.present.clear();
    for (const point of points) this.present.add(ball(point, size));
  }

  show(list: readonly Drawn[], size: number): void {
    this.kept.clear();
    this.labels.replaceChildren();
    this.anchors = list.map(({ text: words, points, from, to }) => {
      for (const point of points) this.kept.add(ball(new THREE.Vector3(...point), size));
      const [a, b] = [new THREE.Vector3(...from), new THREE.Vector3(...to)];
      // The corner of an angle stands between the ends of its legs.
      const middle = points.length === 3 ? [new THREE.Vector3(...(points[1] as Triple))] : [];
      this.kept.add(line([a, ...middle, b]));
      const leader = element<SVGLineElement>('line');
      const text = element<SVGTextElement>('text');
      text.textContent = words;
      this.labels.append(leader, text);
      const at = middle[0]?.clone() ?? a.clone().lerp(b, 0.5);
      return { at, width: LETTER * words.length, leader, text };
    });
  }
  /** Shows or hides what was measured, and not what is being clicked. */
  showKept(shown: boolean): void {
    this.kept.visible = shown;
    this.labels.style.display = shown ? '' : 'none';
  }
  /** Puts the labels beside their measurements in the picture, pixels; one that would cover another moves away. */
  place(camera: THREE.Camera, width: number, height: number): void {
    // The scale bar, which stands at the lower left.
    const placed: Box[] = [44, 26].map((up) => ({ x: 150, y: height - up, width: 300 }));
    for (const { at, width: wide, leader, text } of this.anchors) {
      const seen = at.clone().project(camera);
      const shown = Math.abs(seen.x) < 1 && Math.abs(seen.y) < 1 && seen.z < 1;
      for (const one of [leader, text]) one.style.display = shown ? '' : 'none';
      if (!shown) continue;
      const [x, y] = [(0.5 + seen.x / 2) * width, (0.5 - seen.y / 2) * height];
      const box = {
        x: Math.min(width - wide / 2 - 6, Math.max(wide / 2 + 6, x)),
        y: Math.max(LINE, y - 14),
        width: wide,
      };
      const step = box.y > height / 2 ? -4 : 4;
      while (placed.some((one) => covers(one, box)) && box.y < height - LINE && box.y > LINE) box.y += step;
      placed.push(box);
      text.setAttribute('x', box.x.toFixed(1));
      text.setAttribute('y', box.y.toFixed(1));
      leader.setAttribute('x1', x.toFixed(1));
      leader.setAttribute('y1', y.toFixed(1));
      leader.setAttribute('x2', box.x.toFixed(1));
      leader.setAttribute('y2', (box.y - 4).toFixed(1));
    }
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
