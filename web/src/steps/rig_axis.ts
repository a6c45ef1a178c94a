import { html, type TemplateResult } from 'lit';
import type { App } from '../app';
import { number, t } from '../messages';

/** Whether a scan of several stations can be built: the axis about which they turn is known. */
export const axisIsKnown = (app: App): boolean => !app.project.rig || app.project.rig.turntable !== null;

/** Whether the rig turns its part. */
export const hasTable = (app: App): boolean => app.project.devices.some(({ table }) => table === 'turntable');

/** A number of the board, or of its poses. */
export const boardField = (name: string, label: string, value: number, step = 1): TemplateResult =>
  html`<label class="field"
    ><span>${label}</span
    ><input
      class="num"
      name=${name}
      type="number"
      min=${step < 1 ? 0.1 : 3}
      max="100"
      step=${step}
      required
      .defaultValue=${String(value)}
  /></label>`;

/** What describes a checkerboard. */
export const boardFields = (): TemplateResult =>
  html`${boardField('columns', t('rig.columns'), 10)}${boardField('rows', t('rig.rows'), 7)}${boardField('square_mm', t('rig.square'), 14, 0.01)}`;

/** The board of a form with these fields. */
export function boardOf(form: FormData): Record<string, number> {
  return Object.fromEntries(['columns', 'rows', 'square_mm'].map((name) => [name, Number(form.get(name))]));
}

/** The card that finds the axis of the turntable with the board of the calibration. */
export function axisCard(app: App): TemplateResult | string {
  const { project } = app;
  if (!project.rig || !project.can_scan || !hasTable(app)) return '';
  if (axisIsKnown(app) && !project.rig.calibration && !project.axis) return '';
  const job = app.job('axis');
  const found = project.axis;
  const known = axisIsKnown(app);
  const ownBoard = project.residuals_s > 0; // that of the calibration here
  const find = (event: SubmitEvent) => {
    event.preventDefault();
    void app.command('find-axis', ownBoard ? {} : boardOf(new FormData(event.target as HTMLFormElement)));
  };
  return html`<section class="group" id="axis">
    <h2>
      ${t('axis.title')}${known && found ? html`<small class="num">± ${number(found.axis_sigma_deg, 3)}°</small>` : ''}
    </h2>
    ${
      found
        ? html`<dl class="figures">
            <dt>${t('axis.place')}</dt>
            <dd class="num">± ${number(found.point_sigma_mm, 3)}<span>mm</span></dd>
            <dt>${t('axis.distance')}</dt>
            <dd class="num">${number(found.distance_mm, 1)}<span>mm</span></dd>
            <dt>${t('axis.angles')}</dt>
            <dd class="num">${number(found.angles_rms_deg, 3)}°</dd>
            <dt>${t('axis.views')}</dt>
            <dd class="num">${found.views}</dd>
          </dl>`
        : html`<p class="quiet">${t(known ? 'axis.known' : 'axis.unknown')}</p>`
    }
    ${
      job
        ? html`<p class="next">${t('axis.turning')}</p>
            <button class="btn wide" @click=${() => app.command('stop-job', { job: job.number })}>
              ${t('axis.stop')}
            </button>`
        : html`<form class="form-plain" @submit=${find}>
            ${ownBoard ? '' : html`<div class="four">${boardFields()}</div>`}
            <button
              class="btn ${known ? '' : 'primary'} wide"
              id="find-axis"
              ?disabled=${app.occupied || project.scan_begun}
            >
              ${t(known ? 'axis.again' : 'axis.find')}
            </button>
          </form>`
    }
  </section>`;
}
