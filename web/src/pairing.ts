import { html, type TemplateResult } from 'lit';
import type { Inspecting } from './inspecting';
import type { Store } from './store';
import { meshOf } from './arrays';
import type { Plan } from './inspection_types';
import { t } from './messages';
import type { Triple } from './types';
import type { Hit } from './viewer';

const PAIRS = 3;
const rounded = (point: Triple): Triple => point.map((one) => Number(one.toFixed(4))) as Triple;

/** Three places, each clicked on the surface and then on its reference, by which the part is aligned. */
export class Pairing {
  private pairs: NonNullable<Plan['points']> = [];
  private scan: Triple | null = null;
  /** How the part is aligned once the places are known. */
  private align: NonNullable<Plan['align']> = 'points';

  constructor(
    private readonly app: Store,
    private readonly inspecting: Inspecting,
  ) {}

  /** Begins to pick; the alignment is by the pairs alone, or a fit that begins there. */
  async begin(align: NonNullable<Plan['align']>): Promise<void> {
    const { app } = this;
    this.align = align;
    this.pairs = [];
    this.scan = null;
    app.viewer.setReference(null);
    app.setTool('pair');
    app.viewer.frame();
    if (!app.project.reference?.shown) await app.command('show-reference');
  }
  async picked({ point_mm }: Hit): Promise<void> {
    const { app } = this;
    if (!app.project.reference?.shown) return; // it is being read
    if (this.scan) {
      this.pairs.push({ scan_mm: rounded(this.scan), reference_mm: rounded(point_mm) });
      this.scan = null;
      app.viewer.setReference(null);
      if (this.pairs.length === PAIRS) return this.finish();
    } else {
      this.scan = point_mm;
      await this.showReference();
    }
    this.mark();
  }
  private async showReference(): Promise<void> {
    const { app } = this;
    try {
      app.viewer.setReference(meshOf(await app.session.bytes('/api/reference')));
    } catch (error) {
      this.scan = null;
      app.say(error);
    }
  }
  private finish(): void {
    const { pairs, align, app } = this;
    app.setTool('orbit');
    void this.inspecting.change({ align, points: pairs });
  }
  /** Shows the places that were clicked, on what is in the picture. */
  private mark(): void {
    const { app, pairs, scan } = this;
    app.viewer.showPending(scan ? pairs.map(({ reference_mm }) => reference_mm) : pairs.map(({ scan_mm }) => scan_mm));
    app.requestUpdate();
  }
  /** Another tool was chosen: what was picked so far is dropped. */
  follow(): void {
    const { app } = this;
    if (['pair', 'face'].includes(app.viewer.tool) || !app.viewer.showsReference) return;
    this.scan = null;
    app.viewer.setReference(null);
  }

  get hint(): string {
    const values = { number: this.pairs.length + 1, count: PAIRS };
    if (!this.app.project.reference?.shown) return t('pair.wait');
    return t(this.scan ? 'pair.onReference' : 'pair.onSurface', values);
  }
  /** Buttons of an alignment that may begin at pairs, or is by them. */
  panel(plan: Plan, off: boolean): TemplateResult | string {
    const { app } = this;
    if (plan.align !== 'best-fit' && plan.align !== 'points') return '';
    const picking = app.viewer.tool === 'pair';
    const known = (plan.points ?? []).length >= PAIRS;
    const { align } = plan;
    return html`<button
        class="btn wide small"
        id="pair"
        aria-pressed=${picking}
        ?disabled=${off}
        @click=${() => (picking ? app.setTool('orbit') : void this.begin(align))}
      >
        ${t(align === 'points' ? (known ? 'pair.again' : 'pair.pick') : known ? 'pair.again' : 'pair.start')}
      </button>
      ${
        known && align === 'best-fit'
          ? html`<button
              class="btn wide small"
              id="drop-pairs"
              ?disabled=${off}
              @click=${() => void this.inspecting.change({ points: [] })}
            >
              ${t('pair.drop')}
            </button>`
          : ''
      }`;
  }
}
