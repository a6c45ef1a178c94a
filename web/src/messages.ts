import { ACCEPT } from './messages/accept';
import { CHECK } from './messages/check';
import { EDIT } from './messages/edit';
import { FAULTS } from './messages/faults';
import { FRAME } from './messages/frame';
import { HOME } from './messages/home';
import { INSPECT } from './messages/inspect';
import { LIVE } from './messages/live';
import { MEASURE } from './messages/measure';
import { RIG } from './messages/rig';
import { SCAN } from './messages/scan';
import type { Rows } from './messages/rows';
import { SETTINGS } from './messages/settings';
import { SURFACE } from './messages/surface';
import { TERMS } from './messages/terms';
import { VERDICT } from './messages/verdict';

/** The message catalogue, put together from its areas. */
const CATALOGUE = {
  ...HOME,
  ...FRAME,
  ...RIG,
  ...SETTINGS,
  ...LIVE,
  ...SCAN,
  ...CHECK,
  ...SURFACE,
  ...MEASURE,
  ...EDIT,
  ...INSPECT,
  ...ACCEPT,
  ...VERDICT,
  ...TERMS,
  ...FAULTS,
} as const;

export type MessageKey = keyof typeof CATALOGUE;
/** The languages in the order of the catalogue's columns, each by its own name. */
export const LANGUAGES = [
  ['en', 'English'],
  ['de', 'Deutsch'],
  ['it', 'Italiano'],
] as const;
export type Language = (typeof LANGUAGES)[number][0];

const LOCALES: Record<Language, string> = { en: 'en-GB', de: 'de-DE', it: 'it-IT' };
const known = (name: string | null): Language | undefined => LANGUAGES.find(([one]) => one === name)?.[0];
let language: Language =
  known(localStorage.getItem('frangia-language')) ?? known(navigator.language.slice(0, 2)) ?? 'en';
let column = LANGUAGES.findIndex(([name]) => name === language) as 0 | 1 | 2;

export const currentLanguage = (): Language => language;

export function setLanguage(next: Language): void {
  language = next;
  column = LANGUAGES.findIndex(([name]) => name === next) as 0 | 1 | 2;
  localStorage.setItem('frangia-language', next);
  document.documentElement.lang = next;
}

type Values = Record<string, string | number>;
const filled = (text: string, values: Values): string =>
  text.replace(/\{(\w+)\}/g, (_, name: string) => String(values[name] ?? ''));

export const t = (key: MessageKey, values: Values = {}): string => filled(CATALOGUE[key][column], values);

/** The texts that one step alone has, from a file `words.ts` in its folder. */
export const wordsOf =
  <R extends Rows>(rows: R) =>
  (key: keyof R & string, values: Values = {}): string =>
    filled((rows[key] as Rows[string])[column], values);

/** Whether the catalogue has a text. */
export const isMessage = (key: string): key is MessageKey => key in CATALOGUE;

/** A text with a number in it, which has a row of its own for one. */
export const count = (
  key: 'surface.edits' | 'surface.replay',
  many: number,
  values: Record<string, string | number> = {},
): string => t(many === 1 ? `${key}One` : key, { ...values, count: number(many) });

/** A time as the language writes it, to the minute. */
export const moment = (seconds: number): string =>
  new Date(1000 * seconds).toLocaleString(LOCALES[language], {
    dateStyle: 'medium',
    timeStyle: 'short',
  });

/** The name of a stage of a job; one that the catalogue lacks stays as the server names it. */
export const stageName = (stage: string): string =>
  `stage.${stage}` in CATALOGUE ? t(`stage.${stage}` as MessageKey) : stage;

/** The mark between a number and its decimals. */
export const decimalMark = (): string => (1.5).toLocaleString(LOCALES[language]).charAt(1);

/** A number as the language writes it; one that rounds to zero has no sign. */
export const number = (value: number, digits = 0): string =>
  (Math.abs(value) < 0.5 * 10 ** -digits ? 0 : value).toLocaleString(LOCALES[language], {
    useGrouping: true,
    minimumFractionDigits: digits,
    maximumFractionDigits: digits,
  });
