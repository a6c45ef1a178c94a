import type { Step } from './step';
import { type StepName, STEP_NAMES } from './step_names';

const FOLDERS = import.meta.glob<{ step: Step }>('./steps/*/index.ts', { eager: true });

/** The step of a name; throws where its folder is missing. */
export function stepNamed(name: StepName): Step {
  const folder = FOLDERS[`./steps/${name}/index.ts`];
  if (!folder) throw new Error(`steps/${name}/index.ts is missing`);
  return folder.step;
}

/** The steps, from left to right. */
export const STEPS: readonly Step[] = STEP_NAMES.map(stepNamed);
