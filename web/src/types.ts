import type { Plan } from './inspection_types';
import type * as sent from './schema';

// The state that the server sends, by docs/service-schema.json. The build writes schema.ts from it; here its parts have names.
export type {
  Calibration,
  Change,
  Comparison,
  Device,
  Fit,
  Hole,
  Inspection,
  Job,
  Lan,
  LivePattern,
  Optics,
  Preview,
  Quantity,
  Residuals,
  RigFigures,
  Section,
  Station,
  Step,
  Surface,
  Triple,
  Verdict,
} from './schema';

export type Project = Omit<sent.Project, 'plan'> & { plan: Plan | null };
export type State = Omit<sent.State, 'project'> & { project: Project | null };
export type LogLine = sent.Job['log'][number];
export type SetupJoin = sent.Setup;
export type Summary = NonNullable<sent.Surface['summary']>;
export type RigGeometry = sent.Rig;
export type Table = sent.Table;
/** The tables of rig.toml that hold devices, in the order in which they are chosen. */
export const TABLES = ['camera', 'fringes', 'turntable', 'light', 'line'] as const satisfies readonly Table[];
export type DeviceSearch = sent.Search;
export type ConnectedDevice = DeviceSearch['connected'][number];
export type DeviceDriver = DeviceSearch['drivers'][number];
export type CaptureSettings = sent.Capture;
export type Axis = NonNullable<sent.Project['axis']>;
export type Version = sent.Project['versions'][number];
export type KeptRig = sent.Project['kept_rigs'][number];
export type LibraryRig = sent.State['rigs'][number];
export type ScanCheck = NonNullable<sent.Project['check']>;
export type DisplayFigures = NonNullable<sent.Project['display']>;
export type ExportedFile = sent.Project['exports'][number];
export type ProjectEntry = sent.State['projects'][number];
export type HandMeasurement = sent.Measurement;
export type MeasuredRow = sent.Inspection['characteristics'][number];
export type FoundFeature = sent.Inspection['features'][number];
export type VerdictClause = sent.Inspection['reasons'][number]['clauses'][number];
export type SeriesPart = sent.Project['series'][number];
/** An acceptance test of the scanner: the artifact, its limits, and the errors of all arrangements. */
export type Acceptance = NonNullable<sent.Project['acceptance']>;
export type SeriesRow = SeriesPart['rows'][number];
