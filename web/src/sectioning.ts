import { html, type TemplateResult } from 'lit';
import { Plane, Vector3 } from 'three';
import type { Exporting } from './exporting';
import type { Store } from './store';
import { icon } from './icons';
import { number, t } from './messages';
import { numeric } from './number_field';
import { numberOf, shownNumber } from './written_numbers';
import type { Section, Triple } from './types';
import { choice, repairButton } from './ui';
import { roundLength } from './view_marks';
import type { Hit, SectionAxis } from './viewer';

const POINTS = 3;
/** Steps over the whole part that a key makes, about. */
const STEPS = 60;

/** The plane that cuts the surface in the picture: where it stands, and what it cuts. */
export class Sectioning {
  /** What the plane cuts, of the present plane and mesh; null until it is known. */
  found: Section | null = null;
  private points: Triple[] = [];
  private shown = '';
  private asking = false;

  constructor(
    private readonly app: Store,
    private readonly exporting: Exporting,
  ) {}

  get active(): boolean {
    return this.app.look.axis !== 'off';
  }
  /** Chooses the axis across which the plane stands; the three points are picked. */
  choose(axis: SectionAxis): void {
    this.points = [];
    this.app.setLook({ axis, at: null });
    this.app.setTool(axis === 'points' && !this.app.look.normal ? 'section' : 'orbit');
  }
  /** A key shows and hides the plane. */
  toggle(axis: 'x' | 'y' | 'z'): void {
    this.choose(this.app.look.axis === axis ? 'off' : axis);
  }
  pickAgain(): void {
    this.points = [];
    this.app.setTool('section');
  }
  picked({ point_mm }: Hit): void {
    const { app } = this;
    this.points.push(point_mm);
    app.viewer.showPending(this.points);
    app.requestUpdate();
    if (this.points.length < POINTS) return;
    const [a, b, c] = this.points.map((point) => new Vector3(...point)) as [Vector3, Vector3, Vector3];
    this.points = [];
    const plane = new Plane().setFromCoplanarPoints(a, b, c);
    app.viewer.showPending([]);
    if (plane.normal.lengthSq() < 0.5) return; // on a line: others are picked
    // The larger part of the direction is positive, so that its side does not hang on the order of the clicks.
    const along = plane.normal.toArray().reduce((most, one) => (Math.abs(one) > Math.abs(most) ? one : most), 0);
    if (along < 0) plane.negate();
    app.setLook({ axis: 'points', normal: plane.normal.toArray(), at: -plane.constant });
    app.setTool('orbit');
  }
  get hint(): string {
    return t('section.hint', { count: POINTS - this.points.length });
  }
  moveTo(at: number): void {
    if (Number.isFinite(at)) this.app.setLook({ at });
  }
  /** A key moves the plane by a round length. */
  move(sign: number): void {
    const { viewer } = this.app;
    const [low, high] = viewer.section.range;
    if (this.active && high > low) this.moveTo(viewer.section.at + sign * roundLength((high - low) / STEPS));
  }
  /** The plane as the server takes it; null without one. */
  get plane(): { point_mm: Triple; normal: Triple } | null {
    const { viewer } = this.app;
    const normal = viewer.section.normal;
    return normal && { point_mm: normal.map((one) => one * viewer.section.at) as Triple, normal };
  }
  /** The side that stays, as operations of the editor take it: nx, ny, nz, d. */
  get half(): string {
    const { viewer, look } = this.app;
    const sign = look.flipped ? 1 : -1;
    const normal = viewer.section.normal ?? [0, 0, 0];
    const rounded = normal.map((one) => Number((sign * one).toFixed(6)));
    return [...rounded, (sign * viewer.section.at).toFixed(4)].join(',');
  }

  /** Asks what the plane cuts where it rests, and shows it. */
  follow(): void {
    const { app } = this;
    const surface = app.session.state?.project?.surface;
    const plane = surface && app.viewer.meshShown === surface.mesh_revision ? this.plane : null;
    const key = plane && surface ? JSON.stringify([app.project.name, surface.mesh_revision, plane]) : '';
    if (key === this.shown) return;
    if (this.found) {
      this.found = null;
      app.viewer.setCut(null);
      app.requestUpdate();
    }
    if (!plane) this.shown = '';
    if (!plane || this.asking) return;
    this.asking = true;
    void this.ask(key, plane);
  }
  private async ask(key: string, plane: { point_mm: Triple; normal: Triple }): Promise<void> {
    const { app } = this;
    this.shown = key;
    try {
      this.found = await app.session.cut(plane);
      app.viewer.setCut(this.found);
    } catch (error) {
      app.say(error);
    }
    this.asking = false;
    app.requestUpdate(); // asks again where the plane has moved meanwhile
  }

  /** The axis of the section plane, where on it the plane stands, and what it cuts. */
  panel(cuts = true): TemplateResult {
    const { app } = this;
    const { look, viewer } = app;
    const [low, high] = viewer.section.range;
    const at = viewer.section.at;
    return html`${choice<SectionAxis>(
      t('section.title'),
      look.axis,
      [
        ['off', t('section.off')],
        ['x', 'x'],
        ['y', 'y'],
        ['z', 'z'],
        ['points', html`<span class="word">${t('section.points')}</span>`],
      ],
      (axis) => this.choose(axis),
    )}
    ${
      viewer.section.normal === null
        ? viewer.tool === 'section'
          ? html`<p class="quiet">${this.hint}</p>`
          : ''
        : html`<div class="row section-at">
              <label class="field grow"
                ><span>${t('section.position')}</span>
                <input
                  class="num"
                  name="section-at"
                  .value=${shownNumber(Number(at.toFixed(4)))}
                  ${numeric({})}
                  @change=${(event: Event) => this.moveTo(numberOf(event.target as HTMLInputElement) ?? NaN)}
              /></label>
              <button
                class="icon-btn"
                title=${t('section.flip')}
                aria-label=${t('section.flip')}
                @click=${() => app.setLook({ flipped: !look.flipped })}
              >
                ${icon('flip')}
              </button>
            </div>
            <input
              type="range"
              min=${low}
              max=${high}
              step=${(high - low) / 1000 || 1}
              .value=${String(at)}
              aria-label=${t('section.slide')}
              @input=${(event: Event) => this.moveTo((event.target as HTMLInputElement).valueAsNumber)}
            />
            ${
              look.axis === 'points'
                ? html`<button
                    class="btn wide small"
                    id="section-again"
                    aria-pressed=${viewer.tool === 'section'}
                    @click=${() => this.pickAgain()}
                  >
                    ${t('section.again')}
                  </button>`
                : ''
            }
            ${cuts ? this.figures() : ''}`
    }`;
  }
  private figures(): TemplateResult | string {
    const { found, app } = this;
    if (!found) return '';
    if (found.curves.length === 0) return html`<p class="quiet">${t('section.misses')}</p>`;
    const row = (words: string, value: number, unit: string) =>
      html`<dt>${words}</dt>
        <dd class="num">${number(value, 2)}<span>${unit}</span></dd>`;
    return html`<dl class="figures" id="cut-figures">
        ${row(t('section.length'), found.length_mm, 'mm')}
        ${found.area_mm2 === null ? '' : row(t('section.area'), found.area_mm2, 'mm²')}
      </dl>
      ${
        found.area_mm2 === null
          ? html`<p class="quiet">${t('section.open')}</p>
              ${app.step === 'edit' ? '' : repairButton(app)}`
          : ''
      }
      <div class="pair">
        ${(['dxf', 'svg'] as const).map(
          (format) =>
            html`<button
              class="btn small"
              data-section=${format}
              ?disabled=${app.session.watches}
              @click=${() => this.plane && void this.exporting.section(this.plane, format)}
            >
              ${icon('download')}${format.toUpperCase()}
            </button>`,
        )}
      </div>`;
  }
}
