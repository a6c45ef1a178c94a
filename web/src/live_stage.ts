import type { Store } from './store';
import { LiveView } from './live_view';
import { type Ends, type Legend, scaleOfHeights } from './mesh_colors';
import type { Layer } from './session';

/** What the live preview can show, in the order of the choice. */
export const LAYERS = [
  'camera',
  'phase',
  'modulation',
  'status',
  'depth',
  'points',
] as const satisfies readonly Layer[];
export type LiveLayer = (typeof LAYERS)[number];

/** The live preview on the stage: its layer, and what the server is asked to send. */
export class LiveStage {
  layer: LiveLayer = 'camera';
  readonly view = new LiveView();
  /** When the last picture came, ms. */
  private drawnAt = 0;

  /** The heights of the points, mm above the table, as the picture is coloured; null without points. */
  heights: Legend | null = null;
  /** The ends that were chosen for them. */
  ownEnds: Ends | null = null;

  /** The largest contrast of fringes since the focus is turned. */
  peak = 0;
  /** Whether the preview is to begin as soon as nothing else runs. */
  private wanted = false;

  constructor(private readonly app: Store) {
    const { canvas } = this.view;
    canvas.addEventListener('click', (event) =>
      this.toggleLoupe(event.offsetX / canvas.clientWidth, event.offsetY / canvas.clientHeight),
    );
    setInterval(() => this.watch(), 500);
  }

  /** Seconds since the last picture where a newer one is overdue; null while it is fresh, or without any. */
  get frozen_s(): number | null {
    const { figures } = this.view;
    if (!figures) return null;
    const age = (Date.now() - this.drawnAt) / 1000;
    const due = Math.max(2.5, 4 / Math.max(0.1, figures.frames_per_s));
    return age > due || !this.app.state.project?.live ? age : null;
  }
  private wasFrozen = false;
  /** Nothing else comes from the server while the picture stands still. */
  private watch(): void {
    if (this.app.step !== 'live' || !this.app.session.state) return;
    const frozen = this.frozen_s !== null;
    if (frozen || this.wasFrozen) this.app.requestUpdate();
    this.wasFrozen = frozen;
  }

  setLayer(layer: LiveLayer): void {
    this.layer = layer;
    this.follow();
    this.app.requestUpdate();
  }
  toggleLoupe(x = 0.5, y = 0.5): void {
    this.view.toggleLoupe(x, y);
    this.app.requestUpdate();
  }
  forgetPeak(): void {
    this.peak = this.view.figures?.contrast ?? 0;
    this.app.requestUpdate();
  }
  setMarks(marks: boolean): void {
    this.view.setMarks(marks);
    this.app.requestUpdate();
  }
  /** Asks for what is looked at, and for nothing else. */
  follow(): void {
    const { app } = this;
    const project = app.session.state?.project;
    this.startWanted();
    if (app.step === 'live' && project?.live) app.session.show(this.layer);
    else if (app.step === 'rig' && project?.calibration?.active) app.session.show('camera');
    else app.session.show('none');
  }
  draw(picture: ArrayBuffer): void {
    this.drawnAt = Date.now();
    if (this.view.draw(picture)) this.drawPoints();
    this.peak = Math.max(this.peak, this.view.figures?.contrast ?? 0);
    this.app.requestUpdate();
  }
  private drawPoints(): void {
    const { positions } = this.view;
    if (!positions) return;
    this.heights = scaleOfHeights(positions, this.ownEnds);
    this.app.viewer.setCloud(-1, positions.slice(), [this.heights.low, this.heights.high]);
  }
  setEnds(ends: Ends | null): void {
    this.ownEnds = ends;
    this.drawPoints();
    this.app.requestUpdate();
  }
  /** The preview begins with the step Live, as soon as nothing else runs. */
  private startWanted(): void {
    const { app } = this;
    const project = app.session.state?.project;
    if (!this.wanted || !project?.can_scan || app.session.watches) return;
    if (!project.live && app.busy) return;
    this.wanted = false;
    if (!project.live) void app.command('start-live');
  }
  /** The preview begins with the step; what was seen before, such as a board, is no picture of it. */
  entered(): void {
    if (!this.app.state.project?.live) this.view.clear();
    this.peak = 0;
    this.wanted = true;
  }
  /** It ends when another step is opened. */
  left(next: string): void {
    const { app } = this;
    this.wanted = false;
    const live = app.session.state ? app.job('live') : undefined;
    if (next === 'live' || !live || app.session.watches) return;
    void app.session.command('stop-job', { job: live.number }).catch(() => undefined); // it has ended by itself
    this.view.clear();
  }
}
