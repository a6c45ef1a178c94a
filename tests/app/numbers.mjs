// Numbers as people write them into the fields of the page, in its three languages: numbers.mjs
// FRANGIA_WEB is a folder with the packages of web/.
import fs from 'node:fs';
import { createRequire } from 'node:module';
import os from 'node:os';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

import { fail, passed, problems } from './harness.mjs';

const packages = createRequire(path.resolve(process.env.FRANGIA_WEB ?? 'web', 'package.json'));
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'frangia-numbers-'));
process.on('exit', () => fs.rmSync(folder, { recursive: true }));
const bundle = path.join(folder, 'numbers.mjs');
packages('esbuild').buildSync({
  stdin: {
    contents: `export { readNumber, readNumbers, shownNumber, wrongWith } from './src/written_numbers';
      export { LANGUAGES, setLanguage } from './src/messages';`,
    resolveDir: path.join(import.meta.dirname, '../../web'),
  },
  bundle: true, format: 'esm', target: 'es2022', outfile: bundle,
});
globalThis.localStorage = { getItem: () => null, setItem: () => undefined };
globalThis.document = { documentElement: {} };
globalThis.navigator ??= { language: 'en' };
const { readNumber, readNumbers, shownNumber, wrongWith, LANGUAGES, setLanguage } = await import(pathToFileURL(bundle).href);

const same = (found, wanted, what) => JSON.stringify(found) === JSON.stringify(wanted) || fail(`${what} is ${JSON.stringify(found)}, not ${JSON.stringify(wanted)}`);
const NONE = null; // as JSON writes NaN

for (const [language] of LANGUAGES) {
  setLanguage(language);
  for (const [text, wanted] of [
    ['12,5', 12.5], ['12.5', 12.5], [' -0,25 ', -0.25], ['\u22120.25', -0.25], ['+3', 3], [',5', 0.5], ['5,', 5], ['1e-3', 0.001], ['1,5e2', 150],
    ['1.234,5', 1234.5], ['1,234.5', 1234.5], ['1 234,5', 1234.5], ['1.234.567', 1234567], ["1'234'567", 1234567], ['1.234', 1.234],
    ['', NONE], ['12 5', NONE], ['1,2,3', NONE], ['12,5 mm', NONE], ['zwölf', NONE], ['1.23.456', NONE], ['--5', NONE], ['0x10', NONE], ['Infinity', NONE],
  ])
    same(readNumber(text), wanted, `"${text}" in ${language}`);
  for (const [text, wanted] of [['8', 8], ['100.000', 100000], ['100,000', 100000], ['1.234.567', 1234567], ['12,5', 12.5]])
    same(readNumber(text, true), wanted, `"${text}" as a whole number in ${language}`);
  // What a field shows is read as what it was.
  for (const value of [12.5, -0.1, 0.0001, 1234.5, 1e-7, 250000]) same(readNumber(shownNumber(value)), value, `${value} shown in ${language}`);
  same(shownNumber(12.5, 2), language === 'en' ? '12.50' : '12,50', `12.5 in ${language}`);
  same(shownNumber(null), '', `no number in ${language}`);

  for (const [text, limits] of [['12,5', {}], ['12,5', { min: 12.5, max: 12.5 }], ['', { min: 1 }], ['360', { whole: true, max: 360 }]])
    same(wrongWith(text, limits), '', `what is wrong with "${text}" in ${language}`);
  for (const [text, limits] of [['12,5 mm', {}], ['12,5', { whole: true }], ['1', { min: 2, max: 360 }], ['0', { min: 0.1 }], ['101', { max: 100 }]]) {
    const words = wrongWith(text, limits);
    if (!/^[A-Z][^{}]+\.$/.test(words)) fail(`what is wrong with "${text}" in ${language} is "${words}"`);
  }
}
setLanguage('de');
same(wrongWith('zwölf', {}), 'Das ist keine Zahl: eine eingeben, etwa 12,5.', 'what is wrong');
same(wrongWith('0,05', { min: 0.1 }), 'Eine Zahl von mindestens 0,1 eingeben.', 'what is wrong');

// Several: a comma between digits is a decimal comma where the page writes it.
for (const [language, text, wanted] of [
  ['en', '8 32', [8, 32]], ['en', '8,32', [8, 32]], ['en', '8, 32.5', [8, 32.5]], ['en', '2;8;32', [2, 8, 32]],
  ['de', '12,5', [12.5]], ['de', '12,5 25', [12.5, 25]], ['de', '12,5; 25', [12.5, 25]], ['de', '12,5, 25', [12.5, 25]], ['de', '8,16,32', [8, 16, 32]],
  ['it', '12.5 25', [12.5, 25]], ['it', 'otto', [NONE]],
]) {
  setLanguage(language);
  same(readNumbers(text), wanted, `"${text}" in ${language}`);
}

// The browser's own fields of numbers know the mark of its own language only.
const web = path.join(import.meta.dirname, '../../web/src');
for (const name of fs.readdirSync(web, { recursive: true }))
  if (name.endsWith('.ts') && /type=["']?number\b/.test(fs.readFileSync(path.join(web, name), 'utf8'))) fail(`${name} has a field of type number; use \`numeric\` of number_field.ts`);

for (const sentence of problems) console.log(`wrong: ${sentence}`);
passed(problems.length === 0 ? 'numbers are read in every language' : 'some are not');
process.exit(problems.length === 0 ? 0 : 1);
