import { html, svg, type TemplateResult } from 'lit';
import type { Store } from './store';
import { css, MARK_COLORS, type Rgb, SEVERAL_SETUPS, setupColor } from './colors';
import { icon } from './icons';
import { number, t } from './messages';
import { type Legend, shade } from './mesh_colors';

/** An end of the scale, which can be written over; `factor` is from the unit of the mesh to that of the legend. */
function end(app: Store, scale: Legend, at: 0 | 1, factor: number, digits: number): TemplateResult {
  const ends: [number, number] = [scale.low, scale.high];
  const set = (event: Event) => {
    const input = event.target as HTMLInputElement;
    const value = input.valueAsNumber / factor;
    const wanted: [number, number] = at === 0 ? [value, ends[1]] : [ends[0], value];
    if (wanted[0] < wanted[1]) app.viewer.setEnds(wanted);
    app.requestUpdate();
    input.value = ((wanted[0] < wanted[1] ? value : ends[at]) * factor).toFixed(digits);
  };
  return html`<input
    class="num"
    name=${at === 0 ? 'legend-low' : 'legend-high'}
    type="number"
    step="any"
    aria-label=${t(at === 0 ? 'legend.low' : 'legend.high')}
    title=${t(at === 0 ? 'legend.low' : 'legend.high')}
    .value=${(ends[at] * factor).toFixed(digits)}
    @change=${set}
  />`;
}

/** A colour scale whose histogram stands on it, and whose ends can be chosen. */
function legend(app: Store, title: string, scale: Legend, factor: number, digits: number): TemplateResult {
  const most = Math.max(1, ...scale.counts);
  const bins = scale.counts.length;
  const width = 280 / bins;
  return html`<figure class="legend">
    <figcaption>${title}</figcaption>
    <svg viewBox="0 0 280 68" preserveAspectRatio="none" aria-hidden="true">
      ${scale.counts.map((count, i) => {
        const height = 58 * Math.sqrt(count / most);
        const color = css(shade(scale, scale.band ? (i + 0.5) / bins : bins > 1 ? i / (bins - 1) : 0));
        return svg`<rect x=${i * width} y=${60 - height} width=${width + 0.4} height=${height} fill=${color} />
          <rect x=${i * width} y="61.500" width=${width + 0.4} height="6.500" fill=${color} />`;
      })}
      ${(scale.band ?? []).map((limit) => {
        const x = (280 * (limit - scale.low)) / (scale.high - scale.low);
        return svg`<line class="legend-limit" x1=${x} x2=${x} y1="0" y2="68" />`;
      })}
    </svg>
    <div class="legend-range num">
      ${end(app, scale, 0, factor, digits)}
      ${
        app.viewer.hasOwnEnds
          ? html`<button
              class="icon-btn"
              id="usual-ends"
              title=${t('legend.usual')}
              aria-label=${t('legend.usual')}
              @click=${() => {
                app.viewer.setEnds(null);
                app.requestUpdate();
              }}
            >
              ${icon('again')}
            </button>`
          : html`<span>${number(((scale.low + scale.high) / 2) * factor, digits)}</span>`
      }
      ${end(app, scale, 1, factor, digits)}
    </div>
    ${scale.beyond > 0.001 ? html`<p class="quiet">${t('surface.beyond', { share: number(100 * scale.beyond, 1) })}</p>` : ''}
  </figure>`;
}

/** The setups that were joined; fewer than two colour nothing. */
export const joinedSetups = (app: Store): { number: number }[] => {
  const joined = (app.project.surface?.summary?.setups ?? []).filter((setup) => setup.joined);
  return joined.length > 1 ? joined : [];
};

const swatch = (color: Rgb, text: string): TemplateResult =>
  html`<span
    ><svg viewBox="0 0 14 14" aria-hidden="true">${svg`<rect width="14" height="14" rx="3" fill=${css(color)} />`}</svg
    >${text}</span
  >`;

/** What the colours of the surface mean, with the unit, on the picture. */
export function surfaceLegend(app: Store): TemplateResult | string {
  const { coloring } = app.look;
  const scale = app.viewer.legend;
  const setups = joinedSetups(app);
  if (coloring === 'setup' && setups.length > 0)
    return html`<div class="chip swatches">
      ${setups.map((setup, i) => swatch(setupColor(i), t('surface.setupOnly', { number: setup.number + 1 })))}
      ${swatch(SEVERAL_SETUPS[0] as Rgb, t('surface.setupBoth'))}
    </div>`;
  if (coloring === 'marks')
    return html`<div class="chip swatches">
      ${(['surface.measured', 'surface.displaced', 'surface.synthesized'] as const).map((key, i) =>
        swatch(MARK_COLORS[i] ?? [0, 0, 0], t(key)),
      )}
    </div>`;
  if (!scale) return '';
  if (coloring === 'sigma')
    return html`<div class="chip">${legend(app, t('surface.sigmaLegend'), scale, 1000, 1)}</div>`;
  if (coloring === 'views') return html`<div class="chip">${legend(app, t('surface.viewsLegend'), scale, 1, 0)}</div>`;
  if (coloring === 'deviation')
    return html`<div class="chip">${legend(app, t('surface.deviationLegend'), scale, 1, 2)}</div>`;
  return '';
}
