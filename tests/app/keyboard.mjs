// The app by keyboard alone: no pointer is ever moved. In every step the Tab key reaches all that a pointer can press, and
// shows where it is; a part is scanned, looked at from all sides, measured, cut, edited and exported; dialogs and menus hold
// the focus and give it back.
//
//   node keyboard.mjs PROGRAM FOLDER      FOLDER receives the screenshots
import fs from 'node:fs';
import path from 'node:path';
import { coarsenCamera, expect, fail, idle as allDone, launch, look as lookAt, newHome, openPage, passed, reopen, requireChromium, settled, startServer, stateOf, tell, waitForProject } from './harness.mjs';

const [program, shots] = process.argv.slice(2).map((name) => path.resolve(name));
requireChromium();
fs.mkdirSync(shots, { recursive: true });
const home = newHome();
const MOST_TABS = 200;

/** In the page: what has the focus, and where it shows that. */
function focused() {
  const one = document.activeElement;
  if (!one || one === document.body) return null;
  window.tabStops ??= [];
  let stop = window.tabStops.indexOf(one);
  if (stop < 0) stop = window.tabStops.push(one) - 1;
  const drawn = (element) => {
    const { outlineStyle, outlineWidth } = getComputedStyle(element);
    return outlineStyle !== 'none' && parseFloat(outlineWidth) > 0;
  };
  const shows = [one, one.closest('label'), one.closest('.field')].some((element) => element && drawn(element));
  const { left, right, top, bottom } = (one.matches('.sr, .seg input, .choose input') ? (one.closest('label') ?? one) : one).getBoundingClientRect();
  const inSight = left < innerWidth && right > 0 && top < innerHeight && bottom > 0;
  return { stop, shows, inSight, what: `${one.tagName.toLowerCase()}${one.id ? `#${one.id}` : ''} ${(one.getAttribute('aria-label') ?? one.textContent ?? '').trim().slice(0, 30)} ${one.getAttribute('name') ?? ''}` };
}

/** In the page: what a pointer can use and the Tab key has not reached, within a dialog where one is open. */
function unreached() {
  const stops = new Set(window.tabStops ?? []);
  const root = document.querySelector('dialog[open]') ?? document.querySelector('frangia-app');
  const shown = (element) => {
    const { width, height } = element.getBoundingClientRect();
    return width > 0 && height > 0 && element.checkVisibility({ checkVisibilityCSS: true, contentVisibilityAuto: true });
  };
  const controls = [...root.querySelectorAll('a[href], button, input, select, textarea, summary, .view-canvas')].filter((one) => !one.matches(':disabled') && shown(one));
  // One radio button of a group has the focus, the arrow keys lead to the others.
  const groups = new Set([...stops].filter((one) => one.type === 'radio').map((one) => one.name));
  const missed = controls.filter((one) => !stops.has(one) && !(one.type === 'radio' && groups.has(one.name)));
  // What invites a click although it is no control; the buttons of the views do what the cube does.
  const inviting = [...root.querySelectorAll('*')].filter((one) => {
    if (getComputedStyle(one).cursor !== 'pointer' || !shown(one) || one.closest('.cube')) return false;
    return !one.closest('button, label, summary, select, a, input, option');
  });
  window.tabStops = [];
  return [...missed, ...inviting].map((one) => `${one.tagName.toLowerCase()}${one.id ? `#${one.id}` : ''}.${one.className} "${(one.getAttribute('aria-label') ?? one.textContent ?? '').trim().slice(0, 30)}"`);
}

await tell(home, async () => {
  const server = await startServer(program, home);
  const browser = await launch();
  const page = await openPage(browser, server.url, { width: 1366, height: 768 });
  const look = (name) => lookAt(page, shots, `keyboard-${name}`);
  const idle = () => allDone(page);
  const press = async (...keys) => {
    for (const key of keys) await page.keyboard.press(key);
  };
  /** Presses Tab until something has the focus. */
  const tabTo = async (selector, key = 'Tab') => {
    for (let i = 0; i < MOST_TABS; i++) {
      if (await page.evaluate((selector) => document.activeElement?.matches(selector) ?? false, selector)) return;
      await press(key);
    }
    expect(false, `${key} does not reach ${selector}`);
  };
  const has = (selector) => page.evaluate((selector) => document.activeElement?.matches(selector) ?? false, selector);
  /** Goes once around the page by Tab. */
  const walk = async (where) => {
    await page.evaluate(() => {
      document.activeElement?.blur();
      window.tabStops = [];
      getSelection()?.removeAllRanges();
    });
    const seen = new Set();
    for (let i = 0; i < MOST_TABS; i++) {
      await press('Tab');
      const at = await page.evaluate(focused);
      if (!at) continue;
      if (seen.has(at.stop)) break;
      seen.add(at.stop);
      if (!at.shows) fail(`${where}: nothing shows that ${at.what} has the focus`);
      if (!at.inSight) fail(`${where}: ${at.what} has the focus out of sight`);
    }
    for (const one of await page.evaluate(unreached)) fail(`${where}: Tab does not reach ${one}`);
    passed(`${where}: ${seen.size} places`);
  };

  // A project: name, source, part, stations.
  await page.waitForSelector('#try');
  await walk('the first page');
  await tabTo('input[name=name]');
  await page.keyboard.type('Keys');
  await tabTo('input[name=stations]');
  await page.keyboard.type('4');
  await tabTo('.form .seg input');
  await tabTo('select[name=part]');
  await page.keyboard.type('pl');
  await tabTo('.form > button');
  await press('Enter');
  await page.waitForSelector('#test-devices');
  coarsenCamera(path.join(home, 'projects', 'Keys'), 2);
  await reopen(page, 'Keys');
  await walk('Rig');
  await tabTo('#test-devices');
  await press('Enter');
  await page.waitForFunction(() => document.querySelectorAll('.device .dot.done').length === 3);
  await idle();

  // Live: layers by the arrow keys, the table by a button.
  await press('3');
  await page.waitForSelector('#new-peak');
  await walk('Live');
  await tabTo('.layers input');
  await press('ArrowRight');
  await page.waitForFunction(() => document.querySelector('frangia-app').live.view.figures?.layer === 'phase');
  await tabTo('[data-jog="15"]');
  await press('Enter');
  await waitForProject(page, 'the turn of the table', ({ live }) => Math.abs((live?.table_deg ?? 0) - 15) < 1e-6);
  await press('4');
  await page.waitForSelector('#scan:not([disabled])');
  await walk('Scan');
  await tabTo('#scan');
  await press('Enter');
  await page.waitForSelector('#build:not([disabled])');
  await tabTo('#build');
  await press('Enter');
  await page.waitForSelector('.figures');
  await waitForProject(page, 'the surface', ({ surface }) => surface !== null);
  await idle();
  await settled(page);
  passed('a part is scanned');

  // The view: its buttons and keys, a camera of a station, the projection, and the ends of the legend.
  const eye = () => page.evaluate(() => {
    const { view } = document.querySelector('frangia-app').viewer;
    return { away: view.camera.position.clone().sub(view.controls.target).normalize().toArray(), target: view.controls.target.toArray(), mm: view.mmPerPixel };
  });
  await press('5');
  await tabTo('.panel input[type=radio][name]');
  await page.locator('.panel').getByText('Sigma', { exact: true }).evaluate((label) => label.closest('.seg').querySelector('input:checked').focus());
  for (let i = 0; i < 8 && !(await page.evaluate(() => document.querySelector('frangia-app').look.coloring === 'sigma')); i++) await press('ArrowRight');
  await page.waitForSelector('.legend');
  await walk('Surface');
  await tabTo('input[name=legend-high]');
  await press('Control+a');
  await page.keyboard.type('90');
  await press('Tab');
  await page.waitForFunction(() => Math.abs(document.querySelector('frangia-app').viewer.legend.high - 0.09) < 1e-9);
  await tabTo('[data-view=top]');
  await press('Enter');
  expect((await eye()).away[2] > 0.99, 'the button of the top does not lead there');
  await tabTo('#parallel');
  await press('Enter');
  expect(await page.evaluate(() => document.querySelector('frangia-app').viewer.view.isParallel), 'the projection stays');
  await press('Enter');
  await tabTo('select.stand');
  const above = await eye();
  await press('ArrowDown');
  await page.waitForFunction((z) => document.querySelector('frangia-app').viewer.view.camera.position.z !== z, above.away[2]);
  await press('Shift+Digit5', 'f');
  await tabTo('.view-canvas');
  await settled(page);
  await look('view');
  const before = await eye();
  await press('Enter');  // without a tool: nearer
  await page.waitForFunction((mm) => document.querySelector('frangia-app').viewer.view.mmPerPixel < 0.9 * mm, before.mm);
  await press('f');

  // Two points are measured where the cross is, and the measurement is removed; a plane cuts.
  await press('m');
  await tabTo('.view-canvas', 'Shift+Tab');
  await press('Enter', 'Shift+ArrowRight', 'Shift+ArrowRight', 'Enter');
  const { measurements } = await waitForProject(page, 'the distance', (project) => project.measurements.length === 1);
  expect(measurements[0].value > 1, `the distance is ${measurements[0].value} mm`);
  await idle();
  await look('measured');
  await press('Escape');
  await tabTo('[data-measured=A] button');
  await press('Enter');
  await waitForProject(page, 'the list without it', (project) => project.measurements.length === 0);
  await press('x');
  await page.waitForSelector('[name=section-at]');
  const at = () => page.evaluate(() => document.querySelector('frangia-app').viewer.section.at);
  const first = await at();
  await press('+');
  expect((await at()) > first, 'the key + does not move the plane');
  await tabTo('[name=section-at]');
  await press('Control+a');
  await page.keyboard.type('2');
  await press('Enter');
  await page.waitForFunction(() => Math.abs(document.querySelector('frangia-app').viewer.section.at - 2) < 1e-9);
  await walk('a section');
  await page.evaluate(() => document.activeElement?.blur());
  await press('x');
  passed('looked at, measured and cut');

  // Edit: chosen with a rectangle in the middle, more with Shift, less with Ctrl, deleted, undone by key and by button.
  await press('6');
  await page.waitForSelector('#undo');
  await walk('Edit');
  const selected = (what, wanted) => waitForProject(page, what, ({ surface }) => wanted(surface.selected));
  await press('b');
  await tabTo('.view-canvas', 'Shift+Tab');
  await press('Enter');
  const some = (await selected('the first stroke', (n) => n > 0)).surface.selected;
  await idle();
  await press('Shift+ArrowLeft', 'Shift+ArrowLeft', 'Shift+Enter');
  const more = (await selected('what was added', (n) => n > some)).surface.selected;
  await idle();
  await press('Control+Enter');
  await selected('what was taken out', (n) => n < more);
  await idle();
  await look('selected');
  await press('Delete');
  await selected('the deletion', (n) => n === 0);
  await idle();
  await press('Control+z');
  await selected('the undo', (n) => n > 0);
  await idle();
  await tabTo('[data-history=redo]', 'Shift+Tab');
  await press('Enter');
  await selected('the redo', (n) => n === 0);
  await idle();
  await press('7');
  await walk('Inspect');

  // Dialogs hold the focus and give it back to where it was.
  const holds = async (id) => {
    for (let i = 0; i < 12; i++) {
      await press('Tab');
      expect(await page.evaluate((id) => document.activeElement === document.body || document.activeElement.closest('dialog')?.id === id, id), `the focus leaves the dialog ${id}`);
    }
    await walk(`the dialog ${id}`);
    await press('Escape');
    await page.waitForSelector(`#${id}`, { state: 'hidden' });
  };
  for (const id of ['keys', 'link']) {
    await tabTo(`[data-tool=${id}]`, 'Shift+Tab');
    await press('Enter');
    await page.waitForSelector(`#${id}[open]`);
    await holds(id);
    expect(await has(`[data-tool=${id}]`), `the focus does not return from the dialog ${id}`);
  }
  await page.evaluate(() => document.activeElement?.blur());
  await press('5');
  await tabTo('[data-term]');
  await press('Enter');
  await page.waitForSelector('.term-card:popover-open');
  await press('Escape');
  await page.waitForSelector('.term-card', { state: 'hidden' });
  expect(await has('[data-term]'), 'the focus does not return from the meaning of a term');

  // A menu, and the question that it asks.
  await press('1');
  await page.waitForSelector('.project-card');
  await tabTo('.menu summary');
  await press('Enter');
  await page.waitForSelector('.menu[open]');
  await press('Escape');
  expect((await page.locator('.menu[open]').count()) === 0 && (await has('.menu summary')), 'Escape does not close the menu');
  await press('Enter');
  await walk('the first page with a project');
  await tabTo('.menu summary');
  await press('Enter');
  await tabTo('[data-act=rename]');
  await press('Enter');
  await page.waitForSelector('#ask[open]');
  expect(await has('#ask .entry'), 'the name cannot be written at once');
  await press('Control+a');
  await page.keyboard.type('Typed');
  await press('Enter');
  await page.waitForSelector('[data-project=Typed]');
  const after = await page.evaluate(() => `${document.activeElement.tagName} ${document.activeElement.className}, ${document.querySelectorAll('.menu[open]').length} open`);
  expect(await has('.menu summary'), `the focus does not return to the menu: ${after}`);
  expect((await page.locator('.menu[open]').count()) === 0, 'the menu stays open');

  // The file.
  await press('8');
  await page.waitForSelector('#export');
  await walk('Export');
  await tabTo('#export');
  await press('Enter');
  await page.waitForSelector('.next-step .file .btn');
  await idle();
  const saving = page.waitForEvent('download');
  await tabTo('.next-step .file .btn');
  await press('Enter');
  const file = path.join(home, 'keys.dxf');
  await (await saving).saveAs(file);
  expect(fs.readFileSync(file, 'latin1').trimEnd().endsWith('EOF'), 'the DXF is not complete');
  expect((await stateOf(page)).jobs.every(({ state }) => state !== 'failed'), 'a job failed');
}, 'the part was made by keyboard alone');
