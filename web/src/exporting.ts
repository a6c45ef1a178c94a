import type { Store } from './store';
import type { Triple } from './types';

/** Formats of the step Export, in their order. */
export const FORMATS = ['dxf', 'stl', 'ply', 'obj', 'glb', '3mf'] as const;
export type Format = (typeof FORMATS)[number];
export type Variant = 'faces' | 'polyface' | 'mesh';
/** AutoCAD slows down beyond this; `frangia reconstruct` keeps to it as well. */
export const LIMITS = ['200000', '50000', '0'] as const;
export type Limit = (typeof LIMITS)[number];

export type Encoding = 'binary' | 'ascii';
export interface ExportChoice {
  format: Format;
  variant: Variant;
  encoding: Encoding;
  limit: Limit;
}

/** What the commands `export` and `estimate-export` take. */
export const exportArguments = (exporting: ExportChoice): object => ({
  format: exporting.format,
  ...(exporting.format === 'dxf' ? { dxf: exporting.variant } : {}),
  ...(exporting.format === 'stl' ? { stl: exporting.encoding } : {}),
  ...(exporting.limit === '0' ? {} : { triangles: Number(exporting.limit) }),
});

/** A plane that cuts the surface. */
interface Cut {
  point_mm: Triple;
  normal: Triple;
}

/** What the step Export writes and how large it will be. */
export class Exporting {
  choice: ExportChoice = { format: 'dxf', variant: 'faces', encoding: 'binary', limit: '200000' };
  /** Size of the file that would be written; null while it is not known. */
  estimate: { triangles: number; bytes: number } | null = null;
  private estimated = '';

  constructor(private readonly app: Store) {}

  choose(change: Partial<ExportChoice>): void {
    this.choice = { ...this.choice, ...change };
    this.app.requestUpdate();
  }
  /** Asks how large the file would be, when what decides it has changed. */
  async follow(): Promise<void> {
    const { app } = this;
    if (app.session.state) this.fetchWanted();
    const surface = app.session.state?.project?.surface;
    if (app.step !== 'export' || !surface || app.session.watches || surface.triangles === 0) return;
    const wanted = exportArguments(this.choice);
    const key = JSON.stringify([app.project.name, surface.mesh_revision, wanted]);
    if (key === this.estimated) return;
    this.estimated = key;
    this.estimate = null;
    try {
      const estimate = await app.session.command<{ triangles: number; bytes: number }>('estimate-export', wanted);
      if (key === this.estimated) this.estimate = estimate;
    } catch {
      // Without it, the file can still be written, and that says what is wrong.
    }
    app.requestUpdate();
  }

  /** Writes a board on a sheet of paper, and downloads it when it is there. */
  async print(paper: string): Promise<void> {
    try {
      const { job } = await this.app.session.command<{ job: number }>('print-board', { paper });
      this.wanted = { job, name: `board-${paper}.pdf` };
      this.fetchWanted();
    } catch (error) {
      this.app.say(error);
    }
  }
  /** Writes what the section plane cuts, and downloads it when it is there. */
  async section(plane: Cut, format: 'dxf' | 'svg'): Promise<void> {
    try {
      const { job } = await this.app.session.command<{ job: number }>('export-section', { ...plane, format });
      this.wanted = { job, name: `${this.app.project.name} section.${format}` };
      this.fetchWanted();
    } catch (error) {
      this.app.say(error);
    }
  }
  private wanted: { job: number; name: string } | null = null;
  private fetchWanted(): void {
    const job = this.app.state.jobs.find((one) => one.number === this.wanted?.job);
    if (!this.wanted || !job || job.state === 'waiting' || job.state === 'running') return;
    const { name } = this.wanted;
    this.wanted = null;
    if (job.state === 'done') void this.download(name);
  }

  async download(name: string): Promise<void> {
    try {
      await this.app.session.download(name);
    } catch (error) {
      this.app.say(error);
    }
  }
  async pictureFile(): Promise<void> {
    const blob = await this.app.viewer.snapshot();
    if (blob) this.save(blob, `${this.app.project.name}.png`);
  }
  /** Lets the browser save what was made in the page. */
  save(blob: Blob, name: string): void {
    const anchor = document.createElement('a');
    anchor.href = URL.createObjectURL(blob);
    anchor.download = name;
    anchor.click();
    setTimeout(() => URL.revokeObjectURL(anchor.href), 10_000);
  }
}
