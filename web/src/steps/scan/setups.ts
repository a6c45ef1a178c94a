import { html, type TemplateResult } from 'lit';
import type { App } from '../../parts';
import { icon } from '../../icons';
import { number, t } from '../../messages';
import { presentSetup } from '../../setups';
import type { SetupJoin } from '../../types';
import { term } from '../../terms';
import { choice } from '../../ui';

/** The choice of the setup whose stations are shown. */
export function setupChoice(app: App): TemplateResult | string {
  const present = presentSetup(app.project.stations);
  if (present === 0) return '';
  return choice<string>(
    t('scan.setups'),
    String(app.setups.shown),
    Array.from({ length: present + 1 }, (_, setup) => [String(setup), t('scan.setup', { number: setup + 1 })] as const),
    (setup) => app.setups.show(Number(setup)),
  );
}

/** A part on its feet, the way it is turned, and the part upside down: the lit face is the one that was hidden. */
const turning = (): TemplateResult =>
  html`<svg class="turning" viewBox="0 0 280 120" role="img" aria-label=${t('scan.turnOverPicture')}>
    <g class="turning-table">
      <ellipse cx="66" cy="98" rx="54" ry="12" />
      <ellipse cx="214" cy="98" rx="54" ry="12" />
    </g>
    <path class="turning-part" d="M44 96V64h14V34h18v30h14v32Z" />
    <path class="turning-hidden" d="M43 97h48" />
    <path class="turning-way" d="M112 44q28-26 56 0" />
    <path class="turning-way" d="M160 42l9 3 1-10" />
    <path class="turning-part" d="M192 36v32h14v30h18V68h14V36Z" />
    <path class="turning-shown" d="M191 35h48" />
  </svg>`;

/** After a complete setup: the way to the next one. */
export function nextSetup(app: App): TemplateResult {
  const next = presentSetup(app.project.stations) + 1;
  if (!app.setups.turning) {
    return html`<section class="group">
      <h2><span>${t('scan.otherSide')}${term('setup')}</span></h2>
      <p class="quiet">${t('scan.otherSideHint')}</p>
      <button class="btn wide" id="turn-over" ?disabled=${app.occupied} @click=${() => app.setups.turn(true)}>
        ${icon('flip')}${t('scan.turnOver')}
      </button>
    </section>`;
  }
  const simulated = app.project.devices.some((device) => device.table === 'camera' && device.driver === 'simulated');
  return html`<section class="group">
    <h2>${t('scan.turnOver')}</h2>
    ${turning()}
    <ol class="turning-steps">
      <li>${t('scan.turnOver1')}</li>
      <li>${t('scan.turnOver2')}</li>
      <li>${t('scan.turnOver3')}</li>
    </ol>
    ${simulated ? html`<p class="quiet">${t('scan.turnOverSimulated')}</p>` : ''}
    <button
      class="btn primary wide"
      id="scan-setup"
      ?disabled=${app.occupied}
      @click=${() => void app.setups.scanNext()}
    >
      ${icon('play')}${t('scan.startSetup', { number: next + 1 })}
    </button>
    <button class="btn wide" @click=${() => app.setups.turn(false)}>${t('scan.notYet')}</button>
  </section>`;
}

function joinOf(join: SetupJoin, trusted: boolean): TemplateResult {
  const name = { number: join.number + 1 };
  if (!join.joined)
    return html`<p>
      <span class="dot poor"></span>${t(join.ambiguous ? 'surface.joinAmbiguous' : 'surface.joinFailed', name)}
    </p>`;
  return html`<p>
    <span class="dot ${trusted ? 'done' : 'poor'}"></span
    >${t('surface.joined', { ...name, angle: number(join.turned_deg, 1), distance: number(join.moved_mm, 1) })}
    ${trusted && join.overlap !== null ? t('surface.joinTrusted', { overlap: number(100 * join.overlap), violation: number(100 * (join.violation ?? 0), 1) }) : ''}
    ${trusted ? '' : t('surface.joinWeak')}
  </p>`;
}

/** How the setups of the surface join, in words. */
export function joins(app: App): TemplateResult | string {
  const summary = app.project.surface?.summary;
  const setups = summary?.setups ?? [];
  if (!summary || setups.length < 2) return '';
  const reference = setups.findIndex((setup) => setup.joined && setup.overlap === null);
  return html`<section class="group joins">
    <h2>${t('surface.joins')}</h2>
    ${setups.filter((_, i) => i !== reference).map((setup) => joinOf(setup, summary.untrusted_reason === ''))}
  </section>`;
}
