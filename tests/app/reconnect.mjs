// A page outlives its server: it reconnects to the next one on the same port and operates there. A link that is pasted into
// an open page is taken. The page that `--open` shows leads to the app.
//
//   node reconnect.mjs PROGRAM
import fs from 'node:fs';
import net from 'node:net';
import path from 'node:path';
import { expect, launch, newHome, newLink, openPage, passed, requireChromium, startServer, stateOf, tell } from './harness.mjs';

const program = path.resolve(process.argv[2]);
requireChromium();
const home = newHome();
process.env.XDG_STATE_HOME = home;
const port = await new Promise((resolve) => {
  const line = net.createServer().listen(0, '127.0.0.1', () => {
    const { port } = line.address();
    line.close(() => resolve(port));
  });
});
const start = () => startServer(program, home, '--port', String(port));
const linkOf = (page) => page.evaluate(() => document.querySelector('frangia-app').session.link);
const until = (page, link) => page.waitForFunction((wanted) => document.querySelector('frangia-app').session.link === wanted, link);

await tell(home, async () => {
  const browser = await launch();
  let server = await start();
  // Console errors of a lost connection are what this is about.
  const expected = /ERR_CONNECTION_REFUSED|WebSocket|401|403/;
  const page = await openPage(browser, server.url, undefined, { expected });
  await until(page, 'open');
  await server.end('SIGKILL');
  await until(page, 'lost');
  server = await start();
  await until(page, 'open');
  await page.evaluate(async () => {
    await document.querySelector('frangia-app').session.command('create-project', { name: 'Again', part: 'plate', stations: 3 });
  });
  await page.waitForFunction(() => document.querySelector('frangia-app').state.project?.name === 'Again');
  passed('a page reconnects to a server that was started again, and operates');

  const other = await openPage(browser, `http://127.0.0.1:${port}/#token=of-nobody`, undefined, { expected });
  await until(other, 'refused');
  const link = newLink(program, home);
  await other.evaluate((fragment) => { location.hash = fragment; }, new URL(link).hash);
  await until(other, 'open');
  expect((await stateOf(other)).project.name === 'Again', 'the page shows another project');
  expect(new URL(other.url()).hash === '', 'the token stays in the address');
  const key = await other.evaluate(() => sessionStorage.getItem('frangia-key'));
  await other.evaluate((fragment) => { location.hash = fragment; }, new URL(newLink(program, home)).hash);
  await other.waitForFunction((before) => sessionStorage.getItem('frangia-key') !== before, key);
  await until(other, 'open');
  expect((await linkOf(page)) === 'open', 'the other page has lost its server');
  passed('a link that is pasted into an open page is taken');

  const tools = path.join(home, 'tools');
  fs.mkdirSync(tools);
  fs.writeFileSync(path.join(tools, 'xdg-open'), `#!/bin/sh\necho "$1" >${tools}/new && mv ${tools}/new ${tools}/shown\n`, { mode: 0o755 });
  process.env.PATH = `${tools}:${process.env.PATH}`;
  await startServer(program, path.join(home, 'tools'), '--open');
  while (!fs.existsSync(path.join(tools, 'shown'))) await page.waitForTimeout(20);
  const desktop = await (await browser.newContext()).newPage();
  await desktop.goto(`file://${fs.readFileSync(path.join(tools, 'shown'), 'utf8').trim()}`);
  await desktop.waitForURL('http://127.0.0.1:**');
  await until(desktop, 'open');
  passed('the page that --open shows leads to the app');
}, 'pages keep their server');
