import { html, type TemplateResult } from 'lit';
import type { App } from './app';
import { icon } from './icons';
import { number, t } from './messages';
import type { Measurement } from './ruler';

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

/** What was measured on the surface by hand. It belongs to the mesh on which it was clicked, and comes back with it. */
export class Measuring {
  private readonly lists = new Map<number, { next: number; all: Measured[] }>();
  private shown = '';

  constructor(private readonly app: App) {}

  private get list(): { next: number; all: Measured[] } {
    const revision = this.app.viewer.meshShown;
    const known = this.lists.get(revision) ?? { next: 0, all: [] };
    this.lists.set(revision, known);
    return known;
  }
  get all(): readonly Measured[] {
    return this.app.viewer.shown ? this.list.all : [];
  }
  /** The newest one, which the picture shows large. */
  get last(): Measured | undefined {
    return this.all.at(-1);
  }
  forget(): void {
    this.lists.clear();
    this.follow();
  }
  add(result: Measurement): void {
    const { list } = this;
    list.all = [...list.all, { label: letter(list.next++), result }];
    this.follow();
  }
  private remove(label: string): void {
    this.list.all = this.list.all.filter((one) => one.label !== label);
    this.follow();
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
