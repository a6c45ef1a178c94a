import { html, svg, type TemplateResult } from 'lit';
import { css } from './colors';
import { number, t } from './messages';
import { type Legend, shade } from './mesh_colors';

/** A colour scale whose histogram stands on it. */
export function legend(title: string, scale: Legend, factor: number, digits: number): TemplateResult {
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
