import type { VerdictClause } from './types';
import { decimalMark, isMessage, number, t } from './messages';
import { capitalized } from './ui';

type Value = VerdictClause['values'][string];

/** A share that is neither nothing nor all does not read as if it were. */
function percent(share: number): string {
  if (share <= 0 || share >= 1 - 1e-12) return `${number(100 * share)} %`;
  return `${number(Math.min(99.9, Math.max(0.1, 100 * share)), 1)} %`;
}

const SIGNED = new Set(['deviation_mm']);
const SHARES = new Set(['share', 'poor_share', 'wanted_share', 'of_half_width']);

function valueText(name: string, value: Value): string {
  if (value === null) return '·';
  // A comma between numbers with a comma would read as one more digit.
  if (Array.isArray(value)) return `(${value.map((one) => number(one, 2)).join(decimalMark() === ',' ? '; ' : ', ')})`;
  if (typeof value === 'string') return name === 'unit' && value === 'degrees' ? '°' : value;
  if (SHARES.has(name)) return percent(value);
  if (SIGNED.has(name)) return `${value < 0 ? '−' : '+'}${number(Math.abs(value), 4)}`;
  if (name === 'u95' || name === 'u95_mm' || name === 'value') return number(value, 4);
  return number(value, Number.isInteger(value) ? 0 : Math.abs(value) < 1 ? 3 : 1);
}

/** A clause in the reader's language; one that the catalogue lacks as the server words it. */
function clauseText({ id, values, text }: VerdictClause): string {
  const key = `clause.${id}`;
  if (!isMessage(key)) return text;
  const words = Object.fromEntries(Object.entries(values).map(([name, value]) => [name, valueText(name, value)]));
  return t(key, words).replace(/, U95 · \S+?(?=[.;,)]|$)/g, ''); // it is not known
}

/** The sentence about a verdict. */
export const verdictSentence = (clauses: readonly VerdictClause[]): string =>
  `${capitalized(clauses.map(clauseText).join('; '))}.`;
