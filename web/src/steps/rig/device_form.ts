import { html, type TemplateResult } from 'lit';

import { isMessage, t } from '../../messages';
import { numeric } from '../../number_field';
import { numberOf, shownNumber } from '../../written_numbers';

type Value = string | number | boolean;
/** A line of the settings of a device; with a key where it is "key = value" with a plain value. */
interface Line {
  text: string;
  key?: string;
  value?: Value;
}

const PLAIN = /^\s*([A-Za-z_]\w*)\s*=\s*(?:"([^"\\]*)"|(true|false)|([-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?))\s*$/;
/** Units at the end of keys. */
const UNITS: Record<string, string> = {
  ms: 'ms',
  s: 's',
  mm: 'mm',
  deg: '°',
  px: 'px',
  db: 'dB',
  hz: 'Hz',
  counts: 'counts',
  um: 'µm',
  nm: 'nm',
  v: 'V',
};

export function linesOf(settings: string): Line[] {
  return settings.split('\n').map((text) => {
    const [, key, word, flag, digits] = PLAIN.exec(text) ?? [];
    if (!key) return { text };
    if (word !== undefined) return { text, key, value: word };
    return { text, key, value: flag === undefined ? Number(digits) : flag === 'true' };
  });
}

/** What a setting is called; one without a name by its key: "true_size_mm" as "true size, mm". */
export function labelOf(key: string): string {
  const named = `setting.${key}`;
  if (isMessage(named)) return t(named);
  const words = key.split('_');
  const unit = words.length > 1 ? UNITS[words.at(-1) as string] : undefined;
  return unit ? `${words.slice(0, -1).join(' ')}, ${unit}` : words.join(' ');
}

function field({ key, value }: Line, among: string[], change: (value: Value) => void): TemplateResult | string {
  if (key === undefined || value === undefined || key === 'driver') return '';
  if (among.length > 0)
    return html`<label class="field"
      ><span>${labelOf(key)}</span
      ><select data-setting=${key} @change=${(event: Event) => change((event.target as HTMLSelectElement).value)}>
        ${(among.includes(String(value)) ? among : [String(value), ...among]).map((one) => html`<option ?selected=${one === value}>${one}</option>`)}
      </select></label
    >`;
  if (typeof value === 'boolean')
    return html`<label class="switch"
      >${labelOf(key)}<input
        type="checkbox"
        data-setting=${key}
        .checked=${value}
        @change=${(event: Event) => change((event.target as HTMLInputElement).checked)}
    /></label>`;
  if (typeof value === 'number')
    return html`<label class="field"
      ><span>${labelOf(key)}</span
      ><input
        class="num"
        data-setting=${key}
        .value=${shownNumber(value)}
        ${numeric({})}
        @change=${(event: Event) => {
          const entered = numberOf(event.target as HTMLInputElement);
          if (entered !== null) change(entered);
        }}
    /></label>`;
  return html`<label class="field"
    ><span>${labelOf(key)}</span
    ><input
      data-setting=${key}
      maxlength="200"
      .value=${value}
      @change=${(event: Event) => change((event.target as HTMLInputElement).value.replace(/["\\]/g, ''))}
  /></label>`; // a quote or a backslash would end the text in the file
}

/** The settings of a device as a form; as text, too, for what has no field. */
export function deviceForm(
  settings: string,
  label: string,
  choices: Record<string, string[]>,
  change: (settings: string) => void,
): TemplateResult {
  // A setting with few values has a field also where it is not set: its default comes first.
  const unset = Object.entries(choices)
    .filter(([key]) => !new RegExp(`^\\s*${key}\\s*=`, 'm').test(settings))
    .map(([key, [value]]) => `${key} = "${value}"`);
  const lines = linesOf(settings.trimEnd());
  const missing = linesOf(unset.join('\n')).filter(({ key }) => key !== undefined);
  const set = (at: number, value: Value) =>
    change(lines.map(({ text, key }, i) => (i === at ? `${key} = ${JSON.stringify(value)}` : text)).join('\n') + '\n');
  const add = (line: Line, value: Value) => change(`${settings.trimEnd()}\n${line.key} = ${JSON.stringify(value)}\n`);
  return html`<div class="device-form">
      ${lines.map((line, i) => field(line, choices[line.key ?? ''] ?? [], (value) => set(i, value)))}
      ${missing.map((line) => field(line, choices[line.key ?? ''] ?? [], (value) => add(line, value)))}
    </div>
    <details>
      <summary>${t('rig.asText')}</summary>
      <textarea
        class="lines"
        rows=${Math.min(7, lines.length)}
        spellcheck="false"
        aria-label="${t('rig.settings')}: ${label}"
        .value=${settings}
        @change=${(event: Event) => change((event.target as HTMLTextAreaElement).value)}
      ></textarea>
    </details>`;
}
