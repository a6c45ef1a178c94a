// The story of the operator's app in Debian's Chromium: from an empty table to an edited DXF on the simulated rig.
//
//   node story.mjs PROGRAM FOLDER      FOLDER receives the screenshots
//
// FRANGIA_WEB names the folder whose node_modules holds playwright-core, ajv and axe-core. Every message of the page and of
// the server is checked against docs/service-schema.json, and every page by axe. Ends with 77 where Chromium is missing.
import { spawn, spawnSync } from 'node:child_process';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import os from 'node:os';
import path from 'node:path';

const [program, shots] = process.argv.slice(2).map((name) => path.resolve(name));
const require = createRequire(path.join(process.env.FRANGIA_WEB ?? 'web', 'package.json'));
const chromiumPath = ['/usr/bin/chromium', '/usr/bin/chromium-browser'].find((name) => fs.existsSync(name));
if (!chromiumPath) {
  console.log('skipped: chromium is not installed (apt-get install chromium)');
  process.exit(77);
}
const { chromium } = require('playwright-core');
const Ajv = require('ajv').default;
const axe = fs.readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');
const schemaFile = path.join(import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname), '../../docs/service-schema.json');
const ajv = new Ajv({ strict: false, allErrors: true });
ajv.addSchema(JSON.parse(fs.readFileSync(schemaFile, 'utf8')), 'schema');

const problems = [];
const fail = (sentence) => problems.push(sentence);
const expect = (condition, sentence) => {
  if (!condition) throw new Error(sentence);
};
function check(name, value) {
  const valid = ajv.getSchema(`schema#/definitions/${name}`);
  if (!valid) return fail(`the schema does not define ${name}`);
  if (!valid(value)) fail(`${name}: ${ajv.errorsText(valid.errors).slice(0, 400)}`);
}

const home = fs.mkdtempSync(path.join(os.tmpdir(), 'frangia-story-'));
fs.mkdirSync(shots, { recursive: true });
const begin = Date.now();
const passed = (what) => console.log(`${((Date.now() - begin) / 1000).toFixed(1).padStart(6)} s  ${what}`);
const server = spawn(program, ['--json', 'serve', '--port', '0', '--projects', path.join(home, 'projects')], {
  env: { ...process.env, XDG_RUNTIME_DIR: home },
});
let code = 1;
let browser;
try {
  const url = await new Promise((resolve, reject) => {
    let text = '';
    server.stdout.on('data', (block) => {
      text += block;
      try {
        resolve(JSON.parse(text).url);
      } catch {
        // not complete yet
      }
    });
    server.on('exit', () => reject(new Error('the server ended')));
  });
  browser = await chromium.launch({
    executablePath: chromiumPath,
    args: ['--headless', '--no-sandbox', '--disable-gpu', '--use-gl=angle', '--use-angle=swiftshader',
      '--enable-unsafe-swiftshader', '--disable-background-networking', '--no-first-run', '--disable-dev-shm-usage'],
  });
  const context = await browser.newContext({ viewport: { width: 1440, height: 900 }, colorScheme: 'dark', locale: 'en-GB' });
  const page = await context.newPage();
  await page.addInitScript(axe); // not by the page's own policy, which forbids it
  page.on('pageerror', (error) => fail(`the page: ${error.message}`));
  page.on('console', (message) => {
    const text = message.text();
    if (message.type() === 'error' && !/GL Driver|404/.test(text)) fail(`the page says: ${text.slice(0, 300)}`);
  });
  page.on('request', (request) => {
    const { pathname, origin } = new URL(request.url());
    if (origin !== new URL(url).origin && !request.url().startsWith('blob:')) fail(`the page asked for ${request.url()}`);
    const command = pathname.match(/^\/api\/commands\/(.+)$/);
    if (command) check(`commands/${command[1]}`, request.postDataJSON());
    if (pathname === '/api/session') check('session', request.postDataJSON());
  });
  page.on('websocket', (socket) => {
    socket.on('framesent', ({ payload }) => check('hello', JSON.parse(payload)));
    socket.on('framereceived', ({ payload }) => check('live', JSON.parse(payload)));
  });
  const look = async (name) => {
    await page.waitForTimeout(250);
    await page.screenshot({ path: path.join(shots, `${name}.png`) });
    const found = await page.evaluate(async () =>
      (await window.axe.run(document)).violations.map((one) => `${one.id}: ${one.nodes.map((node) => node.target).slice(0, 3)}`),
    ).catch((error) => [`axe: ${error.message}`]);
    for (const violation of found) fail(`${name}: ${violation}`);
    passed(name);
  };
  const idle = () => page.waitForFunction(() => !document.querySelector('.foot .bar'), null, { timeout: 90_000 });
  const text = (selector) => page.locator(selector).first().innerText();

  await page.goto(url);
  await page.waitForSelector('#try');
  expect(!page.url().includes('token'), 'the token stays in the address');
  await look('project');

  await page.click('#try');
  await page.waitForSelector('#scan');
  await page.click('#scan');
  await page.waitForFunction(() => document.querySelectorAll('.dial-station.done, .dial-station.poor').length >= 5, null, { timeout: 90_000 });
  await look('scan');
  await page.waitForSelector('#build:not([disabled])', { timeout: 90_000 });
  await page.click('#build');
  await page.waitForSelector('.figures', { timeout: 90_000 });
  await idle();
  await page.waitForTimeout(600);
  await page.getByText('Sigma', { exact: true }).click();
  await look('surface');

  await page.getByText('None', { exact: true }).click();
  await page.getByText('x', { exact: true }).click();
  await page.keyboard.press('m');
  const canvas = await page.locator('.view-canvas').boundingBox();
  const at = (x, y) => [canvas.x + x * canvas.width, canvas.y + y * canvas.height];
  await page.mouse.click(...at(0.5, 0.42));
  await page.mouse.click(...at(0.5, 0.68));
  await page.waitForSelector('.chip .big');
  expect(/\d mm/.test(await text('.chip .big')), 'no distance was measured');
  await look('section');
  await page.getByText('Off', { exact: true }).click();

  await page.keyboard.press('4');
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
  const state = async () =>
    page.evaluate(async () => (await fetch('/api/state', { headers: { Authorization: `Bearer ${sessionStorage.getItem('frangia-key')}` } })).json());
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
  await page.waitForFunction(() => document.querySelectorAll('.history li').length === 3);
  await idle();
  const filled = (await state()).project.surface;
  expect(filled.hole_count < holed.hole_count, 'no hole was filled');
  await page.getByText('Turn', { exact: true }).click();
  await page.keyboard.press('3');
  await page.getByText('Marks', { exact: true }).click();
  await look('filled');

  await page.keyboard.press('5');
  await page.waitForSelector('#export');
  await page.getByText('50,000', { exact: true }).click();
  await page.click('#export');
  await page.waitForSelector('.file', { timeout: 60_000 });
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
  await page.keyboard.press('4');
  await page.getByText('Deutsch').click();
  await look('edit-light');
  await page.keyboard.press('?');
  await page.waitForSelector('dialog[open]');
  await look('keys');

  // Another page of the same browser has neither the key nor the right to ask.
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
  expect(after.steps_done === filled.steps_done, 'a page of another origin acted');
  code = problems.length === 0 ? 0 : 1;
} catch (error) {
  console.log(error.stack ?? error);
} finally {
  for (const sentence of new Set(problems)) console.log(`wrong: ${sentence}`);
  await browser?.close();
  server.kill('SIGTERM');
  await new Promise((resolve) => server.on('exit', resolve));
  fs.rmSync(home, { recursive: true, force: true });
}
passed(code === 0 ? 'the story is told' : 'the story broke off');
process.exit(code);
