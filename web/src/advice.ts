import type { StepName } from './app_steps';
import { stepOf } from './faults';

/** Words in sentences that the catalogue of faults does not have, and the step of the app where the user can correct what they name. */
const PLACES: readonly (readonly [RegExp, StepName])[] = [
  [/\b(expos|saturat|too dark|stray light|room light)/i, 'live'],
  [/calibrate the rig|not calibrated|no rig|choose what shows|turntable|camera|display/i, 'rig'],
  [/scan (it )?first|finish its scan|reconstruct it first/i, 'scan'],
];

/** The step that a failure sends to; undefined where it names none, or the present one. */
export const adviceStep = (sentence: string, present: StepName): StepName | undefined => {
  const step = stepOf(sentence) ?? PLACES.find(([words]) => words.test(sentence))?.[1];
  return step === present ? undefined : step;
};
