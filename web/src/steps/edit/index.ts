import { t } from '../../messages';
import type { App } from '../../parts';
import { onButton, type Step } from '../../step';
import { editStep } from './panel';

const TOOLS = { l: 'lasso', b: 'brush', r: 'rectangle', p: 'part', k: 'like' } as const;

function keys(app: App, key: string, event: KeyboardEvent): boolean {
  const surface = app.state.project?.surface;
  if (key === 'escape' && surface?.preview) void app.command('drop-preview');
  else if (key === 'enter' && document.querySelector('#apply:not([disabled])') && !onButton(event))
    app.editing.applyPreview();
  else if (!surface) return false;
  else if (key in TOOLS) app.setTool(TOOLS[key as keyof typeof TOOLS]);
  else if (key === '[' || key === ']') app.editing.growBrush(key === ']');
  else if (key === 'i') app.editing.run('invert');
  else if ((key === 'delete' || key === 'backspace') && surface.selected) app.editing.run('delete');
  else return false;
  return true;
}

export const step: Step = {
  name: 'edit',
  title: () => t('step.edit'),
  onSurface: true,
  acts: true,
  reachable: (project) => Boolean(project?.surface),
  finished: (project) => (project?.surface?.steps_done ?? 0) > 0,
  commandLine: ({ edit }) => edit,
  panel: editStep,
  keys,
  shortcuts: [
    ['edit.brush', 'B'],
    ['edit.lasso', 'L'],
    ['edit.rectangle', 'R'],
    ['edit.part', 'P'],
    ['edit.like', 'K'],
    ['edit.brushSize', '[ ]'],
    ['edit.delete', 'Del'],
    ['edit.invert', 'I'],
  ],
};
