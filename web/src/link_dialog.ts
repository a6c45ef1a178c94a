import { html, svg, type TemplateResult } from 'lit';
import { encode } from 'uqr';
import type { App } from './app';
import { t } from './messages';

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

/** Makes a link and shows it. */
export async function share(app: App): Promise<void> {
  try {
    app.link = await app.session.newLink();
    app.requestUpdate();
    app.dialog('link').showModal();
  } catch (error) {
    app.say(error);
  }
}

/** A link for one more browser, to be clicked, copied or scanned. */
export function linkDialog(link: string, close: TemplateResult): TemplateResult {
  return html`<dialog id="link" aria-label=${t('app.link')}>
    <h2>${t('app.link')}</h2>
    <p class="quiet">${t('app.linkHint')}</p>
    <div class="linkbox">${link}</div>
    ${link ? code(link) : ''} ${close}
  </dialog>`;
}
