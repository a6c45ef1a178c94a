import type { App } from './app';
import { t } from './messages';
import { requireSendable } from './opening';

/** A reference that is sent to the server, and the comparison with it. */
export class Comparing {
  align: 'best-fit' | 'none' = 'best-fit';
  /** Share of a reference that has been sent; null while none is. */
  sent: number | null = null;

  /** The comparison that was there when a new one was asked for, whose deviations are shown when it comes. */
  private wantedAfter: number | null = null;

  constructor(private readonly app: App) {}

  async send(file: File): Promise<void> {
    const { app } = this;
    const format = /\.(stl|ply|obj|3mf|step|stp)$/i.exec(file.name)?.[1]?.toLowerCase();
    if (!format) return app.say(t('compare.wrongFile'));
    try {
      requireSendable(file.size);
      this.sent = 0;
      await app.session.send(file, (share) => {
        this.sent = share;
        app.requestUpdate();
      });
      await app.session.command('set-reference', { name: file.name.slice(0, 120), format, bytes: file.size });
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
    const before = this.revision;
    if (await this.app.command('compare', { align: this.align, start, lower_mm: lower, upper_mm: upper }))
      this.wantedAfter = before;
    this.follow();
  }
  private get revision(): number {
    return this.app.state.project?.surface?.comparison?.revision ?? -1;
  }
  /** Shows the deviations that were asked for, and none that there are no longer. */
  follow(): void {
    const { app, revision } = this;
    const compared = revision >= 0;
    if (compared && this.wantedAfter !== null && this.wantedAfter !== revision) {
      this.wantedAfter = null;
      app.setLook({ coloring: 'deviation' });
    }
    if (!compared && app.look.coloring === 'deviation') app.setLook({ coloring: 'plain' });
  }
}
