import { html, svg, type TemplateResult } from 'lit';
import type { App } from '../app';
import { fringePaths } from '../fringes';
import { icon } from '../icons';
import { currentLanguage, type MessageKey, t } from '../messages';
import { choice } from '../ui';

const FRINGES = fringePaths(720, 420);

const when = (seconds: number): string =>
  new Date(seconds * 1000).toLocaleString(currentLanguage() === 'de' ? 'de-DE' : 'en-GB', {
    dateStyle: 'medium',
    timeStyle: 'short',
  });

/** A name that no project has yet: "Bust", "Bust 2", ... */
function freeName(wanted: string, taken: string[]): string {
  const base = wanted.charAt(0).toUpperCase() + wanted.slice(1);
  for (let i = 1; ; i++) {
    const name = i === 1 ? base : `${base} ${i}`;
    if (!taken.includes(name)) return name;
  }
}

/** Where the rig of a new project comes from. */
export const SOURCES = ['simulated', 'devices', 'file', 'example'] as const;
export type Source = (typeof SOURCES)[number];

/** The rig.toml among chosen files, and the CSV file with its covariance. */
async function rigOf(files: FileList): Promise<{ rig: string; covariance: string }> {
  const texts = { rig: '', covariance: '' };
  for (const file of files) {
    const text = await file.text();
    if (file.name.toLowerCase().endsWith('.csv')) texts.covariance = text;
    else texts.rig = text;
  }
  return texts;
}

function sourceFields(app: App): TemplateResult {
  const { state } = app;
  if (app.projects.source === 'simulated')
    return html`<label class="field"
      ><span>${t('home.part')}</span
      ><select name="part">
        ${state.parts.map((part) => html`<option ?selected=${part === 'bust'}>${part}</option>`)}
      </select></label
    >`;
  if (app.projects.source === 'file')
    return html`<p class="quiet note">${t('home.file')}</p>
      <label class="btn choose"
        >${icon('folder')}<span
          >${app.projects.files.length ? app.projects.files.join(', ') : t('home.chooseFile')}</span
        >
        <input
          name="files"
          class="sr"
          type="file"
          accept=".toml,.csv"
          multiple
          required
          @change=${(event: Event) => app.projects.setFiles([...((event.target as HTMLInputElement).files ?? [])].map((file) => file.name))}
      /></label>`;
  if (app.projects.source === 'example')
    return html`<label class="field"
        ><span>${t('home.example')}</span
        ><select
          name="example"
          @change=${(event: Event) => app.projects.setExample((event.target as HTMLSelectElement).value)}
        >
          ${state.examples.map(({ name }) => html`<option value=${name} ?selected=${name === app.projects.example}>${name}</option>`)}
        </select></label
      >
      <p class="quiet note">
        ${state.examples.find(({ name }) => name === app.projects.example)?.description.replaceAll('`', '') ?? ''}
      </p>`;
  return html`<p class="quiet note">${t('home.devicesHint')}</p>`;
}

function newProject(app: App): TemplateResult {
  const create = async (event: SubmitEvent) => {
    event.preventDefault();
    const form = new FormData(event.target as HTMLFormElement);
    const common = { name: String(form.get('name')).trim(), stations: Number(form.get('stations')) };
    const files = (event.target as HTMLFormElement).querySelector<HTMLInputElement>('input[type=file]')?.files;
    if (app.projects.source === 'simulated') await app.projects.create({ ...common, part: String(form.get('part')) });
    else if (app.projects.source === 'devices') await app.projects.create({ ...common, devices: true });
    else if (app.projects.source === 'example')
      await app.projects.create({ ...common, example: String(form.get('example')) });
    else if (files) await app.projects.create({ ...common, ...(await rigOf(files)) });
  };
  return html`<form class="form" @submit=${(event: SubmitEvent) => void create(event)}>
    <div class="name">
      <label class="field"
        ><span>${t('home.name')}</span><input name="name" required maxlength="60" autocomplete="off"
      /></label>
      <label class="field"
        ><span>${t('home.stations')}</span
        ><input name="stations" class="num" type="number" min="2" max="360" value="8" required
      /></label>
    </div>
    <div class="field">
      <span>${t('home.source')}</span>
      ${choice<Source>(
        t('home.source'),
        app.projects.source,
        SOURCES.map((source) => [source, t(`home.source.${source}` as MessageKey)] as const),
        (source) => app.projects.setSource(source),
      )}
    </div>
    ${sourceFields(app)}
    <button class="btn wide">${t('home.create')}</button>
  </form>`;
}

export function projectStep(app: App): TemplateResult {
  const state = app.state;
  const taken = state.projects.map((one) => one.name);
  return html`<main class="home">
    <section class="hero">
      <svg class="fringes" viewBox="0 0 760 420" preserveAspectRatio="xMidYMid slice" aria-hidden="true">
        ${FRINGES.map(({ d, strength }) => svg`<path d=${d} opacity=${strength.toFixed(2)} />`)}
      </svg>
      <div class="hero-text">
        <h1>${t('home.title')}</h1>
        <p>${t('home.lead')}</p>
        <button
          class="btn primary big"
          id="try"
          @click=${() => app.projects.create({ name: freeName('bust', taken), part: 'bust', stations: 8 })}
        >
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
            (one) =>
              html`<button class="card" @click=${() => app.projects.open(one.name)}>
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
        ${newProject(app)}
      </section>
    </div>
  </main>`;
}
