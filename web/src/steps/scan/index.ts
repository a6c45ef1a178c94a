import { t } from '../../messages';
import type { Step } from '../../step';
import { scanStep } from './panel';

export const step: Step = {
  name: 'scan',
  title: () => t('step.scan'),
  onSurface: false,
  acts: true,
  reachable: (project) => project !== null,
  finished: (project) => Boolean(project?.scan_complete),
  commandLine: ({ scan }) => scan,
  panel: scanStep,
};
