// The part is scanned, turned over, scanned again and joined: dials, guide, colours by setup and the join in words.
//
//   node setups.mjs PROGRAM FOLDER      FOLDER receives the screenshots
import fs from 'node:fs';
import path from 'node:path';
import { check, coarsenCamera, createProject, expect, idle, launch, look, newHome, openPage, passed, requireChromium, startServer, stateOf, tell } from './harness.mjs';

const [program, shots] = process.argv.slice(2).map((name) => path.resolve(name));
requireChromium();
fs.mkdirSync(shots, { recursive: true });
const home = newHome();
const STATIONS = 5;

await tell(home, async () => {
  const server = await startServer(program, home);
  const browser = await launch();
  const page = await openPage(browser, server.url, { width: 1280, height: 800 });
  await createProject(page, 'Bust', 'bust', STATIONS);
  coarsenCamera(path.join(home, 'projects', 'Bust'), 3);
  await page.keyboard.press('4');
  await page.click('#scan:not([disabled])');
  await page.waitForSelector('#build:not([disabled])');
  passed('the first setup is scanned');

  await page.click('#turn-over');
  await page.waitForSelector('.turning');
  await look(page, shots, 'turn-over');
  await page.click('#scan-setup');
  await page.waitForFunction(() => document.querySelectorAll('.seg input[name=Setups]').length === 2);
  await page.waitForSelector('#build:not([disabled])');
  const { project } = await stateOf(page);
  check('state', await stateOf(page));
  expect(project.stations.length === 2 * STATIONS, `${project.stations.length} stations`);
  expect(project.stations.every((station, i) => station.setup === Math.floor(i / STATIONS) && station.state === 'done'), 'the stations of the setups are mixed up');
  expect(project.commands.scan.join(' ').includes(`--views ${STATIONS} --setup 1`), 'the command line does not name the setup');
  expect((await page.locator('.dial-station.done').count()) === STATIONS, 'the dial does not show the stations of one setup');
  await page.getByText('Setup 1', { exact: true }).click();
  await page.waitForFunction(() => [...document.querySelectorAll('.rescan')].every((button) => button.disabled));
  await page.getByText('Setup 2', { exact: true }).click();
  await look(page, shots, 'setups');
  const toml = fs.readFileSync(path.join(home, 'projects', 'Bust', 'scan', 'scan.toml'), 'utf8');
  expect(toml.match(/^setup = 1$/gm)?.length === STATIONS, 'scan.toml does not hold the second setup');

  await page.click('#build');
  await page.waitForSelector('.joins');
  await idle(page);
  const before = (await stateOf(page)).project;
  const { setups } = before.surface.summary;
  const [, second] = setups;
  expect(setups.length === 2 && second.joined && second.overlap > 0.3, `the setups do not join: ${JSON.stringify(setups)}`);
  expect(Math.abs(second.turned_deg - 180) < 2, `turned by ${second.turned_deg}`);
  expect(/Setup 2 is joined.*trusted/s.test(await page.locator('.joins').innerText()), 'the join is not told in words');
  expect((await page.locator('.swatches span').count()) === 3, 'no legend of the setups');
  await page.waitForFunction(() => document.querySelector('frangia-app').meshes.fine);
  await look(page, shots, 'joined');
  // The top of the head was measured by the first setup alone, the underside of the base by the second.
  const colors = await page.evaluate(async (text) => {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes]));
    const pen = new OffscreenCanvas(image.width, image.height).getContext('2d');
    pen.drawImage(image, 0, 0);
    const { data } = pen.getImageData(0, 0, image.width, image.height);
    const seen = { blue: 0, orange: 0, grey: 0 };
    for (let i = 0; i < data.length; i += 4) {
      const [r, g, b] = [data[i], data[i + 1], data[i + 2]];
      if (b > 1.5 * r && b > 90) seen.blue++;
      else if (r > 1.6 * b && g > 1.25 * b && r > 90) seen.orange++;
      else if (r > 120 && Math.abs(r - b) < 40) seen.grey++;
    }
    return seen;
  }, (await page.locator('.view-canvas').screenshot()).toString('base64'));
  expect(colors.blue > 1000 && colors.orange > 50 && colors.grey > 1000, `the setups have no colours of their own: ${JSON.stringify(colors)}`);
  await page.keyboard.press('4');
  await page.waitForSelector('.joins');

  // A setup that fits nowhere, since it shows another part: said in words, and nothing that was joined is lost.
  const rig = path.join(home, 'projects', 'Bust', 'rig.toml');
  for (const file of [rig, path.join(home, 'projects', 'Bust', 'scan', 'capture', 'devices.txt')]) {
    const text = fs.readFileSync(file, 'utf8');
    expect(/part = "?bust/.test(text), `${file} names no part`);
    fs.writeFileSync(file, text.replace(/part = ("?)bust/, 'part = $1shaft'));
  }
  await page.click('#turn-over');
  await page.click('#scan-setup');
  await page.waitForFunction(() => document.querySelectorAll('.seg input[name=Setups]').length === 3);
  await page.waitForSelector('#build:not([disabled])');
  await page.click('#build');
  await page.waitForFunction(() => (document.querySelector('frangia-app').state.project.surface.summary.setups ?? []).length === 3);
  await page.waitForSelector('.joins >> text=Setup 3');
  const told = await page.locator('.joins').innerText();
  expect(/Setup 2 is joined/.test(told) && /Setup 3 fits .* and is left out.*[Ss]can/s.test(told), `the failed join is told as ${told}`);
  const after = (await stateOf(page)).project;
  expect(after.surface.summary.setups.map((setup) => setup.joined).join() === 'true,true,false', 'another setup was joined');
  expect(after.stations.length === 3 * STATIONS && after.stations.every((station) => station.state === 'done'), 'stations were lost');
  expect(after.surface.triangles > 0.8 * before.surface.triangles, `the surface has ${after.surface.triangles} triangles instead of ${before.surface.triangles}`);
  await idle(page);
  await page.locator('.joins').scrollIntoViewIfNeeded();
  await look(page, shots, 'not-joined');
}, 'the setups are joined, and one that fits nowhere is left out');
