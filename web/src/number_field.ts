import { noChange } from 'lit';
import { directive, Directive, type ElementPart } from 'lit/directive.js';
import { type Limits, numberOf, shownNumber, wrongWith } from './written_numbers';

class NumberField extends Directive {
  private input: HTMLInputElement | null = null;
  private limits: Limits = {};

  override render(_limits: Limits): unknown {
    return noChange;
  }
  override update(part: ElementPart, [limits]: [Limits]): unknown {
    const input = part.element as HTMLInputElement;
    this.limits = limits;
    if (!this.input) {
      this.input = input;
      input.autocomplete = 'off';
      input.addEventListener('input', () => this.check());
      input.addEventListener('change', (event) => this.refuse(event));
      input.addEventListener('keydown', (event) => this.step(event));
    }
    // Keys of numbers on a tablet; some of them have no minus.
    input.inputMode = limits.whole ? 'numeric' : (limits.min ?? -1) >= 0 ? 'decimal' : 'text';
    this.check();
    return noChange;
  }

  private check(): void {
    this.input?.setCustomValidity(wrongWith(this.input.value, this.limits));
  }
  /** What cannot be used stays to be corrected, and is used by nobody. A form says so when it is sent. */
  private refuse(event: Event): void {
    const { input } = this;
    this.check();
    if (!input?.validationMessage || input.form) return;
    event.stopImmediatePropagation();
    input.reportValidity();
  }
  /** The arrow keys count up and down. */
  private step(event: KeyboardEvent): void {
    const { input } = this;
    const { min = -Infinity, max = Infinity, step = 1, whole } = this.limits;
    const way = event.key === 'ArrowUp' ? 1 : event.key === 'ArrowDown' ? -1 : 0;
    const value = input ? (numberOf(input, whole) ?? 0) : NaN;
    if (!input || !way || event.altKey || event.ctrlKey || event.metaKey || !Number.isFinite(value)) return;
    event.preventDefault();
    const next = Math.min(max, Math.max(min, value + way * step));
    input.value = shownNumber(Number(next.toPrecision(12)));
    for (const name of ['input', 'change']) input.dispatchEvent(new Event(name, { bubbles: true }));
  }
}

/**
 * Makes a text field one of numbers: it takes a decimal comma and a decimal point, and says in one sentence what it cannot take.
 * It stands behind the value and before `@change`, which hears of numbers only.
 */
export const numeric = directive(NumberField);
