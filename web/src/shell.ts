import { html, type TemplateResult } from 'lit';

import { adviceStep } from './fault_steps';
import type { App } from './parts';
import { icon, logo } from './icons';
import { t } from './messages';
import { plain } from './ui';

async function enter(app: App, event: SubmitEvent): Promise<void> {
  event.preventDefault();
  app.dismiss();
  try {
    await app.session.enter(String(new FormData(event.target as HTMLFormElement).get('password')));
  } catch (error) {
    app.say(error);
  }
}

/** The page before there is a state: while it connects, and for who has no key. */
export function blankPage(app: App): TemplateResult {
  if (app.session.link !== 'refused')
    return html`<main class="blank">
      ${logo}
      ${app.session.blocked ? html`<p role="alert">${t('app.blocked')}</p>` : html`<p class="quiet">${t('app.connecting')}</p>`}
    </main>`;
  return html`<main class="blank">
    ${logo}
    <h1>${t('app.refused')}</h1>
    <p class="quiet">${t('app.refusedHint')}</p>
    <code>frangia serve --new-link</code>
    <form class="row" @submit=${(event: SubmitEvent) => void enter(app, event)}>
      <label class="field grow"
        ><span>${t('app.password')}</span
        ><input name="password" type="password" autocomplete="current-password" required
      /></label>
      <button class="btn">${t('app.enter')}</button>
    </form>
    ${app.problem ? html`<p class="bad" role="alert">${plain(app.problem)}</p>` : ''}
  </main>`;
}

/** What a failure advises, as a button. */
function advice(app: App): TemplateResult | string {
  const step = app.state.project ? adviceStep(app.problem, app.step) : undefined;
  if (!step || !app.canOpen(step)) return '';
  return html`<button
    class="btn small"
    id="advice"
    @click=${() => {
      app.dismiss();
      app.go(step);
    }}
  >
    ${t('app.next', { step: app.titleOf(step) })}
  </button>`;
}

async function takeOver(app: App): Promise<void> {
  try {
    await app.session.takeOver();
    if (app.refused) app.dismiss();
  } catch (error) {
    app.say(error);
  }
}

/** Who operates, a lost connection, what went wrong, and what is held over the page. */
export function notices(app: App): TemplateResult {
  const lost = app.session.link === 'lost';
  // It stands in the refusal, where there is one.
  const refused = app.refused && app.problem !== '' && app.session.watches;
  const button = html`<button class="btn small" id="take-over" @click=${() => void takeOver(app)}>
    ${t('app.takeOver')}
  </button>`;
  return html`<div class="messages" role="region" aria-label=${t('app.messages')}>
    ${
      app.session.watches && !lost && !refused
        ? html`<div class="notice warn" role="status"><span>${t('app.watching')}</span>${button}</div>`
        : ''
    }
    ${lost ? html`<div class="notice warn" role="alert"><span>${t(app.session.blocked ? 'app.blocked' : 'app.lost')}</span></div>` : ''}
    ${
      app.problem && !lost
        ? html`<div class="notice" role="alert">
            <span>${refused ? t('app.watching') : plain(app.problem)}</span>
            ${refused ? button : advice(app)}
            <button class="icon-btn" aria-label=${t('app.dismiss')} @click=${() => app.dismiss()}>
              ${icon('close')}
            </button>
          </div>`
        : ''
    }
    ${app.opening.over ? html`<div class="drop" popover="manual">${t('open.drop')}</div>` : ''}
  </div>`;
}
