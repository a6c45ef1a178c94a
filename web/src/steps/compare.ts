import { html, type TemplateResult } from 'lit';

import type { App } from '../app';
import { icon } from '../icons';
import { number, t } from '../messages';
import type { Comparison } from '../types';
import { choice } from '../ui';

/** With three digits and its sign, which a value that rounds to zero does not have. */
export const signed = (value: number | null): string => {
  if (value === null) return '·';
  const sign = Math.abs(value) < 0.0005 ? '' : value > 0 ? '+' : '−';
  return `${sign}${number(Math.abs(value), 3)}`;
};
const percent = (share: number): string => number(100 * share, 1);

/** The choice among poses that fit alike. */
function poses(app: App, found: Comparison): TemplateResult | string {
  if (found.poses.length < 2) return '';
  const [lower, upper] = found.tolerance_mm;
  return html`<p><span class="dot poor"></span>${t('compare.poses', { count: found.poses.length })}</p>
    <label class="field"
      ><span>${t('compare.pose')}</span>
      <select
        id="start"
        ?disabled=${app.occupied || app.session.watches}
        @change=${(event: Event) => void app.comparing.compare(lower, upper, Number((event.target as HTMLSelectElement).value))}
      >
        ${found.poses.map((pose, i) => html`<option value=${i + 1} ?selected=${i + 1 === found.start}>${i + 1}: ${number(pose.turned_deg, 1)}°, ${number(pose.moved_mm, 1)} mm, RMS ${pose.rms_mm === null ? '·' : number(pose.rms_mm, 4)} mm</option>`)}
      </select></label
    >`;
}

function result(app: App, found: Comparison): TemplateResult {
  const row = (key: Parameters<typeof t>[0], value: string, unit: string) =>
    html`<dt>${t(key)}</dt>
      <dd class="num">${value}<span>${unit}</span></dd>`;
  return html`<p class="verdict-line ${found.verdict}">
      <span class="dot ${found.verdict === 'in' ? 'done' : found.verdict === 'out' ? 'bad' : 'poor'}"></span
      ><b>${t(`compare.${found.verdict}`)}</b>
    </p>
    <p class="quiet">${found.sentence}</p>
    <dl class="figures">
      ${row('compare.inShare', percent(found.in_share), '%')} ${row('compare.outShare', percent(found.out_share), '%')}
      ${row('compare.openShare', percent(found.undecided_share), '%')}
      ${row('compare.notMeasured', percent(found.not_measured_share), '%')}
      ${row('compare.range', `${signed(found.min_mm)} … ${signed(found.max_mm)}`, 'mm')}
      ${row('compare.mean', signed(found.mean_mm), 'mm')}
      ${row('compare.rms', found.rms_mm === null ? '·' : number(found.rms_mm, 3), 'mm')}
      ${found.median_u_mm === null ? '' : row('compare.u', number(1000 * found.median_u_mm, 1), 'µm')}
    </dl>
    <p class="quiet">
      ${
        found.best_fit
          ? t('compare.fitted', {
              turned: number(found.turned_deg, 2),
              moved: number(found.moved_mm, 2),
              overlap: percent(found.overlap),
            })
          : t('compare.stands', { overlap: percent(found.overlap) })
      }
      ${found.left_out ? t('compare.leftOut', { count: number(found.left_out) }) : ''}
    </p>
    ${poses(app, found)}
    ${found.free_directions.map((motion) => html`<p class="quiet">${t('compare.free', { motion })}</p>`)}`;
}

/** A reference, how the surface is laid onto it, the tolerance, and what came out. */
export function comparing(app: App): TemplateResult {
  const { reference, surface } = app.project;
  const off = app.occupied || app.session.watches;
  const choose = (event: Event) => {
    const input = event.target as HTMLInputElement;
    const file = input.files?.[0];
    input.value = '';
    if (file) void app.comparing.send(file);
  };
  const run = (event: SubmitEvent) => {
    event.preventDefault();
    const form = new FormData(event.target as HTMLFormElement);
    void app.comparing.compare(Number(form.get('lower')), Number(form.get('upper')));
  };
  const [lower, upper] = surface?.comparison?.tolerance_mm ?? [-0.1, 0.1];
  return html`<section class="group" id="compare-group">
    <h2>${t('compare.title')}</h2>
    ${reference ? html`<div class="file"><b>${reference.name}</b></div>` : html`<p class="quiet">${t('compare.lead')}</p>`}
    <label class="btn wide choose">
      ${icon('folder')}${app.comparing.sent === null ? t(reference ? 'compare.other' : 'compare.choose') : t('compare.sending', { share: number(100 * app.comparing.sent) })}
      <input
        id="reference"
        class="sr"
        type="file"
        accept=".stl,.ply,.obj,.3mf,.step,.stp"
        ?disabled=${off || app.comparing.sent !== null}
        @change=${choose}
      />
    </label>
    ${
      reference
        ? html`${choice(
              t('compare.align'),
              app.comparing.align,
              [
                ['best-fit', t('compare.bestFit')],
                ['none', t('compare.none')],
              ] as const,
              (align) => app.comparing.setAlign(align),
            )}
            <form class="row" @submit=${run}>
              <label class="field grow"
                ><span>${t('compare.lower')}</span
                ><input class="num" name="lower" type="number" step="any" required .defaultValue=${String(lower)}
              /></label>
              <label class="field grow"
                ><span>${t('compare.upper')}</span
                ><input class="num" name="upper" type="number" step="any" required .defaultValue=${String(upper)}
              /></label>
              <button class="btn" id="compare" ?disabled=${off}>${t('compare.run')}</button>
            </form>`
        : ''
    }
    ${surface?.comparison ? result(app, surface.comparison) : ''}
  </section>`;
}
