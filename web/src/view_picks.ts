import { type ModifierKeys, places, type Tool } from './pointer_strokes';
import type { Point } from './strokes';
import type { Triple } from './types';
import type { Hit, Ray, ViewerEvents } from './viewer_events';

interface Scene {
  readonly tool: Tool;
  rayThrough(point: Point): Ray;
  showPending(points: readonly Triple[]): void;
}

/** Clicks on the surface: each asks the server for the point of the exact mesh, and goes to whom the tool belongs to. */
export class ViewPicks {
  private points: Triple[] = [];
  private answered = Promise.resolve();

  constructor(
    private readonly scene: Scene,
    private readonly events: ViewerEvents,
  ) {}

  clicked(point: Point, keys: ModifierKeys): void {
    const { tool } = this.scene;
    this.ask(point, (hit) => {
      if (tool === this.scene.tool) this.onHit(hit, keys);
    });
  }
  /** Calls `found` in the order of the questions, whichever is answered first. */
  ask(point: Point, found: (hit: Hit) => void): void {
    const asked = this.events.pick(this.scene.rayThrough(point));
    this.answered = this.answered.then(async () => {
      const hit = await asked;
      if (hit) found(hit);
    });
  }
  /** Forgets points that were clicked and make nothing yet. */
  forget(): void {
    this.points = [];
    this.scene.showPending([]);
  }

  private onHit(hit: Hit, keys: ModifierKeys): void {
    const { scene, events } = this;
    const { tool } = scene;
    if (tool === 'part' || tool === 'like') return events.trianglePicked(tool, hit.triangle, keys);
    if (tool === 'loop' || tool === 'feature') return events.picked(tool, [hit.point_mm], keys);
    if (places(tool)) return events.placed(tool, hit);
    if (tool !== 'align') return;
    this.points.push(hit.point_mm);
    scene.showPending(this.points);
    if (this.points.length < 3) return;
    events.picked('align', this.points, keys);
    this.forget();
  }
}
