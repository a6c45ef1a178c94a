import * as THREE from 'three';
import { ConvexGeometry } from 'three/addons/geometries/ConvexGeometry.js';

import type { Optics, RigGeometry } from './types';

const CAMERA = 0x6fb7ff;
const PROJECTOR = 0xffc15e;
const SHEET = 0xff5f57;
const SHARED = 0x52e3aa;

interface Cone {
  at: THREE.Vector3;
  corners: THREE.Vector3[];
}

/** Camera, projector, laser sheet and the volume that both see, in the frame of the turntable. */
export class RigModel {
  readonly group = new THREE.Group();

  set(rig: RigGeometry | null): void {
    this.group.traverse((part) => {
      if (part instanceof THREE.Mesh || part instanceof THREE.LineSegments) part.geometry.dispose();
    });
    this.group.clear();
    if (!rig) return;
    const objectFromRig = new THREE.Matrix4();
    if (rig.turntable) objectFromRig.set(...(rig.turntable.object_from_rig as Sixteen));
    else objectFromRig.set(1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1); // level, looking away
    const distance = rig.turntable?.distance_mm ?? 500;
    const reach = 1.22 * distance;
    const camera = cone(rig.camera, new THREE.Matrix4(), reach);
    const pose = new THREE.Matrix4().set(...(rig.rig_from_projector as Sixteen));
    const way = new THREE.Vector3().setFromMatrixPosition(pose).distanceTo(new THREE.Vector3(0, 0, distance));
    const projector = rig.projector
      ? cone(rig.projector, pose, 1.22 * way)
      : angularCone(rig.field_deg ?? [-10, 10], pose, 1.22 * way);
    const inRig = new THREE.Group();
    inRig.add(
      ...drawCone(camera, CAMERA),
      ...drawCone(projector, PROJECTOR),
      body(new THREE.Matrix4(), CAMERA, distance),
      body(pose, PROJECTOR, distance),
    );
    if (rig.laser_sheet) inRig.add(sheet(rig.laser_sheet, distance));
    const shared = intersection(camera, projector);
    if (shared) inRig.add(shared);
    inRig.applyMatrix4(objectFromRig);
    this.group.add(inRig);
  }

  /** What the picture is fitted to; null without a rig. */
  box(): THREE.Box3 | null {
    return this.group.children.length ? new THREE.Box3().setFromObject(this.group) : null;
  }
}

type Sixteen = [
  number,
  number,
  number,
  number,
  number,
  number,
  number,
  number,
  number,
  number,
  number,
  number,
  number,
  number,
  number,
  number,
];

function cone(optics: Optics, pose: THREE.Matrix4, reach: number): Cone {
  const corners = (
    [
      [0, 0],
      [1, 0],
      [1, 1],
      [0, 1],
    ] as const
  ).map(([u, v]) => {
    const x = (u * optics.width_px - 0.5 - optics.principal_point_px[0]) / optics.focal_px[0];
    const y = (v * optics.height_px - 0.5 - optics.principal_point_px[1]) / optics.focal_px[1];
    return new THREE.Vector3(x * reach, y * reach, reach).applyMatrix4(pose);
  });
  return { at: new THREE.Vector3().setFromMatrixPosition(pose), corners };
}

/** An interferometer lights a range of angles; its height is drawn as wide. */
function angularCone([low, high]: [number, number], pose: THREE.Matrix4, reach: number): Cone {
  const [a, b] = [Math.tan((low * Math.PI) / 180), Math.tan((high * Math.PI) / 180)];
  const h = (b - a) / 2;
  const corners = (
    [
      [a, -h],
      [b, -h],
      [b, h],
      [a, h],
    ] as const
  ).map(([x, y]) => new THREE.Vector3(x * reach, y * reach, reach).applyMatrix4(pose));
  return { at: new THREE.Vector3().setFromMatrixPosition(pose), corners };
}

function drawCone({ at, corners }: Cone, color: number): THREE.Object3D[] {
  const lines: THREE.Vector3[] = [];
  const faces: THREE.Vector3[] = [];
  corners.forEach((corner, i) => {
    const next = corners[(i + 1) % 4] as THREE.Vector3;
    lines.push(at, corner, corner, next);
    faces.push(at, corner, next);
  });
  const edge = new THREE.LineSegments(
    new THREE.BufferGeometry().setFromPoints(lines),
    new THREE.LineBasicMaterial({ color, transparent: true, opacity: 0.8 }),
  );
  const side = new THREE.Mesh(
    new THREE.BufferGeometry().setFromPoints(faces),
    new THREE.MeshBasicMaterial({
      color,
      transparent: true,
      opacity: 0.055,
      side: THREE.DoubleSide,
      depthWrite: false,
    }),
  );
  return [edge, side];
}

/** A housing with a lens. */
function body(pose: THREE.Matrix4, color: number, distance: number): THREE.Object3D {
  const size = distance / 14;
  const group = new THREE.Group();
  const dark = new THREE.MeshStandardMaterial({ color: 0x3a4447, roughness: 0.55 });
  const box = new THREE.Mesh(new THREE.BoxGeometry(size, size * 0.8, size * 1.2), dark);
  box.position.z = -size * 0.75;
  const lens = new THREE.Mesh(
    new THREE.CylinderGeometry(size * 0.3, size * 0.3, size * 0.35, 40),
    new THREE.MeshStandardMaterial({ color, roughness: 0.35 }),
  );
  lens.rotation.x = Math.PI / 2;
  group.add(box, lens);
  group.applyMatrix4(pose);
  return group;
}

function sheet(
  { normal, offset_mm }: { normal: [number, number, number]; offset_mm: number },
  distance: number,
): THREE.Object3D {
  const plane = new THREE.Mesh(
    new THREE.PlaneGeometry(0.5 * distance, 0.5 * distance),
    new THREE.MeshBasicMaterial({
      color: SHEET,
      transparent: true,
      opacity: 0.2,
      side: THREE.DoubleSide,
      depthWrite: false,
    }),
  );
  const n = new THREE.Vector3(...normal);
  plane.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), n);
  const middle = new THREE.Vector3(0, 0, distance);
  plane.position.copy(middle).addScaledVector(n, offset_mm - n.dot(middle));
  return plane;
}

/** The convex volume that lies in both cones: the corners where three of their planes meet. */
function intersection(a: Cone, b: Cone): THREE.Object3D | null {
  const planes = [...planesOf(a), ...planesOf(b)];
  const corners: THREE.Vector3[] = [];
  for (let i = 0; i < planes.length; i++)
    for (let j = i + 1; j < planes.length; j++)
      for (let k = j + 1; k < planes.length; k++) {
        const point = meeting(planes[i] as THREE.Plane, planes[j] as THREE.Plane, planes[k] as THREE.Plane);
        if (point && planes.every((plane) => plane.distanceToPoint(point) > -1e-6 * (1 + point.length())))
          corners.push(point);
      }
  if (corners.length < 4) return null;
  const geometry = new ConvexGeometry(corners);
  const group = new THREE.Group();
  group.add(
    new THREE.Mesh(
      geometry,
      new THREE.MeshBasicMaterial({
        color: SHARED,
        transparent: true,
        opacity: 0.16,
        side: THREE.DoubleSide,
        depthWrite: false,
      }),
    ),
    new THREE.LineSegments(new THREE.EdgesGeometry(geometry, 5), new THREE.LineBasicMaterial({ color: SHARED })),
  );
  return group;
}

function planesOf({ at, corners }: Cone): THREE.Plane[] {
  const middle = corners.reduce((sum, corner) => sum.add(corner), new THREE.Vector3()).divideScalar(4);
  const inside = at.clone().lerp(middle, 0.5);
  const planes = corners.map((corner, i) =>
    new THREE.Plane().setFromCoplanarPoints(at, corner, corners[(i + 1) % 4] as THREE.Vector3),
  );
  planes.push(
    new THREE.Plane().setFromCoplanarPoints(...(corners.slice(0, 3) as [THREE.Vector3, THREE.Vector3, THREE.Vector3])),
  );
  // In front of the parts, not at them.
  const near = corners.map((corner) => at.clone().lerp(corner, 0.62)) as [THREE.Vector3, THREE.Vector3, THREE.Vector3];
  planes.push(new THREE.Plane().setFromCoplanarPoints(near[0], near[1], near[2]));
  const beyond = at.clone().lerp(middle, 0.8);
  return planes.map((plane, i) => (plane.distanceToPoint(i === 5 ? beyond : inside) < 0 ? plane.negate() : plane));
}

function meeting(a: THREE.Plane, b: THREE.Plane, c: THREE.Plane): THREE.Vector3 | null {
  const bc = b.normal.clone().cross(c.normal);
  const volume = a.normal.dot(bc);
  if (Math.abs(volume) < 1e-9) return null;
  const ca = c.normal.clone().cross(a.normal);
  const ab = a.normal.clone().cross(b.normal);
  return bc
    .multiplyScalar(-a.constant)
    .addScaledVector(ca, -b.constant)
    .addScaledVector(ab, -c.constant)
    .divideScalar(volume);
}
