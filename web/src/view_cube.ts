import * as THREE from 'three';

import { type MessageKey, t } from './messages';
import { svgElement } from './svg_element';
import type { Triple } from './types';

/** The faces of the cube: their outward direction, and what is right and up on each. */
const FACES: readonly (readonly [MessageKey, Triple, Triple, Triple])[] = [
  ['app.front', [0, -1, 0], [1, 0, 0], [0, 0, 1]],
  ['app.back', [0, 1, 0], [-1, 0, 0], [0, 0, 1]],
  ['app.left', [-1, 0, 0], [0, -1, 0], [0, 0, 1]],
  ['app.right', [1, 0, 0], [0, 1, 0], [0, 0, 1]],
  ['app.top', [0, 0, 1], [1, 0, 0], [0, 1, 0]],
  ['app.bottom', [0, 0, -1], [1, 0, 0], [0, -1, 0]],
];
/** Half an edge, pixels; below, what a word may take of a face. */
export const HALF = 23;
const WORD = 40;
const LETTER_PX = 0.62;
/** A face that is seen more flatly than this shows no word. */
const FLAT = 0.25;

interface Face {
  away: THREE.Vector3;
  right: THREE.Vector3;
  up: THREE.Vector3;
  name: MessageKey;
  shape: SVGElement;
  text: SVGElement;
}

/** A cube that turns with the object; a click on a face looks at it straight. The buttons of the views do the same by keyboard. */
export class ViewCube {
  readonly group = svgElement('g', { class: 'cube' });
  private readonly faces: Face[];

  constructor(center: number, looked: (from: Triple) => void) {
    this.group.setAttribute('transform', `translate(${center} ${center})`);
    this.faces = FACES.map(([name, away, right, up]) => {
      const shape = svgElement('polygon', { 'data-face': name.slice(4) });
      const [x, y, z] = away;
      shape.addEventListener('click', () => looked(z === 0 ? away : [x, y - 0.001, z]));
      const text = svgElement('text', {});
      return {
        away: new THREE.Vector3(...away),
        right: new THREE.Vector3(...right),
        up: new THREE.Vector3(...up),
        name,
        shape,
        text,
      };
    });
    this.group.append(...this.faces.flatMap(({ shape, text }) => [shape, text]));
  }

  /** Turns the cube; `turn` is the rotation from the object to the eye. */
  update(turn: THREE.Quaternion): void {
    for (const { away, right, up, name, shape, text } of this.faces) {
      const n = away.clone().applyQuaternion(turn);
      const seen = n.z > 0.01;
      shape.toggleAttribute('hidden', !seen);
      text.toggleAttribute('hidden', n.z < FLAT);
      if (!seen) continue;
      const r = right.clone().applyQuaternion(turn);
      const u = up.clone().applyQuaternion(turn);
      const corner = (i: number, j: number) =>
        `${(HALF * (n.x + i * r.x + j * u.x)).toFixed(1)},${(-HALF * (n.y + i * r.y + j * u.y)).toFixed(1)}`;
      shape.setAttribute('points', [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)].join(' '));
      const word = t(name);
      text.textContent = word;
      text.setAttribute('font-size', Math.min(12, WORD / (LETTER_PX * word.length)).toFixed(1));
      const matrix = [r.x, -r.y, -u.x, u.y, HALF * n.x, -HALF * n.y].map((one) => one.toFixed(3));
      text.setAttribute('transform', `matrix(${matrix.join(' ')})`);
    }
  }
}
