// Files and folders are dragged onto the page, in German: a mesh is repaired, measured and exported; each kind opens where it
// belongs, in every step, over dialogs, while a job runs and in a browser that watches; what cannot be opened is said in one
// sentence.
//
//   node drop.mjs PROGRAM FOLDER      FOLDER receives the screenshots
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { coarsenCamera, expect, idle as allDone, launch, look as lookAt, newHome, newLink, openPage, passed, reopen, requireChromium, settled, startServer, stateOf, stlOf, tell, waitForProject, waitForState } from './harness.mjs';

const [program, shots] = process.argv.slice(2).map((name) => path.resolve(name));
const samples = path.join(import.meta.dirname, '../data/cad-samples');
requireChromium();
fs.mkdirSync(shots, { recursive: true });
const home = newHome();

const files = path.join(home, 'files');
const at = (...names) => path.join(files, ...names);
const write = (name, content) => {
  fs.mkdirSync(path.dirname(at(name)), { recursive: true });
  fs.writeFileSync(at(name), content);
};
/** A block as closed triangles, each of its edges in mm. */
function block(x, y, z) {
  const corner = (i) => [i & 1 ? x : 0, i & 2 ? y : 0, i & 4 ? z : 0];
  return [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4], [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]].map((face) => face.map(corner));
}
write('wedge.stl', stlOf(block(40, 30, 10).filter((_, i) => i !== 2 && i !== 3)));  // without its top
write('whole.stl', stlOf(block(40, 30, 10)));
write('other.stl', stlOf(block(20, 30, 10)));
write('cloud.xyz', Array.from({ length: 400 }, (_, i) => `${20 * Math.cos(i)} ${20 * Math.sin(i)} ${i / 20}`).join('\n'));
write('notes.txt', 'x');
write('broken.stl', 'solid x facet');
write('inspection.toml', 'format = "frangia-inspection"\nversion = 1\nalign = "best-fit"\ntolerance_mm = [-0.2, 0.2]\n');
write('papers/notes.txt', 'x');
write('papers/.hidden', 'x');
fs.mkdirSync(at('nothing'), { recursive: true });
fs.copyFileSync(path.join(samples, 'plate.stp'), at('plate.stp'));

await tell(home, async () => {
  const server = await startServer(program, home);
  const browser = await launch();
  const page = await openPage(browser, server.url, { width: 1366, height: 768 }, { locale: 'de-DE', expected: /status of (400|409)/ });
  const cdp = await page.context().newCDPSession(page);
  const look = (name) => lookAt(page, shots, `drop-${name}`);
  const idle = () => allDone(page);
  /** Drags files from outside of the browser to a place of the page; `before` looks while they are held there. */
  const dragOnto = async (driver, names, { x = 500, y = 400, before = null } = {}) => {
    const data = { items: [], files: names.map((name) => at(name)), dragOperationsMask: 1 };
    for (const type of ['dragEnter', 'dragOver', 'drop']) {
      if (type === 'drop' && before) await before();
      await driver.send('Input.dispatchDragEvent', { type, x, y, data });
    }
  };
  const drop = (names, how) => dragOnto(cdp, names, how);
  const said = async (words) => {
    await page.waitForSelector(`.notice[role=alert] >> text=${words}`);
    expect((await page.locator('.notice[role=alert]').count()) === 1, `${words}: it is said twice`);
    const sentence = (await page.locator('.notice[role=alert] span').first().innerText()).trim();
    await page.evaluate(() => document.querySelector('frangia-app').dismiss());
    await page.waitForSelector('.notice[role=alert]', { state: 'detached' });
    return sentence;
  };
  const command = (name, argument) => page.evaluate(([name, argument]) => document.querySelector('frangia-app').session.command(name, argument), [name, argument]);
  const opened = (name, what) => waitForState(page, ({ project, jobs }) => project?.name === name && what(project) && !jobs.some((job) => job.kind !== 'live' && ['waiting', 'running'].includes(job.state)));
  const projects = async () => (await stateOf(page)).projects.map(({ name }) => name).sort().join();
  await page.waitForSelector('#try');

  const step = async (number) => {
    await page.keyboard.press(String(number));
    await page.waitForFunction((number) => document.querySelectorAll('[data-step]')[number - 1].hasAttribute('aria-current'), number);
  };

  // Each kind, onto the first page.
  await drop(['wedge.stl'], { before: async () => {
    await page.waitForSelector('.drop');
    await look('held');
  } });
  await opened('Wedge', (project) => project.surface?.triangles === 10 && project.surface.hole_count === 1);
  await page.waitForSelector('[data-step=surface][aria-current]');
  expect((await page.locator('.drop').count()) === 0, 'the frame of the drop stays');
  await idle();
  await look('surface');
  await page.getByRole('button', { name: 'Reparieren' }).click();
  await page.click('#fill-flat:not([disabled])');
  await page.click('#apply:not([disabled])');
  await waitForProject(page, 'the repair', ({ surface }) => surface.hole_count === 0);
  await idle();
  await page.keyboard.press('5');
  await page.getByRole('button', { name: 'Volumen' }).click();
  const { measurements } = await waitForProject(page, 'the volume', (project) => project.measurements.length === 1);
  expect(Math.abs(measurements[0].value - 12000) < 1e-3, `the volume is ${measurements[0].value} mm³`);
  await page.waitForFunction(() => document.querySelector('.measured td')?.textContent.includes('12.000 mm³'));
  await idle();
  await look('measured');
  await page.keyboard.press('8');
  await page.waitForSelector('#export:not([disabled])');
  await page.click('#export');
  await page.waitForSelector('.next-step .file .btn');
  await idle();
  const saving = page.waitForEvent('download');
  await page.locator('.next-step .file .btn').click();
  const dxf = path.join(home, 'wedge.dxf');
  await (await saving).saveAs(dxf);
  expect(fs.readFileSync(dxf, 'latin1').split('3DFACE').length - 1 === 12, 'the DXF has not the repaired faces');
  passed('a mesh was dropped, repaired, measured and exported');
  await step(1);
  await drop(['cloud.xyz']);
  await opened('Cloud', (project) => project.surface !== null);
  await page.waitForSelector('#cloud');
  await step(1);
  await drop(['plate.stp']);
  await page.click('#ask [data-answer="1"]'); // not to compare the cloud with it
  await opened('Plate', (project) => project.surface?.triangles > 100);
  const plate = path.join(home, 'projects', 'Plate');
  fs.copyFileSync(path.join(plate, fs.readdirSync(plate, { recursive: true }).find((name) => path.basename(name) === 'surface.ply')), at('milled.ply'));
  await step(1);
  await drop(['milled.ply', 'plate.stp', 'inspection.toml']);
  const compared = await opened('Milled', (project) => project.surface?.comparison);
  await page.waitForSelector('[data-step=inspect][aria-current]');
  expect(compared.project.reference.name === 'plate.stp' && compared.project.plan.tolerance_mm[1] === 0.2, 'the mesh is not inspected by what came with it');
  await idle();
  await look('part');
  // A mesh has no devices and was not scanned: the steps say so, and lead to where devices are chosen.
  await step(2);
  await look('no-rig');
  await step(4);
  expect((await page.locator('.panel table').count()) === 0, 'a mesh has stations');
  await look('no-scan');
  await page.click('[data-next=rig]');
  await page.waitForSelector('#find-devices');
  passed('a mesh, a cloud, a STEP file, and a mesh with its STEP file and plan');

  // A rig, then what was scanned with it, as a folder and as its zip.
  await command('create-project', { name: 'Seed', part: 'plate', stations: 3 });
  await opened('Seed', (project) => project.can_scan);
  await page.waitForSelector('[data-step=scan][aria-current]');
  const seed = path.join(home, 'projects', 'Seed');
  coarsenCamera(seed, 8);
  fs.copyFileSync(path.join(seed, 'rig.toml'), at('rig.toml'));
  await step(1);
  await drop(['rig.toml']);
  await opened('Rig', (project) => project.rig !== null && project.surface === null);
  await page.waitForSelector('#test-devices');
  const scanned = spawnSync(program, ['scan', path.join(seed, 'rig.toml'), '-o', at('Part'), '--views', '2'], { encoding: 'utf8' });
  expect(scanned.status === 0, scanned.stderr);
  fs.cpSync(at('Part'), at('two', 'a'), { recursive: true });
  fs.cpSync(at('Part'), at('two', 'b'), { recursive: true });
  fs.cpSync(at('Part'), at('whole', 'scan'), { recursive: true });
  fs.copyFileSync(at('wedge.stl'), at('whole', 'surface.stl'));
  const zipped = spawnSync('/usr/bin/python3', ['-m', 'zipfile', '-c', at('zipped.zip'), at('Part')], { encoding: 'utf8' });
  expect(zipped.status === 0, zipped.stderr);
  for (const [name, project] of [['Part', 'Part'], ['zipped.zip', 'Zipped'], ['whole', 'Scan']]) {
    await step(1);
    await drop([name]);
    await opened(project, ({ stations, scan_complete }) => scan_complete && stations.length === 2);
    await page.waitForSelector('[data-step=scan][aria-current]');
  }
  await idle();
  await look('scan');
  passed('a rig, a scan folder, its zip, and a folder around a scan');

  // What cannot be opened, in one sentence, which names it; nothing is left behind.
  const before = await projects();
  for (const [names, words] of [
    [['notes.txt'], 'notes.txt ist kein Netz'],
    [['papers'], 'papers ist kein Netz'],
    [['nothing'], 'nothing ist leer'],
    [['wedge.stl', 'other.stl'], 'Das sind 2 Dinge: other.stl, wedge.stl'],
    [['wedge.stl', 'rig.toml'], 'Das sind 2 Dinge'],
    [['two'], 'Das sind 2 Dinge: two/a/scan.toml'],
    [['inspection.toml'], 'inspection.toml ist ein Prüfplan'],
    [['broken.stl'], 'broken.stl'],
  ]) {
    await drop(names);
    const sentence = await said(words);
    expect(!/[`]|\/tmp|\b(the|is|of)\b/.test(sentence), `the sentence is ${sentence}`);
  }
  await idle();
  expect((await projects()) === before, `projects are left: ${await projects()}`);
  passed('what cannot be opened is said');

  // In every step of a project with a rig and a surface: a mesh asks what it is for; a dialog that is open gives way.
  await command('open-project', { name: 'Cloud' });
  await opened('Cloud', (project) => project.surface !== null);
  const surfaced = spawnSync(program, ['edit', at('whole.stl'), '-o', path.join(seed, 'surface.ply')], { encoding: 'utf8' });
  expect(surfaced.status === 0, surfaced.stderr);
  await command('open-project', { name: 'Seed' });
  await opened('Seed', (project) => project.surface?.triangles === 12);
  await page.waitForFunction(() => document.querySelector('frangia-app').session.state.project?.name === 'Seed'); // it goes to the surface then
  for (let number = 1; number <= 8; number++) {
    await step(number);
    if (number === 3) await page.waitForSelector('#live-points');
    await drop(['notes.txt']);
    await said('notes.txt ist kein Netz');
    // Onto the panel, too.
    await drop(['other.stl'], number % 2 ? { x: 1200, y: 500 } : {});
    await page.waitForSelector('#ask[open]');
    expect((await page.locator('#question').innerText()).includes('other.stl'), 'it is not asked what the mesh is for');
    await page.keyboard.press('Escape');
    await page.waitForSelector('#ask', { state: 'hidden' });
  }
  await step(6);
  for (const id of ['keys', 'link']) {
    await page.click(`[data-tool=${id}]`);
    await page.waitForSelector(`#${id}[open]`);
    await drop(['notes.txt'], { x: 683, y: 300, before: () => page.waitForFunction(() => {
      const frame = document.querySelector('.drop');
      return frame?.matches(':popover-open');  // above the dialog
    }) });
    await said('notes.txt ist kein Netz');
    expect((await page.locator('dialog[open]').count()) === 0, 'the dialog hides what is said');
  }
  await drop(['other.stl']);
  await page.waitForSelector('#ask[open]');
  await drop(['wedge.stl'], { x: 683, y: 384 });
  await page.waitForFunction(() => document.querySelector('#ask[open] #question')?.textContent.includes('wedge.stl'));
  await look('asked');
  await page.click('#ask [data-answer="0"]');
  const own = await opened('Seed', (project) => project.surface?.comparison);
  expect(own.project.reference.name === 'wedge.stl', 'the mesh is not what the surface is compared with');
  await idle();  // the inspection by the new reference
  await drop(['inspection.toml']);
  await waitForState(page, ({ project }) => project.plan?.tolerance_mm?.[1] === 0.2);
  await idle();
  passed('in every step and over dialogs');

  // While a job runs nothing is opened; the preview gives way.
  const slow = path.join(seed, 'rig.toml');
  fs.writeFileSync(slow, fs.readFileSync(slow, 'utf8').replace('[devices.camera]\n', '[devices.camera]\nreal_time = true\nreference_exposure_ms = 500\n'));
  await reopen(page, 'Seed');
  await command('set-capture', { exposure_ms: 500 });
  await step(4);
  await page.click('#scan:not([disabled])');
  await page.waitForFunction(() => document.querySelector('frangia-app').occupied);
  await drop(['wedge.stl']);
  await said('Eine Aufgabe läuft');
  await page.locator('.foot').getByText('Anhalten', { exact: true }).click();
  await waitForState(page, ({ jobs }) => jobs.every(({ state }) => state !== 'running' && state !== 'waiting'));
  await step(3);
  await page.waitForFunction(() => document.querySelector('frangia-app').session.state.project?.live);
  await drop(['rig.toml']);
  await opened('Rig 2', (project) => project.rig !== null);
  passed('while a job runs');

  // A browser that watches is told so, and may take over; without a server the page stays.
  const other = await openPage(browser, newLink(program, home), { width: 1024, height: 700 }, { expected: /status of 409|ERR_CONNECTION/ });
  await other.waitForSelector('#take-over');
  const there = await other.context().newCDPSession(other);
  await dragOnto(there, ['wedge.stl']);
  await other.waitForSelector('.notice[role=alert] #take-over');
  expect((await other.locator('.notice').count()) === 1, 'that it watches is said twice');
  await settled(other);
  await lookAt(other, shots, 'drop-watching');
  await server.end('SIGTERM');
  await page.waitForSelector('.notice.warn[role=alert]');
  const address = page.url();
  await drop(['wedge.stl']);
  await page.waitForFunction(() => document.querySelector('frangia-app') !== null);
  expect(page.url() === address && (await page.locator('.notice').count()) === 1, `the page has gone to ${page.url()}`);
}, 'everything was dropped');
