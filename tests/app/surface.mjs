// The steps Surface, Edit, Inspect and Export of the operator's app in Debian's Chromium, on a part of which everything is known: a
// slab with two holes below a separate tower, compared with the slab as it should be.
//
//   node surface.mjs PROGRAM FOLDER      FOLDER receives the screenshots
//
// FRANGIA_WEB as in story.mjs. Ends with 77 where Chromium is missing.
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { check, expect, idle as allDone, lastFailure, launch, look as lookAt, newHome, newProject, openPage, passed, requireChromium, startServer, stateOf, stlOf, tell, waitForProject, waitForState } from './harness.mjs';

const [program, shots] = process.argv.slice(2).map((name) => path.resolve(name));
requireChromium();
fs.mkdirSync(shots, { recursive: true });
const home = newHome();

/** A closed tower in one corner, inside of the slab's outline, so that the part fits in one pose only. */
function tower() {
  const corner = (i) => [i & 1 ? 12 : 4, i & 2 ? 10 : 4, i & 4 ? 24 : 10.5];
  return [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4], [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]].map((face) => face.map(corner));
}

/** The triangles of a slab of 60 x 40 x 10 mm in cells of 1 mm; `keep` leaves out cells of its top. */
function slab(keep, lift = () => 0, more = tower()) {
  const triangles = [...more];
  const quad = (a, b, c, d) => triangles.push([a, b, c], [a, c, d]);
  for (let x = 0; x < 60; x++)
    for (let y = 0; y < 40; y++) {
      const top = (i, j) => [i, j, 10 + lift(i, j)];
      if (keep(x, y)) quad(top(x, y), top(x + 1, y), top(x + 1, y + 1), top(x, y + 1));
      quad([x, y, 0], [x, y + 1, 0], [x + 1, y + 1, 0], [x + 1, y, 0]);
    }
  for (let x = 0; x < 60; x++) {
    quad([x, 0, 0], [x + 1, 0, 0], [x + 1, 0, 10], [x, 0, 10]);
    quad([x + 1, 40, 0], [x, 40, 0], [x, 40, 10], [x + 1, 40, 10]);
  }
  for (let y = 0; y < 40; y++) {
    quad([0, y + 1, 0], [0, y, 0], [0, y, 10], [0, y + 1, 10]);
    quad([60, y, 0], [60, y + 1, 0], [60, y + 1, 10], [60, y, 10]);
  }
  return triangles;
}
const within = (x, y, cx, cy, r) => Math.hypot(x + 0.5 - cx, y + 0.5 - cy) < r;
const edge = (x, y) => x === 0 || y === 0 || x === 60 || y === 40;
const part = slab(
  (x, y) => !within(x, y, 15, 20, 5) && !within(x, y, 32, 20, 4),
  (x, y) => (edge(x, y) ? 0 : 0.3 * Math.exp(-((x - 48) ** 2 + (y - 20) ** 2) / 30)), // a bump 0.3 mm high
);
const folder = newProject(program, home, 'slab', part);
const reference = path.join(home, 'slab as designed.stl');
fs.writeFileSync(reference, stlOf(slab(() => true)));

// What a reconstruction of frames at fault leaves beside its surface.
fs.writeFileSync(
  path.join(folder, 'surface.json'),
  JSON.stringify({
    points: 40000, views: 7, views_of_scan: 8, setups: [],
    untrusted_reason: 'the views contradict each other by 1.2 mm',
    warnings: ['views/002: frame 1 is black (odds above 10^6 : 1 against: it has 0.03 times the light); it is left out, and the phase is computed from the others; see `scan` in /tmp/a b/scan.toml'],
  }),
);

// A plain box fits in four poses.
const box = newProject(program, home, 'box', slab(() => true, () => 0, []));
const plain = path.join(home, 'box.stl');

const server = await startServer(program, home);
await tell(home, async () => {
  const browser = await launch();
  const page = await openPage(browser, server.url);
  const look = (name) => lookAt(page, shots, name);
  const idle = () => allDone(page);
  // Failures that the story asks for; any other one ends a wait.
  let forgiven = 0;
  const forgive = async () => (forgiven = await lastFailure(page));
  // As the page knows it, which hears of a change a moment after the server made it, and has drawn it.
  const until = (what, wanted) => waitForProject(page, what, wanted, forgiven);
  const state = () => until('the state', () => true);
  const words = async () => (await page.locator('.history li').last().innerText()).replace(/\s+/g, ' ');
  await page.waitForSelector('#try');
  await page.getByText('slab', { exact: true }).click();
  await page.waitForSelector('.figures');
  await idle();

  // A file that is no reference is refused in words; one that is cut short, too.
  await page.keyboard.press('7');
  await page.setInputFiles('#reference', { name: 'notes.txt', mimeType: 'text/plain', buffer: Buffer.from('x') });
  await page.waitForSelector('text=no STL, PLY, OBJ');
  await page.setInputFiles('#reference', { name: 'broken.stl', mimeType: 'model/stl', buffer: fs.readFileSync(reference).subarray(0, 5000) });
  await waitForState(page, ({ jobs }) => jobs.some((job) => job.state === 'failed'));
  await idle();
  const failures = async () => (await stateOf(page)).jobs.filter((job) => job.state === 'failed').length;
  expect((await failures()) === 1, 'a broken file was taken');
  await forgive();
  await page.setInputFiles('#reference', reference);
  const compared = await until('the comparison', (project) => project.surface.comparison);
  const found = compared.surface.comparison;
  expect(compared.reference.name === 'slab as designed.stl', 'the reference has another name');
  expect(found.overlap > 0.9 && Math.abs(found.max_mm - 0.3) < 0.03, `the bump of 0.3 mm was found as ${found.max_mm} mm`);
  await page.waitForSelector('.legend');
  await page.locator('#verdict .verdict-line').scrollIntoViewIfNeeded();
  await look('deviation');
  await page.locator('.panel').evaluate((panel) => (panel.scrollTop = 0));
  await look('deviation-legend');
  await page.click('#places');
  await page.waitForFunction(() => document.querySelector('frangia-app').viewer.holes.group.children.length > 0);
  await page.waitForSelector('.places tr');
  await look('places');
  await page.click('#places');
  passed(`the largest deviation is ${found.max_mm.toFixed(3)} mm`);

  // The command line below the picture finds the same.
  expect((await page.locator('.command code').innerText()).includes(`frangia inspect ${path.join(folder, 'surface.ply')} --reference`), 'the line is not that of inspect');
  const [, ...inspect] = (await state()).commands.inspect;
  const inspected = spawnSync(program, inspect, { encoding: 'utf8' });
  expect(inspected.status === 0, inspected.stderr);
  const out = Number(/([\d.]+) % of the nominal area is out/.exec(inspected.stdout)?.[1]);
  expect(Math.abs(out - 100 * found.out_share) < 0.051, `the page says ${100 * found.out_share} % out, inspect says ${inspected.stdout}`);

  // Repairs are previewed; what they did is said in words.
  await page.keyboard.press('6');
  await page.waitForSelector('#bridge');
  const before = (await state()).surface;
  expect(before.hole_count === 2, `the slab has ${before.hole_count} holes`);
  await page.locator('[data-hole]').first().check();
  await page.click('#fill');
  await page.waitForSelector('#apply:not([disabled])');
  expect((await state()).surface.triangles === before.triangles, 'a preview changed the surface');
  expect((await page.locator('.chip.preview .words').innerText()).startsWith('Filled 1 hole with'), 'the preview is not worded');
  await look('preview');
  await page.click('#cancel-preview');
  await until('the end of the preview', (project) => project.surface.preview === null);
  await page.click('#fill');
  await page.waitForSelector('#apply:not([disabled])');
  await page.keyboard.press('Enter');
  await until('the filled hole', (project) => project.surface.hole_count === 1);
  expect(/Filled 1 hole with \d+ triangles/.test(await words()), `the history says ${await words()}`);
  await page.keyboard.press('Control+z');
  await until('the hole again', (project) => project.surface.hole_count === 2);
  await idle();
  for (const hole of await page.locator('[data-hole]').all()) await hole.check();
  await page.click('#bridge');
  await page.waitForSelector('#apply:not([disabled])');
  await page.click('#apply');
  await until('the bridge', (project) => project.surface.steps.at(-1)?.operation === 'bridge' && project.surface.steps_done === 1);
  expect(/Bridged two holes with \d+ triangles/.test(await words()), `the history says ${await words()}`);
  await page.keyboard.press('Control+z');
  await until('both holes', (project) => project.surface.steps_done === 0);
  await idle();

  // Every other change is previewed as well: the mesh stays until it is applied, and undo and redo restore both.
  const change = async (name, operation, sentence, ask, isRight) => {
    const was = (await state()).surface;
    await ask();
    const { preview } = (await until(`the preview of ${name}`, (project) => project.surface.preview?.operation === operation)).surface;
    await page.waitForSelector('#apply:not([disabled])');
    const told = await page.locator('.chip.preview .words').innerText();
    expect(sentence.test(told), `the preview of ${name} says ${told}`);
    await page.waitForFunction(() => document.querySelector('frangia-app').viewer.preview.group.children.length > 0);
    expect((await state()).surface.mesh_revision === was.mesh_revision, `the preview of ${name} changed the surface`);
    await page.click('#apply');
    const now = (await until(name, (project) => project.surface.steps_done === was.steps_done + 1)).surface;
    await idle();
    expect(now.preview === null && now.mesh_revision !== was.mesh_revision, `${name} changed nothing`);
    expect(isRight(now, was, preview.change), `${name} made ${now.triangles} triangles in ${now.components} parts of ${was.triangles}`);
    for (const [key, revision] of [['Control+z', was.mesh_revision], ['Control+Shift+Z', now.mesh_revision], ['Control+z', was.mesh_revision]]) {
      await page.keyboard.press(key);
      await until(`${key} of ${name}`, (project) => project.surface.mesh_revision === revision);
      await idle();
    }
  };
  const width = () => page.evaluate(() => document.querySelector('frangia-app').viewer.size.x);
  const plane = (axis) => page.locator('.panel .seg label', { hasText: axis }).locator('visible=true').last().click();
  await page.fill('#tolerance', '0.02');
  await change('reducing', 'decimate', /Reduced by [\d,]+ triangles, within 0.02 mm/, () => page.click('#decimate'), (now, was) => now.triangles < was.triangles / 10);
  await plane(/^x$/);
  await change('cutting', 'cut', /Cut at a plane: [\d,]+ triangles fewer/, () => page.click('#cut'), (now, was) => now.triangles < 0.6 * was.triangles);
  await change('mirroring', 'mirror', /Mirrored/, () => page.click('#mirror'), (now, was, { moved }) => now.triangles === was.triangles && moved > 1000);
  await plane(/^Off$/);
  await change('offsetting', 'offset', /outwards by 0.5 mm/, () => page.locator('form:has(#offset) button').click(), (now, was, { moved }) => moved > 1000);
  await page.fill('#islands', '50');
  await change('islands', 'remove-islands', /Removed 1 separate part of 12/, () => page.locator('form:has(#islands) button').click(), (now) => now.components === 1);
  await change('the largest part', 'keep-largest', /Removed 1 separate part of 12/, () => page.click('#keep-largest'), (now) => now.components === 1);
  await change('smoothing', 'smooth', /Smoothed: [\d,]+ vertices moved/, () => page.click('#smooth'), (now, was, { moved }) => moved > 100);
  await page.click('#spikes');
  await page.waitForSelector('.chip.preview >> text=Found no spike');
  expect((await page.locator('#apply').count()) === 0, 'nothing can be applied');
  await page.click('#cancel-preview');
  await until('the end of the preview', (project) => project.surface.preview === null);
  await idle();

  // Three faces are picked; parallel ones are refused in words, and others are picked.
  const scene = await page.locator('.view-canvas').boundingBox();
  const pick = async (...points) => {
    for (const [x, y] of points) {
      const hit = page.waitForResponse((response) => response.url().endsWith('/api/pick'));
      await page.mouse.click(scene.x + x * scene.width, scene.y + y * scene.height);
      await hit;
    }
  };
  const [top, besides, left, right] = [[0.575, 0.497], [0.592, 0.518], [0.397, 0.665], [0.7, 0.689]];
  await page.click('#align');
  await pick(top, besides, left);
  await page.waitForSelector('.notice >> text=choose faces that meet at an angle');
  await idle();
  await forgive();
  await change('aligning', 'align', /Aligned by three faces/, () => pick(top, left, right), (now, was, { moved }) => moved > 1000);
  expect(Math.abs((await width()) - 60) < 0.1, 'undo left another size');
  await page.locator('.panel').evaluate((panel) => (panel.scrollTop = 0));
  passed('every change is previewed');

  await page.click('#fill-flat');
  await page.waitForSelector('#apply:not([disabled])');
  await page.click('#apply');
  const filled = await until('no hole', (project) => project.surface.hole_count === 0);
  expect(/Filled 2 holes flat with/.test(await words()), `the history says ${await words()}`);
  expect(filled.surface.comparison === null, 'a comparison of another mesh stays');

  // The command line that is shown makes the same bytes.
  await page.keyboard.press('8');
  await page.waitForSelector('#estimate');
  await page.waitForFunction(() => /about/.test(document.querySelector('#estimate').textContent));
  const about = await page.evaluate(() => document.querySelector('frangia-app').exporting.estimate);
  await look('export');
  await page.click('#export');
  const written = (await until('the file', (project) => project.exports.length === 1)).exports[0];
  expect(Math.abs(about.bytes / written.bytes - 1) < 0.1, `${about.bytes} bytes were announced, ${written.bytes} written`);
  const { edit } = (await state()).commands;
  const again = path.join(home, 'again.dxf');
  const line = edit.map((word, i) => (edit[i - 1] === '-o' ? again : word));
  const run = spawnSync(program, line.slice(1), { encoding: 'utf8' });
  expect(run.status === 0, run.stderr);
  expect(fs.readFileSync(again).equals(fs.readFileSync(path.join(folder, 'exports', written.name))), 'the command line makes other bytes');
  passed('the command line makes the same bytes');
  check('state', await stateOf(page));

  // A part that fits its reference in several poses: one is chosen.
  await page.keyboard.press('1');
  await page.locator('.card', { hasText: 'box' }).click();
  await page.waitForFunction(() => document.querySelector('frangia-app').state.project?.name === 'box');
  await page.waitForSelector('[data-step=inspect]:not([disabled])');
  await page.keyboard.press('7');
  await page.waitForSelector('#reference:not([disabled])', { state: 'attached' });
  await page.setInputFiles('#reference', plain);
  await page.waitForSelector('#start:not([disabled])');
  const several = (await state()).surface.comparison;
  expect(several.poses.length === 4 && several.start === 1, `a box fits in ${several.poses.length} poses`);
  await page.selectOption('#start', '3');
  const chosen = (await until('the third pose', (project) => project.surface.comparison?.start === 3)).surface.comparison;
  await idle();
  expect(Math.abs(chosen.turned_deg - several.poses[2].turned_deg) < 0.5 && chosen.in_share > 0.999, `the third pose turns by ${chosen.turned_deg}`);
  expect((await page.locator('.command code').innerText()).includes('--plan'), 'the command line takes no plan');
  expect(/^start = 3$/m.test(fs.readFileSync(path.join(box, 'inspection.toml'), 'utf8')), 'the plan states another pose');
  await page.locator('#start').scrollIntoViewIfNeeded();
  await look('poses');
  await page.keyboard.press('1');
  await page.locator('.card', { hasText: 'slab' }).click();
  await page.waitForFunction(() => document.querySelector('frangia-app').meshes.fine && document.querySelector('frangia-app').state.project?.name === 'slab');

  // What the reconstruction found wrong stands first on the step, in its first words.
  await page.waitForSelector('#findings');
  const said = await page.locator('#findings').innerText();
  expect(/Do not trust this surface/.test(said) && /missing from this surface: 1 of 8/.test(said) && said.includes('View 3: frame 1 is black'), `the findings are worded: ${said}`);
  expect(!/[`]|\/tmp/.test(said), `a path or a backtick: ${said}`);

  // Wheel and middle button move the view while a tool draws; Ctrl takes out of the selection.
  await page.keyboard.press('6');
  await page.keyboard.press('Shift+Digit5');
  await page.keyboard.press('r');
  const canvas = await page.locator('.view-canvas').boundingBox();
  const at = (x, y) => [canvas.x + x * canvas.width, canvas.y + y * canvas.height];
  const drag = async (from, to, button = 'left') => {
    await page.mouse.move(...at(...from));
    await page.mouse.down({ button });
    await page.mouse.move(...at(...to), { steps: 4 });
    await page.mouse.up({ button });
  };
  await drag([0.3, 0.3], [0.7, 0.7]);
  const all = (await until('a selection', (project) => project.surface.selected > 0)).surface.selected;
  await idle();
  await page.keyboard.down('Control');
  await drag([0.3, 0.3], [0.5, 0.7]);
  await page.keyboard.up('Control');
  await until('a smaller selection', (project) => project.surface.selected > 0 && project.surface.selected < all);
  await idle();
  const bar = () => page.locator('.view-marks text.bar').textContent();
  const near = await bar();
  await page.mouse.move(...at(0.5, 0.5));
  for (let i = 0; i < 12; i++) await page.mouse.wheel(0, 300);
  await page.waitForFunction((before) => document.querySelector('.view-marks text.bar').textContent !== before, near);
  await page.locator('[data-history=undo]').click();
  await until('the selection before', (project) => project.surface.steps_done < project.surface.steps.length);
  await idle();

  // Distances stay in a list, each with its letter.
  await page.keyboard.press('5');
  await page.keyboard.press('Shift+Digit5');
  await page.keyboard.press('m');
  for (const [x, y] of [[0.42, 0.5], [0.58, 0.5], [0.42, 0.45], [0.58, 0.45]]) await page.mouse.click(...at(x, y));
  await page.waitForFunction(() => document.querySelectorAll('.measured tr').length === 2);
  await look('measured');
  // They are kept with the project: a page that is opened again shows them.
  await idle();
  await page.reload();
  await page.waitForFunction(() => document.querySelector('frangia-app')?.meshes?.fine && document.querySelectorAll('.measured tr').length === 2);
  const labels = (await page.locator('.view-labels text').allTextContents()).join();
  expect(/^A [\d.]+ mm,B [\d.]+ mm$/.test(labels), `the labels in the picture are ${labels}`);
  await page.keyboard.press('Escape');

  // A mesh that is chosen from the first page opens in a project of its own.
  await page.keyboard.press('1');
  const choosing = page.waitForEvent('filechooser');
  await page.click('#open-file');
  await (await choosing).setFiles(plain);
  await page.click('#ask [data-answer="1"]'); // not to compare the open surface with it
  await page.waitForFunction(() => document.querySelector('frangia-app').state.project?.surface?.triangles > 0 && document.querySelector('frangia-app').state.project.name === 'Box');
  await page.waitForSelector('[data-step=surface][aria-current]');
  await idle();

  await page.setViewportSize({ width: 1024, height: 700 });
  await page.keyboard.press('d');
  for (const [key, name] of [['5', 'surface-small'], ['6', 'edit-small'], ['7', 'inspect-small'], ['8', 'export-small']]) {
    await page.keyboard.press(key);
    await look(name);
  }
}, 'the surface is told');
