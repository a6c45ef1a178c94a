/** A ray through the picture, and the half-space that a section leaves. */
export interface Ray {
  eye: number[];
  direction: number[];
  section?: number[];
  /** The point is one of the reference. */
  reference?: true;
}
/** A point of the exact mesh. */
export interface Hit {
  point_mm: [number, number, number];
  triangle: number;
  sigma_mm: number | null;
}
