import type { Store } from './store';
import { accepted, formatOf, REFERENCE_FORMATS, SURFACE_FORMATS } from './file_formats';
import type { Inspecting } from './inspecting';
import { number, t } from './messages';
import { freeName, type Projects } from './projects';
import { requireSendable } from './session';
import { MOST_FILES, type PlacedFile, zipOf } from './zip_files';

const OPENABLE = accepted([...SURFACE_FORMATS, 'zip', 'toml', 'csv']);

const stem = (name: string): string => name.replace(/\.[^.]*$/, '').slice(0, 50) || 'File';

/** The files below an entry that was dropped. */
async function below(entry: FileSystemEntry, folder: string): Promise<PlacedFile[]> {
  const path = `${folder}${entry.name}`;
  if (entry.isFile)
    return [{ path, file: await new Promise<File>((done, fail) => (entry as FileSystemFileEntry).file(done, fail)) }];
  const reader = (entry as FileSystemDirectoryEntry).createReader();
  const found: PlacedFile[] = [];
  for (;;) {
    const some = await new Promise<FileSystemEntry[]>((done, fail) => reader.readEntries(done, fail));
    if (some.length === 0) return found;
    for (const one of some) if (!one.name.startsWith('.')) found.push(...(await below(one, `${path}/`)));
  }
}

/** The step that shows what arrived. */
type Arrived = 'surface' | 'scan' | 'inspect';

/** Opens what is dropped on the page or chosen where it belongs: surfaces, scans and rigs. */
export class Opening {
  /** Whether something is held over the page that could be dropped. */
  over = false;
  /** Share of a file that has been sent; null while none is. */
  sent: number | null = null;
  /** The job that reads a file into a project of its own. */
  private pending: { job: number; name: string; step: Arrived } | null = null;

  constructor(
    private readonly app: Store,
    private readonly projects: Projects,
    private readonly inspecting: Inspecting,
  ) {
    addEventListener('dragover', (event) => this.onOver(event));
    addEventListener('dragleave', (event) => {
      if (!event.relatedTarget) this.setOver(false);
    });
    addEventListener('drop', (event) => void this.onDrop(event));
  }

  private setOver(over: boolean): void {
    if (over === this.over) return;
    this.over = over;
    this.app.requestUpdate();
  }
  private onOver(event: DragEvent): void {
    if (!event.dataTransfer?.types.includes('Files') || !this.app.session.state) return;
    event.preventDefault();
    this.setOver(true);
  }
  private async onDrop(event: DragEvent): Promise<void> {
    if (!event.dataTransfer?.types.includes('Files')) return;
    event.preventDefault();
    this.setOver(false);
    const entries = [...event.dataTransfer.items].map((item) => item.webkitGetAsEntry()).filter((one) => one !== null);
    await this.open((await Promise.all(entries.map((entry) => below(entry, '')))).flat());
  }
  /** Lets a person choose files, or a folder. */
  choose(folder: boolean): void {
    const input = document.createElement('input');
    input.type = 'file';
    input.multiple = true;
    input.webkitdirectory = folder;
    if (!folder) input.accept = OPENABLE;
    input.addEventListener('change', () => {
      const files = [...(input.files ?? [])].map((file) => ({ path: file.webkitRelativePath || file.name, file }));
      void this.open(files.filter(({ path }) => !/(^|\/)\./.test(path)));
    });
    input.click();
  }

  async open(files: readonly PlacedFile[]): Promise<void> {
    const { app } = this;
    if (files.length === 0) return;
    if (app.session.watches) return app.say(t('app.watching'));
    if (app.occupied) return app.say(t('open.busy'));
    const named = (pattern: RegExp) => files.find(({ path }) => pattern.test(path));
    try {
      const scan = named(/(^|\/)scan\.toml$/i);
      const zip = named(/\.zip$/i);
      const surface = files.find(({ path }) => formatOf(path, SURFACE_FORMATS));
      const rig = named(/\.toml$/i);
      if (scan) {
        const folder = scan.path.split('/').at(-2);
        if (files.length > MOST_FILES) throw new Error(t('open.many', { files: number(files.length) }));
        requireSendable(files.reduce((sum, { file }) => sum + file.size, 0));
        await this.own(await zipOf(files), folder ?? 'scan.toml', 'zip', folder ?? 'Scan', 'scan');
      } else if (zip) await this.own(zip.file, zip.file.name, 'zip', stem(zip.file.name), 'scan');
      else if (surface) await this.surface(surface.file);
      else if (rig) await this.rig(rig.file, named(/\.csv$/i)?.file);
      else app.say(t('open.unknown', { name: files[0]?.file.name ?? '' }));
    } catch (error) {
      app.say(error);
    }
    this.sent = null;
    app.requestUpdate();
  }

  private async surface(file: File): Promise<void> {
    const { app } = this;
    const format = formatOf(file.name, SURFACE_FORMATS) as string;
    if (app.state.project?.surface && formatOf(file.name, REFERENCE_FORMATS)) {
      const answers = [t('open.compare'), t('open.own')];
      const answer = await app.asking.choose(t('open.which', { name: file.name }), answers);
      if (answer === null) return;
      if (answer === 0) {
        app.go('inspect');
        return this.inspecting.send(file);
      }
    }
    await this.own(file, file.name, format, stem(file.name), 'surface');
  }
  private async rig(file: File, covariance?: File): Promise<void> {
    await this.projects.create({
      name: this.freeName(stem(file.name)),
      stations: 8,
      rig: await file.text(),
      ...(covariance ? { covariance: await covariance.text() } : {}),
    });
  }
  private freeName(wanted: string): string {
    return freeName(
      wanted,
      this.app.state.projects.map((one) => one.name),
    );
  }

  /** Opens a file in a project that is made for it. */
  private async own(file: Blob, fileName: string, format: string, wanted: string, step: Arrived): Promise<void> {
    const { app } = this;
    requireSendable(file.size);
    const name = this.freeName(wanted);
    await app.session.command('create-project', { name, stations: 8, devices: true });
    try {
      await this.arrive(file, fileName, format, name, step);
    } catch (error) {
      await app.session.command('discard-project', { name }).catch(() => undefined); // the first error says more
      throw error;
    }
  }
  /** Sends a file to a project without a surface and a scan. */
  private async arrive(file: Blob, fileName: string, format: string, name: string, step: Arrived): Promise<void> {
    const { app } = this;
    this.sent = 0;
    await app.session.send(file, (share) => {
      this.sent = share;
      app.requestUpdate();
    });
    const arguments_ = { format, bytes: file.size, name: fileName.slice(0, 120) };
    const { job } = await app.session.command<{ job: number }>('open-file', arguments_);
    this.sent = null;
    this.pending = { job, name, step };
    this.follow();
  }
  /** Makes a file the surface of the open project, which has none, and inspects it. */
  async into(file: File, format: string): Promise<void> {
    requireSendable(file.size);
    await this.arrive(file, file.name, format, this.app.project.name, 'inspect');
  }

  /** Goes to what was opened when it is there; what could not be read leaves no project behind. */
  follow(): void {
    const { app, pending } = this;
    const job = app.state.jobs.find((one) => one.number === pending?.job);
    if (!pending || !job || job.state === 'waiting' || job.state === 'running') return;
    this.pending = null;
    if (job.state === 'done') {
      app.go(pending.step);
      if (pending.step === 'inspect') void this.inspecting.run();
    } else void app.session.command('discard-project', { name: pending.name }).catch((error) => app.say(error));
  }
}
