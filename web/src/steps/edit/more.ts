import { html, type TemplateResult } from 'lit';
import type { App } from '../../parts';
import { number, t } from '../../messages';
import type { Fit } from '../../types';
import { numberForm } from '../../ui';

/** Selections by what is known of each triangle instead of by a stroke. */
export function selectingByValue(app: App): TemplateResult {
  const { surface } = app.project;
  const sigma = 1000 * 3 * (surface?.sigma_mm.combined ?? 0.01);
  return html`<section class="group">
    <h2>${t('edit.more.select')}</h2>
    ${numberForm('select-sigma', t('edit.sigmaAbove'), Number(sigma.toPrecision(2)), t('edit.apply'), app.busy, (value) => void app.editing.selectBy('select-sigma', `${value / 1000}mm`))}
    ${numberForm('select-below', t('edit.below'), 5, t('edit.apply'), app.busy, (value) => void app.editing.selectBy('select-plane', `0,0,-1,${-value}`))}
    <button class="btn wide" ?disabled=${app.busy} @click=${() => app.editing.selectBy('select-mark', 'synthesized')}>
      ${t('edit.byMark')}
    </button>
  </section>`;
}

function found(fit: Fit): TemplateResult {
  const size = fit.diameter_mm;
  const axis = fit.axis.map((value) => number(value, 3)).join('  ');
  return html`<div class="fit num">
    <div>
      <b>${t(`edit.${fit.kind}`)}</b>
      <span
        >${size === null ? '' : html`⌀ ${number(size, 3)} mm`}${fit.u95_mm === null ? '' : ` ± ${number(1000 * fit.u95_mm, 1)} µm`}</span
      >
    </div>
    <div class="quiet">
      <span>${fit.kind === 'sphere' ? fit.center_mm.map((value) => number(value, 2)).join('  ') : axis}</span>
      <span>${t('edit.form')} ${number(1000 * fit.form_mm, 1)} µm</span>
    </div>
  </div>`;
}

/** Shapes fitted to the selected triangles, with their expanded uncertainty. */
export function fitting(app: App): TemplateResult {
  const { surface } = app.project;
  const selected = surface?.selected ?? 0;
  return html`<section class="group">
    <h2>${t('edit.fit')}</h2>
    <div class="row">
      ${(['plane', 'cylinder', 'sphere'] as const).map(
        (kind) =>
          html`<button
            class="btn small grow"
            data-fit=${kind}
            ?disabled=${!selected || app.busy}
            @click=${() => app.command('fit', { kind })}
          >
            ${t(`edit.${kind}`)}
          </button>`,
      )}
    </div>
    ${surface?.fits.length ? html`<div>${[...surface.fits].reverse().map(found)}</div>` : html`<p class="quiet">${t('edit.fitHint')}</p>`}
  </section>`;
}

/** Operations that change the whole mesh. */
export function shaping(app: App): TemplateResult {
  const { viewer } = app;
  const plane = () => app.sectioning.half;
  const off = app.busy || viewer.section.normal === null;
  return html`<section class="group">
    <h2>${t('edit.shape')}</h2>
    ${app.sectioning.panel(false)}
    <div class="pair">
      <button
        class="btn"
        id="cut"
        ?disabled=${off}
        title=${t('edit.cut')}
        @click=${() => app.editing.preview('cut', plane())}
      >
        ${t('edit.cutShort')}
      </button>
      <button class="btn" id="mirror" ?disabled=${off} @click=${() => app.editing.preview('mirror', plane())}>
        ${t('edit.mirrorAt')}
      </button>
    </div>
    ${viewer.section.normal === null ? html`<p class="quiet">${t('edit.needsSection')}</p>` : ''}
    ${numberForm('offset', t('edit.offsetBy'), 0.5, t('edit.offset'), app.busy, (value) => app.editing.preview('offset', `${value}`))}
    ${numberForm('islands', t('edit.islandsUpTo'), 5, t('edit.delete'), app.busy, (value) => app.editing.preview('remove-islands', `${value}mm`))}
    <button
      class="btn wide"
      id="align"
      aria-pressed=${viewer.tool === 'align'}
      @click=${() => app.setTool(viewer.tool === 'align' ? 'orbit' : 'align')}
    >
      ${t('edit.align')}
    </button>
  </section>`;
}
