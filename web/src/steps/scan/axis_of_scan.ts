import { html, type TemplateResult } from 'lit';
import type { App } from '../../parts';
import { icon } from '../../icons';
import { number, t } from '../../messages';
import { axisIsKnown } from '../../rig_facts';
import { capitalized, plain } from '../../ui';

/** Fewer views do not show an axis; the server keeps the same limit. */
const FEWEST_STATIONS = 3;

/** Whether the scan has several stations and the axis of its turntable is unknown. */
export const lacksAxis = (app: App): boolean =>
  app.project.can_scan && app.project.stations.length > 1 && !axisIsKnown(app);

/** Whether the scan itself can be asked for the axis. */
export const scanMayShowAxis = (app: App): boolean => lacksAxis(app) && app.project.stations.length >= FEWEST_STATIONS;

/** What a scan is started with: one that lacks the axis finds it. */
export const scanArguments = (app: App): { find_axis?: true } => (lacksAxis(app) ? { find_axis: true } : {});

const toWizard = (app: App, primary: boolean): TemplateResult =>
  html`<button class="btn ${primary ? 'primary' : ''} wide" id="to-axis" @click=${() => app.go('rig')}>
    ${t('scan.toAxis')}${icon('arrow')}
  </button>`;

/** Before the scan: where the axis is found. The check card offers the scan itself. */
export const axisFirst = (app: App): TemplateResult =>
  html`<p class="bad axis-first">${t('scan.noAxis')}</p>
    ${toWizard(app, true)}`;

/** After a scan that lacks the axis, in the place of the button that builds the surface. */
export function axisAfter(app: App): TemplateResult {
  const { project } = app;
  const job = app.job('axis');
  if (job)
    return html`<p class="next">${t('scan.axisSought')}</p>
      <button class="btn wide" @click=${() => app.command('stop-job', { job: job.number })}>${t('axis.stop')}</button>`;
  const off = app.occupied || app.session.watches;
  if (project.axis_fault)
    return html`<div id="axis-fault">
        <p class="bad">${capitalized(plain(project.axis_fault))}</p>
        <p class="quiet">${t('scan.framesKept')}</p>
      </div>
      ${toWizard(app, true)}`;
  return html`<p class="bad">${t('scan.noAxis')}</p>
    <button
      class="btn primary wide"
      id="axis-of-scan"
      ?disabled=${off}
      @click=${() => app.command('find-axis', { scan: true })}
    >
      ${t('scan.axisOfScan')}
    </button>
    ${toWizard(app, false)}`;
}

/** Says that the scan itself has shown the axis. */
export function axisFound(app: App): TemplateResult | string {
  const { axis } = app.project;
  if (!axis?.of_scan) return '';
  const values = {
    views: axis.views,
    direction: number(axis.axis_sigma_deg, 3),
    place: number(axis.point_sigma_mm, 3),
  };
  return html`<p class="quiet" id="axis-found"><span class="dot done"></span>${t('scan.axisFound', values)}</p>`;
}
