// Measuring and sections in the operator's app in Debian's Chromium, on a part of which everything is known: a box of 60 x 40 x 10
// mm, and beside it a cylinder of 16 mm, 30 mm high.
//
//   node measure.mjs PROGRAM FOLDER      FOLDER receives the screenshots
//
// FRANGIA_WEB as in story.mjs. Ends with 77 where Chromium is missing.
import fs from 'node:fs';
import path from 'node:path';
import { check, expect, idle as allDone, launch, look as lookAt, newHome, newProject, openPage, passed, requireChromium, settled, startServer, stateOf, tell, waitForProject } from './harness.mjs';

const [program, shots] = process.argv.slice(2).map((name) => path.resolve(name));
requireChromium();
fs.mkdirSync(shots, { recursive: true });
const home = newHome();

/** A closed surface of squares: `at(i, k)` for i and k from 0 to the counts. */
function patch(ni, nk, at) {
  const triangles = [];
  for (let i = 0; i < ni; i++)
    for (let k = 0; k < nk; k++) {
      const [a, b, c, d] = [at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)];
      triangles.push([a, b, c], [a, c, d]);
    }
  return triangles;
}
const box = [
  ...patch(60, 40, (i, k) => [i, k, 10]),
  ...patch(40, 60, (i, k) => [k, i, 0]),
  ...patch(60, 10, (i, k) => [i, 0, k]),
  ...patch(10, 60, (i, k) => [k, 40, i]),
  ...patch(10, 40, (i, k) => [0, k, i]),
  ...patch(40, 10, (i, k) => [60, i, k]),
];
const N = 120;
const round = (k, r, z) => [90 + r * Math.cos((2 * Math.PI * k) / N), 20 + r * Math.sin((2 * Math.PI * k) / N), z];
const cylinder = [...patch(N, 30, (i, k) => round(i % N, 8, k))];
for (let k = 0; k < N; k++)
  for (let r = 0; r < 8; r++)
    for (const [z, up] of [[0, false], [30, true]]) {
      const quad = [round(k, r, z), round(k, r + 1, z), round((k + 1) % N, r + 1, z), round((k + 1) % N, r, z)];
      if (!up) quad.reverse();
      triangle(quad[0], quad[1], quad[2]);
      triangle(quad[0], quad[2], quad[3]);
    }
function triangle(a, b, c) {
  const same = (p, q) => p.every((one, i) => Math.abs(one - q[i]) < 1e-9);
  if (!same(a, b) && !same(b, c) && !same(c, a)) cylinder.push([a, b, c]);
}
newProject(program, home, 'part', [...box, ...cylinder]);
const disc = (N / 2) * 64 * Math.sin((2 * Math.PI) / N);
const rim = 2 * N * 8 * Math.sin(Math.PI / N);

const server = await startServer(program, home);
await tell(home, async () => {
  const browser = await launch();
  const page = await openPage(browser, server.url, { width: 1366, height: 768 }, { expected: /status of 400/ });
  page.on('response', async (response) => {
    if (response.url().endsWith('/api/section')) check('section', await response.json());
  });
  const look = (name) => lookAt(page, shots, name);
  const idle = () => allDone(page);
  const until = (what, wanted) => waitForProject(page, what, wanted);
  const near = (found, wanted, within, what) => expect(Math.abs(found - wanted) < within, `${what} is ${found}, not ${wanted}`);
  await page.waitForSelector('#try');
  await page.getByText('part', { exact: true }).click();
  await page.waitForSelector('#measuring');
  await idle();
  await page.evaluate(() => document.querySelector('frangia-app').viewer.frame([0.7, -1, 0.8]));
  await settled(page);
  /** Clicks on a point of the part that the eye sees. */
  const click = async (point) => {
    const [x, y] = await page.evaluate((point) => {
      const { view } = document.querySelector('frangia-app').viewer;
      const seen = view.camera.position.clone().set(...point).project(view.camera);
      return [(seen.x + 1) / 2, (1 - seen.y) / 2];
    }, point);
    const scene = await page.locator('.view-canvas').boundingBox();
    const hit = page.waitForResponse((response) => response.url().endsWith('/api/pick'));
    await page.mouse.click(scene.x + x * scene.width, scene.y + y * scene.height);
    await hit;
  };
  let count = 0;
  const measured = async (quantity, ...points) => {
    if (quantity) await page.click(`[data-quantity=${quantity}]`);
    for (const point of points) await click(point);
    const all = (await until(quantity, (project) => project.measurements.length === count + 1)).measurements;
    await idle();
    return all[count++];
  };

  // Points, faces, and both.
  const points = await measured('distance', [10, 10, 10], [50, 30, 10]);
  near(points.value, Math.hypot(40, 20), 0.6, 'the distance of the points');
  near(points.to_mm[0] - points.from_mm[0], 40, 0.5, 'its part along x');
  expect(points.u95 === null, 'a surface without sigma has no U95');
  await page.locator('#measuring .seg label').filter({ hasText: 'Faces' }).click();
  await page.waitForSelector('#measuring >> text=Faces to click');
  const faces = await measured(null, [30, 20, 10], [30, 0, 5]).catch(() => null);
  expect(faces && faces.elements.every(({ kind }) => kind === 'plane'), 'the faces are no planes');
  const apart = await measured(null, [90, 12, 15], [60, 20, 5]);
  expect(apart.elements.map(({ kind }) => kind).join() === 'cylinder,plane', `clicked were ${JSON.stringify(apart.elements)}`);
  near(apart.value, 30, 0.05, 'the distance from the axis to the side');
  const angle = await measured('angle', [30, 20, 10], [30, 0, 5]);
  near(angle.value, 90, 0.05, 'the angle of the faces');
  const diameter = await measured('diameter', [90, 12, 20]);
  near(diameter.value, 16, 0.05, 'the diameter');
  const thickness = await measured('thickness', [40, 20, 10]);
  near(thickness.value, 10, 1e-3, 'the thickness');
  await page.keyboard.press('Escape');
  const area = await measured('area');
  near(area.value, 2 * (2400 + 600 + 400) + 2 * disc + 30 * rim, 1, 'the area');
  const volume = await measured('volume');
  near(volume.value, 24000 + 30 * disc, 1, 'the volume');
  await page.waitForFunction(() => document.querySelectorAll('.measured tr').length === 8);
  await page.locator('#measuring').scrollIntoViewIfNeeded();
  await look('measured');
  const labels = (await page.locator('.view-labels text').allTextContents()).join('|');
  expect(/E ⌀ 1[56]\.\d+ mm/.test(labels) && /D (90\.0|89\.9)/.test(labels), `the labels are ${labels}`);
  const boxes = await page.locator('.view-labels text').evaluateAll((all) => all.map((one) => one.getBoundingClientRect().toJSON()));
  for (const [i, a] of boxes.entries())
    for (const b of boxes.slice(i + 1))
      expect(a.right < b.left || b.right < a.left || a.bottom - 4 < b.top || b.bottom - 4 < a.top, 'two labels cover each other');
  const saving = page.waitForEvent('download');
  await page.click('#save-measured');
  const file = path.join(home, 'measured.csv');
  await (await saving).saveAs(file);
  const rows = fs.readFileSync(file, 'utf8').trim().split('\n');
  expect(rows.length === 9 && rows[0] === 'name,quantity,of,value,unit,u95,dx_mm,dy_mm,dz_mm', `the list is ${rows.join('\n')}`);
  expect(/^A,distance,point - point,4\d\.\d+,mm,,/.test(rows[1]) && /^H,volume,surface,30\d+\.\d+,mm3,,,,$/.test(rows[8]), `the list is ${rows.join('\n')}`);
  await page.locator('[data-measured=B] .icon-btn').click();
  await until('one less', (project) => project.measurements.length === 7);
  passed('everything is measured');

  // What cannot be measured is refused in words, and nothing is added.
  await page.click('[data-quantity=diameter]');
  await click([30, 20, 10]);
  await page.waitForSelector('.notice >> text=a plane has no diameter');
  await page.locator('.notice button').first().click();
  await page.keyboard.press('Escape');
  expect((await stateOf(page)).project.measurements.length === 7, 'a refused measurement is kept');

  // A section by a key, at an exact position, with its cap, contour, length and area.
  await page.keyboard.press('z');
  await page.fill('[name=section-at]', '5');
  await page.press('[name=section-at]', 'Enter');
  const cut = async (what, wanted) => {
    const found = await page.waitForFunction((key) => {
      const { sectioning } = document.querySelector('frangia-app');
      return sectioning.found && JSON.stringify(sectioning.plane?.point_mm) === key ? sectioning.found : null;
    }, JSON.stringify(wanted));
    passed(what);
    return found.jsonValue();
  };
  const level = await cut('a section at z = 5', [0, 0, 5]);
  near(level.length_mm, 200 + rim, 0.01, 'the contour');
  near(level.area_mm2, 2400 + disc, 0.01, 'the area of the section');
  await page.locator('#section').scrollIntoViewIfNeeded();
  await page.waitForSelector('#cut-figures');
  await look('section-exact');
  for (const format of ['dxf', 'svg']) {
    const coming = page.waitForEvent('download');
    await page.click(`[data-section=${format}]`);
    const saved = path.join(home, `section.${format}`);
    await (await coming).saveAs(saved);
    await idle();
    const text = fs.readFileSync(saved, 'utf8');
    expect(format === 'dxf' ? (text.match(/POLYLINE/g) ?? []).length === 2 && text.includes('$INSUNITS') : text.includes('<svg') && text.includes('path'), `the ${format} lacks its curves`);
  }
  await page.keyboard.press('Escape');
  await page.locator('.view-canvas').click({ position: { x: 5, y: 5 } });
  await page.evaluate(() => document.activeElement?.blur());
  await page.keyboard.press('+');
  await page.waitForFunction(() => document.querySelector('frangia-app').sectioning.plane?.point_mm[2] > 5);
  await page.keyboard.press('-');
  await page.waitForFunction(() => Math.abs(document.querySelector('frangia-app').sectioning.plane?.point_mm[2] - 5) < 1e-9);
  await page.keyboard.press('z');
  await page.waitForFunction(() => document.querySelector('frangia-app').sectioning.plane === null);

  // Through three points.
  await page.locator('#section .seg label').filter({ hasText: '3 points' }).click();
  for (const point of [[10, 20, 10], [50, 20, 10], [30, 0, 5]]) await click(point);
  const plane = await page.waitForFunction(() => {
    const { sectioning, viewer } = document.querySelector('frangia-app');
    return sectioning.found && viewer.atRest ? sectioning.plane : null;
  });
  const { normal } = await plane.jsonValue();
  const wanted = [0, -5, 20].map((one) => one / Math.hypot(5, 20));
  for (const i of [0, 1, 2]) near(normal[i], wanted[i], 0.03, `the normal's part ${i}`);
  await look('section-points');

  // Narrow, in Italian and light.
  await page.selectOption('#language', 'it');
  await page.keyboard.press('d');
  await page.setViewportSize({ width: 360, height: 740 });
  await page.locator('#measuring').scrollIntoViewIfNeeded();
  await look('narrow');
  await page.keyboard.press('?');
  await page.waitForSelector('#keys[open]');
  await look('narrow-keys');
  check('state', await stateOf(page));
}, 'measuring is told');
