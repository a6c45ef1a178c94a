import { number, t } from './messages';
import type { Store } from './store';
import type { Project, RigFigures } from './types';

/** Whether a scan of several stations can be built: the axis about which they turn is known. */
export const axisIsKnown = (app: Store): boolean => !app.project.rig || app.project.rig.turntable !== null;

/** Whether the rig turns its part. */
export const hasTable = (app: Store): boolean => app.project.devices.some(({ table }) => table === 'turntable');

/** Whether the devices answer: all did when they were tested, or when something was measured with them; '' where neither is known. */
export function devicesAnswer({ devices, display, calibration, axis, scan_begun }: Project): 'now' | 'before' | '' {
  if (devices.length > 0 && devices.every(({ answer }) => answer)) return 'now';
  return display || calibration || axis || scan_begun ? 'before' : '';
}

/** How good a rig is, in a few words: calibrated or not, and whether its axis is known. */
export function rigWords(rig: RigFigures): string {
  const calibrated =
    rig.date === ''
      ? t('rigs.uncalibrated')
      : t('rigs.calibrated', {
          date: rig.date,
          sigma: rig.point_sigma_mm === null ? '·' : number(rig.point_sigma_mm, 3),
        });
  return rig.has_turntable ? `${calibrated}, ${t(rig.has_axis ? 'rigs.axis' : 'rigs.noAxis')}` : calibrated;
}
