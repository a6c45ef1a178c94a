import { html, type TemplateResult } from 'lit';
import type { App } from '../../parts';
import { t } from '../../messages';
import { capitalized, plain } from '../../ui';

/** Longer sentences are shown in full only when they are opened. */
const FIRST_LINE = 120;
/** A first line of fewer letters says too little. */
const SHORTEST = 20;

function sentence(text: string): TemplateResult {
  const whole = capitalized(plain(text));
  const end = SHORTEST + whole.slice(SHORTEST).search(/[;.] /);
  if (whole.length <= FIRST_LINE || end < SHORTEST) return html`<p>${whole}</p>`;
  return html`<details>
    <summary>${whole.slice(0, end)}</summary>
    <p>${whole.slice(end + 2)}</p>
  </details>`;
}

/** What the reconstruction found wrong: whether the surface can be trusted, views that were left out, and why. */
export function findings(app: App): TemplateResult | string {
  const summary = app.project.surface?.summary;
  if (!summary) return '';
  const { untrusted_reason: reason, views, views_of_scan: all } = summary;
  const warnings = (summary.warnings ?? []).filter((one) => !reason || !one.includes(reason));
  const missing = (all ?? views) - views;
  if (!reason && missing <= 0 && warnings.length === 0) return '';
  return html`<section class="group findings" id="findings">
    ${
      reason
        ? html`<h2 class="bad">
              <span><span class="dot bad"></span>${t('findings.untrusted')}</span>
            </h2>
            ${sentence(reason)}`
        : html`<h2>
            <span><span class="dot poor"></span>${t('findings.title')}</span>
          </h2>`
    }
    ${missing > 0 ? html`<p id="left-out">${t('findings.leftOut', { count: missing, all: all ?? views })}</p>` : ''}
    ${warnings.map(sentence)}
    ${
      app.project.can_scan && (reason || missing > 0)
        ? html`<button class="btn wide" @click=${() => app.go('scan')}>${t('findings.toScan')}</button>`
        : ''
    }
  </section>`;
}
