import { html, svg, type TemplateResult } from 'lit';
import { encode } from 'uqr';
import type { Lan } from './session';
import type { Store } from './store';
import { t } from './messages';
import { choice } from './ui';

/** A QR code as one path of squares, with the quiet zone that readers need. */
function code(text: string): TemplateResult {
  const { data, size } = encode(text, { ecc: 'M', border: 3 });
  let path = '';
  data.forEach((row, y) => row.forEach((dark, x) => (path += dark ? `M${x} ${y}h1v1h-1z` : '')));
  return html`<svg
    class="qr"
    viewBox="0 0 ${size} ${size}"
    role="img"
    aria-label=${t('app.qr')}
    shape-rendering="crispEdges"
  >
    ${svg`<rect width=${size} height=${size} fill="#fff" /><path d=${path} fill="#000" />`}
  </svg>`;
}

/** A fingerprint in four parts of eight bytes, as people compare it. */
const inParts = (fingerprint: string): TemplateResult[] =>
  (fingerprint.match(/.{1,24}/g) ?? []).map((part) => html`<span>${part}</span>`);

/** Makes a link and shows it. */
export async function share(app: Store): Promise<void> {
  try {
    app.sharing = { ...app.sharing, link: await app.session.newLink(), lan: await app.session.lan() };
    app.requestUpdate();
    app.dialog('link').showModal();
  } catch (error) {
    app.say(error);
  }
}

async function change(app: Store, wanted?: { address: string; encrypted: boolean }): Promise<void> {
  try {
    app.sharing.lan = await app.session.changeLan(wanted);
  } catch (error) {
    app.dialog('link').close(); // it would hide the words
    app.say(error);
  }
  app.requestUpdate();
}

function tablets(app: Store, lan: Lan): TemplateResult {
  const letIn = (event: SubmitEvent) => {
    event.preventDefault();
    const chosen = new FormData(event.target as HTMLFormElement).get('address');
    void change(app, { address: String(chosen ?? lan.addresses[0]), encrypted: app.sharing.encrypted });
  };
  if (lan.open)
    return html`<div class="beside">
        ${code(lan.open.link)}
        <div>
          <p>${t('lan.scan')}</p>
          ${lan.open.fingerprint ? html`<p class="quiet">${t('lan.encryptedHint')}</p>` : ''}
          <dl class="figures" id="lan">
            <dt>${t('lan.address')}</dt>
            <dd class="num">${lan.open.url}</dd>
            <dt>${t('app.password')}</dt>
            <dd class="num">${lan.open.password}</dd>
          </dl>
          ${
            lan.open.fingerprint
              ? html`<div class="fingerprint">
                  <span class="quiet">${t('lan.fingerprint')}</span>
                  <code id="fingerprint">${inParts(lan.open.fingerprint)}</code>
                </div>`
              : ''
          }
        </div>
      </div>
      <button class="btn wide" id="close-lan" @click=${() => void change(app)}>${t('lan.close')}</button>`;
  const way = app.sharing.encrypted ? 'encrypted' : 'plain';
  if (lan.addresses.length === 0) return html`<p class="quiet">${t('lan.none')}</p>`;
  return html`<form class="form-plain" @submit=${letIn}>
    <p class="quiet">${t('lan.hint')}</p>
    ${
      lan.addresses.length > 1
        ? html`<label class="field"
            ><span>${t('lan.address')}</span
            ><select name="address">
              ${lan.addresses.map((address) => html`<option>${address}</option>`)}
            </select></label
          >`
        : ''
    }
    <div class="field">
      <span>${t('lan.way')}</span>
      ${choice(
        t('lan.way'),
        way,
        (['plain', 'encrypted'] as const).map((one) => [one, t(`lan.${one}`)] as const),
        (chosen) => {
          app.sharing.encrypted = chosen === 'encrypted';
          app.requestUpdate();
        },
      )}
      <p class="quiet note" id="way">${t(`lan.${way}Hint`)}</p>
    </div>
    <button class="btn wide" id="let-in">${t('lan.letIn')}</button>
  </form>`;
}

/** Whether a link leads to the machine on which it is opened. */
const isLocal = (link: string): boolean => /^http:\/\/(127\.|localhost|\[::1\])/.test(link);

/** Lets a tablet in, or one more browser by a link. A link to this machine itself has no code that a tablet could use. */
export function linkDialog(app: Store, close: TemplateResult): TemplateResult {
  const { link, lan } = app.sharing;
  return html`<dialog id="link" aria-label=${t('app.link')}>
    ${
      lan
        ? html`<h2>${t('lan.title')}</h2>
            ${tablets(app, lan)}`
        : ''
    }
    <h2>${t('app.link')}</h2>
    <p class="quiet">${t(isLocal(link) ? 'app.linkHint' : 'app.linkOnce')}</p>
    <div class="linkbox">${link}</div>
    ${link && !isLocal(link) ? code(link) : ''} ${close}
  </dialog>`;
}
