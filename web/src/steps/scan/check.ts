import { html, type TemplateResult } from 'lit';
import type { App } from '../../parts';
import type { StepName } from '../../step_names';
import { icon } from '../../icons';
import { number, t } from '../../messages';
import { plain } from '../../ui';
import { axisIsKnown, devicesAnswer, hasTable } from '../../rig_facts';
import { scanArguments, scanMayShowAxis } from './axis_of_scan';

/** Fringes of less contrast are blurred or drowned in room light: half of what a sound rig shows. */
const POOR_CONTRAST = 0.35;
/** Beyond this share of pixels the light is too strong. */
const MOST_SATURATED = 0.005;
/** Supports move and glue creeps: a calibration of last month is worth a check. */
const OLD_DAYS = 30;
const DAY_MS = 86_400_000;

interface Line {
  state: 'done' | 'poor' | 'bad' | '';
  label: string;
  text: string;
  /** The step where the user can correct it. */
  step?: StepName;
  /** Another way, below the line. */
  other?: TemplateResult;
}

function devices(app: App): Line {
  const all = app.project.devices;
  const faulty = all.find((device) => device.fault);
  const answer = devicesAnswer(app.project);
  return {
    label: t('rig.devices'),
    state: faulty ? 'bad' : answer === 'now' ? 'done' : '',
    text: faulty
      ? plain(faulty.fault)
      : t(answer === 'now' ? 'check.answer' : answer ? 'check.answered' : 'check.untested'),
    ...(faulty ? { step: 'rig' as const } : {}),
  };
}

function calibration(app: App): Line {
  const label = t('rig.calibration');
  const { rig, rig_adjustable: simulated } = app.project;
  if (!rig) return { label, state: 'bad', text: t('check.uncalibrated'), step: 'rig' };
  const known = rig.calibration;
  if (!known)
    return simulated
      ? { label, state: 'done', text: t('check.exact') }
      : { label, state: 'poor', text: t('check.undated'), step: 'rig' };
  const days = Math.max(0, Math.floor((Date.now() - Date.parse(known.date)) / DAY_MS));
  const text = t(days === 0 ? 'check.today' : days === 1 ? 'check.yesterday' : 'check.days', {
    days,
    sigma: number(known.point_sigma_mm, 3),
  });
  return days > OLD_DAYS ? { label, state: 'poor', text, step: 'rig' } : { label, state: 'done', text };
}

/** The scan itself shows the axis, unless the part is round. */
const byScan = (app: App): TemplateResult =>
  html`<div class="check-other">
    <p class="quiet">${t('check.byScan')}</p>
    <button
      class="btn wide"
      id="scan-for-axis"
      ?disabled=${app.occupied || app.session.watches}
      @click=${() => app.command('start-scan', scanArguments(app))}
    >
      ${icon('play')}${t('scan.axisOfScan')}
    </button>
  </div>`;

function axis(app: App): Line {
  const label = t('axis.title');
  if (!hasTable(app)) return { label, state: '', text: t('check.noTable') };
  if (!axisIsKnown(app)) {
    const line: Line = { label, state: 'bad', text: t('check.noAxis'), step: 'rig' };
    return scanMayShowAxis(app) ? { ...line, other: byScan(app) } : line;
  }
  const found = app.project.axis;
  return {
    label,
    state: 'done',
    text: found
      ? t(found.of_scan ? 'check.axisOfScan' : 'check.axisFound', { sigma: number(found.axis_sigma_deg, 3) })
      : t('check.axisKnown'),
  };
}

/** Where the table stands: the angles of the stations begin there. */
function home(app: App): Line[] {
  if (!hasTable(app)) return [];
  const label = t('check.home');
  const { table_angle: lost, devices: all } = app.project;
  if (lost) return [{ label, state: 'bad', text: t('check.homeLost') }];
  const answers = all.some(({ table, answer }) => table === 'turntable' && answer);
  return [{ label, state: answers ? 'done' : '', text: t(answers ? 'check.homeKnown' : 'check.untested') }];
}

function light(app: App): Line[] {
  const found = app.project.check;
  const focus = t('check.focus');
  const label = t('live.light');
  if (!found) {
    const text = t(app.project.rig ? 'check.unseen' : 'check.afterCalibration');
    return [
      { label: focus, state: '', text },
      { label, state: '', text },
    ];
  }
  const blurred = found.contrast < POOR_CONTRAST;
  const strong = found.saturated > MOST_SATURATED;
  const wrong = found.finding !== '' || found.points === 0;
  return [
    {
      label: focus,
      state: blurred ? 'poor' : 'done',
      text: t(blurred ? 'check.blurred' : 'check.contrast', { contrast: number(found.contrast, 2) }),
      ...(blurred ? { step: 'live' as const } : {}),
    },
    {
      label,
      state: strong || wrong ? 'poor' : 'done',
      text: found.finding
        ? plain(found.finding)
        : t(found.points === 0 ? 'check.nothing' : 'check.light', {
            saturated: number(100 * found.saturated, 1),
            points: number(found.points),
          }),
      ...(strong || wrong ? { step: 'live' as const } : {}),
    },
  ];
}

/** One card that says before a scan whether devices, calibration, axis, focus and light are fit for it. */
export function scanCheck(app: App): TemplateResult | string {
  if (!app.project.can_scan) return '';
  const lines = [devices(app), calibration(app), axis(app), ...home(app), ...light(app)];
  return html`<section class="group" id="scan-check">
    <h2>${t('check.title')}</h2>
    <div class="checks">
      ${lines.map(
        ({ state, label, text, step, other }) =>
          html`<div class="check" data-state=${state}>
              <span class="dot ${state}"></span>
              <div><b>${label}</b><span class="quiet">${text}</span></div>
              ${
                step
                  ? html`<button
                      class="btn small"
                      aria-label="${app.titleOf(step)}: ${label}"
                      @click=${() => app.go(step)}
                    >
                      ${app.titleOf(step)}
                    </button>`
                  : ''
              }
            </div>
            ${other ?? ''}`,
      )}
    </div>
    <button
      class="btn wide"
      id="check-scan"
      ?disabled=${app.occupied || app.session.watches}
      @click=${() => app.command('check-scan')}
    >
      ${icon('check')}${t('check.run')}
    </button>
  </section>`;
}
