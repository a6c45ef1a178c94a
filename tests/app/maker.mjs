// The story that decides: a maker's rig comes out of its box and gives a finished part without a command line. It is
// simulated: its projector is two frames late and has a gamma of 2.2, lamps on 50 Hz light the room, and neither geometry nor
// axis is known.
//
//   node maker.mjs PROGRAM FOLDER      FOLDER receives the screenshots
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { coarsenCamera, expect, idle, launch, look as lookAt, makeDisplayPrompt, newHome, openPage, passed, reopen, requireChromium, startServer, stateOf, tell, waitForProject } from './harness.mjs';

const [program, shots] = process.argv.slice(2).map((name) => path.resolve(name));
requireChromium();
fs.mkdirSync(shots, { recursive: true });
const home = newHome();
const POSES = 3;
const STATIONS = 5;
const TRIANGLES = 20000;

await tell(home, async () => {
  const server = await startServer(program, home);
  const browser = await launch();
  const page = await openPage(browser, server.url, { width: 1366, height: 768 });
  const look = (name) => lookAt(page, shots, `maker-${name}`);
  await page.waitForSelector('input[name=name]');
  await look('home');
  await page.fill('input[name=name]', 'Maker');
  await page.fill('input[name=stations]', String(STATIONS));
  await page.locator('.form').getByText('Example', { exact: true }).click();
  await page.selectOption('select[name=example]', 'simulated-maker-unpacked');
  await look('new');
  await page.getByText('Create', { exact: true }).click();
  await page.waitForSelector('#test-devices');
  coarsenCamera(path.join(home, 'projects', 'Maker'));
  await reopen(page, 'Maker');
  await look('rig');

  await page.click('#test-devices.primary:not([disabled])');
  await page.waitForFunction(() => document.querySelectorAll('.device .dot.done').length === 3);
  await idle(page);
  await look('tested');
  await page.click('#measure-display.primary:not([disabled])');
  const { display } = await waitForProject(page, 'the display', (project) => project.display !== null);
  await idle(page);
  await look('display');
  expect(Math.abs(display.latency_s - 2 / 60) < 0.001, `the latency is ${display.latency_s} s, not two frames`);
  expect(Math.abs(display.half_light - 0.5 ** 2.2) < 0.01, `half drive gives ${display.half_light} of the light, not that of gamma 2.2`);
  expect(display.mains_hz === 50 && display.exposure_step_ms === 10, `the lamps are taken for ${display.mains_hz} Hz, in steps of ${display.exposure_step_ms} ms`);
  const rig = fs.readFileSync(path.join(home, 'projects', 'Maker', 'rig.toml'), 'utf8');
  expect(rig.includes(`delay_s = ${display.delay_s}`) && rig.includes('[projector.response]'), 'the rig does not keep what was measured');

  // A board that was printed here: its markers tell what it is, and the ruler on it how far it was scaled.
  expect((await page.locator('input[name=square_mm]').count()) === 0, 'the side of a square is asked for');
  await page.fill('input[name=poses]', String(POSES));
  await page.click('#calibrate.primary:not([disabled])');
  for (let pose = 0; pose < POSES; pose++) {
    await waitForProject(page, `pose ${pose}`, ({ calibration }) => calibration?.waiting && calibration.found > 30 && calibration.poses.length === pose);
    if (pose === 0) expect((await page.locator('#named').innerText()).includes('14.00 mm'), 'the board does not say what it is');
    if (pose === 1) await look('pose');
    await page.keyboard.press('Enter');
  }
  await page.waitForSelector('#find-axis.primary');
  await idle(page);
  await look('calibrated');

  // From here on, no frame waits for the display: the next ones would take minutes.
  makeDisplayPrompt(path.join(home, 'projects', 'Maker'));
  await page.click('#find-axis:not([disabled])');
  await waitForProject(page, 'the axis', (project) => project.axis !== null);
  await idle(page);
  await look('axis');

  // The preview begins without what the calibration saw.
  const seen = await page.evaluate(() => {
    const app = document.querySelector('frangia-app');
    app.go('live');
    return app.live.view.figures;
  });
  expect(seen === null, 'the preview begins with the picture of the board');
  await page.waitForFunction(() => (document.querySelector('frangia-app').live.view.figures?.points ?? 0) > 1000);
  await look('live');

  await page.keyboard.press('4');
  await page.waitForSelector('#scan:not([disabled])');
  await look('scan-before');
  await page.click('#scan');
  // A coarse surface of the stations so far, while the part still stands there.
  await page.waitForFunction(() => (document.querySelector('frangia-app').session.state.project.grown?.views.length ?? 0) > 1);
  await page.waitForFunction(() => document.querySelector('frangia-app').viewer.clouds.triangles > 1000);
  await look('growing');
  await page.waitForSelector('#build:not([disabled])');
  await idle(page);
  await look('scanned');
  // A number that cannot be is refused at its field; what the page builds has the bytes of the program with the same options.
  await page.click('#build-options summary');
  await page.fill('#build-options input[name=max_triangles]', '2.5');
  await page.click('#build');
  await page.waitForSelector('#wrong-max_triangles');
  await look('triangles-refused');
  expect(!(await stateOf(page)).jobs.some(({ kind }) => kind === 'reconstruct'), 'half a triangle is built');
  await page.fill('#build-options input[name=max_triangles]', String(TRIANGLES));
  expect((await page.locator('#wrong-max_triangles').count()) === 0, 'the refusal stays when the field is corrected');
  await page.click('#build');
  await page.waitForSelector('.figures');
  await idle(page);
  const [, ...again] = (await stateOf(page)).project.commands.reconstruct;
  const built = spawnSync(program, again, { encoding: 'utf8' });
  expect(built.status === 0, built.stderr);
  const folder = path.join(home, 'projects', 'Maker');
  const bytes = [['versions', '001', 'surface.ply'], ['exports', 'Maker.ply']].map((file) => fs.readFileSync(path.join(folder, ...file)));
  expect(bytes[0].equals(bytes[1]), 'the program builds another surface');
  await look('surface');
  await page.locator('#build-again').scrollIntoViewIfNeeded();
  await look('build-again');
  await page.keyboard.press('8');
  await page.waitForSelector('#export');
  await look('export');
  await page.click('#export');
  await page.waitForSelector('.file');
  await idle(page);
  await look('exported');
  const saving = page.waitForEvent('download');
  await page.locator('.next-step .file .btn').click();
  const dxf = path.join(home, 'part.dxf');
  await (await saving).saveAs(dxf);
  const { summary, triangles } = (await stateOf(page)).project.surface;
  expect(summary.untrusted_reason === '' && summary.views === STATIONS && summary.rms_after_mm < 0.05, `the surface is not sound: ${JSON.stringify(summary)}`);
  expect(triangles > TRIANGLES / 2 && triangles <= TRIANGLES, `the surface has ${triangles} triangles, not at most ${TRIANGLES}`);
  const text = fs.readFileSync(dxf, 'latin1');
  const faces = text.split('3DFACE').length - 1;
  expect(faces === triangles && text.trimEnd().endsWith('EOF'), `the DXF holds ${faces} of ${triangles} faces`);
}, 'the maker has a part');
