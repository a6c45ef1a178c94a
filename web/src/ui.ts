import { html, type TemplateResult } from 'lit';
import type { Store } from './store';
import type { StepName } from './step_names';
import { worded } from './faults';
import { icon } from './icons';
import { t } from './messages';
import { numeric } from './number_field';
import { type Limits, numberIn, shownNumber } from './written_numbers';

/** A row of choices, of which one is chosen. */
export function choice<T extends string>(
  label: string,
  value: T,
  options: readonly (readonly [T, TemplateResult | string])[],
  choose: (value: T) => void,
): TemplateResult {
  return html`<div
    class="seg ${options.length > 4 && options.every(([, text]) => typeof text === 'string') ? 'many' : ''}"
    role="radiogroup"
    aria-label=${label}
  >
    ${options.map(
      ([key, text]) =>
        html`<label
          ><input type="radio" name=${label} .checked=${key === value} @change=${() => choose(key)} />${text}</label
        >`,
    )}
  </div>`;
}

/** What a browser that watches may not do: all its buttons and fields are disabled there. */
export const acts = (app: Store, content: TemplateResult): TemplateResult =>
  html`<fieldset class="acts" ?disabled=${app.session.watches}>${content}</fieldset>`;

/** The button that leads to the next step. */
export const nextStep = (app: Store, step: StepName, ready = true): TemplateResult =>
  html`<section class="group next-step">
    <button class="btn ${ready ? 'primary' : ''} wide" data-next=${step} @click=${() => app.go(step)}>
      ${t('app.next', { step: app.titleOf(step) })}${icon('arrow')}
    </button>
  </section>`;

/** What holes advise: the step that fills them, at their list. */
export const repairButton = (app: Store): TemplateResult =>
  html`<button
    class="btn wide"
    data-repair
    @click=${async () => {
      app.go('edit');
      await app.updateComplete;
      document.querySelector('#holes')?.scrollIntoView();
    }}
  >
    ${t('edit.repair')}
  </button>`;

export const bytes = (count: number, format: (value: number, digits: number) => string): string =>
  count < 1000
    ? `${format(count, 0)} B`
    : count < 1e6
      ? `${format(count / 1e3, 0)} kB`
      : count < 1e9
        ? `${format(count / 1e6, 1)} MB`
        : `${format(count / 1e9, 1)} GB`;

/** A field with a number and the button that uses it. */
export const numberForm = (
  id: string,
  label: string,
  value: number,
  button: string,
  disabled: boolean,
  use: (value: number) => void,
  limits: Limits = {},
): TemplateResult =>
  html`<form
    class="row"
    @submit=${(event: SubmitEvent) => {
      event.preventDefault();
      use(numberIn(new FormData(event.target as HTMLFormElement), 'value', limits.whole) ?? NaN);
    }}
  >
    <label class="field grow"
      ><span>${label}</span
      ><input id=${id} class="num" name="value" required .defaultValue=${shownNumber(value)} ${numeric(limits)}
    /></label>
    <button class="btn" ?disabled=${disabled}>${button}</button>
  </form>`;

/**
 * A sentence of the library for the page: in the reader's language, no backticks around names, views by their number, a
 * file by its name alone.
 */
export const plain = (sentence: string): string =>
  worded(sentence)
    .replace(/\bviews\/0*(\d+)/g, (_, number: string) => t('findings.view', { number: Number(number) + 1 }))
    .replace(/`([^`]+)`/g, (_, name: string) => (/^[\w-]+$/.test(name) ? name.replaceAll('_', ' ') : name))
    .replace(/(?<![\w.])(?:\/[^\s/:;,()]+(?: [^\s/:;,()]+)*?)+\/([^\s/:;,()]+)/g, '$1');

export const capitalized = (sentence: string): string => sentence.charAt(0).toUpperCase() + sentence.slice(1);

/** A word as a POSIX shell reads it back. */
export const quoted = (word: string): string =>
  /^[A-Za-z0-9_\-+=./,:@%]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;

export const span = (seconds: number): string =>
  seconds < 90 ? `${Math.max(1, Math.round(seconds))} s` : `${Math.round(seconds / 60)} min`;
