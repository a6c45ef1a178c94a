import { html, type TemplateResult } from 'lit';
import { live } from 'lit/directives/live.js';

import type { App } from '../../parts';
import { icon } from '../../icons';
import { number, t } from '../../messages';
import { numeric } from '../../number_field';
import { numberIn, shownNumber } from '../../written_numbers';
import type { CharacteristicKind, PlannedCharacteristic, PlannedFeature } from '../../inspection_types';
import type { FoundFeature, Inspection } from '../../types';

/** What can be measured of which kinds of features; the last ones are relative to a datum. */
const OF_ONE: readonly CharacteristicKind[] = [
  'flatness',
  'roundness',
  'cylindricity',
  'position',
  'surface-profile',
  'thickness',
];
const KINDS: readonly CharacteristicKind[] = [
  'distance',
  'angle',
  ...OF_ONE,
  'parallelism',
  'perpendicularity',
  'run-out',
  'total-run-out',
];
const TWO_SIDED: readonly CharacteristicKind[] = ['distance', 'angle', 'thickness'];

const size = ({ diameter_mm, u95_mm }: FoundFeature): string =>
  diameter_mm === null
    ? ''
    : `⌀ ${number(diameter_mm, 3)}${u95_mm === null ? '' : ` ± ${number(1000 * u95_mm, 1)} µm`}`;

/** A feature that was found, to be taken into the plan. */
function found(app: App, feature: FoundFeature, index: number): TemplateResult {
  const { inspecting } = app;
  return html`<tr aria-selected=${inspecting.chosen === index} data-feature=${index}>
    <td>
      <button class="link" @click=${() => inspecting.choose(inspecting.chosen === index ? null : index)}>
        ${t(`inspect.kind.${feature.kind}`)}${feature.hole && feature.diameter_mm !== null ? `, ${t('inspect.hole')}` : ''}
      </button>
    </td>
    <td>${size(feature)}</td>
    <td>
      ${
        feature.name === null
          ? html`<button
              class="btn small"
              ?disabled=${app.occupied || app.session.watches}
              @click=${() => inspecting.add(feature)}
            >
              ${t('inspect.add')}
            </button>`
          : html`<span class="quiet">${feature.name}</span>`
      }
    </td>
  </tr>`;
}

/** Features of the surface, found on demand, to be chosen by a click or from the list. */
function choosing(app: App, inspection: Inspection | null): TemplateResult {
  const { inspecting, viewer } = app;
  const off = app.occupied || app.session.watches;
  const features = inspection?.features ?? [];
  const chosen = inspecting.chosen === null ? undefined : features[inspecting.chosen];
  if (!inspection?.searched)
    return html`<button class="btn wide" id="find-features" ?disabled=${off} @click=${() => void inspecting.run(true)}>
      ${t('inspect.find')}
    </button>`;
  return html`<button
      class="btn wide"
      id="pick-feature"
      aria-pressed=${viewer.tool === 'feature'}
      @click=${() => app.setTool(viewer.tool === 'feature' ? 'orbit' : 'feature')}
    >
      ${icon('part')}${t('inspect.pick')}
    </button>
    ${
      chosen && inspecting.chosen !== null
        ? html`<table class="table features">
            <tbody class="num">
              ${found(app, chosen, inspecting.chosen)}
            </tbody>
          </table>`
        : ''
    }
    <details>
      <summary>${t('inspect.found', { count: features.length })}</summary>
      <table class="table features">
        <tbody class="num">
          ${features.map((feature, i) => found(app, feature, i))}
        </tbody>
      </table>
    </details>`;
}

/** The name of a feature or characteristic, which can be written over. */
const named = (app: App, name: string): TemplateResult =>
  html`<input
    class="name grow"
    aria-label="${t('inspect.name')} ${name}"
    title=${t('inspect.name')}
    maxlength="60"
    ?disabled=${app.occupied || app.session.watches}
    .value=${live(name)}
    @change=${(event: Event) => app.inspecting.rename(name, (event.target as HTMLInputElement).value.trim())}
  />`;

const remove = (app: App, name: string, act: () => void): TemplateResult =>
  html`<button
    class="icon-btn"
    title=${t('inspect.remove')}
    aria-label="${t('inspect.remove')} ${name}"
    ?disabled=${app.occupied || app.session.watches}
    @click=${act}
  >
    ${icon('close')}
  </button>`;

/** A feature of the plan: its nominal size with limits, or the limit of its form. */
function feature(app: App, one: PlannedFeature): TemplateResult {
  const { inspecting } = app;
  const off = app.occupied || app.session.watches;
  const stated = one.face ? inspecting.foundOf(one) : undefined;
  const kind = one.kind ?? stated?.kind;
  const change = (event: SubmitEvent) => {
    event.preventDefault();
    const form = new FormData(event.target as HTMLFormElement);
    const [lower, upper, nominal] = ['lower', 'upper', 'nominal'].map((name) => numberIn(form, name)) as [
      number | null,
      number | null,
      number | null,
    ];
    inspecting.changeFeature(one.name, {
      diameter_mm: nominal,
      tolerance_mm: nominal !== null && lower !== null && upper !== null ? [lower, upper] : null,
    });
  };
  const input = (name: string, label: string, value: number | null | undefined) =>
    html`<label class="field grow"
      ><span>${label}</span
      ><input class="num" name=${name} ?disabled=${off} .defaultValue=${shownNumber(value)} ${numeric({})}
    /></label>`;
  return html`<div class="planned" data-planned=${one.name}>
    <div class="row">${named(app, one.name)}${remove(app, one.name, () => inspecting.removeFeature(one.name))}</div>
    ${
      kind === 'plane' || kind === 'line'
        ? ''
        : html`<form class="row" @submit=${change}>
            ${input('nominal', t('inspect.nominal'), one.diameter_mm ?? stated?.nominal_mm)}
            ${input('lower', t('inspect.lower'), one.tolerance_mm?.[0])}
            ${input('upper', t('inspect.upper'), one.tolerance_mm?.[1])}
            <button class="btn" ?disabled=${off}>${t('inspect.set')}</button>
          </form>`
    }
  </div>`;
}

function characteristic(app: App, one: PlannedCharacteristic): TemplateResult {
  return html`<div class="planned row" data-planned=${one.name}>
    <span class="grow"
      >${named(app, one.name)}<br /><span class="quiet"
        >${t(`inspect.what.${one.kind}`)}:
        ${one.feature ?? one.section ?? ''}${one.datum ? ` – ${one.datum}` : ''}</span
      ></span
    >${remove(app, one.name, () => app.inspecting.removeCharacteristic(one.name))}
  </div>`;
}

/** Where a feature should be: as the plan states it, or the face of the reference. */
function nominalPlace(app: App, features: readonly PlannedFeature[], name?: string): [number, number, number] | null {
  const planned = features.find((one) => one.name === name);
  if (!planned?.face) return planned?.near_mm ?? null;
  const near = app.inspecting.foundOf(planned)?.near_mm ?? [];
  return near.length === 3 && near.every((one) => one !== null) ? (near as [number, number, number]) : null;
}

/** A new characteristic of the features of the plan. */
function adding(app: App, features: readonly PlannedFeature[]): TemplateResult | string {
  if (features.length === 0) return '';
  const off = app.occupied || app.session.watches;
  const add = (event: SubmitEvent) => {
    event.preventDefault();
    const form = new FormData(event.target as HTMLFormElement);
    const text = (name: string) => String(form.get(name) ?? '');
    const kind = text('kind') as CharacteristicKind;
    const two = TWO_SIDED.includes(kind);
    const wanted: Omit<PlannedCharacteristic, 'name'> = { kind, feature: text('feature') };
    if (!OF_ONE.includes(kind)) wanted.datum = text('datum');
    const [nominal, limit] = [numberIn(form, 'nominal'), numberIn(form, 'limit')];
    if (kind === 'position') wanted.position_mm = nominalPlace(app, features, wanted.feature);
    if (two && nominal !== null) wanted.nominal = nominal;
    if (two && nominal !== null && limit !== null) wanted.tolerance = [-limit, limit];
    if (!two && limit !== null) wanted.limit = limit;
    app.inspecting.addCharacteristic(wanted);
  };
  const names = features.map(({ name }, i) => html`<option ?selected=${i === features.length - 1}>${name}</option>`);
  const { kind: adds } = app.inspecting;
  const unit = adds === 'angle' ? '°' : 'mm';
  return html`<form class="adding" id="add-characteristic" @submit=${add}>
    <h2>${t('inspect.addCharacteristic')}</h2>
    <label class="field"
      ><span>${t('inspect.characteristic')}</span>
      <select
        name="kind"
        ?disabled=${off}
        @change=${(event: Event) => app.inspecting.chooseKind((event.target as HTMLSelectElement).value as CharacteristicKind)}
      >
        ${KINDS.map((kind) => html`<option value=${kind} ?selected=${kind === adds}>${t(`inspect.what.${kind}`)}</option>`)}
      </select></label
    >
    <div class="row">
      <label class="field grow"
        ><span>${t('inspect.feature')}</span
        ><select name="feature" ?disabled=${off}>
          ${names}
        </select></label
      >
      ${
        OF_ONE.includes(adds)
          ? ''
          : html`<label class="field grow"
              ><span>${t('inspect.ofDatum')}</span
              ><select name="datum" ?disabled=${off}>
                ${features.map(({ name }) => html`<option>${name}</option>`)}
              </select></label
            >`
      }
    </div>
    <div class="row">
      ${
        TWO_SIDED.includes(adds)
          ? html`<label class="field grow"
              ><span>${t('inspect.nominalOf', { unit })}</span
              ><input class="num" name="nominal" ?disabled=${off} ${numeric({})}
            /></label>`
          : ''
      }
      <label class="field grow"
        ><span>${TWO_SIDED.includes(adds) ? t('inspect.plusMinus', { unit }) : t('inspect.limit')}</span
        ><input class="num" name="limit" ?disabled=${off} ${numeric({ min: 0 })}
      /></label>
      <button class="btn" ?disabled=${off}>${t('inspect.add')}</button>
    </div>
  </form>`;
}

/** The plan: its features and characteristics, and its file. */
export function planned(app: App, inspection: Inspection | null): TemplateResult {
  const { inspecting } = app;
  const { plan } = inspecting;
  const features = plan.features ?? [];
  const off = app.occupied || app.session.watches;
  const open = (event: Event) => {
    const input = event.target as HTMLInputElement;
    const file = input.files?.[0];
    input.value = '';
    if (file) void inspecting.open(file);
  };
  return html`<section class="group" id="plan-group">
    <h2>${t('inspect.plan')}</h2>
    ${app.project.plan_fault ? html`<p><span class="dot bad"></span>${t('inspect.planFault')} ${app.project.plan_fault}</p>` : ''}
    ${features.length === 0 ? html`<p class="quiet">${t('inspect.planLead')}</p>` : ''}
    ${features.map((one) => feature(app, one))} ${(plan.characteristics ?? []).map((one) => characteristic(app, one))}
    ${app.facing.panel(off)} ${choosing(app, inspection)} ${adding(app, features)}
    <div class="pair">
      <label class="btn choose"
        >${icon('folder')}${t('inspect.openPlan')}
        <input id="open-plan" class="sr" type="file" accept=".toml" ?disabled=${off} @change=${open} />
      </label>
      <button class="btn" id="save-plan" ?disabled=${off} @click=${() => void inspecting.write('toml')}>
        ${icon('download')}${t('inspect.savePlan')}
      </button>
    </div>
  </section>`;
}
