import { html, type TemplateResult } from 'lit';
import type { App } from '../../parts';
import { number, t } from '../../messages';
import type { DisplayFigures } from '../../types';
import { term } from '../../terms';
import { plain } from '../../ui';
import type { RigStage } from './stages';

/** Drivers of pictures, not of a phase. */
const DISPLAYS: ReadonlySet<string> = new Set(['monitor', 'simulated-display']);
/** Fringes that lose more of their contrast are not sharp. */
const SHARP = 0.4;

function figures(found: DisplayFigures): TemplateResult {
  const ms = (seconds: number) => number(1000 * seconds);
  return html`<dl class="figures">
      <dt>${t('display.latency')}${term('latency')}</dt>
      <dd class="num">${ms(found.latency_s)}<span>ms</span></dd>
      <dt>${t('display.delay')}</dt>
      <dd class="num">${ms(found.delay_s)}<span>ms</span></dd>
      <dt>${t('display.late')}</dt>
      <dd class="num">${found.late_frames}</dd>
      <dt>${t('display.fps')}</dt>
      <dd class="num">${number(found.camera_fps, 1)}<span>/s</span></dd>
      <dt>${t('display.patterns')}</dt>
      <dd class="num">${number(found.patterns_per_s, 1)}<span>/s</span></dd>
      <dt>${t('display.room')}</dt>
      <dd class="num">
        ${found.mains_hz ? html`${number(100 * found.room_flicker, 1)} %<span>${found.mains_hz} Hz</span>` : t('display.steady')}
      </dd>
      <dt>${t('display.step')}</dt>
      <dd class="num">
        ${found.exposure_step_ms ? html`${number(found.exposure_step_ms, 1)}<span>ms</span>` : t('display.any')}
      </dd>
      <dt>${t('display.half')}${term('response')}</dt>
      <dd class="num">${found.half_light === null ? '–' : `${number(100 * found.half_light, 1)} %`}</dd>
      <dt>${t('display.white')}</dt>
      <dd class="num">${number(found.white_level)}</dd>
      <dt>${t('display.zeros')}</dt>
      <dd class="num">${number(100 * found.dark_zeros, 1)} %</dd>
      <dt>${t('display.sharpness')}</dt>
      <dd class="num">${number(100 * found.sharpness)} %</dd>
    </dl>
    <meter
      min="0"
      max="1"
      low=${SHARP}
      high=${SHARP}
      optimum="1"
      .value=${found.sharpness}
      aria-label=${t('display.sharpness')}
    ></meter>
    ${
      found.findings.length === 0
        ? html`<p class="quiet"><span class="dot done"></span>${t('display.sound')}</p>`
        : html`<div class="doctor">
            ${found.findings.map((sentence) => html`<p><span class="dot poor"></span>${plain(sentence)}</p>`)}
          </div>`
    }`;
}

/** Fits display and camera to each other: latency, response, room light, focus, level of white. Null without a display. */
export function displayStage(app: App): RigStage | null {
  const { project } = app;
  const isDisplay = project.devices.some(({ table, driver }) => table === 'fringes' && DISPLAYS.has(driver));
  if (!project.can_scan || !isDisplay) return null;
  const job = app.job('display');
  const found = project.display;
  const due = !project.rig && !project.scan_begun && !found;
  return {
    name: 'display',
    title: t('display.title'),
    summary: !found
      ? ''
      : `${number(1000 * found.delay_s)} ms${found.findings.length ? ` · ${t('display.findings', { count: found.findings.length })}` : ''}`,
    state: !found ? '' : found.findings.length === 0 ? 'done' : 'poor',
    due,
    body: html`${found ? figures(found) : html`<p class="quiet">${t('display.lead')}</p>`}
    ${
      job
        ? html`<p class="next">${t('display.flashing')}</p>
            <button class="btn wide" @click=${() => app.command('stop-job', { job: job.number })}>
              ${t('job.stop')}
            </button>`
        : html`<button
            class="btn ${due ? 'primary' : ''} wide"
            id="measure-display"
            ?disabled=${app.occupied || app.session.watches || project.scan_begun}
            @click=${() => app.command('measure-display')}
          >
            ${t(found ? 'display.again' : 'display.measure')}
          </button>`
    }`,
  };
}
