// How long after the last frame of a scan its surface is there, for `./run figures app`.
//
//   node last_frame.mjs PROGRAM [MPX...] [--json]
//
// Prints one JSON object: for each size of the camera, 1.3 and 5.2 megapixels by default, the times from the last frame on
// the disk until the scan is complete, and until the surface that is then asked for is there, both in s. The scan replays the frames of
// eight stations of a simulated part through the driver `folder`, as fast as they can be read. No browser is involved.
import { execFile } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { promisify } from 'node:util';
import { coarsenCamera, expect, newHome, startServer } from './harness.mjs';

const program = path.resolve(process.argv[2]);
const sizes = process.argv.slice(3).filter((word) => word !== '--json').map(Number);
/** Megapixels of the camera of a new simulated project. */
const OWN = 0.64 * 0.512;
const STATIONS = 8;
const pause = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

async function client(url) {
  const { origin, hash } = new URL(url);
  const post = async (where, body, key) => {
    const answer = await fetch(`${origin}${where}`, {
      method: 'POST', body: JSON.stringify(body),
      headers: { 'Content-Type': 'application/json', ...(key ? { Authorization: `Bearer ${key}` } : {}) },
    });
    const text = await answer.text();
    expect(answer.ok, `${where}: ${text}`);
    return JSON.parse(text);
  };
  const { key } = await post('/api/session', { token: hash.replace('#token=', '') });
  const state = async () => (await fetch(`${origin}/api/state`, { headers: { Authorization: `Bearer ${key}` } })).json();
  /** Starts a job, and returns when it was seen to be done, ms. */
  const done = async (name, argument = {}) => {
    const { job: number } = await post(`/api/commands/${name}`, argument, key);
    for (;;) {
      const job = (await state()).jobs.find((one) => one.number === number);
      expect(!job || job.state !== 'failed', `${name}: ${job?.error}`);
      if (!number || !job || job.state === 'done') return Date.now();
      await pause(10);
    }
  };
  return { done, state };
}

/** The newest time of a frame below a folder, ms. */
const newest = (folder) =>
  Math.max(...fs.readdirSync(folder, { recursive: true }).filter((name) => name.endsWith('.png')).map((name) => fs.statSync(path.join(folder, name)).mtimeMs));

async function measure(megapixels) {
  const home = newHome();
  const server = await startServer(program, home);
  const { done, state } = await client(server.url);
  await done('create-project', { name: 'part', part: 'bust', stations: STATIONS });
  const folder = path.join(home, 'projects', 'part');
  coarsenCamera(folder, Math.sqrt(OWN / megapixels) > 0.4 ? 0.5 : 0.25);
  const rig = path.join(folder, 'rig.toml');
  const recorded = path.join(home, 'recorded');
  await promisify(execFile)(program, ['--quiet', 'scan', rig, '-o', recorded, '--views', String(STATIONS)]);
  const text = fs.readFileSync(rig, 'utf8');
  fs.writeFileSync(rig, text.replace(/\[devices\.camera\]\n(?:[^[\n].*\n)+/, `[devices.camera]\ndriver = "folder"\nfolder = "${recorded}"\n`));
  await done('open-project', { name: 'part' });
  while ((await state()).jobs.some((job) => job.state === 'running')) await pause(50);
  const scanned = await done('start-scan');
  const last = newest(path.join(folder, 'scan'));
  const asked = Date.now();
  const built = await done('reconstruct');
  const { project } = await state();
  expect(project.surface.summary.views === STATIONS, 'the surface lacks views');
  await server.end('SIGTERM');
  fs.rmSync(home, { recursive: true, force: true });
  const { width_px: width, height_px: height } = project.rig.camera;
  return { megapixels: (width * height) / 1e6, complete_s: (scanned - last) / 1000, surface_s: (scanned - last + built - asked) / 1000, triangles: project.surface.triangles };
}

const found = [];
for (const size of sizes.length ? sizes : [1.3, 5.2]) found.push(await measure(size));
console.log(JSON.stringify(found));
process.exit(0);
