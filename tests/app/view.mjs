// The view in Debian's Chromium, on a part of which everything is known: a box of 60 x 40 x 10 mm, one half of whose top is less
// certain. Its cube, projections, keys and legend; selecting what is alike; a cloud of points; and what terms mean.
//
//   node view.mjs PROGRAM FOLDER      FOLDER receives the screenshots
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { expect, idle as allDone, launch, look as lookAt, newHome, openPage, passed, requireChromium, settled, startServer, tell, waitForProject } from './harness.mjs';

const [program, shots] = process.argv.slice(2).map((name) => path.resolve(name));
requireChromium();
fs.mkdirSync(shots, { recursive: true });
const home = newHome();
const [X, Y, Z] = [60, 40, 10];

/** The box in cells of 1 mm, as the text of a PLY file with the sigma of each vertex: 0.01 mm, at x above 40 on the top 0.05 mm. */
function boxWithSigma() {
  const vertices = [];
  const numbers = new Map();
  const faces = [];
  const vertex = (p) => {
    const key = p.join();
    if (!numbers.has(key)) {
      numbers.set(key, vertices.length);
      vertices.push([...p, p[2] === Z && p[0] > 40 ? 0.05 : 0.01].join(' '));
    }
    return numbers.get(key);
  };
  const patch = (ni, nk, at) => {
    for (let i = 0; i < ni; i++)
      for (let k = 0; k < nk; k++) {
        const [a, b, c, d] = [at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)].map(vertex);
        faces.push(`3 ${a} ${b} ${c}`, `3 ${a} ${c} ${d}`);
      }
  };
  patch(X, Y, (i, k) => [i, k, Z]);
  patch(Y, X, (i, k) => [k, i, 0]);
  patch(X, Z, (i, k) => [i, 0, k]);
  patch(Z, X, (i, k) => [k, Y, i]);
  patch(Z, Y, (i, k) => [0, k, i]);
  patch(Y, Z, (i, k) => [X, i, k]);
  return ['ply', 'format ascii 1.0', `element vertex ${vertices.length}`, ...['x', 'y', 'z', 'sigma_mm'].map((name) => `property float ${name}`),
    `element face ${faces.length}`, 'property list uchar int vertex_indices', 'end_header', ...vertices, ...faces, ''].join('\n');
}
const folder = path.join(home, 'projects', 'box');
fs.mkdirSync(folder, { recursive: true });
fs.writeFileSync(path.join(folder, 'project.json'), '{"format": "frangia-project", "version": 1}\n');
fs.writeFileSync(path.join(home, 'box.ply'), boxWithSigma());
const made = spawnSync(program, ['edit', path.join(home, 'box.ply'), '-o', path.join(folder, 'surface.ply')], { encoding: 'utf8' });
if (made.status !== 0) throw new Error(made.stderr);

const server = await startServer(program, home);
await tell(home, async () => {
  const browser = await launch();
  const page = await openPage(browser, server.url, { width: 1366, height: 768 });
  const look = (name) => lookAt(page, shots, `view-${name}`);
  const idle = () => allDone(page);
  const near = (found, wanted, within, what) => expect(Math.abs(found - wanted) <= within, `${what} is ${found}, not ${wanted}`);
  await page.waitForSelector('#try');
  await page.getByText('box', { exact: true }).click();
  await page.waitForSelector('#measuring');
  await idle();
  await settled(page);
  /** The direction from what is looked at to the eye, and mm a pixel. */
  const eye = () =>
    page.evaluate(() => {
      const { view } = document.querySelector('frangia-app').viewer;
      return { away: view.camera.position.clone().sub(view.controls.target).normalize().toArray(), target: view.controls.target.toArray(), mm: view.mmPerPixel };
    });
  /** Where a point of the part is on the page. */
  const at = (...point) =>
    page.evaluate((point) => {
      const { view, canvas } = document.querySelector('frangia-app').viewer;
      view.camera.updateMatrixWorld();
      const seen = view.camera.position.clone().set(...point).project(view.camera);
      const frame = canvas.getBoundingClientRect();
      return [frame.left + ((seen.x + 1) / 2) * frame.width, frame.top + ((1 - seen.y) / 2) * frame.height];
    }, point);
  const length = async (p, q) => {
    const [[a, b], [c, d]] = [await at(...p), await at(...q)];
    return Math.hypot(a - c, b - d);
  };

  // The cube, and both projections: parallel rays show equal edges equally long, however far they are.
  await page.click('[data-face=top]');
  await settled(page);
  near((await eye()).away[2], 1, 0.01, 'the height of the eye from above');
  const edges = async () => (await length([0, 0, Z], [X, 0, Z])) / (await length([0, 0, 0], [X, 0, 0]));
  expect((await edges()) > 1.02, 'an eye sees the nearer edge no longer');
  await page.keyboard.press('o');
  await settled(page);
  near(await edges(), 1, 1e-6, 'the ratio of equal edges');
  await look('parallel');
  await page.mouse.move(...(await at(20, 20, Z)));
  const before = await eye();
  await page.mouse.dblclick(...(await at(50, 30, Z)));
  await page.waitForFunction((mm) => document.querySelector('frangia-app').viewer.view.mmPerPixel < 0.5 * mm, before.mm);
  const after = await eye();
  near(after.target[0], 50, 0.5, 'x of what was clicked twice');
  near(after.target[1], 30, 0.5, 'y of what was clicked twice');
  await page.keyboard.press('f');
  await settled(page);
  passed('the cube, the projections and the double click');

  // What parallel rays select is what they show.
  await page.keyboard.press('6');
  await page.keyboard.press('r');
  await page.mouse.move(...(await at(9.5, 9.5, Z)));
  await page.mouse.down();
  await page.mouse.move(...(await at(30, 20, Z)), { steps: 3 });
  await page.mouse.move(...(await at(30.5, 20.5, Z)));
  await page.mouse.up();
  const boxed = await waitForProject(page, 'the rectangle', (project) => project.surface.selected > 0);
  near(boxed.surface.selected, 2 * 21 * 11, 90, 'the triangles within a rectangle of 21 x 11 mm');
  await page.keyboard.press('o');

  // The picture by keyboard alone: turned, moved, and a brush used in its middle.
  await page.keyboard.press('Escape');
  await page.locator('.view-canvas').focus();
  const still = await eye();
  await page.keyboard.press('ArrowLeft');
  expect(Math.hypot(...(await eye()).away.map((one, i) => one - still.away[i])) > 0.001, 'the arrow does not turn the view');
  await page.keyboard.press('Shift+ArrowUp');
  await page.keyboard.press('PageUp');
  expect((await eye()).mm < still.mm, 'Page up does not bring it nearer');
  await page.keyboard.press('f');
  await page.keyboard.press('b');
  const small = await page.evaluate(() => document.querySelector('frangia-app').viewer.brush);
  await page.keyboard.press(']');
  expect((await page.evaluate(() => document.querySelector('frangia-app').viewer.brush)) > small, 'the key ] does not enlarge the brush');
  await page.locator('.view-canvas').focus();
  await page.keyboard.press('Enter');
  await waitForProject(page, 'the stroke of the keyboard', ({ surface }) => surface.steps_done === 2);
  await idle();
  await page.mouse.move(...(await at(30, 20, Z)));
  await page.waitForSelector('.view-overlay circle', { state: 'attached' });
  await look('brush');
  passed('the view by keyboard');

  // What is like a triangle: the top, then its less certain half.
  await page.keyboard.press('k');
  await page.mouse.click(...(await at(20, 20, Z)));
  const top = await waitForProject(page, 'the top', ({ surface }) => surface.steps_done === 3);
  near(top.surface.selected, 2 * X * Y, 0, 'the triangles that face up');
  await page.locator('.panel').getByText('Sigma', { exact: true }).click();
  await page.keyboard.down('Shift');
  await page.keyboard.down('Control');
  await page.mouse.click(...(await at(50, 20, Z)));
  await page.keyboard.up('Control');
  await page.keyboard.up('Shift');
  const half = await waitForProject(page, 'what is as uncertain', ({ surface }) => surface.steps_done === 5);
  near(half.surface.selected, 2 * 20 * Y, 0, 'the triangles of the top that are as uncertain');
  await idle();
  await look('alike');
  await page.keyboard.press('Escape');

  // A legend whose ends are chosen, and what its unit means.
  await page.keyboard.press('5');
  await page.locator('.panel').getByText('Sigma', { exact: true }).click();
  await page.waitForSelector('.legend');
  const scale = () => page.evaluate(() => document.querySelector('frangia-app').viewer.legend);
  const usual = await scale();
  await page.fill('input[name=legend-high]', '80');
  await page.keyboard.press('Tab');
  near((await scale()).high, 0.08, 1e-9, 'the upper end, mm');
  await page.fill('input[name=legend-low]', '90');
  await page.keyboard.press('Tab');
  near((await scale()).low, usual.low, 1e-9, 'the lower end after one above the upper end, mm');
  await look('legend');
  // The bar is as long as its words say, also where words are larger.
  for (const viewport of [{ width: 2560, height: 1440 }, { width: 360, height: 740 }, { width: 1366, height: 768 }]) {
    await page.setViewportSize(viewport);
    await settled(page);
    const bar = await page.evaluate(() => {
      const { right, left } = document.querySelector('path.bar').getBoundingClientRect();
      const tools = document.querySelector('.view-tools').getBoundingClientRect();
      return { mm: parseFloat(document.querySelector('text.bar').textContent), px: right - left, free: tools.left - right };
    });
    near(bar.px * (await eye()).mm, bar.mm, 0.05 * bar.mm, `the length of the bar at ${viewport.width} px`);
    expect(bar.free > 0, `the views cover the bar at ${viewport.width} px`);
  }
  await page.click('#usual-ends');
  near((await scale()).high, usual.high, 1e-9, 'the usual upper end, mm');
  for (const [language, words] of [['de', 'Standardunsicherheit'], ['it', 'incertezza tipo'], ['en', 'standard uncertainty']]) {
    await page.selectOption('#language', language);
    await page.click('[data-term=sigma]');
    expect((await page.locator('.term-card').innerText()).toLowerCase().includes(words.toLowerCase()), `sigma is not explained in ${language}`);
    if (language === 'en') await look('term');
    await page.keyboard.press('Escape');
    await page.waitForSelector('.term-card', { state: 'hidden' });
  }
  passed('legend and terms');

  // A cloud of points opens and is seen.
  await page.keyboard.press('1');
  await page.waitForSelector('#try');
  const chosen = page.waitForEvent('filechooser');
  await page.getByText('Open a file', { exact: true }).click();
  const points = Array.from({ length: 2000 }, (_, i) => `${30 * Math.cos(i)} ${30 * Math.sin(i)} ${i / 40}`).join('\n');
  await (await chosen).setFiles({ name: 'spiral.xyz', mimeType: 'text/plain', buffer: Buffer.from(`${points}\n`) });
  await page.waitForSelector('#cloud');
  await idle();
  await settled(page);
  await look('cloud');
  const drawn = await page.evaluate(() => {
    const { viewer } = document.querySelector('frangia-app');
    viewer.drawNow();
    return viewer.renderer.info.render.points;
  });
  near(drawn, 2000, 0, 'the number of points that are drawn');

  // What cannot be read is not opened, and the page says why.
  await page.keyboard.press('1');
  await page.waitForSelector('#try');
  const broken = page.waitForEvent('filechooser');
  await page.getByText('Open a file', { exact: true }).click();
  await (await broken).setFiles({ name: 'broken.stl', mimeType: 'model/stl', buffer: Buffer.from('solid x facet') });
  await page.locator('dialog[open]').getByText('Open it on its own', { exact: true }).click();
  await page.waitForSelector('.notice[role=alert] >> text=broken.stl');
  await idle();
  expect((await page.locator('.notice[role=alert]').count()) === 1, 'the reason is gone with the project');
}, 'the view was used');
