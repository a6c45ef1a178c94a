import { html, svg, type TemplateResult } from 'lit';

import type { App } from '../../parts';
import { accepted, MESH_FORMATS } from '../../file_formats';
import { icon } from '../../icons';
import type { Inspection, SeriesPart, SeriesRow } from '../../types';
import { number, t } from '../../messages';

const DOTS = { in: 'done', out: 'bad', undecided: 'poor' } as const;
const WIDE = 120;
const HIGH = 34;
/** Share of the height of the tolerance in the drawing. */
const BAND = 0.6;

/** Of the drawing, mm or degrees: what is smaller is no trend. */
const LEAST_SPAN = 0.01;

/** The parts of the series, this one last. */
function partsOf(app: App, found: Inspection | null): SeriesPart[] {
  const { series, name, plan } = app.project;
  const serial = plan?.report?.serial ?? '';
  return [...series, { name, serial, verdict: found?.verdict ?? null, rows: found?.characteristics ?? [] }];
}

/** A characteristic over the parts, between the lines of its limits. */
function trend(values: readonly (SeriesRow | undefined)[]): TemplateResult {
  const known = values.filter((row): row is SeriesRow => row !== undefined && row.value !== null);
  const limits = known.at(-1)?.limits;
  const numbers = [
    ...known.map(({ value }) => value as number),
    ...[...(limits ?? [])].filter((one): one is number => one !== null),
  ];
  const [low, high] = [Math.min(...numbers), Math.max(...numbers)];
  const span = Math.max(high - low, LEAST_SPAN);
  const y = (value: number) => HIGH / 2 - ((value - (low + high) / 2) / span) * HIGH * BAND;
  const x = (i: number) => 6 + (i / Math.max(1, values.length - 1)) * (WIDE - 12);
  const line = values.flatMap((row, i) =>
    row?.value == null ? [] : [`${x(i).toFixed(1)},${y(row.value).toFixed(1)}`],
  );
  return html`<svg class="trend" viewBox="0 0 ${WIDE} ${HIGH}" aria-hidden="true">
    ${(limits ?? []).map((limit) => (limit === null ? '' : svg`<line class="limit" x1="0" x2=${WIDE} y1=${y(limit)} y2=${y(limit)} />`))}
    ${svg`<polyline points=${line.join(' ')} />`}
    ${values.map((row, i) => (row?.value == null ? '' : svg`<circle class=${row.verdict ?? ''} cx=${x(i)} cy=${y(row.value)} r="3" />`))}
  </svg>`;
}

function table(parts: readonly SeriesPart[]): TemplateResult {
  const names = [...new Set(parts.flatMap(({ rows }) => rows.map(({ name }) => name)))];
  return html`<ol class="parts">
      ${parts.map(
        ({ name, serial, verdict }) =>
          html`<li>
            <span class="dot ${verdict ? DOTS[verdict] : ''}"></span><b>${serial || name}</b>
            <span class="quiet">${t(verdict ? `inspect.${verdict}` : 'series.open')}</span>
          </li>`,
      )}
    </ol>
    <table class="table series">
      <tbody class="num">
        ${names.map((name) => {
          const values = parts.map(({ rows }) => rows.find((row) => row.name === name));
          const last = values.at(-1);
          return html`<tr>
            <th scope="row">${name}</th>
            <td>${last?.value == null ? '·' : number(last.value, last.unit === 'mm' ? 4 : 3)}</td>
            <td>${trend(values)}</td>
          </tr>`;
        })}
      </tbody>
    </table>`;
}

/** The parts that were inspected by the same plan, and the next one. */
export function series(app: App, found: Inspection | null): TemplateResult | string {
  const { inspecting, project } = app;
  const off = app.occupied || app.session.watches;
  if (!found && project.series.length === 0) return '';
  const choose = (event: Event) => {
    const input = event.target as HTMLInputElement;
    const file = input.files?.[0];
    input.value = '';
    if (file) void inspecting.next(file, (one, format) => app.opening.into(one, format));
  };
  return html`<section class="group" id="series-group">
    <h2>${t('series.title')}</h2>
    ${project.series.length > 0 ? table(partsOf(app, found)) : html`<p class="quiet">${t('series.lead')}</p>`}
    <div class="pair">
      ${
        project.can_scan
          ? html`<button class="btn" id="next-part" ?disabled=${off} @click=${() => void inspecting.next()}>
              ${t('series.scan')}
            </button>`
          : ''
      }
      <label class="btn choose"
        >${icon('folder')}${t('series.file')}
        <input
          id="next-file"
          class="sr"
          type="file"
          accept=${accepted(MESH_FORMATS)}
          ?disabled=${off}
          @change=${choose}
        />
      </label>
    </div>
  </section>`;
}
