import { t } from '../../messages';
import { residualStage } from '../../residuals';
import { onButton, type Step } from '../../step';
import { rigStep } from './panel';

export const step: Step = {
  name: 'rig',
  title: () => t('step.rig'),
  onSurface: false,
  acts: true,
  reachable: (project) => project !== null,
  finished: (project) => Boolean(project?.rig),
  commandLine: ({ rig }) => rig,
  panel: rigStep,
  overlay: residualStage,
  keys: (app, key, event) => {
    if (key !== 'enter' || !app.state.project?.calibration?.waiting || onButton(event)) return false;
    void app.command('capture-pose');
    return true;
  },
  shortcuts: [['rig.poseKey', 'Enter']],
  entered: ({ viewer, session }) => {
    viewer.setRig(session.state?.project?.rig ?? null);
    viewer.frame([0.55, -0.9, 0.5]);
  },
  left: ({ viewer }) => {
    viewer.setRig(null);
    viewer.frame([0.9, -1.1, 0.6]);
  },
};
