/** The state that the server sends; docs/service-schema.json describes it. */
export type JobState = 'waiting' | 'running' | 'done' | 'failed' | 'stopped';
export interface LogLine { warning: boolean; sentence: string }
export interface Job {
  number: number;
  kind: 'open' | 'scan' | 'reconstruct' | 'edit' | 'export';
  state: JobState;
  progress: number;
  stage: string;
  error: string;
  seconds: number;
  log: LogLine[];
}
export type StationState = 'waiting' | 'capturing' | 'done' | 'skipped';
export interface Station {
  angle_deg: number;
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
export interface Step { operation: string; value: string }
export interface Summary {
  points: number;
  views: number;
  registration?: string;
  rms_before_mm?: number;
  rms_after_mm?: number;
  untrusted_reason: string;
}
export interface Surface {
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
  summary: Summary | null;
}
export interface Project {
  name: string;
  can_scan: boolean;
  scan_complete: boolean;
  stations: Station[];
  surface: Surface | null;
  exports: { name: string; bytes: number }[];
  commands: { scan?: string[]; reconstruct?: string[]; edit?: string[] };
}
export interface ProjectEntry {
  name: string;
  modified_s: number;
  scanned: boolean;
  has_surface: boolean;
}
export interface State {
  version: string;
  parts: string[];
  projects: ProjectEntry[];
  project: Project | null;
  jobs: Job[];
}
