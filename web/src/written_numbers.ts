import { decimalMark, number, t } from './messages';

/** What a field takes. */
export interface Limits {
  min?: number;
  max?: number;
  whole?: boolean;
  /** By how much the arrow keys change it; 1 without. */
  step?: number;
}

const PLAIN = /^[-+]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][-+]?\d+)?$/;
/** Groups of three digits, "1 234 567", "1.234,5"; the first mark between them. */
const GROUPED = /^[-+]?\d{1,3}(?:([.,'’ \u00a0\u202f])\d{3})(?:\1\d{3})*(?:[.,]\d+)?$/;
const ONE_GROUP = /^[-+]?\d{1,3}[.,]\d{3}$/;

/**
 * A number as people write it, whatever the language of the page: "12,5" and "12.5" are the same. In a whole number a mark
 * separates thousands, as it does beside another mark. NaN for what is no number.
 */
export function readNumber(text: string, whole = false): number {
  const bare = text.trim().replace(/^[\u2212\u2013]/, '-');
  if (whole && ONE_GROUP.test(bare)) return Number(bare.replace(/[.,]/, ''));
  if (PLAIN.test(bare)) return Number(bare.replace(',', '.'));
  const mark = GROUPED.exec(bare)?.[1];
  if (mark === undefined) return NaN;
  const [front, ...digits] = bare.split(mark).join('').split(/[.,]/);
  return digits.length > 1 ? NaN : Number([front, ...digits].join('.'));
}

/**
 * Several numbers, between which a blank, a semicolon or a comma stands. A comma between two digits is a decimal comma where the
 * page writes it, unless a part has several of them.
 */
export const readNumbers = (text: string): number[] =>
  text
    .split(/[;\s]+|,(?=\s)/)
    .flatMap((part) => {
      const commas = part.split(',').length - 1;
      return commas > 1 || (commas === 1 && decimalMark() === '.') ? part.split(',') : [part];
    })
    .filter(Boolean)
    .map((part) => readNumber(part));

/** A number as a field shows it, in the language of the page and without marks between thousands; empty for none. */
export const shownNumber = (value: number | null | undefined, digits?: number): string =>
  value == null || Number.isNaN(value)
    ? ''
    : (digits === undefined ? String(value) : value.toFixed(digits)).replace('.', decimalMark());

/** What is wrong with the text of a field, as one sentence; empty where it can be used. */
export function wrongWith(text: string, { min, max, whole = false }: Limits): string {
  if (text.trim() === '') return ''; // `required` says so
  const value = readNumber(text, whole);
  if (!Number.isFinite(value)) return t(whole ? 'number.noWhole' : 'number.none', { example: number(12.5, 1) });
  if (whole && !Number.isInteger(value)) return t('number.noWhole');
  const below = min !== undefined && value < min;
  const above = max !== undefined && value > max;
  if (!below && !above) return '';
  const [low, high] = [shownNumber(min), shownNumber(max)];
  if (min !== undefined && max !== undefined) return t('number.between', { low, high });
  return below ? t('number.least', { low }) : t('number.most', { high });
}

/** The number in a field; null where it is empty. */
export const numberOf = (input: HTMLInputElement, whole = false): number | null =>
  input.value.trim() === '' ? null : readNumber(input.value, whole);

/** The number in a field of a form that was checked; null where it is empty or not there. */
export function numberIn(form: FormData, name: string, whole = false): number | null {
  const text = String(form.get(name) ?? '').trim();
  return text === '' ? null : readNumber(text, whole);
}
