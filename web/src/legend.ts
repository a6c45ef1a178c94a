import { html, svg, type TemplateResult } from 'lit';
import type { Store } from './store';
import { css, MARK_COLORS, type Rgb, SEVERAL_SETUPS, setupColor } from './colors';
import { number, t } from './messages';
import { type Legend, shade } from './mesh_colors';

/** A colour scale whose histogram stands on it. */
function legend(title: string, scale: Legend, factor: number, digits: number): TemplateResult {
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
      <span>${number(scale.low * factor, digits)}</span>
      <span>${number(((scale.low + scale.high) / 2) * factor, digits)}</span>
      <span>${number(scale.high * factor, digits)}</span>
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
  if (coloring === 'sigma') return html`<div class="chip">${legend(t('surface.sigmaLegend'), scale, 1000, 1)}</div>`;
  if (coloring === 'views') return html`<div class="chip">${legend(t('surface.viewsLegend'), scale, 1, 0)}</div>`;
  if (coloring === 'deviation')
    return html`<div class="chip">${legend(t('surface.deviationLegend'), scale, 1, 2)}</div>`;
  return '';
}
