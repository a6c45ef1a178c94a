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

/** The sizes, each in another language; the last two, as a page of 1366 x 768 and of 3840 x 2160 is at 200 % zoom, in one theme. */
const SIZES = [
  { width: 1366, height: 768, language: 'en', themes: ['dark', 'light'] },
  { width: 360, height: 800, language: 'de', themes: ['light', 'dark'] },
  { width: 3840, height: 2160, language: 'it', themes: ['dark', 'light'] },
  { width: 683, height: 384, language: 'it', themes: ['light'] },
  { width: 1920, height: 1080, language: 'de', themes: ['dark'] },
];

await tell(home, async () => {
  const browser = await launch();
  const page = await openPage(browser, server.url, { width: 1366, height: 768 }, { reducedMotion: 'reduce' });
  await page.waitForSelector('#try');
  // axe sees no pixel of the picture: few are drawn of it.
  const coarsen = () => page.evaluate(() => document.querySelector('frangia-app').viewer.renderer.setPixelRatio(0.1));
  await coarsen();
  /** Shows a theme, and waits for the words and boxes of the page; the picture beside them may still be drawn. */
  const show = (theme) =>
    page.evaluate((theme) => {
      document.documentElement.dataset.theme = theme;
      return document.querySelector('frangia-app').updateComplete;
    }, theme);
  const looked = () => page.evaluate(() => [document.documentElement.dataset.theme, document.documentElement.lang]);
  /** Looks at the page as it is, in each theme: contrast depends on it, nothing else does. */
  const inEachTheme = async (name, { themes }, part) => {
    for (const [i, theme] of themes.entries()) {
      await show(theme);
      await axe(page, `${name}, ${theme}`, i === 0 ? {} : COLORS, part);
    }
    for (const fault of await page.evaluate(faultsOfLayout)) fail(`${name}: ${fault}`);
  };
  /** In each size, with its language. */
  const inEachSize = async (see, sizes = SIZES) => {
    for (const size of sizes) {
      await page.setViewportSize(size);
      await page.selectOption('#language', size.language);
      await see(size, `${size.width} x ${size.height}`);
    }
  };
  await inEachSize((size, name) => inEachTheme(`no project, ${name}`, size));
  passed('the first page');
  // What was chosen outlives the page.
  await page.click('[data-tool=theme]');
  const chosen = await looked();
  await page.reload();
  await page.waitForSelector('.tools');
  await coarsen();
  expect(String(await looked()) === String(chosen), `the page is ${await looked()} instead of ${chosen}`);

  await command(page, 'create-project', { name: 'Plate', part: 'plate', stations: 3 });
  coarsenCamera(path.join(home, 'projects', 'Plate'), 4);
  const step = async (key, name, size) => {
    await page.keyboard.press(key);
    if (key === '3') await page.waitForSelector('#live-points');
    await inEachTheme(`step ${key}, ${name}`, size);
  };
  for (const key of ['2', '4']) await step(key, 'before the scan', { themes: ['dark', 'light'] });
  await command(page, 'start-scan');
  await command(page, 'reconstruct');
  await command(page, 'edit', { operation: 'fill-holes', value: '5mm' });
  await command(page, 'select-component-of', { triangle: 0 });
  await command(page, 'export', { format: 'stl' });
  await inEachSize(async (size, name) => {
    for (const key of ['1', '2', '4', '5', '6', '7', '8', '3']) await step(key, name, size);
    passed(`every step, ${name}`);
  });
  // Every dialog, whatever opens it.
  const dialogs = await page.evaluate(() => [...document.querySelectorAll('dialog')].map((one) => one.id));
  expect(dialogs.includes('keys') && dialogs.includes('link'), `the dialogs are ${dialogs}`);
  await page.keyboard.press('5');
  await inEachSize(async (size, name) => {
    for (const id of dialogs) {
      if (id === 'link') await page.click('[data-tool=link]');
      else await page.evaluate((name) => document.getElementById(name).showModal(), id);
      await page.waitForSelector(`#${id}[open]`);
      if (id === 'link') await page.waitForSelector('#link .linkbox');
      await inEachTheme(`dialog ${id}, ${name}`, size, `#${id}`);
      await page.keyboard.press('Escape');
      await page.waitForSelector(`#${id}[open]`, { state: 'detached' });
    }
  }, SIZES.slice(0, 4));
  passed('every dialog');
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
