import type { Rows } from './rows';

/** The clauses of a verdict, by their ids; docs/inspection.md lists their values. */
export const VERDICT = {
  'clause.in': [
    'In, over {share} of the nominal area',
    'Innerhalb, auf {share} der Sollfläche',
    "Conforme, sul {share} dell'area nominale",
  ],
  'clause.gap': [
    'the widest gap is {gap_mm} mm at {at_mm}',
    'die größte Lücke misst {gap_mm} mm bei {at_mm}',
    'la lacuna più larga è di {gap_mm} mm a {at_mm}',
  ],
  'clause.out_at': [
    'Out at {at_mm}: {deviation_mm} mm, U95 {u95_mm} mm',
    'Außerhalb bei {at_mm}: {deviation_mm} mm, U95 {u95_mm} mm',
    'Non conforme a {at_mm}: {deviation_mm} mm, U95 {u95_mm} mm',
  ],
  'clause.out_missing': [
    'Out at {at_mm}: surface was measured behind the nominal one, whose material is missing',
    'Außerhalb bei {at_mm}: Gemessen wurde hinter der Sollfläche, Material fehlt',
    'Non conforme a {at_mm}: la superficie misurata è dietro quella nominale, manca materiale',
  ],
  'clause.out_share': [
    '{share} of the nominal area is out',
    '{share} der Sollfläche liegen außerhalb',
    "il {share} dell'area nominale non è conforme",
  ],
  'clause.near_limit': [
    'Undecided: {share} of the nominal area lies within the uncertainty of a limit',
    'Unentschieden: {share} der Sollfläche liegen innerhalb der Unsicherheit einer Grenze',
    "Indeciso: il {share} dell'area nominale sta entro l'incertezza di un limite",
  ],
  'clause.near_limit_at': [
    'Undecided: {share} of the nominal area lies within the uncertainty of a limit, such as {at_mm} with {deviation_mm} mm, U95 {u95_mm} mm',
    'Unentschieden: {share} der Sollfläche liegen innerhalb der Unsicherheit einer Grenze, etwa {at_mm} mit {deviation_mm} mm, U95 {u95_mm} mm',
    "Indeciso: il {share} dell'area nominale sta entro l'incertezza di un limite, come {at_mm} con {deviation_mm} mm, U95 {u95_mm} mm",
  ],
  'clause.too_noisy': [
    "Undecided: {share} of the nominal area has a U95 above {u95_mm} mm, {of_half_width} of the tolerance's half-width, mostly noise",
    'Unentschieden: {share} der Sollfläche haben ein U95 über {u95_mm} mm, {of_half_width} der halben Toleranz, meist Rauschen',
    "Indeciso: il {share} dell'area nominale ha un U95 oltre {u95_mm} mm, {of_half_width} della semitolleranza, soprattutto rumore",
  ],
  'clause.too_systematic': [
    "Undecided: {share} of the nominal area has a U95 above {u95_mm} mm, {of_half_width} of the tolerance's half-width, mostly calibration and alignment",
    'Unentschieden: {share} der Sollfläche haben ein U95 über {u95_mm} mm, {of_half_width} der halben Toleranz, meist Kalibrierung und Ausrichtung',
    "Indeciso: il {share} dell'area nominale ha un U95 oltre {u95_mm} mm, {of_half_width} della semitolleranza, soprattutto calibrazione e allineamento",
  ],
  'clause.not_measured': [
    'Undecided: {share} of the nominal area was not measured and {poor_share} not well enough, wanted is {wanted_share} together at most; the widest gap is {gap_mm} mm at {at_mm}, wanted is {wanted_mm} mm at most',
    'Unentschieden: {share} der Sollfläche wurden nicht gemessen und {poor_share} nicht gut genug, höchstens {wanted_share} zusammen dürfen fehlen; die größte Lücke misst {gap_mm} mm bei {at_mm}, höchstens {wanted_mm} mm dürfen es sein',
    "Indeciso: il {share} dell'area nominale non è stato misurato e il {poor_share} non abbastanza bene, al massimo {wanted_share} insieme; la lacuna più larga è di {gap_mm} mm a {at_mm}, al massimo {wanted_mm} mm",
  ],
  'clause.gap_too_wide': [
    'the widest gap is {gap_mm} mm at {at_mm}, wanted is {wanted_mm} mm at most',
    'die größte Lücke misst {gap_mm} mm bei {at_mm}, höchstens {wanted_mm} mm dürfen es sein',
    'la lacuna più larga è di {gap_mm} mm a {at_mm}, al massimo {wanted_mm} mm',
  ],
  'clause.decidable': [
    'it is good enough for a half-width of {half_width_mm} mm',
    'sie genügt für eine halbe Toleranz von {half_width_mm} mm',
    'basta per una semitolleranza di {half_width_mm} mm',
  ],
  'clause.reduce_noise': [
    'take more views, a longer exposure or a finer pattern',
    'mehr Ansichten, längere Belichtung oder feineres Muster wählen',
    'usare più viste, una posa più lunga o un motivo più fine',
  ],
  'clause.reduce_systematic': [
    'calibrate again, or state a tolerance that this rig can decide',
    'neu kalibrieren oder eine Toleranz wählen, die dieser Aufbau entscheiden kann',
    'calibrare di nuovo, o indicare una tolleranza che questo apparato possa decidere',
  ],
  'clause.reduce_uncertainty': [
    'measure with a smaller uncertainty',
    'mit kleinerer Unsicherheit messen',
    "misurare con un'incertezza minore",
  ],
  'clause.scan_more': [
    'scan it from more stations or in another setup, or exclude it in the plan',
    'von mehr Stationen oder in einer weiteren Aufspannung scannen oder im Plan ausnehmen',
    'scandire da più stazioni o in un altro piazzamento, o escluderla nel piano',
  ],
  'clause.edges': [
    'not judged are strips of {edge_mm} mm along edges, {share} of the area',
    'nicht beurteilt sind Streifen von {edge_mm} mm entlang der Kanten, {share} der Fläche',
    "non si giudicano strisce di {edge_mm} mm lungo gli spigoli, il {share} dell'area",
  ],
  'clause.no_sigma': [
    'the mesh states no sigma, so that no uncertainty is known and the limits alone decide',
    'das Netz nennt kein Sigma: Die Unsicherheit ist unbekannt, und allein die Grenzen entscheiden',
    "la mesh non indica sigma: l'incertezza non è nota e decidono solo i limiti",
  ],
  'clause.counts': [
    'Characteristics: {of}, of which {in} in, {out} out, {undecided} undecided',
    'Merkmale: {of}, davon {in} innerhalb, {out} außerhalb, {undecided} unentschieden',
    'Caratteristiche: {of}, di cui {in} conformi, {out} non conformi, {undecided} indecise',
  ],
  'clause.worst': [
    'the worst is {name} with {value} {unit}, U95 {u95} {unit}',
    'am schlechtesten ist {name} mit {value} {unit}, U95 {u95} {unit}',
    'la peggiore è {name} con {value} {unit}, U95 {u95} {unit}',
  ],
  'clause.not_found': ['{name} was not measured', '{name} wurde nicht gemessen', '{name} non è stata misurata'],
} as const satisfies Rows;
