import * as THREE from 'three';

import type { MeshArrays } from './arrays';
import { MeshLevel } from './mesh_level';

/** The reference, in place of the surface. */
export class ReferenceView {
  readonly group = new THREE.Group();
  readonly box = new THREE.Box3();
  private level: MeshLevel | null = null;

  get shown(): boolean {
    return this.level !== null;
  }
  /** Shows a mesh; null shows none. */
  set(arrays: MeshArrays | null): void {
    this.level?.dispose();
    this.group.clear();
    this.level = arrays && new MeshLevel(arrays, 0x8fb0e0);
    if (!this.level) return;
    this.level.shade(true, false); // a CAD face has few triangles, whose corners know no edge
    this.group.add(this.level.group);
    this.box.setFromBufferAttribute(this.level.mesh.geometry.getAttribute('position') as THREE.BufferAttribute);
  }
}
