import type { Rows } from './rows';

/** Texts of the comparison with a reference. */
export const COMPARE = {
  'compare.title': ['Compare with a reference', 'Mit einer Referenz vergleichen'],
  'compare.lead': [
    'A CAD model or another mesh (STEP, STL, PLY, OBJ, 3MF), in millimetres unless the file states its unit.',
    'Ein CAD-Modell oder ein anderes Netz (STEP, STL, PLY, OBJ, 3MF), in Millimetern, wenn die Datei keine Einheit nennt.',
  ],
  'compare.choose': ['Choose a file', 'Datei wählen'],
  'compare.other': ['Another file', 'Andere Datei'],
  'compare.sending': ['Sending {share} %', 'Senden {share} %'],
  'compare.align': ['Alignment', 'Ausrichtung'],
  'compare.bestFit': ['Best fit', 'Bestpassung'],
  'compare.none': ['As it stands', 'Wie sie liegt'],
  'compare.lower': ['From, mm', 'Von, mm'],
  'compare.upper': ['To, mm', 'Bis, mm'],
  'compare.run': ['Compare', 'Vergleichen'],
  'compare.in': ['In tolerance', 'In der Toleranz'],
  'compare.out': ['Out of tolerance', 'Außerhalb der Toleranz'],
  'compare.undecided': ['Not decided', 'Nicht entschieden'],
  'compare.inShare': ['Proven in', 'Sicher innerhalb'],
  'compare.outShare': ['Proven out', 'Sicher außerhalb'],
  'compare.openShare': ['Undecided', 'Unentschieden'],
  'compare.notMeasured': ['Not measured', 'Nicht gemessen'],
  'compare.range': ['Smallest, largest', 'Kleinste, größte'],
  'compare.rms': ['RMS', 'RMS'],
  'compare.mean': ['Mean', 'Mittel'],
  'compare.u': ['Standard uncertainty, median', 'Standardunsicherheit, Median'],
  'compare.fitted': [
    'Turned by {turned}° and moved by {moved} mm; {overlap} % of the surface lies on the reference.',
    'Um {turned}° gedreht und um {moved} mm verschoben; {overlap} % der Fläche liegen auf der Referenz.',
  ],
  'compare.stands': [
    'As it stands; {overlap} % of the surface lies on the reference.',
    'Wie sie liegt; {overlap} % der Fläche liegen auf der Referenz.',
  ],
  'compare.leftOut': [
    '{count} vertices were left out: edges, synthesized ones, or nothing opposite.',
    '{count} Punkte blieben außer Acht: Kanten, ergänzte, oder ohne Gegenüber.',
  ],
  'compare.free': ['Not determined by the shape: {motion}', 'Durch die Form nicht bestimmt: {motion}'],
  'compare.pose': ['Pose', 'Lage'],
  'compare.poses': [
    'The surface fits the reference alike in {count} poses. Choose the one in which the part is meant.',
    'Die Fläche passt in {count} Lagen gleich gut auf die Referenz. Bitte die gemeinte wählen.',
  ],
  'compare.wrongFile': [
    'This is no STL, PLY, OBJ, 3MF or STEP file. Choose another one.',
    'Das ist keine STL-, PLY-, OBJ-, 3MF- oder STEP-Datei. Bitte eine andere wählen.',
  ],
} as const satisfies Rows;
