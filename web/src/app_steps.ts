/** The steps, from left to right. */
export const STEPS = ['project', 'rig', 'live', 'scan', 'surface', 'edit', 'inspect', 'export'] as const;
/** Those whose picture is the surface. */
export const ON_SURFACE: ReadonlySet<string> = new Set<(typeof STEPS)[number]>([
  'surface',
  'edit',
  'inspect',
  'export',
]);
export type StepName = (typeof STEPS)[number];
