import * as THREE from 'three';

const AXES = [
  ['x', new THREE.Vector3(1, 0, 0)],
  ['y', new THREE.Vector3(0, 1, 0)],
  ['z', new THREE.Vector3(0, 0, 1)],
] as const;
const ARM = 26;
const CENTER = 40;
const WIDEST_BAR_PX = 150;

/** The largest of 1, 2 and 5 times a power of ten that is not above a length. */
export function roundLength(most: number): number {
  const ten = 10 ** Math.floor(Math.log10(most));
  return (most >= 5 * ten ? 5 : most >= 2 * ten ? 2 : 1) * ten;
}

const length = (mm: number): string => (mm < 1 ? `${Number((1000 * mm).toPrecision(1))} µm` : `${mm} mm`);

const element = (name: string, attributes: Record<string, string>): SVGElement => {
  const one = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) one.setAttribute(key, value);
  return one;
};

/** What stands on the 3D picture and follows the eye: the axes of the object, and a bar of known length. */
export class ViewMarks {
  readonly element = element('svg', { class: 'view-marks', 'aria-hidden': 'true' });
  private readonly arms = AXES.map(([name]) => {
    const line = element('line', { class: `axis ${name}`, x1: String(CENTER), y1: String(CENTER) });
    const text = element('text', { class: `axis ${name}` });
    text.textContent = name;
    return { line, text };
  });
  private readonly bar = element('path', { class: 'bar' });
  private readonly label = element('text', { class: 'bar', x: '92', y: '52' });

  constructor() {
    this.element.append(...this.arms.flatMap(({ line, text }) => [line, text]), this.bar, this.label);
  }

  update(camera: THREE.Camera, mmPerPixel: number): void {
    const turn = camera.quaternion.clone().invert();
    const seen = AXES.map(([, axis]) => axis.clone().applyQuaternion(turn));
    // What points to the eye is drawn over the others.
    const order = [0, 1, 2].sort((a, b) => (seen[a] as THREE.Vector3).z - (seen[b] as THREE.Vector3).z);
    for (const i of order) {
      const { x, y } = seen[i] as THREE.Vector3;
      const { line, text } = this.arms[i] as { line: SVGElement; text: SVGElement };
      line.setAttribute('x2', (CENTER + ARM * x).toFixed(1));
      line.setAttribute('y2', (CENTER - ARM * y).toFixed(1));
      text.setAttribute('x', (CENTER + (ARM + 9) * x).toFixed(1));
      text.setAttribute('y', (CENTER - (ARM + 9) * y).toFixed(1));
    }
    const mm = roundLength(mmPerPixel * WIDEST_BAR_PX);
    const width = mm / mmPerPixel;
    this.bar.setAttribute('d', `M92 60v6h${width.toFixed(1)}v-6`);
    this.label.textContent = length(mm);
  }
}
