import type { Acceptance, Comparison, Inspection, Plan, SeriesPart } from './inspection_types';
import type { HandMeasurement } from './measure_types';

/** The state that the server sends; docs/service-schema.json describes it. */
export type JobState = 'waiting' | 'running' | 'done' | 'failed' | 'stopped';
export interface LogLine {
  warning: boolean;
  sentence: string;
}
export interface Job {
  number: number;
  kind:
    | 'open'
    | 'live'
    | 'find'
    | 'identify'
    | 'devices'
    | 'exposure'
    | 'calibrate'
    | 'axis'
    | 'scan'
    | 'reconstruct'
    | 'edit'
    | 'preview'
    | 'measure'
    | 'reference'
    | 'inspect'
    | 'report'
    | 'export'
    | 'copy'
    | 'rig'
    | 'display';
  state: JobState;
  progress: number;
  stage: string;
  error: string;
  seconds: number;
  /** That the job made or wrote out. */
  revision: number | null;
  log: LogLine[];
}
export type StationState = 'waiting' | 'capturing' | 'done' | 'skipped';
export interface Station {
  angle_deg: number;
  setup: number;
  state: StationState;
  verdict: string;
  good: boolean;
  contrast: number;
  saturated: number;
  points: number;
  has_cloud: boolean;
}
export interface Hole {
  number: number;
  size_mm: number;
  length_mm: number;
  center_mm: [number, number, number];
}
/** What a step did; counts are those after it less those before. */
export interface Change {
  triangles: number;
  holes: number;
  components: number;
  moved: number;
  selected: number;
}
export interface Step {
  operation: string;
  value: string;
  change: Change;
}
export interface Summary {
  points: number;
  views: number;
  registration?: string;
  rms_before_mm?: number;
  rms_after_mm?: number;
  /** What became of the turntable; `plain` where these figures say all that `registration` does. */
  turntable?: {
    plain: boolean;
    kept: boolean;
    overlap: number;
    moved_mm: number;
    turned_deg: number;
    angles_deg: number;
    closure_deg: number | null;
  };
  untrusted_reason: string;
  /** What the reconstruction warned of; missing for a surface of an older program. */
  warnings?: string[];
  views_of_scan?: number;
  /** How the setups join; missing or empty for a scan of one. */
  setups?: SetupJoin[];
}
export interface SetupJoin {
  number: number;
  views: number;
  joined: boolean;
  ambiguous: boolean;
  turned_deg: number;
  moved_mm: number;
  overlap: number | null;
  violation: number | null;
}
/** A shape that was fitted to selected triangles. */
export interface Fit {
  kind: 'plane' | 'cylinder' | 'sphere';
  center_mm: Triple;
  axis: Triple;
  diameter_mm: number | null;
  u95_mm: number | null;
  rms_mm: number;
  form_mm: number;
  points: number;
}
export type Triple = [number, number, number];
export interface Optics {
  width_px: number;
  height_px: number;
  focal_px: [number, number];
  principal_point_px: [number, number];
}
/** Poses are 4 x 4, row by row; all in mm in the frame of the camera. */
export interface RigGeometry {
  camera: Optics;
  projector: Optics | null;
  field_deg: [number, number] | null;
  rig_from_projector: number[];
  baseline_mm: number;
  laser_sheet: { normal: Triple; offset_mm: number } | null;
  turntable: { object_from_rig: number[]; distance_mm: number } | null;
  calibration: { date: string; poses: number; point_sigma_mm: number; distance_mm: number } | null;
}
/** The tables of rig.toml that hold devices. */
export const TABLES = ['camera', 'fringes', 'turntable', 'light', 'line'] as const;
export type Table = (typeof TABLES)[number];
/** A device of the rig; `settings` are the lines of its table in rig.toml. */
export interface Device {
  table: string;
  driver: string;
  settings: string;
  name: string;
  answer: string;
  fault: string;
}
/** A device that was found; `modes` are the ways in which it says that it can work, with the lines that choose them. */
export interface ConnectedDevice {
  table: Table;
  driver: string;
  name: string;
  settings: string;
  modes: { name: string; settings: string }[];
}
export interface DeviceDriver {
  table: Table;
  driver: string;
  description: string;
  /** Whether its devices can show a number. */
  identifies: boolean;
  /** Values of settings that have few, the default first. */
  choices: Record<string, string[]>;
}
/** What a search for devices found, and the drivers of the program. */
export interface DeviceSearch {
  connected: ConnectedDevice[];
  drivers: DeviceDriver[];
  warnings: string[];
}
/** The residuals of a calibration; arrows are x, y and the residual in x and y, px. */
export interface Residuals {
  poses: {
    name: string;
    camera_rms_px: number;
    projector_rms_px: number;
    distance_mm: number;
    tilt_deg: number;
    change_mm: number;
    outlier: boolean;
  }[];
  maps: {
    title: string;
    width: number;
    height: number;
    rms_px: number;
    points: number;
    arrows: [number, number, number, number][];
  }[];
}
export interface CaptureSettings {
  exposure_ms: number;
  exposures_ms: number[];
  gain_db: number;
  black_level_counts: number;
  shifts: number;
  algorithm: string;
}
export type LivePattern = 'fringes' | 'white' | 'dark';
export interface Verdict {
  grade: string;
  point_sigma_mm: number;
  spread_mm: number;
  distance_mm: number;
  baseline_mm: number;
  camera_rms_px: number;
  projector_rms_px: number;
  poses: number;
}
export interface Axis {
  views: number;
  axis_sigma_deg: number;
  point_sigma_mm: number;
  angles_rms_deg: number;
  distance_mm: number;
}
export interface Calibration {
  active: boolean;
  waiting: boolean;
  /** It waits for a printed board that says by its markers which it is. */
  naming: boolean;
  /** Null until it is known. */
  board: { columns: number; rows: number; square_mm: number } | null;
  found: number;
  wanted: number;
  with_board: number;
  field: number;
  cells: boolean[];
  columns: number;
  distance_ratio: number;
  tilts_deg: [number, number, number, number];
  sufficient: boolean;
  next: { kind: string; side: string; place: string; text: string };
  findings: string[];
  fault: string;
  poses: { points: number; expected: number }[];
  verdict: Verdict | null;
}
export interface Preview extends Step {
  revision: number;
}
/** A surface that was built; `previous` was shown then, 0 for none. */
export interface Version {
  number: number;
  previous: number;
  built_s: number;
  steps: number;
  steps_done: number;
}
export interface Surface {
  /** Its number among the versions. */
  version: number;
  /** Names the mesh, also after a restart. */
  mesh: string;
  /** Levels of detail, the coarsest first. */
  levels: { triangles: number; error_mm: number }[];
  comparison: Comparison | null;
  inspection: Inspection | null;
  preview: Preview | null;
  mesh_revision: number;
  selection_revision: number;
  vertices: number;
  triangles: number;
  selected: number;
  components: number;
  sigma_mm: { combined: number | null; noise: number | null; systematic: number | null };
  hole_count: number;
  holes: Hole[];
  steps: Step[];
  steps_done: number;
  fits: Fit[];
  summary: Summary | null;
}
/** What a list shows of a rig. */
export interface RigFigures {
  date: string;
  poses: number;
  point_sigma_mm: number | null;
  has_turntable: boolean;
  has_axis: boolean;
  drivers: string[];
}
/** A rig that the project had before a change. */
export interface KeptRig extends RigFigures {
  number: number;
  kept_s: number;
  before: 'geometry' | 'devices' | 'display' | 'calibration' | 'axis' | 'restored';
}
/** A rig that is kept for any project. */
export interface LibraryRig extends RigFigures {
  name: string;
  kept_s: number;
}
/** Light and focus before a scan, measured in one view. */
export interface ScanCheck {
  at_s: number;
  contrast: number;
  saturated: number;
  points: number;
  finding: string;
}
/** What flashes, ramps and fringes showed of display and camera. */
export interface DisplayFigures {
  exposure_ms: number;
  latency_s: number;
  delay_s: number;
  /** Frames that come late, whatever the delay. */
  late_frames: number;
  camera_fps: number;
  patterns_per_s: number;
  /** Mains whose lamps flicker; 0 for steady light. */
  mains_hz: number;
  /** Amplitude, over the light of the display. */
  room_flicker: number;
  /** Exposures of whole multiples see even light; 0: any do. */
  exposure_step_ms: number;
  /** Share of full light at half of full drive; null where the light of the room hides it. */
  half_light: number | null;
  /** Contrast of fringes of 12 px over that of coarse ones. */
  sharpness: number;
  white_level: number;
  dark_zeros: number;
  findings: string[];
}
export interface Project {
  name: string;
  can_scan: boolean;
  scan_begun: boolean;
  scan_complete: boolean;
  capture: CaptureSettings;
  rig: RigGeometry | null;
  rig_fault: string;
  rig_begun: boolean;
  /** Its parts can be moved by hand: they are simulated, and nothing was measured of them. */
  rig_adjustable: boolean;
  /** The newest first. */
  kept_rigs: KeptRig[];
  check: ScanCheck | null;
  /** Since it was measured. */
  display: DisplayFigures | null;
  residuals_s: number;
  devices: Device[];
  live: { pattern: LivePattern; table_deg: number } | null;
  calibration: Calibration | null;
  /** Of the turntable, since it was searched for. */
  axis: Axis | null;
  table_angle: { last_deg: number | null } | null;
  stations: Station[];
  /** A coarse surface of some stations, while the scan runs and until it is built. */
  grown: { views: number[]; triangles: number; revision: number } | null;
  /** The surface exists, and is being read. */
  surface_loading: boolean;
  surface: Surface | null;
  /** Of the surface, its edits and versions; each change makes the next one. */
  revision: number;
  versions: Version[];
  /** Number of the version that is shown; 0 for none. */
  current_version: number;
  /** Of which version and revision an exported surface is. */
  exports: ExportedFile[];
  /** `shown`: it was read, and can be drawn and picked. */
  reference: { name: string; format: string; shown: boolean } | null;
  measurements: HandMeasurement[];
  /** Parts before this one that were inspected by the same plan, the oldest first. */
  series: SeriesPart[];
  acceptance: Acceptance | null;
  /** That the surface is inspected by; null: none was made. */
  plan: Plan | null;
  plan_fault: string;
  commands: { rig?: string[]; scan?: string[]; reconstruct?: string[]; edit?: string[]; inspect?: string[] };
}
export interface ExportedFile {
  name: string;
  bytes: number;
  version: number | null;
  revision: number | null;
}
export interface ProjectEntry {
  name: string;
  modified_s: number;
  scanned: boolean;
  has_surface: boolean;
  /** When its picture was written; 0: there is none. */
  thumbnail_s: number;
  notes: string;
}
export interface State {
  version: string;
  parts: string[];
  algorithms: { name: string; frames: string }[];
  examples: { name: string; description: string }[];
  search: DeviceSearch | null;
  projects: ProjectEntry[];
  /** Names of the projects in the bin. */
  discarded: string[];
  rigs: LibraryRig[];
  project: Project | null;
  jobs: Job[];
}
