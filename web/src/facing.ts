import { html, type TemplateResult } from 'lit';
import { meshOf } from './arrays';
import { CAD_FORMATS } from './file_formats';
import type { Inspecting } from './inspecting';
import { number, t } from './messages';
import type { Store } from './store';
import type { Triple } from './types';
import type { Hit, PickedFace } from './viewer_events';

/** Faces of a CAD reference, clicked to become features of the plan. */
export class Facing {
  private chosen: PickedFace | null = null;
  private at: Triple | null = null;
  private loading = false;

  constructor(
    private readonly app: Store,
    private readonly inspecting: Inspecting,
  ) {}

  private get picking(): boolean {
    return this.app.viewer.tool === 'face';
  }
  async begin(): Promise<void> {
    const { app } = this;
    app.setTool('face');
    if (!app.project.reference?.shown) await app.command('show-reference');
    this.follow();
  }
  picked({ face, point_mm }: Hit): void {
    if (!this.app.viewer.showsReference) return; // it is being read
    this.chosen = face ?? null;
    this.at = point_mm;
    this.app.viewer.showPending([point_mm]);
    this.app.requestUpdate();
  }
  /** Brings the reference into the picture when it can be drawn; forgets the face when another tool was chosen. */
  follow(): void {
    const { app } = this;
    if (!this.picking) {
      if (!this.at) return;
      this.chosen = null;
      this.at = null;
      app.viewer.showPending([]);
      app.requestUpdate();
      return;
    }
    if (app.state.project?.reference?.shown && !app.viewer.showsReference && !this.loading) void this.show();
  }
  private async show(): Promise<void> {
    const { app } = this;
    this.loading = true;
    try {
      const arrays = meshOf(await app.session.bytes('/api/reference'));
      if (this.picking) app.viewer.setReference(arrays);
    } catch (error) {
      app.setTool('orbit');
      app.say(error);
    }
    this.loading = false;
    app.requestUpdate();
  }

  get hint(): string {
    return t(this.app.viewer.showsReference ? 'face.hint' : 'pair.wait');
  }

  private row(face: PickedFace, off: boolean): TemplateResult {
    const { kind, diameter_mm: diameter } = face;
    if (!kind) return html`<p class="quiet" id="free-form">${t('face.freeForm')}</p>`;
    const planned = (this.inspecting.plan.features ?? []).find((one) => one.face === face.number);
    return html`<table class="table features" id="picked-face">
      <tbody class="num">
        <tr aria-selected="true">
          <td>${t(`inspect.kind.${kind}`)}, ${t('face.number', { number: face.number })}</td>
          <td>${diameter === null ? '' : `⌀ ${number(diameter, 3)}`}</td>
          <td>
            ${
              planned
                ? html`<span class="quiet">${planned.name}</span>`
                : html`<button class="btn small" ?disabled=${off} @click=${() => this.inspecting.addFace(face)}>
                    ${t('inspect.add')}
                  </button>`
            }
          </td>
        </tr>
      </tbody>
    </table>`;
  }

  /** The button that begins, and the face that was clicked. */
  panel(off: boolean): TemplateResult | string {
    const { app } = this;
    if (!CAD_FORMATS.includes(app.project.reference?.format ?? '')) return '';
    return html`<button
        class="btn wide"
        id="pick-face"
        aria-pressed=${this.picking}
        ?disabled=${off && !this.picking}
        @click=${() => (this.picking ? app.setTool('orbit') : void this.begin())}
      >
        ${t('face.pick')}
      </button>
      ${this.chosen ? this.row(this.chosen, off) : ''}`;
  }
}
