import * as THREE from 'three';

import type { RigGeometry } from './types';
import type { Viewer } from './viewer';

/** Looks at the part as the camera of the rig did at an angle of the turntable. */
export function standAtStation(viewer: Viewer, rig: RigGeometry, angleDeg: number): void {
  if (!rig.turntable) return;
  const objectFromRig = new THREE.Matrix4().set(...(rig.turntable.object_from_rig as THREE.Matrix4Tuple));
  // The part has turned with the table: seen from it, the camera went the other way.
  objectFromRig.premultiply(new THREE.Matrix4().makeRotationZ((-angleDeg * Math.PI) / 180));
  const eye = new THREE.Vector3().setFromMatrixPosition(objectFromRig);
  const axis = new THREE.Vector3(0, 0, 1).transformDirection(objectFromRig);
  const { height_px: height, focal_px: focal } = rig.camera;
  const field = (2 * Math.atan(height / 2 / focal[1]) * 180) / Math.PI;
  viewer.view.standAt(eye, axis, rig.turntable.distance_mm, field);
  viewer.draw();
}
