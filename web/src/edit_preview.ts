import * as THREE from 'three';

/** What an edit would create and remove, laid over the surface. */
export class EditPreview {
  readonly group = new THREE.Group();

  set(arrays: Map<string, ArrayLike<number>> | null): void {
    for (const child of [...this.group.children]) {
      (child as THREE.Mesh).geometry.dispose();
      this.group.remove(child);
    }
    if (!arrays) return;
    for (const [word, color] of [
      ['added', 0x2fd694],
      ['removed', 0xff6a55],
    ] as const) {
      const triangles = arrays.get(`${word}_triangles`) as Uint32Array | undefined;
      if (!triangles || triangles.length === 0) continue;
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute('position', new THREE.BufferAttribute(arrays.get(`${word}_positions`) as Float32Array, 3));
      geometry.setAttribute('normal', new THREE.BufferAttribute(arrays.get(`${word}_normals`) as Float32Array, 3));
      geometry.setIndex(new THREE.BufferAttribute(triangles, 1));
      const material = new THREE.MeshLambertMaterial({
        color,
        side: THREE.DoubleSide,
        polygonOffset: true,
        polygonOffsetFactor: -1,
        polygonOffsetUnits: -2,
      });
      // What is new lies above what goes, where both are close to the surface.
      if (word === 'added') Object.assign(material, { polygonOffsetFactor: -4, polygonOffsetUnits: -8 });
      if (word === 'removed') Object.assign(material, { transparent: true, opacity: 0.55, depthWrite: false });
      const wires = new THREE.Mesh(
        geometry,
        new THREE.MeshBasicMaterial({ color: 0x06251a, wireframe: true, transparent: true, opacity: 0.35 }),
      );
      this.group.add(new THREE.Mesh(geometry, material));
      if (word === 'added' && triangles.length < 300_000) this.group.add(wires);
    }
  }
}
