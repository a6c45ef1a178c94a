import { html, type TemplateResult } from 'lit';
import { type Combine, type Likeness, LIKENESSES } from '../../editing';
import type { App } from '../../parts';
import { icon, type IconName } from '../../icons';
import { type MessageKey, number, t } from '../../messages';
import { numeric } from '../../number_field';
import { numberIn, shownNumber } from '../../written_numbers';
import { choice, nextStep, numberForm } from '../../ui';
import { stepWords } from '../../step_words';
import type { Tool } from '../../viewer';
import { fitting, selectingByValue, shaping } from './more';

const SHOWN_HOLES = 6;

const tool = (name: IconName, key: MessageKey): TemplateResult => html`${icon(name)}<span>${t(key)}</span>`;

/** What the present tool needs to know. */
function toolSettings(app: App): TemplateResult | string {
  const { viewer, editing } = app;
  if (viewer.tool === 'brush')
    return html`<label class="slider"
      ><span>${t('edit.brushSize')}</span><b class="num">${number(2 * viewer.brush)} px</b>
      <input
        id="brush-size"
        type="range"
        min="4"
        max="120"
        .value=${String(viewer.brush)}
        @input=${(event: Event) => editing.setBrush((event.target as HTMLInputElement).valueAsNumber)}
    /></label>`;
  if (viewer.tool !== 'like') return '';
  return html`${choice<Likeness>(
      t('edit.like'),
      editing.likeness,
      LIKENESSES.map((one) => [one, t(`edit.like.${one}`)] as const),
      (one) => editing.setLikeness(one),
    )}
    <p class="quiet">${t('edit.likeHint')}</p>`;
}

function selecting(app: App): TemplateResult {
  const surface = app.project.surface;
  const selected = surface?.selected ?? 0;
  const run = (operation: string, value = '') => app.editing.run(operation, value);
  return html`<section class="group">
    <h2>
      ${t('edit.select')}<small
        >${selected ? t('edit.selected', { count: number(selected) }) : t('edit.nothing')}</small
      >
    </h2>
    <div class="tools-of">
      ${choice<Tool>(
        t('edit.select'),
        app.viewer.tool,
        [
          ['orbit', tool('orbit', 'edit.orbit')],
          ['brush', tool('brush', 'edit.brush')],
          ['lasso', tool('lasso', 'edit.lasso')],
          ['rectangle', tool('rectangle', 'edit.rectangle')],
          ['part', tool('part', 'edit.part')],
          ['like', tool('like', 'edit.like')],
          ['loop', tool('loop', 'edit.loop')],
        ],
        (tool) => app.setTool(tool),
      )}
    </div>
    ${toolSettings(app)}
    ${choice<Combine>(
      t('edit.mode'),
      app.editing.combine,
      [
        ['replace', t('edit.replace')],
        ['add', t('edit.add')],
        ['without', t('edit.without')],
        ['within', t('edit.within')],
      ],
      (combine) => app.editing.setCombine(combine),
    )}
    <p class="quiet for-mouse">${t('edit.modeKeys')}</p>
    <p class="quiet for-fingers">${t('edit.modeFingers')}</p>
    <label class="switch"
      >${t('edit.through')}<input
        type="checkbox"
        .checked=${app.viewer.through}
        @change=${(event: Event) => (app.viewer.through = (event.target as HTMLInputElement).checked)}
    /></label>
    <div class="row">
      <button class="btn small grow" ?disabled=${!selected} @click=${() => run('grow', '1')}>${t('edit.grow')}</button>
      <button class="btn small grow" ?disabled=${!selected} @click=${() => run('shrink', '1')}>
        ${t('edit.shrink')}
      </button>
      <button class="btn small grow" @click=${() => run('invert')}>${t('edit.invert')}</button>
    </div>
    <div class="pair">
      <button class="btn danger" id="delete" ?disabled=${!selected} @click=${() => run('delete')}>
        ${icon('trash')}${t('edit.delete')}
      </button>
      <button class="btn" id="smooth" ?disabled=${app.busy} @click=${() => app.editing.preview('smooth', '3')}>
        ${t('edit.smooth')}
      </button>
    </div>
  </section>`;
}

function repairing(app: App): TemplateResult {
  const surface = app.project.surface;
  if (!surface) return html``;
  const size = app.viewer.size.length();
  const more = surface.hole_count - SHOWN_HOLES;
  const chosen = app.editing.chosenHoles;
  const [one] = chosen;
  const off = app.busy;
  const fill = (flat: string) =>
    one === undefined
      ? app.editing.preview(`fill-holes${flat}`, `${Math.ceil(2 * size)}mm`)
      : app.editing.preview(`fill-hole${flat}`, String(one));
  const tolerance = Math.max(0.001, Number((size / 5000).toPrecision(1)));
  return html`<section class="group" id="holes">
      <h2>${t('edit.holes')}<small class="num">${surface.hole_count || ''}</small></h2>
      ${surface.hole_count === 0 ? html`<p class="quiet">${t('edit.noHoles')}</p>` : ''}
      ${surface.hole_count > 0 ? html`<p class="quiet">${t('edit.chooseHoles')}</p>` : ''}
      <div class="holes">
        ${surface.holes
          .slice(0, SHOWN_HOLES)
          .map(
            (hole) =>
              html`<label class="hole"
                ><input
                  type="checkbox"
                  data-hole=${hole.number}
                  .checked=${chosen.has(hole.number)}
                  aria-label=${t('edit.holeSize', { size: number(hole.size_mm, 2) })}
                  @change=${(event: Event) => app.editing.chooseHole(hole.number, (event.target as HTMLInputElement).checked)}
                /><span class="num">⌀ ${number(hole.size_mm, 2)} mm</span></label
              >`,
          )}
      </div>
      ${more > 0 ? html`<p class="quiet">${t('edit.more', { count: more })}</p>` : ''}
      ${
        surface.hole_count > 0
          ? html`<div class="pair">
                <button class="btn" id="fill" ?disabled=${off || chosen.size > 1} @click=${() => fill('')}>
                  ${one === undefined ? t('edit.fillAll', { count: surface.hole_count }) : t('edit.fillOne')}
                </button>
                <button class="btn" id="fill-flat" ?disabled=${off || chosen.size > 1} @click=${() => fill('-flat')}>
                  ${t('edit.fillFlat')}
                </button>
              </div>
              ${
                surface.hole_count > 1
                  ? html`<button
                      class="btn wide"
                      id="bridge"
                      ?disabled=${off || chosen.size !== 2}
                      @click=${() => app.editing.preview('bridge', [...chosen].join(','))}
                    >
                      ${t('edit.bridgeTwo')}
                    </button>`
                  : ''
              }`
          : ''
      }
    </section>
    <section class="group">
      <h2>${t('edit.repair')}</h2>
      <button class="btn wide" id="spikes" ?disabled=${app.busy} @click=${() => app.editing.preview('remove-spikes')}>
        ${t('edit.spikes')}
      </button>
      <button
        class="btn wide"
        id="keep-largest"
        ?disabled=${app.busy || surface.components < 2}
        @click=${() => app.editing.preview('keep-largest', '1')}
      >
        ${t('edit.islands')}
      </button>
      <form
        class="row"
        @submit=${(event: SubmitEvent) => {
          event.preventDefault();
          app.editing.preview('decimate', `${numberIn(new FormData(event.target as HTMLFormElement), 'tolerance')}mm`);
        }}
      >
        <label class="field grow"
          ><span>${t('edit.within_mm')}, mm</span>
          <input
            class="num"
            id="tolerance"
            name="tolerance"
            required
            .defaultValue=${shownNumber(tolerance)}
            ${numeric({ min: 0.0001, step: 0.01 })}
        /></label>
        <button class="btn" id="decimate" ?disabled=${app.busy}>${t('edit.decimate')}</button>
      </form>
      ${reducing(app, surface.triangles)}
    </section>`;
}

/** Reduces the mesh to at most a number of triangles, as other programs ask for. */
const reducing = (app: App, triangles: number): TemplateResult =>
  numberForm(
    'decimate-to',
    t('edit.mostTriangles'),
    Math.ceil(triangles / 2),
    t('edit.decimate'),
    app.busy,
    (value) => app.editing.preview('decimate-to', String(Math.max(4, value))),
    { min: 1, whole: true, step: 1000 },
  );

export function editStep(app: App): TemplateResult {
  const surface = app.project.surface;
  if (!surface) return html`<section class="group"><p class="quiet">${t('surface.none')}</p></section>`;
  return html`${selecting(app)}${selectingByValue(app)}${repairing(app)}${fitting(app)}${shaping(app)}
    <section class="group">
      <h2>${t('edit.history')}</h2>
      <div class="pair">
        <button class="btn" id="undo" ?disabled=${surface.steps_done === 0} @click=${() => app.command('undo')}>
          ${icon('undo')}${t('edit.undo')}
        </button>
        <button
          class="btn"
          id="redo"
          ?disabled=${surface.steps_done === surface.steps.length}
          @click=${() => app.command('redo')}
        >
          ${icon('redo')}${t('edit.redo')}
        </button>
      </div>
      ${surface.steps.length === 0 ? html`<p class="quiet">${t('edit.noHistory')}</p>` : ''}
      <ol class="history">
        ${surface.steps.map(
          (step, i) =>
            html`<li class=${i < surface.steps_done ? '' : 'undone'}>
              <div>${stepWords(step)}</div>
            </li>`,
        )}
      </ol>
    </section>
    ${nextStep(app, 'inspect', !surface.preview)}`;
}
