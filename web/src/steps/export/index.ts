import type { Step } from '../../step';
import { exportStep } from './panel';
import { words } from './words';

/** Files of other steps: boards, reports and plans. */
const NO_EXPORTS = /^(calibration\.html|board-.*|inspection\.toml|.* report\.(html|csv|qif))$/;

export const step: Step = {
  name: 'export',
  title: () => words('step.export'),
  onSurface: true,
  acts: false,
  reachable: (project) => Boolean(project?.surface),
  finished: (project) => (project?.exports ?? []).some(({ name }) => !NO_EXPORTS.test(name)),
  commandLine: ({ edit }) => edit,
  panel: exportStep,
};
