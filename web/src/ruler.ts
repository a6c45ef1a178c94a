import * as THREE from 'three';

import type { Point } from './strokes';
import { grownOf } from './grown';
import type { Triple } from './types';

/** What the picture draws of a measurement. */
export interface Drawn {
  /** Tells a label that was dragged from the others. */
  key: string;
  text: string;
  /** Of a value with a tolerance. */
  verdict?: 'in' | 'out' | 'undecided' | null;
  points: readonly Triple[];
  from: Triple;
  to: Triple;
}

const COLOR = 0xff8a4c;
/** Size of a line of text whose font has so many pixels, and what a letter takes of it. */
const FONT = 14;
const LINE = 18;
const LETTER = 7.6;

interface Anchor {
  key: string;
  at: THREE.Vector3;
  /** Where that is in the picture, pixels. */
  seen: Point;
  letters: number;
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

const within = (least: number, value: number, most: number): number => Math.max(least, Math.min(most, value));

/** Whether two labels, each given by its middle, cover each other. */
const covers = (a: Box, b: Box, line: number): boolean =>
  Math.abs(a.x - b.x) < (a.width + b.width) / 2 + 6 && Math.abs(a.y - b.y) < line;

/**
 * Measurements in the scene, each with its label, and the points of the one that is being clicked. A label that is dragged
 * stays beside its measurement as it was left; a double click lets it go.
 */
export class Ruler {
  readonly group = new THREE.Group();
  readonly labels = element<SVGSVGElement>('svg');
  private readonly kept = new THREE.Group();
  private readonly present = new THREE.Group();
  private anchors: Anchor[] = [];
  /** From the measurement to the middle of its label, pixels. */
  private readonly dragged = new Map<string, Point>();

  constructor(private readonly moved: () => void) {
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
    this.anchors = list.map(({ key, text: words, verdict, points, from, to }) => {
      for (const point of points) this.kept.add(ball(new THREE.Vector3(...point), size));
      const [a, b] = [new THREE.Vector3(...from), new THREE.Vector3(...to)];
      // The corner of an angle stands between the ends of its legs.
      const middle = points.length === 3 ? [new THREE.Vector3(...(points[1] as Triple))] : [];
      this.kept.add(line([a, ...middle, b]));
      const leader = element<SVGLineElement>('line');
      const text = element<SVGTextElement>('text');
      text.textContent = words;
      for (const one of [leader, text]) one.setAttribute('class', verdict ?? '');
      text.dataset['label'] = key;
      this.labels.append(leader, text);
      const at = middle[0]?.clone() ?? a.clone().lerp(b, 0.5);
      const anchor = { key, at, seen: [0, 0] as Point, letters: words.length, leader, text };
      this.drag(anchor);
      return anchor;
    });
  }
  private drag({ key, seen, text }: Anchor): void {
    let held: Point | null = null; // from the pointer to the middle of the label
    text.addEventListener('pointerdown', (event) => {
      held = [Number(text.getAttribute('x')) - event.clientX, Number(text.getAttribute('y')) - event.clientY];
      text.setPointerCapture(event.pointerId);
      event.stopPropagation();
    });
    text.addEventListener('pointermove', (event) => {
      if (!held) return;
      this.dragged.set(key, [event.clientX + held[0] - seen[0], event.clientY + held[1] - seen[1]]);
      this.moved();
    });
    for (const end of ['pointerup', 'pointercancel'] as const) text.addEventListener(end, () => (held = null));
    text.addEventListener('dblclick', (event) => {
      this.dragged.delete(key);
      event.stopPropagation();
      this.moved();
    });
  }
  /** Shows or hides what was measured, and not what is being clicked. */
  showKept(shown: boolean): void {
    this.kept.visible = shown;
    this.labels.style.display = shown ? '' : 'none';
  }
  /** Puts the labels beside their measurements in the picture, pixels; one that would cover another moves away. */
  place(camera: THREE.Camera, width: number, height: number): void {
    // Words grow on large screens.
    const grown = grownOf(this.labels);
    const row = LINE * grown;
    // The scale bar, which stands at the lower left.
    const placed: Box[] = [44, 26].map((up) => ({ x: 150 * grown, y: height - up * grown, width: 300 * grown }));
    // Those that were dragged first: the others move away from them.
    const inOrder = [...this.anchors].sort((a, b) => Number(this.dragged.has(b.key)) - Number(this.dragged.has(a.key)));
    for (const { key, at, seen: onPicture, letters, leader, text } of inOrder) {
      const wide = LETTER * grown * letters;
      const seen = at.clone().project(camera);
      const shown = Math.abs(seen.x) < 1 && Math.abs(seen.y) < 1 && seen.z < 1;
      for (const one of [leader, text]) one.style.display = shown ? '' : 'none';
      if (!shown) continue;
      const [x, y] = [(0.5 + seen.x / 2) * width, (0.5 - seen.y / 2) * height];
      onPicture[0] = x;
      onPicture[1] = y;
      const own = this.dragged.get(key);
      const box = {
        x: within(wide / 2 + 6, x + (own?.[0] ?? 0), Math.max(wide / 2 + 6, width - wide / 2 - 6)),
        y: within(row, y + (own?.[1] ?? -FONT * grown), height - 6),
        width: wide,
      };
      const step = box.y > height / 2 ? -4 : 4;
      while (!own && placed.some((one) => covers(one, box, row)) && box.y < height - row && box.y > row) box.y += step;
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
