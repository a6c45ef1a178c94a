import * as THREE from 'three';

import type { MeshArrays } from './arrays';
import { viridis } from './colors';
import { colorByHeight, type Ends } from './mesh_colors';

/** The coarse surface among the clouds. */
const GROWN = 'grown';

/** The points of the stations of a scan, those of the live preview, which is station -1, and the surface that grows. */
export class CloudsView {
  readonly group = new THREE.Group();
  /** Stations that the surface holds: their points are not drawn. */
  private grown: readonly number[] = [];

  /** A coarse surface of some stations; null removes it. */
  setGrown(arrays: MeshArrays | null, stations: readonly number[]): void {
    const old = this.group.getObjectByName(GROWN) as THREE.Mesh | undefined;
    if (old) {
      old.geometry.dispose();
      (old.material as THREE.Material).dispose();
      this.group.remove(old);
    }
    this.grown = arrays ? stations : [];
    if (!arrays) return;
    const geometry = new THREE.BufferGeometry()
      .setAttribute('position', new THREE.BufferAttribute(arrays.positions, 3))
      .setAttribute('normal', new THREE.BufferAttribute(arrays.normals, 3))
      .setIndex(new THREE.BufferAttribute(arrays.triangles, 1));
    const mesh = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({ color: 0xb9c4c0, side: THREE.DoubleSide }));
    mesh.name = GROWN;
    this.group.add(mesh);
  }
  get triangles(): number {
    const mesh = this.group.getObjectByName(GROWN) as THREE.Mesh | undefined;
    return mesh ? (mesh.geometry.index?.count ?? 0) / 3 : 0;
  }

  /** Points of a station; those of the live preview are coloured by height, from one end of a scale to the other. */
  set(station: number, positions: Float32Array | null, ends: Ends | null = null): void {
    const old = this.group.getObjectByName(String(station)) as THREE.Points | undefined;
    if (old) {
      old.geometry.dispose();
      this.group.remove(old);
    }
    if (!positions) return;
    const geometry = new THREE.BufferGeometry().setAttribute('position', new THREE.BufferAttribute(positions, 3));
    const material = new THREE.PointsMaterial({ size: station < 0 ? 2 : 1.6, sizeAttenuation: false });
    if (ends) {
      colorByHeight(geometry, positions, ends);
      material.vertexColors = true;
    } else {
      const [r, g, b] = viridis(0.35 + 0.6 * ((station * 0.381966) % 1));
      material.color.setRGB(r / 255, g / 255, b / 255, THREE.SRGBColorSpace);
    }
    const points = new THREE.Points(geometry, material);
    points.name = String(station);
    this.group.add(points);
  }

  /** The first point that is shown within a distance of a ray, or that of the coarse surface on it. */
  pointOn(ray: THREE.Ray, distance: number): THREE.Vector3 | null {
    const caster = new THREE.Raycaster(ray.origin, ray.direction);
    caster.params.Points.threshold = distance;
    const shown = this.group.visible ? this.group.children.filter((one) => one.visible) : [];
    return caster.intersectObjects(shown, false)[0]?.point ?? null;
  }

  clear(): void {
    this.setGrown(null, []);
    for (const child of [...this.group.children]) this.set(Number(child.name), null);
  }

  /** Shows the clouds of some stations, or that of the live preview alone; returns whether the picture changes. */
  show(shown: boolean, live: boolean, isShown: (station: number) => boolean): boolean {
    const visible = () => [this.group, ...this.group.children].map((one) => one.visible).join();
    const before = visible();
    this.group.visible = shown;
    const grownIsShown = this.grown.every(isShown);
    for (const cloud of this.group.children) {
      if (cloud.name === GROWN) cloud.visible = !live && grownIsShown;
      else if (live || cloud.name === '-1') cloud.visible = live && cloud.name === '-1';
      else cloud.visible = isShown(Number(cloud.name)) && !(grownIsShown && this.grown.includes(Number(cloud.name)));
    }
    return visible() !== before;
  }
}
