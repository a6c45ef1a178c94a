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
/** Length of an axis: it ends outside of the cube. */
const ARM = 40;
const CENTER = 58;
/** An axis that is seen shorter than this share of its length is not drawn. */
const SHORTEST = 0.3;
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
  private readonly behind = svgElement('g', {});
  private readonly before = svgElement('g', {});

  /** `looked` is called with where the eye is to stand. */
  constructor(looked: (from: Triple) => void) {
    this.cube = new ViewCube(CENTER, looked);
    const names = this.arms.map(({ text }) => text);
    this.element.append(this.behind, this.cube.group, this.before, ...names, this.bar, this.label);
  }

  /** `mmPerPixel` and `widthPx` are those of the picture. */
  update(camera: THREE.Camera, mmPerPixel: number, widthPx: number): void {
    const turn = camera.quaternion.clone().invert();
    const seen = AXES.map(([, axis]) => axis.clone().applyQuaternion(turn));
    this.cube.update(turn);
    for (const [i, { x, y, z }] of seen.entries()) {
      const { line, text } = this.arms[i] as { line: SVGElement; text: SVGElement };
      // What points at the eye, or away from it, would stand on a word of the cube.
      for (const one of [line, text]) one.toggleAttribute('hidden', Math.hypot(x, y) < SHORTEST);
      // The cube covers what points away from the eye.
      const group = z > 0 ? this.before : this.behind;
      if (line.parentNode !== group) group.append(line);
      const begin = z > 0 ? HALF : 0;
      line.setAttribute('x1', (CENTER + begin * x).toFixed(1));
      line.setAttribute('y1', (CENTER - begin * y).toFixed(1));
      line.setAttribute('x2', (CENTER + ARM * x).toFixed(1));
      line.setAttribute('y2', (CENTER - ARM * y).toFixed(1));
      text.setAttribute('x', (CENTER + (ARM + 9) * x).toFixed(1));
      text.setAttribute('y', (CENTER - (ARM + 9) * y).toFixed(1));
    }
    const mmPerUnit = mmPerPixel * grownOf(this.element);
    const room = widthPx > NARROW_PX ? WIDEST_BAR_PX : Math.min(WIDEST_BAR_PX, widthPx - VIEWS_PX);
    const mm = roundLength(mmPerUnit * Math.max(SHORTEST_BAR_PX, room));
    const width = mm / mmPerUnit;
    this.bar.setAttribute('d', `M${BAR[0]} ${BAR[1]}v6h${width.toFixed(1)}v-6`);
    this.label.textContent = length(mm);
  }
}
