import { html, type TemplateResult } from 'lit';
import type { App } from '../app';
import { number, t } from '../messages';
import { boardFields, boardOf } from './rig_board';

/** Whether a scan of several stations can be built: the axis about which they turn is known. */
export const axisIsKnown = (app: App): boolean => !app.project.rig || app.project.rig.turntable !== null;

/** Whether the rig turns its part. */
export const hasTable = (app: App): boolean => app.project.devices.some(({ table }) => table === 'turntable');

/** The card that finds the axis of the turntable with the board of the calibration. */
export function axisCard(app: App): TemplateResult | string {
  const { project } = app;
  if (!project.rig || !project.can_scan || !hasTable(app)) return '';
  if (project.rig_adjustable && axisIsKnown(app) && !project.axis) return '';
  const job = app.job('axis');
  const found = project.axis;
  const known = axisIsKnown(app);
  const ownBoard = project.residuals_s > 0; // that of the calibration here
  const find = (event: SubmitEvent) => {
    event.preventDefault();
    const board = ownBoard ? {} : boardOf(new FormData(event.target as HTMLFormElement));
    void (async () => {
      if (!known || (await app.asking.confirm(t('axis.ask'), t('axis.again')))) await app.command('find-axis', board);
    })();
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
            ${ownBoard ? '' : html`<div class="four">${boardFields(app)}</div>`}
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
