import { html } from 'lit';
import type { App } from '../../parts';
import { number, t } from '../../messages';
import { axisIsKnown, hasTable } from '../../rig_facts';
import { choice } from '../../ui';
import type { AxisBy } from '../../arranging';
import { boardFields, boardOf } from './board';
import type { RigStage } from './stages';

/** Finds the axis of the turntable by the board of the calibration, or by any part. Null without a turntable. */
export function axisStage(app: App): RigStage | null {
  const { project } = app;
  if (!project.can_scan || !hasTable(app)) return null;
  const job = app.job('axis');
  const found = project.axis;
  const known = axisIsKnown(app);
  const byPart = app.arranging.axisBy === 'part';
  const ownBoard = project.residuals_s > 0; // that of the calibration here
  const find = (event: SubmitEvent) => {
    event.preventDefault();
    const board = byPart ? { part: true } : ownBoard ? {} : boardOf(new FormData(event.target as HTMLFormElement));
    void (async () => {
      if (!known || (await app.asking.confirm(t('axis.ask'), t('axis.again')))) await app.command('find-axis', board);
    })();
  };
  const body = html`${
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
          </dl>
          ${found.of_scan ? html`<p class="quiet">${t('axis.ofScan')}</p>` : ''}`
      : html`<p class="quiet">${t(!project.rig ? 'axis.later' : known ? 'axis.known' : 'axis.unknown')}</p>
          ${project.rig ? html`<p class="quiet">${t(byPart ? 'axis.standPart' : 'axis.standBoard')}</p>` : ''}`
  }
  ${
    !project.rig
      ? ''
      : job
        ? html`<p class="next">${t('axis.turning')}</p>
            <button class="btn wide" @click=${() => app.command('stop-job', { job: job.number })}>
              ${t('axis.stop')}
            </button>`
        : html`<form class="form-plain" @submit=${find}>
            ${choice<AxisBy>(
              t('axis.by'),
              app.arranging.axisBy,
              [
                ['board', t('axis.byBoard')],
                ['part', t('axis.byPart')],
              ],
              (by) => app.arranging.setAxisBy(by),
            )}
            ${ownBoard || byPart ? '' : html`<div class="four">${boardFields()}</div>`}
            <button
              class="btn ${known ? '' : 'primary'} wide"
              id="find-axis"
              ?disabled=${app.occupied || app.session.watches || (project.scan_begun && known)}
            >
              ${t(known ? 'axis.again' : 'axis.find')}
            </button>
          </form>`
  }`;
  return {
    name: 'axis',
    title: t('axis.title'),
    summary: !project.rig
      ? ''
      : found
        ? `± ${number(found.axis_sigma_deg, 3)}°`
        : t(known ? 'axis.isKnown' : 'axis.isUnknown'),
    state: !project.rig ? '' : known ? 'done' : 'bad',
    due: Boolean(project.rig) && !known,
    body,
  };
}
