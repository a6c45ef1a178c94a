// Times of the operator's app in Debian's Chromium with software rendering, for `./run bench` and `./run figures app`.
//
//   node figures.mjs PROGRAM [REPEATS] [--json]
//
// Prints one JSON object. first_paint_s: the start of `frangia serve` until it prints its address, and from the navigation
// there to the first contentful paint, in a browser that is running. live: the preview replays a recorded scan at 640 x 512 through the driver `folder`, while the page shows a
// layer of it; what the page receives is counted.
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { expect, launch, newHome, openPage, problems, requireChromium, startServer, stateOf } from './harness.mjs';

const program = path.resolve(process.argv[2]);
const WATCHED_S = 6;
const repeats = Number(process.argv.slice(3).find((word) => word !== '--json') ?? 5);
requireChromium();
const sorted = (values) => [...values].sort((a, b) => a - b);
const median = (values) => sorted(values)[Math.floor(values.length / 2)];

async function firstPaint(browser) {
  const home = newHome();
  const begin = Date.now();
  const server = await startServer(program, home);
  const started = Date.now();
  const page = await openPage(browser, server.url);  // a tab of its own takes time that a person's browser does not
  const painted = await page.evaluate(async () => {
    const paint = () => performance.getEntriesByName('first-contentful-paint')[0];
    while (!paint()) await new Promise((resolve) => setTimeout(resolve, 10));
    return paint().startTime;
  });
  await page.waitForSelector('#try');
  await page.context().close();
  await server.end('SIGTERM');
  fs.rmSync(home, { recursive: true, force: true });
  return (started - begin + painted) / 1000;
}

/** The "values" of a packed message. */
function valuesOf(message) {
  const length = message.readUInt32LE(0);
  return JSON.parse(message.subarray(4, 4 + length).toString('utf8')).values;
}

/** Messages of each layer a second, and the decodes a second that the server counts, over some seconds. */
async function live(browser) {
  const home = newHome();
  const server = await startServer(program, home);
  const page = await openPage(browser, server.url);
  const messages = [];
  await page.waitForSelector('#try');
  await page.click('#try');
  await page.waitForSelector('#test-devices');  // of the step Rig, where a new project begins
  const [name] = fs.readdirSync(path.join(home, 'projects'));
  const rig = path.join(home, 'projects', name, 'rig.toml');
  const recorded = spawnSync(program, ['scan', rig, '-o', path.join(home, 'recorded'), '--views', '1'], { encoding: 'utf8' });
  expect(recorded.status === 0, `nothing was recorded: ${recorded.stderr}`);
  const text = fs.readFileSync(rig, 'utf8');
  const camera = /\[devices\.camera\]\n(?:[^[\n].*\n)+/;
  expect(camera.test(text), 'the rig has no camera');
  fs.writeFileSync(rig, text.replace(camera, `[devices.camera]\ndriver = "folder"\nfolder = "${path.join(home, 'recorded')}"\n`));
  const watched = new Promise((resolve) => page.once('websocket', resolve));
  await page.reload();
  (await watched).on('framereceived', ({ payload }) => {
    if (typeof payload !== 'string') messages.push({ at: Date.now(), ...valuesOf(payload) });
  });
  await page.waitForSelector('main.panel');
  await page.keyboard.press('3');
  const shown = {};
  for (const layer of ['Depth', 'Points']) {
    await page.locator('.layers').getByText(layer, { exact: true }).click();
    await page.waitForTimeout(3000);
    messages.length = 0;
    await page.waitForTimeout(1000 * WATCHED_S);
    const values = messages.filter((message) => message.layer === layer.toLowerCase());
    expect(values.length > 0 && values.at(-1).points > 5000, `no ${layer} came: ${JSON.stringify(values.at(-1))}`);
    shown[layer.toLowerCase()] = {
      messages_per_s: values.length / WATCHED_S,
      decodes_per_s: median(values.map((value) => value.decodes_per_s)),
      decode_ms: median(values.map((value) => value.decode_ms)),
    };
  }
  const state = await stateOf(page);
  expect(state.jobs.every((job) => job.state !== 'failed'), JSON.stringify(state.jobs));
  await page.context().close();
  await server.end('SIGTERM');
  fs.rmSync(home, { recursive: true, force: true });
  return shown;
}

const browser = await launch();
try {
  await firstPaint(browser);  // the browser's own first page
  const paints = [];
  for (let i = 0; i < repeats; i++) paints.push(await firstPaint(browser));
  const figures = { first_paint_s: { median: median(paints), least: sorted(paints)[0], most: sorted(paints).at(-1) }, live: await live(browser) };
  expect(problems.length === 0, problems.join('\n'));
  console.log(JSON.stringify(figures));
} finally {
  await browser.close();
}
