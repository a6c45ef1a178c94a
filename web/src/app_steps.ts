/** The steps, from left to right. */
export const STEPS = ['project', 'rig', 'live', 'scan', 'surface', 'edit', 'export'] as const;
export type StepName = (typeof STEPS)[number];
