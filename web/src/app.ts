// Above 250 lines: the state of the page and its commands are one class, which lit draws.
import { html, LitElement, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';

import type { StepName } from './app_steps';
import { arranged, type RigDraft } from './arrange';
import { dialogs, footer, header, picture } from './frame_parts';
import { onKey } from './keyboard';
import { currentLanguage, setLanguage, t } from './messages';
import { Session } from './session';
import { blankPage, notices } from './shell';
import { StationClouds } from './station_clouds';
import { finished, reachable } from './step_state';
import { editStep, type Combine } from './steps/edit';
import { exportArguments, exportStep, type Exporting } from './steps/export';
import { liveStep, type LiveLayer } from './steps/live';
import { projectStep, type Source } from './steps/project';
import { rigStep } from './steps/rig';
import type { DeviceDraft } from './steps/rig_devices';
import { scanStep } from './steps/scan';
import { presentSetup } from './steps/scan_setups';
import { surfaceStep } from './steps/surface';
import type { Coloring } from './mesh_colors';
import { MeshSource } from './mesh_source';
import type { Measurement } from './ruler';
import type { Job, Project, Residuals, RigGeometry, State } from './types';
import { type Hit, type Ray, type SectionAxis, type Shading, type Tool, Viewer } from './viewer';
import { LiveView } from './live_view';

interface Look { shading: Shading; coloring: Coloring; axis: SectionAxis; share: number; flipped: boolean }

/** The window: steps, picture, panel, and the line at the bottom. */
@customElement('frangia-app')
export class App extends LitElement {
  step: StepName = 'project';
  look: Look = { shading: 'smooth', coloring: 'plain', axis: 'off', share: 0.5, flipped: false };
  combine: Combine = 'replace';
  exporting: Exporting = { format: 'dxf', variant: 'faces', encoding: 'binary', limit: '200000' };
  /** Size of the file that would be written; null while it is not known. */
  estimate: { triangles: number; bytes: number } | null = null;
  private estimated = '';
  align: 'best-fit' | 'none' = 'best-fit';
  /** Share of a reference that has been sent; null while none is. */
  sent: number | null = null;
  /** Holes that were chosen, by number, of the mesh of a revision. */
  private chosen = { revision: -1, holes: new Set<number>() };
  layer: LiveLayer = 'camera';
  private setup: number | null = null;
  /** Whether the page guides through turning the part over. */
  turning = false;
  private previewFocused = -1;
  private rigDraft: RigDraft = {};
  source: Source = 'simulated';
  example = 'lab-piezo';
  deviceDraft: DeviceDraft | null = null;
  residuals: Residuals | null = null;
  /** Index of the map on the stage; -1 shows the rig. */
  residualMap = -1;
  private residualsShown = 0;
  private created = false;
  viewer!: Viewer;
  readonly live = new LiveView();
  readonly session = new Session(() => this.onState(), (picture) => this.onPicture(picture));
  readonly host = document.createElement('div');
  measurement: Measurement | null = null;
  problem = '';
  private seenFailure = 0;
  meshes!: MeshSource;
  private clouds!: StationClouds;
  private projectShown = '';
  private wantSurface = false;
  copied = false;
  link = '';

  protected override createRenderRoot(): HTMLElement {
    return this;
  }

  override connectedCallback(): void {
    super.connectedCallback();
    setLanguage(currentLanguage());
    const theme = localStorage.getItem('frangia-theme') ?? (matchMedia('(prefers-color-scheme: light)').matches ? 'light' : 'dark');
    document.documentElement.dataset.theme = theme;
    this.host.className = 'view';
    this.viewer = new Viewer(this.host, {
      pick: (ray) => this.pick(ray),
      measured: (result) => {
        this.measurement = result;
        this.requestUpdate();
      },
      outlined: (outline, through) => void this.selectBy(through ? 'select-outline-through' : 'select-outline', outline),
      partPicked: (triangle) => void this.selectPart(triangle),
      picked: (tool, points) => void this.onPicked(tool, points),
    });
    this.clouds = new StationClouds(this.session, this.viewer, () => this.chooseClouds(), (error) => this.say(error));
    this.meshes = new MeshSource(this.session, this.viewer, () => this.requestUpdate(), (error) => this.say(error));
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
  /** What the panel shows; it begins at its top when this changes. */
  private panelKey = '';
  protected override updated(): void {
    void this.estimateExport();
    this.focusPreview();
    const key = `${this.step} ${this.session.state?.project?.calibration?.active ?? false}`;
    if (key === this.panelKey) return;
    this.panelKey = key;
    const panel = this.querySelector('.panel');
    if (panel) panel.scrollTop = 0;
  }

  /** Whether the stage shows the camera instead of the scene. */
  get showsCamera(): boolean {
    if (this.step === 'rig') return Boolean(this.project.calibration?.active);
    return this.step === 'live' && this.layer !== 'points';
  }

  get showsResiduals(): boolean {
    return this.step === 'rig' && !this.project.calibration?.active && Boolean(this.residuals?.maps[this.residualMap]);
  }

  private onPicture(picture: ArrayBuffer): void {
    if (this.live.draw(picture) && this.live.positions) this.viewer.setCloud(-1, this.live.positions.slice());
    this.requestUpdate();
  }
  setLayer(layer: LiveLayer): void {
    this.layer = layer;
    this.chooseLayer();
    this.requestUpdate();
  }
  /** What the server sends: nothing unless it is looked at. */
  private chooseLayer(): void {
    const project = this.session.state?.project;
    if (this.step === 'live' && project?.live) this.session.show(this.layer);
    else if (this.step === 'rig' && project?.calibration?.active) this.session.show('camera');
    else this.session.show('none');
  }
  private async onPicked(tool: Tool, points: [number, number, number][]): Promise<void> {
    const text = points.flat().map((value) => String(Math.round(value * 1000) / 1000)).join(',');
    if (tool === 'align') return this.edit('align', text);
    const [at] = points;
    const holes = this.project.surface?.holes ?? [];
    if (!at || holes.length === 0) return;
    const far = ([x, y, z]: readonly number[]) => Math.hypot((x as number) - at[0], (y as number) - at[1], (z as number) - at[2]);
    const nearest = holes.reduce((best, hole) => (far(hole.center_mm) - hole.size_mm / 2 < far(best.center_mm) - best.size_mm / 2 ? hole : best));
    this.chooseHole(nearest.number, true);
    await this.selectBy('select-loop', String(nearest.number));
  }
  async pictureFile(): Promise<void> {
    const blob = await this.viewer.snapshot();
    if (!blob) return;
    const anchor = document.createElement('a');
    anchor.href = URL.createObjectURL(blob);
    anchor.download = `${this.project.name}.png`;
    anchor.click();
    setTimeout(() => URL.revokeObjectURL(anchor.href), 10_000);
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
      }
      const surface = state.project?.surface ?? null;
      if (this.wantSurface && surface && !this.job('reconstruct')) {
        this.wantSurface = false;
        this.go('surface');
        if ((surface.summary?.setups ?? []).filter((setup) => setup.joined).length > 1) this.setLook({ coloring: 'setup' });
        else if (this.look.coloring === 'setup') this.setLook({ coloring: 'plain' });
      }
      this.chooseLayer();
      if (this.step === 'rig') this.viewer.setRig(this.drawnRig);
      void this.meshes.follow();
      this.chooseClouds();
      void this.clouds.follow();
      void this.readResiduals();
    }
    this.requestUpdate();
  }

  private async readResiduals(): Promise<void> {
    const at = this.state.project?.residuals_s ?? 0;
    if (at === this.residualsShown) return;
    this.residualsShown = at;
    this.residuals = null;
    this.residualMap = -1;
    if (at === 0) return;
    try {
      this.residuals = JSON.parse(new TextDecoder().decode(await this.session.bytes('/api/residuals'))) as Residuals;
      this.requestUpdate();
    } catch (error) {
      this.say(error);
    }
  }
  showResiduals(map: number): void {
    this.residualMap = map;
    this.requestUpdate();
  }
  draftDevices(draft: DeviceDraft | null): void {
    this.deviceDraft = draft;
    this.requestUpdate();
  }
  async useDevices(devices: Partial<DeviceDraft>): Promise<void> {
    if (await this.command('set-devices', { devices })) this.draftDevices(null);
  }
  setSource(source: Source): void {
    this.source = source;
    this.requestUpdate();
  }
  setExample(example: string): void {
    this.example = example;
    this.requestUpdate();
  }
  setMarks(marks: boolean): void {
    this.live.setMarks(marks);
    this.requestUpdate();
  }

  /** The rig as the sliders stand. */
  get drawnRig(): RigGeometry | null {
    const rig = this.state.project?.rig ?? null;
    return rig && arranged(rig, this.rigDraft);
  }
  draftRig(draft: RigDraft): void {
    this.rigDraft = draft;
    this.viewer.setRig(this.drawnRig);
    this.requestUpdate();
  }
  async moveRig(draft: RigDraft): Promise<void> {
    if (!(await this.command('set-rig', draft))) this.viewer.setRig(this.project.rig);
    this.rigDraft = {};
    this.requestUpdate();
  }

  private onProject(state: State): void {
    this.projectShown = state.project?.name ?? '';
    this.meshes.forget();
    this.clouds.forget();
    this.seenFailure = Math.max(0, ...state.jobs.filter((job) => job.state === 'failed').map((job) => job.number));
    this.problem = '';
    this.deviceDraft = null;
    this.setup = null;
    this.turning = false;
    if (!state.project) this.go('project');
    else if (state.project.surface) this.go('surface');
    else this.go(this.created || (!state.project.can_scan && !state.project.scan_complete) ? 'rig' : 'scan');
    this.created = false;
    this.viewer.frame([0.9, -1.1, 0.6]);
  }

  private async pick(ray: Ray): Promise<Hit | null> {
    try {
      return await this.session.pick(ray);
    } catch (error) {
      this.say(error);
      return null;
    }
  }

  /** The setup whose stations the step Scan shows. */
  get setupShown(): number {
    return Math.min(this.setup ?? Infinity, presentSetup(this.session.state?.project?.stations ?? []));
  }
  showSetup(setup: number | null): void {
    this.setup = setup;
    this.chooseClouds();
    this.requestUpdate();
  }
  turn(turning: boolean): void {
    this.turning = turning;
    this.requestUpdate();
  }
  async scanNextSetup(): Promise<void> {
    const setup = presentSetup(this.project.stations) + 1;
    if (!(await this.command('start-scan', { setup }))) return;
    this.turn(false);
    this.showSetup(null);
  }
  private chooseClouds(): void {
    this.clouds.choose(this.step, this.setupShown);
  }

  go(step: StepName): void {
    const before = this.step;
    this.step = step;
    this.setTool('orbit');
    this.chooseClouds();
    this.viewer.showSurface(step === 'surface' || step === 'edit' || step === 'export');
    const project = this.session.state?.project ?? null;
    this.viewer.setRig(step === 'rig' ? (project?.rig ?? null) : null);
    if (step === 'rig') this.viewer.frame([0.55, -0.9, 0.5]);
    else if (before === 'rig') this.viewer.frame([0.9, -1.1, 0.6]);
    if (step === 'live' && project?.can_scan && !project.live && !this.busy && !this.session.watches) void this.command('start-live');
    const live = this.session.state ? this.job('live') : undefined;
    if (before === 'live' && step !== 'live' && live && !this.session.watches) {
      void this.command('stop-job', { job: live.number });
      this.live.clear();
    }
    this.chooseLayer();
    this.requestUpdate();
  }

  async command(name: string, argument: object = {}): Promise<boolean> {
    try {
      await this.session.command(name, argument);
      this.problem = '';
      return true;
    } catch (error) {
      this.say(error);
      return false;
    }
  }
  async create(project: { name: string; stations: number } & Record<string, string | number | boolean>): Promise<void> {
    this.created = true;
    if (!(await this.command('create-project', project))) this.created = false;
  }
  async open(name: string): Promise<void> {
    if (this.state.project?.name === name) this.go(this.project.surface ? 'surface' : 'scan');
    else await this.command('open-project', { name });
  }
  async sendReference(file: File): Promise<void> {
    const format = /\.(stl|ply|obj|3mf|step|stp)$/i.exec(file.name)?.[1]?.toLowerCase();
    if (!format) return this.say(t('compare.wrongFile'));
    try {
      this.sent = 0;
      await this.session.sendReference(file, format, (share) => {
        this.sent = share;
        this.requestUpdate();
      });
      this.sent = null;
      await this.compare(-0.1, 0.1);
    } catch (error) {
      this.say(error);
    }
    this.sent = null;
    this.requestUpdate();
  }
  setAlign(align: App['align']): void {
    this.align = align;
    this.requestUpdate();
  }
  async compare(lower: number, upper: number, start = 1): Promise<void> {
    if (await this.command('compare', { align: this.align, start, lower_mm: lower, upper_mm: upper })) this.setLook({ coloring: 'deviation' });
  }
  get chosenHoles(): Set<number> {
    const revision = this.project.surface?.mesh_revision ?? -1;
    if (revision !== this.chosen.revision) this.chosen = { revision, holes: new Set() };
    return this.chosen.holes;
  }
  chooseHole(hole: number, chosen: boolean): void {
    if (chosen) this.chosenHoles.add(hole);
    else this.chosenHoles.delete(hole);
    this.requestUpdate();
  }
  /** Puts the focus on what applies a new preview, so that Enter does; the button that asked for it was disabled. */
  private focusPreview(): void {
    const revision = this.session.state?.project?.surface?.preview?.revision ?? -1;
    const apply = this.querySelector<HTMLButtonElement>('#apply:not([disabled])');
    if (revision === this.previewFocused || !apply) return;
    this.previewFocused = revision;
    if (!document.activeElement?.matches('input, select, textarea')) apply.focus({ preventScroll: true });
  }
  /** Tries an edit; it is applied when it has been looked at. */
  preview(operation: string, value = ''): void {
    void this.command('preview', { operation, value });
  }
  applyPreview(): void {
    const preview = this.project.surface?.preview;
    if (preview) this.edit(preview.operation, preview.value);
  }
  /** Asks how large the file would be, when what decides it has changed. */
  private async estimateExport(): Promise<void> {
    const surface = this.session.state?.project?.surface;
    if (this.step !== 'export' || !surface || this.session.watches || surface.triangles === 0) return;
    const wanted = exportArguments(this.exporting);
    const key = JSON.stringify([surface.mesh_revision, wanted]);
    if (key === this.estimated) return;
    this.estimated = key;
    this.estimate = null;
    try {
      const estimate = await this.session.command<{ triangles: number; bytes: number }>('estimate-export', wanted);
      if (key === this.estimated) this.estimate = estimate;
    } catch {
      // Without it, the file can still be written, and that says what is wrong.
    }
    this.requestUpdate();
  }
  async build(): Promise<void> {
    this.wantSurface = await this.command('reconstruct');
  }
  edit(operation: string, value = ''): void {
    void this.command('edit', { operation, value });
  }
  async selectBy(operation: string, value: string): Promise<void> {
    if (await this.prepareCombination()) this.edit(operation, value);
  }
  async selectPart(triangle: number): Promise<void> {
    if (await this.prepareCombination()) await this.command('select-component-of', { triangle });
  }
  private async prepareCombination(): Promise<boolean> {
    if (this.combine === 'replace' || !this.project.surface?.selected) return true;
    return this.command('edit', { operation: this.combine, value: '' });
  }
  async download(name: string): Promise<void> {
    try {
      await this.session.download(name);
    } catch (error) {
      this.say(error);
    }
  }

  setTool(tool: Tool): void {
    this.viewer.setTool(tool);
    this.requestUpdate();
  }
  setCombine(combine: Combine): void {
    this.combine = combine;
    this.requestUpdate();
  }
  setExport(change: Partial<App['exporting']>): void {
    this.exporting = { ...this.exporting, ...change };
    this.requestUpdate();
  }
  setLook(change: Partial<Look>): void {
    this.look = { ...this.look, ...change };
    const { look, viewer } = this;
    if (change.shading) viewer.setShading(look.shading);
    if (change.coloring) viewer.setColoring(look.coloring);
    if (look.coloring === 'setup') void this.meshes.showSetups();
    viewer.setSection(look.axis, look.share, look.flipped);
    this.requestUpdate();
  }

  private say(error: unknown): void {
    this.problem = error instanceof Error ? error.message : String(error);
    this.requestUpdate();
  }

  dismiss(): void {
    this.problem = '';
    this.requestUpdate();
  }
  dialog(id: string): HTMLDialogElement {
    return this.querySelector(`#${id}`) as HTMLDialogElement;
  }
  toggleTheme(): void {
    const theme = document.documentElement.dataset.theme === 'light' ? 'dark' : 'light';
    document.documentElement.dataset.theme = theme;
    localStorage.setItem('frangia-theme', theme);
  }
  toggleLanguage(): void {
    setLanguage(currentLanguage() === 'en' ? 'de' : 'en');
    this.requestUpdate();
  }
  async enter(event: SubmitEvent): Promise<void> {
    event.preventDefault();
    this.problem = '';
    try {
      await this.session.enter(String(new FormData(event.target as HTMLFormElement).get('password')));
    } catch (error) {
      this.say(error);
    }
  }
  async share(): Promise<void> {
    try {
      this.link = await this.session.newLink();
      this.requestUpdate();
      this.dialog('link').showModal();
    } catch (error) {
      this.say(error);
    }
  }

  reachable(step: StepName): boolean {
    return reachable(this.state.project, step);
  }
  finished(step: StepName): boolean {
    return finished(this.state.project, step);
  }

  private panel(): TemplateResult {
    if (this.step === 'rig') return rigStep(this);
    if (this.step === 'live') return liveStep(this);
    if (this.step === 'scan') return scanStep(this);
    if (this.step === 'surface') return surfaceStep(this);
    if (this.step === 'edit') return editStep(this);
    return exportStep(this);
  }

  protected override render(): TemplateResult {
    if (this.session.link === 'refused' || !this.session.state) return blankPage(this);
    return html`${header(this)}
      <div class="work">
        ${this.step === 'project' || !this.state.project
          ? projectStep(this)
          : html`${picture(this)}<main class="panel" tabindex="-1"><h1 class="sr">${t(`step.${this.step}`)}</h1>${this.panel()}</main>`}
        ${notices(this)}
      </div>
      ${footer(this)}${dialogs(this)}`;
  }
}
