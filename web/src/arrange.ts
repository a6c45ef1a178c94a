import * as THREE from 'three';

import type { RigGeometry } from './types';

export type RigFigure = 'baseline_mm' | 'distance_mm' | 'camera_focal_px' | 'projector_focal_px';
export type RigDraft = Partial<Record<RigFigure, number>>;
type Sixteen = Parameters<THREE.Matrix4['set']>;

const rows = (matrix: THREE.Matrix4): number[] => matrix.clone().transpose().toArray();
const focused = <T extends { focal_px: [number, number] }>(optics: T, focal: number): T => ({
  ...optics,
  focal_px: [focal, (focal * optics.focal_px[1]) / optics.focal_px[0]],
});

/** The rig as the sliders stand, before the server has moved it; as arrange_rig does. */
export function arranged(rig: RigGeometry, draft: RigDraft): RigGeometry {
  const next: RigGeometry = { ...rig };
  if (draft.camera_focal_px) next.camera = focused(rig.camera, draft.camera_focal_px);
  if (draft.projector_focal_px && rig.projector) next.projector = focused(rig.projector, draft.projector_focal_px);
  if (!rig.turntable || (!draft.baseline_mm && !draft.distance_mm)) return next;
  const rigFromObject = new THREE.Matrix4().set(...(rig.turntable.object_from_rig as Sixteen)).invert();
  const before = new THREE.Vector3().setFromMatrixPosition(rigFromObject);
  const target = before.clone();
  if (draft.distance_mm) target.setLength(draft.distance_mm);
  const pose = new THREE.Matrix4().set(...(rig.rig_from_projector as Sixteen));
  const place = new THREE.Vector3().setFromMatrixPosition(pose);
  const moved = place.clone().setLength(draft.baseline_mm ?? rig.baseline_mm);
  const turn = new THREE.Quaternion().setFromUnitVectors(
    before.clone().sub(place).normalize(),
    target.clone().sub(moved).normalize(),
  );
  const rotation = new THREE.Matrix4()
    .extractRotation(pose)
    .premultiply(new THREE.Matrix4().makeRotationFromQuaternion(turn));
  next.rig_from_projector = rows(rotation.setPosition(moved));
  next.baseline_mm = moved.length();
  rigFromObject.setPosition(target);
  next.turntable = { object_from_rig: rows(rigFromObject.invert()), distance_mm: target.length() };
  return next;
}
