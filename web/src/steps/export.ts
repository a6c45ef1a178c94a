import { html, type TemplateResult } from 'lit';
import type { App } from '../app';
import { icon } from '../icons';
import { number, t } from '../messages';
import type { ExportedFile } from '../types';
import { bytes, choice } from '../ui';

const FORMATS = ['dxf', 'stl', 'ply', 'obj', 'glb', '3mf'] as const;
export type Format = (typeof FORMATS)[number];
export type Variant = 'faces' | 'polyface' | 'mesh';
/** AutoCAD slows down beyond this; `frangia reconstruct` keeps to it as well. */
const LIMITS = ['200000', '50000', '0'] as const;
export type Limit = (typeof LIMITS)[number];

export type Encoding = 'binary' | 'ascii';
export interface ExportChoice {
  format: Format;
  variant: Variant;
  encoding: Encoding;
  limit: Limit;
}

/** What the commands `export` and `estimate-export` take. */
export const exportArguments = (exporting: ExportChoice): object => ({
  format: exporting.format,
  ...(exporting.format === 'dxf' ? { dxf: exporting.variant } : {}),
  ...(exporting.format === 'stl' ? { stl: exporting.encoding } : {}),
  ...(exporting.limit === '0' ? {} : { triangles: Number(exporting.limit) }),
});

/** A file that was exported, with the button that brings it to this machine. */
const written = (app: App, file: ExportedFile, next = false): TemplateResult =>
  html`<div class="file">
    <b>${file.name}</b
    ><span class="num quiet"
      >${bytes(file.bytes, number)}${file.revision === null ? '' : html`<br />${t('export.of', { version: file.version ?? 0, revision: number(file.revision) })}`}</span
    >
    <button
      class="btn ${next ? 'primary' : 'small'}"
      @click=${() => app.exporting.download(file.name)}
      aria-label="${t('export.download')} ${file.name}"
    >
      ${icon('download')}${next ? t('export.download') : ''}
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
      <h2>${t('export.format')}</h2>
      <div class="formats" role="radiogroup" aria-label=${t('export.format')}>
        ${FORMATS.map(
          (one) =>
            html`<label
              ><input
                type="radio"
                name="format"
                .checked=${one === format}
                @change=${() => app.exporting.choose({ format: one })}
              /><b>${one.toUpperCase()}</b><span>${t(`export.${one}`)}</span></label
            >`,
        )}
      </div>
      ${
        format === 'dxf'
          ? html`<h2>${t('export.variant')}</h2>
              ${choice<Variant>(
                t('export.variant'),
                exporting.variant,
                [
                  ['faces', t('export.faces')],
                  ['polyface', t('export.polyface')],
                  ['mesh', t('export.mesh')],
                ],
                (variant) => app.exporting.choose({ variant }),
              )}`
          : ''
      }
      ${
        format === 'stl'
          ? html`<h2>${t('export.encoding')}</h2>
              ${choice<Encoding>(
                t('export.encoding'),
                exporting.encoding,
                [
                  ['binary', t('export.binary')],
                  ['ascii', t('export.ascii')],
                ],
                (encoding) => app.exporting.choose({ encoding }),
              )}`
          : ''
      }
      <h2>${t('export.limit')}<small>${t('export.triangles')}</small></h2>
      ${choice<Limit>(
        t('export.limit'),
        exporting.limit,
        LIMITS.map(
          (limit) =>
            [limit, limit === '0' ? t('export.all') : html`<span class="num">${number(Number(limit))}</span>`] as const,
        ),
        (limit) => app.exporting.choose({ limit }),
      )}
    </section>
    <section class="group">
      <h2>${t('export.more')}</h2>
      <div class="pair">
        <button
          class="btn"
          id="zip"
          ?disabled=${app.occupied || app.session.watches || !project.scan_complete}
          @click=${() => app.command('export', { format: 'zip' })}
        >
          ${t('export.zip')}
        </button>
        <button class="btn" id="picture" @click=${() => app.exporting.pictureFile()}>${t('export.picture')}</button>
      </div>
    </section>
    <section class="group">
      <h2>${t('export.files')}</h2>
      ${project.exports.length === 0 ? html`<p class="quiet">${t('export.none')}</p>` : ''}
      <div>${project.exports.map((file) => written(app, file))}</div>
    </section>
    <section class="group next-step">
      <p class="quiet num" id="estimate">
        ${estimate ? t('export.about', { size: bytes(estimate.bytes, number), triangles: number(estimate.triangles) }) : html`&nbsp;`}
      </p>
      <button
        class="btn ${ready ? '' : 'primary'} wide"
        id="export"
        ?disabled=${app.busy || app.session.watches}
        @click=${start}
      >
        ${t('export.write', { format: format.toUpperCase() })}
      </button>
      ${newest ? written(app, newest, ready) : ''}
    </section>`;
}
