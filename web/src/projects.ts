import type { App } from './app';
import type { Source } from './steps/project';

/** Creating and opening projects, as the step Project asks for it. */
export class Projects {
  source: Source = 'simulated';
  example = 'lab-piezo';
  /** Names of the chosen files of a rig. */
  files: string[] = [];
  /** Whether the project that opens next was created here. */
  private created = false;

  constructor(private readonly app: App) {}

  setSource(source: Source): void {
    this.source = source;
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
  async open(name: string): Promise<void> {
    const { app } = this;
    if (app.state.project?.name === name)
      app.go(app.project.surface || app.project.surface_loading ? 'surface' : 'scan');
    else await app.command('open-project', { name });
  }
}
