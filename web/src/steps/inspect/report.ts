import { html, type TemplateResult } from 'lit';

import type { App } from '../../parts';
import { icon } from '../../icons';
import type { Inspection } from '../../types';
import { t } from '../../messages';

/** What stands at the head of the report, and the files. */
export function reporting(app: App, found: Inspection | null): TemplateResult {
  const { inspecting } = app;
  const { plan } = inspecting;
  const off = app.occupied || app.session.watches;
  const none = off || !found?.current;
  const field = (key: 'serial' | 'order' | 'customer' | 'operator' | 'drawing') =>
    html`<label class="field"
      ><span>${t(`inspect.field.${key}`)}</span
      ><input
        name=${key}
        maxlength="120"
        ?disabled=${off}
        .value=${plan.report?.[key] ?? ''}
        @change=${(event: Event) => {
          const { [key]: _, ...others } = plan.report ?? {};
          const text = (event.target as HTMLInputElement).value.trim();
          inspecting.head({ report: text ? { ...others, [key]: text } : others });
        }}
    /></label>`;
  return html`<section class="group" id="report-group">
    <h2>${t('inspect.report')}</h2>
    <details>
      <summary>${t('inspect.head')}</summary>
      <label class="field"
        ><span>${t('inspect.field.part')}</span
        ><input
          name="part"
          maxlength="120"
          ?disabled=${off}
          .value=${plan.part ?? ''}
          @change=${(event: Event) => inspecting.head({ part: (event.target as HTMLInputElement).value.trim() })}
      /></label>
      ${field('drawing')}${field('serial')}${field('order')}${field('customer')}${field('operator')}
    </details>
    <div class="pair">
      <button class="btn" id="report" ?disabled=${none} @click=${() => void inspecting.write('pdf')}>
        ${icon('download')}${t('inspect.writeReport')}
      </button>
      <button class="btn" id="report-html" ?disabled=${none} @click=${() => void inspecting.write('html')}>HTML</button>
    </div>
    <div class="pair">
      ${(['csv', 'qif'] as const).map(
        (format) =>
          html`<button
            class="btn"
            ?disabled=${none || !found?.characteristics.length}
            @click=${() => void inspecting.write(format)}
          >
            ${format.toUpperCase()}
          </button>`,
      )}
    </div>
  </section>`;
}
