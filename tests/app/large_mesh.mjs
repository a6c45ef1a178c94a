// How the operator's app shows large meshes in Debian's Chromium with software rendering.
//
//   node large_mesh.mjs PROGRAM [TRIANGLES] [--json]      TRIANGLES: 1700000 by default
//
// In a window of 1280 x 720. Prints the seconds to the first picture, the frames a second while a hand orbits and the
// milliseconds of drawing one, the seconds from the end of that to the finest picture, the milliseconds of drawing
// it, those from the end of a lasso over about a tenth of the triangles to its picture, and those of undoing and redoing the
// deletion of what it selected.
// FRANGIA_WEB as in story.mjs. Ends with 77 where Chromium is missing.
import fs from 'node:fs';
import path from 'node:path';
import { expect, fail, idle, launch, newHome, openPage, problems, requireChromium, startServer, stateOf } from './harness.mjs';

const plain = process.argv.slice(2).filter((word) => word !== '--json');
const json = process.argv.includes('--json');
const program = path.resolve(plain[0]);
const wanted = Number(plain[1] ?? 1_700_000);
requireChromium();

/** Writes a ball with bumps, a hole and a sigma, of about so many triangles, as a binary PLY. */
function writeBall(file, triangles) {
  const rings = Math.round(Math.sqrt(triangles / 4));
  const around = 2 * rings;
  const vertices = Buffer.alloc(around * (rings + 1) * 18);
  let at = 0;
  for (let i = 0; i <= rings; i++) {
    const polar = (Math.PI * (i + 0.5)) / (rings + 1);
    for (let j = 0; j < around; j++) {
      const azimuth = (2 * Math.PI * j) / around;
      const radius = 45 + 1.5 * Math.sin(9 * polar) * Math.cos(11 * azimuth) + 0.02 * Math.sin(211 * polar) * Math.sin(173 * azimuth);
      const place = [radius * Math.sin(polar) * Math.cos(azimuth), radius * Math.sin(polar) * Math.sin(azimuth), 50 + radius * Math.cos(polar)];
      for (const value of [...place, 0.004 + 0.003 * Math.sin(5 * polar) ** 2]) at = vertices.writeFloatLE(value, at);
      at = vertices.writeUInt16LE(1 + ((i * 7) % 5), at);
    }
  }
  const faces = [];
  for (let i = 0; i < rings; i++) {
    const row = Buffer.alloc(2 * around * 13);
    let end = 0;
    for (let j = 0; j < around; j++) {
      if (i > 0.7 * rings && i < 0.72 * rings && j < 0.02 * around) continue; // a hole
      const [a, b] = [i * around + j, i * around + ((j + 1) % around)];
      for (const face of [[a, a + around, b], [b, a + around, b + around]]) {
        end = row.writeUInt8(3, end);
        for (const vertex of face) end = row.writeUInt32LE(vertex, end);
      }
    }
    faces.push(row.subarray(0, end));
  }
  const count = faces.reduce((sum, row) => sum + row.length / 13, 0);
  const header = `ply\nformat binary_little_endian 1.0\nelement vertex ${around * (rings + 1)}\nproperty float x\nproperty float y\nproperty float z\nproperty float sigma_mm\nproperty ushort views\nelement face ${count}\nproperty list uchar uint vertex_indices\nend_header\n`;
  fs.writeFileSync(file, Buffer.concat([Buffer.from(header), vertices, ...faces]));
  return count;
}

const home = newHome();
const folder = path.join(home, 'projects', 'large');
fs.mkdirSync(folder, { recursive: true });
fs.writeFileSync(path.join(folder, 'project.json'), '{"format": "frangia-project", "version": 1}\n');
const triangles = writeBall(path.join(folder, 'surface.ply'), wanted);
const server = await startServer(program, home);
const figures = { triangles };
let browser;
let code = 1;
try {
  browser = await launch();
  const page = await openPage(browser, server.url, { width: 1280, height: 720 });
  await page.waitForSelector('#try');
  const viewer = (work, ...more) => page.evaluate(work, ...more);

  // From the moment at which the mesh exists: opening reads it from the disk as well.
  const begin = Date.now();
  await page.getByText('large', { exact: true }).click();
  await page.waitForFunction(() => document.querySelector('frangia-app').viewer.shown, null, { timeout: 120_000, polling: 20 });
  figures.first_picture_s = (Date.now() - begin) / 1000;
  await page.waitForFunction(() => document.querySelector('frangia-app').meshes.fine);
  await idle(page);
  figures.finest_picture_s = (Date.now() - begin) / 1000;

  // A hand that orbits: a move of the pointer before each frame.
  await page.keyboard.press('6');
  await page.waitForSelector('#undo');
  const canvas = await page.locator('.view-canvas').boundingBox();
  const at = (x, y) => [canvas.x + x * canvas.width, canvas.y + y * canvas.height];
  Object.assign(figures, await viewer(async ([x, y]) => {
    const canvas = document.querySelector('.view-canvas');
    const send = (type, dx) => canvas.dispatchEvent(new PointerEvent(type, { pointerId: 1, pointerType: 'mouse', isPrimary: true, button: type === 'pointermove' ? -1 : 0, buttons: type === 'pointerup' ? 0 : 1, clientX: x + dx, clientY: y, bubbles: true }));
    const gl = canvas.getContext('webgl2');
    const frame = () => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
    const { viewer } = document.querySelector('frangia-app');
    canvas.setPointerCapture = canvas.releasePointerCapture = () => {};
    send('pointerdown', 0);
    const times = [];
    for (let i = 1; i <= 24; i++) {
      send('pointermove', 6 * i);
      const begin = performance.now();
      viewer.drawNow();
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // waits for the picture
      times.push(performance.now() - begin);
      await frame();
    }
    // As it is seen: the next move comes when the browser has shown the one before.
    const started = performance.now();
    const MOVES = 30;
    for (let i = 1; i <= MOVES; i++) {
      send('pointermove', 144 - 4 * i);
      await frame();
    }
    const moves_per_s = (1000 * MOVES) / (performance.now() - started);
    const moving = viewer.trianglesShown;
    const released = performance.now();
    send('pointerup', 24);
    const finest = document.querySelector('frangia-app').project.surface.levels.at(-1).triangles;
    while (viewer.trianglesShown !== finest || !viewer.atRest) await frame();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    const detail_s = (performance.now() - released) / 1000;
    const begin = performance.now();
    viewer.drawNow();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    const rest = performance.now() - begin;
    const middle = (values) => values.sort((a, b) => a - b)[Math.floor(values.length / 2)];
    return { orbit_frames_per_s: moves_per_s, orbit_frame_ms: middle(times), orbit_triangles: moving, detail_s, rest_frame_ms: rest, rest_triangles: viewer.trianglesShown };
  }, at(0.5, 0.5)));

  // A lasso over about a tenth of the triangles.
  await page.keyboard.press('l');
  const lasso = async (share) => {
    const loop = Array.from({ length: 40 }, (_, i) => at(0.5 + share * Math.cos((i * Math.PI) / 20), 0.5 + share * 1.3 * Math.sin((i * Math.PI) / 20)));
    await page.mouse.move(...loop[0]);
    await page.mouse.down();
    for (const point of loop) await page.mouse.move(...point);
  };
  /** Milliseconds from an act to the picture that shows what it changed. */
  const timed = async (act, done) => {
    await viewer((text) => {
      window.timing = new Promise((resolve) => {
        const done = new Function('app', `return ${text}`);
        const app = document.querySelector('frangia-app');
        let begin = 0;
        const start = () => (begin ||= performance.now());
        for (const name of ['pointerup', 'keydown', 'click']) addEventListener(name, start, { capture: true, once: true });
        // The app draws by itself: the first picture of its own that shows the change counts.
        const { viewer } = app;
        const draw = Object.getPrototypeOf(viewer).drawNow;
        viewer.drawNow = () => {
          draw.call(viewer);
          if (!begin || !done(app)) return;
          delete viewer.drawNow;
          const gl = document.querySelector('.view-canvas').getContext('webgl2');
          gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // waits for the picture
          resolve(performance.now() - begin);
        };
      });
    }, done);
    await act();
    return viewer(() => window.timing);
  };
  const selects = 'app.project.surface.selected > 0 && app.meshes.selectionShown === app.project.surface.selection_revision';
  await lasso(0.12);
  figures.lasso_ms = await timed(() => page.mouse.up(), selects);
  figures.lasso_triangles = (await stateOf(page)).project.surface.selected;
  await idle(page);
  const revision = (await stateOf(page)).project.surface.mesh_revision;
  const shows = (what) => `app.viewer.meshShown ${what} && app.project.surface.mesh_revision ${what} && app.meshes.selectionShown === app.project.surface.selection_revision`;
  figures.delete_ms = await timed(() => page.keyboard.press('Delete'), shows(`!== ${revision}`));
  await idle(page);
  await page.waitForFunction(() => document.querySelector('frangia-app').meshes.fine);
  // From rest: whoever undoes has seen what the edit did.
  await page.waitForFunction(() => {
    const { viewer, project } = document.querySelector('frangia-app');
    return viewer.trianglesShown === project.surface.levels.at(-1).triangles;
  });
  await page.waitForTimeout(1500);
  figures.undo_ms = await timed(() => page.keyboard.press('Control+z'), shows(`=== ${revision}`));
  await idle(page);
  figures.redo_ms = await timed(() => page.keyboard.press('Control+Shift+Z'), shows(`!== ${revision}`));
  expect(figures.lasso_triangles > wanted / 25, `the lasso selected ${figures.lasso_triangles} triangles only`);
  code = 0;
} catch (error) {
  fail(error.stack ?? String(error));
} finally {
  await browser?.close();
  await server.end('SIGTERM');
  fs.rmSync(home, { recursive: true, force: true });
}
if (json) console.log(JSON.stringify(figures));
else for (const [name, value] of Object.entries(figures)) console.log(`${name.padEnd(18)} ${Number.isInteger(value) ? value : value.toFixed(name.endsWith('_s') ? 2 : 0)}`);
for (const sentence of new Set(problems)) console.error(`wrong: ${sentence}`);
process.exit(problems.length ? 1 : code);
