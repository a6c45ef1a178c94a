/** The steps, from left to right; each is a folder of `steps`. */
export const STEP_NAMES = ['project', 'rig', 'live', 'scan', 'surface', 'edit', 'inspect', 'export'] as const;
export type StepName = (typeof STEP_NAMES)[number];
