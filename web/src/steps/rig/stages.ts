import { html, type TemplateResult } from 'lit';
import type { StageName } from '../../arranging';
import type { App } from '../../parts';

/** A stage on the way from an unpacked rig to one that scans. */
export interface RigStage {
  name: StageName;
  title: string;
  /** How it stands, in a few words beside the title. */
  summary: string;
  state: '' | 'done' | 'poor' | 'bad';
  /** Whether the next scan waits for it. */
  due: boolean;
  body: TemplateResult;
}

/** The stages as cards, of which the next one is open and the others are one line each. */
export function rigStages(app: App, stages: readonly RigStage[]): TemplateResult {
  const due = stages.find((stage) => stage.due)?.name;
  const newest = stages.filter(({ name }) => name === app.arranging.newest).at(-1)?.name;
  const open = due ?? newest ?? 'devices';
  return html`${stages.map((stage) => {
    const shown = app.arranging.isOpen(stage.name, open);
    return html`<details class="group stage-card" id=${stage.name} data-due=${stage.name === due} ?open=${shown}>
      <summary
        data-stage=${stage.name}
        @click=${(event: Event) => {
          event.preventDefault();
          app.arranging.toggle(stage.name, open);
        }}
      >
        <span class="dot ${stage.state}"></span>
        <h2>${stage.title}</h2>
        <span class="quiet num">${stage.summary}</span>
      </summary>
      <div class="stage-body">${stage.body}</div>
    </details>`;
  })}`;
}
