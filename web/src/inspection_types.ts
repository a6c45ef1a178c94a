/** Deviations of the surface from a reference; shares are of the compared area. */
export interface Comparison {
  revision: number;
  reference: string;
  reference_triangles: number;
  best_fit: boolean;
  /** Of `poses`, from 1. */
  start: number;
  /** Poses that fit alike, the best first. */
  poses: { turned_deg: number; moved_mm: number; overlap: number; rms_mm: number | null }[];
  tolerance_mm: [number, number];
  scale_mm: [number, number];
  histogram: number[];
  verdict: 'in' | 'out' | 'undecided';
  /** Shares of the nominal area; they sum to 1. */
  in_share: number;
  out_share: number;
  undecided_share: number;
  not_measured_share: number;
  /** Diameter of the patches over which deviations are averaged. */
  patch_mm: number;
  rms_mm: number | null;
  mean_mm: number | null;
  min_mm: number | null;
  max_mm: number | null;
  median_u_mm: number | null;
  area_mm2: number;
  overlap: number;
  fit_rms_mm: number | null;
  turned_deg: number;
  moved_mm: number;
  left_out: number;
  free_directions: string[];
}
/** A row of the table of results. */
export interface MeasuredRow {
  name: string;
  kind: string;
  feature: string;
  datum: string;
  unit: 'mm' | 'degrees';
  nominal: number | null;
  /** Of the value; null: none on that side. */
  limits: [number | null, number | null] | null;
  value: number | null;
  u95: number | null;
  /** Share of the tolerance that is used; above 1 beyond it. */
  used: number | null;
  verdict: 'in' | 'out' | 'undecided' | null;
}
/** A feature of the surface. `at_mm` and `axis` are in its frame, `near_mm` in that of the reference. */
export interface FoundFeature {
  /** In the plan; null: it is not in the plan. */
  name: string | null;
  kind: 'plane' | 'line' | 'circle' | 'cylinder' | 'sphere' | 'cone' | 'torus';
  hole: boolean;
  diameter_mm: number | null;
  u95_mm: number | null;
  form_mm: number | null;
  near_mm: [number, number, number];
  at_mm: [number, number, number];
  axis: [number, number, number];
  half_angle_deg: number | null;
  /** Of the CAD reference. */
  face: number | null;
  nominal_mm: number | null;
}
/** A part of the sentence about a verdict. `text` is English; other languages word it by `id` and `values`. */
export interface VerdictClause {
  id: string;
  values: Record<string, number | string | [number, number, number] | null>;
  text: string;
}
/** What an inspection found. Places are in the frame of the surface. */
export interface Inspection {
  revision: number;
  verdict: 'in' | 'out' | 'undecided';
  /** Why the verdict is what it is, what decided first. Places in them are in the frame of the reference. */
  reasons: { about: 'surface' | 'characteristics'; sentence: string; clauses: VerdictClause[] }[];
  searched: boolean;
  characteristics: MeasuredRow[];
  features: FoundFeature[];
  places: {
    decision: 'out' | 'near_limit' | 'not_well_measured' | 'not_measured';
    at_mm: [number, number, number];
    deviation_mm: number | null;
    u95_mm: number | null;
    area_mm2: number;
    missing: boolean;
  }[];
  thickness_mm: [number | null, number | null, number | null] | null;
}
/** What was found of a characteristic of an earlier part. */
export type SeriesRow = Pick<MeasuredRow, 'name' | 'unit' | 'nominal' | 'limits' | 'value' | 'u95' | 'verdict'>;
/** A part that was inspected by the same plan, in a project of its own. */
export interface SeriesPart {
  name: string;
  serial: string;
  /** Null: it was not inspected. */
  verdict: Inspection['verdict'] | null;
  rows: SeriesRow[];
}
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
  kind?: FoundFeature['kind'];
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
  report?: Partial<Record<'drawing' | 'order' | 'serial' | 'customer' | 'operator' | 'date' | 'paper', string>>;
}
/** An acceptance test of the scanner: the artifact, its limits, and the errors of all arrangements. */
export interface Acceptance {
  artifact: {
    diameters_mm: number[];
    spacing_mm: number | null;
    u95_mm: number;
    form_mm: number;
    expansion_ppm_per_k: number;
    certificate: string;
  };
  limits: Record<'probing_form_mm' | 'probing_size_mm' | 'sphere_spacing_mm' | 'length_mm', number | null>;
  volume_mm: [number, number, number] | null;
  temperature_c: number;
  temperature_u_k: number;
  operator: string;
  /** Each was measured in a project of the series. */
  arrangements: { name: string; project: string; warnings: string[] }[];
  /** The worst of all arrangements; none before the first is measured. */
  quantities: {
    symbol: 'P_Form.Sph.D95%' | 'PF' | 'P_Size.Sph.All' | 'SD' | 'E';
    error_mm: number;
    u95_mm: number;
    limit_mm: number | null;
    verdict: 'in' | 'out' | 'undecided' | null;
    /** Index of the arrangement with this error. */
    arrangement: number;
  }[];
  verdict: 'in' | 'out' | 'undecided' | null;
  /** What a test after VDI/VDE 2634 part 3 also needs. */
  incomplete: string[];
}
