import { html, type TemplateResult } from 'lit';
import type { App } from './parts';
import { icon } from './icons';
import { surfaceLegend } from './legend';
import { type MessageKey, number, t } from './messages';
import { previewBar } from './preview_bar';
import { standAtStation } from './station_view';

/** Where the eye of each standard view is, and the key that takes it there, with Shift. Slightly off the poles, where up has no direction. */
export const VIEWS = [
  ['front', [0, -1, 0]],
  ['back', [0, 1, 0]],
  ['left', [-1, 0, 0]],
  ['right', [1, 0, 0]],
  ['top', [0, -0.001, 1]],
  ['bottom', [0, -0.001, -1]],
  ['iso', [1, -1, 0.816]],
] as const satisfies readonly (readonly [string, readonly [number, number, number]])[];

/** The cameras of the stations of the first setup, in whose pose the part stands in the picture. */
function stationViews(app: App): TemplateResult | string {
  const { rig, stations } = app.project;
  const own = stations.filter((station) => station.setup === 0);
  if (!rig?.turntable || own.length === 0 || !(app.onSurface || app.step === 'scan')) return '';
  const stand = (event: Event) => {
    const select = event.target as HTMLSelectElement;
    const station = own[Number(select.value)];
    select.value = '';
    if (station) standAtStation(app.viewer, rig, station.angle_deg);
  };
  return html`<select class="stand" aria-label=${t('app.stand')} title=${t('app.stand')} @change=${stand}>
    <option value="" selected>${t('table.camera')}</option>
    ${own.map((station, i) => html`<option value=${i}>${i + 1}: ${number(station.angle_deg, 0)}°</option>`)}
  </select>`;
}

function parallelButton(app: App): TemplateResult {
  const { view } = app.viewer;
  return html`<button
    class="icon-btn"
    id="parallel"
    title="${t('app.parallel')} (O)"
    aria-label=${t('app.parallel')}
    aria-pressed=${view.isParallel}
    @click=${() => toggleParallel(app)}
  >
    ${icon('parallel')}
  </button>`;
}
export function toggleParallel(app: App): void {
  app.viewer.view.setParallel(!app.viewer.view.isParallel);
  app.viewer.draw();
  app.requestUpdate();
}

const viewButtons = (app: App): TemplateResult =>
  html`<div class="view-tools" role="group" aria-label=${t('app.views')}>
    ${VIEWS.map(
      ([name, [x, y, z]], i) =>
        html`<button
          class="icon-btn text"
          data-view=${name}
          title="${t(`app.${name}` as MessageKey)} (⇧ ${i + 1})"
          @click=${() => app.viewer.frame([x, y, z])}
        >
          ${t(`app.${name}` as MessageKey)}
        </button>`,
    )}
    ${stationViews(app)} ${parallelButton(app)}
    <button
      class="icon-btn"
      title="${t('app.frame')} (F)"
      aria-label=${t('app.frame')}
      @click=${() => app.viewer.frame()}
    >
      ${icon('fit')}
    </button>
  </div>`;

const chip = (text: string): TemplateResult => html`<div class="chip">${text}</div>`;

/** What stands on the 3D picture: what a tool waits for, what was measured, the scale of the colours, standard views. */
export function viewOverlay(app: App): TemplateResult {
  const { viewer } = app;
  const scene = viewer.supported && !app.showsCamera && !app.showsResiduals;
  const showsSurface = scene && app.onSurface;
  return html`<div class="floating">
      ${previewBar(app)} ${viewer.tool === 'section' ? chip(app.sectioning.hint) : ''}
      ${viewer.tool === 'pair' ? chip(app.pairing.hint) : ''} ${viewer.tool === 'face' ? chip(app.facing.hint) : ''}
      ${viewer.tool === 'align' && !app.project.surface?.preview ? chip(t('edit.alignHint')) : ''}
      ${viewer.tool === 'feature' ? chip(t('inspect.pickHint')) : ''}
      ${viewer.tool === 'loop' ? chip(t('edit.loopHint')) : ''} ${app.measuring.chip()}
      ${showsSurface && !viewer.showsReference ? surfaceLegend(app) : ''}
    </div>
    ${scene ? viewButtons(app) : ''}`;
}
