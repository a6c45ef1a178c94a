import type { ModifierKeys, PlacingTool, Tool } from './pointer_strokes';
import type { FoundFeature } from './types';
import type { Outline } from './view_camera';

/** A ray through the picture, and the half-space that a section leaves. */
export interface Ray {
  eye: number[];
  direction: number[];
  section?: number[];
  /** The point is one of the reference. */
  reference?: true;
}
/** A face of a CAD reference; without a kind it has a free form. */
export interface PickedFace {
  number: number;
  kind: FoundFeature['kind'] | null;
  diameter_mm: number | null;
}
/** A point of the exact mesh. */
export interface Hit {
  point_mm: [number, number, number];
  triangle: number;
  sigma_mm: number | null;
  /** Of a reference; null where it is a mesh. */
  face?: PickedFace | null;
}

/** Requests and events of the 3D view. */
export interface ViewerEvents {
  /** Asks for the point of the exact mesh on a ray. */
  pick(ray: Ray): Promise<Hit | null>;
  /** A place of the surface to measure from, or to put a plane through. */
  placed(tool: PlacingTool, hit: Hit): void;
  outlined(outline: Outline, through: boolean, keys: ModifierKeys): void;
  /** A triangle of the connected part, or of what is alike, that is to be selected. */
  trianglePicked(tool: 'part' | 'like', triangle: number, keys: ModifierKeys): void;
  /** A point of the surface, or three of them for an alignment. */
  picked(tool: Tool, points: [number, number, number][], keys: ModifierKeys): void;
}
