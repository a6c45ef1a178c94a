import { FAULTS } from './messages/faults';
import { currentLanguage, decimalMark, t } from './messages';

export type FaultId = keyof typeof FAULTS;

/** A sentence of the server as its row and the values in it. */
export interface Fault {
  id: FaultId;
  values: string[];
}

interface Template {
  id: FaultId;
  /** Its groups are the values, in the order of their numbers. */
  expression: RegExp;
  /** The longest piece without a value, which every sentence of the row holds. */
  piece: string;
  /** Letters that are no value. */
  fixed: number;
}

function templateOf(id: FaultId): Template {
  const [english] = FAULTS[id];
  const pieces = english.split(/\{\d+\}/);
  const escaped = english.replace(/[.*+?^$()|[\]\\]/g, '\\$&');
  return {
    id,
    expression: new RegExp(`^${escaped.replace(/\{\d+\}/g, '(.*?)')}$`, 's'),
    piece: pieces.reduce((longest, one) => (one.length > longest.length ? one : longest), ''),
    fixed: pieces.join('').length,
  };
}
// What begins or ends with a value would also match longer sentences: the row with most letters of its own is tried first.
const TEMPLATES = (Object.keys(FAULTS) as FaultId[]).map(templateOf).sort((a, b) => b.fixed - a.fixed);

const found = new Map<string, Fault | undefined>();
/** Sentences that are remembered; a scan with many warnings sends some hundred. */
const REMEMBERED = 2000;

/** The row of a sentence; undefined where the catalogue has none. */
export function faultOf(sentence: string): Fault | undefined {
  if (found.has(sentence)) return found.get(sentence);
  let fault: Fault | undefined;
  for (const { id, piece, expression } of TEMPLATES) {
    const match = sentence.includes(piece) ? expression.exec(sentence) : null;
    if (!match) continue;
    fault = { id, values: match.slice(1) };
    break;
  }
  if (found.size >= REMEMBERED) found.clear();
  found.set(sentence, fault);
  return fault;
}

/** What precedes a sentence: the device, the file, the key. */
const PREFIX = /^([^:;]{1,120}): (.+)$/s;
/** Where a sentence may go on with one of another row, which begins with its sign: "views agree ...; the axis moved ...". */
const JOINT = /(?<=.)(?=[;:,] | and )/gs;
/** A row that says something of a key or device in front of it: "camera.white_level must be a number". */
const PREDICATE = /^(is|are|must|has|had|holds|does|needs|names|shows|cannot|accepts|refers) /;
/** Words that stand in front of a predicate at most, such as `pattern "fringe"`. */
const SUBJECT_WORDS = 3;

/** The parts of a sentence that has no row itself, if some have one; put together they are the sentence. */
export function partsOf(sentence: string): string[] | undefined {
  const [, prefix, rest] = PREFIX.exec(sentence) ?? [];
  if (prefix && rest && (faultOf(rest) || faultOf(prefix))) return [prefix, ': ', rest];
  for (const { index } of sentence.matchAll(JOINT)) {
    const tail = sentence.slice(index);
    const head = sentence.slice(0, index);
    if (faultOf(tail) || faultOf(head)) return [head, tail];
  }
  const [, sign, after] = /^([;:,] )(.+)$/s.exec(sentence) ?? [];
  if (sign && after) return [sign, after];
  const words = sentence.split(' ');
  for (let n = 1; n <= SUBJECT_WORDS && n < words.length; n++) {
    const predicate = words.slice(n).join(' ');
    if (PREDICATE.test(predicate) && faultOf(predicate)) return [words.slice(0, n).join(' '), ' ', predicate];
  }
  return prefix && rest ? [prefix, ': ', rest] : undefined;
}

/** What was worded before, by language and sentence: the page words all that it shows again at each change. */
const wordedBefore = new Map<string, string>();

/** A value in the language of the reader; what is to be written into a file, such as `white_level = 0.5`, stays. */
function valueIn(id: FaultId, place: number, value: string): string {
  if (!/^-?\d+\.\d+$/.test(value)) return worded(value);
  return new RegExp(`[=[] ?\\{${place}\\}`).test(FAULTS[id][0]) ? value : value.replace('.', decimalMark());
}

/** A sentence of the server in the language of the reader; as it is where the catalogue has no row for it. */
export function worded(sentence: string): string {
  if (currentLanguage() === 'en' || !/[a-z]/i.test(sentence)) return sentence;
  const key = `${currentLanguage()} ${sentence}`;
  const known = wordedBefore.get(key);
  if (known !== undefined) return known;
  if (wordedBefore.size >= REMEMBERED) wordedBefore.clear();
  const words = wordsFor(sentence);
  wordedBefore.set(key, words);
  return words;
}

function wordsFor(sentence: string): string {
  const fault = faultOf(sentence);
  if (fault) return t(fault.id, Object.fromEntries(fault.values.map((value, i) => [i, valueIn(fault.id, i, value)])));
  return partsOf(sentence)?.map(worded).join('') ?? sentence;
}
