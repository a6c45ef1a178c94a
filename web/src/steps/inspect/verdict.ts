import { html, svg, type TemplateResult } from 'lit';

import type { App } from '../../parts';
import { worded } from '../../faults';
import { number, t } from '../../messages';
import type { Inspection } from '../../types';
import { verdictSentence } from '../../verdict_words';

/** With the sign that is printed, not that of keyboards. */
const minus = (text: string): string => text.replace('-', '−');
/** With its sign, which a value that rounds to zero does not have. */
export const signed = (value: number | null, digits = 3): string => {
  if (value === null) return '·';
  const sign = Math.abs(value) < 0.5 * 10 ** -digits ? '' : value > 0 ? '+' : '−';
  return `${sign}${number(Math.abs(value), digits)}`;
};

type Verdict = Inspection['verdict'];

/** Three lamps, of which one is lit; none without a verdict. */
const light = (verdict: Verdict | null): TemplateResult =>
  html`<svg class="traffic" viewBox="0 0 22 58" aria-hidden="true">
    ${svg`<rect x="1" y="1" width="20" height="56" rx="10" />`}
    ${(['out', 'undecided', 'in'] as const).map(
      (lamp, i) => svg`<circle class="${lamp} ${lamp === verdict ? 'lit' : ''}" cx="11" cy=${11 + 18 * i} r="7" />`,
    )}
  </svg>`;

/** The places that are out, undecided or not measured; a click brings one to the middle of the picture. */
function places(app: App, found: Inspection): TemplateResult {
  const { inspecting } = app;
  return html`<table class="table places">
    <thead>
      <tr>
        <th>${t('inspect.place')}</th>
        <th>${t('inspect.deviationMm')}</th>
        <th>x, y, z, mm</th>
      </tr>
    </thead>
    <tbody class="num">
      ${found.places.map(
        (place, i) =>
          html`<tr aria-selected=${inspecting.placeChosen === i}>
            <td>
              <span class="dot ${place.decision === 'out' ? 'bad' : 'poor'}"></span
              ><button
                class="link"
                title=${t('inspect.placeShow')}
                @click=${() => inspecting.choosePlace(i, app.viewer)}
              >
                ${t(place.missing ? 'inspect.missing' : `inspect.place.${place.decision}`)}
              </button>
            </td>
            <td>${place.deviation_mm === null ? '' : signed(place.deviation_mm)}</td>
            <td>${place.near_mm.map((one) => (one === null ? '·' : minus(number(one, 1)))).join('  ')}</td>
          </tr>`,
      )}
    </tbody>
  </table>`;
}

/** What the inspection warned of, and what that may mean. */
function warnings({ warnings: said, characteristics }: Inspection): TemplateResult | string {
  if (said.length === 0) return '';
  const SHOWN = 3;
  const line = (text: string) => html`<p class="warning"><span class="dot poor"></span>${worded(text)}</p>`;
  const none = characteristics.length > 0 && characteristics.every(({ value }) => value === null);
  return html`<section class="group" id="warnings">
    ${none ? html`<p class="warning"><span class="dot bad"></span>${t('inspect.otherPart')}</p>` : ''}
    ${said.slice(0, SHOWN).map(line)}
    ${
      said.length > SHOWN
        ? html`<details>
            <summary>${t('inspect.moreWarnings', { count: said.length - SHOWN })}</summary>
            ${said.slice(SHOWN).map(line)}
          </details>`
        : ''
    }
  </section>`;
}

/** Where the plan or the reference is another one than that of the results. */
function outdated(app: App): TemplateResult {
  return html`<section class="group" id="verdict">
    <div class="verdict-line undecided">
      ${light(null)}
      <div>
        <b>${t(app.occupied ? 'inspect.running' : 'inspect.outdated')}</b>
        ${app.occupied ? '' : html`<p class="quiet">${t('inspect.outdatedWhy')}</p>`}
      </div>
    </div>
    <button
      class="btn wide"
      id="inspect-again"
      ?disabled=${app.occupied || app.session.watches}
      @click=${() => void app.inspecting.run()}
    >
      ${t('inspect.run')}
    </button>
  </section>`;
}

/** Why the part is what it is, in words, and where. */
export function verdict(app: App, found: Inspection): TemplateResult | string {
  const { inspecting } = app;
  if (!found.current) return outdated(app);
  if (found.reasons.length === 0) return warnings(found);
  return html`<section class="group" id="verdict">
      <div class="verdict-line ${found.verdict}">
        ${light(found.verdict)}
        <div>
          <b>${t(`inspect.${found.verdict}`)}</b>
          ${found.reasons.map(({ clauses }) => html`<p class="quiet">${verdictSentence(clauses)}</p>`)}
        </div>
      </div>
      ${
        found.places.length > 0
          ? html`<button
              class="btn wide"
              id="places"
              aria-pressed=${inspecting.placesShown}
              @click=${() => inspecting.showPlaces(!inspecting.placesShown)}
            >
              ${t('inspect.places', { count: found.places.length })}
            </button>`
          : ''
      }
      ${inspecting.placesShown ? places(app, found) : ''}
    </section>
    ${warnings(found)}`;
}
