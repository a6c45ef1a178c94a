import { html, svg, type TemplateResult } from 'lit';

import type { App } from '../../parts';
import { accepted, REFERENCE_FORMATS } from '../../file_formats';
import { icon } from '../../icons';
import { number, t } from '../../messages';
import { numeric } from '../../number_field';
import { numberIn, shownNumber } from '../../written_numbers';
import type { Plan } from '../../inspection_types';
import type { Comparison, Inspection, MeasuredRow } from '../../types';
import { choice, nextStep } from '../../ui';
import { type Term, term } from '../../terms';
import { accepting } from './accept';
import { planned } from './plan';
import { reporting } from './report';
import { series } from './series';
import { signed, verdict } from './verdict';

const percent = (share: number): string => number(100 * share, 1);

type Verdict = Inspection['verdict'];
const DOTS: Record<Verdict, string> = { in: 'done', out: 'bad', undecided: 'poor' };

/** The tolerance, how much of it is used, and where the value stands in it. */
function bar(row: MeasuredRow): TemplateResult | string {
  if (row.used === null || row.verdict === null) return '';
  const WIDTH = 100;
  const used = Math.min(1.2, row.used);
  return html`<svg
    class="tolerance-bar ${row.verdict}"
    viewBox="0 0 120 8"
    preserveAspectRatio="none"
    aria-hidden="true"
  >
    ${svg`<rect class="whole" width=${WIDTH} height="8" /><rect class="part" width=${WIDTH * used} height="8" />
      <line x1=${WIDTH} x2=${WIDTH} y1="0" y2="8" />`}
  </svg>`;
}

function limitsOf({ limits, nominal, unit }: MeasuredRow): string {
  if (!limits) return '';
  const [lower, upper] = limits;
  const digits = unit === 'mm' ? 3 : 2;
  if (nominal !== null && lower !== null && upper !== null)
    return `${number(nominal, digits)} ${signed(lower - nominal, digits)} ${signed(upper - nominal, digits)}`;
  return `≤ ${number(upper ?? 0, digits)}`;
}

/** The table of results. */
function rows(found: Inspection): TemplateResult | string {
  if (found.characteristics.length === 0) return '';
  const value = (one: number | null, unit: string) => (one === null ? '·' : number(one, unit === 'mm' ? 4 : 3));
  return html`<section class="group ${found.current ? '' : 'outdated'}">
    <h2>${t('inspect.results')}</h2>
    <table class="table results">
      <thead>
        <tr>
          <th>${t('inspect.characteristic')}</th>
          <th>${t('inspect.measured')}</th>
          <th>${t('inspect.deviation')}</th>
          <th>U95${term('U95')}</th>
        </tr>
      </thead>
      <tbody class="num">
        ${found.characteristics.map(
          (row) =>
            html`<tr data-row=${row.name}>
                <th scope="row"><span class="dot ${row.verdict ? DOTS[row.verdict] : ''}"></span>${row.name}</th>
                <td>${row.value === null ? t('inspect.notFound') : value(row.value, row.unit)}</td>
                <td>${row.nominal === null || row.value === null ? '' : signed(row.value - row.nominal, 4)}</td>
                <td>${value(row.u95, row.unit)}</td>
              </tr>
              <tr class="more">
                <td colspan="2">
                  ${row.limits ? `${limitsOf(row)} ${row.unit === 'mm' ? 'mm' : '°'}` : ''}
                  ${row.verdict ? html`<span class="sr">${t(`inspect.${row.verdict}`)}</span>` : ''}
                </td>
                <td colspan="2">${bar(row)}</td>
              </tr>`,
        )}
      </tbody>
    </table>
  </section>`;
}

/** The choice among poses that fit alike. */
function poses(app: App, found: Comparison): TemplateResult | string {
  if (found.poses.length < 2) return '';
  return html`<p><span class="dot poor"></span>${t('inspect.poses', { count: found.poses.length })}</p>
    <label class="field"
      ><span>${t('inspect.pose')}</span>
      <select
        id="start"
        ?disabled=${app.occupied || app.session.watches}
        @change=${(event: Event) => void app.inspecting.change({ start: Number((event.target as HTMLSelectElement).value) })}
      >
        ${found.poses.map((pose, i) => html`<option value=${i + 1} ?selected=${i + 1 === found.start}>${i + 1}: ${number(pose.turned_deg, 1)}°, ${number(pose.moved_mm, 1)} mm, RMS ${pose.rms_mm === null ? '·' : number(pose.rms_mm, 4)} mm</option>`)}
      </select></label
    >`;
}

function deviations(app: App, found: Comparison): TemplateResult {
  const row = (key: Parameters<typeof t>[0], value: string, unit: string, of?: Term) =>
    html`<dt>${t(key)}${of ? term(of) : ''}</dt>
      <dd class="num">${value}<span>${unit}</span></dd>`;
  const current = app.inspecting.found?.current ?? true;
  return html`<section class="group ${current ? '' : 'outdated'}">
    <h2>${t('inspect.surface')}</h2>
    <p class="quiet">
      ${
        app.inspecting.plan.align === 'none'
          ? t('inspect.stands', { overlap: percent(found.overlap) })
          : t(app.inspecting.plan.align === 'points' ? 'inspect.byPoints' : 'inspect.fitted', {
              turned: number(found.turned_deg, 2),
              moved: number(found.moved_mm, 2),
              overlap: percent(found.overlap),
              count: (app.inspecting.plan.points ?? []).length,
            })
      }
      ${found.left_out ? t('inspect.leftOut', { count: number(found.left_out) }) : ''}
    </p>
    ${found.free_directions.map((motion) => html`<p class="quiet">${t('inspect.free', { motion })}</p>`)}
    <dl class="figures">
      ${row('inspect.inShare', percent(found.in_share), '%')} ${row('inspect.outShare', percent(found.out_share), '%')}
      ${row('inspect.openShare', percent(found.undecided_share), '%')}
      ${row('inspect.notMeasured', percent(found.not_measured_share), '%', 'coverage')}
      ${row('inspect.range', `${signed(found.min_mm)} … ${signed(found.max_mm)}`, 'mm')}
      ${row('inspect.mean', signed(found.mean_mm), 'mm')}
      ${row('inspect.rms', found.rms_mm === null ? '·' : number(found.rms_mm, 3), 'mm')}
      ${found.median_u_mm === null ? '' : row('inspect.u', number(1000 * found.median_u_mm, 1), 'µm')}
    </dl>
  </section>`;
}

/** Up to three features that the part is put on, in their order. */
function datums(app: App, plan: Plan): TemplateResult {
  const names = (plan.features ?? []).map(({ name }) => name);
  const set = (at: number, name: string) => {
    const next = [...(plan.datums ?? [])];
    next[at] = name;
    void app.inspecting.change({ align: 'datum', datums: next.filter((one) => one) });
  };
  return html`<div class="row datums">
    ${['A', 'B', 'C'].map(
      (letter, i) =>
        html`<label class="field grow"
          ><span>${letter}${i === 0 ? term('datum') : ''}</span>
          <select
            ?disabled=${app.occupied || app.session.watches || i > (plan.datums ?? []).length}
            @change=${(event: Event) => set(i, (event.target as HTMLSelectElement).value)}
          >
            <option value="">·</option>
            ${names.map((name) => html`<option ?selected=${plan.datums?.[i] === name}>${name}</option>`)}
          </select></label
        >`,
    )}
  </div>`;
}

/** A reference, how the surface is laid onto it, and the tolerance. */
function reference(app: App): TemplateResult {
  const { inspecting } = app;
  const { reference: known, surface } = app.project;
  const { plan } = inspecting;
  const off = app.occupied || app.session.watches;
  const choose = (event: Event) => {
    const input = event.target as HTMLInputElement;
    const file = input.files?.[0];
    input.value = '';
    if (file) void inspecting.send(file);
  };
  const run = (event: SubmitEvent) => {
    event.preventDefault();
    const form = new FormData(event.target as HTMLFormElement);
    void inspecting.change({ tolerance_mm: [numberIn(form, 'lower') ?? NaN, numberIn(form, 'upper') ?? NaN] });
  };
  const [lower, upper] = plan.tolerance_mm ?? [-0.1, 0.1];
  const align = (how: NonNullable<Plan['align']>) => {
    if (how === 'points' && (plan.points ?? []).length < 3) return void app.pairing.begin('points');
    const first = plan.features?.[0]?.name;
    void inspecting.change({
      align: how,
      ...(how === 'datum' && !plan.datums?.length && first ? { datums: [first] } : {}),
    });
  };
  return html`<section class="group" id="reference-group">
    <h2>${t('inspect.reference')}</h2>
    ${known ? html`<div class="file"><b>${known.name}</b></div>` : html`<p class="quiet">${t('inspect.lead')}</p>`}
    <label class="btn ${known || surface?.inspection ? '' : 'primary'} wide choose">
      ${icon('folder')}${inspecting.sent === null ? t(known ? 'inspect.other' : 'inspect.choose') : t('inspect.sending', { share: number(100 * inspecting.sent) })}
      <input
        id="reference"
        class="sr"
        type="file"
        accept=${accepted(REFERENCE_FORMATS)}
        ?disabled=${off || inspecting.sent !== null}
        @change=${choose}
      />
    </label>
    ${
      known
        ? html`${choice<NonNullable<Plan['align']>>(
              t('inspect.align'),
              plan.align ?? 'none',
              [
                ['best-fit', t('inspect.bestFit')],
                ...(plan.features?.length ? ([['datum', t('inspect.datum')]] as const) : []),
                ['points', t('inspect.points')],
                ['none', t('inspect.none')],
              ],
              align,
            )}
            ${plan.align === 'datum' ? datums(app, plan) : ''} ${app.pairing.panel(plan, off)}
            ${surface?.comparison ? poses(app, surface.comparison) : ''}
            <p class="quiet">${t('inspect.tolerance')}</p>
            <form class="row" @submit=${run}>
              <label class="field grow"
                ><span>${t('inspect.lower')}</span
                ><input
                  class="num"
                  name="lower"
                  required
                  .defaultValue=${shownNumber(lower)}
                  ${numeric({ step: 0.01 })}
              /></label>
              <label class="field grow"
                ><span>${t('inspect.upper')}</span
                ><input
                  class="num"
                  name="upper"
                  required
                  .defaultValue=${shownNumber(upper)}
                  ${numeric({ step: 0.01 })}
              /></label>
              <button class="btn" id="inspect" ?disabled=${off}>${t('inspect.run')}</button>
            </form>`
        : ''
    }
  </section>`;
}

/** How the surface is judged, and whether walls are measured. */
function rule(app: App): TemplateResult {
  const { inspecting } = app;
  const { plan } = inspecting;
  const off = app.occupied || app.session.watches;
  const walls = app.project.surface?.inspection?.thickness_mm;
  const change = (event: SubmitEvent) => {
    event.preventDefault();
    const form = new FormData(event.target as HTMLFormElement);
    const of = (name: string) => numberIn(form, name);
    void inspecting.change({
      min_feature_mm: of('patch'),
      edge_mm: of('edge'),
      min_coverage: (of('coverage') ?? 90) / 100,
      max_gap_mm: of('gap'),
    });
  };
  const input = (name: 'patch' | 'edge' | 'coverage' | 'gap', value: number | null | undefined, usual: string) =>
    html`<label class="field"
      ><span>${t(`inspect.rule.${name}`)}${name === 'patch' || name === 'gap' ? term(name) : ''}</span
      ><input
        class="num"
        name=${name}
        placeholder=${usual}
        ?disabled=${off}
        .defaultValue=${shownNumber(value || null)}
        ${numeric({ min: 0, max: name === 'coverage' ? 100 : 10_000 })}
    /></label>`;
  return html`<section class="group" id="rule-group">
    <label class="switch"
      >${t('inspect.thickness')}<input
        type="checkbox"
        name="thickness"
        ?disabled=${off}
        .checked=${plan.thickness ?? false}
        @change=${(event: Event) => void inspecting.change({ thickness: (event.target as HTMLInputElement).checked })}
    /></label>
    ${
      walls
        ? html`<dl class="figures" id="walls">
            ${(['thinnest', 'median', 'thickest'] as const).map(
              (name, i) =>
                html`<dt>${t(`inspect.wall.${name}`)}</dt>
                  <dd class="num">${walls[i] == null ? '·' : number(walls[i], 3)}<span>mm</span></dd>`,
            )}
          </dl>`
        : ''
    }
    <details>
      <summary>${t('inspect.rule')}</summary>
      <form class="rule" @submit=${change}>
        ${input('patch', plan.min_feature_mm, t('inspect.rule.auto'))}
        ${input('edge', plan.edge_mm, t('inspect.rule.auto'))}
        ${input('coverage', plan.min_coverage === undefined ? null : 100 * plan.min_coverage, '90')}
        ${input('gap', plan.max_gap_mm, t('inspect.rule.auto'))}
        <button class="btn" ?disabled=${off}>${t('inspect.set')}</button>
      </form>
    </details>
  </section>`;
}

export function inspectStep(app: App): TemplateResult {
  const { surface } = app.project;
  const found = surface?.inspection ?? null;
  return html`${found ? verdict(app, found) : ''} ${reference(app)} ${found ? rows(found) : ''} ${planned(app, found)}
  ${surface?.comparison ? deviations(app, surface.comparison) : ''} ${rule(app)} ${app.measuring.panel()}
  ${reporting(app, found)} ${series(app, found)} ${accepting(app)} ${nextStep(app, 'export', Boolean(found))}`;
}
