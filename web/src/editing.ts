import type { Store } from './store';
import type { Inspecting } from './inspecting';
import { t } from './messages';
import type { ModifierKeys, Tool } from './viewer';

/** What a selection does with the present one. */
export type Combine = 'replace' | 'add' | 'without' | 'within';

const NO_KEYS: ModifierKeys = { shift: false, ctrl: false };

const round = (value: number): string => String(Math.round(value * 1000) / 1000);

/** What is alike where the selection takes what is like a triangle. */
export const LIKENESSES = ['normal', 'curvature', 'sigma', 'mark'] as const;
export type Likeness = (typeof LIKENESSES)[number];
/** Radius of the brush, pixels. */
const BRUSH = { least: 4, most: 120, step: 1.25 };

/** Selections, edits and their previews, as the step Edit asks for them. */
export class Editing {
  combine: Combine = 'replace';
  likeness: Likeness = 'normal';
  /** Holes that were chosen, by number, of the mesh of a revision. */
  private chosen = { revision: -1, holes: new Set<number>() };
  private previewFocused = -1;

  constructor(
    private readonly app: Store,
    private readonly inspecting: Inspecting,
  ) {}

  setCombine(combine: Combine): void {
    this.combine = combine;
    this.app.requestUpdate();
  }
  setLikeness(likeness: Likeness): void {
    this.likeness = likeness;
    this.app.requestUpdate();
  }
  setBrush(radius: number): void {
    this.app.viewer.brush = Math.round(Math.min(BRUSH.most, Math.max(BRUSH.least, radius)));
    this.app.requestUpdate();
  }
  /** A key makes the brush larger or smaller. */
  growBrush(larger: boolean): void {
    this.setBrush(this.app.viewer.brush * (larger ? BRUSH.step : 1 / BRUSH.step));
  }
  get chosenHoles(): Set<number> {
    const revision = this.app.project.surface?.mesh_revision ?? -1;
    if (revision !== this.chosen.revision) this.chosen = { revision, holes: new Set() };
    return this.chosen.holes;
  }
  chooseHole(hole: number, chosen: boolean): void {
    if (chosen) this.chosenHoles.add(hole);
    else this.chosenHoles.delete(hole);
    this.app.requestUpdate();
  }

  run(operation: string, value = ''): void {
    void this.app.command('edit', { operation, value });
  }
  /** Tries an edit; it is applied when it has been looked at. */
  preview(operation: string, value = ''): void {
    void this.app.command('preview', { operation, value });
  }
  applyPreview(): void {
    const preview = this.app.project.surface?.preview;
    if (!preview) return;
    if (this.app.viewer.tool === 'align') this.app.setTool('orbit');
    this.run(preview.operation, preview.value);
  }
  /** Brings the marks of the chosen holes, or of what was inspected, into the picture, and the focus to a new preview. */
  follow(): void {
    const { app } = this;
    const surface = app.session.state?.project?.surface;
    const chosen = app.step === 'edit' && surface ? this.chosenHoles : new Set<number>();
    if (app.step === 'inspect' && surface) app.viewer.mark(this.inspecting.marks);
    else app.viewer.mark((surface?.holes ?? []).filter((hole) => chosen.has(hole.number)));
    this.focusPreview();
  }
  /** Puts the focus on what applies a new preview, so that Enter does; the button that asked for it was disabled. */
  private focusPreview(): void {
    const revision = this.app.session.state?.project?.surface?.preview?.revision ?? -1;
    const apply = this.app.querySelector<HTMLButtonElement>('#apply:not([disabled])');
    if (revision === this.previewFocused || !apply) return;
    this.previewFocused = revision;
    if (!document.activeElement?.matches('input, select, textarea')) apply.focus({ preventScroll: true });
  }

  async selectBy(operation: string, value: string, keys = NO_KEYS): Promise<void> {
    if (await this.prepareCombination(keys)) this.run(operation, value);
  }
  /** Selects the connected part that holds a triangle, or all that is like it. */
  async selectByTriangle(tool: 'part' | 'like', triangle: number, keys: ModifierKeys): Promise<void> {
    if (!(await this.prepareCombination(keys))) return;
    if (tool === 'part') await this.app.command('select-component-of', { triangle });
    else await this.app.command('select-like', { triangle, by: this.likeness });
  }
  /** Shift adds, Ctrl takes out, both intersect, whatever is chosen in the panel. */
  private combineOf({ shift, ctrl }: ModifierKeys): Combine {
    if (shift) return ctrl ? 'within' : 'add';
    return ctrl ? 'without' : this.combine;
  }
  private async prepareCombination(keys: ModifierKeys): Promise<boolean> {
    const combine = this.combineOf(keys);
    if (combine === 'replace') return true;
    if (this.app.project.surface?.selected) return this.app.command('edit', { operation: combine, value: '' });
    if (combine === 'add') return true;
    this.app.say(t('edit.nothingToTakeFrom'));
    return false;
  }

  /** Points of the surface that a tool was used at. */
  async picked(tool: Tool, points: [number, number, number][], keys: ModifierKeys): Promise<void> {
    // The tool stays: faces that cannot be aligned are chosen anew.
    if (tool === 'align') return this.preview('align', points.flat().map(round).join(','));
    const [at] = points;
    const holes = this.app.project.surface?.holes ?? [];
    if (!at || holes.length === 0) return;
    const far = ([x, y, z]: readonly number[]) =>
      Math.hypot((x as number) - at[0], (y as number) - at[1], (z as number) - at[2]);
    const nearest = holes.reduce((best, hole) =>
      far(hole.center_mm) - hole.size_mm / 2 < far(best.center_mm) - best.size_mm / 2 ? hole : best,
    );
    this.chooseHole(nearest.number, true);
    await this.selectBy('select-loop', String(nearest.number), keys);
  }
}
