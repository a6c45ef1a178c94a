import { html, type TemplateResult } from 'lit';
import type { Exporting } from './exporting';
import type { Store } from './store';
import { term } from './terms';
import { icon } from './icons';
import { number, t } from './messages';
import type { Drawn } from './ruler';
import type { HandMeasurement, Quantity, Triple } from './types';
import { choice } from './ui';
import type { Hit } from './viewer';

/** What can be measured, in the order of the buttons. */
export const QUANTITIES: readonly Quantity[] = ['distance', 'angle', 'diameter', 'thickness', 'area', 'volume'];

const UNITS: Record<HandMeasurement['unit'], string> = { mm: 'mm', degrees: '°', mm2: 'mm²', mm3: 'mm³' };

/** Digits of a value: to a tenth of a micrometre, a hundredth of a degree, a thousandth of an area. */
const digitsOf = ({ unit, value }: HandMeasurement): number => {
  if (unit === 'mm') return 3;
  if (unit === 'degrees') return 2;
  return Math.abs(value) < 100 ? 3 : Math.abs(value) < 10_000 ? 2 : 0;
};
const gap = (unit: HandMeasurement['unit']): string => (unit === 'degrees' ? '' : ' ');

const valueOf = (one: HandMeasurement): string =>
  `${one.quantity === 'diameter' ? '⌀ ' : ''}${number(one.value, digitsOf(one))}${gap(one.unit)}${UNITS[one.unit]}`;

function uncertaintyOf({ u95, unit, value }: HandMeasurement): string {
  if (u95 === null) return '';
  if (unit === 'mm') return u95 < 5e-5 ? `± < ${number(0.1, 1)} µm` : `± ${number(1000 * u95, 1)} µm`;
  if (unit === 'degrees') return `± ${number(u95, 3)}°`;
  return `± ${number(u95, Math.abs(value) < 100 ? 3 : 1)} ${UNITS[unit]}`;
}

/** With a minus as wide as a digit; what rounds to zero has none. */
const signed = (mm: number): string => `${mm <= -5e-4 ? '−' : ''}${number(Math.abs(mm), 3)}`;

/** The end of its line less the beginning, mm. */
const deltaOf = ({ from_mm: from, to_mm: to }: HandMeasurement): Triple =>
  [0, 1, 2].map((i) => (to[i] as number) - (from[i] as number)) as Triple;

/** What it is of, such as "plane – point". */
const wordsOf = ({ elements }: HandMeasurement): string =>
  elements.map(({ kind }) => t(`measure.of.${kind}`)).join(' – ');

const LENGTHS: readonly Quantity[] = ['distance', 'thickness'];

/** What was measured on the surface by hand, kept with the project. It belongs to the mesh on which it was clicked. */
export class Measuring {
  /** What the tool measures. */
  quantity: Quantity = 'distance';
  /** Whether a click takes the whole face around it. */
  faces = false;
  private places: { point_mm: Triple; triangle: number; face: boolean }[] = [];
  private shown = '';

  constructor(
    private readonly app: Store,
    private readonly exporting: Exporting,
    /** What else has a label in the picture. */
    private readonly others: () => readonly Drawn[],
  ) {}

  get all(): readonly HandMeasurement[] {
    const { app } = this;
    const project = app.session.state?.project;
    const surface = project?.surface;
    if (!surface || !app.viewer.shown || app.viewer.meshShown !== surface.mesh_revision) return [];
    return project.measurements.filter((one) => one.mesh === surface.mesh);
  }
  /** The newest one, which the picture shows large. */
  get last(): HandMeasurement | undefined {
    return this.all.at(-1);
  }
  forget(): void {
    this.places = [];
    this.follow();
  }

  /** Begins to measure, or measures at once what needs no click; again, ends. */
  begin(quantity: Quantity): void {
    const { app } = this;
    if (quantity === 'area' || quantity === 'volume') return void this.ask(quantity, []);
    const same = app.viewer.tool === 'measure' && this.quantity === quantity;
    this.quantity = quantity;
    this.places = [];
    app.setTool(same ? 'orbit' : 'measure');
  }
  takeFaces(faces: boolean): void {
    this.faces = faces;
    this.app.requestUpdate();
  }
  /** Whether a click takes a face now. */
  private get takesFace(): boolean {
    return this.quantity === 'diameter' || (this.quantity !== 'thickness' && this.faces);
  }
  private get wanted(): number {
    if (this.quantity === 'distance') return 2;
    if (this.quantity !== 'angle') return 1;
    return (this.places[0]?.face ?? this.faces) ? 2 : 3;
  }
  /** A click on the surface. */
  picked({ point_mm, triangle }: Hit): void {
    const { quantity, app } = this;
    // The corner of an angle is of points alone.
    const face = quantity === 'angle' && this.places[0] ? this.places[0].face : this.takesFace;
    this.places.push({ point_mm, triangle, face });
    const complete = this.places.length >= this.wanted;
    const { places } = this;
    if (complete) this.places = [];
    app.viewer.showPending(this.places.map((place) => place.point_mm));
    app.requestUpdate();
    if (complete) void this.ask(quantity, places);
  }
  private async ask(quantity: Quantity, places: Measuring['places']): Promise<void> {
    const mesh = this.app.project.surface?.mesh;
    if (mesh) await this.app.command('measure', { quantity, places, mesh });
  }
  /** Drops what was clicked so far; whether there was anything. */
  cancel(): boolean {
    const begun = this.places.length > 0;
    this.places = [];
    this.app.viewer.showPending([]);
    this.app.requestUpdate();
    return begun;
  }

  /** Brings the measurements of the mesh into the picture. */
  follow(): void {
    const { app } = this;
    if (app.viewer.tool !== 'measure') this.places = [];
    const { all } = this;
    const others = this.others();
    const key = `${others.map(({ key, text, verdict }) => `${key}${text}${verdict}`).join(' ')} ${app.session.state?.project?.name} ${app.viewer.meshShown} ${all.map((one) => `${one.label}${one.value}`).join(' ')} ${t('measure.of.point')}`;
    if (key === this.shown) return;
    this.shown = key;
    app.viewer.showMeasurements([
      ...all.map((one) => ({
        key: one.label,
        text: `${one.label} ${valueOf(one)}`,
        points: one.elements.map(({ point_mm }) => point_mm),
        from: one.from_mm,
        to: one.to_mm,
      })),
      ...others,
    ]);
    app.requestUpdate();
  }
  private save(): void {
    const row = (one: HandMeasurement) => {
      const delta = LENGTHS.includes(one.quantity) ? deltaOf(one).map((length) => length.toFixed(4)) : ['', '', ''];
      const of = one.elements.map(({ kind }) => kind).join(' - ');
      return [one.label, one.quantity, of, one.value.toFixed(4), one.unit, one.u95?.toFixed(4) ?? '', ...delta].join(
        ',',
      );
    };
    const text = ['name,quantity,of,value,unit,u95,dx_mm,dy_mm,dz_mm', ...this.all.map(row), ''].join('\n');
    this.exporting.save(new Blob([text], { type: 'text/csv' }), `${this.app.project.name} measured.csv`);
  }

  /** What can be measured, and the list of what was. */
  panel(): TemplateResult {
    const { app } = this;
    const active = app.viewer.tool === 'measure';
    const off = app.session.watches;
    const chooses = active && (this.quantity === 'distance' || this.quantity === 'angle');
    return html`<section class="group" id="measuring">
      <h2><span>${t('measure.title')}${term('U95')}</span></h2>
      <div class="quantities">
        ${QUANTITIES.map(
          (quantity) =>
            html`<button
              class="btn small"
              data-quantity=${quantity}
              aria-pressed=${active && this.quantity === quantity}
              title=${quantity === 'area' ? t('measure.areaHint') : quantity === 'volume' ? t('measure.volumeHint') : ''}
              ?disabled=${off}
              @click=${() => this.begin(quantity)}
            >
              ${t(`measure.${quantity}`)}
            </button>`,
        )}
      </div>
      ${
        chooses
          ? choice<'points' | 'faces'>(
              t('measure.takes'),
              this.faces ? 'faces' : 'points',
              [
                ['points', t('measure.points')],
                ['faces', t('measure.faces')],
              ],
              (taken) => this.takeFaces(taken === 'faces'),
            )
          : ''
      }
      ${active ? html`<p class="quiet">${this.hint}</p>` : ''} ${this.list()}
    </section>`;
  }
  private list(): TemplateResult | string {
    if (this.all.length === 0) return '';
    return html`<table class="table measured">
        <tbody class="num">
          ${this.all.map(
            (one) =>
              html`<tr data-measured=${one.label}>
                <th scope="row">${one.label}</th>
                <td>
                  <b>${valueOf(one)}</b> <span class="quiet">${uncertaintyOf(one)}</span><br />
                  <span class="quiet">${t(`measure.${one.quantity}`)}, ${wordsOf(one)}</span>
                  ${
                    LENGTHS.includes(one.quantity)
                      ? html`<br /><span class="quiet delta"
                            >${['x', 'y', 'z'].map((axis, i) => html`<span>Δ${axis} ${signed(deltaOf(one)[i] as number)}</span>`)}</span
                          >`
                      : ''
                  }
                </td>
                <td>
                  <button
                    class="icon-btn"
                    title=${t('measure.remove')}
                    aria-label="${t('measure.remove')} ${one.label}"
                    ?disabled=${this.app.session.watches}
                    @click=${() => this.app.command('remove-measurements', { labels: [one.label] })}
                  >
                    ${icon('close')}
                  </button>
                </td>
              </tr>`,
          )}
        </tbody>
      </table>
      <button class="btn wide" id="save-measured" @click=${() => this.save()}>
        ${icon('download')}${t('measure.save')}
      </button>`;
  }
  /** What the tool waits for. */
  private get hint(): string {
    const { quantity } = this;
    const left = this.wanted - this.places.length;
    if (quantity === 'thickness') return t('measure.hint.thickness');
    if (quantity === 'diameter') return t('measure.hint.diameter');
    const face = quantity === 'angle' ? (this.places[0]?.face ?? this.faces) : this.faces;
    return t(face ? 'measure.hint.faces' : 'measure.hint.points', { count: left });
  }
  /** What the tool waits for, and the newest one, on the picture, while the tool measures. */
  chip(): TemplateResult | string {
    const { last } = this;
    if (this.app.viewer.tool !== 'measure') return '';
    if (!last || this.places.length > 0) return html`<div class="chip">${this.hint}</div>`;
    const u = uncertaintyOf(last);
    return html`<div class="chip">
      <div class="big">${last.label} = ${valueOf(last)}</div>
      ${u ? html`<div class="num quiet">${u} (U95)</div>` : ''}
    </div>`;
  }
}
