// The story of rigs: a rig.toml from the browser, devices that are searched for and chosen, a camera that vanishes from the
// preview, a project folder that is deleted under the server, and a browser without WebGL that scans and exports.
//
//   node rig.mjs PROGRAM FOLDER      FOLDER receives the screenshots
import fs from 'node:fs';
import path from 'node:path';
import { coarsenCamera, expect, idle, launch, look, makeDisplayPrompt, newHome, newLink, openPage, passed, reopen, requireChromium, startServer, stateOf, tell, waitForState } from './harness.mjs';

const [program, shots] = process.argv.slice(2).map((name) => path.resolve(name));
const here = import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname);
requireChromium();
const home = newHome();
fs.mkdirSync(shots, { recursive: true });
const server = await startServer(program, home);
let browser;

const notice = async (page) => (await page.locator('.notice').first().innerText()).replace(/\s+/g, ' ');

async function create(page, name, source) {
  await page.keyboard.press('1');
  await page.waitForSelector('input[name=name]');
  await page.fill('input[name=name]', name);
  await page.locator('.form').getByText(source, { exact: true }).click();
}

await tell(home, async () => {
  browser = await launch();
  const refusals = /status of 400/;  // of a bad rig.toml and of a deleted folder
  const page = await openPage(browser, server.url, undefined, { expected: refusals });
  await page.waitForSelector('input[name=name]');

  // An example first: the text explains what it is.
  await create(page, 'Laboratory', 'Example');
  await page.waitForSelector('select[name=example]');
  await page.selectOption('select[name=example]', 'maker-projector');
  expect((await page.locator('.form .note').innerText()).includes('webcam'), 'the example is not described');
  await look(page, shots, 'new-example');

  // A project of the user's own devices begins with a search.
  await create(page, 'Mine', 'My devices');
  await page.getByText('Create', { exact: true }).click();
  await page.waitForSelector('#find-devices');
  await page.click('#find-devices');
  await waitForState(page, (state) => state.search !== null);
  await page.waitForSelector('select[data-table=camera]');
  await idle(page);
  expect(await page.locator('#set-devices').isDisabled(), 'no devices are chosen yet');
  await look(page, shots, 'find-devices');

  // A rig.toml by upload, then other devices for it.
  await create(page, 'Uploaded', 'rig.toml');
  await page.setInputFiles('input[type=file]', { name: 'rig.toml', mimeType: 'text/plain', buffer: Buffer.from('format = "frangia-rig"\nversion = 1\n[devices.camera]\ndriver = "folder"\nfolder = "/etc"\n') });
  await page.getByText('Create', { exact: true }).click();
  await page.waitForSelector('.notice');
  expect((await notice(page)).includes('camera'), `a bad rig.toml is not explained: ${await notice(page)}`);
  expect(!fs.existsSync(path.join(home, 'projects', 'Uploaded')), 'a refused project leaves a folder');
  await page.setInputFiles('input[type=file]', path.join(here, '../../examples/simulated-digital.toml'));
  await page.getByText('Create', { exact: true }).click();
  await page.waitForSelector('#choose-devices:not([disabled])');
  coarsenCamera(path.join(home, 'projects', 'Uploaded'), 3);
  await reopen(page, 'Uploaded');
  await page.click('#choose-devices');
  // A setting with few values is chosen; what fails is said in the reader's language.
  await page.selectOption('select[data-table=camera]', { label: 'webcams through Video4Linux2' });
  await page.selectOption('select[data-setting=pixel_format]', 'mjpeg');
  await page.selectOption('#language', 'de');
  const setting = await page.locator('label:has(select[data-setting=pixel_format])').innerText();
  expect(setting.startsWith('Pixelformat'), `a setting in German: ${setting}`);
  await page.click('#set-devices');
  await page.waitForSelector('.notice');
  expect(/^camera \/dev\/video0|video0/.test(await notice(page)) && (await notice(page)).includes('kann nicht geöffnet werden'), `a failure in German: ${await notice(page)}`);
  await look(page, shots, 'fault-german');
  await page.selectOption('#language', 'en');
  await page.locator('.chooser details summary').first().click();
  await page.waitForSelector('textarea.lines');
  expect((await page.inputValue('textarea.lines >> nth=0')).includes('pixel_format = "mjpeg"'), 'the chosen setting is not among the lines');
  await page.locator('textarea.lines').first().fill('driver = "simulated"\npart = "plate"\nsamples = 1\n');
  await page.keyboard.press('Tab');
  await page.click('#set-devices');
  await page.waitForFunction(() => document.querySelectorAll('.device .dot.done').length === 3);
  await idle(page);
  await look(page, shots, 'chosen-devices');

  // Display and camera are fitted to each other, with what the rig lacks in words.
  const rigFile = path.join(home, 'projects', 'Uploaded', 'rig.toml');
  fs.writeFileSync(rigFile, fs.readFileSync(rigFile, 'utf8').replace('[devices.fringes]\n', '[devices.fringes]\nlatency_ms = 40\n'));
  await reopen(page, 'Uploaded');
  await page.keyboard.press('2');
  await page.click('[data-stage=display]');
  await page.click('#measure-display:not([disabled])');
  const fitted = await waitForState(page, (state) => state.project.display !== null);
  const { latency_s: latency, delay_s: delay } = fitted.project.display;
  expect(Math.abs(latency - 0.04) < 0.002, `the latency is ${latency} s, not 0.04`);
  expect(fs.readFileSync(rigFile, 'utf8').includes(`delay_s = ${delay}`), 'the rig does not keep the delay');
  await idle(page);
  await page.locator('#measure-display').scrollIntoViewIfNeeded();
  await look(page, shots, 'display-measured');
  passed(`the latency of the display is ${(1000 * latency).toFixed(0)} ms`);
  makeDisplayPrompt(path.join(home, 'projects', 'Uploaded'));

  // Without the axis of its turntable the rig scans no stations, and the page leads to where it is found.
  const rig = path.join(home, 'projects', 'Uploaded', 'rig.toml');
  const complete = fs.readFileSync(rig, 'utf8');
  fs.writeFileSync(path.join(path.dirname(rig), 'true-rig.toml'), complete);  // the simulated table stays
  fs.writeFileSync(rig, complete.replace(/\[turntable\](\n\w+ = .*)*\n/, ''));
  await reopen(page, 'Uploaded');
  await page.keyboard.press('4');
  await page.click('#to-axis');
  await page.waitForSelector('#find-axis:not([disabled])');
  await look(page, shots, 'axis-unknown');
  // Any part will do, which needs no numbers.
  await page.locator('#axis label', { hasText: 'Any part' }).click();
  expect((await page.locator('#axis input[name=square_mm]').count()) === 0, 'a part has no squares');
  await look(page, shots, 'axis-by-part');
  await page.locator('#axis label', { hasText: 'Board' }).click();
  // The board was not captured here: it is counted and measured.
  for (const [name, value] of [['columns', 10], ['rows', 7], ['square_mm', 14]]) await page.fill(`#axis input[name=${name}]`, String(value));
  await page.click('#find-axis');
  const found = await waitForState(page, ({ project }) => project.axis !== null && project.rig.turntable !== null);
  await idle(page);
  await look(page, shots, 'axis-found');
  // What a search changed comes back with a click, after a question; so does what was found.
  const restore = async (before) => {
    await page.locator('#rig-history .earlier', { hasText: before }).first().getByRole('button').click();
    await page.click('#ask [data-answer="0"]');
  };
  await restore('Before the axis was found');
  await waitForState(page, (state) => state.project.rig.turntable === null && state.project.axis === null);
  await restore('Before a return');
  await waitForState(page, (state) => state.project.rig.turntable !== null);
  await page.locator('#rig-history').scrollIntoViewIfNeeded();
  await look(page, shots, 'rig-history');
  await page.click('[data-stage=calibration]');
  await page.getByText('Print a board', { exact: true }).click();
  const saving = page.waitForEvent('download');
  await page.click('[data-paper=a4]');
  const board = await saving;
  expect(board.suggestedFilename() === 'board-a4.pdf', `the board is called ${board.suggestedFilename()}`);
  expect(fs.readFileSync(await board.path(), 'latin1').startsWith('%PDF'), 'the board is no PDF');
  await idle(page);
  passed(`the axis is within ${found.project.axis.axis_sigma_deg.toFixed(3)} degrees`);

  // The scan itself shows the axis, unless its part is round; its frames are kept in any case.
  const withoutAxis = async (name, part, stations) => {
    await create(page, name, 'Simulated');
    await page.selectOption('select[name=part]', part);
    await page.fill('input[name=stations]', String(stations));
    await page.getByText('Create', { exact: true }).click();
    await page.waitForSelector('[data-next=live]');
    const file = path.join(home, 'projects', name, 'rig.toml');
    coarsenCamera(path.dirname(file));
    fs.writeFileSync(file, fs.readFileSync(file, 'utf8').replace(/\[turntable\](\n\w+ = .*)*\n/, ''));
    await reopen(page, name);
    await page.keyboard.press('4');
    await page.waitForSelector('#scan-for-axis:not([disabled])');
  };
  await withoutAxis('Figure', 'bust', 6);
  await look(page, shots, 'axis-by-scan');
  await page.click('#scan-for-axis');
  const { project: figure } = await waitForState(page, ({ project }) => project.axis?.of_scan);
  await page.waitForSelector('#axis-found');
  await idle(page);
  await look(page, shots, 'axis-of-scan');
  expect(figure.axis.views === 6 && figure.axis.axis_sigma_deg < 0.5, `the scan shows the axis as ${JSON.stringify(figure.axis)}`);
  expect((await page.locator('#axis-found').innerText()).includes('found from this scan, by 6 views: ±'), 'the card does not say where the axis comes from');
  await page.click('#build');
  const { project: built } = await waitForState(page, ({ project }) => project.surface?.summary?.views === 6);
  expect(built.surface.summary.untrusted_reason === '', `the surface about this axis: ${built.surface.summary.untrusted_reason}`);
  await idle(page);
  passed(`the scan shows the axis within ${figure.axis.axis_sigma_deg.toFixed(3)} degrees`);
  await withoutAxis('Round', 'shaft', 4);
  await page.click('#scan-for-axis');
  await page.waitForSelector('#axis-fault');
  await idle(page);
  await look(page, shots, 'axis-not-of-scan');
  expect(/does not show the axis/.test(await page.locator('#axis-fault').innerText()), 'a round part shows an axis');
  expect(fs.readdirSync(path.join(home, 'projects', 'Round', 'scan', 'views')).length === 4, 'the frames are gone');
  await page.click('#to-axis');
  await page.waitForSelector('#find-axis:not([disabled])');
  await reopen(page, 'Uploaded');

  // The camera vanishes from the preview: the page says it, and goes on when it is plugged in again.
  const whole = fs.readFileSync(rig, 'utf8');
  fs.writeFileSync(rig, whole.replace('[devices.camera]\n', '[devices.camera]\nfaults = ["unplugged 0 always"]\n'));
  await page.keyboard.press('3');
  await page.waitForSelector('.notice');
  expect(/camera/.test(await notice(page)), `a camera that vanished is not named: ${await notice(page)}`);
  await look(page, shots, 'vanished');
  fs.writeFileSync(rig, whole);
  await page.click('#live-start:not([disabled])');
  await page.waitForFunction(() => Number(document.querySelector('#live-points')?.textContent.replaceAll(',', '')) > 5000);
  passed('the preview returns after the camera');
  await page.click('[data-jog="15"]:not([disabled])');
  await waitForState(page, (state) => Math.abs((state.project.live?.table_deg ?? 0) - 15) < 1e-6);
  await page.click('[data-jog="0"]:not([disabled])');
  await waitForState(page, (state) => state.project.live?.table_deg === 0);
  // Focus: the bar has its mark, and a click shows single pixels about it.
  const scaleOf = () => page.locator('.live-picture').evaluate((canvas) => new DOMMatrix(getComputedStyle(canvas).transform).a);
  await page.waitForFunction(() => Number(document.querySelector('#contrast')?.textContent) > 0.3);
  const mark = await page.locator('.focus .peak').evaluate((rect) => Number(rect.getAttribute('x')) / 320);
  expect(mark > 0.3, `the best contrast is marked at ${mark}`);
  await page.locator('.live-picture').click({ position: { x: 200, y: 150 } });
  expect((await scaleOf()) >= 2, `the loupe enlarges ${await scaleOf()} times`);
  await look(page, shots, 'loupe');
  await page.click('#loupe');
  expect((await scaleOf()) === 1, 'the whole picture does not come back');
  const before = (await stateOf(page)).project.capture.exposure_ms;
  await page.click('#auto-exposure');
  await waitForState(page, (state) => state.project.capture.exposure_ms !== before && state.project.live !== null);
  passed(`the exposure is ${(await stateOf(page)).project.capture.exposure_ms.toFixed(1)} ms`);

  const enterExposures = async (text) => {
    await page.fill('#exposures:not([disabled])', text);
    await page.keyboard.press('Tab');
  };
  await enterExposures('2 x');
  await page.waitForSelector('.notice');
  expect((await notice(page)).includes('no exposures'), `a text is taken for exposures: ${await notice(page)}`);
  await enterExposures('7');
  await waitForState(page, (state) => state.project.capture.exposure_ms === 7);

  // The folder of the project is deleted under the server.
  await page.keyboard.press('4');
  await waitForState(page, (state) => state.jobs.every((job) => job.state !== 'running'));
  fs.rmSync(path.join(home, 'projects', 'Uploaded'), { recursive: true });
  await page.click('#scan');
  await page.waitForSelector('.notice');
  expect(/is gone/.test(await notice(page)), `a deleted folder is not named: ${await notice(page)}`);
  await look(page, shots, 'deleted');
  await create(page, 'Plate', 'Simulated');
  await page.selectOption('select[name=part]', 'plate');
  await page.fill('input[name=stations]', '3');
  await page.getByText('Create', { exact: true }).click();
  await page.waitForSelector('[data-next=live]');
  coarsenCamera(path.join(home, 'projects', 'Plate'), 4);
  await reopen(page, 'Plate');
  await page.context().close();

  // A browser without WebGL says so; everything but the 3D picture works.
  await browser.close();
  browser = await launch({ webgl: false });
  const plain = await openPage(browser, newLink(program, home));
  await plain.getByText('WebGL is off').waitFor();
  await plain.keyboard.press('3');
  await plain.waitForFunction(() => Number(document.querySelector('#live-points')?.textContent.replaceAll(',', '')) > 1000);
  await look(plain, shots, 'no-webgl-live');
  await plain.keyboard.press('4');
  await plain.click('#scan:not([disabled])');
  await plain.waitForSelector('#build:not([disabled])');
  await plain.click('#build');
  await plain.waitForSelector('.figures');
  await idle(plain);
  await look(plain, shots, 'no-webgl');
  await plain.keyboard.press('6');
  await plain.waitForSelector('#undo');
  await plain.keyboard.press('8');
  await plain.click('#export');
  await plain.waitForSelector('.file');
  passed('a browser without WebGL scans and exports');
}, 'the story is told');
