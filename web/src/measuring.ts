import { html, type TemplateResult } from 'lit';
import { Vector3 } from 'three';
import type { App } from './app';
import { icon } from './icons';
import { number, t } from './messages';
import { type HandMeasurement, type Measurement, measured } from './ruler';
import type { Surface } from './types';

interface Measured {
  label: string;
  result: Measurement;
}

/** "A" to "Z", then "A2", ... */
const letter = (index: number): string =>
  String.fromCharCode(65 + (index % 26)) + (index < 26 ? '' : String(Math.floor(index / 26) + 1));

const value = ({ distance_mm, angle_deg }: Measurement): string =>
  angle_deg === null ? `${number(distance_mm ?? 0, 3)} mm` : `${number(angle_deg, 2)}°`;

const uncertainty = ({ u95_mm, u95_deg }: Measurement): string =>
  u95_mm !== null ? `± ${number(1000 * u95_mm, 1)} µm` : u95_deg !== null ? `± ${number(u95_deg, 3)}°` : '';

/** The last point less the first, mm. */
function delta({ points }: Measurement): [number, number, number] {
  const [a, b] = [points[0], points.at(-1)] as [number[], number[]];
  return [0, 1, 2].map((i) => (b[i] as number) - (a[i] as number)) as [number, number, number];
}

/** Operations that choose triangles and leave the mesh as it is. */
const CHOOSES = /^(select|invert$|grow$|shrink$|add$|without$|within$)/;

/** Names the mesh that is shown, also after a restart: the version, and the edits that made it. */
function meshOf({ version, steps, steps_done: done }: Surface): string {
  const edits = steps.slice(0, done).filter(({ operation }) => !CHOOSES.test(operation));
  let hash = 2166136261; // FNV-1a
  for (const letter of JSON.stringify(edits.map(({ operation, value }) => [operation, value])))
    hash = Math.imul(hash ^ (letter.codePointAt(0) as number), 16777619) >>> 0;
  return `${version}-${hash.toString(16)}`;
}

const measuredBy = ({ label, points_mm: points, sigmas_mm: sigmas }: HandMeasurement): Measured => ({
  label,
  result: measured(
    points.map((point) => new Vector3(...point)),
    sigmas.map((sigma) => sigma ?? NaN),
  ),
});

/** What was measured on the surface by hand, kept with the project. It belongs to the mesh on which it was clicked. */
export class Measuring {
  /** The list as it is sent, until the server has it. */
  private sent: HandMeasurement[] | null = null;
  private known: { of: string; all: Measured[] } = { of: '', all: [] };
  private shown = '';

  constructor(private readonly app: App) {}

  private get kept(): readonly HandMeasurement[] {
    return this.sent ?? this.app.session.state?.project?.measurements ?? [];
  }
  get all(): readonly Measured[] {
    const { app } = this;
    const surface = app.session.state?.project?.surface;
    if (!surface || !app.viewer.shown || app.viewer.meshShown !== surface.mesh_revision) return [];
    const mesh = meshOf(surface);
    const own = this.kept.filter((one) => one.mesh === mesh);
    const of = JSON.stringify(own);
    if (of !== this.known.of) this.known = { of, all: own.map(measuredBy) };
    return this.known.all;
  }
  /** The newest one, which the picture shows large. */
  get last(): Measured | undefined {
    return this.all.at(-1);
  }
  forget(): void {
    this.sent = null;
    this.follow();
  }
  add(result: Measurement): void {
    const surface = this.app.session.state?.project?.surface;
    if (!surface) return;
    const taken = new Set(this.kept.map(({ label }) => label));
    let index = 0;
    while (taken.has(letter(index))) ++index;
    const one = {
      label: letter(index),
      mesh: meshOf(surface),
      points_mm: [...result.points],
      sigmas_mm: result.sigmas_mm.map((sigma) => (Number.isFinite(sigma) ? sigma : null)),
    };
    void this.keep([...this.kept, one]);
  }
  private async keep(list: HandMeasurement[]): Promise<void> {
    this.sent = list;
    this.follow();
    const kept = await this.app.command('set-measurements', { measurements: list });
    if (this.sent !== list) return; // a newer one is on its way
    if (kept) await this.arrived(list);
    this.sent = null;
    this.follow();
  }
  /** Until the state holds what was sent, so that nothing flickers. */
  private async arrived(list: HandMeasurement[]): Promise<void> {
    const wanted = list.map(({ label }) => label).join();
    const has = () => this.app.session.state?.project?.measurements.map(({ label }) => label).join() === wanted;
    for (let i = 0; i < 40 && !has(); ++i) await new Promise((resolve) => setTimeout(resolve, 50));
  }
  private remove(label: string): void {
    void this.keep(this.kept.filter((one) => one.label !== label));
  }
  /** Brings the measurements of the mesh into the picture. */
  follow(): void {
    const { app } = this;
    const key = `${app.viewer.meshShown} ${this.all.map(({ label }) => label).join(' ')}`;
    if (key === this.shown) return;
    this.shown = key;
    app.viewer.showMeasurements(this.all);
    app.requestUpdate();
  }
  private save(): void {
    const row = ({ label, result }: Measured) =>
      [
        label,
        result.distance_mm?.toFixed(4) ?? '',
        result.u95_mm?.toFixed(4) ?? '',
        result.angle_deg?.toFixed(4) ?? '',
        result.u95_deg?.toFixed(4) ?? '',
        ...delta(result).map((one) => one.toFixed(4)),
      ].join(',');
    const text = ['name,distance_mm,u95_mm,angle_deg,u95_deg,dx_mm,dy_mm,dz_mm', ...this.all.map(row), ''].join('\n');
    this.app.exporting.save(new Blob([text], { type: 'text/csv' }), `${this.app.project.name} measured.csv`);
  }

  /** The list in the panel. */
  panel(): TemplateResult | string {
    if (this.all.length === 0) return '';
    return html`<table class="table measured">
        <tbody class="num">
          ${this.all.map(
            ({ label, result }) =>
              html`<tr>
                <th scope="row">${label}</th>
                <td>
                  <b>${value(result)}</b> <span class="quiet">${uncertainty(result)}</span>
                  ${
                    result.angle_deg === null
                      ? html`<br /><span class="quiet"
                            >Δ
                            ${delta(result)
                              .map((one) => number(one, 2))
                              .join('  ')}
                            mm</span
                          >`
                      : ''
                  }
                </td>
                <td>
                  <button
                    class="icon-btn"
                    title=${t('measure.remove')}
                    aria-label="${t('measure.remove')} ${label}"
                    ?disabled=${this.app.session.watches}
                    @click=${() => this.remove(label)}
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
  /** The newest one on the picture, while a tool measures. */
  chip(): TemplateResult | string {
    const { last } = this;
    const { tool } = this.app.viewer;
    if (!last || (tool !== 'measure' && tool !== 'angle')) return '';
    const u = uncertainty(last.result);
    return html`<div class="chip">
      <div class="big">${last.label} = ${value(last.result)}</div>
      ${u ? html`<div class="num quiet">${u} (k = 2)</div>` : ''}
    </div>`;
  }
}
