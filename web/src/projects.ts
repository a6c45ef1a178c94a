import type { Store } from './store';
import { t } from './messages';
import type { ProjectEntry } from './types';

/** Where the rig of a new project comes from. */
export const SOURCES = ['kept', 'simulated', 'devices', 'file', 'example'] as const;
export type Source = (typeof SOURCES)[number];

/** A name that no project has yet: "Bust", "Bust 2", ... */
export function freeName(wanted: string, taken: readonly string[]): string {
  const base = wanted.charAt(0).toUpperCase() + wanted.slice(1);
  for (let i = 1; ; i++) {
    const name = i === 1 ? base : `${base} ${i}`;
    if (!taken.includes(name)) return name;
  }
}

const THUMBNAIL = { width: 240, height: 160 };
/** After the surface was last shown anew, until its picture is taken, ms. */
const SETTLED_MS = 2500;

/** Creating, opening and keeping projects, as the step Project asks for it. */
export class Projects {
  /** Where the rig of a new project comes from; null until somebody chooses. */
  private chosen: Source | null = null;
  example = 'lab-piezo';
  /** Names of the chosen files of a rig. */
  files: string[] = [];
  /** What the names or notes of the listed projects hold. */
  wanted = '';
  /** Addresses of the pictures, by name and time. */
  private readonly pictures = new Map<string, string>();
  /** The revision of the surface that the picture of each project shows. */
  private readonly pictured = new Map<string, number>();
  /** What is pictured when the view is at rest: name and revision. */
  private awaited = '';
  private picturing = 0;
  /** Whether the project that opens next was created here. */
  private created = false;

  /** The name that the open project gets here. */
  private renamed = '';

  constructor(private readonly app: Store) {}

  /** A kept rig, where there is one: most projects use the rig that stands there. */
  get source(): Source {
    return this.chosen ?? (this.app.state.rigs.length > 0 ? 'kept' : 'simulated');
  }
  setSource(source: Source): void {
    this.chosen = source;
    this.files = [];
    this.app.requestUpdate();
  }
  setFiles(files: string[]): void {
    this.files = files;
    this.app.requestUpdate();
  }
  setExample(example: string): void {
    this.example = example;
    this.app.requestUpdate();
  }
  async create(project: { name: string; stations: number } & Record<string, string | number | boolean>): Promise<void> {
    this.created = true;
    if (!(await this.app.command('create-project', project))) this.created = false;
  }
  /** Whether the open project is new; asked once. */
  takeCreated(): boolean {
    const { created } = this;
    this.created = false;
    return created;
  }
  /** Whether the open project has only got another name; asked once. */
  takeRenamed(name: string): boolean {
    const { renamed } = this;
    if (name) this.renamed = '';
    return name !== '' && name === renamed;
  }
  async open(name: string): Promise<void> {
    const { app } = this;
    if (app.state.project?.name === name)
      app.go(app.project.surface || app.project.surface_loading ? 'surface' : 'scan');
    else await app.command('open-project', { name });
  }

  search(wanted: string): void {
    this.wanted = wanted;
    this.app.requestUpdate();
  }
  /** The projects that are searched for. */
  get listed(): ProjectEntry[] {
    const wanted = this.wanted.trim().toLowerCase();
    return this.app.state.projects.filter(({ name, notes }) => `${name}\n${notes}`.toLowerCase().includes(wanted));
  }
  private get names(): string[] {
    return this.app.state.projects.map(({ name }) => name);
  }
  async rename(name: string): Promise<void> {
    const to = await this.app.asking.write(t('home.renameAsk', { name }), name, t('home.rename'));
    if (!to || to === name) return;
    if (name === this.app.state.project?.name) this.renamed = to;
    await this.app.command('rename-project', { name, to });
  }
  async duplicate(name: string): Promise<void> {
    const copy = await this.app.asking.write(
      t('home.duplicateAsk', { name }),
      freeName(name, this.names),
      t('home.duplicate'),
    );
    if (copy) await this.app.command('duplicate-project', { name, copy });
  }
  async note({ name, notes }: ProjectEntry): Promise<void> {
    const text = await this.app.asking.write(t('home.notesAsk', { name }), notes, t('home.notesKeep'), {
      lines: 7,
      most: 1000,
    });
    if (text !== null && text !== notes) await this.app.command('set-notes', { name, text });
  }
  async discard(name: string): Promise<void> {
    if (await this.app.asking.confirm(t('home.discardAsk', { name }), t('home.discard'))) {
      await this.app.command('discard-project', { name });
      this.pictured.delete(name); // another one may get the name
    }
  }
  /** Deletes for good what the bin holds now; `size` is that of it, for the question. */
  async emptyBin(size: string): Promise<void> {
    const { discarded: names } = this.app.state;
    const asked =
      names.length === 1
        ? t('home.emptyAskOne', { name: names[0] as string, size })
        : t('home.emptyAsk', { count: names.length, size });
    if (await this.app.asking.confirm(asked, t('home.emptyBin'))) await this.app.command('empty-bin', { names });
  }
  async forgetRig(name: string): Promise<void> {
    if (await this.app.asking.confirm(t('rigs.discardAsk', { name }), t('rigs.discard')))
      await this.app.command('discard-rig', { name });
  }

  /** Address of the picture of a project; empty until it has come. */
  picture({ name, thumbnail_s: at }: ProjectEntry): string {
    if (at === 0) return '';
    const key = `${name} ${at}`;
    const known = this.pictures.get(key);
    if (known !== undefined) return known;
    this.pictures.set(key, '');
    this.app.session.bytes(`/api/thumbnails/${encodeURIComponent(name)}`).then(
      (bytes) => {
        this.pictures.set(key, URL.createObjectURL(new Blob([bytes])));
        this.app.requestUpdate();
      },
      () => undefined, // the card is complete without it
    );
    return '';
  }
  /** Takes a picture for the list of a surface that has none, or that changed since this page showed it. */
  follow(): void {
    const { app, pictured } = this;
    const surface = app.state.project?.surface;
    if (!surface || !app.viewer.supported || !app.viewer.shown || app.session.watches) return;
    const { name } = app.project;
    const { mesh_revision: revision } = surface;
    const entry = app.state.projects.find((one) => one.name === name);
    if (!entry) return;
    if (entry.thumbnail_s > 0 && !pictured.has(name)) pictured.set(name, revision);
    const key = `${name} ${revision}`;
    if (pictured.get(name) === revision || key === this.awaited) return;
    this.awaited = key;
    clearTimeout(this.picturing);
    this.picturing = window.setTimeout(() => void this.takePicture(name, revision), SETTLED_MS);
  }
  private async takePicture(name: string, revision: number): Promise<void> {
    const { app } = this;
    this.awaited = '';
    if (app.state.project?.name !== name || app.state.project.surface?.mesh_revision !== revision) return;
    const shows = app.step === 'surface' || app.step === 'edit' || app.step === 'export';
    if (!shows || !app.viewer.atRest || app.look.coloring !== 'plain' || app.busy) return; // another time
    this.pictured.set(name, revision);
    const bytes = await app.viewer.thumbnail(THUMBNAIL.width, THUMBNAIL.height);
    if (bytes) await app.session.command('set-thumbnail', { picture: bytes }).catch(() => undefined);
  }
}
