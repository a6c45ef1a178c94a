// A phone or tablet held across: every step and its sheet fit, fingers move the picture whatever the tool, a decimal comma is
// understood, projects are tidied up, and a tablet comes in encrypted.
//
//   node phone.mjs PROGRAM FOLDER      FOLDER receives the screenshots
import fs from 'node:fs';
import path from 'node:path';
import { axe, check, expect, fail, faultsOfLayout, idle, launch, look, newHome, newProject, openPage, passed, requireChromium, settled, startServer, stateOf, tell, waitForProject, waitForState } from './harness.mjs';

const [program, shots] = process.argv.slice(2).map((name) => path.resolve(name));
requireChromium();
fs.mkdirSync(shots, { recursive: true });
const home = newHome();
process.env.XDG_CONFIG_HOME = home; // where the certificate is kept

const [X, Y, Z] = [60, 40, 10];
const quad = (a, b, c, d) => [[a, b, c], [a, c, d]];
newProject(program, home, 'box', [
  ...quad([0, 0, Z], [X, 0, Z], [X, Y, Z], [0, Y, Z]), ...quad([0, 0, 0], [0, Y, 0], [X, Y, 0], [X, 0, 0]),
  ...quad([0, 0, 0], [X, 0, 0], [X, 0, Z], [0, 0, Z]), ...quad([0, Y, 0], [0, Y, Z], [X, Y, Z], [X, Y, 0]),
  ...quad([0, 0, 0], [0, 0, Z], [0, Y, Z], [0, Y, 0]), ...quad([X, 0, 0], [X, Y, 0], [X, Y, Z], [X, 0, Z]),
]);

await tell(home, async () => {
  const server = await startServer(program, home);
  const browser = await launch({ more: ['--ignore-certificate-errors'] });
  const phone = { width: 800, height: 360 };
  const page = await openPage(browser, server.url, phone, { hasTouch: true, isMobile: true, locale: 'de-DE' });
  await page.waitForSelector('#try');

  // A number that is none is refused by a sentence; none is lost.
  const german = await page.evaluate(() => document.documentElement.lang);
  expect(german === 'de', `the page is in ${german}`);
  const stations = page.locator('input[name=stations]');
  const saysOf = (input) => input.evaluate((one) => one.validationMessage);
  for (const [text, words] of [['12,5', 'Eine ganze Zahl eingeben.'], ['1', 'Eine Zahl von 2 bis 360 eingeben.'], ['acht', 'Eine ganze Zahl eingeben.'], ['8', '']]) {
    await stations.fill(text);
    expect((await saysOf(stations)) === words, `"${text}" stations: "${await saysOf(stations)}"`);
  }
  await stations.press('ArrowUp');
  expect((await stations.inputValue()) === '9', 'the arrow key does not count');

  // The list: a copy, another name, the bin and the way back.
  const act = async (name, what) => {
    await page.click(`[data-project="${name}"] summary`);
    await page.click(`[data-project="${name}"] [data-act=${what}]`);
    await page.waitForSelector('#ask[open]');
  };
  const listed = (...names) => waitForState(page, ({ projects }) => names.every((name) => projects.some((one) => one.name === name)) && projects.length === names.length);
  await act('box', 'duplicate');
  await page.click('#ask [data-answer="0"]');
  await page.waitForSelector('[data-project="Box"]');
  await act('Box', 'rename');
  await page.fill('#ask .entry', 'Deckel');
  await page.click('#ask [data-answer="0"]');
  await page.waitForSelector('[data-project="Deckel"]');
  await act('Deckel', 'discard');
  await page.click('#ask [data-answer="0"]');
  await page.waitForSelector('#bin');
  await listed('box');
  await page.click('#bin summary');
  await page.click('#bin .btn');
  await page.waitForSelector('[data-project="Deckel"]');
  await listed('box', 'Deckel');
  passed('projects are copied, named, deleted and brought back');

  // The bin is emptied after a question that names what it frees, and not without an answer.
  await act('Deckel', 'discard');
  await page.click('#ask [data-answer="0"]');
  await page.waitForSelector('#bin');
  if (!(await page.locator('#bin').getAttribute('open').then((open) => open !== null))) await page.click('#bin summary');
  expect(/\d (B|kB|MB)/.test(await page.locator('#empty-bin').innerText()), 'the size of the bin is not told');
  await look(page, shots, 'phone-bin');
  await page.click('#empty-bin');
  await page.waitForSelector('#ask[open]');
  expect(/Deckel.*\d (B|kB|MB)/s.test(await page.locator('#ask').innerText()), 'the question does not say what is deleted');
  await page.keyboard.press('Escape');
  await page.waitForSelector('#ask:not([open])', { state: 'attached' });
  expect((await stateOf(page)).discarded.length === 1, 'the bin is emptied without an answer');
  await page.click('#empty-bin');
  await page.click('#ask [data-answer="0"]');
  await waitForState(page, ({ discarded, discarded_bytes: size }) => discarded.length === 0 && size === 0);
  await page.waitForSelector('#bin', { state: 'detached' });
  await listed('box');
  passed('the bin is emptied');

  await page.getByText('box', { exact: true }).click();
  await page.waitForSelector('#measuring');
  await idle(page);
  /** What the picture shows: from what is looked at to the eye, what is looked at, and mm a pixel. */
  const eye = () =>
    page.evaluate(() => {
      const { view } = document.querySelector('frangia-app').viewer;
      return { away: view.camera.position.clone().sub(view.controls.target).normalize().toArray(), target: view.controls.target.toArray(), mm: view.mmPerPixel };
    });
  const apart = (a, b) => Math.hypot(...a.map((one, i) => one - b[i]));

  // Each step across: nothing is cut off, the sheet folds away and comes back with the next step.
  for (const [width, height] of [[800, 360], [844, 390], [667, 375]]) {
    await page.setViewportSize({ width, height });
    for (const step of ['project', 'scan', 'surface', 'edit', 'inspect', 'export']) {
      await page.click(`[data-step=${step}]`);
      await settled(page);
      const name = `phone-${step}-${width}`;
      if (width === 800) await page.screenshot({ path: path.join(shots, `${name}.png`) });
      for (const fault of await page.evaluate(faultsOfLayout)) fail(`${name}: ${fault}`);
      if (step === 'project') continue;
      const { stage, panel } = await page.evaluate(() => Object.fromEntries(['stage', 'panel'].map((one) => [one, document.querySelector(`.${one}`).getBoundingClientRect().toJSON()])));
      expect(stage.width > 0.4 * width && stage.height > 0.7 * height && panel.height > 0.7 * height, `${name}: the picture has ${stage.width} x ${stage.height} px, the sheet ${panel.height} px in height`);
    }
  }
  await page.setViewportSize(phone);
  await axe(page, 'phone');
  await page.click('.sheet-handle');
  await settled(page);
  const folded = await page.evaluate(() => document.querySelector('.stage').getBoundingClientRect().width);
  expect(folded > 760 && !(await page.locator('.panel').isVisible()), `the picture is ${folded} px wide without the sheet`);
  await page.screenshot({ path: path.join(shots, 'phone-folded.png') });
  await page.click('[data-step=edit]');
  expect(await page.locator('.panel').isVisible(), 'the sheet does not come back');
  passed('every step fits');

  // A decimal comma.
  await page.click('[data-step=surface]');
  await page.locator('#sectioning, .panel').getByText('z', { exact: true }).first().click();
  const at = page.locator('input[name=section-at]');
  const section = () => page.evaluate(() => document.querySelector('frangia-app').viewer.section.at);
  await at.fill('7,25');
  await at.press('Tab');
  expect(Math.abs((await section()) - 7.25) < 1e-9, `7,25 is ${await section()}`);
  expect((await at.inputValue()) === '7,25', `it is shown as ${await at.inputValue()}`);
  await at.fill('sieben');
  await at.press('Tab');
  expect((await section()) === 7.25 && /keine Zahl/.test(await saysOf(at)), `"sieben" moves the section to ${await section()}`);
  await at.fill('7.5');
  await at.press('Tab');
  expect((await section()) === 7.5, `7.5 is ${await section()}`);
  passed('a decimal comma');

  // Fingers, while a lasso draws.
  await page.click('[data-step=edit]');
  await page.keyboard.press('f');
  await page.keyboard.press('l');
  await settled(page);
  const line = await page.context().newCDPSession(page);
  const frame = await page.locator('.view-canvas').boundingBox();
  const middle = [frame.x + frame.width / 2, frame.y + frame.height / 2];
  const touch = (type, places) => line.send('Input.dispatchTouchEvent', { type, touchPoints: places.map(([x, y], id) => ({ x: middle[0] + x, y: middle[1] + y, id })) });
  /** Moves fingers from some places to others, in steps. */
  const fingers = async (from, to) => {
    const before = await eye();
    for (let count = 1; count <= from.length; count++) await touch('touchStart', from.slice(0, count));
    for (let k = 1; k <= 6; k++) await touch('touchMove', from.map((place, i) => place.map((one, axis) => one + ((to[i][axis] - one) * k) / 6)));
    await touch('touchEnd', []);
    await settled(page);
    const after = await eye();
    return { before, after, moved: apart(before.target, after.target), turned: apart(before.away, after.away), closer: before.mm / after.mm };
  };
  const pinched = await fingers([[-40, 0], [40, 0]], [[-80, 0], [80, 0]]);
  expect(pinched.closer > 1.5 && pinched.turned < 0.02, `a pinch: ${JSON.stringify(pinched)}`);
  const dragged = await fingers([[-40, 0], [40, 0]], [[-40, 40], [40, 40]]);
  expect(dragged.moved > 20 * dragged.before.mm && dragged.turned < 0.02, `two fingers that move: ${JSON.stringify(dragged)}`);
  await page.keyboard.press('f');
  const twisted = await fingers([[-60, 0], [60, 0]], [[-42, -42], [42, 42]]);
  const azimuth = ({ away: [x, y] }) => Math.atan2(y, x);
  const by = azimuth(twisted.after) - azimuth(twisted.before);
  expect(by > 0.4 && by < 0.9 && Math.abs(twisted.after.away[2] - twisted.before.away[2]) < 0.02, `a twist of 45° clockwise turns by ${by}`);
  const turned = await fingers([[-60, 0], [0, 0], [60, 0]], [[-60, 40], [0, 40], [60, 40]]);
  expect(turned.after.away[2] > turned.before.away[2] + 0.1 && turned.moved < 1e-6, `three fingers: ${JSON.stringify(turned)}`);
  expect((await stateOf(page)).project.surface.steps_done === 0, 'fingers that move the picture have drawn');
  // One finger still draws, and a mouse's other buttons move.
  const still = await fingers([[-70, -50], [-70, -50]].slice(0, 1), [[-69, -50]]);
  expect(still.turned === 0, 'a finger turns the picture while a lasso draws');
  await page.mouse.move(...middle);
  for (const [button, changed] of [['right', 'target'], ['middle', 'away']]) {
    const before = await eye();
    await page.mouse.down({ button });
    await page.mouse.move(middle[0] + 40, middle[1] + 10, { steps: 3 });
    await page.mouse.up({ button });
    await page.mouse.move(...middle);
    expect(apart(before[changed], (await eye())[changed]) > 0.01, `the ${button} button does not move the picture`);
  }
  await page.keyboard.press('f');
  await page.keyboard.press('r');
  await settled(page);
  await fingers([[-100, -90]], [[100, 90]]);
  await waitForProject(page, 'the rectangle of a finger', ({ surface }) => surface.selected > 0);
  await page.screenshot({ path: path.join(shots, 'phone-fingers.png') });
  passed('fingers and buttons move the picture while a tool draws');

  // Encrypted, with the fingerprint that the other browser can compare.
  await page.keyboard.press('Escape');
  await page.click('[data-tool=link]');
  await page.waitForSelector('#link[open] .linkbox');
  if ((await page.locator('#let-in').count()) === 0) return passed('this machine is in no network');
  await page.locator('#link').getByText('Verschlüsselt', { exact: true }).click();
  await page.click('#let-in');
  await page.waitForSelector('#fingerprint');
  await settled(page);
  await page.screenshot({ path: path.join(shots, 'phone-encrypted.png') });
  for (const fault of await page.evaluate(faultsOfLayout)) fail(`phone-encrypted: ${fault}`);
  await axe(page, 'phone-encrypted');
  const { open } = await page.evaluate(() => document.querySelector('frangia-app').sharing.lan);
  check('lan', await page.evaluate(() => document.querySelector('frangia-app').sharing.lan));
  expect((await page.locator('#fingerprint').innerText()).replace(/\s/g, '') === open.fingerprint, 'the fingerprint is shown in part');
  const tablet = await openPage(browser, open.link, { width: 1024, height: 700 }, { expected: /status of (409|403)/ });
  await tablet.waitForFunction(() => document.querySelector('frangia-app').session.watches);
  expect(await tablet.evaluate(() => isSecureContext && location.protocol === 'https:'), 'the tablet is not encrypted');
  // A browser that takes the certificate for pages alone says so, instead of waiting for ever.
  await tablet.addInitScript(() => {
    window.WebSocket = class {
      static OPEN = 1;
      constructor() {
        setTimeout(() => this.onclose?.({ code: 1006 }), 20);
      }
      close() {}
    };
  });
  await tablet.reload();
  await tablet.waitForSelector('[role=alert] >> text=no live connection');
  await tablet.screenshot({ path: path.join(shots, 'phone-blocked.png') });
}, 'a phone was used');
