import * as THREE from 'three';

import { viridis } from './colors';
import { colorByHeight } from './mesh_colors';

/** The points of the stations of a scan, and those of the live preview, which is station -1. */
export class CloudsView {
  readonly group = new THREE.Group();

  set(station: number, positions: Float32Array | null): void {
    const old = this.group.getObjectByName(String(station)) as THREE.Points | undefined;
    if (old) {
      old.geometry.dispose();
      this.group.remove(old);
    }
    if (!positions) return;
    const geometry = new THREE.BufferGeometry().setAttribute('position', new THREE.BufferAttribute(positions, 3));
    const material = new THREE.PointsMaterial({ size: station < 0 ? 2 : 1.6, sizeAttenuation: false });
    if (station < 0) {
      colorByHeight(geometry, positions);
      material.vertexColors = true;
    } else {
      const [r, g, b] = viridis(0.35 + 0.6 * ((station * 0.381966) % 1));
      material.color.setRGB(r / 255, g / 255, b / 255, THREE.SRGBColorSpace);
    }
    const points = new THREE.Points(geometry, material);
    points.name = String(station);
    this.group.add(points);
  }

  clear(): void {
    for (const child of [...this.group.children]) this.set(Number(child.name), null);
  }

  /** Shows the clouds of some stations, or that of the live preview alone; returns whether the picture changes. */
  show(shown: boolean, live: boolean, isShown: (station: number) => boolean): boolean {
    const visible = () => [this.group, ...this.group.children].map((one) => one.visible).join();
    const before = visible();
    this.group.visible = shown;
    for (const cloud of this.group.children)
      cloud.visible = live ? cloud.name === '-1' : cloud.name !== '-1' && isShown(Number(cloud.name));
    return visible() !== before;
  }
}
