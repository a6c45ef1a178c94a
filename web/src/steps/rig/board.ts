import { html, type TemplateResult } from 'lit';
import type { BoardKind } from '../../arranging';
import type { App } from '../../parts';
import { icon } from '../../icons';
import { t } from '../../messages';
import { numeric } from '../../number_field';
import { numberIn, shownNumber } from '../../written_numbers';
import { choice } from '../../ui';

const PAPERS = [
  ['a5', 'A5'],
  ['a4', 'A4'],
  ['letter', 'Letter'],
  ['a3', 'A3'],
] as const;
/** Length of the ruler on a printed board, where the printer did not scale it, mm. */
const RULER = 100;

/** Whether camera and board are computed, so that a print is known without a ruler. */
const isSimulated = (app: App): boolean =>
  app.project.devices.some(({ table, driver }) => table === 'camera' && driver === 'simulated');

/** A number of the board, or of its poses; without a value the field waits for what was measured. */
export const boardField = (name: string, label: string, value: number | null, step = 1): TemplateResult =>
  html`<label class="field"
    ><span>${label}</span
    ><input
      class="num"
      name=${name}
      required
      .defaultValue=${shownNumber(value)}
      ${numeric({ min: step < 1 ? 0.1 : 3, max: name === 'ruler_mm' ? 199 : 100, step, whole: step === 1 })}
  /></label>`;

/** What describes a checkerboard. Nothing is filled in: it is counted and measured. */
export const boardFields = (): TemplateResult =>
  html`${boardField('columns', t('rig.columns'), null)}${boardField('rows', t('rig.rows'), null)}${boardField('square_mm', t('rig.square'), null, 0.01)}`;

/** The board of the calibration, and how many poses of it. */
export const calibrationFields = (app: App): TemplateResult =>
  html`${choice<BoardKind>(
    t('board.kind'),
    app.arranging.boardKind,
    [
      ['printed', t('board.printed')],
      ['own', t('board.own')],
    ],
    (kind) => app.arranging.setBoardKind(kind),
  )}
  ${
    app.arranging.boardKind === 'printed'
      ? html`<p class="quiet">${t('board.names')}</p>
          <div class="four">
            ${boardField('ruler_mm', t('board.ruler'), isSimulated(app) ? RULER : null, 0.01)}${boardField('poses', t('rig.poses'), 12)}
          </div>`
      : html`<div class="four">${boardFields()}${boardField('poses', t('rig.poses'), 12)}</div>`
  }`;

/** The numbers of a form with such fields. */
export function boardOf(form: FormData): Record<string, number> {
  const fields = ['columns', 'rows', 'square_mm', 'ruler_mm', 'poses'].filter((name) => form.has(name));
  return Object.fromEntries(fields.map((name) => [name, numberIn(form, name) ?? NaN]));
}

/** Boards to print. */
export const boardPrints = (app: App): TemplateResult =>
  html`<details class="more" ?open=${!isSimulated(app) && !app.project.rig}>
    <summary>${t('board.print')}</summary>
    <p class="quiet">${t('board.hint')}</p>
    <div class="row">
      ${PAPERS.map(
        ([paper, name]) =>
          html`<button
            class="btn small grow"
            data-paper=${paper}
            ?disabled=${app.occupied || app.session.watches}
            @click=${() => void app.exporting.print(paper)}
          >
            ${icon('download')}${name}
          </button>`,
      )}
    </div>
  </details>`;
