import { html, svg, type TemplateResult } from 'lit';
import type { App } from '../../parts';
import type { RigFigure } from '../../arrange';
import { icon } from '../../icons';
import { number, t, type MessageKey } from '../../messages';
import { poseTable } from '../../residuals';
import type { Calibration, RigGeometry } from '../../types';
import { term } from '../../terms';
import { nextStep, plain } from '../../ui';
import { axisStage } from './axis';
import { boardOf, boardPrints, calibrationFields } from './board';
import { devices } from './devices';
import { displayStage } from './display';
import { keepRig, rigHistory } from './history';
import { type RigStage, rigStages } from './stages';

/** The report of `frangia calibrate rig`, which the calibration writes to the exports. */
const REPORT = 'calibration.html';

/**
 * One figure of the rig. Those of a simulated, uncalibrated one can be moved: the picture follows while it is dragged, the
 * rig when it is let go.
 */
function figure(app: App, key: RigFigure, label: string, value: number, unit: string): TemplateResult {
  if (!app.project.rig_adjustable || app.project.scan_begun)
    return html`<dl class="figures">
      <dt>${label}</dt>
      <dd class="num">${number(value, 1)}<span>${unit}</span></dd>
    </dl>`;
  const fixed = app.occupied || app.session.watches;
  return html`<label class="slider"
    ><span>${label}</span><b class="num">${number(value, 1)} ${unit}</b>
    <input
      data-figure=${key}
      type="range"
      min="20"
      max=${unit === 'px' ? 4000 : 1200}
      step="0.5"
      .value=${String(value)}
      ?disabled=${fixed}
      @input=${(event: Event) => app.arranging.draftRig({ [key]: Number((event.target as HTMLInputElement).value) })}
      @change=${(event: Event) => void app.arranging.moveRig({ [key]: Number((event.target as HTMLInputElement).value) })}
  /></label>`;
}

function geometry(app: App, rig: RigGeometry): TemplateResult {
  const distance = rig.turntable?.distance_mm ?? 0;
  const angle = distance ? (2 * Math.atan(rig.baseline_mm / 2 / distance) * 180) / Math.PI : null;
  const fov = (optics: { width_px: number; focal_px: [number, number] }) =>
    (2 * Math.atan(optics.width_px / 2 / optics.focal_px[0]) * 180) / Math.PI;
  return html`<section class="group">
    <h2>${t('rig.geometry')}${app.project.scan_begun ? html`<small>${t('live.fixed')}</small>` : ''}</h2>
    ${figure(app, 'baseline_mm', t('rig.baseline'), rig.baseline_mm, 'mm')}
    ${rig.turntable ? figure(app, 'distance_mm', t('rig.distance'), distance, 'mm') : ''}
    ${figure(app, 'camera_focal_px', t('rig.cameraFocal'), rig.camera.focal_px[0], 'px')}
    ${rig.projector ? figure(app, 'projector_focal_px', t('rig.projectorFocal'), rig.projector.focal_px[0], 'px') : ''}
    <dl class="figures">
      ${
        angle === null
          ? ''
          : html`<dt>${t('rig.angle')}</dt>
              <dd class="num">${number(angle, 1)}°</dd>`
      }
      <dt><i class="key camera"></i>${t('rig.cameraField')}</dt>
      <dd class="num">${number(fov(rig.camera), 1)}°</dd>
      ${
        rig.projector
          ? html`<dt><i class="key projector"></i>${t('rig.projectorField')}</dt>
              <dd class="num">${number(fov(rig.projector), 1)}°</dd>`
          : ''
      }
      <dt><i class="key shared"></i>${t('rig.shared')}</dt>
      <dd></dd>
    </dl>
  </section>`;
}

function coverage(state: Calibration): TemplateResult {
  const rows = Math.ceil(state.cells.length / state.columns);
  const names = ['left', 'right', 'up', 'down'] as const;
  return html`<div class="coverage">
    <svg viewBox="0 0 ${state.columns * 30} ${rows * 24}" role="img" aria-label=${t('rig.field')}>
      ${state.cells.map(
        (covered, i) =>
          svg`<rect class=${covered ? 'on' : ''} x=${(i % state.columns) * 30 + 1} y=${Math.floor(i / state.columns) * 24 + 1} width="28" height="22" rx="3" />`,
      )}
    </svg>
    <dl class="figures">
      <dt>${t('rig.field')}</dt>
      <dd class="num">${number(100 * state.field)} %</dd>
      <dt>${t('rig.depth')}</dt>
      <dd class="num">${number(100 * (state.distance_ratio - 1))} %</dd>
      <dt>${t('rig.tilts')}</dt>
      <dd></dd>
      ${names.map(
        (name, i) =>
          html`<dt class="sub">${t(`rig.tilt.${name}`)}</dt>
            <dd class="num">${number(state.tilts_deg[i] ?? 0)}°</dd>`,
      )}
    </dl>
  </div>`;
}

function verdict(state: Calibration): TemplateResult | string {
  const found = state.verdict;
  if (!found) return '';
  return html`<div class="verdict">
    <div class="big num">± ${number(found.point_sigma_mm, 3)} mm</div>
    <p>${t('rig.verdict', { distance: number(found.distance_mm), grade: t(`grade.${found.grade as 'good'}`) })}</p>
    <dl class="figures">
      <dt>${t('rig.spread')}</dt>
      <dd class="num">${number(found.spread_mm, 3)}<span>mm</span></dd>
      <dt>${t('rig.baseline')}${term('baseline')}</dt>
      <dd class="num">${number(found.baseline_mm, 2)}<span>mm</span></dd>
      <dt>${t('rig.cameraRms')}${term('residual')}</dt>
      <dd class="num">${number(found.camera_rms_px, 3)}<span>px</span></dd>
      <dt>${t('rig.projectorRms')}</dt>
      <dd class="num">${number(found.projector_rms_px, 3)}<span>px</span></dd>
      <dt>${t('rig.poses')}</dt>
      <dd class="num">${found.poses}</dd>
    </dl>
  </div>`;
}

/** What the checks of the poses found, in words, and what to do. */
function doctor(state: Calibration): TemplateResult | string {
  const { findings, fault } = state;
  if (!fault && findings.length === 0)
    return state.verdict ? html`<p class="quiet"><span class="dot done"></span>${t('rig.sound')}</p>` : '';
  return html`<div class="doctor">
    <h3>${t('rig.findings')}</h3>
    ${fault ? html`<p class="bad">${plain(fault)}</p>` : ''}
    ${findings.map((sentence) => html`<p><span class="dot poor"></span>${plain(sentence)}</p>`)}
  </div>`;
}

/** What the next pose of the board should be, in the language of the page. */
function nextPose({ next }: Calibration): string {
  const tilt = next.side ? t(`tilt.${next.side}` as MessageKey) : '';
  const place = next.place ? t(`place.${next.place}` as MessageKey) : '';
  return t(`pose.${next.kind}` as MessageKey, { tilt, place });
}

function calibration(app: App): RigStage {
  const { project } = app;
  const state = project.calibration;
  const known = project.rig?.calibration;
  const start = (event: SubmitEvent) => {
    event.preventDefault();
    const form = new FormData(event.target as HTMLFormElement);
    const wanted = boardOf(form);
    void (async () => {
      if (!known || (await app.asking.confirm(t('rig.againAsk'), t('rig.again'))))
        await app.command('start-calibration', wanted);
    })();
  };
  const sigma = state?.verdict?.point_sigma_mm ?? known?.point_sigma_mm;
  const doubtful = Boolean(state?.fault) || (state?.findings.length ?? 0) > 0;
  const due = Boolean(state?.active) || (!project.rig && project.can_scan);
  const body = html`${
    state?.active
      ? html`<p class="next">
            ${state.naming ? t('board.naming') : state.waiting ? (state.poses.length === 0 ? t('rig.first') : nextPose(state)) : state.poses.length && state.with_board >= state.wanted ? t('rig.solving') : t('rig.capturing')}
          </p>
          <div class="pair">
            <button
              class="btn primary"
              id="pose"
              ?disabled=${!state.waiting}
              @click=${() => app.command('capture-pose')}
            >
              ${icon('check')}${t('rig.pose', { number: state.poses.length + 1, wanted: state.wanted })}
            </button>
            <button
              class="btn"
              id="end-poses"
              ?disabled=${!state.waiting || state.with_board < 3}
              @click=${() => app.command('end-poses')}
            >
              ${t('rig.end')}
            </button>
          </div>
          ${state.board ? html`<p class="quiet" id="named">${t('board.named', { columns: state.board.columns, rows: state.board.rows, square: number(state.board.square_mm, 2) })}</p>` : ''}
          ${coverage(state)}`
      : html`${state ? verdict(state) : html`<p class="quiet">${t('rig.lead')}</p>`} ${poseTable(app)}`
  }
  ${state ? doctor(state) : ''}
  ${
    state?.active
      ? ''
      : html`${project.exports.some(({ name }) => name === REPORT) ? html`<button class="btn wide" id="report" @click=${() => app.exporting.download(REPORT)}>${icon('download')}${t('rig.report')}</button>` : ''}
          <form class="form-plain" @submit=${start}>
            ${calibrationFields(app)}
            <button
              class="btn ${due ? 'primary' : ''} wide"
              id="calibrate"
              ?disabled=${app.occupied || app.session.watches || !project.can_scan || project.scan_begun}
            >
              ${t(state?.verdict || known ? 'rig.again' : 'rig.start')}
            </button>
          </form>
          ${boardPrints(app)}`
  }`;
  return {
    name: 'calibration',
    title: t('rig.calibration'),
    summary: state?.active
      ? t('rig.pose', { number: state.poses.length, wanted: state.wanted })
      : sigma !== undefined
        ? `± ${number(sigma, 3)} mm`
        : t(project.rig_adjustable ? 'rig.exact' : project.rig ? 'rig.given' : 'rig.isUnknown'),
    state: !project.rig ? '' : doubtful ? 'poor' : 'done',
    due,
    body,
  };
}

/** The rigs that were, and the geometry of the present one. */
function more(app: App): TemplateResult {
  const rig = app.arranging.drawnRig;
  const { project } = app;
  const fault = project.rig_begun
    ? ''
    : project.rig_fault || (project.can_scan ? '' : t(project.scan_complete ? 'scan.noRig' : 'rig.none'));
  if (project.calibration?.active) return html``;
  return html`${keepRig(app)}${rigHistory(app)}${rig ? geometry(app, rig) : fault ? html`<section class="group"><p class="quiet">${plain(fault)}</p></section>` : ''}`;
}

export function rigStep(app: App): TemplateResult {
  const { project } = app;
  const active = Boolean(project.calibration?.active);
  const stages = [
    devices(app),
    active ? null : displayStage(app),
    project.can_scan || project.calibration ? calibration(app) : null,
    active ? null : axisStage(app),
  ].filter((stage) => stage !== null);
  const ready = !stages.some(({ due }) => due);
  return html`${rigStages(app, stages)}${more(app)} ${project.can_scan && !active ? nextStep(app, 'live', ready) : ''}`;
}
