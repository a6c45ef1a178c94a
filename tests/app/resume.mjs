// The second and third story of the operator's app: the browser is closed in mid-scan and opened again, a second browser
// watches and takes over, and the server is killed in mid-scan and resumes to the same bytes.
//
//   node resume.mjs PROGRAM FOLDER      FOLDER receives the screenshots
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { coarsenCamera, createProject, expect, launch, look, newHome, newLink, openPage, passed, requireChromium, startServer, tell, waitForState } from './harness.mjs';

const [program, shots] = process.argv.slice(2).map((name) => path.resolve(name));
requireChromium();
const home = newHome();
fs.mkdirSync(shots, { recursive: true });
const STATIONS = 4;
const EXPOSURE_MS = 1000;  // in real time until the server is killed: the scan would take a minute
let server = await startServer(program, home);

const share = (state) => state.jobs.find((job) => job.kind === 'scan' && job.state === 'running')?.progress ?? 0;

/** Contents of all frames of a scan folder, by name. */
function framesOf(folder) {
  const frames = new Map();
  for (const name of fs.readdirSync(path.join(folder, 'views'), { recursive: true }))
    if (name.endsWith('.png')) frames.set(name, fs.readFileSync(path.join(folder, 'views', name)));
  return frames;
}

await tell(home, async () => {
  const browser = await launch();
  let page = await openPage(browser, server.url);
  await createProject(page, 'Plate', 'plate', STATIONS);
  coarsenCamera(path.join(home, 'projects', 'Plate'), 4);
  await page.keyboard.press('4');
  await page.waitForSelector('#scan:not([disabled])');
  const project = path.join(home, 'projects', 'Plate');
  const rig = path.join(project, 'rig.toml');
  fs.writeFileSync(rig, fs.readFileSync(rig, 'utf8').replace('[devices.camera]\n', `[devices.camera]\nreal_time = true\nreference_exposure_ms = ${EXPOSURE_MS}\n`));
  await page.evaluate(async (exposure) => {
    const body = JSON.stringify({ exposure_ms: exposure, gain_db: 0, black_level_counts: 0, shifts: 4, algorithm: 'auto' });
    const answer = await fetch('/api/commands/set-capture', {
      method: 'POST', body, headers: { 'Content-Type': 'application/json', Authorization: `Bearer ${sessionStorage.getItem('frangia-key')}` },
    });
    if (!answer.ok) throw new Error(await answer.text());
  }, EXPOSURE_MS);
  await page.click('#scan');
  await waitForState(page, (state) => share(state) > 0.02);
  await page.context().close();

  // A new browser finds the scan going on, and operates: the role of the first one ended with it. A third one watches, and
  // takes over by asking.
  const second = await openPage(browser, newLink(program, home));
  await second.waitForFunction(() => document.querySelector('frangia-app').session.state && !document.querySelector('frangia-app').session.watches);
  await second.evaluate(() => document.querySelector('frangia-app').session.command('set-notes', { name: 'Plate', text: 'seen' }));
  page = await openPage(browser, newLink(program, home));
  await page.waitForSelector('#take-over');
  const seen = share(await waitForState(page, (state) => share(state) > 0));
  await look(page, shots, 'watching');
  const refused = await page.evaluate(async () => {
    const answer = await fetch('/api/commands/close-project', {
      method: 'POST', body: '{}', headers: { 'Content-Type': 'application/json', Authorization: `Bearer ${sessionStorage.getItem('frangia-key')}` },
    });
    return answer.status;
  });
  expect(refused === 409, `a browser that watches may act: ${refused}`);
  await page.click('#take-over');
  await page.waitForSelector('#take-over', { state: 'detached' });
  passed('the second browser has taken over');

  // SIGKILL in mid-scan. The server finds the project on the disk and goes on with the first missing frame.
  await waitForState(page, (state) => share(state) > seen);
  await server.end('SIGKILL');
  await page.waitForSelector('.notice.warn[role=alert]');
  await look(page, shots, 'lost');
  await page.context().close();
  // From here on, exposures take no time; the frames are the same.
  fs.writeFileSync(rig, fs.readFileSync(rig, 'utf8').replace('real_time = true\n', ''));
  server = await startServer(program, home);
  page = await openPage(browser, server.url);
  await page.locator('.card', { hasText: 'Plate' }).click();
  await page.waitForSelector('#scan:not([disabled])');
  const offer = await page.locator('#scan').innerText();
  expect(/Continue/.test(offer), `the app does not offer to continue: ${offer}`);
  await look(page, shots, 'resume');
  await page.click('#scan');
  const done = await waitForState(page, (state) => state.project.scan_complete && state.jobs.every((job) => job.state !== 'running'));
  expect(done.project.stations.every((station) => station.state === 'done'), 'a station is missing');
  const whole = spawnSync(program, ['scan', rig, '-o', path.join(home, 'whole'), '--views', String(STATIONS), '--exposure', String(EXPOSURE_MS)], { encoding: 'utf8' });
  expect(whole.status === 0, `frangia scan fails: ${whole.stderr}`);
  const [resumed, once] = [framesOf(path.join(project, 'scan')), framesOf(path.join(home, 'whole'))];
  expect(once.size > 0 && resumed.size === once.size, `${resumed.size} frames instead of ${once.size}`);
  for (const [name, bytes] of once) expect(bytes.equals(resumed.get(name) ?? Buffer.alloc(0)), `${name} differs from an uninterrupted scan`);
  passed(`${once.size} frames equal those of an uninterrupted scan`);

  // An edit whose answer is lost is sent again, and is made once.
  const idle = (state) => state.jobs.every((job) => job.state !== 'running' && job.state !== 'waiting');
  await page.waitForSelector('#build:not([disabled])');
  await page.click('#build');
  await waitForState(page, (state) => state.project.surface && idle(state));
  let sent = 0;
  let sentAgain;
  const isSentAgain = new Promise((resolve) => { sentAgain = resolve; });
  await page.route('**/api/commands/edit', async (route) => {
    if (sent++ > 0) {
      sentAgain();
      return route.continue();
    }
    await route.fetch();
    await route.abort('connectionreset');
  });
  // The page goes to the new surface by itself.
  await page.waitForFunction(() => document.querySelector('frangia-app').step === 'surface');
  await page.keyboard.press('6');
  await page.waitForSelector('#undo');
  await page.keyboard.press('i');
  await isSentAgain;
  const edited = await waitForState(page, (state) => state.project.surface.steps.length > 0 && idle(state));
  expect(edited.project.surface.steps.length === 1, 'an edit whose answer was lost is made twice');
  expect(edited.project.revision === 2, `the revision is ${edited.project.revision} after a surface and an edit`);
  passed('an edit whose answer was lost is made once');

  // Built again, the surface is another version; the first one is there with its edit, which can be replayed.
  await page.keyboard.press('5');
  await page.getByText('Build again', { exact: true }).click();
  const again = await waitForState(page, (state) => state.project.current_version === 2 && idle(state));
  expect(again.project.surface.steps.length === 0, 'a new surface has edits');
  await page.waitForSelector('#replay:not([disabled])');
  await page.locator('#versions').scrollIntoViewIfNeeded();
  await look(page, shots, 'versions');
  await page.click('#replay');
  await waitForState(page, (state) => state.project.surface.steps_done === 1 && idle(state));
  await page.click('[data-version="1"] button:not([disabled])');
  await waitForState(page, (state) => state.project.current_version === 1 && state.project.surface.steps_done === 1 && idle(state));
  passed('the surfaces are versions with their edits');
}, 'the scan survived');
