import { STEPS, stepNamed } from './all_steps';
import type { MessageKey } from './messages';
import type { App } from './parts';
import { toggleTheme } from './preferences';
import { toggleParallel, VIEWS } from './view_tools';

type Shortcut = readonly [MessageKey, string];

/** The keys of the window and of its steps, for the sheet of shortcuts. */
export const shortcuts = (): readonly Shortcut[] => [
  ['keys.steps', `1 – ${STEPS.length}`],
  ['app.frame', 'F'],
  ['app.views', 'Shift 1 – 7'],
  ['app.parallel', 'O'],
  ['keys.turn', '← ↑ → ↓'],
  ['keys.pan', 'Shift ← ↑ → ↓'],
  ['keys.zoom', 'PgUp PgDn'],
  ['keys.use', 'Enter'],
  ...STEPS.flatMap((step) => step.shortcuts ?? []),
  ['measure.distance', 'M'],
  ['measure.angle', 'A'],
  ['section.axes', 'X Y Z'],
  ['section.move', '+ −'],
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
  const step = /^[1-9]$/.test(key) ? STEPS[Number(key) - 1] : undefined;
  if (step) {
    if (app.canOpen(step.name)) app.go(step.name);
  } else if (key === '?') app.dialog('keys').showModal();
  else if (key === 'd') toggleTheme();
  else if (key === 'f') app.viewer.frame();
  else if (key === 'o' && app.viewer.supported) toggleParallel(app);
  else if (stepNamed(app.step).keys?.(app, key, event)) return;
  else if (key === 'escape' && app.viewer.tool === 'measure' && app.measuring.cancel()) return;
  else if (key === 'escape') app.setTool('orbit');
  else if (!surface) return;
  else if (key === 'm') app.measuring.begin('distance');
  else if (key === 'a') app.measuring.begin('angle');
  else if (app.onSurface && (key === 'x' || key === 'y' || key === 'z')) app.sectioning.toggle(key);
  else if (key === '+' || key === '=') app.sectioning.move(1);
  else if (key === '-') app.sectioning.move(-1);
}
