// axe finds no violation: on every step, in each theme and language, on a desktop and a tablet, and in every dialog.
//
//   node accessible.mjs PROGRAM
import path from 'node:path';
import { axe, coarsenCamera, expect, launch, newHome, newLink, openPage, passed, requireChromium, settled, startServer, tell, waitForState } from './harness.mjs';

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

await tell(home, async () => {
  const browser = await launch();
  const page = await openPage(browser, server.url);
  await page.waitForSelector('#try');
  const looks = [['dark', 'en'], ['light', 'it']];  // contrast depends on the theme alone, words on the language alone
  /** Looks at the page as it opens in each theme and in each language. */
  const inEachLook = async (see) => {
    for (const [theme, language] of looks) {
      await page.evaluate(([theme, language]) => {
        localStorage.setItem('frangia-theme', theme);
        localStorage.setItem('frangia-language', language);
      }, [theme, language]);
      await page.reload();
      await page.waitForSelector('.tools');
      const seen = await page.evaluate(() => [document.documentElement.dataset.theme, document.documentElement.lang]);
      expect(seen[0] === theme && seen[1] === language, `the page is ${seen} instead of ${theme}, ${language}`);
      await see(`${theme}, ${language}`);
    }
  };
  await inEachLook((which) => axe(page, `no project, ${which}`));
  passed('the first page');

  await command(page, 'create-project', { name: 'Plate', part: 'plate', stations: 3 });
  coarsenCamera(path.join(home, 'projects', 'Plate'), 4);
  await inEachLook(async (which) => {
    for (const key of ['2', '4']) {
      await page.keyboard.press(key);
      await settled(page);
      await axe(page, `step ${key} before the scan, ${which}`);
    }
  });
  await command(page, 'start-scan');
  await command(page, 'reconstruct');
  await command(page, 'edit', { operation: 'fill-holes', value: '5mm' });
  await command(page, 'select-component-of', { triangle: 0 });
  await command(page, 'export', { format: 'stl' });
  await page.setViewportSize({ width: 1024, height: 700 });
  await inEachLook(async (which) => {
    for (const key of ['1', '2', '4', '5', '6', '7', '8', '3']) {
      await page.keyboard.press(key);
      if (key === '3') await page.waitForSelector('#live-points');
      await settled(page);
      await axe(page, `step ${key}, ${which}`);
    }
    passed(`every step, ${which}`);
    // Every dialog, whatever opens it.
    const dialogs = await page.evaluate(() => [...document.querySelectorAll('dialog')].map((one) => one.id));
    expect(dialogs.includes('keys') && dialogs.includes('link'), `the dialogs are ${dialogs}`);
    for (const id of dialogs) {
      if (id === 'link') await page.click('[data-tool=link]');
      else await page.evaluate((name) => document.getElementById(name).showModal(), id);
      await page.waitForSelector(`#${id}[open]`);
      if (id === 'link') await page.waitForSelector('#link .linkbox');
      await axe(page, `dialog ${id}, ${which}`);
      await page.keyboard.press('Escape');
      await page.waitForSelector(`#${id}[open]`, { state: 'detached' });
    }
    passed(`every dialog, ${which}`);
  });
  await page.evaluate(() => localStorage.setItem('frangia-language', 'en'));

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
