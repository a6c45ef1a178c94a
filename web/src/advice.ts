import type { StepName } from './app_steps';

/** Words of the server's refusals and failures, and the step where what they name is put right. */
const PLACES: readonly (readonly [RegExp, StepName])[] = [
  [
    /axis of the turntable|calibrate the rig|not calibrated|no rig|choose (them|a camera|what shows)|turntable|camera|display/i,
    'rig',
  ],
  [/expos|saturat|too dark|light/i, 'live'],
  [/scan (it )?first|finish its scan|reconstruct it first/i, 'scan'],
];

/** The step that a failure sends to; undefined where it names none, or the present one. */
export const adviceStep = (sentence: string, present: StepName): StepName | undefined => {
  const step = PLACES.find(([words]) => words.test(sentence))?.[1];
  return step === present ? undefined : step;
};
