import type { Store } from './store';
import type { Station } from './types';

/** The setup in which the part lies now. */
export const presentSetup = (stations: readonly Station[]): number => stations.at(-1)?.setup ?? 0;

/** The setups of the part: which one the step Scan shows, and turning the part over. */
export class Setups {
  private chosen: number | null = null;
  /** Whether the page guides through turning the part over. */
  turning = false;

  constructor(
    private readonly app: Store,
    private readonly whenChosen: () => void,
  ) {}

  forget(): void {
    this.chosen = null;
    this.turning = false;
  }
  /** The setup whose stations the step Scan shows. */
  get shown(): number {
    return Math.min(this.chosen ?? Infinity, presentSetup(this.app.session.state?.project?.stations ?? []));
  }
  show(setup: number | null): void {
    this.chosen = setup;
    this.whenChosen();
    this.app.requestUpdate();
  }
  turn(turning: boolean): void {
    this.turning = turning;
    this.app.requestUpdate();
  }
  async scanNext(): Promise<void> {
    const setup = presentSetup(this.app.project.stations) + 1;
    if (!(await this.app.command('start-scan', { setup }))) return;
    this.turn(false);
    this.show(null);
  }
}
