import { html, LitElement, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';

import { meshOf, unpack } from './arrays';
import { icon, type IconName, logo } from './icons';
import { currentLanguage, type MessageKey, number, setLanguage, t } from './messages';
import { Refusal, Session } from './session';
import { editStep, type Combine } from './steps/edit';
import { exportStep, type Format, type Limit, type Variant } from './steps/export';
import { projectStep } from './steps/project';
import { scanStep } from './steps/scan';
import { surfaceStep } from './steps/surface';
import type { Job, Project, State } from './types';
import { plain, quoted } from './ui';
import { type Coloring, type Measurement, type SectionAxis, type Shading, type Tool, Viewer } from './viewer';

const STEPS = ['project', 'scan', 'surface', 'edit', 'export'] as const;
type StepName = (typeof STEPS)[number];
interface Look { shading: Shading; coloring: Coloring; axis: SectionAxis; share: number; flipped: boolean }

const KEYS: readonly (readonly [MessageKey | IconName, string])[] = [
  ['keys.steps', '1 – 5'],
  ['app.frame', 'F'],
  ['edit.lasso', 'L'],
  ['edit.rectangle', 'R'],
  ['edit.part', 'P'],
  ['surface.measure', 'M'],
  ['edit.delete', 'Del'],
  ['edit.invert', 'I'],
  ['edit.undo', 'Ctrl Z'],
  ['edit.redo', 'Ctrl Shift Z'],
  ['keys.deselect', 'Esc'],
  ['app.theme', 'D'],
  ['app.keys', '?'],
];

/** The window: steps, picture, panel, and the line at the bottom. */
@customElement('frangia-app')
export class App extends LitElement {
  step: StepName = 'project';
  look: Look = { shading: 'smooth', coloring: 'plain', axis: 'off', share: 0.5, flipped: false };
  combine: Combine = 'replace';
  exporting: { format: Format; variant: Variant; limit: Limit } = { format: 'dxf', variant: 'faces', limit: '200000' };
  viewer!: Viewer;
  private readonly session = new Session(() => this.onState());
  private readonly host = document.createElement('div');
  private measurement: Measurement | null = null;
  private problem = '';
  private seenFailure = 0;
  private meshShown = -1;
  private selectionShown = -1;
  private cloudsShown = new Map<number, number>();
  private projectShown = '';
  private wantSurface = false;
  private copied = false;
  private link = '';

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
      measured: (result) => {
        this.measurement = result;
        this.requestUpdate();
      },
      outlined: (outline, through) => void this.selectBy(through ? 'select-outline-through' : 'select-outline', outline),
      partPicked: (triangle) => void this.selectPart(triangle),
    });
    addEventListener('keydown', (event) => this.onKey(event));
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
      }
      void this.showSurface();
      void this.showClouds();
    }
    this.requestUpdate();
  }

  private onProject(state: State): void {
    this.projectShown = state.project?.name ?? '';
    this.meshShown = this.selectionShown = -1;
    this.cloudsShown.clear();
    this.viewer.setMesh(null);
    this.viewer.clearClouds();
    this.seenFailure = Math.max(0, ...state.jobs.filter((job) => job.state === 'failed').map((job) => job.number));
    this.problem = '';
    if (!state.project) this.go('project');
    else this.go(state.project.surface ? 'surface' : 'scan');
    this.viewer.frame([0.9, -1.1, 0.6]);
  }

  private async showSurface(): Promise<void> {
    const surface = this.state.project?.surface;
    if (!surface) {
      if (this.meshShown !== -1) this.viewer.setMesh(null);
      this.meshShown = -1;
      return;
    }
    try {
      if (surface.mesh_revision !== this.meshShown) {
        this.meshShown = surface.mesh_revision;
        const arrays = meshOf(await this.session.bytes('/api/mesh'));
        if (this.meshShown !== surface.mesh_revision) return;
        this.viewer.setMesh(arrays);
        this.selectionShown = -1;
        this.requestUpdate();
      }
      if (surface.selection_revision !== this.selectionShown) {
        this.selectionShown = surface.selection_revision;
        const flags = surface.selected ? unpack(await this.session.bytes('/api/selection')).get('selected') : undefined;
        this.viewer.setSelection((flags as Uint8Array | undefined) ?? null);
      }
    } catch (error) {
      this.say(error);
    }
  }

  private async showClouds(): Promise<void> {
    this.viewer.showClouds(this.step === 'scan');
    const stations = this.state.project?.stations ?? [];
    for (const [i, station] of stations.entries()) {
      if (!station.has_cloud || this.cloudsShown.get(i) === station.points) continue;
      this.cloudsShown.set(i, station.points);
      try {
        const arrays = unpack(await this.session.bytes(`/api/clouds/${i}`));
        this.viewer.setCloud(i, arrays.get('positions') as Float32Array);
      } catch (error) {
        if (!(error instanceof Refusal) || error.status !== 404) this.say(error);
      }
    }
  }

  go(step: StepName): void {
    this.step = step;
    this.setTool('orbit');
    this.viewer.showClouds(step === 'scan');
    this.viewer.showSurface(step !== 'scan');
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
  async create(name: string, part: string, stations: number): Promise<void> {
    await this.command('create-project', { name, part, stations });
  }
  async open(name: string): Promise<void> {
    if (this.state.project?.name === name) this.go(this.project.surface ? 'surface' : 'scan');
    else await this.command('open-project', { name });
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
    viewer.setSection(look.axis, look.share, look.flipped);
    this.requestUpdate();
  }

  private say(error: unknown): void {
    this.problem = error instanceof Error ? error.message : String(error);
    this.requestUpdate();
  }

  private onKey(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    if (target.matches('input:not([type=radio]):not([type=checkbox]):not([type=range]), select, textarea')) return;
    if (!this.session.state || document.querySelector('dialog[open]')) return;
    const surface = this.state.project?.surface;
    const key = event.key.toLowerCase();
    if (event.ctrlKey || event.metaKey) {
      if (key !== 'z' || !surface) return;
      event.preventDefault();
      return void this.command(event.shiftKey ? 'redo' : 'undo');
    }
    if (event.altKey) return;
    if (/^[1-5]$/.test(key)) {
      const step = STEPS[Number(key) - 1] as StepName;
      if (this.reachable(step)) this.go(step);
    } else if (key === '?') this.dialog('keys').showModal();
    else if (key === 'd') this.toggleTheme();
    else if (key === 'f') this.viewer.frame();
    else if (key === 'escape') this.setTool('orbit');
    else if (!surface) return;
    else if (key === 'm') this.setTool('measure');
    else if (this.step !== 'edit') return;
    else if (key === 'l') this.setTool('lasso');
    else if (key === 'r') this.setTool('rectangle');
    else if (key === 'p') this.setTool('part');
    else if (key === 'i') this.edit('invert');
    else if ((key === 'delete' || key === 'backspace') && surface.selected) this.edit('delete');
  }

  private dialog(id: string): HTMLDialogElement {
    return this.querySelector(`#${id}`) as HTMLDialogElement;
  }
  private toggleTheme(): void {
    const theme = document.documentElement.dataset.theme === 'light' ? 'dark' : 'light';
    document.documentElement.dataset.theme = theme;
    localStorage.setItem('frangia-theme', theme);
  }
  private toggleLanguage(): void {
    setLanguage(currentLanguage() === 'en' ? 'de' : 'en');
    this.requestUpdate();
  }
  private async share(): Promise<void> {
    try {
      this.link = await this.session.newLink();
      this.requestUpdate();
      this.dialog('link').showModal();
    } catch (error) {
      this.say(error);
    }
  }

  private reachable(step: StepName): boolean {
    const project = this.state.project;
    if (step === 'project') return true;
    if (step === 'scan') return project !== null;
    return Boolean(project?.surface);
  }
  private finished(step: StepName): boolean {
    const project = this.state.project;
    if (step === 'project') return project !== null;
    if (step === 'scan') return Boolean(project?.scan_complete);
    if (step === 'surface') return Boolean(project?.surface);
    if (step === 'edit') return (project?.surface?.steps_done ?? 0) > 0;
    return (project?.exports.length ?? 0) > 0;
  }

  private header(): TemplateResult {
    const tool = (name: IconName, key: MessageKey, act: () => void) =>
      html`<button class="icon-btn" title=${t(key)} aria-label=${t(key)} @click=${act}>${icon(name)}</button>`;
    return html`<header class="top">
      <div class="brand">${logo}<b>Frangia</b>${this.state.project ? html`<span class="project">${this.project.name}</span>` : ''}</div>
      <nav class="steps" aria-label=${t('steps')}>
        ${STEPS.map(
          (step, i) => html`<button
            class=${this.finished(step) ? 'done' : ''}
            ?disabled=${!this.reachable(step)}
            aria-current=${step === this.step ? 'step' : nothing}
            data-step=${step}
            @click=${() => this.go(step)}
          >
            <i>${i + 1}</i>${t(`step.${step}`)}
          </button>`,
        )}
      </nav>
      <div class="tools">
        <button class="icon-btn text" lang=${currentLanguage() === 'en' ? 'de' : 'en'} @click=${() => this.toggleLanguage()}>${t('app.language')}</button>
        ${tool('theme', 'app.theme', () => this.toggleTheme())} ${tool('link', 'app.link', () => void this.share())}
        ${tool('keys', 'app.keys', () => this.dialog('keys').showModal())}
      </div>
    </header>`;
  }

  private footer(): TemplateResult {
    const job = this.state.jobs.find((one) => one.state === 'running');
    const commands = this.state.project?.commands ?? {};
    const words = this.step === 'scan' ? commands.scan : this.step === 'surface' ? commands.reconstruct : this.step === 'project' ? undefined : commands.edit;
    const line = words?.map(quoted).join(' ') ?? '';
    const last = this.state.jobs.at(-1);
    const copy = async () => {
      await navigator.clipboard.writeText(line);
      this.copied = true;
      this.requestUpdate();
      setTimeout(() => {
        this.copied = false;
        this.requestUpdate();
      }, 1500);
    };
    return html`<footer class="foot">
      <div class="job" role="status">
        ${job
          ? html`<svg class="bar" aria-hidden="true"><rect width="${100 * job.progress}%" height="4" /></svg>
              <span>${t(`job.${job.kind}`)}${job.stage ? ` · ${job.stage}` : ''}</span>
              <button class="btn small" @click=${() => this.command('stop-job', { job: job.number })}>${t('job.stop')}</button>`
          : html`<span>${plain(last?.log.at(-1)?.sentence ?? t('job.idle'))}</span>`}
      </div>
      ${line
        ? html`<div class="command" title=${t('command.same')}>
            <code><b>$</b> ${line}</code>
            <button class="icon-btn" aria-label="${t('command.copy')}: ${t('command.same')}" title=${this.copied ? t('command.copied') : t('command.copy')} @click=${copy}>
              ${icon(this.copied ? 'check' : 'copy')}
            </button>
          </div>`
        : ''}
    </footer>`;
  }

  private picture(): TemplateResult {
    const { viewer, measurement } = this;
    return html`<div class="stage" role="region" aria-label=${t('app.view')}>
      ${viewer.supported ? this.host : html`<div class="blank"><p>${t('app.noWebGL')}</p></div>`}
      <div class="floating">
        ${viewer.tool === 'measure' && !measurement ? html`<div class="chip">${t('surface.measureHint')}</div>` : ''}
        ${measurement
          ? html`<div class="chip"><div class="big">${number(measurement.distance_mm, 3)} mm</div>
              ${measurement.sigma_mm === null ? '' : html`<div class="num quiet">± ${number(1000 * measurement.sigma_mm, 1)} µm (k = 1)</div>`}</div>`
          : ''}
      </div>
      ${viewer.supported
        ? html`<div class="view-tools">
            <button class="icon-btn text" @click=${() => viewer.frame([0, -1, 0.18])}>${t('app.front')}</button>
            <button class="icon-btn text" @click=${() => viewer.frame([0, -0.02, 1])}>${t('app.top')}</button>
            <button class="icon-btn" title=${t('app.frame')} aria-label=${t('app.frame')} @click=${() => viewer.frame()}>${icon('fit')}</button>
          </div>`
        : ''}
    </div>`;
  }

  private panel(): TemplateResult {
    if (this.step === 'scan') return scanStep(this);
    if (this.step === 'surface') return surfaceStep(this);
    if (this.step === 'edit') return editStep(this);
    return exportStep(this);
  }

  private dialogs(): TemplateResult {
    const close = (id: string) =>
      html`<button class="icon-btn close" aria-label=${t('app.close')} @click=${() => this.dialog(id).close()}>${icon('close')}</button>`;
    return html`<dialog id="keys" aria-label=${t('app.keys')}>
        <h2>${t('app.keys')}</h2>
        <div class="keys">
          ${KEYS.map(([key, keys]) => html`<span>${t(key as MessageKey)}</span><span>${keys.split(' ').map((one) => (one === '–' ? ' – ' : html`<kbd>${one}</kbd>`))}</span>`)}
        </div>
        ${close('keys')}
      </dialog>
      <dialog id="link" aria-label=${t('app.link')}>
        <h2>${t('app.link')}</h2>
        <p class="quiet">${t('app.linkHint')}</p>
        <div class="linkbox">${this.link}</div>
        ${close('link')}
      </dialog>`;
  }

  protected override render(): TemplateResult {
    if (this.session.link === 'refused')
      return html`<main class="blank">${logo}<h1>${t('app.refused')}</h1><p class="quiet">${t('app.refusedHint')}</p><code>frangia serve --new-link</code></main>`;
    if (!this.session.state) return html`<main class="blank">${logo}<p class="quiet">${t('app.connecting')}</p></main>`;
    const lost = this.session.link === 'lost';
    return html`${this.header()}
      <div class="work">
        ${this.step === 'project' || !this.state.project
          ? projectStep(this)
          : html`${this.picture()}<main class="panel" tabindex="-1"><h1 class="sr">${t(`step.${this.step}`)}</h1>${this.panel()}</main>`}
        <div class="messages" role="region" aria-label=${t('app.messages')}>
          ${lost ? html`<div class="notice warn" role="alert"><span>${t('app.lost')}</span></div>` : ''}
          ${this.problem && !lost
            ? html`<div class="notice" role="alert"><span>${plain(this.problem)}</span>
                <button class="icon-btn" aria-label=${t('app.dismiss')} @click=${() => { this.problem = ''; this.requestUpdate(); }}>${icon('close')}</button></div>`
            : ''}
        </div>
      </div>
      ${this.footer()}${this.dialogs()}`;
  }
}
