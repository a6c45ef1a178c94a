// A browser on another machine: it comes through a reverse proxy with TLS and opens the app with the password.
//
//   node password.mjs https://NAME:PORT PASSWORD      NAME is taken for this machine
import { axe, expect, launch, openPage, passed, problems, requireChromium, stateOf } from './harness.mjs';

const [origin, password] = process.argv.slice(2);
requireChromium();
const browser = await launch({ more: [`--host-resolver-rules=MAP ${new URL(origin).hostname} 127.0.0.1`] });
let code = 1;
try {
  const page = await openPage(browser, origin, undefined, { ignoreHTTPSErrors: true });
  await page.waitForSelector('input[name=password]');
  await axe(page, 'password');
  await page.fill('input[name=password]', 'not the password');
  await page.keyboard.press('Enter');
  await page.waitForSelector('[role=alert]');
  await axe(page, 'password refused');
  await page.fill('input[name=password]', password);
  await page.keyboard.press('Enter');
  await page.waitForSelector('#try');
  // The state arrives by the WebSocket, through the proxy. Another session operates, which may be taken over.
  await page.waitForSelector('#take-over');
  await page.click('#take-over');
  await page.waitForSelector('#take-over', { state: 'detached' });
  await page.click('#try');
  await page.waitForSelector('#test-devices');  // of the step Rig, where a new project begins
  expect((await stateOf(page)).project !== null, 'no project is open');
  passed('opened by the password');
  code = problems.length === 0 ? 0 : 1;
} catch (error) {
  console.log(error.stack ?? error);
} finally {
  for (const sentence of new Set(problems)) console.log(`wrong: ${sentence}`);
  await browser.close();
}
process.exit(code);
