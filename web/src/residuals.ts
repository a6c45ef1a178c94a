import { html, svg, type TemplateResult } from 'lit';
import type { App } from './parts';
import { type MessageKey, number, t } from './messages';
import type { Residuals } from './types';
import { choice } from './ui';

type ResidualMap = Residuals['maps'][number];

/** "Camera" and "Projector" in the language of the page; other cameras keep their names. */
const titleOf = (map: ResidualMap): string =>
  map.title === 'Camera' || map.title === 'Projector' ? t(`rig.map${map.title}` as MessageKey) : map.title;

/** Green, yellow, red: an error relative to three times the RMS, as in the report of `frangia calibrate rig`. */
const hue = (error: number, rms: number): number => Math.round(120 * (1 - Math.min(1, error / (3 * rms))));

/** Every residual as an arrow; one of the RMS is this share of the width. */
const ARROW = 0.03;

function figure(map: ResidualMap): TemplateResult {
  const scale = (ARROW * map.width) / Math.max(map.rms_px, 1e-6);
  return html`<figure class="residual-map">
    <svg
      viewBox="0 0 ${map.width} ${map.height}"
      role="img"
      aria-label=${t('rig.residualsOf', { device: titleOf(map) })}
      stroke-width=${map.width / 420}
    >
      <rect width=${map.width} height=${map.height} />
      ${map.arrows.map(([x, y, dx, dy]) => {
        const color = `hsl(${hue(Math.hypot(dx, dy), map.rms_px)} 72% 52%)`;
        return svg`<circle cx=${x} cy=${y} r=${map.width / 380} fill=${color} /><line x1=${x} y1=${y} x2=${x + scale * dx} y2=${y + scale * dy} stroke=${color} />`;
      })}
    </svg>
    <figcaption>${t('rig.mapScale', { rms: number(map.rms_px, 3), points: number(map.points) })}</figcaption>
  </figure>`;
}

/** The stage of the step Rig shows the rig, or the residuals over the image of a device. */
export function residualStage(app: App): TemplateResult | string {
  const maps = app.arranging.residuals?.maps ?? [];
  if (maps.length === 0 || app.project.calibration?.active) return '';
  const options = [['-1', t('rig.scene')] as const, ...maps.map((map, i) => [String(i), titleOf(map)] as const)];
  const map = maps[app.arranging.residualMap];
  return html`<div class="layers">
      ${choice(t('rig.picture'), String(app.arranging.residualMap), options, (key) => app.arranging.showResiduals(Number(key)))}
    </div>
    ${map ? figure(map) : ''}`;
}

/** What each pose contributed; the outliers are named. */
export function poseTable(app: App): TemplateResult | string {
  const poses = app.arranging.residuals?.poses ?? [];
  if (poses.length === 0) return '';
  const worst = Math.max(...poses.map((pose) => Math.max(pose.camera_rms_px, pose.projector_rms_px)));
  const bar = (value: number, kind: string) =>
    svg`<rect class=${kind} y=${kind === 'camera' ? 1 : 6} width=${(100 * value) / worst} height="4" rx="1" />`;
  const outliers = poses.flatMap((pose, i) => (pose.outlier ? [i + 1] : []));
  return html`<table class="table poses">
      <thead>
        <tr>
          <th>${t('rig.poseNoun')}</th>
          <th class="word" colspan="2">${t('rig.residualPx')}</th>
          <th>${t('rig.changeMm')}</th>
        </tr>
      </thead>
      <tbody>
        ${poses.map(
          (pose, i) =>
            html`<tr class=${pose.outlier ? 'outlier' : ''}>
              <td class="num"><span class="dot ${pose.outlier ? 'poor' : 'done'}"></span>${i + 1}</td>
              <td class="bars">
                <svg viewBox="0 0 100 11" preserveAspectRatio="none" aria-hidden="true">
                  ${bar(pose.camera_rms_px, 'camera')}${bar(pose.projector_rms_px, 'projector')}
                </svg>
              </td>
              <td class="num">${number(pose.camera_rms_px, 2)} · ${number(pose.projector_rms_px, 2)}</td>
              <td class="num">${number(pose.change_mm, 3)}</td>
            </tr>`,
        )}
      </tbody>
    </table>
    <p class="quiet">
      ${outliers.length ? html`<span class="dot poor"></span>${t('rig.outliers', { poses: outliers.join(', ') })}` : t('rig.noOutliers')}
    </p>`;
}
