import { t } from '../../messages';
import type { Step } from '../../step';
import { projectStep } from './panel';

export const step: Step = {
  name: 'project',
  title: () => t('step.project'),
  onSurface: false,
  acts: false,
  reachable: () => true,
  finished: (project) => project !== null,
  commandLine: () => undefined,
  panel: projectStep,
};
