import type { Rows } from './rows';

/** Texts of the comparison with a reference. */
export const COMPARE = {
  'compare.title': ['Compare with a reference', 'Mit einer Referenz vergleichen', 'Confronta con un riferimento'],
  'compare.lead': [
    'A CAD model or another mesh (STEP, STL, PLY, OBJ, 3MF), in millimetres unless the file states its unit.',
    'Ein CAD-Modell oder ein anderes Netz (STEP, STL, PLY, OBJ, 3MF), in Millimetern, wenn die Datei keine Einheit nennt.',
    "Un modello CAD o un'altra mesh (STEP, STL, PLY, OBJ, 3MF), in millimetri se il file non indica un'unità.",
  ],
  'compare.choose': ['Choose a file', 'Datei wählen', 'Scegli un file'],
  'compare.other': ['Another file', 'Andere Datei', 'Altro file'],
  'compare.sending': ['Sending {share} %', 'Senden {share} %', 'Invio {share} %'],
  'compare.align': ['Alignment', 'Ausrichtung', 'Allineamento'],
  'compare.bestFit': ['Best fit', 'Bestpassung', 'Migliore adattamento'],
  'compare.none': ['As it stands', 'Wie sie liegt', "Così com'è"],
  'compare.lower': ['From, mm', 'Von, mm', 'Da, mm'],
  'compare.upper': ['To, mm', 'Bis, mm', 'A, mm'],
  'compare.run': ['Compare', 'Vergleichen', 'Confronta'],
  'compare.in': ['In tolerance', 'In der Toleranz', 'In tolleranza'],
  'compare.out': ['Out of tolerance', 'Außerhalb der Toleranz', 'Fuori tolleranza'],
  'compare.undecided': ['Not decided', 'Nicht entschieden', 'Non deciso'],
  'compare.inShare': ['Proven in', 'Sicher innerhalb', 'Dentro, provato'],
  'compare.outShare': ['Proven out', 'Sicher außerhalb', 'Fuori, provato'],
  'compare.openShare': ['Undecided', 'Unentschieden', 'Indeciso'],
  'compare.notMeasured': ['Not measured', 'Nicht gemessen', 'Non misurato'],
  'compare.range': ['Smallest, largest', 'Kleinste, größte', 'Minimo, massimo'],
  'compare.rms': ['RMS', 'RMS', 'RMS'],
  'compare.mean': ['Mean', 'Mittel', 'Media'],
  'compare.u': ['Standard uncertainty, median', 'Standardunsicherheit, Median', 'Incertezza tipo, mediana'],
  'compare.fitted': [
    'Turned by {turned}° and moved by {moved} mm; {overlap} % of the surface lies on the reference.',
    'Um {turned}° gedreht und um {moved} mm verschoben; {overlap} % der Fläche liegen auf der Referenz.',
    'Girata di {turned}° e spostata di {moved} mm; il {overlap} % della superficie sta sul riferimento.',
  ],
  'compare.stands': [
    'As it stands; {overlap} % of the surface lies on the reference.',
    'Wie sie liegt; {overlap} % der Fläche liegen auf der Referenz.',
    "Così com'è; il {overlap} % della superficie sta sul riferimento.",
  ],
  'compare.leftOut': [
    '{count} vertices were left out: edges, synthesized ones, or nothing opposite.',
    '{count} Punkte blieben außer Acht: Kanten, ergänzte, oder ohne Gegenüber.',
    '{count} vertici esclusi: spigoli, aggiunti, o senza nulla di fronte.',
  ],
  'compare.free': [
    'Not determined by the shape: {motion}',
    'Durch die Form nicht bestimmt: {motion}',
    'Non determinato dalla forma: {motion}',
  ],
  'compare.pose': ['Pose', 'Lage', 'Posa'],
  'compare.poses': [
    'The surface fits the reference alike in {count} poses. Choose the one in which the part is meant.',
    'Die Fläche passt in {count} Lagen gleich gut auf die Referenz. Bitte die gemeinte wählen.',
    'La superficie si adatta ugualmente in {count} pose. Scegliere quella in cui il pezzo è inteso.',
  ],
  'compare.wrongFile': [
    'This is no STL, PLY, OBJ, 3MF or STEP file. Choose another one.',
    'Das ist keine STL-, PLY-, OBJ-, 3MF- oder STEP-Datei. Bitte eine andere wählen.',
    'Non è un file STL, PLY, OBJ, 3MF o STEP. Sceglierne un altro.',
  ],
} as const satisfies Rows;
