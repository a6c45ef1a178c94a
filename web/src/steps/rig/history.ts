import { html, type TemplateResult } from 'lit';
import type { App } from '../../parts';
import { rigWords } from '../../rig_facts';
import { icon } from '../../icons';
import { type MessageKey, moment, t } from '../../messages';
import type { KeptRig } from '../../types';

async function restore(app: App, rig: KeptRig): Promise<void> {
  const text = t('rigs.restoreAsk', { rig: rigWords(rig), date: moment(rig.kept_s) });
  if (await app.asking.confirm(text, t('rigs.restore'))) await app.command('restore-rig', { number: rig.number });
}

/** The rigs that the project had, each of which comes back with a click. */
export function rigHistory(app: App): TemplateResult | string {
  const { kept_rigs: kept, scan_begun: fixed } = app.project;
  if (kept.length === 0) return '';
  return html`<section class="group" id="rig-history">
    <h2>${t('rigs.history')}${fixed ? html`<small>${t('live.fixed')}</small>` : ''}</h2>
    <div>
      ${kept.map(
        (rig) =>
          html`<div class="earlier" data-rig=${rig.number}>
            <div>
              <b>${t(`rigs.before.${rig.before}` as MessageKey)}</b>
              <span class="quiet num">${moment(rig.kept_s)}<br />${rigWords(rig)}</span>
            </div>
            <button
              class="btn small"
              ?disabled=${app.occupied || fixed || app.session.watches}
              @click=${() => void restore(app, rig)}
            >
              ${icon('undo')}${t('rigs.restore')}
            </button>
          </div>`,
      )}
    </div>
  </section>`;
}

/** Keeps a calibrated rig for other projects. */
export function keepRig(app: App): TemplateResult | string {
  const { rig, calibration } = app.project;
  if (!rig?.calibration || calibration?.active) return '';
  const same = app.state.rigs.find(
    (one) => one.date === rig.calibration?.date && one.point_sigma_mm === rig.calibration.point_sigma_mm,
  );
  const keep = (event: SubmitEvent) => {
    event.preventDefault();
    const name = String(new FormData(event.target as HTMLFormElement).get('rig-name')).trim();
    void app.command('keep-rig', { name });
  };
  return html`<section class="group" id="keep-rig">
    <h2>${t('rigs.keep')}</h2>
    <p class="quiet">${same ? t('rigs.kept', { name: same.name }) : t('rigs.keepHint')}</p>
    <form class="row" @submit=${keep}>
      <label class="field grow"
        ><span>${t('home.name')}</span
        ><input name="rig-name" required maxlength="60" autocomplete="off" .defaultValue=${app.project.name}
      /></label>
      <button class="btn" ?disabled=${app.occupied || app.session.watches}>${t('rigs.keepIt')}</button>
    </form>
  </section>`;
}
