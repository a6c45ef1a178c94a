import * as THREE from 'three';

import type { MeshArrays } from './arrays';
import { type Coloring, type Legend, vertexColors } from './mesh_colors';
import { SurfaceMaterial } from './surface_material';

const PLAIN = 0xd6d2c9;
/** One level of detail of the mesh: its surface, its wires and what is selected of it. */
export class MeshLevel {
  readonly group = new THREE.Group();
  readonly mesh: THREE.Mesh<THREE.BufferGeometry, SurfaceMaterial>;
  /** Draws the vertices of what has no triangles: a cloud of points. */
  private points: THREE.Points | null = null;
  private wires: THREE.LineSegments | null = null;
  private picked: THREE.Mesh | null = null;

  constructor(
    readonly arrays: MeshArrays,
    color = PLAIN,
  ) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(arrays.positions, 3));
    geometry.setAttribute('normal', new THREE.BufferAttribute(arrays.normals, 3));
    geometry.setIndex(new THREE.BufferAttribute(arrays.triangles, 1));
    geometry.computeBoundingSphere();
    this.mesh = new THREE.Mesh(geometry, new SurfaceMaterial(color));
    this.group.add(this.mesh);
    if (arrays.triangles.length > 0) return;
    // Without the index, which has no triangle.
    const cloud = new THREE.BufferGeometry().setAttribute('position', geometry.getAttribute('position'));
    this.points = new THREE.Points(cloud, new THREE.PointsMaterial({ size: 2, sizeAttenuation: false, color }));
    this.group.add(this.points);
  }

  get triangles(): number {
    return this.arrays.triangles.length / 3;
  }

  color(coloring: Coloring, scale: Legend | null): void {
    const { geometry, material } = this.mesh;
    const colors = vertexColors(this.arrays, coloring, scale);
    if (colors) geometry.setAttribute('color', new THREE.BufferAttribute(colors, 3, true));
    else geometry.deleteAttribute('color');
    material.setColored(colors !== null);
    if (!this.points) return;
    if (colors) this.points.geometry.setAttribute('color', geometry.getAttribute('color'));
    else this.points.geometry.deleteAttribute('color');
    const drawn = this.points.material as THREE.PointsMaterial;
    drawn.vertexColors = colors !== null;
    drawn.color.set(colors ? 0xffffff : PLAIN);
    drawn.needsUpdate = true;
  }

  shade(flat: boolean, wires: boolean): void {
    const { material } = this.mesh;
    material.setFlat(flat);
    if (wires && !this.wires) {
      this.wires = new THREE.LineSegments(
        new THREE.WireframeGeometry(this.mesh.geometry),
        new THREE.LineBasicMaterial({ color: 0x0c2a20, transparent: true, opacity: 0.42 }),
      );
      material.polygonOffset = true;
      material.polygonOffsetFactor = 1;
      material.polygonOffsetUnits = 1;
      this.group.add(this.wires);
    }
    if (this.wires) this.wires.visible = wires;
  }

  /** Shows the triangles whose flag is 1; null shows none. */
  select(flags: Uint8Array | null): void {
    if (this.picked) {
      this.picked.geometry.dispose();
      this.group.remove(this.picked);
      this.picked = null;
    }
    if (!flags || flags.length !== this.triangles) return;
    let count = 0;
    for (const flag of flags) count += flag;
    if (count === 0) return;
    const { triangles } = this.arrays;
    const index = new Uint32Array(count * 3);
    for (let i = 0, at = 0; i < flags.length; i++) {
      if (flags[i] === 0) continue;
      index[at++] = triangles[3 * i] as number;
      index[at++] = triangles[3 * i + 1] as number;
      index[at++] = triangles[3 * i + 2] as number;
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', this.mesh.geometry.getAttribute('position'));
    geometry.setAttribute('normal', this.mesh.geometry.getAttribute('normal'));
    geometry.setIndex(new THREE.BufferAttribute(index, 1));
    geometry.boundingSphere = this.mesh.geometry.boundingSphere;
    const material = new SurfaceMaterial(0xa175ff, true);
    material.polygonOffset = true;
    material.polygonOffsetFactor = -1;
    material.polygonOffsetUnits = -2;
    material.clippingPlanes = this.mesh.material.clippingPlanes;
    this.picked = new THREE.Mesh(geometry, material);
    this.group.add(this.picked);
  }

  cut(planes: THREE.Plane[]): void {
    for (const part of [this.mesh, this.wires, this.picked, this.points]) {
      if (!part) continue;
      const material = part.material as THREE.Material;
      if ((material.clippingPlanes ?? []).length !== planes.length) material.needsUpdate = true;
      material.clippingPlanes = planes;
    }
  }

  dispose(): void {
    this.select(null);
    this.wires?.geometry.dispose();
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
    this.points?.geometry.dispose();
    (this.points?.material as THREE.Material | undefined)?.dispose();
  }
}
