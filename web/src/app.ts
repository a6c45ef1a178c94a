import { html, LitElement, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';

import { ON_SURFACE, type StepName } from './app_steps';
import { Arranging } from './arranging';
import { Asking } from './ask';
import { Editing } from './editing';
import { Exporting } from './exporting';
import { dialogs, footer, header, picture } from './frame_parts';
import { Inspecting } from './inspecting';
import { onKey } from './keyboard';
import type { Sharing } from './link_dialog';
import { LiveStage } from './live_stage';
import type { Coloring } from './mesh_colors';
import { Measuring } from './measuring';
import { MeshSource } from './mesh_source';
import { type Language, setLanguage, t } from './messages';
import { applyPreferences } from './preferences';
import { Opening } from './opening';
import { Pairing } from './pairing';
import { Projects } from './projects';
import { CONFLICT, Refusal, Session } from './session';
import { Sectioning } from './sectioning';
import { Setups } from './setups';
import { acts, blankPage, notices } from './shell';
import { StationClouds } from './station_clouds';
import { editStep } from './steps/edit';
import { exportStep } from './steps/export';
import { inspectStep } from './steps/inspect';
import { liveStep } from './steps/live';
import { projectStep } from './steps/project';
import { rigStep } from './steps/rig';
import { scanStep } from './steps/scan';
import { surfaceStep } from './steps/surface';
import type { Job, Project, State } from './types';
import { type Hit, type Ray, type SectionLook, type Shading, type Tool, Viewer } from './viewer';

interface Look extends SectionLook {
  shading: Shading;
  coloring: Coloring;
}

const PANELS: Record<Exclude<StepName, 'project'>, (app: App) => TemplateResult> = {
  rig: rigStep,
  live: liveStep,
  scan: scanStep,
  surface: surfaceStep,
  edit: editStep,
  inspect: inspectStep,
  export: exportStep,
};

/** Steps whose panels do nothing but act. */
const ACTING: ReadonlySet<StepName> = new Set(['rig', 'live', 'scan', 'edit']);

/** The window: steps, picture, panel, and the line at the bottom. What each step does is in a part of its own. */
@customElement('frangia-app')
export class App extends LitElement {
  step: StepName = 'project';
  look: Look = { shading: 'smooth', coloring: 'plain', axis: 'off', normal: null, at: null, flipped: false };
  readonly session = new Session(
    () => this.onState(),
    (picture) => this.live.draw(picture),
  );
  readonly asking = new Asking(this);
  readonly projects = new Projects(this);
  readonly opening = new Opening(this);
  readonly arranging = new Arranging(this);
  readonly live = new LiveStage(this);
  readonly setups = new Setups(this);
  readonly inspecting = new Inspecting(this);
  readonly editing = new Editing(this);
  readonly exporting = new Exporting(this);
  readonly measuring = new Measuring(this);
  readonly sectioning = new Sectioning(this);
  readonly pairing = new Pairing(this);
  readonly host = document.createElement('div');
  viewer!: Viewer;
  meshes!: MeshSource;
  private clouds!: StationClouds;
  problem = '';
  /** Whether `problem` is that another browser operates. */
  refused = false;
  copied = false;
  sharing: Sharing = { link: '', lan: null };
  private seenFailure = 0;
  private projectShown = '';
  private wantSurface = false;
  /** What the panel shows; it begins at its top when this changes. */
  private panelKey = '';

  protected override createRenderRoot(): HTMLElement {
    return this;
  }

  override connectedCallback(): void {
    super.connectedCallback();
    applyPreferences();
    this.host.className = 'view';
    this.viewer = new Viewer(this.host, {
      pick: (ray) => this.pick(ray),
      placed: (tool, hit) =>
        void { measure: this.measuring, section: this.sectioning, pair: this.pairing }[tool].picked(hit),
      outlined: (outline, through, keys) =>
        void this.editing.selectBy(through ? 'select-outline-through' : 'select-outline', outline, keys),
      partPicked: (triangle, keys) => void this.editing.selectPart(triangle, keys),
      picked: (tool, points, keys) => {
        const [at] = points;
        if (tool === 'feature' && at) this.inspecting.picked(at);
        else void this.editing.picked(tool, points, keys);
      },
    });
    this.clouds = new StationClouds(
      this.session,
      this.viewer,
      () => this.chooseClouds(),
      (error) => this.say(error),
    );
    this.meshes = new MeshSource(
      this.session,
      this.viewer,
      () => this.requestUpdate(),
      (error) => this.say(error),
    );
    addEventListener('keydown', (event) => onKey(this, event));
    void this.session.begin();
  }

  get state(): State {
    return this.session.state as State;
  }
  get project(): Project {
    return this.state.project as Project;
  }
  /** The job of a kind that waits or runs. */
  job(kind: Job['kind']): Job | undefined {
    return this.state.jobs.find((job) => job.kind === kind && (job.state === 'running' || job.state === 'waiting'));
  }
  get busy(): boolean {
    return this.state.jobs.some((job) => job.state === 'running' || job.state === 'waiting');
  }
  /** Whether a job runs other than the live preview, which gives way. */
  get occupied(): boolean {
    return this.state.jobs.some((job) => job.kind !== 'live' && (job.state === 'running' || job.state === 'waiting'));
  }
  /** Whether the stage shows the camera instead of the scene. */
  get showsCamera(): boolean {
    if (this.step === 'rig') return Boolean(this.project.calibration?.active);
    return this.step === 'live' && this.live.layer !== 'points';
  }
  get showsResiduals(): boolean {
    return (
      this.step === 'rig' &&
      !this.project.calibration?.active &&
      Boolean(this.arranging.residuals?.maps[this.arranging.residualMap])
    );
  }

  private onState(): void {
    const state = this.session.state;
    if (state) {
      const name = state.project?.name ?? '';
      if (name !== this.projectShown) this.onProject(state);
      const failed = state.jobs.filter((job) => job.state === 'failed').at(-1);
      if (failed && failed.number > this.seenFailure) {
        this.seenFailure = failed.number;
        this.problem = failed.error;
        this.refused = false;
      }
      this.showWantedSurface();
      this.inspecting.follow();
      this.opening.follow();
      this.live.follow();
      if (this.step === 'rig') this.viewer.setRig(this.arranging.drawnRig);
      void this.meshes.follow();
      this.chooseClouds();
      void this.clouds.follow();
      void this.arranging.follow();
    }
    this.requestUpdate();
  }
  private onProject(state: State): void {
    this.projectShown = state.project?.name ?? '';
    this.meshes.forget();
    this.clouds.forget();
    this.seenFailure = Math.max(0, ...state.jobs.filter((job) => job.state === 'failed').map((job) => job.number));
    this.problem = '';
    this.arranging.deviceDraft = null;
    this.setups.forget();
    this.measuring.forget();
    const created = this.projects.takeCreated();
    if (!state.project) this.go('project');
    else if (state.project.surface || state.project.surface_loading || state.project.versions.length > 0)
      this.go('surface');
    else this.go(created || (!state.project.can_scan && !state.project.scan_complete) ? 'rig' : 'scan');
    this.viewer.frame([0.9, -1.1, 0.6]);
  }

  async build(): Promise<void> {
    this.wantSurface = await this.command('reconstruct');
  }
  /** Goes to the surface when it has been built here. */
  private showWantedSurface(): void {
    const surface = this.state.project?.surface;
    if (!this.wantSurface || !surface || this.job('reconstruct')) return;
    this.wantSurface = false;
    this.go('surface');
    if ((surface.summary?.setups ?? []).filter((setup) => setup.joined).length > 1) this.setLook({ coloring: 'setup' });
    else if (this.look.coloring === 'setup') this.setLook({ coloring: 'plain' });
  }
  private async pick(ray: Ray): Promise<Hit | null> {
    try {
      return await this.session.pick(ray);
    } catch (error) {
      this.say(error);
      return null;
    }
  }
  chooseClouds(): void {
    this.clouds.choose(this.step, this.setups.shown);
  }

  go(step: StepName): void {
    const before = this.step;
    this.step = step;
    this.setTool('orbit');
    this.chooseClouds();
    this.viewer.showSurface(ON_SURFACE.has(step));
    this.viewer.setRig(step === 'rig' ? (this.session.state?.project?.rig ?? null) : null);
    if (step === 'rig') this.viewer.frame([0.55, -0.9, 0.5]);
    else if (before === 'rig') this.viewer.frame([0.9, -1.1, 0.6]);
    this.live.stepped(before, step);
    this.requestUpdate();
  }
  async command(name: string, argument: object = {}): Promise<boolean> {
    // A job may fail before the answer that it was started arrives: what it says stays.
    const before = this.problem;
    try {
      await this.session.command(name, argument);
      if (this.problem === before) this.problem = '';
      return true;
    } catch (error) {
      this.say(error);
      return false;
    }
  }
  setTool(tool: Tool): void {
    this.viewer.setTool(tool);
    this.requestUpdate();
  }
  setLook(change: Partial<Look>): void {
    this.look = { ...this.look, ...change };
    const { look, viewer } = this;
    if (change.shading) viewer.setShading(look.shading);
    if (change.coloring) viewer.setColoring(look.coloring);
    if (look.coloring === 'setup') void this.meshes.showSetups();
    viewer.setSection(look);
    this.requestUpdate();
  }
  say(error: unknown): void {
    this.problem = error instanceof Error ? error.message : String(error);
    this.refused = error instanceof Refusal && error.status === CONFLICT;
    this.requestUpdate();
  }
  dismiss(): void {
    this.problem = '';
    this.requestUpdate();
  }
  dialog(id: string): HTMLDialogElement {
    return this.querySelector(`#${id}`) as HTMLDialogElement;
  }
  changeLanguage(language: Language): void {
    setLanguage(language);
    this.requestUpdate();
  }

  protected override updated(): void {
    void this.exporting.follow();
    this.editing.follow();
    this.measuring.follow();
    this.sectioning.follow();
    this.pairing.follow();
    if (this.session.state) this.projects.follow();
    const key = `${this.step} ${this.session.state?.project?.calibration?.active ?? false}`;
    if (key === this.panelKey) return;
    this.panelKey = key;
    const panel = this.querySelector('.panel');
    if (panel) panel.scrollTop = 0;
  }
  protected override render(): TemplateResult {
    if (this.session.link === 'refused' || !this.session.state) return blankPage(this);
    return html`${header(this)}
      <div class="work">
        ${
          this.step === 'project' || !this.state.project
            ? projectStep(this)
            : html`${picture(this)}
                <main class="panel" tabindex=${this.session.watches ? 0 : -1}>
                  <h1 class="sr">${t(`step.${this.step}`)}</h1>
                  ${ACTING.has(this.step) ? acts(this, PANELS[this.step](this)) : PANELS[this.step](this)}
                </main>`
        }
        ${notices(this)}
      </div>
      ${footer(this)}${dialogs(this)} ${this.opening.over ? html`<div class="drop">${t('open.drop')}</div>` : ''}`;
  }
}
