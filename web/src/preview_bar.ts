import { html, type TemplateResult } from 'lit';

import type { App } from './app';
import { t } from './messages';
import { stepWords } from './step_words';

/** What an edit would do, in the picture and in words, before it is applied. */
export function previewBar(app: App): TemplateResult {
  const preview = app.step === 'edit' ? app.state.project?.surface?.preview : null;
  if (!preview) return html``;
  return html`<div class="chip preview" role="group" aria-label=${t('preview.title')}>
    <div class="quiet">${t('preview.title')}</div>
    <div class="words">${stepWords(preview)}</div>
    <div class="row">
      <button class="btn primary grow" id="apply" ?disabled=${app.occupied} @click=${() => app.applyPreview()}>${t('preview.apply')}</button>
      <button class="btn grow" id="cancel-preview" ?disabled=${app.occupied} @click=${() => app.command('drop-preview')}>${t('preview.cancel')}</button>
    </div>
  </div>`;
}
