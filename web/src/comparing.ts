import type { App } from './app';
import { t } from './messages';

/** A reference that is sent to the server, and the comparison with it. */
export class Comparing {
  align: 'best-fit' | 'none' = 'best-fit';
  /** Share of a reference that has been sent; null while none is. */
  sent: number | null = null;

  /** Whether the deviations are shown when they come. */
  private wanted = false;

  constructor(private readonly app: App) {}

  async send(file: File): Promise<void> {
    const { app } = this;
    const format = /\.(stl|ply|obj|3mf|step|stp)$/i.exec(file.name)?.[1]?.toLowerCase();
    if (!format) return app.say(t('compare.wrongFile'));
    try {
      this.sent = 0;
      await app.session.sendReference(file, format, (share) => {
        this.sent = share;
        app.requestUpdate();
      });
      this.sent = null;
      await this.compare(-0.1, 0.1);
    } catch (error) {
      app.say(error);
    }
    this.sent = null;
    app.requestUpdate();
  }
  setAlign(align: Comparing['align']): void {
    this.align = align;
    this.app.requestUpdate();
  }
  async compare(lower: number, upper: number, start = 1): Promise<void> {
    this.wanted = await this.app.command('compare', { align: this.align, start, lower_mm: lower, upper_mm: upper });
  }
  /** Shows the deviations that were asked for, and none that there are no longer. */
  follow(): void {
    const { app } = this;
    const compared = Boolean(app.state.project?.surface?.comparison);
    if (!app.job('compare') && this.wanted) {
      this.wanted = false;
      if (compared) app.setLook({ coloring: 'deviation' });
    }
    if (!compared && app.look.coloring === 'deviation') app.setLook({ coloring: 'plain' });
  }
}
