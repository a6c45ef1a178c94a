import { LitElement } from 'lit';

import { Asking } from './ask';
import type { Coloring } from './mesh_colors';
import { MeshSource } from './mesh_source';
import { type Lan, CONFLICT, Refusal, Session } from './session';
import type { StepName } from './step_names';
import type { Job, Project, State } from './types';
import type { SectionLook, Shading, Tool, Viewer } from './viewer';

interface Look extends SectionLook {
  shading: Shading;
  coloring: Coloring;
}

/** What the dialog of links shows; `lan` is null where tablets cannot be let in. */
export interface Sharing {
  link: string;
  lan: Lan | null;
  /** Whether the next tablets are to be let in with encryption. */
  encrypted: boolean;
}

/**
 * What all parts of the window share, and know nothing of each other by: the session and its state, the step, the look of the
 * picture, and commands to the server. Parts and panels are built on it; it uses none of them.
 */
export abstract class Store extends LitElement {
  step: StepName = 'project';
  look: Look = { shading: 'smooth', coloring: 'plain', axis: 'off', normal: null, at: null, flipped: false };
  readonly session = new Session(
    () => this.onState(),
    (picture) => this.onPicture(picture),
  );
  readonly asking = new Asking(this);
  readonly host = document.createElement('div');
  viewer!: Viewer;
  meshes!: MeshSource;
  problem = '';
  /** Whether `problem` is that another browser operates. */
  refused = false;
  copied = false;
  sharing: Sharing = { link: '', lan: null, encrypted: false };

  /** A state has come, or the connection has changed. */
  protected abstract onState(): void;
  /** A picture of the live preview has come. */
  protected abstract onPicture(picture: ArrayBuffer): void;
  abstract go(step: StepName): void;
  /** The name of a step in the reader's language. */
  abstract titleOf(step: StepName): string;
  /** Whether a step can be opened now. */
  abstract canOpen(step: StepName): boolean;

  get state(): State {
    return this.session.state as State;
  }
  get project(): Project {
    return this.state.project as Project;
  }
  /** The job of a kind that waits or runs. */
  job(kind: Job['kind']): Job | undefined {
    return this.state.jobs.find((job) => job.kind === kind && (job.state === 'running' || job.state === 'waiting'));
  }
  get busy(): boolean {
    return this.state.jobs.some((job) => job.state === 'running' || job.state === 'waiting');
  }
  /** Whether a job runs other than the live preview, which gives way. */
  get occupied(): boolean {
    return this.state.jobs.some((job) => job.kind !== 'live' && (job.state === 'running' || job.state === 'waiting'));
  }

  async command(name: string, argument: object = {}): Promise<boolean> {
    // A job may fail before the answer that it was started arrives: what it says stays.
    const before = this.problem;
    try {
      await this.session.command(name, argument);
      if (this.problem === before) this.problem = '';
      return true;
    } catch (error) {
      this.say(error);
      return false;
    }
  }
  setTool(tool: Tool): void {
    this.viewer.setTool(tool);
    this.requestUpdate();
  }
  setLook(change: Partial<Look>): void {
    this.look = { ...this.look, ...change };
    const { look, viewer } = this;
    if (change.shading) viewer.setShading(look.shading);
    if (change.coloring) viewer.setColoring(look.coloring);
    if (look.coloring === 'setup') void this.meshes.showSetups();
    viewer.setSection(look);
    this.requestUpdate();
  }
  say(error: unknown): void {
    this.problem = error instanceof Error ? error.message : String(error);
    this.refused = error instanceof Refusal && error.status === CONFLICT;
    this.requestUpdate();
  }
  dismiss(): void {
    this.problem = '';
    this.requestUpdate();
  }
  dialog(id: string): HTMLDialogElement {
    return this.querySelector(`#${id}`) as HTMLDialogElement;
  }
}
