// axe finds no violation, and nothing is cut off: on every step and in every dialog, in three sizes and at 200 % zoom, in both
// themes and in each language.
//
//   node accessible.mjs PROGRAM
import path from 'node:path';
import { axe, coarsenCamera, COLORS, expect, fail, faultsOfLayout, launch, newHome, newLink, openPage, passed, requireChromium, startServer, tell, waitForState } from './harness.mjs';

const program = path.resolve(process.argv[2]);
requireChromium();
const home = newHome();
const server = await startServer(program, home);

async function command(page, name, argument = {}) {
  await page.evaluate(async ([name, argument]) => {
    const answer = await fetch(`/api/commands/${name}`, {
      method: 'POST', body: JSON.stringify(argument),
      headers: { 'Content-Type': 'application/json', Authorization: `Bearer ${sessionStorage.getItem('frangia-key')}` },
    });
    if (!answer.ok) throw new Error(`${name}: ${await answer.text()}`);
  }, [name, argument]);
  await waitForState(page, ({ jobs }) => !jobs.some((job) => ['waiting', 'running'].includes(job.state) && job.kind !== 'live'));
}


/** In the page: shows it in the other theme. */
function otherTheme() {
  const { dataset } = document.documentElement;
  dataset.theme = dataset.theme === 'light' ? 'dark' : 'light';
}

/** The sizes, the last two as a page of 1366 x 768 and of 3840 x 2160 is at 200 % zoom; each in another language. */
const SIZES = [[1366, 768, 'en'], [360, 800, 'de'], [3840, 2160, 'it'], [683, 384, 'it'], [1920, 1080, 'de']];

await tell(home, async () => {
  const browser = await launch();
  const page = await openPage(browser, server.url, { width: 1366, height: 768 }, { reducedMotion: 'reduce' });
  await page.waitForSelector('#try');
  // axe sees no pixel of the picture: few are drawn of it.
  const coarsen = () => page.evaluate(() => document.querySelector('frangia-app').viewer.renderer.setPixelRatio(0.1));
  await coarsen();
  /** Waits for the words and boxes of the page; the picture beside them may still be drawn. */
  const drawn = () => page.evaluate(() => document.querySelector('frangia-app').updateComplete);
  const looked = () => page.evaluate(() => [document.documentElement.dataset.theme, document.documentElement.lang]);
  /** Looks at the page as it is, in each theme: contrast depends on it, nothing else does. */
  const inEachTheme = async (name) => {
    await drawn();
    await axe(page, `${name}, ${await looked()}`);
    for (const fault of await page.evaluate(faultsOfLayout)) fail(`${name}, ${await looked()}: ${fault}`);
    await page.evaluate(otherTheme);
    await axe(page, `${name}, ${await looked()}`, COLORS);
    await page.evaluate(otherTheme);
  };
  /** In each size, with its language. */
  const inEachSize = async (see) => {
    for (const [width, height, language] of SIZES) {
      await page.setViewportSize({ width, height });
      await page.selectOption('#language', language);
      await see(`${width} x ${height}`);
      passed(`${width} x ${height}, ${language}`);
    }
  };
  await inEachSize((size) => inEachTheme(`no project, ${size}`));
  // What was chosen outlives the page.
  await page.click('[data-tool=theme]');
  const chosen = await looked();
  await page.reload();
  await page.waitForSelector('.tools');
  await coarsen();
  expect(String(await looked()) === String(chosen), `the page is ${await looked()} instead of ${chosen}`);

  await command(page, 'create-project', { name: 'Plate', part: 'plate', stations: 3 });
  coarsenCamera(path.join(home, 'projects', 'Plate'), 4);
  const steps = async (keys, when) =>
    inEachSize(async (size) => {
      for (const key of keys) {
        await page.keyboard.press(key);
        if (key === '3') await page.waitForSelector('#live-points');
        await inEachTheme(`step ${key}${when}, ${size}`);
      }
    });
  await steps(['2', '4'], ' before the scan');
  await command(page, 'start-scan');
  await command(page, 'reconstruct');
  await command(page, 'edit', { operation: 'fill-holes', value: '5mm' });
  await command(page, 'select-component-of', { triangle: 0 });
  await command(page, 'export', { format: 'stl' });
  await steps(['1', '2', '4', '5', '6', '7', '8', '3'], '');
  // Every dialog, whatever opens it.
  const dialogs = await page.evaluate(() => [...document.querySelectorAll('dialog')].map((one) => one.id));
  expect(dialogs.includes('keys') && dialogs.includes('link'), `the dialogs are ${dialogs}`);
  await page.keyboard.press('5');
  await inEachSize(async (size) => {
    for (const id of dialogs) {
      if (id === 'link') await page.click('[data-tool=link]');
      else await page.evaluate((name) => document.getElementById(name).showModal(), id);
      await page.waitForSelector(`#${id}[open]`);
      if (id === 'link') await page.waitForSelector('#link .linkbox');
      await inEachTheme(`dialog ${id}, ${size}`);
      await page.keyboard.press('Escape');
      await page.waitForSelector(`#${id}[open]`, { state: 'detached' });
    }
  });
  await page.selectOption('#language', 'en');

  // What others see: a browser that watches, one without a key, and both after the server is gone.
  const watching = await openPage(browser, newLink(program, home));
  await watching.waitForSelector('#take-over');
  await axe(watching, 'watching');
  const stranger = await openPage(browser, new URL(server.url).origin);
  await stranger.waitForSelector('.blank code');
  await axe(stranger, 'without a key');
  await stranger.emulateMedia({ colorScheme: 'light' });
  await axe(stranger, 'without a key, light');
  await server.end('SIGTERM');
  await page.waitForSelector('.notice.warn[role=alert]');
  await axe(page, 'the server is gone');
}, 'axe finds no violation');
