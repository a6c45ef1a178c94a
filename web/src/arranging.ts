import type { Store } from './store';
import { arranged, type RigDraft } from './arrange';
import { type Residuals, type RigGeometry, type Table, TABLES } from './types';

/** A board that was printed here names itself by its markers; another one is described. */
export type BoardKind = 'printed' | 'own';
/** What stands on the turntable while its axis is looked for. */
export type AxisBy = 'board' | 'part';
/** The settings of each table as they stand in the form: lines of rig.toml, empty for no device. */
export type DeviceDraft = Record<Table, string>;
/** The stages of the step Rig. */
export type StageName = 'devices' | 'display' | 'calibration' | 'axis';

/** The driver that the lines of a table name; empty without one. */
export const driverOf = (lines: string): string => /^\s*driver\s*=\s*"([^"]*)"/m.exec(lines)?.[1] ?? '';

/** What the step Rig changes: the geometry, the devices, and which residuals are on the stage. */
export class Arranging {
  deviceDraft: DeviceDraft | null = null;
  boardKind: BoardKind = 'printed';
  axisBy: AxisBy = 'board';
  residuals: Residuals | null = null;
  /** Index of the map on the stage; -1 shows the rig. */
  residualMap = -1;
  private residualsShown = 0;
  private draft: RigDraft = {};
  /** The job that gives the rig the devices of the draft. */
  private using = 0;

  /** Stages that were opened or closed by hand, until another one is the next. */
  private byHand = { next: '', open: new Map<StageName, boolean>() };

  constructor(private readonly app: Store) {}

  isOpen(stage: StageName, next: StageName): boolean {
    if (this.byHand.next !== next) this.byHand = { next, open: new Map() };
    return this.byHand.open.get(stage) ?? stage === next;
  }
  toggle(stage: StageName, next: StageName): void {
    this.byHand.open.set(stage, !this.isOpen(stage, next));
    this.app.requestUpdate();
  }
  /** The stage whose result is the newest, which stays open when nothing else is wanted. */
  get newest(): StageName | undefined {
    const { axis, calibration, display } = this.app.project;
    return axis ? 'axis' : calibration ? 'calibration' : display ? 'display' : undefined;
  }

  /** The rig as the sliders stand. */
  get drawnRig(): RigGeometry | null {
    const rig = this.app.state.project?.rig ?? null;
    return rig && arranged(rig, this.draft);
  }
  draftRig(draft: RigDraft): void {
    this.draft = draft;
    this.app.viewer.setRig(this.drawnRig);
    this.app.requestUpdate();
  }
  async moveRig(draft: RigDraft): Promise<void> {
    if (!(await this.app.command('set-rig', draft))) this.app.viewer.setRig(this.app.project.rig);
    this.draft = {};
    this.app.requestUpdate();
  }
  setBoardKind(kind: BoardKind): void {
    this.boardKind = kind;
    this.app.requestUpdate();
  }
  setAxisBy(by: AxisBy): void {
    this.axisBy = by;
    this.app.requestUpdate();
  }
  draftDevices(draft: DeviceDraft | null): void {
    this.deviceDraft = draft;
    this.app.requestUpdate();
  }
  async useDevices(devices: Partial<DeviceDraft>): Promise<void> {
    try {
      this.using = (await this.app.session.command<{ job: number }>('set-devices', { devices })).job;
      this.app.dismiss();
    } catch (error) {
      this.app.say(error);
    }
  }
  /** Ends the draft when its devices are those of the rig: a failure keeps it. */
  private followDevices(): void {
    const job = this.app.state.jobs.find(({ number }) => number === this.using);
    if (!job || job.state === 'waiting' || job.state === 'running') return;
    this.using = 0;
    const { deviceDraft: draft } = this;
    const driver = (of: Table) => this.app.state.project?.devices.find(({ table }) => table === of)?.driver ?? '';
    const taken = draft !== null && TABLES.every((table) => driverOf(draft[table]) === driver(table));
    if (job.state === 'done' || taken) this.draftDevices(null);
  }

  showResiduals(map: number): void {
    this.residualMap = map;
    this.app.requestUpdate();
  }
  /** Reads the residuals of the project's calibration when they have changed. */
  async follow(): Promise<void> {
    const { app } = this;
    this.followDevices();
    const at = app.state.project?.residuals_s ?? 0;
    if (at === this.residualsShown) return;
    this.residualsShown = at;
    this.residuals = null;
    this.residualMap = -1;
    if (at === 0) return;
    try {
      this.residuals = JSON.parse(new TextDecoder().decode(await app.session.bytes('/api/residuals'))) as Residuals;
      app.requestUpdate();
    } catch (error) {
      app.say(error);
    }
  }
}
