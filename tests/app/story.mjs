// The story of the operator's app in Debian's Chromium: from an empty table to an edited DXF on the simulated rig.
//
//   node story.mjs PROGRAM FOLDER      FOLDER receives the screenshots
//
// With FRANGIA_DRAFT=1 there are fewer pixels.
// FRANGIA_WEB names the folder whose node_modules holds playwright-core, ajv and axe-core. Every message of the page and of
// the server is checked against docs/service-schema.json, and every page by axe. Ends with 77 where Chromium is missing.
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { check, coarsenCamera, expect, idle as allDone, isDraft, launch, look as lookAt, newHome, openPage, passed, reopen, requireChromium, settled, startServer, stateOf, tell, waitForProject, waitForState } from './harness.mjs';

const [program, shots] = process.argv.slice(2).map((name) => path.resolve(name));
requireChromium();
const home = newHome();
fs.mkdirSync(shots, { recursive: true });
const server = await startServer(program, home);
const { url } = server;
await tell(home, async () => {
  const browser = await launch();
  const page = await openPage(browser, url);
  const context = page.context();
  const look = (name) => lookAt(page, shots, name);
  const idle = () => allDone(page);
  const text = (selector) => page.locator(selector).first().innerText();

  await page.waitForSelector('#try');
  expect(!page.url().includes('token'), 'the token stays in the address');
  await look('project');

  await page.click('#try');

  // The rig: its devices, its geometry, and a calibration by a board that the simulated rig shows.
  await page.waitForSelector('#test-devices');
  if (isDraft) {
    const { name } = (await stateOf(page)).project;
    coarsenCamera(path.join(home, 'projects', name), 1.5);
    await reopen(page, name);
  }
  await page.click('#test-devices');
  await page.waitForFunction(() => document.querySelectorAll('.device .dot.done').length === 3);
  await idle();
  await look('rig');
  const poses = 3;
  await page.click('[data-stage=calibration]');
  await page.getByText('Another one', { exact: true }).click();
  expect((await page.inputValue('input[name=square_mm]')) === '', 'the side of a square is not measured yet');
  for (const [name, value] of [['columns', 10], ['rows', 7], ['square_mm', 14], ['poses', poses]]) await page.fill(`input[name=${name}]`, String(value));
  await page.click('#calibrate');
  for (let pose = 0; pose < poses; pose++) {
    await waitForProject(page, `pose ${pose}`, ({ calibration }) => calibration?.waiting && calibration.found === 70 && calibration.poses.length === pose);
    if (pose === poses - 1) await look('calibrate');
    await page.keyboard.press('Enter');
    await waitForState(page, (state) => state.project.calibration.poses.length === pose + 1);
  }
  await page.waitForSelector('.verdict');
  await idle();
  await look('calibrated');
  await page.getByText('Residuals, camera', { exact: true }).click();
  await page.waitForSelector('.residual-map line', { state: 'attached' });
  expect((await page.locator('.residual-map > svg line').count()) === 70 * poses, 'the map does not show every residual');
  check('residuals', await page.evaluate(async () => (await fetch('/api/residuals', { headers: { Authorization: `Bearer ${sessionStorage.getItem('frangia-key')}` } })).json()));
  await look('residuals');
  await page.locator('.layers').getByText('Rig', { exact: true }).click();

  // Live: the camera, and what is decoded from its frames as they come.
  await page.click('[data-next=live]');
  await page.waitForFunction(() => Number(document.querySelector('#live-points')?.textContent.replaceAll(',', '')) > 5000);
  await look('live');
  const layer = async (name) => {
    await page.locator('.layers').getByText(name, { exact: true }).click();
    // Until a picture of the layer has come.
    await page.waitForFunction((wanted) => document.querySelector('frangia-app').live.view.figures?.layer === wanted, name.toLowerCase());
    await settled(page);
  };
  for (const name of ['Phase', 'Status', 'Depth']) await layer(name);
  await layer('Phase');
  await look('live-phase');
  await layer('Points');
  await look('live-points');
  const figures = await page.locator('.live-foot .num').last().innerText();
  passed(`the preview shows ${figures}`);
  await page.setViewportSize({ width: 1024, height: 700 });
  await layer('Depth');
  await look('live-tablet');
  await page.setViewportSize({ width: 1440, height: 900 });

  await page.click('[data-next=scan]');
  await page.waitForSelector('#scan-check [data-state=done]');
  await page.waitForSelector('#scan:not([disabled])');
  await page.click('#scan');
  await page.waitForFunction(() => document.querySelectorAll('.dial-station.done, .dial-station.poor').length >= 5);
  await look('scan');
  await page.waitForSelector('#build:not([disabled])');
  await page.click('#build');
  await page.waitForSelector('.figures');
  await idle();
  await page.getByText('Sigma', { exact: true }).click();
  await look('surface');

  await page.getByText('None', { exact: true }).click();
  await page.locator('.seg').getByText('x', { exact: true }).click();
  await page.keyboard.press('m');
  const canvas = await page.locator('.view-canvas').boundingBox();
  const at = (x, y) => [canvas.x + x * canvas.width, canvas.y + y * canvas.height];
  await page.mouse.click(...at(0.5, 0.42));
  await page.mouse.click(...at(0.5, 0.68));
  await page.waitForSelector('.chip .big');
  expect(/\d mm/.test(await text('.chip .big')), 'no distance was measured');
  await look('section');
  await page.getByText('Off', { exact: true }).click();

  await page.keyboard.press('6');
  await page.waitForSelector('#undo');
  await page.keyboard.press('l');
  const loop = Array.from({ length: 40 }, (_, i) => at(0.5 + 0.035 * Math.cos((i * Math.PI) / 20), 0.4 + 0.055 * Math.sin((i * Math.PI) / 20)));
  await page.mouse.move(...loop[0]);
  await page.mouse.down();
  for (const point of loop) await page.mouse.move(...point);
  await page.mouse.up();
  await page.waitForSelector('#delete:not([disabled])');
  await look('edit');
  const colorAt = async (x, y) => {
    const [left, top] = at(x, y);
    const shot = await page.screenshot({ clip: { x: Math.round(left), y: Math.round(top), width: 1, height: 1 } });
    return page.evaluate(async (text) => {
      const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
      const pen = new OffscreenCanvas(1, 1).getContext('2d');
      pen.drawImage(await createImageBitmap(new Blob([bytes])), 0, 0);
      return [...pen.getImageData(0, 0, 1, 1).data];
    }, shot.toString('base64'));
  };
  expect((await text('.command code')).includes('--select-outline'), 'the command line of the edit is not shown');
  const isViolet = ([r, g, b]) => b > r + 30 && b > g + 60;
  expect(isViolet(await colorAt(0.5, 0.4)), 'the selection is not drawn where the lasso was');
  expect(!isViolet(await colorAt(0.5, 0.6)), 'the selection is drawn where the lasso was not');
  const state = () => stateOf(page);
  const whole = (await state()).project.surface;
  check('state', await state());
  await page.keyboard.press('Delete');
  await page.waitForSelector('#delete[disabled]');
  await idle();
  const holed = (await state()).project.surface;
  expect(holed.triangles === whole.triangles - whole.selected, 'the lasso did not delete what it selected');
  await page.keyboard.press('Control+z');
  await page.waitForSelector('#delete:not([disabled])');
  await page.keyboard.press('Control+Shift+Z');
  await page.waitForSelector('#delete[disabled]');
  await idle();
  await page.click('#fill');
  await page.waitForSelector('#apply:not([disabled])');
  await page.click('#apply');
  await page.waitForFunction(() => document.querySelectorAll('.history li').length === 3);
  await idle();
  const filled = (await state()).project.surface;
  expect(filled.hole_count < holed.hole_count, 'no hole was filled');
  await page.keyboard.press('Escape');
  await page.keyboard.press('5');
  await page.getByText('Marks', { exact: true }).click();
  await look('filled');

  // A brush stroke on the chest, a plane through it with its uncertainty, and an angle.
  await page.keyboard.press('6');
  await page.keyboard.press('b');
  await page.mouse.move(...at(0.44, 0.6));
  await page.mouse.down();
  for (let i = 0; i <= 12; i++) await page.mouse.move(...at(0.44 + 0.005 * i, 0.6 + 0.004 * i));
  await page.mouse.up();
  await page.waitForSelector('[data-fit=plane]:not([disabled])');
  await page.click('[data-fit=plane]');
  await page.waitForSelector('.fit');
  await idle();
  const [fit] = (await state()).project.surface.fits;
  expect(fit.kind === 'plane' && fit.points > 20 && fit.u95_mm > 0, 'no plane was fitted to the brushed triangles');
  await page.locator('.fit').first().scrollIntoViewIfNeeded();
  await look('fit');
  await page.keyboard.press('a');
  for (const [x, y] of [[0.48, 0.35], [0.5, 0.45], [0.45, 0.62]]) await page.mouse.click(...at(x, y));
  await page.waitForSelector('.chip .big');
  expect(/\d°/.test(await text('.chip .big')), 'no angle was measured');
  await page.keyboard.press('Escape');

  await page.keyboard.press('8');
  await page.waitForSelector('#export');
  await page.getByText('50,000', { exact: true }).click();
  await page.click('#export');
  await page.waitForSelector('.file');
  await idle();
  await look('export');
  const saving = page.waitForEvent('download');
  await page.locator('.file .btn').first().click();
  const dxf = path.join(home, 'part.dxf');
  await (await saving).saveAs(dxf);
  const reading = spawnSync('/usr/bin/python3', ['-c', `
import sys
try:
    import ezdxf
except ImportError:
    sys.exit("ezdxf is not installed")
document = ezdxf.readfile(sys.argv[1])
assert not document.audit().errors
print(sum(1 for one in document.modelspace() if one.dxftype() == "3DFACE"))`, dxf], { encoding: 'utf8' });
  if (reading.status === 0) {
    const faces = Number(reading.stdout);
    expect(faces > 40_000 && faces <= 50_000, `the DXF holds ${faces} faces`);
    passed(`the DXF of ${faces} faces is read back by ezdxf`);
  } else {
    passed(`not read back: ${reading.stderr.trim().split('\n').at(-1)}`);
  }

  await page.emulateMedia({ colorScheme: 'light' });
  await page.keyboard.press('d');
  await page.keyboard.press('6');
  await page.selectOption('#language', 'de');
  await look('edit-light');
  await page.keyboard.press('?');
  await page.waitForSelector('dialog[open]');
  await look('keys');

  await page.keyboard.press('Escape');
  await page.click('[data-tool=link]');
  await page.waitForSelector('#link[open] .linkbox');
  await look('link');
  await page.keyboard.press('Escape');

  // Another page of the same browser has neither the key nor the right to ask.
  const stepsBefore = (await state()).project.surface.steps_done;
  const other = await context.newPage();
  await other.goto(new URL(url).origin);
  await other.waitForSelector('.blank code');
  await other.goto('about:blank');
  const stolen = await other.evaluate(async (origin) => {
    const ask = async (target, init) => fetch(origin + target, init).then((answer) => answer.status, () => 'refused');
    return [await ask('/api/state'), await ask('/api/commands/undo', { method: 'POST', mode: 'no-cors', body: '{}' })];
  }, new URL(url).origin);
  expect(stolen[0] === 'refused', 'a page of another origin reads the state');
  const after = (await state()).project.surface;
  expect(after.steps_done === stepsBefore, 'a page of another origin acted');
}, 'the story is told');
