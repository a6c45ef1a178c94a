export type Triple = [number, number, number];
export type Quantity = 'distance' | 'angle' | 'diameter' | 'thickness' | 'area' | 'volume';
/** What was measured by clicking on the surface. */
export interface HandMeasurement {
  label: string;
  /** Names the mesh that it is of. */
  mesh: string;
  quantity: Quantity;
  value: number;
  unit: 'mm' | 'degrees' | 'mm2' | 'mm3';
  /** Half the width of the 95 % interval. */
  u95: number | null;
  elements: {
    kind: 'point' | 'plane' | 'cylinder' | 'sphere' | 'cone' | 'torus' | 'selection' | 'surface';
    point_mm: Triple;
    center_mm: Triple;
    axis: Triple;
    diameter_mm: number | null;
    form_mm: number | null;
  }[];
  /** Ends of its line. */
  from_mm: Triple;
  to_mm: Triple;
}
/** Where a plane cuts the surface: curves u, v, u, v, ... in mm from the origin along u and v. */
export interface Section {
  mesh_revision: number;
  origin_mm: Triple;
  u: Triple;
  v: Triple;
  length_mm: number;
  /** Null where a curve is open. */
  area_mm2: number | null;
  curves: { closed: boolean; points_mm: number[] }[];
}
