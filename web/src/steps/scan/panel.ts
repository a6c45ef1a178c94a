import { html, type TemplateResult } from 'lit';
import type { App } from '../../parts';
import { dial } from '../../dial';
import { icon } from '../../icons';
import { number, stageName, t } from '../../messages';
import type { Station } from '../../types';
import { nextStep, numberForm, plain, span } from '../../ui';
import { axisAfter, axisFirst, axisFound, lacksAxis, scanArguments } from './axis_of_scan';
import { scanCheck } from './check';
import { presentSetup } from '../../setups';
import { joins, nextSetup, setupChoice } from './setups';

/** Whether the present setup is captured. */
const done = (app: App): boolean =>
  app.project.scan_complete &&
  app.project.stations.every((station) => station.state === 'done' || station.state === 'skipped');

/** Share of the present setup that is captured; the job counts the stations of all setups. */
function progressOf(app: App): number {
  const { stations } = app.project;
  const own = stations.filter((station) => station.setup === presentSetup(stations)).length;
  return Math.max(0, ((app.job('scan')?.progress ?? 0) * stations.length - (stations.length - own)) / Math.max(1, own));
}

function note(app: App): string {
  const job = app.job('scan');
  const progress = progressOf(app);
  if (job && progress > 0.02) return t('scan.left', { time: span((job.seconds * (1 - progress)) / progress) });
  if (job) return stageName(job.stage);
  return done(app) ? t('scan.complete') : t('scan.stationsNoun');
}

const dot = (station: Station): string =>
  station.state === 'done' && station.verdict && !station.good ? 'poor' : station.state;

export function scanStep(app: App): TemplateResult {
  const { project } = app;
  const job = app.job('scan');
  const present = presentSetup(project.stations);
  const shown = app.setups.shown;
  const all = project.stations
    .map((station, place) => ({ station, place }))
    .filter(({ station }) => station.setup === shown);
  const stations = all.map(({ station }) => station);
  // Frames of the first station may be there although no station is complete yet.
  const begun =
    (project.scan_begun && !project.scan_complete) ||
    project.stations.some((station) => station.setup === present && station.state !== 'waiting');
  const measured = stations.some((station) => station.points > 0);
  const complete = done(app);
  const before = !job && !begun && !complete;
  const resumed = !job && begun && !complete;
  const lead = resumed
    ? t('scan.resume')
    : !project.can_scan
      ? t('scan.noRig')
      : before || (complete && lacksAxis(app))
        ? ''
        : t('scan.lead');
  // A mesh that was dropped has neither stations nor devices.
  if (!project.can_scan && !project.scan_complete && !begun && !job)
    return html`<section class="group"><p class="quiet">${t('live.noDevices')}</p></section>
      ${nextStep(app, 'rig')}`;
  if (app.setups.turning && complete && !job) return nextSetup(app);
  return html`<section class="group">
      ${setupChoice(app)}
      ${dial(stations, shown === present ? progressOf(app) : 0, shown === present ? note(app) : t('scan.complete'))}
      ${
        job
          ? html`<button class="btn wide" @click=${() => app.command('stop-job', { job: job.number })}>
              ${icon('pause')}${t('scan.pause')}
            </button>`
          : complete && lacksAxis(app)
            ? axisAfter(app)
            : complete
              ? html`<form class="form-plain" novalidate @submit=${app.building.submit}>
                  <button class="btn primary wide" id="build" ?disabled=${app.occupied}>
                    ${t('scan.build')}${icon('arrow')}
                  </button>
                  <details class="more" id="build-options">
                    <summary>${t('build.options')}</summary>
                    <div class="form-plain">${app.building.fields()}</div>
                  </details>
                </form>`
              : project.table_angle
                ? numberForm(
                    'table-angle',
                    t('scan.tableAngle'),
                    project.table_angle.last_deg ?? 0,
                    t('scan.continue'),
                    app.occupied,
                    (angle) => void app.command('start-scan', { table_deg: angle, ...scanArguments(app) }),
                  )
                : !begun && lacksAxis(app)
                  ? axisFirst(app)
                  : project.can_scan
                    ? html`<button
                        class="btn primary wide"
                        id="scan"
                        ?disabled=${app.occupied}
                        @click=${() => app.command('start-scan', scanArguments(app))}
                      >
                        ${icon('play')}${begun ? t('scan.continue') : t('scan.start')}
                      </button>`
                    : ''
      }
      ${complete && !job ? axisFound(app) : ''} ${lead ? html`<p class="quiet">${lead}</p>` : ''}
    </section>
    ${before ? scanCheck(app) : ''}
    ${complete && !job && project.can_scan && !lacksAxis(app) && !app.session.watches ? nextSetup(app) : ''}
    ${job ? '' : joins(app)}
    <section class="group">
      <table class="table">
        <thead>
          <tr>
            <th>${t('scan.angle')}</th>
            ${
              measured || begun
                ? html`<th>${t('scan.contrast')}</th>
                    <th>${t('scan.saturated')}</th>
                    <th>${t('scan.points')}</th>`
                : ''
            }
          </tr>
        </thead>
        <tbody class="num">
          ${all.map(
            ({ station, place }) =>
              html`<tr title=${station.verdict}>
                <td>
                  ${
                    station.state === 'done' || station.state === 'skipped'
                      ? html`<button
                          class="rescan"
                          title=${t(shown === present ? 'scan.rescan' : 'scan.turnedSince')}
                          aria-label="${t('scan.rescan')}: ${number(station.angle_deg, 1)}°"
                          ?disabled=${app.occupied || !project.can_scan || shown !== present}
                          @click=${() => app.command('rescan-station', { station: place })}
                        >
                          <span class="dot ${dot(station)}"></span>${icon('again')}
                        </button>`
                      : html`<span class="dot ${dot(station)}"></span>`
                  }<span class="angle">${number(station.angle_deg, 1)}°</span>
                </td>
                ${
                  measured || begun
                    ? station.points
                      ? html`<td>${station.contrast > 0 ? number(station.contrast, 2) : '·'}</td>
                          <td>${number(100 * station.saturated, 1)} %</td>
                          <td>${number(station.points)}</td>`
                      : html`<td>·</td>
                          <td>·</td>
                          <td>·</td>`
                    : ''
                }
              </tr>`,
          )}
        </tbody>
      </table>
      ${all
        .filter(({ station }) => station.verdict && !station.good)
        .map(
          ({ station, place }) =>
            html`<div class="faulty" data-station=${place}>
              <p><span class="dot poor"></span>${number(station.angle_deg, 1)}°: ${plain(station.verdict)}</p>
              ${
                shown === present && (station.state === 'done' || station.state === 'skipped')
                  ? html`<button
                      class="btn small"
                      ?disabled=${app.occupied || !project.can_scan}
                      @click=${() => app.command('rescan-station', { station: place })}
                    >
                      ${icon('again')}${t('scan.rescan')}
                    </button>`
                  : ''
              }
            </div>`,
        )}
    </section>`;
}
