import { t } from '../../messages';
import type { Step } from '../../step';
import { surfaceStep } from './panel';

export const step: Step = {
  name: 'surface',
  title: () => t('step.surface'),
  onSurface: true,
  acts: false,
  reachable: (project) =>
    Boolean(project && (project.surface || project.surface_loading || project.versions.length > 0)),
  finished: (project) => Boolean(project?.surface),
  commandLine: ({ reconstruct }) => reconstruct,
  panel: surfaceStep,
};
