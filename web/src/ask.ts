import { html, type TemplateResult } from 'lit';
import { t } from './messages';

/** The page on which a question is asked. */
interface Host {
  requestUpdate(): void;
  readonly updateComplete: Promise<boolean>;
  dialog(id: string): HTMLDialogElement;
}

interface Question {
  text: string;
  /** What the buttons beside "Cancel" are called; the first one is meant most often. */
  answers: readonly string[];
  /** A text that is asked for, as it begins. */
  entry?: { value: string; lines: number; most: number };
  resolve: (answer: number | null) => void;
}

/** A question that must be answered before something is changed or lost. */
export class Asking {
  private question: Question | null = null;

  constructor(private readonly app: Host) {}

  /** Resolves to the number of the answer, or to null for none. */
  async choose(text: string, answers: readonly string[], entry?: Question['entry']): Promise<number | null> {
    this.answer(null);
    const answered = new Promise<number | null>(
      (resolve) => (this.question = { text, answers, resolve, ...(entry ? { entry } : {}) }),
    );
    this.app.requestUpdate();
    await this.app.updateComplete;
    this.app.dialog('ask').showModal();
    return answered;
  }
  async confirm(text: string, action: string): Promise<boolean> {
    return (await this.choose(text, [action])) === 0;
  }
  /** Resolves to a text, or to null when it is not to be used. */
  async write(
    text: string,
    value: string,
    action: string,
    { lines = 1, most = 60 }: { lines?: number; most?: number } = {},
  ): Promise<string | null> {
    const answered = this.choose(text, [action], { value, lines, most });
    let written = '';
    this.take = (entry) => (written = entry);
    return (await answered) === 0 ? written.trim() : null;
  }
  private take: (entry: string) => void = () => undefined;
  private answer(answer: number | null): void {
    const { question } = this;
    if (!question) return;
    this.question = null;
    const dialog = this.app.dialog('ask');
    this.take(dialog.querySelector<HTMLInputElement | HTMLTextAreaElement>('.entry')?.value ?? '');
    if (dialog.open) dialog.close();
    question.resolve(answer);
    this.app.requestUpdate();
  }

  /** Not when the next question has opened the dialog again since. */
  private readonly closed = (): void => {
    if (!this.app.dialog('ask').open) this.answer(null);
  };

  dialog(): TemplateResult {
    const { question } = this;
    return html`<dialog id="ask" class="ask" aria-label=${t('ask.title')} @close=${this.closed}>
      <p id="question">${question?.text ?? ''}</p>
      ${question?.entry ? entryField(question.entry, () => this.answer(0)) : ''}
      <div class="answers">
        <button class="btn" @click=${() => this.answer(null)}>${t('ask.cancel')}</button>
        ${(question?.answers ?? []).map(
          (text, i) =>
            html`<button class="btn ${i === 0 ? 'primary' : ''}" data-answer=${i} @click=${() => this.answer(i)}>
              ${text}
            </button>`,
        )}
      </div>
    </dialog>`;
  }
}

const entryField = ({ value, lines, most }: NonNullable<Question['entry']>, done: () => void): TemplateResult =>
  lines > 1
    ? html`<textarea
        class="entry lines"
        rows=${lines}
        maxlength=${most}
        aria-labelledby="question"
        .value=${value}
      ></textarea>`
    : html`<div class="field">
        <input
          class="entry"
          maxlength=${most}
          autocomplete="off"
          aria-labelledby="question"
          .value=${value}
          @keydown=${(event: KeyboardEvent) => {
            if (event.key !== 'Enter') return;
            event.preventDefault(); // it would press what gets the focus when the dialog closes
            done();
          }}
        />
      </div>`;
