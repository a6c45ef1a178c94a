import type { App } from './app';
import { ON_SURFACE, type StepName, STEPS } from './app_steps';
import type { IconName } from './icons';
import type { MessageKey } from './messages';
import { toggleTheme } from './preferences';
import { reachable } from './step_state';
import { VIEWS } from './view_tools';

export const KEYS: readonly (readonly [MessageKey | IconName, string])[] = [
  ['keys.steps', '1 – 8'],
  ['app.frame', 'F'],
  ['app.views', 'Shift 1 – 7'],
  ['rig.poseKey', 'Enter'],
  ['edit.brush', 'B'],
  ['edit.lasso', 'L'],
  ['edit.rectangle', 'R'],
  ['edit.part', 'P'],
  ['measure.distance', 'M'],
  ['measure.angle', 'A'],
  ['section.axes', 'X Y Z'],
  ['section.move', '+ −'],
  ['edit.delete', 'Del'],
  ['edit.invert', 'I'],
  ['edit.undo', 'Ctrl Z'],
  ['edit.redo', 'Ctrl Shift Z'],
  ['keys.deselect', 'Esc'],
  ['app.theme', 'D'],
  ['app.keys', '?'],
];

/** Keyboard shortcuts of the window; the sheet `keys` lists them. */
export function onKey(app: App, event: KeyboardEvent): void {
  const target = event.target as HTMLElement;
  if (target.matches('input:not([type=radio]):not([type=checkbox]):not([type=range]), select, textarea')) return;
  if (!app.session.state || document.querySelector('dialog[open]')) return;
  const surface = app.state.project?.surface;
  const key = event.key.toLowerCase();
  if (event.ctrlKey || event.metaKey) {
    if (key !== 'z' || !surface) return;
    event.preventDefault();
    return void app.command(event.shiftKey ? 'redo' : 'undo');
  }
  if (event.altKey) return;
  const view = event.shiftKey && /^Digit[1-7]$/.test(event.code) ? VIEWS[Number(event.code.slice(5)) - 1] : undefined;
  if (view) {
    const [x, y, z] = view[1];
    return app.viewer.frame([x, y, z]);
  }
  if (/^[1-8]$/.test(key)) {
    const step = STEPS[Number(key) - 1] as StepName;
    if (reachable(app.state.project, step)) app.go(step);
  } else if (key === '?') app.dialog('keys').showModal();
  else if (key === 'd') toggleTheme();
  else if (key === 'f') app.viewer.frame();
  else if (key === 'escape' && app.step === 'edit' && surface?.preview) void app.command('drop-preview');
  else if (
    key === 'enter' &&
    app.step === 'edit' &&
    document.querySelector('#apply:not([disabled])') &&
    !target.matches('button, summary')
  )
    app.editing.applyPreview();
  else if (key === 'escape' && app.viewer.tool === 'measure' && app.measuring.cancel()) return;
  else if (key === 'escape') app.setTool('orbit');
  else if (
    key === 'enter' &&
    app.step === 'rig' &&
    app.state.project?.calibration?.waiting &&
    !target.matches('button, summary')
  )
    void app.command('capture-pose');
  else if (!surface) return;
  else if (key === 'm') app.measuring.begin('distance');
  else if (key === 'a') app.measuring.begin('angle');
  else if (ON_SURFACE.has(app.step) && (key === 'x' || key === 'y' || key === 'z')) app.sectioning.toggle(key);
  else if (key === '+' || key === '=') app.sectioning.move(1);
  else if (key === '-') app.sectioning.move(-1);
  else if (app.step !== 'edit') return;
  else if (key === 'l') app.setTool('lasso');
  else if (key === 'b') app.setTool('brush');
  else if (key === 'r') app.setTool('rectangle');
  else if (key === 'p') app.setTool('part');
  else if (key === 'i') app.editing.run('invert');
  else if ((key === 'delete' || key === 'backspace') && surface.selected) app.editing.run('delete');
}
