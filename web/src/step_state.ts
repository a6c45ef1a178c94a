import type { StepName } from './app_steps';
import type { Project } from './types';

/** Whether a step can be opened. */
export function reachable(project: Project | null, step: StepName): boolean {
  if (step === 'project') return true;
  if (step === 'scan' || step === 'live' || step === 'rig') return project !== null;
  if (step === 'surface' && project && (project.surface_loading || project.versions.length > 0)) return true;
  return Boolean(project?.surface);
}

/** Files of other steps: boards, reports and plans. */
const NO_EXPORTS = /^(calibration\.html|board-.*|inspection\.toml|.* report\.(html|csv|qif))$/;

/** Whether a step has its result. */
export function finished(project: Project | null, step: StepName): boolean {
  if (step === 'project') return project !== null;
  if (step === 'rig') return Boolean(project?.rig);
  if (step === 'live') return Boolean(project?.scan_begun);
  if (step === 'scan') return Boolean(project?.scan_complete);
  if (step === 'surface') return Boolean(project?.surface);
  if (step === 'inspect') return Boolean(project?.surface?.inspection);
  if (step === 'edit') return (project?.surface?.steps_done ?? 0) > 0;
  return (project?.exports ?? []).some(({ name }) => !NO_EXPORTS.test(name));
}
