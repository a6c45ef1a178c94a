import { html, type TemplateResult } from 'lit';
import { type DeviceDraft, driverOf } from '../../arranging';
import type { App } from '../../parts';
import { devicesAnswer } from '../../rig_facts';
import { worded } from '../../faults';
import { icon } from '../../icons';
import { type MessageKey, t } from '../../messages';
import { type Table, TABLES } from '../../types';
import { deviceForm } from './device_form';
import { plain } from '../../ui';
import type { RigStage } from './stages';

const REQUIRED: ReadonlySet<Table> = new Set(['camera', 'fringes']);

/** The devices of the rig as a draft to begin with. */
export const draftOf = (app: App): DeviceDraft =>
  Object.fromEntries(
    TABLES.map((table) => [table, app.project.devices.find((one) => one.table === table)?.settings ?? '']),
  ) as DeviceDraft;

/** Whether a device exists in software alone. */
const isSimulated = (one?: { driver: string }): boolean => one?.driver.startsWith('simulated') ?? false;

/** One table: what was found, then every driver, the simulated ones last; then the settings as a form. */
function chooser(app: App, draft: DeviceDraft, table: Table): TemplateResult {
  const search = app.state.search;
  const found = search?.connected.filter((one) => one.table === table) ?? [];
  const drivers = search?.drivers.filter((one) => one.table === table) ?? [];
  const lines = draft[table];
  const chosen = found.findIndex((one) => lines.startsWith(one.settings));
  const change = (text: string) => app.arranging.draftDevices({ ...draft, [table]: text });
  const pick = (value: string) => {
    if (value === '') return change('');
    const at = Number(value.slice(1));
    const one = found[at];
    // The first mode is the largest image without compression.
    if (value.startsWith('f')) return change(one ? one.settings + (one.modes[0]?.settings ?? '') : '');
    change(`driver = "${drivers[at]?.driver}"\n`);
  };
  const shown = found.find((one) => lines.startsWith(one.settings));
  const mode = shown?.modes.findIndex((one) => lines === shown.settings + one.settings) ?? -1;
  const driver = drivers.findIndex((one) => one.driver === driverOf(lines));
  const value = lines === '' ? '' : chosen >= 0 ? `f${chosen}` : driver >= 0 ? `d${driver}` : 'as is';
  const option = (key: string, text: string) => html`<option value=${key} ?selected=${key === value}>${text}</option>`;
  const foundOption = (one: { name: string }, i: number) => option(`f${i}`, one.name);
  const driverOption = (one: { description: string }, i: number) => option(`d${i}`, worded(one.description));
  const group = (name: MessageKey, options: TemplateResult[]) =>
    options.length ? html`<optgroup label=${t(name)}>${options}</optgroup>` : '';
  return html`<div class="chooser">
    <label class="field"
      ><span
        >${t(`table.${table}` as MessageKey)}${REQUIRED.has(table) ? '' : html`<small>${t('rig.optional')}</small>`}</span
      ><select data-table=${table} @change=${(event: Event) => pick((event.target as HTMLSelectElement).value)}>
        ${option('', t('rig.noDevice'))} ${value === 'as is' ? option('as is', driverOf(lines)) : ''}
        ${group(
          'rig.connected',
          found.map(foundOption).filter((_, i) => !isSimulated(found[i])),
        )}
        ${group(
          'rig.drivers',
          drivers.map(driverOption).filter((_, i) => !isSimulated(drivers[i])),
        )}
        ${group('rig.simulated', [
          ...found.map(foundOption).filter((_, i) => isSimulated(found[i])),
          ...drivers.map(driverOption).filter((_, i) => isSimulated(drivers[i])),
        ])}
      </select></label
    >
    ${
      shown?.modes.length
        ? html`<label class="field"
            ><span>${t('rig.mode')}</span
            ><select
              data-mode=${table}
              @change=${(event: Event) => change(shown.settings + (shown.modes[Number((event.target as HTMLSelectElement).value)]?.settings ?? ''))}
            >
              ${mode < 0 ? html`<option value="-1" selected>${t('rig.modeOwn')}</option>` : ''}
              ${shown.modes.map(({ name }, i) => html`<option value=${i} ?selected=${i === mode}>${name}</option>`)}
            </select></label
          >`
        : ''
    }
    ${lines ? deviceForm(lines, t(`table.${table}` as MessageKey), search?.drivers.find((one) => one.table === table && one.driver === driverOf(lines))?.choices ?? {}, change) : ''}
    ${
      table === 'fringes' && search?.drivers.some(({ identifies }) => identifies)
        ? html`<button
            class="btn small"
            id="identify"
            ?disabled=${app.occupied}
            @click=${() => app.command('identify-displays')}
          >
            ${t('rig.identify')}
          </button>`
        : ''
    }
  </div>`;
}

function choosing(app: App, draft: DeviceDraft): TemplateResult {
  const { search } = app.state;
  const use = () => {
    const devices = Object.fromEntries(Object.entries(draft).filter(([, lines]) => lines.trim()));
    void (async () => {
      const asked = !app.project.rig?.calibration || (await app.asking.confirm(t('rig.devicesAsk'), t('rig.use')));
      if (asked) await app.arranging.useDevices(devices);
    })();
  };
  const ready = draft.camera.trim() && draft.fringes.trim();
  return html`<p class="quiet">${search ? t('rig.chooseHint') : t('rig.searchFirst')}</p>
    <button
      class="btn wide ${search ? '' : 'primary'}"
      id="find-devices"
      ?disabled=${app.occupied}
      @click=${() => app.command('find-devices')}
    >
      ${icon('again')}${t(search ? 'rig.searchAgain' : 'rig.search')}
    </button>
    ${search && search.connected.length === 0 ? html`<p><span class="dot poor"></span>${t('rig.nothingFound')}</p>` : ''}
    ${search?.warnings.map((sentence) => html`<p><span class="dot poor"></span>${plain(sentence)}</p>`) ?? ''}
    ${search ? TABLES.map((table) => chooser(app, draft, table)) : ''}
    <div class="pair">
      <button
        class="btn"
        @click=${() => app.arranging.draftDevices(null)}
        ?disabled=${app.project.devices.length === 0}
      >
        ${t('rig.keep')}
      </button>
      <button
        class="btn ${search ? 'primary' : ''}"
        id="set-devices"
        ?disabled=${app.occupied || !search || !ready}
        @click=${use}
      >
        ${t('rig.use')}
      </button>
    </div>`;
}

/** The devices of the rig: listed and tested, or chosen among those that are connected. */
export function devices(app: App): RigStage {
  const { project } = app;
  const draft =
    app.arranging.deviceDraft ?? (project.devices.length === 0 && !project.scan_begun ? draftOf(app) : null);
  const faulty = project.devices.some((device) => device.fault);
  const answer = devicesAnswer(project);
  const due = Boolean(draft) || faulty || (!answer && !project.rig_adjustable && project.can_scan);
  const body = html` ${
    draft
      ? choosing(app, draft)
      : html`<div class="devices">
            ${project.devices.map(
              (device) =>
                html`<div class="device">
                  <span class="dot ${device.fault ? 'poor' : device.answer ? 'done' : ''}"></span>
                  <div>
                    <b>${t(`table.${device.table.split('-')[0]}` as MessageKey)}</b
                    ><span class="quiet"
                      >${isSimulated(device) && !device.name ? t('rig.isSimulated') : device.name || device.driver}</span
                    >
                    ${device.fault || device.answer ? html`<p class=${device.fault ? 'bad' : 'quiet'}>${plain(device.fault || device.answer)}</p>` : ''}
                  </div>
                </div>`,
            )}
          </div>
          <div class="pair">
            <button
              class="btn"
              id="choose-devices"
              ?disabled=${app.occupied || project.scan_begun}
              @click=${() => app.arranging.draftDevices(draftOf(app))}
            >
              ${t('rig.choose')}
            </button>
            <button
              class="btn ${due ? 'primary' : ''}"
              id="test-devices"
              ?disabled=${app.occupied || !project.can_scan}
              @click=${() => app.command('test-devices')}
            >
              ${t('rig.test')}
            </button>
          </div>`
  }`;
  return {
    name: 'devices',
    title: t('rig.devices'),
    summary: project.scan_begun
      ? t('live.fixed')
      : faulty
        ? t('rig.noAnswer')
        : answer
          ? t(answer === 'now' ? 'check.answer' : 'check.answered')
          : project.devices.length
            ? t('check.untested')
            : '',
    state: faulty ? 'bad' : answer ? 'done' : '',
    due,
    body,
  };
}
