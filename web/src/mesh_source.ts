import { meshOf, unpack, valuesOf } from './arrays';
import { Refusal, type Session } from './session';
import type { Surface } from './types';
import type { Viewer } from './viewer';

const drawn = (): Promise<void> =>
  new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(() => resolve())));

/**
 * Brings the levels of detail of the surface and what is selected of them into the picture, as the state names them: the
 * coarsest level first, so that there is a picture at once.
 */
export class MeshSource {
  private previewShown = -1;
  private deviationShown = -1;
  private levelsDeviating = 0;
  private setupsShown = '';
  private running = false;
  private again = false;

  constructor(
    private readonly session: Session,
    private readonly viewer: Viewer,
    private readonly changed: () => void,
    private readonly failed: (error: unknown) => void,
  ) {}

  private get surface(): Surface | null {
    return this.session.state?.project?.surface ?? null;
  }
  /** Whether the level that is drawn at rest is there. */
  get fine(): boolean {
    const { surface, viewer } = this;
    const levels = surface?.levels ?? [];
    return (
      levels.length > 0 &&
      viewer.levelsShown === levels.length &&
      (levels.length > 1 || levels[0]?.triangles === surface?.triangles)
    );
  }

  forget(): void {
    this.viewer.clearMesh();
    this.viewer.setPreview(null);
    this.previewShown = -1;
    this.deviationShown = -1;
  }

  /** Brings the points of the joined setups, which colour the mesh. */
  async showSetups(): Promise<void> {
    const key = JSON.stringify([this.session.state?.project?.name, this.surface?.version, this.surface?.summary]);
    if (key === this.setupsShown) return;
    this.setupsShown = key;
    const joined = (this.surface?.summary?.setups ?? []).filter((setup) => setup.joined);
    try {
      const clouds: Float32Array[] = [];
      for (let i = 0; i < joined.length; i++)
        clouds.push(unpack(await this.session.bytes(`/api/setups/${i}`)).get('positions') as Float32Array);
      this.viewer.setSetups(clouds);
    } catch (error) {
      this.setupsShown = '';
      this.failed(error);
    }
  }

  /** Follows the state. */
  async follow(): Promise<void> {
    this.again = true;
    if (this.running) return;
    this.running = true;
    try {
      while (this.again) {
        const { surface, viewer } = this;
        viewer.setIncomplete(
          surface !== null &&
            (viewer.meshShown !== surface.mesh_revision || this.selectionShown !== surface.selection_revision),
        );
        this.again = false;
        const { state } = this.session;
        try {
          await this.step();
        } catch (error) {
          // What is there no longer is of a state that is over: the one after it is followed now, or when it comes.
          if (this.session.state !== state) this.again = true;
          else if (!(error instanceof Refusal && error.status === 404)) this.failed(error);
        }
      }
    } finally {
      this.viewer.setIncomplete(false);
      this.running = false;
    }
  }

  private async step(): Promise<void> {
    const { surface, viewer } = this;
    if (!surface) {
      if (viewer.shown) this.forget();
      return;
    }
    if (viewer.meshShown !== surface.mesh_revision) {
      this.deviationShown = -1;
      if (!viewer.recallMesh(surface.mesh_revision, surface.selection_revision) && !(await this.addLevel(surface, 0)))
        return;
    }
    await this.select(surface);
    await this.preview(surface);
    await this.compare(surface);
    if (viewer.levelsShown >= surface.levels.length) return;
    await drawn();
    if (viewer.meshShown !== this.surface?.mesh_revision || !(await this.addLevel(surface, viewer.levelsShown))) return;
    this.again = true;
  }

  private async addLevel(surface: Surface, level: number): Promise<boolean> {
    const bytes = await this.session.bytes(`/api/levels/${level}`);
    if (valuesOf<{ revision: number }>(bytes).revision !== surface.mesh_revision) return false; // a newer state comes
    this.viewer.addLevel(surface.mesh_revision, meshOf(bytes));
    this.deviationShown = -1;
    this.changed();
    return true;
  }

  /** The selection in the picture; -1 where it is not that of the mesh shown. */
  get selectionShown(): number {
    return this.viewer.selected.levels > 0 ? this.viewer.selected.revision : -1;
  }

  private async select(surface: Surface): Promise<void> {
    const { viewer } = this;
    const { revision, levels } = viewer.selected;
    for (let level = revision === surface.selection_revision ? levels : 0; level < viewer.levelsShown; level++) {
      let flags: Uint8Array | null = null;
      if (surface.selected)
        flags =
          (unpack(await this.session.bytes(`/api/selection/${level}`)).get('selected') as Uint8Array | undefined) ??
          null;
      if (viewer.meshShown !== surface.mesh_revision || this.surface?.selection_revision !== surface.selection_revision)
        return;
      viewer.setSelection(level, flags, surface.selection_revision);
    }
  }

  private async preview(surface: Surface): Promise<void> {
    const revision = surface.preview?.revision ?? -1;
    if (revision === this.previewShown) return;
    this.viewer.setPreview(surface.preview ? unpack(await this.session.bytes('/api/preview')) : null);
    this.previewShown = revision;
  }

  private async compare(surface: Surface): Promise<void> {
    const { viewer } = this;
    const revision = surface.comparison?.revision ?? -1;
    if (revision === this.deviationShown && this.levelsDeviating === viewer.levelsShown) return;
    const values: (Float32Array | null)[] = [];
    if (surface.comparison) {
      for (let level = 0; level < viewer.levelsShown; level++)
        values.push(
          (unpack(await this.session.bytes(`/api/deviations/${level}`)).get('deviation_mm') as
            Float32Array | undefined) ?? null,
        );
    }
    viewer.setDeviations(values, surface.comparison?.tolerance_mm ?? null);
    this.deviationShown = revision;
    this.levelsDeviating = viewer.levelsShown;
    this.changed();
  }
}
