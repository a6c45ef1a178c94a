import { html, svg, type TemplateResult } from 'lit';
import { LAYERS, type LiveLayer } from '../../live_stage';
import type { App } from '../../parts';
import { css, type Rgb, viridis } from '../../colors';
import { histogram } from '../../histogram';
import { icon } from '../../icons';
import { cyclic, STATUS_COLORS } from '../../live_view';
import { legend } from '../../legend';
import { type Ends, heightColor } from '../../mesh_colors';
import { number, t } from '../../messages';
import { numeric } from '../../number_field';
import { numberOf, readNumbers, shownNumber } from '../../written_numbers';
import type { LivePattern } from '../../types';
import { term } from '../../terms';
import { choice, nextStep, plain } from '../../ui';
import { hasTable } from '../../rig_facts';

const STATUSES = [
  'measured',
  'filled',
  'unmodulated',
  'saturated',
  'residue',
  'order',
  'unresolved',
  'mixed',
  'field',
] as const;

/** Exposures on a slider that grows by a tenth of a decade. */
const exposureAt = (step: number): number => Number((10 ** (step / 20)).toPrecision(2));
const stepOf = (exposure: number): number => Math.round(20 * Math.log10(exposure));

/** What stands on the picture: layers, figures and the scale of its colours. */
export function liveOverlay(app: App): TemplateResult {
  const { figures } = app.live.view;
  const age = app.live.frozen_s;
  const frozen = age === null ? '' : app.project.live ? t('live.frozen', { seconds: number(age) }) : t('live.stopped');
  return html`<div class="layers">
      ${choice<LiveLayer>(
        t('live.layer'),
        app.live.layer,
        LAYERS.map((layer) => [layer, t(`live.${layer}`)] as const),
        (layer) => app.live.setLayer(layer),
      )}
    </div>
    ${frozen ? html`<div class="live-frozen" role="status"><span class="dot poor"></span>${frozen}</div>` : ''}
    ${(app.project.live || app.job('live')) && !figures ? html`<div class="live-wait quiet">${t('live.waiting')}</div>` : ''}
    ${
      figures
        ? html`<div class="live-foot">
            ${scale(app, app.live.layer, figures.low, figures.high)}
            <span class="num"
              >${t('live.rate', { frames: number(figures.frames_per_s, 1), decodes: number(figures.decodes_per_s, 1) })}</span
            >
          </div>`
        : ''
    }`;
}

function scale(app: App, layer: LiveLayer, low: number, high: number): TemplateResult | string {
  if (layer === 'status')
    return html`<span class="status-key all"
      >${STATUSES.map(
        (name, i) =>
          html`<span
            ><svg viewBox="0 0 10 10" aria-hidden="true">
              ${svg`<rect width="10" height="10" rx="2" fill=${css(STATUS_COLORS[i] ?? [0, 0, 0])} />`}</svg
            >${t(`status.${name}`)}</span
          >`,
      )}</span
    >`;
  if (layer === 'camera')
    return html`<span class="status-key"
      ><span
        ><svg viewBox="0 0 10 10" aria-hidden="true"><rect class="saturated" width="10" height="10" rx="2" /></svg
        >${t('live.saturated')}</span
      ><span
        ><svg viewBox="0 0 10 10" aria-hidden="true"><rect class="dark" width="10" height="10" rx="2" /></svg
        >${t('live.dark')}</span
      ></span
    >`;
  if (layer === 'phase') return ramp('−π', cyclic, 'π', 'rad');
  if (layer === 'points') {
    const { heights, ownEnds } = app.live;
    const setEnds = (ends: Ends | null) => app.live.setEnds(ends);
    const title = t('live.height');
    if (!heights) return '';
    return legend({ title, scale: heights, factor: 1, digits: 1, color: heightColor, own: ownEnds !== null, setEnds });
  }
  if (layer === 'depth') return ramp(number(low, 1), (share) => viridis(1 - share), number(high, 1), 'mm');
  return ramp(number(low), viridis, number(high), t('live.counts'));
}

/** A scale of colours with its ends and its unit. */
function ramp(low: string, color: (share: number) => Rgb, high: string, unit: string): TemplateResult {
  const STEPS = 24;
  const stops = Array.from(
    { length: STEPS },
    (_, i) => svg`<rect x=${i * 5} width="5.2" height="8" fill=${css(color(i / (STEPS - 1)))} />`,
  );
  return html`<span class="ramp num"
    >${low}<svg viewBox="0 0 120 8" preserveAspectRatio="none" aria-hidden="true">${stops}</svg>${high} ${unit}</span
  >`;
}

/** How sharp the fringes are, and how sharp they were: focus is where the bar reaches its mark again. */
function focus(app: App, contrast: number): TemplateResult | string {
  const { peak, view } = app.live;
  if (!view.figures || peak === 0) return '';
  const at = (share: number) => 320 * Math.min(1, share);
  return html`<div class="focus">
    <svg
      viewBox="0 0 320 12"
      preserveAspectRatio="none"
      role="img"
      aria-label=${t('live.focus', { contrast: number(contrast, 2), peak: number(peak, 2) })}
    >
      ${svg`<rect class="all" width="320" height="12" rx="2" /><rect class="now" width=${at(contrast)} height="12" rx="2" />
        <rect class="peak" x=${Math.max(0, at(peak) - 3)} width="3" height="12" />`}
    </svg>
    <div class="pair">
      <button class="btn small" id="new-peak" @click=${() => app.live.forgetPeak()}>${t('live.newPeak')}</button>
      <button
        class="btn small"
        id="loupe"
        aria-pressed=${view.loupe}
        ?disabled=${app.live.layer === 'points'}
        @click=${() => app.live.toggleLoupe()}
      >
        ${t('live.loupe')}
      </button>
    </div>
  </div>`;
}

function light(app: App): TemplateResult {
  const { figures } = app.live.view;
  const contrast = figures?.contrast ?? 0;
  const share = (value: number | undefined) => (value === undefined ? '·' : `${number(100 * value, 1)} %`);
  return html`<section class="group">
    <h2>${t('live.light')}</h2>
    ${histogram(app.live.view.histogram)}
    <dl class="figures">
      <dt><i class="key saturated"></i>${t('live.saturated')}</dt>
      <dd class="num ${figures && figures.saturated > 0.005 ? 'bad' : ''}">${share(figures?.saturated)}</dd>
      <dt><i class="key dark"></i>${t('live.darkPart')}</dt>
      <dd class="num">${share(figures?.dark)}</dd>
      <dt>${t('live.contrast')}${term('contrast')}</dt>
      <dd class="num" id="contrast">${contrast > 0 ? number(contrast, 2) : '·'}</dd>
      <dt>${t('scan.points')}</dt>
      <dd class="num" id="live-points">${figures ? number(figures.points) : '·'}</dd>
      <dt>${t('live.decode')}</dt>
      <dd class="num">${figures && figures.decode_ms ? html`${number(figures.decode_ms, 0)}<span>ms</span>` : '·'}</dd>
    </dl>
    ${focus(app, contrast)}
    <label class="switch"
      ><span>${t('live.marks')}</span
      ><input
        id="marks"
        type="checkbox"
        .checked=${app.live.view.marks}
        @change=${(event: Event) => app.live.setMarks((event.target as HTMLInputElement).checked)}
    /></label>
    ${figures?.finding ? html`<p><span class="dot poor"></span>${plain(figures.finding)}</p>` : ''}
  </section>`;
}

function exposure(app: App): TemplateResult {
  const { capture, scan_begun } = app.project;
  const several = capture.exposures_ms.length > 1;
  const fixed = scan_begun || app.occupied;
  const set = (key: 'exposure_ms' | 'gain_db' | 'black_level_counts', value: number) =>
    void app.command('set-capture', { [key]: value });
  const slider = (
    id: string,
    label: string,
    value: number,
    shown: string,
    least: number,
    most: number,
    step: number,
    change: (value: number) => void,
  ) =>
    html`<label class="slider"
      ><span>${label}</span><b class="num">${shown}</b>
      <input
        id=${id}
        type="range"
        min=${least}
        max=${most}
        step=${step}
        .value=${String(value)}
        ?disabled=${scan_begun}
        @change=${(event: Event) => change(Number((event.target as HTMLInputElement).value))}
    /></label>`;
  return html`<section class="group">
    <h2>${t('live.exposure')}${scan_begun ? html`<small>${t('live.fixed')}</small>` : ''}</h2>
    ${slider('exposure', t('live.time'), stepOf(capture.exposure_ms), `${number(capture.exposure_ms, capture.exposure_ms < 10 ? 2 : 1)} ms`, -20, 50, 1, (step) => set('exposure_ms', exposureAt(step)))}
    <div class="pair">
      <button
        class="btn"
        id="auto-exposure"
        ?disabled=${fixed}
        title=${t('live.autoHint')}
        @click=${() => app.command('find-exposure')}
      >
        ${icon('sun')}${t('live.auto')}
      </button>
      <button
        class="btn"
        id="bracket"
        ?disabled=${fixed}
        title=${t('live.bracketHint')}
        @click=${() => app.command('find-exposure', { bracket: true })}
      >
        ${icon('layers')}${t('live.bracket')}
      </button>
    </div>
    ${exposures(app, several, fixed)}
    ${slider('gain', t('live.gain'), capture.gain_db, `${number(capture.gain_db, 1)} dB`, 0, 24, 0.5, (value) => set('gain_db', value))}
    ${slider('black', t('live.black'), capture.black_level_counts, number(capture.black_level_counts, 0), 0, 32, 1, (value) => set('black_level_counts', value))}
  </section>`;
}

/** The exposures of each frame of the scan; what several of them measure is merged. */
function exposures(app: App, several: boolean, fixed: boolean): TemplateResult {
  const { exposures_ms } = app.project.capture;
  const shown = several ? exposures_ms.map((value) => shownNumber(Number(value.toPrecision(3)))).join(' ') : '';
  const enter = (event: Event) => {
    const input = event.target as HTMLInputElement;
    const values = readNumbers(input.value);
    if (!values.every((value) => value > 0 && Number.isFinite(value))) {
      app.say(t('live.badExposures', { text: input.value }));
      input.value = shown;
      return;
    }
    const [one] = values;
    if (values.length === 1 && one !== undefined)
      void app.command('set-capture', { exposure_ms: one, exposures_ms: [] }).then(() => (input.value = ''));
    else void app.command('set-capture', { exposures_ms: values });
  };
  return html`<label class="field"
    ><span>${t('live.exposures')}${term('exposure bracket')}</span
    ><input
      id="exposures"
      class="num"
      autocomplete="off"
      inputmode="decimal"
      placeholder=${t('live.exposuresHint')}
      ?disabled=${fixed}
      .value=${shown}
      @change=${enter}
  /></label>`;
}

/** By how much a button turns the table, degrees. */
const JOG = 15;

function fringes(app: App): TemplateResult {
  const { capture, scan_begun, live } = app.project;
  const usable = app.state.algorithms;
  const at = live?.table_deg ?? 0;
  const turnTo = (angle: number) => void app.command('set-live', { table_deg: angle });
  return html`<section class="group">
    <h2>${t('live.fringes')}</h2>
    ${choice<LivePattern>(
      t('live.pattern'),
      live?.pattern ?? 'fringes',
      [
        ['fringes', t('live.patternFringes')],
        ['white', t('live.patternWhite')],
        ['dark', t('live.patternDark')],
      ],
      (pattern) => void app.command('set-live', { pattern }),
    )}
    <div class="pair">
      <label class="field"
        ><span>${t('live.frames')}</span
        ><select
          id="shifts"
          ?disabled=${scan_begun}
          @change=${(event: Event) => void app.command('set-capture', { shifts: Number((event.target as HTMLSelectElement).value), algorithm: 'auto' })}
        >
          ${[3, 4, 5, 6, 8, 12].map((count) => html`<option value=${count} ?selected=${count === capture.shifts}>${count}</option>`)}
        </select></label
      >
      <label class="field"
        ><span>${t('live.algorithm')}</span
        ><select
          id="algorithm"
          ?disabled=${scan_begun}
          @change=${(event: Event) => void app.command('set-capture', { algorithm: (event.target as HTMLSelectElement).value })}
        >
          <option value="auto" ?selected=${capture.algorithm === 'auto'}>auto</option>
          ${usable.map((one) => html`<option value=${one.name} title=${one.frames} ?selected=${one.name === capture.algorithm}>${one.name}</option>`)}
        </select></label
      >
    </div>
    <label class="field"
      ><span>${t('home.stations')}</span
      ><input
        id="stations"
        class="num"
        ?disabled=${scan_begun}
        .value=${String(app.project.stations.length)}
        ${numeric({ min: 1, max: 360, whole: true })}
        @change=${(event: Event) => {
          const stations = numberOf(event.target as HTMLInputElement, true);
          if (stations !== null) void app.command('set-capture', { stations });
        }}
    /></label>
    <label class="slider"
      ><span>${t('live.table')}</span><b class="num">${number(live?.table_deg ?? 0, 0)}°</b>
      <input
        id="table"
        type="range"
        min="0"
        max="345"
        step="15"
        .value=${String(live?.table_deg ?? 0)}
        @change=${(event: Event) => turnTo(Number((event.target as HTMLInputElement).value))}
    /></label>
    ${
      hasTable(app)
        ? html`<div class="row" id="jog">
            ${[-JOG, 0, JOG].map(
              (by) =>
                html`<button
                  class="btn small grow num"
                  data-jog=${by}
                  ?disabled=${!live}
                  @click=${() => turnTo(by === 0 ? 0 : (at + by + 360) % 360)}
                >
                  ${by === 0 ? t('live.home') : `${by < 0 ? '−' : '+'}${number(Math.abs(by))}°`}
                </button>`,
            )}
          </div>`
        : ''
    }
  </section>`;
}

export function liveStep(app: App): TemplateResult {
  const { project } = app;
  if (!project.can_scan)
    return html`<section class="group">
        <p class="quiet">${t(project.scan_complete ? 'scan.noRig' : 'live.noDevices')}</p>
      </section>
      ${project.scan_complete ? '' : nextStep(app, 'rig')}`;
  const job = app.job('live');
  return html`<section class="group">
      ${
        job
          ? html`<button class="btn wide" id="live-stop" @click=${() => app.command('stop-job', { job: job.number })}>
              ${icon('pause')}${t('live.stop')}
            </button>`
          : html`<button
              class="btn primary wide"
              id="live-start"
              ?disabled=${app.busy}
              @click=${() => app.command('start-live')}
            >
              ${icon('play')}${t('live.start')}
            </button>`
      }
      <p class="quiet">${t(project.rig ? 'live.lead' : 'live.leadUncalibrated')}</p>
    </section>
    ${light(app)}${exposure(app)}${fringes(app)}${nextStep(app, 'scan', Boolean(project.live))}`;
}
