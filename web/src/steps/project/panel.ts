import { html, svg, type TemplateResult } from 'lit';
import type { App } from '../../parts';
import { fringePaths } from '../../fringes';
import { icon } from '../../icons';
import { isMessage, type MessageKey, moment, number, t } from '../../messages';
import { numeric } from '../../number_field';
import { numberIn } from '../../written_numbers';
import { freeName, type Source, SOURCES } from '../../projects';
import type { ProjectEntry } from '../../types';
import { acts, bytes, choice } from '../../ui';
import { term } from '../../terms';
import { rigWords } from '../../rig_facts';

const FRINGES = fringePaths(720, 420);

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

/** A word of the catalogue, or what stands for one that it does not have. */
const wordOr = (key: string, otherwise: string): string => (isMessage(key) ? t(key) : otherwise);

/** What an example is: in the reader's language, or as its file says where the catalogue does not have it. */
function exampleWords(example: { name: string; description: string } | undefined): string {
  return wordOr(`example.${example?.name}`, example?.description ?? '');
}

/** The kept rigs, of which one is chosen. */
const keptRigs = (app: App): TemplateResult =>
  html`<div class="rigs" role="radiogroup" aria-label=${t('home.source.kept')}>
    ${app.state.rigs.map(
      (rig, i) =>
        html`<div class="rig">
          <label
            ><input type="radio" name="kept" value=${rig.name} ?checked=${i === 0} /><b>${rig.name}</b
            ><span class="quiet num">${rigWords(rig)}</span></label
          >
          <button
            type="button"
            class="icon-btn"
            title=${t('rigs.discard')}
            aria-label="${t('rigs.discard')}: ${rig.name}"
            @click=${() => void app.projects.forgetRig(rig.name)}
          >
            ${icon('close')}
          </button>
        </div>`,
    )}
  </div>`;

function sourceFields(app: App): TemplateResult {
  const { state } = app;
  if (app.projects.source === 'kept') return keptRigs(app);
  if (app.projects.source === 'simulated')
    return html`<label class="field"
      ><span>${t('home.part')}</span
      ><select name="part">
        ${state.parts.map((part) => html`<option value=${part} ?selected=${part === 'bust'}>${wordOr(`part.${part}`, part)}</option>`)}
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
          ${state.examples.map(({ name }) => html`<option value=${name} ?selected=${name === app.projects.example}>${wordOr(`rigName.${name}`, name)}</option>`)}
        </select></label
      >
      <p class="quiet note">${exampleWords(state.examples.find(({ name }) => name === app.projects.example))}</p>`;
  return html`<p class="quiet note">${t('home.devicesHint')}</p>`;
}

function newProject(app: App): TemplateResult {
  const create = async (event: SubmitEvent) => {
    event.preventDefault();
    const form = new FormData(event.target as HTMLFormElement);
    const common = { name: String(form.get('name')).trim(), stations: numberIn(form, 'stations', true) ?? NaN };
    const files = (event.target as HTMLFormElement).querySelector<HTMLInputElement>('input[type=file]')?.files;
    if (app.projects.source === 'simulated') await app.projects.create({ ...common, part: String(form.get('part')) });
    else if (app.projects.source === 'kept')
      await app.projects.create({ ...common, kept_rig: String(form.get('kept')) });
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
        ><span>${t('home.stations')}${term('station')}</span
        ><input name="stations" class="num" value="8" required ${numeric({ min: 2, max: 360, whole: true })}
      /></label>
    </div>
    <div class="field">
      <span>${t('home.source')}</span>
      ${choice<Source>(
        t('home.source'),
        app.projects.source,
        SOURCES.filter((source) => source !== 'kept' || app.state.rigs.length > 0).map(
          (source) => [source, t(`home.source.${source}` as MessageKey)] as const,
        ),
        (source) => app.projects.setSource(source),
      )}
    </div>
    ${sourceFields(app)}
    <button class="btn wide">${t('home.create')}</button>
  </form>`;
}

/** A menu closes when something in it is chosen, by Escape, and when the focus leaves it; the focus stays at its button. */
function close(menu: HTMLDetailsElement): void {
  menu.open = false;
  menu.querySelector('summary')?.focus();
}
/** Before the button acts: a dialog that it opens gives the focus back to where it was then. */
const closeMenu = {
  capture: true,
  handleEvent: (event: Event): void =>
    close((event.currentTarget as HTMLElement).closest('details') as HTMLDetailsElement),
};
function closeByKey(event: KeyboardEvent): void {
  const menu = event.currentTarget as HTMLDetailsElement;
  if (event.key !== 'Escape' || !menu.open) return;
  event.stopPropagation();
  close(menu);
}
function closeBehind(event: FocusEvent): void {
  const menu = event.currentTarget as HTMLDetailsElement;
  if (!menu.contains(event.relatedTarget as Node | null)) menu.open = false;
}

function card(app: App, one: ProjectEntry): TemplateResult {
  const picture = app.projects.picture(one);
  const act = (key: MessageKey, name: string, run: () => Promise<void>) =>
    html`<button class="btn small" data-act=${name} ?disabled=${app.session.watches} @click=${() => void run()}>
      ${t(key)}
    </button>`;
  const state = one.has_surface ? 'home.surface' : one.scanned ? 'home.scanned' : 'home.empty';
  return html`<div class="project-card" data-project=${one.name}>
    <button class="card" @click=${() => app.projects.open(one.name)}>
      ${picture ? html`<img src=${picture} alt="" />` : icon('folder')}<b>${one.name}</b>
      <span class="quiet num">${moment(one.modified_s)}</span>
      <span class="tag ${one.has_surface ? 'on' : ''}">${t(state)}</span>
      ${one.notes ? html`<span class="notes quiet">${one.notes}</span>` : ''}
    </button>
    <details class="menu" @keydown=${closeByKey} @focusout=${closeBehind}>
      <summary class="icon-btn" title=${t('home.more')} aria-label="${t('home.more')}: ${one.name}">⋯</summary>
      <div class="acts" @click=${closeMenu}>
        ${act('home.rename', 'rename', () => app.projects.rename(one.name))}
        ${act('home.duplicate', 'duplicate', () => app.projects.duplicate(one.name))}
        ${act('home.notes', 'notes', () => app.projects.note(one))}
        ${act('home.discard', 'discard', () => app.projects.discard(one.name))}
      </div>
    </details>
  </div>`;
}

/** The projects that were deleted, each of which can be put back. */
function bin(app: App): TemplateResult | string {
  const { discarded, discarded_bytes: total } = app.state;
  const size = bytes(total, number);
  if (discarded.length === 0) return '';
  return html`<details class="more" id="bin">
    <summary>${t('home.bin', { count: discarded.length })}</summary>
    ${discarded.map(
      (name) =>
        html`<div class="file">
          <b>${name}</b><span></span>
          <button class="btn small" @click=${() => app.command('take-back-project', { name })}>
            ${icon('undo')}${t('home.takeBack')}
          </button>
        </div>`,
    )}
    <button
      class="btn small danger"
      id="empty-bin"
      ?disabled=${app.occupied || app.session.watches}
      @click=${() => app.projects.emptyBin(size)}
    >
      ${icon('trash')}${t('home.emptyBin')}, ${size}
    </button>
  </details>`;
}

function projectList(app: App): TemplateResult {
  const { projects } = app.state;
  const { sent } = app.opening;
  return html`<section>
    <div class="list-head">
      <h2>${t('home.recent')}</h2>
      <div class="row">
        <button class="btn small" id="open-file" @click=${() => app.opening.choose(false)}>
          ${icon('folder')}${sent === null ? t('open.file') : t('inspect.sending', { share: number(100 * sent) })}
        </button>
        <button class="btn small" id="open-folder" @click=${() => app.opening.choose(true)}>${t('open.folder')}</button>
      </div>
    </div>
    <p class="quiet">${t('open.hint')}</p>
    ${
      projects.length > 3
        ? html`<div class="field">
            <input
              id="search"
              type="search"
              autocomplete="off"
              aria-label=${t('home.search')}
              placeholder=${t('home.search')}
              .value=${app.projects.wanted}
              @input=${(event: Event) => app.projects.search((event.target as HTMLInputElement).value)}
            />
          </div>`
        : ''
    }
    <div class="cards">
      ${projects.length === 0 ? html`<p class="quiet">${t('home.none')}</p>` : ''}
      ${projects.length > 0 && app.projects.listed.length === 0 ? html`<p class="quiet">${t('home.noMatch')}</p>` : ''}
      ${app.projects.listed.map((one) => card(app, one))}
    </div>
    ${bin(app)}
  </section>`;
}

export function projectStep(app: App): TemplateResult {
  const state = app.state;
  const taken = state.projects.map((one) => one.name);
  const content = html`<section class="hero">
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
      ${projectList(app)}
      <section>
        <h2>${t('home.new')}</h2>
        ${newProject(app)}
      </section>
    </div>`;
  return html`<main class="home ${state.projects.length > 0 || state.rigs.length > 0 ? 'used' : ''}">
    ${acts(app, content)}
  </main>`;
}
