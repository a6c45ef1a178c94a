import { COMPARE } from './messages/compare';
import { EDIT } from './messages/edit';
import { EXPORT } from './messages/export';
import { FRAME } from './messages/frame';
import { HOME } from './messages/home';
import { LIVE } from './messages/live';
import { RIG } from './messages/rig';
import { SCAN } from './messages/scan';
import { SURFACE } from './messages/surface';

/** The message catalogue, put together from its areas. */
const CATALOGUE = { ...HOME, ...FRAME, ...RIG, ...LIVE, ...SCAN, ...SURFACE, ...COMPARE, ...EDIT, ...EXPORT } as const;

export type MessageKey = keyof typeof CATALOGUE;
export type Language = 'en' | 'de';

const stored = localStorage.getItem('frangia-language');
let language: Language =
  stored === 'de' || stored === 'en' ? stored : navigator.language.startsWith('de') ? 'de' : 'en';

export const currentLanguage = (): Language => language;

export function setLanguage(next: Language): void {
  language = next;
  localStorage.setItem('frangia-language', next);
  document.documentElement.lang = next;
}

export function t(key: MessageKey, values: Record<string, string | number> = {}): string {
  const text: string = CATALOGUE[key][language === 'en' ? 0 : 1];
  return text.replace(/\{(\w+)\}/g, (_, name: string) => String(values[name] ?? ''));
}

/** A text with a number in it, which has a row of its own for one. */
export const count = (
  key: 'surface.edits' | 'surface.replay',
  many: number,
  values: Record<string, string | number> = {},
): string => t(many === 1 ? `${key}One` : key, { ...values, count: number(many) });

/** A time as the language writes it, to the minute. */
export const moment = (seconds: number): string =>
  new Date(1000 * seconds).toLocaleString(language === 'de' ? 'de-DE' : 'en-GB', {
    dateStyle: 'medium',
    timeStyle: 'short',
  });

/** The name of a stage of a job; one that the catalogue lacks stays as the server names it. */
export const stageName = (stage: string): string =>
  `stage.${stage}` in CATALOGUE ? t(`stage.${stage}` as MessageKey) : stage;

/** A number as the language writes it; one that rounds to zero has no sign. */
export const number = (value: number, digits = 0): string =>
  (Math.abs(value) < 0.5 * 10 ** -digits ? 0 : value).toLocaleString(language === 'de' ? 'de-DE' : 'en-GB', {
    minimumFractionDigits: digits,
    maximumFractionDigits: digits,
  });
