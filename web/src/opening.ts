import { type Dropped, filesOf, sortOut } from './dropped';
import { accepted, formatOf, REFERENCE_FORMATS, SURFACE_FORMATS } from './file_formats';
import type { Inspecting } from './inspecting';
import { t } from './messages';
import { freeName, type Projects } from './projects';
import { CONFLICT, Refusal, requireSendable } from './session';
import type { Store } from './store';
import { type PlacedFile, zipOf } from './zip_files';

const OPENABLE = accepted([...SURFACE_FORMATS, 'zip', 'toml', 'csv']);

const stem = (name: string): string => name.replace(/\.[^.]*$/, '').slice(0, 50) || 'File';

/** The step that shows what arrived. */
type Arrived = 'surface' | 'scan' | 'inspect';

/** Opens what is dropped on the page or chosen where it belongs: surfaces, scans and rigs. */
export class Opening {
  /** Whether something is held over the page that could be dropped. */
  over = false;
  /** Share of a file that has been sent; null while none is. */
  sent: number | null = null;
  /** The job that reads a file into a project of its own. */
  private pending: { job: number; name: string; step: Arrived; then: () => Promise<void> } | null = null;

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
  /** Taken in any case: where nothing can be opened, the browser would leave the page for the file. */
  private onOver(event: DragEvent): void {
    const { dataTransfer } = event;
    if (!dataTransfer?.types.includes('Files')) return;
    event.preventDefault();
    if (this.app.session.link === 'open') this.setOver(true);
    else dataTransfer.dropEffect = 'none';
  }
  private async onDrop(event: DragEvent): Promise<void> {
    if (!event.dataTransfer?.types.includes('Files')) return;
    event.preventDefault();
    this.setOver(false);
    if (this.app.session.link !== 'open') return;
    // What is opened, or why it is not, would stand behind a dialog.
    for (const dialog of document.querySelectorAll<HTMLDialogElement>('dialog[open]')) dialog.close();
    try {
      await this.open(await filesOf(event.dataTransfer));
    } catch (error) {
      this.app.say(error);
    }
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
    if (app.session.watches) return app.say(new Refusal(CONFLICT, t('app.watching')));
    if (app.occupied) return app.say(t('open.busy'));
    try {
      await this.take(await sortOut(files));
    } catch (error) {
      app.say(error);
    }
    this.sent = null;
    app.requestUpdate();
  }
  private async take(dropped: Dropped): Promise<void> {
    const { kind } = dropped;
    if (kind === 'scan') {
      const { name, files } = dropped;
      requireSendable(files.reduce((sum, { file }) => sum + file.size, 0));
      await this.own(await zipOf(files), name || 'scan.toml', 'zip', name || 'Scan', 'scan');
    } else if (kind === 'zip') await this.own(dropped.file, dropped.file.name, 'zip', stem(dropped.file.name), 'scan');
    else if (kind === 'rig') await this.rig(dropped.file, dropped.covariance);
    else if (kind === 'plan') await this.plan(dropped.file);
    else if (!dropped.reference && !dropped.plan) await this.surface(dropped.file);
    else await this.part(dropped.file, dropped.reference, dropped.plan);
  }

  /** A part with what it is compared with, and the plan of its inspection. */
  private async part(file: File, reference?: File, plan?: File): Promise<void> {
    const { inspecting } = this;
    const format = formatOf(file.name, SURFACE_FORMATS) as string;
    await this.own(file, file.name, format, stem(file.name), 'inspect', async () => {
      if (plan) await inspecting.open(plan);
      if (reference) await inspecting.send(reference);
    });
  }
  /** A plan belongs to the part that is open. */
  private async plan(file: File): Promise<void> {
    const { app } = this;
    if (!app.canOpen('inspect')) throw new Error(t('open.planAlone', { name: file.name }));
    app.go('inspect');
    await this.inspecting.open(file);
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
  private async own(
    file: Blob,
    fileName: string,
    format: string,
    wanted: string,
    step: Arrived,
    then?: () => Promise<void>,
  ): Promise<void> {
    const { app } = this;
    requireSendable(file.size);
    const name = this.freeName(wanted);
    await app.session.command('create-project', { name, stations: 8, devices: true });
    try {
      await this.arrive(file, fileName, format, name, step, then);
    } catch (error) {
      await app.session.command('discard-project', { name }).catch(() => undefined); // the first error says more
      throw error;
    }
  }
  /** Sends a file to a project without a surface and a scan. */
  private async arrive(
    file: Blob,
    fileName: string,
    format: string,
    name: string,
    step: Arrived,
    then?: () => Promise<void>,
  ): Promise<void> {
    const { app } = this;
    this.sent = 0;
    await app.session.send(file, (share) => {
      this.sent = share;
      app.requestUpdate();
    });
    const arguments_ = { format, bytes: file.size, name: fileName.slice(0, 120) };
    const { job } = await app.session.command<{ job: number }>('open-file', arguments_);
    this.sent = null;
    this.pending = { job, name, step, then: then ?? (async () => undefined) };
    this.follow();
  }
  /** Makes a file the surface of the open project, which has none, and inspects it. */
  async into(file: File, format: string): Promise<void> {
    requireSendable(file.size);
    await this.arrive(file, file.name, format, this.app.project.name, 'inspect', () => this.inspecting.run());
  }

  /** Goes to what was opened when it is there; what could not be read leaves no project behind. */
  follow(): void {
    const { app, pending } = this;
    const job = app.state.jobs.find((one) => one.number === pending?.job);
    if (!pending || !job || job.state === 'waiting' || job.state === 'running') return;
    this.pending = null;
    if (job.state === 'done') {
      app.go(pending.step);
      void pending.then().catch((error) => app.say(error));
    } else void app.session.command('discard-project', { name: pending.name }).catch((error) => app.say(error));
  }
}
