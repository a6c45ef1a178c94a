import { html, type TemplateResult } from 'lit';
import type { App } from '../../parts';
import { joinedSetups } from '../../legend';
import type { Coloring } from '../../mesh_colors';
import { number, t } from '../../messages';
import { term } from '../../terms';
import { choice, nextStep, plain, repairButton } from '../../ui';
import { findings } from './findings';
import { joins } from '../scan/setups';
import { versions } from './versions';
import type { Summary, Surface } from '../../types';
import type { Shading } from '../../viewer';

const um = (value: number | null): TemplateResult =>
  value === null ? html`<dd class="num">·</dd>` : html`<dd class="num">${number(1000 * value, 1)}<span>µm</span></dd>`;

/** What the registration found: in the words of the page, or in those of the library where it knows more. */
function registrationWords(summary: Summary): string {
  const { turntable, rms_after_mm: rms } = summary;
  const more = plain(summary.registration ?? '');
  if (!turntable || rms == null || !turntable.plain) return more.charAt(0).toUpperCase() + more.slice(1);
  const agree = t('surface.agree', { rms: number(1000 * rms, 1), overlap: number(100 * turntable.overlap) });
  const axis = turntable.kept
    ? t('surface.axisKept')
    : t('surface.axisMoved', {
        moved: number(turntable.moved_mm, 3),
        turned: number(turntable.turned_deg, 3),
        angles: number(turntable.angles_deg, 3),
      });
  const { closure_deg: closure } = turntable;
  const closes = closure === null || turntable.kept ? '' : ` ${t('surface.closes', { angle: number(closure, 4) })}`;
  return `${agree} ${axis}${closes}`;
}

export function appearance(app: App): TemplateResult {
  const { look, viewer } = app;
  return html`<section class="group">
    <h2>${t('surface.shading')}</h2>
    ${choice<Shading>(
      t('surface.shading'),
      look.shading,
      [
        ['smooth', t('surface.smooth')],
        ['flat', t('surface.flat')],
        ['wire', t('surface.wire')],
      ],
      (shading) => app.setLook({ shading }),
    )}
    ${viewer.wiresCoarsely ? html`<p class="quiet">${t('surface.wiresOf', { shown: number(viewer.trianglesShown), count: number(app.project.surface?.triangles ?? 0) })}</p>` : ''}
    <h2><span>${t('surface.color')}${term('mark')}</span></h2>
    ${choice<Coloring>(
      t('surface.color'),
      look.coloring,
      [
        ['plain', t('surface.plain')],
        ['sigma', t('surface.sigma')],
        ['views', t('surface.views')],
        ['marks', t('surface.marks')],
        ...(joinedSetups(app).length > 0 ? ([['setup', t('surface.setup')]] as const) : []),
        ...(app.project.surface?.comparison ? ([['deviation', t('surface.deviation')]] as const) : []),
      ],
      (coloring) => app.setLook({ coloring }),
    )}
  </section>`;
}

/** The surface is not in memory: it is being read, its reading was stopped, or there is none. */
function absent(app: App): TemplateResult {
  const { surface_loading: loading, versions: all, current_version: current } = app.project;
  if (loading || all.length === 0)
    return html`<section class="group">
      <p class="quiet">${t(loading ? 'surface.loading' : 'surface.none')}</p>
    </section>`;
  return html`<section class="group">
      <p class="quiet">${t('surface.unread')}</p>
      <button
        class="btn wide"
        id="read"
        ?disabled=${app.busy || app.session.watches}
        @click=${() => app.command('open-version', { version: current })}
      >
        ${t('surface.read')}
      </button>
    </section>
    ${versions(app)}`;
}

/** The figures that explain the first ones. */
function details(app: App, surface: Surface): TemplateResult {
  const { summary } = surface;
  return html`<details class="more" id="details">
    <summary>${t('surface.details')}</summary>
    <dl class="figures">
      ${
        surface.sigma_mm.systematic === null
          ? ''
          : html`<dt>${t('surface.noise')}${term('noise')}</dt>
              ${um(surface.sigma_mm.noise)}
              <dt>${t('surface.systematic')}${term('systematic')}</dt>
              ${um(surface.sigma_mm.systematic)}`
      }
      <dt>${t('surface.triangles')}</dt>
      <dd class="num">${number(surface.triangles)}</dd>
      ${
        summary
          ? html`<dt>${t('surface.points')}</dt>
              <dd class="num">${number(summary.points)}</dd>
              <dt>${t('surface.viewsFused')}${term('view')}</dt>
              <dd class="num">${number(summary.views)}</dd>`
          : ''
      }
      <dt>${t('surface.parts')}</dt>
      <dd class="num">${number(surface.components)}</dd>
      <dt>${t('surface.revision')}</dt>
      <dd class="num">${number(app.project.revision)}</dd>
    </dl>
    ${summary?.registration ? html`<p class="quiet">${registrationWords(summary)}</p>` : ''}
  </details>`;
}

/** Builds the surface again: as fine, as small and as closed as is wanted. */
function building(app: App): TemplateResult | string {
  if (!app.project.scan_complete) return '';
  return html`<section class="group" id="build-again">
    <form class="form-plain" novalidate @submit=${app.building.submit}>
      ${app.building.fields()}
      <button class="btn wide" ?disabled=${app.busy || app.session.watches}>${t('surface.build')}</button>
    </form>
  </section>`;
}

export function surfaceStep(app: App): TemplateResult {
  const { surface } = app.project;
  if (!surface) return absent(app);
  const { size } = app.viewer;
  return html`${findings(app)}
    ${surface.triangles === 0 ? html`<section class="group"><p class="quiet" id="cloud">${t('surface.cloud')}</p></section>` : ''}
    <section class="group">
      <h2>${t('surface.figures')}</h2>
      <dl class="figures">
        <dt>${t('surface.sigmaMedian')}${term('sigma')}</dt>
        ${um(surface.sigma_mm.combined)}
        <dt>${t('surface.size')}</dt>
        <dd class="num">${number(size.x, 1)} × ${number(size.y, 1)} × ${number(size.z, 1)}<span>mm</span></dd>
        <dt>${t('surface.holes')}</dt>
        <dd class="num">${number(surface.hole_count)}</dd>
      </dl>
      ${surface.hole_count > 0 ? repairButton(app) : ''} ${details(app, surface)}
    </section>
    ${app.measuring.panel()} ${appearance(app)}
    <section class="group" id="section">
      <h2>${t('section.title')}</h2>
      ${app.sectioning.panel()}
    </section>
    ${joins(app)} ${building(app)} ${versions(app)} ${nextStep(app, 'edit')}`;
}
