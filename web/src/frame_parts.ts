import { html, nothing, type TemplateResult } from 'lit';

import type { App } from './parts';
import { STEPS, stepNamed } from './all_steps';
import { icon, type IconName, logo } from './icons';
import { shortcuts } from './keyboard';
import { linkDialog, share } from './link_dialog';
import { currentLanguage, type Language, LANGUAGES, type MessageKey, stageName, t } from './messages';
import { toggleTheme } from './preferences';
import { stepWords } from './step_words';
import type { Job, Step } from './types';
import { plain, quoted, span } from './ui';
import { viewOverlay } from './view_tools';

/** Undo and redo, named by what they take back or do again. */
function history(app: App): TemplateResult | string {
  const surface = app.state.project?.surface;
  if (!surface || surface.steps.length === 0) return '';
  const button = (name: 'undo' | 'redo', step: Step | undefined) => {
    const words = step ? `${t(`edit.${name}`)}: ${stepWords(step)}` : t(`edit.${name}`);
    return html`<button
      class="icon-btn"
      data-history=${name}
      title=${words}
      aria-label=${words}
      ?disabled=${!step || app.session.watches}
      @click=${() => app.command(name)}
    >
      ${icon(name)}
    </button>`;
  };
  return html`${button('undo', surface.steps[surface.steps_done - 1])}
  ${button('redo', surface.steps[surface.steps_done])}`;
}

/** What a job may still take, by the share that it has done; empty while that says nothing. */
function timeLeft({ kind, progress, seconds }: Job): string {
  if (kind === 'live' || progress < 0.04 || progress >= 1 || seconds < 1.5) return '';
  return ` · ${t('scan.left', { time: span((seconds * (1 - progress)) / progress) })}`;
}

/** The steps from left to right. */
export function header(app: App): TemplateResult {
  const tool = (name: IconName, key: MessageKey, act: () => void) =>
    html`<button class="icon-btn" data-tool=${name} title=${t(key)} aria-label=${t(key)} @click=${act}>
      ${icon(name)}
    </button>`;
  return html`<header class="top">
    <div class="brand">
      ${logo}<b>Frangia</b>${app.state.project ? html`<span class="project">${app.project.name}</span>` : ''}
    </div>
    <nav class="steps" aria-label=${t('steps')}>
      ${STEPS.map(
        ({ name, title, finished, reachable }, i) =>
          html`<button
            class=${finished(app.state.project) ? 'done' : ''}
            ?disabled=${!reachable(app.state.project)}
            aria-current=${name === app.step ? 'step' : nothing}
            data-step=${name}
            @click=${() => app.go(name)}
          >
            <i>${i + 1}</i>${title()}
          </button>`,
      )}
    </nav>
    <div class="tools">
      ${history(app)}
      <select
        id="language"
        class="icon-btn text"
        aria-label=${t('app.language')}
        @change=${(event: Event) => app.changeLanguage((event.target as HTMLSelectElement).value as Language)}
      >
        ${LANGUAGES.map(([key, name]) => html`<option value=${key} lang=${key} ?selected=${key === currentLanguage()}>${name}</option>`)}
      </select>
      ${tool('theme', 'app.theme', toggleTheme)} ${tool('link', 'app.link', () => void share(app))}
      ${tool('keys', 'app.keys', () => app.dialog('keys').showModal())}
    </div>
  </header>`;
}

/** What runs, and the command line that does the same. */
export function footer(app: App): TemplateResult {
  const job = app.state.jobs.find((one) => one.state === 'running');
  const words = stepNamed(app.step).commandLine(app.state.project?.commands ?? {});
  const line = words?.map(quoted).join(' ') ?? '';
  const last = app.state.jobs.at(-1);
  const report = last?.log.at(-1);
  const said = report ? plain(report.sentence) : t('job.idle');
  const copy = async () => {
    await navigator.clipboard.writeText(line);
    app.copied = true;
    app.requestUpdate();
    setTimeout(() => {
      app.copied = false;
      app.requestUpdate();
    }, 1500);
  };
  return html`<footer class="foot">
    <div class="job" role="status">
      ${
        job
          ? html`<svg class="bar" aria-hidden="true"><rect width="${100 * job.progress}%" height="4" /></svg>
              <span
                >${t(`job.${job.kind}`)}${job.stage && job.kind !== 'live' ? ` · ${stageName(job.stage)}` : ''}${timeLeft(job)}</span
              >
              <button
                class="btn small"
                ?disabled=${app.session.watches}
                @click=${() => app.command('stop-job', { job: job.number })}
              >
                ${t('job.stop')}
              </button>`
          : html`<span>${said}</span>`
      }
    </div>
    ${
      line
        ? html`<div class="command" title=${t('command.same')}>
            <code><b>$</b> ${line}</code>
            <button
              class="icon-btn"
              aria-label="${t('command.copy')}: ${t('command.same')}"
              title=${app.copied ? t('command.copied') : t('command.copy')}
              @click=${copy}
            >
              ${icon(app.copied ? 'check' : 'copy')}
            </button>
          </div>`
        : ''
    }
  </footer>`;
}

/** The scene or the camera, and what floats on it. */
export function picture(app: App): TemplateResult {
  const { viewer } = app;
  viewer.canvas.setAttribute('role', 'application');
  viewer.canvas.setAttribute('aria-label', t('app.viewKeys'));
  return html`<div
    class="stage ${app.showsCamera || app.showsResiduals ? 'with-camera' : ''}"
    role="region"
    aria-label=${t('app.view')}
  >
    ${viewer.supported ? app.host : app.showsCamera || app.showsResiduals ? '' : html`<div class="blank"><p>${t('app.noWebGL')}</p></div>`}
    ${app.showsCamera ? html`<div class="camera ${app.step === 'live' && app.live.frozen_s !== null ? 'frozen' : ''}">${app.live.view.canvas}</div>` : ''}
    ${stepNamed(app.step).overlay?.(app) ?? ''} ${viewOverlay(app)}
  </div>`;
}

/** The sheet of shortcuts and the link for another browser. */
export function dialogs(app: App): TemplateResult {
  const close = (id: string) =>
    html`<button class="icon-btn close" aria-label=${t('app.close')} @click=${() => app.dialog(id).close()}>
      ${icon('close')}
    </button>`;
  return html`<dialog id="keys" aria-label=${t('app.keys')}>
      <h2>${t('app.keys')}</h2>
      <div class="keys">
        ${shortcuts().map(([key, keys]) => html`<span>${t(key)}</span><span>${keys.split(' ').map((one) => (one === '–' ? ' – ' : html`<kbd>${one}</kbd>`))}</span>`)}
      </div>
      ${close('keys')}
    </dialog>
    ${linkDialog(app, close('link'))} ${app.asking.dialog()}`;
}
