import { html, svg, type TemplateResult } from 'lit';
import type { App } from '../app';
import { fringePaths } from '../fringes';
import { icon } from '../icons';
import { currentLanguage, t } from '../messages';

const FRINGES = fringePaths(720, 420);

const when = (seconds: number): string =>
  new Date(seconds * 1000).toLocaleString(currentLanguage() === 'de' ? 'de-DE' : 'en-GB', { dateStyle: 'medium', timeStyle: 'short' });

/** A name that no project has yet: "Bust", "Bust 2", ... */
function freeName(wanted: string, taken: string[]): string {
  const base = wanted.charAt(0).toUpperCase() + wanted.slice(1);
  for (let i = 1; ; i++) {
    const name = i === 1 ? base : `${base} ${i}`;
    if (!taken.includes(name)) return name;
  }
}

export function projectStep(app: App): TemplateResult {
  const state = app.state;
  const taken = state.projects.map((one) => one.name);
  const create = (event: SubmitEvent) => {
    event.preventDefault();
    const form = new FormData(event.target as HTMLFormElement);
    void app.create(String(form.get('name')).trim(), String(form.get('part')), Number(form.get('stations')));
  };
  return html`<main class="home">
    <section class="hero">
      <svg class="fringes" viewBox="0 0 760 420" preserveAspectRatio="xMidYMid slice" aria-hidden="true">
        ${FRINGES.map(({ d, strength }) => svg`<path d=${d} opacity=${strength.toFixed(2)} />`)}
      </svg>
      <div class="hero-text">
        <h1>${t('home.title')}</h1>
        <p>${t('home.lead')}</p>
        <button class="btn primary big" id="try" @click=${() => app.create(freeName('bust', taken), 'bust', 8)}>
          ${icon('play')}${t('home.try')}
        </button>
        <p class="quiet">${t('home.tryHint')}</p>
      </div>
    </section>
    <div class="home-grid">
      <section>
        <h2>${t('home.recent')}</h2>
        <div class="cards">
          ${state.projects.length === 0 ? html`<p class="quiet">${t('home.none')}</p>` : ''}
          ${state.projects.map(
            (one) => html`<button class="card" @click=${() => app.open(one.name)}>
              ${icon('folder')}<b>${one.name}</b>
              <span class="quiet num">${when(one.modified_s)}</span>
              <span class="tag ${one.has_surface ? 'on' : ''}"
                >${one.has_surface ? t('home.surface') : one.scanned ? t('home.scanned') : t('home.empty')}</span
              >
            </button>`,
          )}
        </div>
      </section>
      <section>
        <h2>${t('home.new')}</h2>
        <form class="form" @submit=${create}>
          <label class="field"><span>${t('home.name')}</span><input name="name" required maxlength="60" autocomplete="off" /></label>
          <div class="pair">
            <label class="field"><span>${t('home.part')}</span
              ><select name="part">${state.parts.map((part) => html`<option ?selected=${part === 'bust'}>${part}</option>`)}</select></label>
            <label class="field"><span>${t('home.stations')}</span
              ><input name="stations" class="num" type="number" min="2" max="72" value="8" required /></label>
          </div>
          <button class="btn wide">${t('home.create')}</button>
        </form>
      </section>
    </div>
  </main>`;
}
