import { html, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';

import { stepNamed } from './all_steps';
import type { BuildSettings } from './building';
import type { StepName } from './step_names';
import { dialogs, footer, header, picture } from './frame_parts';
import { onKey } from './keyboard';
import { MeshSource } from './mesh_source';
import { type Language, setLanguage, t } from './messages';
import { App } from './parts';
import { applyPreferences } from './preferences';
import { blankPage, notices } from './shell';
import { acts } from './ui';
import { StationClouds } from './station_clouds';
import type { Job, State } from './types';
import { type Hit, type Ray, Viewer } from './viewer';

const isFailed = (job: Job): boolean => job.state === 'failed';

/** The window: steps, picture, panel, and the line at the bottom. What each step does is in a part of its own. */
@customElement('frangia-app')
export class FrangiaApp extends App {
  private clouds!: StationClouds;
  private seenFailure = 0;
  private begun = false; // a state has arrived
  private projectShown = '';
  private wantSurface = false;
  /** Whether the sheet is folded away, on a small screen. */
  private folded = false;
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
        void { measure: this.measuring, section: this.sectioning, pair: this.pairing, face: this.facing }[tool].picked(
          hit,
        ),
      outlined: (outline, through, keys) =>
        void this.editing.selectBy(through ? 'select-outline-through' : 'select-outline', outline, keys),
      trianglePicked: (tool, triangle, keys) => void this.editing.selectByTriangle(tool, triangle, keys),
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

  protected override onState(): void {
    const state = this.session.state;
    if (state) {
      const name = state.project?.name ?? '';
      if (name !== this.projectShown) this.onProject(state);
      this.begun = true;
      const failed = state.jobs.filter(isFailed).at(-1);
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
    // What could not be opened says why, also where its failure comes in one state with the project, or without it.
    if (state.project) {
      if (!this.begun) this.seenFailure = Math.max(0, ...state.jobs.filter(isFailed).map((job) => job.number));
      this.problem = '';
    }
    this.arranging.deviceDraft = null;
    this.setups.forget();
    this.building.forget();
    this.measuring.forget();
    const created = this.projects.takeCreated();
    if (this.projects.takeRenamed(this.projectShown)) return;
    if (!state.project) this.go('project');
    else if (state.project.surface || state.project.surface_loading || state.project.versions.length > 0)
      this.go('surface');
    else this.go(created || (!state.project.can_scan && !state.project.scan_complete) ? 'rig' : 'scan');
    this.viewer.frame([0.9, -1.1, 0.6]);
  }

  override async build(settings: Partial<BuildSettings> = {}): Promise<void> {
    this.wantSurface = await this.command('reconstruct', settings);
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
  protected override chooseClouds(): void {
    this.clouds.choose(this.step, this.setups.shown);
  }

  override titleOf(step: StepName): string {
    return stepNamed(step).title();
  }
  override canOpen(step: StepName): boolean {
    return stepNamed(step).reachable(this.session.state?.project ?? null);
  }
  override get onSurface(): boolean {
    return stepNamed(this.step).onSurface;
  }
  override go(step: StepName): void {
    stepNamed(this.step).left?.(this, step);
    this.folded = false; // what is to be done there is in the panel
    this.step = step;
    this.setTool('orbit');
    this.chooseClouds();
    this.viewer.showSurface(this.onSurface);
    stepNamed(step).entered?.(this);
    this.live.follow();
    this.requestUpdate();
  }
  /** Folds the sheet of a small screen away, or brings it back. */
  private fold(): void {
    this.folded = !this.folded;
    this.requestUpdate();
  }
  protected override onPicture(picture: ArrayBuffer): void {
    this.live.draw(picture);
  }
  override changeLanguage(language: Language): void {
    setLanguage(language);
    this.requestUpdate();
  }

  protected override updated(): void {
    this.querySelector<HTMLElement>('.drop')?.showPopover(); // above dialogs, too
    void this.exporting.follow();
    this.editing.follow();
    this.measuring.follow();
    this.sectioning.follow();
    this.pairing.follow();
    this.facing.follow();
    if (this.session.state) this.projects.follow();
    const key = `${this.step} ${this.session.state?.project?.calibration?.active ?? false}`;
    if (key === this.panelKey) return;
    this.panelKey = key;
    const panel = this.querySelector('.panel');
    if (panel) panel.scrollTop = 0;
  }
  protected override render(): TemplateResult {
    if (this.session.link === 'refused' || !this.session.state) return blankPage(this);
    const { title, panel, acts: acting } = stepNamed(this.step);
    return html`${header(this)}
      <div class="work ${this.folded ? 'folded' : ''}">
        ${
          this.step === 'project' || !this.state.project
            ? stepNamed('project').panel(this)
            : html`${picture(this)}
                <button
                  class="sheet-handle"
                  title=${t('app.sheet')}
                  aria-label=${t('app.sheet')}
                  aria-expanded=${this.folded ? 'false' : 'true'}
                  @click=${() => this.fold()}
                ></button>
                <main class="panel" tabindex=${this.session.watches ? 0 : -1}>
                  <h1 class="sr">${title()}</h1>
                  ${acting ? acts(this, panel(this)) : panel(this)}
                </main>`
        }
        ${notices(this)}
      </div>
      ${footer(this)}${dialogs(this)}`;
  }
}
