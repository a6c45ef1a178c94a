// The step Inspect of the operator's app in Debian's Chromium, on a part of which everything is known: three balls. They
// are found, clicked and put into a plan with their distance; the plan is saved and read back, and the report is written.
//
//   node inspect.mjs PROGRAM FOLDER      FOLDER receives the screenshots
//
// FRANGIA_WEB as in story.mjs. Ends with 77 where Chromium is missing.
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { check, expect, idle as allDone, lastFailure, launch, look as lookAt, newHome, newProject, openPage, passed, requireChromium, settled, startServer, stateOf, stlOf, tell, waitForProject } from './harness.mjs';

const [program, shots] = process.argv.slice(2).map((name) => path.resolve(name));
const here = import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname);
requireChromium();
fs.mkdirSync(shots, { recursive: true });
const home = newHome();

/** A ball of triangles. */
function ball([x, y, z], radius, rings) {
  const at = (i, k) => {
    const [u, v] = [(Math.PI * i) / rings, (2 * Math.PI * k) / (2 * rings)];
    return [x + radius * Math.sin(u) * Math.cos(v), y + radius * Math.sin(u) * Math.sin(v), z + radius * Math.cos(u)];
  };
  const triangles = [];
  for (let i = 0; i < rings; i++)
    for (let k = 0; k < 2 * rings; k++) {
      if (i > 0) triangles.push([at(i, k), at(i + 1, k), at(i, k + 1)]);
      if (i < rings - 1) triangles.push([at(i, k + 1), at(i + 1, k), at(i + 1, k + 1)]);
    }
  return triangles;
}
// Measured: the small ball is 0.05 mm too large and 0.1 mm too far away.
const third = ball([18, 30, 6], 6, 20); // beside the others, so that the part fits in one pose only
const nominal = [...ball([0, 0, 0], 15, 40), ...ball([50, 0, 0], 10, 28), ...third];
const measured = [...ball([0, 0, 0], 15, 40), ...ball([50.1, 0, 0], 10.025, 28), ...third];
const folder = newProject(program, home, 'balls', measured);
const reference = path.join(home, 'balls as designed.stl');
fs.writeFileSync(reference, stlOf(nominal));

/** A plate of 60 x 40 x 10 mm about a bore, in its middle, whose radius is 0.02 mm too large. */
function boredPlate() {
  const [AROUND, RINGS, LAYERS, RADIUS] = [240, 12, 8, 8.02];
  const at = (i, k, z) => {
    const u = (2 * Math.PI * i) / AROUND;
    const outer = 1 / Math.max(Math.abs(Math.cos(u)) / 30, Math.abs(Math.sin(u)) / 20);
    const r = RADIUS + ((outer - RADIUS) * k) / RINGS;
    return [r * Math.cos(u), r * Math.sin(u), z];
  };
  const triangles = [];
  const quad = (a, b, c, d) => triangles.push([a, b, c], [a, c, d]);
  for (let i = 0; i < AROUND; i++) {
    for (let k = 0; k < RINGS; k++) {
      quad(at(i, k, 10), at(i, k + 1, 10), at(i + 1, k + 1, 10), at(i + 1, k, 10));
      quad(at(i, k, 0), at(i + 1, k, 0), at(i + 1, k + 1, 0), at(i, k + 1, 0));
    }
    for (let z = 0; z < LAYERS; z++) {
      const [low, high] = [(10 * z) / LAYERS, (10 * (z + 1)) / LAYERS];
      quad(at(i, 0, low), at(i, 0, high), at(i + 1, 0, high), at(i + 1, 0, low));
      quad(at(i, RINGS, low), at(i + 1, RINGS, low), at(i + 1, RINGS, high), at(i, RINGS, high));
    }
  }
  return triangles;
}
newProject(program, home, 'plate', boredPlate());

const server = await startServer(program, home);
await tell(home, async () => {
  const browser = await launch();
  const page = await openPage(browser, server.url, undefined, { expected: /status of 400/ }); // of a plan with a wrong key
  const look = (name) => lookAt(page, shots, name);
  const idle = () => allDone(page);
  let forgiven = 0; // the last job that was to fail
  const until = (what, wanted) => waitForProject(page, what, wanted, forgiven);
  const state = () => until('the state', () => true);
  const submit = (form) => page.locator(`${form} button`).last().click();
  await page.waitForSelector('#try');
  await page.getByText('balls', { exact: true }).click();
  await page.waitForSelector('.figures');
  await idle();

  // Without a reference and a plan there is nothing to inspect; features can be looked for.
  await page.keyboard.press('7');
  await page.waitForSelector('#find-features:not([disabled])');
  expect(await page.locator('#report').isDisabled(), 'a report of nothing');
  await look('begin');
  await page.click('#find-features');
  const { inspection } = (await until('the features', (project) => project.surface.inspection?.searched)).surface;
  const balls = inspection.features.filter(({ kind }) => kind === 'sphere');
  expect(balls.length === 3, `${balls.length} balls were found`);
  await idle();

  // A click on the large ball chooses it; both go into the plan.
  await page.click('#pick-feature');
  const scene = await page.locator('.view-canvas').boundingBox();
  const at = await page.evaluate(() => {
    const { view, size } = document.querySelector('frangia-app').viewer;
    void size;
    const camera = view.camera;
    const point = camera.position.clone().set(0, 0, 0).project(camera);
    return [(point.x + 1) / 2, (1 - point.y) / 2];
  });
  await page.mouse.click(scene.x + at[0] * scene.width, scene.y + at[1] * scene.height);
  await page.waitForSelector('#plan-group > .features tr[aria-selected=true]');
  expect((await page.locator('#plan-group > .features').innerText()).includes('30.0'), 'another feature was clicked');
  await look('clicked');
  await page.locator('#plan-group > .features .btn').click();
  await until('the first ball', (project) => project.plan?.features?.length === 1);
  await idle();
  await page.locator('#plan-group details summary').click();
  await page.locator('#plan-group details tr:has(.btn)').filter({ hasText: /sphere/ }).first().locator('.btn').click();
  const planned = (await until('the second ball', (project) => project.plan?.features?.length === 2)).plan;
  expect(planned.features.every(({ name }) => /^sphere \d$/.test(name)), 'the balls have other names');
  await until('its size', (project) => project.surface.inspection.characteristics.length === 2);
  await idle();

  // The size of the small ball is out of its tolerance, and so is the distance of the two.
  const small = page.locator('[data-planned="sphere 2"]');
  await small.locator('[name=nominal]').fill('20');
  await small.locator('[name=lower]').fill('-0.02');
  await small.locator('[name=upper]').fill('0.02');
  await small.locator('form button').click();
  await until('the verdict', (project) => project.surface.inspection.verdict === 'out');
  await idle();
  await page.locator('#add-characteristic [name=feature]').selectOption('sphere 2');
  await page.locator('#add-characteristic [name=datum]').selectOption('sphere 1');
  await page.locator('#add-characteristic [name=nominal]').fill('50');
  await page.locator('#add-characteristic [name=limit]').fill('0.3');
  await submit('#add-characteristic');
  const rows = (await until('the distance', (project) => project.surface.inspection.characteristics.length === 3)).surface.inspection.characteristics;
  await idle();
  const [, diameter, distance] = rows;
  expect(Math.abs(diameter.value - 20.05) < 0.005 && diameter.verdict === 'out', `the small ball measures ${diameter.value}`);
  expect(Math.abs(distance.value - 50.1) < 0.005 && distance.verdict === 'in', `the distance measures ${distance.value}`);
  expect(Math.abs(distance.used - 1 / 3) < 0.1, `a third of the tolerance is used, not ${distance.used}`);
  passed('features and characteristics are chosen in the page');

  // Each value has a label at its feature, the worst first; one that is dragged stays beside its feature, and a double click
  // lets it go.
  if ((await page.getAttribute('#pick-feature', 'aria-pressed')) === 'true') await page.click('#pick-feature');
  await settled(page);
  const labels = page.locator('.view-labels text[data-label^="row "]');
  expect((await labels.count()) === 3 && (await labels.first().textContent()).startsWith('sphere 2 diameter: 20.05'), `the labels are ${await labels.allTextContents()}`);
  const label = page.locator('.view-labels text[data-label="row Distance 1"]');
  const spot = async () => {
    const { x, y, width, height } = await label.boundingBox();
    return [x + width / 2, y + height / 2];
  };
  const [x, y] = await spot();
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x - 60, y - 90, { steps: 4 });
  await page.mouse.up();
  // A label moves with the next picture that is drawn.
  const near = async (wanted) => {
    await settled(page);
    const [u, v] = await spot();
    return Math.hypot(u - wanted[0], v - wanted[1]) < 3;
  };
  expect(await near([x - 60, y - 90]), `the label was dragged to ${await spot()}, not by -60, -90 from ${[x, y]}`);
  await look('labels');
  const turn = async (from) => {
    await page.evaluate((from) => document.querySelector('frangia-app').viewer.frame(from), from);
    await settled(page);
  };
  await turn([0, -1, 0.3]);
  const turned = await spot();
  await label.dblclick();
  expect(!(await near(turned)), 'a double click does not let the label go');
  await turn([0.9, -1.1, 0.6]);

  // With a reference, the surface is judged as well.
  await page.setInputFiles('#reference', reference);
  const judged = await until('the deviations', (project) => project.surface.comparison);
  expect(judged.surface.inspection.verdict === 'out' && judged.surface.inspection.characteristics.length === 3, 'the plan was lost');
  await idle();
  await page.locator('.panel').evaluate((panel) => (panel.scrollTop = 0));
  await look('results');
  await page.locator('#plan-group').scrollIntoViewIfNeeded();
  await look('plan');

  // The places stand there with their coordinates, and a click on one looks at it alone.
  await page.click('#places');
  const inPanel = () => page.evaluate(() => {
    const panel = document.querySelector('.panel');
    return panel.scrollWidth <= panel.clientWidth + 1;
  });
  expect(await inPanel(), 'the table of places is wider than the panel');
  expect((await page.locator('.places thead').innerText()).includes('mm'), 'the places have no unit');
  const rings = () => page.evaluate(() => document.querySelector('frangia-app').inspecting.marks.length);
  const ringed = await rings();
  expect(ringed > 1, `${ringed} places are ringed`);
  await page.locator('.places .link').first().click();
  await settled(page);
  expect((await rings()) === 1, 'the place that was clicked is not ringed alone');
  await look('place');
  await page.click('#places');
  await page.evaluate(() => document.querySelector('frangia-app').viewer.frame([0.9, -1.1, 0.6]));

  // What was found by another plan is said to be so, and no report is written of it.
  await page.locator('#add-characteristic [name=kind]').selectOption('flatness');
  await page.locator('#add-characteristic [name=feature]').selectOption('sphere 1');
  await submit('#add-characteristic');
  await page.waitForSelector('.notice >> text=has no flatness');
  await page.waitForSelector('#inspect-again:not([disabled])');
  expect((await page.locator('#verdict .lit').count()) === 0, 'the verdict is that of another plan');
  expect(await page.locator('#report').isDisabled(), 'a report of another plan');
  await page.locator('.panel').evaluate((panel) => (panel.scrollTop = 0));
  await look('outdated');
  forgiven = await lastFailure(page);
  await page.locator('[data-planned="Flatness 1"] .icon-btn').click();
  await until('the verdict again', (project) => project.surface.inspection.current);
  await idle();
  await page.waitForSelector('#verdict .out.lit');
  if (await page.locator('.notice .icon-btn').count()) await page.locator('.notice .icon-btn').first().click();

  // A feature is called as the drawing calls it, also where others refer to it.
  const naming = page.locator('[data-planned="sphere 1"] .name');
  await naming.fill('ball A');
  await naming.press('Tab');
  const renamed = await until('the name', (project) => project.plan.features.some(({ name }) => name === 'ball A') && project.surface.inspection.current);
  expect(renamed.plan.characteristics[0].datum === 'ball A', 'the distance refers to a feature that is gone');
  await idle();

  // The command line below finds the same.
  const [, ...line] = (await state()).commands.inspect;
  const inspected = JSON.parse(spawnSync(program, ['--json', ...line], { encoding: 'utf8' }).stdout);
  expect(inspected.characteristics.every(({ value }, i) => Math.abs(value - rows[i].value) < 1e-3), 'the program measures otherwise');

  // Report and plan are downloaded; the plan is read back.
  const saved = async (button, name) => {
    const saving = page.waitForEvent('download');
    await page.click(button);
    const file = path.join(home, name);
    await (await saving).saveAs(file);
    await idle();
    return fs.readFileSync(file, 'utf8');
  };
  await page.locator('#report-group summary').click();
  await page.locator('#report-group [name=serial]').fill('No. 17');
  await page.locator('#report-group [name=serial]').press('Tab');
  await until('the serial number', (project) => project.plan.report?.serial === 'No. 17');
  await idle();
  const report = await saved('#report-html', 'report.html');
  expect(report.includes('No. 17') && report.includes('balls as designed.stl') && /sphere 2 diameter/.test(report), 'the report lacks what was inspected');
  const plan = await saved('#save-plan', 'saved.toml');
  const before = (await state()).plan;
  await page.locator('[data-planned="sphere 2"] .icon-btn').first().click();
  const less = (await until('one feature less', (project) => project.plan.features.length === 1)).plan;
  expect((less.characteristics ?? []).length === 0, 'a distance of a feature that is gone');
  await idle();
  await page.setInputFiles('#open-plan', { name: 'bad.toml', mimeType: 'text/plain', buffer: Buffer.from(plan.replace('tolerance_mm', 'tolerence_mm')) });
  await page.waitForSelector('.notice >> text=perhaps tolerance_mm was meant');
  await page.setInputFiles('#open-plan', { name: 'saved.toml', mimeType: 'text/plain', buffer: Buffer.from(plan) });
  const again = (await until('the plan again', (project) => project.plan.features.length === 2)).plan;
  expect(JSON.stringify(again) === JSON.stringify(before), 'the plan was read back otherwise');
  await idle();
  check('state', await stateOf(page));
  if (fs.existsSync('/usr/bin/weasyprint')) {
    const printed = await saved('#report', 'report.pdf');
    expect(printed.startsWith('%PDF-'), 'the report is no PDF file');
  } else {
    await page.click('#report');
    await page.waitForSelector('.notice >> text=install the package weasyprint');
    await idle();
  }
  passed('report and plan are files');

  // Three places, each clicked on the scan and then on the reference, put the part on it.
  await page.locator('#reference-group .seg label').filter({ hasText: 'Points' }).click();
  await page.waitForSelector('.floating .chip >> text=Place 1 of 3: click it on the scan');
  for (const [i, [x, y, z, r]] of [[0, 0, 0, 15], [50, 0, 0, 10], [18, 30, 6, 6]].entries())
    for (const onReference of [false, true]) {
      await page.waitForFunction((wanted) => {
        const { viewer, state } = document.querySelector('frangia-app');
        return viewer.atRest && viewer.showsReference === wanted && state.project.reference.shown;
      }, onReference);
      const [u, v] = await page.evaluate(([x, y, z, r]) => {
        const { camera } = document.querySelector('frangia-app').viewer.view;
        const center = camera.position.clone().set(x, y, z);
        const seen = center.addScaledVector(camera.position.clone().sub(center).normalize(), r).project(camera);
        return [(seen.x + 1) / 2, (1 - seen.y) / 2];
      }, [i === 1 && !onReference ? x + 0.1 : x, y, z, r]);
      const answer = page.waitForResponse((response) => response.url().endsWith('/api/pick'));
      await page.mouse.click(scene.x + u * scene.width, scene.y + v * scene.height);
      await answer;
    }
  const put = await until('the alignment by points', (project) => project.plan.align === 'points' && project.surface.comparison);
  expect(put.plan.points.length === 3 && put.surface.comparison.moved_mm < 1.5, `the points moved the part by ${put.surface.comparison.moved_mm} mm`);
  await idle();
  await page.locator('.panel').evaluate((panel) => (panel.scrollTop = 0));
  await look('by-points');
  passed('three places align the part');

  // The part on its datums, in another language and in the light theme.
  await page.getByText('Datums', { exact: true }).click();
  await until('the alignment to datums', (project) => project.plan.align === 'datum' && project.surface.comparison);
  await idle();
  await page.selectOption('#language', 'de');
  await page.emulateMedia({ colorScheme: 'light' });
  await page.keyboard.press('d');
  await page.locator('.panel').evaluate((panel) => (panel.scrollTop = 0));
  await look('german');
  const german = await page.locator('#verdict').innerText();
  expect(/Merkmale: \d, davon \d innerhalb, 1 außerhalb/.test(german) && /Sollfläche/.test(german) && !/nominal area/.test(german), `the verdict is worded: ${german}`);
  await page.setViewportSize({ width: 1024, height: 700 });
  await look('small');

  // The next part, from a file, is inspected by the same plan and stands beside the first.
  await page.selectOption('#language', 'en');
  await page.setInputFiles('#next-file', { name: 'second.stl', mimeType: 'model/stl', buffer: stlOf(nominal) });
  await page.waitForSelector('#ask [data-answer="0"]');
  await page.click('#ask [data-answer="0"]');
  const second = await until('the next part', (project) => project.name === 'balls 2' && project.surface?.inspection);
  await idle();
  expect(second.series.length === 1 && second.series[0].serial === 'No. 17' && second.series[0].verdict === 'out', `the series is ${JSON.stringify(second.series)}`);
  expect(second.surface.inspection.verdict === 'in', `the second part is ${second.surface.inspection.verdict}`);
  expect(second.plan.report?.serial === undefined && second.plan.features.length === 2, 'the plan is another one');
  await page.setViewportSize({ width: 1366, height: 768 });
  await page.locator('#series-group').scrollIntoViewIfNeeded();
  await page.waitForFunction(() => document.querySelectorAll('.trend circle').length === 6);
  await look('series');
  check('state', await stateOf(page));

  // A click on a face of the CAD reference takes it into the plan, with its nominal size.
  await page.keyboard.press('1');
  await page.locator('button b').getByText('plate', { exact: true }).click();
  await page.waitForSelector('.figures');
  await idle();
  await page.keyboard.press('7');
  await page.waitForSelector('#reference-group');
  expect((await page.locator('#pick-face').count()) === 0, 'faces of no reference are offered');
  await page.setInputFiles('#reference', path.join(here, '../data/cad-samples/plate.stp'));
  await until('the CAD reference', (project) => project.reference?.format === 'stp' && project.surface.comparison);
  await idle();
  await page.click('#pick-face');
  await page.waitForFunction(() => document.querySelector('frangia-app').viewer.showsReference);
  const clickAt = async (at, wanted) => {
    await settled(page);
    const box = await page.locator('.view-canvas').boundingBox();
    const [u, v] = await page.evaluate(([x, y, z]) => {
      const { camera } = document.querySelector('frangia-app').viewer.view;
      const seen = camera.position.clone().set(x, y, z).project(camera);
      return [(seen.x + 1) / 2, (1 - seen.y) / 2];
    }, at);
    const answer = page.waitForResponse((response) => response.url().endsWith('/api/pick'));
    await page.mouse.click(box.x + u * box.width, box.y + v * box.height);
    check('picked', await (await answer).json());
    await page.locator('#picked-face').filter({ hasText: wanted }).waitFor();
  };
  await settled(page);
  // The far side of the bore, seen from above.
  const eye = await page.evaluate(() => document.querySelector('frangia-app').viewer.view.camera.position.toArray());
  const far = Math.hypot(eye[0], eye[1]);
  await clickAt([(-8 * eye[0]) / far, (-8 * eye[1]) / far, 8], /^\s*cylinder, face \d+/);
  const bore = await page.locator('#picked-face').innerText();
  expect(/^cylinder, face \d+\s+⌀ 16\.000/.test(bore.replace(/\s+/g, ' ')), `the bore is ${bore}`);
  await look('face');
  await page.locator('#picked-face .btn').click();
  const faced = await until('the bore', (project) => project.plan?.features?.length === 1 && project.surface.inspection?.characteristics.length === 1);
  expect(faced.plan.features[0].face > 0 && faced.plan.features[0].kind === undefined, `the plan holds ${JSON.stringify(faced.plan.features[0])}`);
  const [measuredBore] = faced.surface.inspection.characteristics;
  expect(measuredBore.nominal === 16 && Math.abs(measuredBore.value - 16.04) < 0.01, `the bore measures ${measuredBore.value}`);
  await idle();
  await clickAt([20, 12, 10], /^\s*plane, face \d+/);
  await page.locator('#picked-face .btn').click();
  await until('the top', (project) => project.plan.features.length === 2);
  await idle();
  await page.click('#pick-face');
  await page.waitForFunction(() => !document.querySelector('frangia-app').viewer.showsReference);
  await page.waitForSelector('#picked-face', { state: 'detached' });
  await page.locator('#plan-group').scrollIntoViewIfNeeded();
  await look('faces-planned');
  check('state', await stateOf(page));
  passed('faces of the reference are features');
}, 'the inspection is told');
