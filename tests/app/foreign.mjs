// A page of another origin in the browser that has the app open: it can neither read nor act.
//
//   node foreign.mjs PROGRAM
//
// The page comes from another port of this machine, which a browser counts as the same site, and from another name that
// leads to the app's own port, as DNS rebinding does.
import http from 'node:http';
import path from 'node:path';
import { expect, launch, newHome, newLink, openPage, passed, requireChromium, startServer, stateOf, tell } from './harness.mjs';

const program = path.resolve(process.argv[2]);
requireChromium();
const home = newHome();
const server = await startServer(program, home);
const app = new URL(server.url).origin;
const { port } = new URL(app);
const heard = [];  // what the other origin receives from the browser
const other = http.createServer((request, response) => {
  heard.push(`${request.method} ${request.url} ${JSON.stringify(request.headers)}`);
  response.setHeader('Content-Type', 'text/html');
  response.end('<!doctype html><title>another page</title><body></body>');
});
await new Promise((resolve) => other.listen(0, '127.0.0.1', resolve));
const elsewhere = [`http://127.0.0.1:${other.address().port}`, `http://localhost:${other.address().port}`, `http://evil.example:${other.address().port}`];

/** Everything that a page may try, in the page. Returns what it could read, by the way it took. */
async function attack({ app, key }) {
  const read = {};
  const within = (promise) => Promise.race([promise, new Promise((resolve) => setTimeout(resolve, 60_000, 'nothing'))]);
  const tries = {
    state: ['/api/state', {}],
    'state with a key': ['/api/state', { headers: { Authorization: `Bearer ${key}` } }],
    'state with credentials': ['/api/state', { credentials: 'include' }],
    page: ['/', {}],
    undo: ['/api/commands/undo', { method: 'POST', body: '{}' }],
    'undo as JSON': ['/api/commands/undo', { method: 'POST', body: '{}', headers: { 'Content-Type': 'application/json' } }],
    'undo with a key': ['/api/commands/undo', { method: 'POST', body: '{}', headers: { 'Content-Type': 'application/json', Authorization: `Bearer ${key}` } }],
    session: ['/api/session', { method: 'POST', body: '{"token": "x"}', headers: { 'Content-Type': 'application/json' } }],
    operator: ['/api/operator', { method: 'POST', body: '{}', keepalive: true }],
    beacon: ['/api/commands/close-project', { method: 'POST', body: new Blob(['{}'], { type: 'text/plain' }), mode: 'no-cors', keepalive: true }],
  };
  for (const [name, [at, init]] of Object.entries(tries)) {
    for (const mode of init.mode ? [init.mode] : ['cors', 'no-cors']) {
      try {
        const answer = await fetch(app + at, { ...init, mode });
        const text = await answer.text();
        if (answer.type !== 'opaque' || text) read[`${name}, ${mode}`] = `${answer.type} ${answer.status} ${text.slice(0, 80)}`;
      } catch {
        // refused by the browser
      }
    }
  }
  navigator.sendBeacon(`${app}/api/commands/close-project`, new Blob(['{}'], { type: 'text/plain' }));
  const element = (name, attributes) =>
    within(new Promise((resolve) => {
      const one = Object.assign(document.createElement(name), attributes);
      one.onload = () => resolve('loaded');
      one.onerror = () => resolve('refused');
      document.body.append(one);
    }));
  for (const at of ['/api/state', '/index.html', '/api/mesh'])
    for (const [name, attributes] of [['script', { src: app + at }], ['img', { src: app + at }], ['link', { rel: 'stylesheet', href: app + at }]])
      if ((await element(name, attributes)) === 'loaded') read[`${name} ${at}`] = 'loaded';
  const socket = new WebSocket(`${app.replace('http', 'ws')}/api/live`);
  const opened = await within(new Promise((resolve) => {
    socket.onopen = () => socket.send(JSON.stringify({ type: 'hello', key }));
    socket.onmessage = () => resolve('message');
    socket.onclose = () => resolve('closed');
  }));
  if (opened !== 'closed') read.socket = opened;
  const frame = document.createElement('iframe');
  frame.src = `${app}/`;
  const framed = new Promise((resolve) => (frame.onload = resolve));
  document.body.append(frame);
  await within(framed);
  try {
    if (frame.contentDocument?.body.innerText) read.frame = frame.contentDocument.body.innerText.slice(0, 80);
  } catch {
    // another origin
  }
  const popup = window.open(`${app}/`);
  for (const end = Date.now() + 60_000; ; await new Promise((resolve) => setTimeout(resolve, 20))) {
    try {
      read.popup = popup.sessionStorage.length + popup.document.title;  // of the empty page that it is at first
      if (Date.now() > end) break;
    } catch {
      delete read.popup;  // another origin
      break;
    }
  }
  popup?.postMessage({ key: 'give' }, '*');
  if (Object.keys(sessionStorage).length + Object.keys(localStorage).length > 0) read.storage = 'not empty';
  return read;
}

/** Posts a form to a command, as a page can without a script, and waits for the page that the answer opens. */
async function post(page, action, encoding) {
  const opened = page.context().waitForEvent('page');
  await page.evaluate(([action, encoding]) => {
    const form = Object.assign(document.createElement('form'), { method: 'POST', action, enctype: encoding, target: '_blank' });
    form.append(Object.assign(document.createElement('input'), { name: '{"a": "', value: '"}' }));
    document.body.append(form);
    form.submit();
  }, [action, encoding]);
  await (await opened).waitForLoadState();
}

await tell(home, async () => {
  const browser = await launch({ more: [`--host-resolver-rules=MAP evil.example 127.0.0.1`] });
  const page = await openPage(browser, server.url);
  await page.waitForSelector('#try');
  await page.click('#try');
  await page.waitForSelector('#test-devices');  // of the step Rig, where a new project begins
  const before = JSON.stringify((await stateOf(page)).project);
  const key = await page.evaluate(() => sessionStorage.getItem('frangia-key'));
  const unchanged = async (after) => expect(JSON.stringify((await stateOf(page)).project) === before, `${after} acted`);
  for (const origin of elsewhere) {
    const evil = await page.context().newPage();
    await evil.goto(`${origin}/`);
    // A wrong key first, then the right one: even with it, no page of another origin is answered.
    for (const given of ['x'.repeat(key.length), key]) {
      const read = await evil.evaluate(attack, { app, key: given });
      expect(Object.keys(read).length === 0, `a page of ${origin} reads ${JSON.stringify(read)}`);
      for (const frame of evil.frames())
        if (frame !== evil.mainFrame()) expect(!(await frame.content()).includes('frangia'), 'the app is shown in a frame');
      await evil.goto(`${origin}/`);
    }
    for (const encoding of ['text/plain', 'application/x-www-form-urlencoded', 'multipart/form-data'])
      for (const at of ['/api/commands/close-project', '/api/operator', '/api/session']) await post(evil, app + at, encoding);
    await unchanged(`a page of ${origin}`);
    await evil.close();
    for (const other of page.context().pages()) if (other !== page) await other.close();
    passed(`a page of ${origin} reads and does nothing`);
  }
  // The app's own port under another name.
  const rebound = await page.context().newPage();
  const answer = await rebound.goto(`http://evil.example:${port}/`);
  expect(answer.status() === 403, `the page is served under another name: ${answer.status()}`);
  const stolen = await rebound.evaluate(async (key) => (await fetch('/api/state', { headers: { Authorization: `Bearer ${key}` } })).status, key);
  expect(stolen === 403, `the state is served under another name: ${stolen}`);
  await rebound.close();
  passed('the app answers under its own name only');
  // A link that another page shows opens the app without rights, and tells the other page nothing.
  const linked = await page.context().newPage();
  await linked.goto(elsewhere[0]);
  await linked.evaluate((url) => document.body.append(Object.assign(document.createElement('a'), { href: url, textContent: 'link', target: '_self', rel: 'opener' })), newLink(program, home));
  await linked.click('a');
  await linked.waitForSelector('#take-over, #scan, .dial, main');
  expect(await linked.evaluate(() => window.opener === null), 'the other page holds the window of the app');
  expect(!heard.some((line) => line.includes('token') || line.includes(key)), 'another origin hears a secret');
  await unchanged('a link');
}, 'nothing was read and nothing was done');
