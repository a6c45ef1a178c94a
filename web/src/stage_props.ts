import * as THREE from 'three';

/** Lights that follow the camera. */
export function addLights(lights: THREE.Group): void {
  const add = (color: number, strength: number, x: number, y: number, z: number) => {
    const light = new THREE.DirectionalLight(color, strength);
    light.position.set(x, y, z);
    lights.add(light);
  };
  lights.add(new THREE.HemisphereLight(0xeaf1ff, 0x4a4540, 0.95));
  add(0xfff6ea, 2.7, -0.75, 0.9, 1.0); // key light, upper left of the viewer; lights follow the camera
  add(0xcfe4ff, 0.75, 1.0, -0.1, 0.25);
  add(0xffffff, 0.9, 0.3, 0.6, -1.0);
}

/** The turntable: a disc with a ring of degrees. */
export function addTable(table: THREE.Group): void {
  const disc = new THREE.Mesh(
    new THREE.CircleGeometry(110, 128),
    new THREE.MeshBasicMaterial({
      color: 0x808c88,
      transparent: true,
      opacity: 0.07,
      depthWrite: false,
      side: THREE.DoubleSide,
    }),
  );
  const points: number[] = [];
  for (let degree = 0; degree < 360; degree += 3) {
    const angle = (degree * Math.PI) / 180;
    const inner = degree % 45 === 0 ? 96 : degree % 15 === 0 ? 102 : 106;
    points.push(Math.cos(angle) * inner, Math.sin(angle) * inner, 0, Math.cos(angle) * 110, Math.sin(angle) * 110, 0);
  }
  const ticks = new THREE.BufferGeometry().setAttribute('position', new THREE.Float32BufferAttribute(points, 3));
  table.add(
    disc,
    new THREE.LineSegments(ticks, new THREE.LineBasicMaterial({ color: 0x808c88, transparent: true, opacity: 0.55 })),
  );
  const ring = new THREE.BufferGeometry().setFromPoints(
    Array.from(
      { length: 129 },
      (_, i) => new THREE.Vector3(Math.cos((i * Math.PI) / 64) * 110, Math.sin((i * Math.PI) / 64) * 110, 0),
    ),
  );
  table.add(new THREE.Line(ring, new THREE.LineBasicMaterial({ color: 0x808c88, transparent: true, opacity: 0.55 })));
}
