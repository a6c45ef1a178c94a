import { html, type TemplateResult } from 'lit';
import type { App } from '../../parts';
import { count, moment, t } from '../../messages';
import type { Version } from '../../types';

/** The edits of the surface before, for one that was built again and has none of its own. */
function replaying(app: App): TemplateResult | string {
  const { versions: all, current_version: current } = app.project;
  const present = all.find(({ number }) => number === current);
  const before = all.find(({ number }) => number === present?.previous);
  if (!present || !before || present.steps > 0 || before.steps_done === 0) return '';
  return html`<button
    class="btn wide"
    id="replay"
    ?disabled=${app.busy || app.session.watches}
    @click=${() => app.command('replay-edits', { version: before.number })}
  >
    ${count('surface.replay', before.steps_done, { version: before.number })}
  </button>`;
}

/** The surfaces that were built, the newest first, each with its edits. */
export function versions(app: App): TemplateResult | string {
  const { versions: all, current_version: current } = app.project;
  if (all.length < 2) return '';
  const row = (version: Version): TemplateResult => {
    const name = t('surface.version', { number: version.number });
    const act = t(version.number === current ? 'surface.shown' : 'surface.show');
    return html`<div class="file" data-version=${version.number}>
      <b>${name}</b>
      <span class="num quiet">${moment(version.built_s)} · ${count('surface.edits', version.steps_done)}</span>
      <button
        class="btn small"
        aria-label=${`${act}: ${name}`}
        ?disabled=${app.busy || app.session.watches || version.number === current}
        @click=${() => app.command('open-version', { version: version.number })}
      >
        ${act}
      </button>
    </div>`;
  };
  return html`<section class="group" id="versions">
    <h2>${t('surface.versions')}</h2>
    ${replaying(app)}
    <div>${[...all].reverse().map(row)}</div>
  </section>`;
}
