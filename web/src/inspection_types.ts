import type { Inspection } from './schema';

// The keys of inspection.toml.

export type CharacteristicKind =
  | 'distance'
  | 'angle'
  | 'flatness'
  | 'roundness'
  | 'cylindricity'
  | 'position'
  | 'parallelism'
  | 'perpendicularity'
  | 'run-out'
  | 'total-run-out'
  | 'surface-profile'
  | 'line-profile'
  | 'thickness';
export interface PlannedFeature {
  name: string;
  kind?: Inspection['features'][number]['kind'];
  near_mm?: [number, number, number];
  face?: number;
  diameter_mm?: number | null;
  tolerance_mm?: [number, number] | null;
}
export interface PlannedCharacteristic {
  name: string;
  kind: CharacteristicKind;
  /** None: a line profile, and a surface profile or a thickness of the whole part. */
  feature?: string;
  /** Of a line profile. */
  section?: string;
  datum?: string;
  position_mm?: [number, number, number] | null;
  nominal?: number;
  tolerance?: [number, number];
  limit?: number;
}
/** The keys of inspection.toml that the page edits; it keeps all others. */
export interface Plan {
  format: string;
  version: number;
  part?: string;
  align?: 'best-fit' | 'datum' | 'points' | 'none';
  /** The same places on the surface and on its reference. */
  points?: { scan_mm: [number, number, number]; reference_mm: [number, number, number] }[];
  datums?: string[];
  start?: number;
  tolerance_mm?: [number, number];
  /** How the surface is judged; 0 or null: by the usual rule. */
  min_feature_mm?: number | null;
  edge_mm?: number | null;
  min_coverage?: number;
  max_gap_mm?: number | null;
  thickness?: boolean;
  features?: PlannedFeature[];
  characteristics?: PlannedCharacteristic[];
  report?: Partial<Record<'drawing' | 'order' | 'serial' | 'customer' | 'operator' | 'date' | 'paper', string>> & {
    pages?: string[];
  };
}
