import { html, type TemplateResult } from 'lit';

import type { App } from './parts';
import { t } from './messages';
import { stepWords } from './step_words';

/** What an edit would do, in the picture and in words, before it is applied. */
export function previewBar(app: App): TemplateResult {
  const preview = app.step === 'edit' ? app.state.project?.surface?.preview : null;
  if (!preview) return html``;
  const { triangles, holes, components, moved } = preview.change;
  const nothing = triangles === 0 && holes === 0 && components === 0 && moved === 0;
  return html`<div class="chip preview" role="group" aria-label=${t('preview.title')}>
    <div class="quiet">${t('preview.title')}</div>
    <div class="words">${stepWords(preview)}</div>
    ${
      nothing
        ? ''
        : html`<div class="row quiet">
            <span><i class="key added"></i>${t('preview.added')}</span
            ><span><i class="key removed"></i>${t('preview.removed')}</span>
          </div>`
    }
    <div class="row">
      ${nothing ? '' : html`<button class="btn primary grow" id="apply" ?disabled=${app.occupied || app.session.watches} @click=${() => app.editing.applyPreview()}>${t('preview.apply')}</button>`}
      <button
        class="btn grow"
        id="cancel-preview"
        ?disabled=${app.occupied || app.session.watches}
        @click=${() => app.command('drop-preview')}
      >
        ${t(nothing ? 'app.close' : 'preview.cancel')}
      </button>
    </div>
  </div>`;
}
