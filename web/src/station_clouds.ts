import { type MeshArrays, meshOf, unpack } from './arrays';
import type { StepName } from './step_names';
import { Refusal, type Session } from './session';
import type { Viewer } from './viewer';

/** Brings the points of the stations into the picture while a scan grows. */
export class StationClouds {
  /** The number of points that is shown of each station. */
  private readonly shown = new Map<number, number>();
  /** The revision of the coarse surface that is shown; 0 for none. */
  private grown = 0;

  constructor(
    private readonly session: Session,
    private readonly viewer: Viewer,
    private readonly added: () => void,
    private readonly failed: (error: unknown) => void,
  ) {}

  forget(): void {
    this.shown.clear();
    this.grown = 0;
    this.viewer.clearClouds();
  }

  /** Each setup stands in its own pose on the table: clouds of two would mix. */
  choose(step: StepName, setup: number): void {
    const stations = this.session.state?.project?.stations ?? [];
    this.viewer.showClouds(
      step === 'scan' || step === 'live',
      step === 'live',
      (station) => (stations[station]?.setup ?? 0) === setup,
    );
  }

  private showGrown(arrays: MeshArrays | null, stations: readonly number[]): void {
    this.viewer.clouds.setGrown(arrays, stations);
    this.viewer.draw();
  }
  /** Brings the coarse surface that the state names. */
  private async followGrown(): Promise<void> {
    const grown = this.session.state?.project?.grown ?? null;
    const revision = grown?.revision ?? 0;
    if (revision === this.grown) return;
    this.grown = revision;
    if (!grown) return this.showGrown(null, []);
    try {
      const arrays = meshOf(await this.session.bytes('/api/grown-surface'));
      if (this.grown !== revision) return;
      this.showGrown(arrays, grown.views);
      this.added();
    } catch (error) {
      if (!(error instanceof Refusal) || error.status !== 404) this.failed(error);
    }
  }

  /** Follows the state. */
  async follow(): Promise<void> {
    void this.followGrown();
    const stations = this.session.state?.project?.stations ?? [];
    for (const [i, station] of stations.entries()) {
      if (!station.has_cloud || this.shown.get(i) === station.points) continue;
      this.shown.set(i, station.points);
      try {
        const arrays = unpack(await this.session.bytes(`/api/clouds/${i}`));
        this.viewer.setCloud(i, arrays.get('positions') as Float32Array);
        this.added();
      } catch (error) {
        if (!(error instanceof Refusal) || error.status !== 404) this.failed(error);
      }
    }
  }
}
