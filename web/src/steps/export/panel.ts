import { html, type TemplateResult } from 'lit';
import { type Encoding, exportArguments, FORMATS, type Limit, LIMITS, type Variant } from '../../exporting';
import type { App } from '../../parts';
import { icon } from '../../icons';
import { number, t } from '../../messages';
import type { ExportedFile } from '../../types';
import { bytes, choice } from '../../ui';
import { words } from './words';

/** A file that was exported, with the button that brings it to this machine. */
const written = (app: App, file: ExportedFile, next = false): TemplateResult =>
  html`<div class="file">
    <b>${file.name}</b
    ><span class="num quiet"
      >${bytes(file.bytes, number)}${file.revision === null ? '' : html`<br />${words('export.of', { version: file.version ?? 0, revision: number(file.revision) })}`}</span
    >
    <button
      class="btn ${next ? 'primary' : 'small'}"
      @click=${() => app.exporting.download(file.name)}
      aria-label="${words('export.download')} ${file.name}"
    >
      ${icon('download')}${next ? words('export.download') : ''}
    </button>
  </div>`;

export function exportStep(app: App): TemplateResult {
  const { project } = app;
  const { choice: exporting, estimate } = app.exporting;
  if (!project.surface) return html`<section class="group"><p class="quiet">${t('surface.none')}</p></section>`;
  const format = exporting.format;
  const start = () => app.command('export', exportArguments(exporting));
  const newest = project.exports.find(({ name }) => name === `${project.name}.${format}`);
  // What is written of the surface as it is wants to be fetched next.
  const ready =
    newest !== undefined && newest.revision === project.revision && newest.version === project.current_version;
  return html`<section class="group">
      <h2>${words('export.format')}</h2>
      <div class="formats" role="radiogroup" aria-label=${words('export.format')}>
        ${FORMATS.map(
          (one) =>
            html`<label
              ><input
                type="radio"
                name="format"
                .checked=${one === format}
                @change=${() => app.exporting.choose({ format: one })}
              /><b>${one.toUpperCase()}</b><span>${words(`export.${one}`)}</span></label
            >`,
        )}
      </div>
      ${
        format === 'dxf'
          ? html`<h2>${words('export.variant')}</h2>
              ${choice<Variant>(
                words('export.variant'),
                exporting.variant,
                [
                  ['faces', words('export.faces')],
                  ['polyface', words('export.polyface')],
                  ['mesh', words('export.mesh')],
                ],
                (variant) => app.exporting.choose({ variant }),
              )}`
          : ''
      }
      ${
        format === 'stl'
          ? html`<h2>${words('export.encoding')}</h2>
              ${choice<Encoding>(
                words('export.encoding'),
                exporting.encoding,
                [
                  ['binary', words('export.binary')],
                  ['ascii', words('export.ascii')],
                ],
                (encoding) => app.exporting.choose({ encoding }),
              )}`
          : ''
      }
      <h2>${words('export.limit')}<small>${words('export.triangles')}</small></h2>
      ${choice<Limit>(
        words('export.limit'),
        exporting.limit,
        LIMITS.map(
          (limit) =>
            [
              limit,
              limit === '0' ? words('export.all') : html`<span class="num">${number(Number(limit))}</span>`,
            ] as const,
        ),
        (limit) => app.exporting.choose({ limit }),
      )}
    </section>
    <section class="group">
      <h2>${words('export.more')}</h2>
      <div class="pair">
        <button
          class="btn"
          id="zip"
          ?disabled=${app.occupied || app.session.watches || !project.scan_complete}
          @click=${() => app.command('export', { format: 'zip' })}
        >
          ${words('export.zip')}
        </button>
        <button class="btn" id="picture" @click=${() => app.exporting.pictureFile()}>${words('export.picture')}</button>
      </div>
    </section>
    <section class="group">
      <h2>${words('export.files')}</h2>
      ${project.exports.length === 0 ? html`<p class="quiet">${words('export.none')}</p>` : ''}
      <div>${project.exports.map((file) => written(app, file))}</div>
    </section>
    <section class="group next-step">
      <p class="quiet num" id="estimate">
        ${estimate ? words('export.about', { size: bytes(estimate.bytes, number), triangles: number(estimate.triangles) }) : html`&nbsp;`}
      </p>
      <button
        class="btn ${ready ? '' : 'primary'} wide"
        id="export"
        ?disabled=${app.busy || app.session.watches}
        @click=${start}
      >
        ${words('export.write', { format: format.toUpperCase() })}
      </button>
      ${newest ? written(app, newest, ready) : ''}
    </section>`;
}
