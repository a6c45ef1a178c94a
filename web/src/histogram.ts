import { html, svg, type TemplateResult } from 'lit';
import { t } from './messages';

/** Brightness of a frame: the first bin is dark, the last one holds the saturated pixels. */
export function histogram(counts: Uint32Array): TemplateResult {
  const inner = Math.max(1, ...counts.subarray(1, counts.length - 1));
  const width = 320 / counts.length;
  return html`<svg
    class="histogram"
    viewBox="0 0 320 84"
    preserveAspectRatio="none"
    role="img"
    aria-label=${t('live.histogram')}
  >
    ${Array.from(counts, (count, i) => {
      const height = 82 * Math.min(1, Math.sqrt(count / inner));
      const name = i === 0 ? 'dark' : i === counts.length - 1 ? 'saturated' : '';
      return svg`<rect class=${name} x=${i * width} y=${84 - height} width=${width - 0.7} height=${height} />`;
    })}
  </svg>`;
}
