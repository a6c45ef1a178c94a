import { html, type TemplateResult } from 'lit';

import type { App } from '../../parts';
import { worded } from '../../faults';
import { icon } from '../../icons';
import type { Acceptance } from '../../types';
import { number, t } from '../../messages';
import { numeric } from '../../number_field';
import { numberIn, shownNumber } from '../../written_numbers';

const DOTS = { in: 'done', out: 'bad', undecided: 'poor' } as const;
const LIMITS = {
  form: 'probing_form_mm',
  size: 'probing_size_mm',
  spacing: 'sphere_spacing_mm',
  length: 'length_mm',
} as const;
const BAR = ['1', '2', '3', '4', '5', '6', '7'] as const;
const BALL = ['1', '2', '3'] as const;

/** The usual arrangements of an artifact that were not measured yet. */
export function openArrangements({ artifact, arrangements }: Acceptance): string[] {
  const names =
    artifact.diameters_mm.length === 2
      ? BAR.map((one) => t(`accept.bar.${one}`))
      : BALL.map((one) => t(`accept.ball.${one}`));
  return names.filter((name) => !arrangements.some((one) => one.name === name));
}

/** What a form states, as acceptance.toml has it; empty fields are left out. */
export function acceptancePlan(form: FormData): object {
  const text = (name: string) => String(form.get(name) ?? '').trim();
  const of = (name: string) => numberIn(form, name);
  const volume = ['volume_x', 'volume_y', 'volume_z'].map(of);
  return {
    artifact: {
      diameters_mm: [of('diameter1'), of('diameter2')].filter((one) => one !== null),
      spacing_mm: of('diameter2') === null ? null : of('spacing'),
      u95_mm: of('u95'),
      form_mm: of('form'),
      expansion_ppm_per_k: of('expansion'),
      certificate: text('certificate') || null,
    },
    limits: Object.fromEntries(
      Object.entries(LIMITS).map(([name, key]) => {
        const ofBar = name === 'spacing' || name === 'length';
        return [key, ofBar && of('diameter2') === null ? null : of(`limit_${name}`)];
      }),
    ),
    volume_mm: volume.every((one) => one !== null) ? volume : null,
    conditions: {
      temperature_c: of('temperature'),
      temperature_u_k: of('temperature_u'),
      operator: text('operator') || null,
    },
  };
}

/** The artifact as its certificate states it, and the limits. */
function artifactForm(app: App, test: Acceptance | null): TemplateResult {
  const off = app.occupied || app.session.watches;
  const input = (name: string, label: string, value: number | null | undefined, required = false) =>
    html`<label class="field"
      ><span>${label}</span
      ><input
        class="num"
        name=${name}
        ?required=${required}
        ?disabled=${off}
        .defaultValue=${shownNumber(value)}
        ${numeric({})}
    /></label>`;
  const words = (name: 'certificate' | 'operator', value: string | undefined) =>
    html`<label class="field"
      ><span>${t(`accept.${name}`)}</span
      ><input name=${name} maxlength="120" ?disabled=${off} .defaultValue=${value ?? ''}
    /></label>`;
  const artifact = test?.artifact;
  const begin = (event: SubmitEvent) => {
    event.preventDefault();
    void app.command('set-acceptance', { plan: acceptancePlan(new FormData(event.target as HTMLFormElement)) });
  };
  return html`<details id="artifact">
    <summary>${t('accept.artifact')}</summary>
    <form @submit=${begin}>
      ${input('diameter1', t('accept.diameter1'), artifact?.diameters_mm[0], true)}
      ${input('diameter2', t('accept.diameter2'), artifact?.diameters_mm[1])}
      ${input('spacing', t('accept.spacing'), artifact?.spacing_mm)}
      ${input('u95', t('accept.u95'), artifact?.u95_mm, true)} ${input('form', t('accept.form'), artifact?.form_mm)}
      ${input('expansion', t('accept.expansion'), artifact?.expansion_ppm_per_k)}
      ${words('certificate', artifact?.certificate)}
      ${(['form', 'size', 'spacing', 'length'] as const).map((name) =>
        input(`limit_${name}`, t(`accept.limit.${name}`), test?.limits[LIMITS[name]]),
      )}
      ${input('temperature', t('accept.temperature'), test?.temperature_c ?? 20)}
      ${input('temperature_u', t('accept.temperature_u'), test?.temperature_u_k)}
      <fieldset class="field">
        <legend>${t('accept.volume')}</legend>
        <div class="pair">
          ${['x', 'y', 'z'].map(
            (axis, i) =>
              html`<input
                class="num"
                name="volume_${axis}"
                aria-label="${t('accept.volume')} ${axis.toUpperCase()}"
                ?disabled=${off}
                .defaultValue=${shownNumber(test?.volume_mm?.[i])}
                ${numeric({})}
              />`,
          )}
        </div>
      </fieldset>
      ${words('operator', test?.operator)}
      <button class="btn wide" id="set-acceptance" ?disabled=${off}>
        ${t(test ? 'accept.change' : 'accept.begin')}
      </button>
    </form>
  </details>`;
}

/** The worst errors of all arrangements, with their limits. */
function errors(test: Acceptance): TemplateResult | string {
  if (test.quantities.length === 0) return '';
  const { verdict } = test;
  return html`<p id="acceptance-verdict">
      <span class="dot ${verdict ? DOTS[verdict] : ''}"></span> ${t(`accept.${verdict ?? 'open'}`)}
    </p>
    <table class="table" id="errors">
      <thead>
        <tr>
          <th></th>
          <th>mm</th>
          <th>± U95</th>
          <th>≤</th>
        </tr>
      </thead>
      <tbody class="num">
        ${test.quantities.map(
          (one) =>
            html`<tr>
              <th scope="row" title=${test.arrangements[one.arrangement]?.name ?? ''}>
                ${one.verdict ? html`<span class="dot ${DOTS[one.verdict]}"></span>` : ''}
                ${t(`accept.what.${one.symbol}`)}
              </th>
              <td>${number(one.error_mm, 4)}</td>
              <td>${number(one.u95_mm, 4)}</td>
              <td>${one.limit_mm === null ? '·' : number(one.limit_mm, 4)}</td>
            </tr>`,
        )}
      </tbody>
    </table>`;
}

/** The arrangements so far, this one, and the next. */
function arrangements(app: App, test: Acceptance): TemplateResult {
  const off = app.occupied || app.session.watches;
  const here = test.arrangements.find(({ project }) => project === app.project.name);
  const open = openArrangements(test);
  const measure = (event: SubmitEvent) => {
    event.preventDefault();
    const name = String(new FormData(event.target as HTMLFormElement).get('arrangement') ?? '').trim();
    void app.command('measure-arrangement', { name });
  };
  return html`<ol class="parts">
      ${test.arrangements.map(
        ({ name, project, warnings }) =>
          html`<li>
            <span class="dot ${warnings.length > 0 ? 'poor' : 'done'}" title=${warnings.map(worded).join('\n')}></span>
            <b>${name}</b> <span class="quiet">${project}</span>
          </li>`,
      )}
    </ol>
    <form @submit=${measure}>
      <label class="field"
        ><span>${t('accept.name')}</span
        ><input
          name="arrangement"
          list="arrangements"
          maxlength="80"
          required
          ?disabled=${off}
          .defaultValue=${here?.name ?? open[0] ?? ''}
      /></label>
      <datalist id="arrangements">${open.map((name) => html`<option value=${name}></option>`)}</datalist>
      <button class="btn wide" id="measure-arrangement" ?disabled=${off}>
        ${t(here ? 'accept.again' : 'accept.measure')}
      </button>
    </form>
    <div class="pair">
      ${
        app.project.can_scan
          ? html`<button
              class="btn"
              id="next-arrangement"
              ?disabled=${off || !here}
              @click=${() => void app.inspecting.next()}
            >
              ${t('accept.next')}
            </button>`
          : ''
      }
      <button
        class="btn"
        id="certificate"
        ?disabled=${off || test.arrangements.length === 0}
        @click=${() => void app.inspecting.certify()}
      >
        ${icon('download')}${t('accept.pdf')}
      </button>
    </div>
    ${
      test.incomplete.length > 0
        ? html`<p class="quiet">${t('accept.missing')}</p>
            <ul class="quiet">
              ${test.incomplete.map((one) => html`<li>${worded(one)}</li>`)}
            </ul>`
        : ''
    }
    <button
      class="btn"
      id="end-acceptance"
      ?disabled=${off}
      @click=${() => void app.command('set-acceptance', { end: true })}
    >
      ${t('accept.end')}
    </button>`;
}

/** The acceptance test of the scanner: the artifact, its arrangements and the certificate. */
export function accepting(app: App): TemplateResult {
  const test = app.project.acceptance;
  return html`<section class="group" id="accept-group">
    <h2>${t('accept.title')}</h2>
    ${test ? html`${errors(test)} ${arrangements(app, test)}` : html`<p class="quiet">${t('accept.lead')}</p>`}
    ${artifactForm(app, test)}
  </section>`;
}
