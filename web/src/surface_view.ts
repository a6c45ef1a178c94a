import * as THREE from 'three';

import type { MeshArrays } from './arrays';
import { colorMesh, type Coloring, type Legend } from './mesh_colors';

export type Shading = 'smooth' | 'flat' | 'wire';
export type SectionAxis = 'off' | 'x' | 'y' | 'z';

/** The mesh in the scene: shading, colours, section plane and selection. */
export class SurfaceView {
  readonly group = new THREE.Group();
  readonly plane = new THREE.Plane(new THREE.Vector3(1, 0, 0), 0);
  readonly box = new THREE.Box3();
  arrays: MeshArrays | null = null;
  mesh: THREE.Mesh<THREE.BufferGeometry, THREE.MeshStandardMaterial> | null = null;
  legend: Legend | null = null;
  section: { axis: SectionAxis; share: number; flipped: boolean } = { axis: 'off', share: 0.5, flipped: false };
  private inside: THREE.Mesh | null = null;
  private wire: THREE.LineSegments | null = null;
  private picked: THREE.Mesh | null = null;
  private shading: Shading = 'smooth';
  private coloring: Coloring = 'plain';
  private surfaceShown = true;

  /** Hides the surface while a scan is looked at. */
  show(shown: boolean): void {
    this.surfaceShown = shown;
    for (const part of [this.mesh, this.inside, this.picked]) if (part) part.visible = shown;
    if (this.wire) this.wire.visible = shown && this.shading === 'wire';
  }

  setMesh(arrays: MeshArrays | null): void {
    for (const part of [this.mesh, this.inside, this.wire, this.picked]) if (part) this.group.remove(part);
    this.mesh?.geometry.disposeBoundsTree();
    this.mesh?.geometry.dispose();
    this.wire?.geometry.dispose();
    this.mesh = this.inside = this.wire = this.picked = null;
    this.arrays = arrays;
    if (!arrays || arrays.triangles.length === 0) return;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(arrays.positions, 3));
    geometry.setAttribute('normal', new THREE.BufferAttribute(arrays.normals, 3));
    geometry.setIndex(new THREE.BufferAttribute(arrays.triangles, 1));
    geometry.computeBoundingBox();
    this.box.copy(geometry.boundingBox as THREE.Box3);
    const material = new THREE.MeshStandardMaterial({ color: 0xd6d2c9, roughness: 0.62, metalness: 0.0 });
    this.mesh = new THREE.Mesh(geometry, material);
    this.inside = new THREE.Mesh(
      geometry,
      new THREE.MeshStandardMaterial({ color: 0x7a4a3f, roughness: 0.9, side: THREE.BackSide }),
    );
    this.group.add(this.mesh, this.inside);
    this.legend = colorMesh(this.mesh, arrays, this.coloring);
    this.shade();
    this.cut();
    this.show(this.surfaceShown);
    // After the first picture: rays are needed when someone points at the mesh.
    setTimeout(() => {
      // Indirect: the triangles keep their order, by which the server numbers them.
      if (this.mesh?.geometry === geometry) geometry.computeBoundsTree({ indirect: true });
    }, 50);
  }

  setSelection(flags: Uint8Array | null): void {
    if (this.picked) {
      this.picked.geometry.dispose();
      this.group.remove(this.picked);
      this.picked = null;
    }
    if (flags && this.mesh && this.arrays && flags.length * 3 === this.arrays.triangles.length) {
      let count = 0;
      for (const flag of flags) count += flag;
      if (count > 0) {
        const index = new Uint32Array(count * 3);
        let at = 0;
        for (let i = 0; i < flags.length; i++) {
          if (!flags[i]) continue;
          index.set(this.arrays.triangles.subarray(3 * i, 3 * i + 3), at);
          at += 3;
        }
        const geometry = new THREE.BufferGeometry();
        geometry.setAttribute('position', this.mesh.geometry.getAttribute('position'));
        geometry.setAttribute('normal', this.mesh.geometry.getAttribute('normal'));
        geometry.setIndex(new THREE.BufferAttribute(index, 1));
        this.picked = new THREE.Mesh(
          geometry,
          new THREE.MeshStandardMaterial({
            color: 0x9a6bff, emissive: 0x43208f, roughness: 0.7, side: THREE.DoubleSide,
            polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -2,
            clippingPlanes: this.section.axis === 'off' ? [] : [this.plane],
          }),
        );
        this.group.add(this.picked);
      }
    }
  }

  /** Position of the section plane, mm. */
  get sectionAt(): number {
    const { axis, share } = this.section;
    if (axis === 'off' || this.box.isEmpty()) return 0;
    return this.box.min[axis] + share * (this.box.max[axis] - this.box.min[axis]);
  }

  get size(): THREE.Vector3 {
    return this.box.isEmpty() ? new THREE.Vector3() : this.box.getSize(new THREE.Vector3());
  }

  shade(): void {
    if (!this.mesh) return;
    const material = this.mesh.material;
    material.flatShading = this.shading === 'flat';
    material.needsUpdate = true;
    if (this.shading === 'wire' && !this.wire) {
      this.wire = new THREE.LineSegments(
        new THREE.WireframeGeometry(this.mesh.geometry),
        new THREE.LineBasicMaterial({ color: 0x0c2a20, transparent: true, opacity: 0.42 }),
      );
      material.polygonOffset = true;
      material.polygonOffsetFactor = 1;
      material.polygonOffsetUnits = 1;
      this.group.add(this.wire);
      this.cut();
    }
    if (this.wire) this.wire.visible = this.shading === 'wire';
  }

  cut(): void {
    const { axis, flipped } = this.section;
    const sign = flipped ? 1 : -1;
    if (axis !== 'off') {
      this.plane.normal.set(axis === 'x' ? sign : 0, axis === 'y' ? sign : 0, axis === 'z' ? sign : 0);
      this.plane.constant = -sign * this.sectionAt;
    }
    for (const part of [this.mesh, this.inside, this.wire, this.picked]) {
      if (!part) continue;
      const material = part.material as THREE.Material;
      material.clippingPlanes = axis === 'off' ? [] : [this.plane];
      material.needsUpdate = true;
    }
  }

  setShading(shading: Shading): void {
    this.shading = shading;
    this.shade();
  }

  setColoring(coloring: Coloring): void {
    this.coloring = coloring;
    this.legend = this.mesh && this.arrays ? colorMesh(this.mesh, this.arrays, coloring) : null;
  }
}
