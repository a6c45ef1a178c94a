import { html, type TemplateResult } from 'lit';
import type { App } from '../app';
import { dial } from '../dial';
import { icon } from '../icons';
import { number, t } from '../messages';
import type { Station } from '../types';
import { numberForm, span } from '../ui';

function note(app: App): string {
  const job = app.job('scan');
  if (job && job.progress > 0.02) return t('scan.left', { time: span((job.seconds * (1 - job.progress)) / job.progress) });
  if (job) return job.stage;
  return app.project.scan_complete ? t('scan.complete') : t('scan.stationsNoun');
}

const dot = (station: Station): string =>
  station.state === 'done' && station.verdict && !station.good ? 'poor' : station.state;

export function scanStep(app: App): TemplateResult {
  const { project } = app;
  const job = app.job('scan');
  const begun = project.stations.some((station) => station.state !== 'waiting');
  const measured = project.stations.some((station) => station.points > 0);
  return html`<section class="group">
      ${dial(project.stations, job?.progress ?? 0, note(app))}
      ${job
        ? html`<button class="btn wide" @click=${() => app.command('stop-job', { job: job.number })}>${icon('pause')}${t('scan.pause')}</button>`
        : project.scan_complete
          ? html`<button class="btn primary wide" id="build" ?disabled=${app.occupied} @click=${() => app.build()}>${t('scan.build')}${icon('arrow')}</button>`
          : project.table_angle
            ? numberForm('table-angle', t('scan.tableAngle'), project.table_angle.last_deg ?? 0, t('scan.continue'), app.occupied,
                (angle) => void app.command('start-scan', { table_deg: angle }))
          : project.can_scan
            ? html`<button class="btn primary wide" id="scan" ?disabled=${app.occupied} @click=${() => app.command('start-scan')}>
                ${icon('play')}${begun ? t('scan.continue') : t('scan.start')}
              </button>`
            : ''}
      <p class="quiet">
        ${!job && begun && !project.scan_complete ? t('scan.resume') : project.can_scan ? t('scan.lead') : t('scan.noRig')}
      </p>
    </section>
    <section class="group">
      <table class="table">
        <thead>
          <tr>
            <th>${t('scan.angle')}</th>
            ${measured || begun ? html`<th>${t('scan.contrast')}</th><th>${t('scan.saturated')}</th><th>${t('scan.points')}</th>` : ''}
          </tr>
        </thead>
        <tbody class="num">
          ${project.stations.map(
            (station, i) => html`<tr title=${station.verdict}>
              <td>
                ${station.state === 'done' || station.state === 'skipped'
                  ? html`<button class="rescan" title=${t('scan.rescan')} aria-label="${t('scan.rescan')}: ${number(station.angle_deg, 1)}°" ?disabled=${app.occupied || !project.can_scan}
                      @click=${() => app.command('rescan-station', { station: i })}><span class="dot ${dot(station)}"></span>${icon('again')}</button>`
                  : html`<span class="dot ${dot(station)}"></span>`}<span class="angle">${number(station.angle_deg, 1)}°</span></td>
              ${measured || begun
                ? station.points
                  ? html`<td>${number(station.contrast, 2)}</td><td>${number(100 * station.saturated, 1)} %</td><td>${number(station.points)}</td>`
                  : html`<td>·</td><td>·</td><td>·</td>`
                : ''}
            </tr>`,
          )}
        </tbody>
      </table>
      ${project.stations
        .filter((station) => station.verdict && !station.good)
        .map((station) => html`<p><span class="dot poor"></span>${number(station.angle_deg, 1)}°: ${station.verdict}</p>`)}
    </section>`;
}
