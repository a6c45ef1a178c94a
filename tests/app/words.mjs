// Every failure and warning of the library in the three languages of the page, with its values: words.mjs
// FRANGIA_WEB is a folder with the packages of web/.
import fs from 'node:fs';
import { createRequire } from 'node:module';
import os from 'node:os';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

import { fail, passed, problems } from './harness.mjs';

const packages = createRequire(path.resolve(process.env.FRANGIA_WEB ?? 'web', 'package.json'));
const web = path.join(import.meta.dirname, '../../web');
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'frangia-words-'));
process.on('exit', () => fs.rmSync(folder, { recursive: true }));
const bundle = path.join(folder, 'words.mjs');
packages('esbuild').buildSync({
  stdin: {
    contents: `export { worded, faultOf } from './src/faults';
      export { stepOf } from './src/fault_steps';
      export { FAULTS } from './src/messages/faults';
      export { TERMS } from './src/messages/terms';
      export { LANGUAGES, setLanguage } from './src/messages';`,
    resolveDir: web,
  },
  bundle: true, format: 'esm', target: 'es2022', outfile: bundle,
});
const kept = new Map();
globalThis.localStorage = { getItem: (key) => kept.get(key) ?? null, setItem: (key, value) => kept.set(key, value) };
globalThis.document = { documentElement: {} };
globalThis.navigator ??= { language: 'en' };
const { worded, faultOf, stepOf, FAULTS, TERMS, LANGUAGES, setLanguage } = await import(pathToFileURL(bundle).href);

/** Values as they come: numbers and names, which no language changes. */
const VALUES = ['7.25', 'x-19', '31', '0.4', '58', '6.75', '12', '93', 'q7', '2'];
const filled = (text) => text.replace(/\{(\d+)\}/g, (_, n) => VALUES[Number(n)]);
/** In a language with a decimal comma; what is written into a file keeps its point. */
const filledIn = (language, english, text) =>
  text.replace(/\{(\d+)\}/g, (place, n) => {
    const forFile = ['= ', '=', '[', '[ '].some((sign) => english.includes(sign + place));
    return language === 'en' || forFile || !/^[\d.]+$/.test(VALUES[Number(n)]) ? VALUES[Number(n)] : VALUES[Number(n)].replace('.', ',');
  });

for (const [id, row] of Object.entries(FAULTS)) {
  if (/\}\{/.test(row[0])) VALUES[0] = 'two in a row'; // where two values touch, where one ends is not known
  else VALUES[0] = '7.25';
  const sentence = filled(row[0]);
  const fault = faultOf(sentence);
  // Two rows may fit a sentence; then they say the same.
  if (!fault) fail(`${id}: the page does not find the row of "${sentence}"`);
  LANGUAGES.forEach(([language], column) => {
    setLanguage(language);
    const words = worded(sentence);
    const wanted = filledIn(language, row[0], row[column]);
    if (words !== wanted) fail(`${id} in ${language}: "${words}" instead of "${wanted}"`);
    if (/\{\d+\}/.test(words)) fail(`${id} in ${language}: a value is missing in "${words}"`);
  });
}

const wordedIn = (language, sentence, words) => {
  setLanguage(language);
  const found = worded(sentence);
  if (found !== words) fail(`"${sentence}" is worded "${found}" instead of "${words}"`);
};
// A file and a key in front, sentences that go on with another, and one as the value of another.
wordedIn('de', '/p/rig.toml: camera.white_level must be a whole number', '/p/rig.toml: camera.white_level muss eine ganze Zahl sein');
wordedIn('it', '/p/scan.toml: pattern "fine" has no frame of this number', '/p/scan.toml: il pattern «fine» non ha un fotogramma con questo numero');
wordedIn('de', 'views agree to 0.012 mm RMS (before: 0.3 mm), 81 % of the points overlap; the axis moved by 0.1 mm and 0.2 degrees, the angles by up to 0.3 degrees; the full turn closes to 0.01 degrees (before: 0.4)',
  'die Ansichten stimmen auf 0,012 mm RMS überein (vorher: 0,3 mm), 81 % der Punkte überlappen; die Achse bewegte sich um 0,1 mm und 0,2 Grad, die Winkel um bis zu 0,3 Grad; die volle Drehung schließt auf 0,01 Grad (vorher: 0,4)');
wordedIn('it', 'view 3 of 8 at 90 degrees: overexposed, shorten or bracket the exposure', "vista 3 di 8 a 90 gradi: sovraesposto, accorciare l'esposizione o usarne più di una");
wordedIn('de', 'no pixel has a phase: 41 % of the pixels are saturated; expose shorter, close the aperture, or correct white_level in rig.toml',
  'kein Pixel hat eine Phase: 41 % der Pixel sind gesättigt; kürzer belichten oder die Blende schließen');
wordedIn('de', 'view 7 of 7 at 30 degrees: good: contrast 0.77, 0.0 % saturated, 75102 points', 'Ansicht 7 von 7 bei 30 Grad: gut: Kontrast 0,77, 0,0 % gesättigt, 75102 Punkte');
wordedIn('de', 'an unheard-of sentence', 'an unheard-of sentence');
wordedIn('en', 'the disk is full; free some space', 'the disk is full; free some space');
// What a failure advises is a button, in every language.
for (const [language] of LANGUAGES) {
  setLanguage(language);
  for (const [sentence, step] of [
    ['views/003: no view has a measured pixel', 'live'],
    ['the axis of the turntable is unknown: find it in step Rig, or scan a single station', 'rig'],
    ['an unheard-of sentence', undefined],
  ])
    if (stepOf(sentence) !== step) fail(`"${sentence}" leads to ${stepOf(sentence)} instead of ${step}`);
}
// The English entry of each term is the beginning of that of docs/terms.md.
const entries = new Map([...fs.readFileSync(path.join(web, '../docs/terms.md'), 'utf8').matchAll(/^\| (.+?) \| (.+) \|$/gm)].map(([, term, meaning]) => [term, meaning]));
for (const [key, [word]] of Object.entries(TERMS)) {
  if (!key.startsWith('term.')) continue;
  const [meaning] = TERMS[key.replace('term.', 'means.')] ?? [''];
  if (!meaning || !entries.get(word)?.startsWith(meaning)) fail(`${word}: the page says "${meaning}", docs/terms.md "${entries.get(word)}"`);
}
passed(`${Object.keys(FAULTS).length} sentences in ${LANGUAGES.length} languages`);
for (const problem of problems) console.error(problem);
process.exitCode = problems.length > 0 ? 1 : 0;
