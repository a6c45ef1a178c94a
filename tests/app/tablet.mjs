// A tablet beside the scanner: it is let in with a code that is scanned, watches, takes over, and leaves the role when its
// browser is closed.
//
//   node tablet.mjs PROGRAM FOLDER      FOLDER receives the screenshots
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { check, expect, idle, launch, look as lookAt, newHome, openPage, passed, requireChromium, startServer, stateOf, tell } from './harness.mjs';

const [program, shots] = process.argv.slice(2).map((name) => path.resolve(name));
requireChromium();
fs.mkdirSync(shots, { recursive: true });
const home = newHome();

/** What another program reads in the QR code of a picture; null where that program is missing. */
function scanned(file) {
  const reader = spawnSync('zbarimg', ['--quiet', '--raw', file], { encoding: 'utf8' });
  return reader.error ? null : reader.stdout.trim();
}

const watches = (page, wanted) => page.waitForFunction((wanted) => document.querySelector('frangia-app').session.watches === wanted, wanted);

await tell(home, async () => {
  const server = await startServer(program, home);
  const browser = await launch();
  const page = await openPage(browser, server.url, { width: 1366, height: 768 }, { expected: /status of 409/ });
  await page.waitForSelector('#try');
  await page.click('#try');
  await page.waitForSelector('#test-devices');
  await idle(page);

  // A link to this machine itself has no code: a tablet could not open it.
  await page.click('[data-tool=link]');
  await page.waitForSelector('#link[open] .linkbox');
  expect((await page.locator('#link .qr').count()) === 0, 'a code leads to 127.0.0.1');
  if ((await page.locator('#let-in').count()) === 0) {
    await page.waitForSelector('#link >> text=in no network');
    return passed('this machine is in no network, which the page says');
  }
  await page.click('#let-in');
  await page.waitForSelector('#link .qr');
  await lookAt(page, shots, 'tablet-let-in');
  const lan = await page.evaluate(() => document.querySelector('frangia-app').sharing.lan);
  check('lan', lan);
  const code = path.join(home, 'code.png');
  await page.locator('#link .qr').screenshot({ path: code });
  const read = scanned(code);
  passed(read === null ? 'not read back: zbarimg is not installed' : 'the code is read back by zbarimg');
  expect(read === null || read === lan.open.link, `the code is read as ${read}`);
  expect(!/127\.|localhost/.test(lan.open.link), `the link leads to ${lan.open.link}`);
  await page.keyboard.press('Escape');

  // The tablet watches: what it may not do is disabled, and a refusal offers to take over.
  const tablet = await openPage(browser, lan.open.link, { width: 1024, height: 700 }, { hasTouch: true, expected: /status of (409|403)|Cross-Origin-Opener-Policy/ });
  await watches(tablet, true);
  await tablet.keyboard.press('2');
  await tablet.waitForSelector('#test-devices:disabled');
  expect((await tablet.locator('main.panel button:not(:disabled)').count()) === 0, 'a browser that watches may press a button');
  await tablet.click('[data-tool=link]');
  await tablet.waitForSelector('.notice[role=alert] #take-over');
  expect((await tablet.locator('#take-over').count()) === 1, 'it can be taken over in two places');
  await lookAt(tablet, shots, 'tablet-refused');
  await tablet.click('#take-over');
  await watches(tablet, false);
  await watches(page, true);
  await tablet.click('#test-devices:not(:disabled)');
  await tablet.waitForFunction(() => document.querySelectorAll('.device .dot.done').length === 3);
  await page.waitForFunction(() => document.querySelectorAll('.device .dot.done').length === 3);
  await lookAt(tablet, shots, 'tablet-operates');
  await lookAt(page, shots, 'tablet-watched');
  passed('the tablet operates');
  // Nobody lets others in from the network itself.
  await tablet.click('[data-tool=link]');
  await tablet.waitForSelector('#link[open] .qr');
  expect((await tablet.locator('#let-in, #close-lan').count()) === 0, 'a tablet lets others in');
  await tablet.keyboard.press('Escape');

  // Its role ends with its browser, and the other one goes on without asking.
  await tablet.context().close();
  await watches(page, false);
  await page.click('#test-devices:not(:disabled)');
  await idle(page);
  const byPassword = await openPage(browser, lan.open.url, { width: 1024, height: 700 }, { expected: /status of (401|403)|Cross-Origin-Opener-Policy|ERR_CONNECTION/ });
  await byPassword.fill('input[name=password]', lan.open.password);
  await byPassword.keyboard.press('Enter');
  await watches(byPassword, true);
  passed('the password opens as well');

  // The door is closed: tablets lose their server.
  await page.click('[data-tool=link]');
  await page.click('#close-lan');
  await page.waitForSelector('#let-in');
  await byPassword.waitForFunction(() => document.querySelector('frangia-app').session.link === 'lost');
  expect((await stateOf(page)).jobs.every((job) => job.state === 'done'), 'a job failed');
}, 'a tablet came, operated and went');
