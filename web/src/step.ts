import type { TemplateResult } from 'lit';

import type { MessageKey } from './messages';
import type { App } from './parts';
import type { StepName } from './step_names';
import type { Project } from './types';

/** A step of the app, which is a folder of `steps` with a name in `STEP_NAMES`. */
export interface Step {
  readonly name: StepName;
  readonly title: () => string;
  /** Whether its picture is the surface. */
  readonly onSurface: boolean;
  /** Whether its panel does nothing but act; it is disabled in a browser that watches. */
  readonly acts: boolean;
  /** Whether it can be opened. */
  readonly reachable: (project: Project | null) => boolean;
  /** Whether it has its result. */
  readonly finished: (project: Project | null) => boolean;
  /** The command line that does the same, of those that the state names. */
  readonly commandLine: (commands: Project['commands']) => readonly string[] | undefined;
  readonly panel: (app: App) => TemplateResult;
  /** What stands on the picture. */
  readonly overlay?: (app: App) => TemplateResult | string;
  /** Acts on a key, in lower case; whether it did. */
  readonly keys?: (app: App, key: string, event: KeyboardEvent) => boolean;
  /** The keys as the sheet of shortcuts lists them. */
  readonly shortcuts?: readonly (readonly [MessageKey, string])[];
  readonly entered?: (app: App) => void;
  readonly left?: (app: App, next: StepName) => void;
}

/** Whether a key was pressed on what Enter would press itself. */
export const onButton = (event: KeyboardEvent): boolean => (event.target as HTMLElement).matches('button, summary');
