import { type MessageKey, number, t } from './messages';
import type { Step } from './types';

/** A number with its unit as the language writes it, with the digits that it was given with. */
function quantity(value: string): string {
  const [, digits, unit] = /^(-?[\d.]+)(mm|um|deg)?$/.exec(value) ?? [];
  if (digits === undefined) return value;
  return `${number(Number(digits), digits.split('.')[1]?.length ?? 0)}${unit ? ` ${unit === 'um' ? 'µm' : unit === 'deg' ? '°' : unit}` : ''}`;
}

/** What a step did, in a sentence. */
export function stepWords({ operation, value, change }: Step): string {
  const count = (key: MessageKey, more: Record<string, string | number> = {}) =>
    t(key, {
      triangles: number(Math.abs(change.triangles)),
      holes: number(Math.abs(change.holes)),
      parts: number(Math.abs(change.components)),
      selected: number(change.selected),
      moved: number(change.moved),
      value: quantity(value),
      ...more,
    });
  if (operation.startsWith('fill-hole')) {
    const flat = operation.endsWith('-flat');
    if (change.holes === 0 && change.triangles === 0) return count('did.filledNone');
    if (change.holes === -1) return count(flat ? 'did.filledOneFlat' : 'did.filledOne');
    return count(flat ? 'did.filledFlat' : 'did.filled');
  }
  if (operation === 'bridge') return count('did.bridge');
  if (operation === 'delete') return count('did.delete');
  if (operation === 'smooth') return count('did.smooth');
  if (operation === 'remove-spikes') return count(change.triangles || change.moved ? 'did.spikes' : 'did.spikesNone');
  if (operation === 'keep-largest' || operation === 'remove-islands')
    return count(change.components === 0 ? 'did.islandsNone' : change.components === -1 ? 'did.island' : 'did.islands');
  if (operation.startsWith('decimate')) return count(operation === 'decimate' ? 'did.decimate' : 'did.decimateTo');
  if (operation === 'cut') return count('did.cut');
  if (operation === 'mirror') return count('did.mirror');
  if (operation === 'offset') return count('did.offset');
  if (operation === 'align') return count('did.align');
  if (operation === 'invert') return count('did.invert');
  if (operation === 'grow' || operation === 'shrink') return count(`did.${operation}`);
  if (operation === 'add' || operation === 'within' || operation === 'without') return count(`did.${operation}`);
  if (operation === 'select-sigma') return count('did.selectSigma');
  if (operation === 'select-normal') return count('did.selectNormal');
  if (operation === 'select-curvature') return count('did.selectCurvature');
  if (operation === 'select-plane') return count('did.selectPlane');
  if (operation === 'select-component') return count('did.selectPart');
  if (operation === 'select-loop') return count('did.selectLoop');
  if (operation === 'select-mark') return count('did.selectMark');
  if (operation.startsWith('select-')) return count('did.selectOutline');
  return operation;
}
