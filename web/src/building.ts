import { html, type TemplateResult } from 'lit';
import { t } from './messages';
import { numeric } from './number_field';
import { type Limits, readNumber } from './written_numbers';
import type { Store } from './store';
import { term } from './terms';

/** How the surface is built from the scan. */
export interface BuildSettings {
  voxel_mm: number;
  watertight: boolean;
  max_triangles: number;
}

type NumberField = 'voxel_mm' | 'max_triangles';

/** Limits that the server keeps as well. */
const LEAST_VOXEL_MM = 0.001;
const FEWEST_TRIANGLES = 4;
const MOST_TRIANGLES = 1e9;

/** What is asked for when the surface is built, for the first time or again. What was entered stays for the next build. */
export class Building {
  private entered: Record<NumberField, string> = { voxel_mm: '', max_triangles: '' };
  private watertight = false;
  private wrong = new Set<NumberField>();

  constructor(
    private readonly app: Store,
    private readonly start: (settings: Partial<BuildSettings>) => Promise<void>,
  ) {}

  forget(): void {
    this.entered = { voxel_mm: '', max_triangles: '' };
    this.watertight = false;
    this.wrong.clear();
  }

  /** Builds with what the form holds; a field that holds no such number says so instead. */
  readonly submit = (event: SubmitEvent): void => {
    event.preventDefault();
    const form = event.target as HTMLFormElement;
    const settings: Partial<BuildSettings> = { watertight: this.watertight };
    this.wrong.clear();
    for (const name of ['voxel_mm', 'max_triangles'] as const) {
      const input = form.elements.namedItem(name) as HTMLInputElement;
      if (!input.validity.valid) this.wrong.add(name);
      else if (input.value) settings[name] = readNumber(input.value, name === 'max_triangles');
    }
    this.app.requestUpdate();
    if (this.wrong.size === 0) {
      void this.start(settings);
      return;
    }
    const [first] = this.wrong;
    const input = form.elements.namedItem(first as string) as HTMLInputElement;
    input.closest('details')?.setAttribute('open', '');
    input.focus();
  };

  private number(name: NumberField, label: TemplateResult, limits: Limits): TemplateResult {
    const wrong = this.wrong.has(name);
    const enter = (event: Event) => {
      this.entered[name] = (event.target as HTMLInputElement).value;
      if (this.wrong.delete(name)) this.app.requestUpdate();
    };
    return html`<label class="field"
        ><span>${label}</span
        ><input
          class="num"
          name=${name}
          placeholder=${t(name === 'voxel_mm' ? 'build.voxelAuto' : 'build.trianglesAll')}
          aria-invalid=${wrong}
          aria-describedby=${wrong ? `wrong-${name}` : ''}
          .defaultValue=${this.entered[name]}
          ${numeric(limits)}
          ?disabled=${this.app.busy || this.app.session.watches}
          @input=${enter}
      /></label>
      ${
        wrong
          ? html`<p class="bad" role="alert" id="wrong-${name}">
              ${t(name === 'voxel_mm' ? 'build.voxelWrong' : 'build.trianglesWrong')}
            </p>`
          : ''
      }`;
  }

  /** Resolution, largest number of triangles, and whether holes are closed. */
  fields(): TemplateResult {
    return html`${this.number('voxel_mm', html`${t('build.voxel')}${term('voxel')}`, { min: LEAST_VOXEL_MM, step: 0.1 })}
      ${this.number('max_triangles', html`${t('build.triangles')}`, { min: FEWEST_TRIANGLES, max: MOST_TRIANGLES, whole: true, step: 1000 })}
      <label class="switch"
        >${t('build.watertight')}<input
          type="checkbox"
          name="watertight"
          .checked=${this.watertight}
          ?disabled=${this.app.busy || this.app.session.watches}
          @change=${(event: Event) => (this.watertight = (event.target as HTMLInputElement).checked)}
      /></label>`;
  }
}
