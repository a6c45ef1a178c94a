import type { StepName } from './app_steps';
import { FAULTS_ACCEPTANCE } from './messages/faults_acceptance';
import { FAULTS_BUILD } from './messages/faults_build';
import { FAULTS_CALIBRATION } from './messages/faults_calibration';
import { FAULTS_CAPTURE } from './messages/faults_capture';
import { currentLanguage, t } from './messages';

const FAULTS = { ...FAULTS_CAPTURE, ...FAULTS_CALIBRATION, ...FAULTS_BUILD, ...FAULTS_ACCEPTANCE };
export type FaultId = keyof typeof FAULTS;

/** A sentence of the server as its row and the values in it. */
export interface Fault {
  id: FaultId;
  values: string[];
}

/** The row's first column as an expression whose groups are its values, in the order of their numbers. */
function expressionOf(template: string): RegExp {
  const escaped = template.replace(/[.*+?^$()|[\]\\]/g, '\\$&');
  return new RegExp(`^${escaped.replace(/\{\d+\}/g, '(.*?)')}$`, 's');
}
const EXPRESSIONS = (Object.keys(FAULTS) as FaultId[]).map((id) => ({ id, expression: expressionOf(FAULTS[id][0]) }));
// What begins or ends with a value would also match longer sentences: the longest row is tried first.
EXPRESSIONS.sort((a, b) => FAULTS[b.id][0].length - FAULTS[a.id][0].length);

/** The row of a sentence; undefined where the catalogue has none. */
export function faultOf(sentence: string): Fault | undefined {
  for (const { id, expression } of EXPRESSIONS) {
    const found = expression.exec(sentence);
    if (found) return { id, values: found.slice(1) };
  }
  return undefined;
}

/** What precedes a sentence: the device, the file, the key. */
const PREFIX = /^([^:;]{1,80}): (.+)$/s;

/** A sentence of the server in the language of the reader; as it is where the catalogue has no row for it. */
export function worded(sentence: string): string {
  if (currentLanguage() === 'en') return sentence;
  const fault = faultOf(sentence);
  if (fault) return t(fault.id, Object.fromEntries(fault.values.map((value, i) => [i, worded(value)])));
  const [, prefix, rest] = PREFIX.exec(sentence) ?? [];
  return prefix && rest ? `${prefix}: ${worded(rest)}` : sentence;
}

/** Where the user can do what a fault asks for; of a page that shows another step already, nothing. */
const STEPS: Partial<Record<FaultId, StepName>> = {
  'fault.nothingMeasured': 'live',
  'fault.overexposed': 'live',
  'fault.lowContrast': 'live',
  'fault.saturatedPixels': 'live',
  'fault.darkFrames': 'live',
  'fault.noFringesSeen': 'live',
  'fault.noMeasuredPixel': 'live',
  'fault.exposureUneven': 'live',
  'fault.exposureRange': 'live',
  'fault.needsCamera': 'rig',
  'fault.needsTable': 'rig',
  'fault.wantsDisplay': 'rig',
  'fault.noDevices': 'rig',
  'fault.noAxis': 'rig',
  'fault.axisUnknown': 'rig',
  'fault.calibrateTable': 'rig',
  'fault.notTheRig': 'rig',
  'fault.viewsContradict': 'rig',
  'fault.latencyChanges': 'rig',
  'fault.shiftsNotFollowed': 'rig',
  'fault.viewFitsNoOther': 'scan',
  'fault.quarterMissing': 'scan',
  'fault.sideMissing': 'scan',
  'fault.copiedView': 'scan',
  'fault.setupIncomplete': 'scan',
  'fault.openMesh': 'edit',
  'fault.nothingToExport': 'edit',
  'fault.changedSince': 'inspect',
  'fault.inspectAgain': 'inspect',
};

/** The step that a sentence of the server sends to; also of a sentence within it. */
export function stepOf(sentence: string): StepName | undefined {
  const fault = faultOf(sentence);
  if (fault) return STEPS[fault.id] ?? fault.values.map(stepOf).find((step) => step !== undefined);
  const rest = PREFIX.exec(sentence)?.[2];
  return rest ? stepOf(rest) : undefined;
}
