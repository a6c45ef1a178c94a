import { html, noChange, svg, type TemplateResult } from 'lit';
import type { Store } from './store';
import { css, MARK_COLORS, type Rgb, SEVERAL_SETUPS, setupColor } from './colors';
import { icon } from './icons';
import { number, t } from './messages';
import { type Ends, type Legend, shade } from './mesh_colors';
import { numeric } from './number_field';
import { numberOf, shownNumber } from './written_numbers';

/** A scale as it is shown: `factor` is from the unit of its values to that of the title. */
interface Shown {
  title: string;
  scale: Legend;
  factor: number;
  digits: number;
  /** The colour at a share of the scale. */
  color: (share: number) => Rgb;
  /** Whether somebody chose its ends. */
  own: boolean;
  /** Chooses them; null takes the usual ones. */
  setEnds: (ends: Ends | null) => void;
}

/** An end of the scale, which can be written over. */
function end({ scale, factor, digits, setEnds }: Shown, at: 0 | 1): TemplateResult {
  const ends: [number, number] = [scale.low, scale.high];
  const name = at === 0 ? 'legend-low' : 'legend-high';
  const set = (event: Event) => {
    const input = event.target as HTMLInputElement;
    const value = (numberOf(input) ?? NaN) / factor;
    const wanted: [number, number] = at === 0 ? [value, ends[1]] : [ends[0], value];
    if (wanted[0] < wanted[1]) setEnds(wanted);
    input.value = shownNumber((wanted[0] < wanted[1] ? value : ends[at]) * factor, digits);
  };
  // What is being written stays, although the usual ends of a live picture change.
  const focused = document.activeElement;
  const written = focused instanceof HTMLInputElement && focused.name === name;
  return html`<input
    class="num"
    name=${name}
    aria-label=${t(at === 0 ? 'legend.low' : 'legend.high')}
    title=${t(at === 0 ? 'legend.low' : 'legend.high')}
    .value=${written ? noChange : shownNumber(ends[at] * factor, digits)}
    ${numeric({ step: 10 ** -digits })}
    @change=${set}
  />`;
}

/** A colour scale whose histogram stands on it, and whose ends can be chosen. */
export function legend(shown: Shown): TemplateResult {
  const { title, scale, factor, digits, color, own, setEnds } = shown;
  const most = Math.max(1, ...scale.counts);
  const bins = scale.counts.length;
  const width = 280 / bins;
  return html`<figure class="legend">
    <figcaption>${title}</figcaption>
    <svg viewBox="0 0 280 68" preserveAspectRatio="none" aria-hidden="true">
      ${scale.counts.map((count, i) => {
        const height = 58 * Math.sqrt(count / most);
        const fill = css(color(scale.band ? (i + 0.5) / bins : bins > 1 ? i / (bins - 1) : 0));
        return svg`<rect x=${i * width} y=${60 - height} width=${width + 0.4} height=${height} fill=${fill} />
          <rect x=${i * width} y="61.500" width=${width + 0.4} height="6.500" fill=${fill} />`;
      })}
      ${(scale.band ?? []).map((limit) => {
        const x = (280 * (limit - scale.low)) / (scale.high - scale.low);
        return svg`<line class="legend-limit" x1=${x} x2=${x} y1="0" y2="68" />`;
      })}
    </svg>
    <div class="legend-range num">
      ${end(shown, 0)}
      ${
        own
          ? html`<button
              class="icon-btn"
              id="usual-ends"
              title=${t('legend.usual')}
              aria-label=${t('legend.usual')}
              @click=${() => setEnds(null)}
            >
              ${icon('again')}
            </button>`
          : html`<span>${number(((scale.low + scale.high) / 2) * factor, digits)}</span>`
      }
      ${end(shown, 1)}
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
  const { viewer } = app;
  const shown = (title: string, factor: number, digits: number) => {
    const setEnds = (ends: Ends | null) => {
      viewer.setEnds(ends);
      app.requestUpdate();
    };
    const color = (share: number) => shade(scale, share);
    return html`<div class="chip">
      ${legend({ title, scale, factor, digits, color, own: viewer.hasOwnEnds, setEnds })}
    </div>`;
  };
  if (coloring === 'sigma') return shown(t('surface.sigmaLegend'), 1000, 1);
  if (coloring === 'views') return shown(t('surface.viewsLegend'), 1, 0);
  if (coloring === 'deviation') return shown(t('surface.deviationLegend'), 1, 2);
  return '';
}
