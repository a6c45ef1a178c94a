import { t } from '../../messages';
import type { Step } from '../../step';
import { inspectStep } from './panel';

export const step: Step = {
  name: 'inspect',
  title: () => t('step.inspect'),
  onSurface: true,
  acts: false,
  reachable: (project) => Boolean(project?.surface),
  finished: (project) => Boolean(project?.surface?.inspection),
  commandLine: ({ inspect }) => inspect,
  panel: inspectStep,
};
