import { t } from '../../messages';
import type { Step } from '../../step';
import { liveOverlay, liveStep } from './panel';

export const step: Step = {
  name: 'live',
  title: () => t('step.live'),
  onSurface: false,
  acts: true,
  reachable: (project) => project !== null,
  finished: (project) => Boolean(project?.scan_begun),
  commandLine: ({ scan }) => scan,
  panel: liveStep,
  overlay: liveOverlay,
  entered: (app) => app.live.entered(),
  left: (app, next) => app.live.left(next),
};
