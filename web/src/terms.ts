import { html, type TemplateResult } from 'lit';

import { t } from './messages';
import type { TERMS } from './messages/terms';

type TermOf<Key> = Key extends `term.${infer Name}` ? Name : never;
/** The terms that the page explains. */
export type Term = TermOf<keyof typeof TERMS>;

const MARGIN = 12;
let card: HTMLElement | null = null;

/** Shows what a term means below the button that asked. */
function explain(event: Event, name: Term): void {
  event.preventDefault(); // of a label or a summary around the button
  event.stopPropagation();
  if (!card) {
    card = document.createElement('aside');
    card.className = 'term-card';
    card.popover = 'auto';
    card.tabIndex = -1;
    document.body.append(card);
  }
  const word = document.createElement('b');
  word.textContent = t(`term.${name}`);
  const meaning = document.createElement('p');
  meaning.textContent = t(`means.${name}`);
  card.replaceChildren(word, meaning);
  card.setAttribute('aria-label', t(`term.${name}`));
  card.showPopover();
  const at = (event.currentTarget as HTMLElement).getBoundingClientRect();
  const { width, height } = card.getBoundingClientRect();
  const below = at.bottom + 6 + height < innerHeight - MARGIN;
  card.style.left = `${Math.max(MARGIN, Math.min(at.left - 20, innerWidth - width - MARGIN))}px`;
  card.style.top = `${below ? at.bottom + 6 : at.top - 6 - height}px`;
  card.focus();
}

/** A "?" beside a term, which opens its entry. */
export const term = (name: Term): TemplateResult =>
  html`<button
    type="button"
    class="term"
    data-term=${name}
    aria-label=${t('term.ask', { term: t(`term.${name}`) })}
    @click=${(event: Event) => explain(event, name)}
  >
    ?
  </button>`;
