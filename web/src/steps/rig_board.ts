import { html, type TemplateResult } from 'lit';
import type { App } from '../app';
import { icon } from '../icons';
import { t } from '../messages';

/** Corners of the boards that are printed here. */
const CORNERS = { columns: 10, rows: 7 };
const PAPERS = [
  ['a4', 'A4'],
  ['a3', 'A3'],
  ['letter', 'Letter'],
] as const;

/** Whether camera and board are computed, so that the size of its squares is known without a ruler. */
const isSimulated = (app: App): boolean =>
  app.project.devices.some(({ table, driver }) => table === 'camera' && driver === 'simulated');

/** A number of the board, or of its poses; without a value the field waits for what was measured. */
export const boardField = (name: string, label: string, value: number | null, step = 1): TemplateResult =>
  html`<label class="field"
    ><span>${label}</span
    ><input
      class="num"
      name=${name}
      type="number"
      min=${step < 1 ? 0.1 : 3}
      max="100"
      step=${step}
      required
      .defaultValue=${value === null ? '' : String(value)}
  /></label>`;

/** What describes a checkerboard. The side of a square is that of the ruler, never that of the file. */
export const boardFields = (app: App): TemplateResult =>
  html`${boardField('columns', t('rig.columns'), CORNERS.columns)}${boardField('rows', t('rig.rows'), CORNERS.rows)}${boardField('square_mm', t('rig.square'), isSimulated(app) ? 14 : null, 0.01)}`;

/** The board of a form with these fields. */
export function boardOf(form: FormData): Record<string, number> {
  return Object.fromEntries(['columns', 'rows', 'square_mm'].map((name) => [name, Number(form.get(name))]));
}

/** Boards to print; a printer scales them, so that their squares are measured afterwards. */
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
