import * as THREE from 'three';

/** A place that is ringed. */
export interface Marked {
  center_mm: [number, number, number];
  size_mm: number;
}

/** How much larger than its hole a ring is. */
const AROUND = 1.25;

/** A ring that faces whoever looks, as a picture. */
function ring(): THREE.Texture {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = 128;
  const pen = canvas.getContext('2d') as CanvasRenderingContext2D;
  for (const [color, width] of [
    ['#ffffff', 13],
    ['#8a5cf0', 8],
  ] as const) {
    pen.strokeStyle = color;
    pen.lineWidth = width;
    pen.beginPath();
    pen.arc(64, 64, 54, 0, 2 * Math.PI);
    pen.stroke();
  }
  return new THREE.CanvasTexture(canvas);
}

/** Rings around holes and places that were chosen, so that one sees which they are. */
export class HoleMarks {
  readonly group = new THREE.Group();
  private material: THREE.SpriteMaterial | null = null;
  private shown = '';

  /** Returns whether the picture changes. */
  set(holes: readonly Marked[], least_mm: number): boolean {
    const key = JSON.stringify([holes, least_mm]);
    if (key === this.shown) return false;
    this.shown = key;
    this.group.clear();
    this.material ??= new THREE.SpriteMaterial({ map: ring(), depthTest: false, transparent: true });
    for (const hole of holes) {
      const sprite = new THREE.Sprite(this.material);
      sprite.position.set(...hole.center_mm);
      sprite.scale.setScalar(Math.max(least_mm, AROUND * hole.size_mm));
      sprite.renderOrder = 3;
      this.group.add(sprite);
    }
    return true;
  }
}
