import * as THREE from 'three';

import { grownOf } from './grown';
import { svgElement } from './svg_element';
import type { Triple } from './types';
import { HALF, ViewCube } from './view_cube';

const AXES = [
  ['x', new THREE.Vector3(1, 0, 0)],
  ['y', new THREE.Vector3(0, 1, 0)],
  ['z', new THREE.Vector3(0, 0, 1)],
] as const;
/** Length of an axis from the middle of the cube, what is seen of it outside of the cube at least, and where its letter follows. */
const ARM = 40;
const LEAST_ARM = 7;
const LETTER = 9;
/** An axis that is seen shorter than this share of its length is not drawn: its letter would stand on a word of the cube. */
const SHORTEST = 0.3;
const CENTER = 58;
const WIDEST_BAR_PX = 150;
/** In a picture up to this width, pixels, the views stand beside the bar, and take so much of it. */
const NARROW_PX = 900;
const VIEWS_PX = 356;
const SHORTEST_BAR_PX = 48;
/** Where the bar begins, right of the cube, and its height, pixels. */
const BAR = [128, 92] as const;

/** The largest of 1, 2 and 5 times a power of ten that is not above a length. */
export function roundLength(most: number): number {
  const ten = 10 ** Math.floor(Math.log10(most));
  return (most >= 5 * ten ? 5 : most >= 2 * ten ? 2 : 1) * ten;
}

const length = (mm: number): string => (mm < 1 ? `${Number((1000 * mm).toPrecision(1))} µm` : `${mm} mm`);

/**
 * How far the outline of the cube is from its middle in a direction of the picture, pixels. It has three pairs of parallel
 * sides, one along each axis as it is seen; the reach of the cube across a side is the sum of its half edges there.
 */
function outlineOf(seen: readonly THREE.Vector3[], u: number, v: number): number {
  const across = seen.map(({ x, y }) => {
    const reach = seen.reduce((sum, other) => sum + Math.abs(other.x * y - other.y * x), 0);
    return (HALF * reach) / Math.max(1e-9, Math.abs(u * y - v * x));
  });
  return Math.min(...across);
}

/** What stands on the 3D picture and follows the eye: a cube with the axes of the object, and a bar of known length. */
export class ViewMarks {
  readonly element = svgElement('svg', { class: 'view-marks', 'aria-hidden': 'true' });
  private readonly arms = AXES.map(([name]) => {
    const line = svgElement('line', { class: `axis ${name}` });
    const text = svgElement('text', { class: `axis ${name}` });
    text.textContent = name;
    return { line, text };
  });
  private readonly bar = svgElement('path', { class: 'bar' });
  private readonly label = svgElement('text', { class: 'bar', x: String(BAR[0]), y: String(BAR[1] - 8) });
  private readonly cube: ViewCube;

  /** `looked` is called with where the eye is to stand. */
  constructor(looked: (from: Triple) => void) {
    this.cube = new ViewCube(CENTER, looked);
    const arms = this.arms.flatMap(({ line, text }) => [line, text]);
    this.element.append(...arms, this.cube.group, this.bar, this.label);
  }

  /** `mmPerPixel` and `widthPx` are those of the picture. */
  update(camera: THREE.Camera, mmPerPixel: number, widthPx: number): void {
    const turn = camera.quaternion.clone().invert();
    const seen = AXES.map(([, axis]) => axis.clone().applyQuaternion(turn));
    this.cube.update(turn);
    for (const [i, { x, y }] of seen.entries()) {
      const { line, text } = this.arms[i] as { line: SVGElement; text: SVGElement };
      const size = Math.hypot(x, y);
      for (const one of [line, text]) one.toggleAttribute('hidden', size < SHORTEST);
      if (size < SHORTEST) continue;
      const place = (one: SVGElement, far: number, [left, top]: readonly [string, string]) => {
        one.setAttribute(left, (CENTER + (far * x) / size).toFixed(1));
        one.setAttribute(top, (CENTER - (far * y) / size).toFixed(1));
      };
      const begin = outlineOf(seen, x / size, y / size);
      const end = Math.max(ARM * size, begin + LEAST_ARM);
      place(line, begin, ['x1', 'y1']);
      place(line, end, ['x2', 'y2']);
      place(text, end + LETTER, ['x', 'y']);
    }
    const mmPerUnit = mmPerPixel * grownOf(this.element);
    const room = widthPx > NARROW_PX ? WIDEST_BAR_PX : Math.min(WIDEST_BAR_PX, widthPx - VIEWS_PX);
    const mm = roundLength(mmPerUnit * Math.max(SHORTEST_BAR_PX, room));
    const width = mm / mmPerUnit;
    this.bar.setAttribute('d', `M${BAR[0]} ${BAR[1]}v6h${width.toFixed(1)}v-6`);
    this.label.textContent = length(mm);
  }
}
