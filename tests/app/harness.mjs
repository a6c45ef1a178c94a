// What the stories of the operator's app share: the server, Debian's Chromium, and the checks of every message and page.
import { spawn, spawnSync } from 'node:child_process';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import os from 'node:os';
import path from 'node:path';

const require = createRequire(path.resolve(process.env.FRANGIA_WEB ?? 'web', 'package.json'));
const here = import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname);

export const problems = [];
export const fail = (sentence) => problems.push(sentence);
export const expect = (condition, sentence) => {
  if (!condition) throw new Error(sentence);
};
/** How much slower the server may be, as a factor of limits of time: with sanitizers above 1. */
const slowdown = Number(process.env.FRANGIA_SLOWDOWN ?? 1);
/** By when an event has come, even on a busy machine, in milliseconds. */
export const PATIENCE = 120_000 * slowdown;
const begin = Date.now();
export const passed = (what) => console.log(`${((Date.now() - begin) / 1000).toFixed(1).padStart(6)} s  ${what}`);

const chromiumPath = ['/usr/bin/chromium', '/usr/bin/chromium-browser'].find((name) => fs.existsSync(name));
/** Ends the test with 77 where Chromium is missing. */
export function requireChromium() {
  if (chromiumPath) return;
  console.log('skipped: chromium is not installed (apt-get install chromium)');
  process.exit(77);
}

/** A draft: what is drawn and simulated needs no more pixels than the checks do. Not where people look at the pictures. */
export const isDraft = process.env.FRANGIA_DRAFT === '1';

let ajv;
/** Checks a message against a definition of docs/service-schema.json. */
export function check(name, value) {
  if (!ajv) {
    const Ajv = require('ajv').default;
    ajv = new Ajv({ strict: false, allErrors: true });
    ajv.addSchema(JSON.parse(fs.readFileSync(path.join(here, '../../docs/service-schema.json'), 'utf8')), 'schema');
  }
  const valid = ajv.getSchema(`schema#/definitions/${name}`);
  if (!valid) return fail(`the schema does not define ${name}`);
  if (!valid(value)) fail(`${name}: ${ajv.errorsText(valid.errors).slice(0, 400)}`);
}

/** Makes the camera of a project's simulated rig coarser, so that a test renders and decodes less. */
export function coarsenCamera(project, factor = 2) {
  for (const name of ['rig.toml', 'true-rig.toml']) {
    const file = path.join(project, name);
    if (!fs.existsSync(file)) continue;
    const scale = (text, key, change) => text.replace(new RegExp(`^${key} = \\[(.*)\\]$`, 'm'), (_, numbers) => `${key} = [${numbers.split(',').map(Number).map(change).join(', ')}]`);
    let text = fs.readFileSync(file, 'utf8');
    text = scale(text, 'size_px', (value) => Math.floor(value / factor));
    text = scale(text, 'focal_px', (value) => value / factor);
    text = scale(text, 'principal_point_px', (value) => (value + 0.5) / factor - 0.5);
    text = text.replace(/^samples = \d+$/m, 'samples = 1');
    fs.writeFileSync(file, text);
  }
}

/** From here on, a project's display shows each picture at once, which no frame has to wait for. */
export function makeDisplayPrompt(project) {
  const rig = path.join(project, 'rig.toml');
  const text = fs.readFileSync(rig, 'utf8');
  expect(/^latency_ms = /m.test(text) && /^delay_s = /m.test(text), 'the display is prompt already');
  fs.writeFileSync(rig, text.replace(/^(latency_ms|delay_s) = [\d.]+/gm, '$1 = 0'));
}

/** Opens a project again, as its files are now. */
export async function reopen(page, name) {
  await page.evaluate(async (name) => {
    const answer = await fetch('/api/commands/open-project', {
      method: 'POST', body: JSON.stringify({ name }),
      headers: { 'Content-Type': 'application/json', Authorization: `Bearer ${sessionStorage.getItem('frangia-key')}` },
    });
    if (!answer.ok) throw new Error(await answer.text());
  }, name);
  await idle(page);
}

/** Creates a project on the page whose simulated rig has a part, and opens it. */
export async function createProject(page, name, part, stations) {
  await page.waitForSelector('input[name=name]');
  await page.fill('input[name=name]', name);
  await page.selectOption('select[name=part]', part);
  await page.fill('input[name=stations]', String(stations));
  await page.getByText('Create', { exact: true }).click();
  await page.waitForSelector('[data-next=live]');
}

/** What ends each browser and server that was started, in their order. */
const endings = [];
/** The pages that were opened. */
const pages = [];

/** Tells what each open page shows, with a picture of it in `folder` if there is one: for whoever reads why a story broke off. */
async function describePages(folder) {
  let number = 0;
  for (const page of pages) {
    if (page.isClosed()) continue;
    const told = page.evaluate(() => {
      const app = document.querySelector('frangia-app');
      const jobs = app?.session.state?.jobs.map(({ number, kind, state, stage, error }) => [number, kind, state, stage, error].join(' '));
      return { step: app?.step, tool: app?.viewer.tool, link: app?.session.link, problem: app?.problem, unanswered: app?.session.unanswered, live: app?.session.state?.project?.live, jobs };
    });
    const patience = new Promise((resolve) => setTimeout(resolve, 20_000, 'the page does not answer'));
    console.log(`page ${++number}: ${JSON.stringify(await Promise.race([told, patience]).catch(String))}`);
    if (!folder) continue;
    const file = path.join(folder, `broken-off-${number}.png`);
    await page.screenshot({ path: file, timeout: 20_000 }).then(() => console.log(`  ${file}`), (error) => console.log(`  ${error.message}`));
  }
}

/** Runs a story; prints what went wrong, ends browsers and servers, removes the folder, and ends the process. */
export async function tell(home, story, ending) {
  let code = 1;
  try {
    await story();
    code = problems.length === 0 ? 0 : 1;
  } catch (error) {
    console.log(error.stack ?? error);
    await describePages(process.argv[3] && fs.existsSync(process.argv[3]) ? process.argv[3] : null);
  } finally {
    for (const sentence of new Set(problems)) console.log(`wrong: ${sentence}`);
    for (const end of endings.reverse()) await end();
    fs.rmSync(home, { recursive: true, force: true });
  }
  passed(code === 0 ? ending : 'the story broke off');
  process.exit(code);
}

export const newHome = () => fs.mkdtempSync(path.join(os.tmpdir(), 'frangia-story-'));

/** Starts a server whose projects and runtime file are in a folder. */
export async function startServer(program, home, ...more) {
  const process_ = spawn(program, ['--json', 'serve', ...(more.includes('--port') ? [] : ['--port', '0']), '--projects', path.join(home, 'projects'), ...more], {
    env: { ...process.env, XDG_RUNTIME_DIR: home },
  });
  const url = await new Promise((resolve, reject) => {
    let text = '';
    process_.stdout.on('data', (block) => {
      text += block;
      try {
        resolve(JSON.parse(text).url);
      } catch {
        // not complete yet
      }
    });
    process_.on('exit', () => reject(new Error('the server ended')));
  });
  const end = (signal) => {
    if (process_.exitCode !== null || process_.signalCode !== null) return undefined;
    const ended = new Promise((resolve) => process_.on('exit', resolve));
    process_.kill(signal);
    return ended;
  };
  endings.push(() => end('SIGTERM'));
  return { url, end };
}

export function newLink(program, home) {
  const asked = spawnSync(program, ['serve', '--new-link'], { env: { ...process.env, XDG_RUNTIME_DIR: home }, encoding: 'utf8' });
  expect(asked.status === 0, `no new link: ${asked.stderr}`);
  return asked.stdout.trim();
}

/** Chromium with more arguments; without WebGL if that is wanted. */
export async function launch({ webgl = true, more = [] } = {}) {
  const browser = await require('playwright-core').chromium.launch({
    executablePath: chromiumPath,
    args: ['--headless', '--no-sandbox', '--disable-gpu', '--disable-background-networking', '--no-first-run', '--disable-dev-shm-usage',
      ...(webgl ? ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'] : ['--disable-3d-apis']), ...more],
  });
  endings.push(() => browser.close());
  return browser;
}

/** The stages of jobs that the message catalogue of the page names. */
const STAGES = new Set([...fs.readFileSync(path.join(here, '../../web/src/messages/frame.ts'), 'utf8').matchAll(/'stage\.([\w-]+)'/g)].map(([, stage]) => stage));

/** A page all of whose messages are checked. `expected` matches what the console may say beside what it always may. */
export async function openPage(browser, url, viewport = { width: 1440, height: 900 }, { expected = /^$/, ...more } = {}) {
  // A processor draws here, for each pixel of the screen; boxes, words and clicks are measured in those of CSS.
  const deviceScaleFactor = isDraft ? 0.5 : 1;
  const context = await browser.newContext({ viewport, deviceScaleFactor, colorScheme: 'dark', locale: 'en-GB', ...more });
  const page = await context.newPage();
  page.setDefaultTimeout(PATIENCE);
  // Not by the page's own policy, which forbids it.
  await page.addInitScript(fs.readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8'));
  page.on('pageerror', (error) => fail(`the page: ${error.message}`));
  page.on('console', (message) => {
    const text = message.text();
    if (message.type() === 'error' && !/GL Driver|403|404|409|ERR_CONNECTION|WebSocket/.test(text) && !expected.test(text)) fail(`the page says: ${text.slice(0, 300)}`);
  });
  pages.push(page);
  page.on('request', (request) => {
    const { pathname, origin } = new URL(request.url());
    if (origin !== new URL(url).origin && !request.url().startsWith('blob:')) fail(`the page asked for ${request.url()}`);
    const command = pathname.match(/^\/api\/commands\/(.+)$/);
    if (command) check(`commands/${command[1]}`, request.postDataJSON());
    if (pathname === '/api/pick') check('ray', request.postDataJSON());
    if (pathname === '/api/session') check('session', request.postDataJSON());
  });
  page.on('websocket', (socket) => {
    socket.on('framesent', ({ payload }) => {
      const message = JSON.parse(payload);
      check(message.type === 'show' ? 'show' : 'hello', message);
    });
    socket.on('framereceived', ({ payload }) => {
      if (typeof payload !== 'string') return;
      const message = JSON.parse(payload);
      check('live', message);
      for (const { stage } of message.state?.jobs ?? []) if (stage && !STAGES.has(stage)) fail(`the page has no word for the stage ${stage}`);
    });
  });
  await page.goto(url);
  return page;
}

/** The rules of axe that another theme can break. */
export const COLORS = { runOnly: { type: 'rule', values: ['color-contrast', 'link-in-text-block'] } };

/** Runs axe on the page as it is, or on a part of it. */
export async function axe(page, name, options = {}, part = 'html') {
  const found = await page
    .evaluate(async ([options, part]) => (await window.axe.run(document.querySelector(part), { resultTypes: ['violations'], ...options })).violations.map((one) => `${one.id}: ${one.nodes.map((node) => node.target).slice(0, 3)}`), [options, part])
    .catch((error) => [`axe: ${error.message}`]);
  for (const violation of found) fail(`${name}: ${violation}`);
}

/** Waits until the page has drawn what it knows and nothing moves. */
export const settled = (page) =>
  page.waitForFunction(async () => {
    const app = document.querySelector('frangia-app');
    await app.updateComplete;
    await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
    return app.viewer.atRest;
  });

/** In the page: what is cut off, has no room, or is one primary button too many. */
export function faultsOfLayout() {
  const faults = [];
  const shown = (element) => {
    const { width, height } = element.getBoundingClientRect();
    return width > 0 && height > 0 && element.checkVisibility({ checkVisibilityCSS: true });
  };
  const words = (element) => `${element.tagName.toLowerCase()} "${element.textContent.trim().replace(/\s+/g, ' ').slice(0, 40)}"`;
  if (document.documentElement.scrollWidth > innerWidth + 1) faults.push('the page scrolls sideways');
  for (const main of document.querySelectorAll('main')) {
    if (main.getBoundingClientRect().height < 0.3 * innerHeight) faults.push('the page has no room');
  }
  // What scrolls sideways by itself may end beyond the edge.
  for (const element of document.querySelectorAll('button, label, h1, h2, h3, p, dt, dd, summary, th, td')) {
    if (!shown(element) || element.closest('.sr, nav, .layers, .command')) continue;
    const { left, right } = element.getBoundingClientRect();
    if (left < -2 || right > innerWidth + 2) faults.push(`${words(element)} is beyond the edge`);
    if (element.children.length === 0 && element.scrollWidth > element.clientWidth + 2 && element.clientWidth > 0 && getComputedStyle(element).textOverflow !== 'ellipsis')
      faults.push(`${words(element)} is cut off`);
  }
  for (const dialog of document.querySelectorAll('dialog[open]')) {
    const { left, right, top, bottom } = dialog.getBoundingClientRect();
    if (left < 0 || right > innerWidth || top < 0 || bottom > innerHeight || dialog.scrollWidth > dialog.clientWidth) faults.push(`the dialog ${dialog.id} is beyond the edge`);
  }
  const ends = [...document.querySelectorAll('.brand > *')].filter(shown).map((one) => one.getBoundingClientRect());
  const steps = document.querySelector('.steps')?.getBoundingClientRect();
  for (const { right, top, bottom } of ends)
    if (steps && right > steps.left + 1 && top < steps.bottom && bottom > steps.top) faults.push('the steps cover what stands before them');
  const primary = [...document.querySelectorAll('.btn.primary')].filter(shown);
  const modal = document.querySelector('dialog[open]');
  if (!modal && primary.length > 1) faults.push(`more than one primary button: ${primary.map(words).join(', ')}`);
  return faults;
}

/** Takes a screenshot, looks for what is cut off, and runs axe on the page. */
export async function look(page, folder, name) {
  await settled(page);
  await page.screenshot({ path: path.join(folder, `${name}.png`) });
  for (const fault of await page.evaluate(faultsOfLayout)) fail(`${name}: ${fault}`);
  await axe(page, name);
  passed(name);
}

export const stateOf = (page) =>
  page.evaluate(async () => (await fetch('/api/state', { headers: { Authorization: `Bearer ${sessionStorage.getItem('frangia-key')}` } })).json());

/**
 * Waits for the next state that the server sends the page after the one that was noted as `stateSeen`, until `deadline`, in
 * milliseconds of the clock: states that come again and again, as of a live preview, do not prolong it.
 */
const nextState = async (page, deadline) => {
  const timeout = Math.min(PATIENCE, deadline - Date.now());
  if (timeout <= 0) throw new Error('too late');
  await page.waitForFunction(() => document.querySelector('frangia-app')?.session.state !== window.stateSeen, null, { timeout });
};
/** How long what a story waits for may take, in milliseconds. */
const LONGEST_WAIT = 5 * PATIENCE;

/** Asks the server for its state, again whenever it sends the page a new one, until it is as wanted; returns it. */
export async function waitForState(page, wanted, longest = LONGEST_WAIT) {
  const deadline = Date.now() + longest;
  for (;;) {
    // Noted before the question, so that no state is missed that comes meanwhile.
    await page.evaluate(() => (window.stateSeen = document.querySelector('frangia-app')?.session.state));
    const state = await stateOf(page);
    if (wanted(state)) return state;
    await nextState(page, deadline).catch(() => expect(false, `the state does not come: ${wanted}; the jobs are ${JSON.stringify(state.jobs)}`));
  }
}

/** Number of the last job that failed; 0 without any. */
export const lastFailure = async (page) => Math.max(0, ...(await stateOf(page)).jobs.filter((job) => job.state === 'failed').map((job) => job.number));

/** Waits until the open project, as the page knows it and has drawn it, is as wanted; returns it. A job that fails and has a number above `forgiven` ends the wait with its error. */
export async function waitForProject(page, what, wanted, forgiven = 0, longest = LONGEST_WAIT) {
  const deadline = Date.now() + longest;
  for (;;) {
    const { project, jobs } = await page.evaluate(async () => {
      const app = document.querySelector('frangia-app');
      window.stateSeen = app.session.state;
      await app.updateComplete;
      return window.stateSeen;
    });
    if (wanted(project)) return project;
    const failed = jobs.find((job) => job.state === 'failed' && job.number > forgiven);
    expect(!failed, `${what}: ${failed?.error}`);
    await nextState(page, deadline).catch(() => expect(false, `${what} does not come; the jobs are ${JSON.stringify(jobs)}`));
  }
}

const unfinished = ({ kind, state }) => kind !== 'live' && (state === 'waiting' || state === 'running');

/** Waits until everything that the page asked for is answered and done, and the page has heard of it and drawn it. The preview may go on. */
export async function idle(page) {
  for (;;) {
    await page.waitForFunction(() => document.querySelector('frangia-app').session.unanswered === 0);
    const { jobs, project } = await waitForState(page, (state) => !state.jobs.some(unfinished));
    await page.waitForFunction(async ([last, revision]) => {
      const app = document.querySelector('frangia-app');
      await app.updateComplete;
      const { jobs, project } = app.session.state;
      return (jobs.at(-1)?.number ?? 0) >= last && (project?.revision ?? 0) >= revision;
    }, [jobs.at(-1)?.number ?? 0, project?.revision ?? 0]);
    // What was answered meanwhile may have started a job, or brought something to draw.
    const known = await page.evaluate(async () => {
      const app = document.querySelector('frangia-app');
      await app.updateComplete;
      return app.session.unanswered === 0 ? app.session.state.jobs : null;
    });
    if (known && !known.some(unfinished) && !(await stateOf(page)).jobs.some(unfinished)) return;
    await page.evaluate(() => new Promise(requestAnimationFrame));
  }
}

/** A binary STL of triangles, each of three corners in mm. */
export function stlOf(triangles) {
  const bytes = Buffer.alloc(84 + 50 * triangles.length);
  bytes.writeUInt32LE(triangles.length, 80);
  triangles.forEach((corners, i) => corners.flat().forEach((value, k) => bytes.writeFloatLE(value, 84 + 50 * i + 12 + 4 * k)));
  return bytes;
}

/** Makes a project whose surface is these triangles; returns its folder. */
export function newProject(program, home, name, triangles) {
  const folder = path.join(home, 'projects', name);
  fs.mkdirSync(folder, { recursive: true });
  fs.writeFileSync(path.join(folder, 'project.json'), '{"format": "frangia-project", "version": 1}\n');
  const stl = path.join(home, `${name}.stl`);
  fs.writeFileSync(stl, stlOf(triangles));
  const made = spawnSync(program, ['edit', stl, '-o', path.join(folder, 'surface.ply')], { encoding: 'utf8' });
  if (made.status !== 0) throw new Error(made.stderr);
  return folder;
}
