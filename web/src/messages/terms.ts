import type { Rows } from './rows';

/** What stands behind each "?": a word and its entry of docs/terms.md, of which the English text is the beginning. */
export const TERMS = {
  'term.baseline': ['baseline', 'Basis', 'base'],
  'means.baseline': [
    'distance between the centers of projection of camera and projector',
    'Abstand der Projektionszentren von Kamera und Projektor',
    'distanza fra i centri di proiezione di camera e proiettore',
  ],
  'term.contrast': ['contrast', 'Kontrast', 'contrasto'],
  'means.contrast': [
    'of fringes: modulation divided by the mean light; 1 without blur and room light',
    'von Streifen: Modulation geteilt durch das mittlere Licht; 1 ohne Unschärfe und Raumlicht',
    'di frange: modulazione divisa per la luce media; 1 senza sfocatura e senza luce della stanza',
  ],
  'term.coverage': ['coverage', 'Abdeckung', 'copertura'],
  'means.coverage': [
    'share of the nominal area that is decided to be in, out or near a limit',
    'Anteil der Sollfläche, über den entschieden ist: innerhalb, außerhalb oder nahe einer Grenze',
    "quota dell'area nominale su cui si è deciso: conforme, non conforme o vicino a un limite",
  ],
  'term.datum': ['datum', 'Bezug', 'riferimento'],
  'means.datum': [
    'feature of the part by which its coordinate system is defined',
    'Element des Teils, das sein Koordinatensystem festlegt',
    'elemento del pezzo che definisce il suo sistema di coordinate',
  ],
  'term.exposure bracket': ['exposure bracket', 'Belichtungsreihe', 'serie di esposizioni'],
  'means.exposure bracket': [
    'several exposures of the same pattern, merged into one frame',
    'mehrere Belichtungen desselben Musters, zu einem Bild vereint',
    'più esposizioni dello stesso motivo, unite in una immagine',
  ],
  'term.gap': ['gap', 'Lücke', 'lacuna'],
  'means.gap': [
    'part of the nominal surface that is not measured, or not well enough; its width is that of the largest circle within it',
    'Teil der Sollfläche, der nicht oder nicht gut genug gemessen ist; seine Weite ist die des größten Kreises darin',
    'parte della superficie nominale non misurata, o non abbastanza bene; la sua larghezza è quella del cerchio più grande in essa',
  ],
  'term.latency': ['latency', 'Verzögerung', 'ritardo'],
  'means.latency': [
    'time from the command to show a pattern until the camera sees it',
    'Zeit vom Befehl, ein Muster zu zeigen, bis die Kamera es sieht',
    'tempo dal comando di mostrare un motivo fino a quando la camera lo vede',
  ],
  'term.mark': ['mark', 'Herkunft', 'origine'],
  'means.mark': [
    'state of a vertex or triangle: measured, displaced or synthesized',
    'Zustand eines Punkts oder Dreiecks: gemessen, verschoben oder ergänzt',
    'stato di un vertice o triangolo: misurato, spostato o aggiunto',
  ],
  'term.noise': ['noise', 'Rauschen', 'rumore'],
  'means.noise': [
    'random part of the uncertainty; fusion reduces it',
    'zufälliger Teil der Unsicherheit; das Vereinen von Ansichten verringert ihn',
    "parte casuale dell'incertezza; la fusione la riduce",
  ],
  'term.patch': ['patch', 'Flächenstück', 'zona'],
  'means.patch': [
    'round part of the nominal surface over which deviations are averaged and decided',
    'rundes Stück der Sollfläche, über das Abweichungen gemittelt und beurteilt werden',
    'parte rotonda della superficie nominale su cui gli scostamenti si mediano e si giudicano',
  ],
  'term.residual': ['residual', 'Restfehler', 'residuo'],
  'means.residual': [
    'distance between a point where it was found and where the solved model puts it',
    'Abstand zwischen einem Punkt, wo er gefunden wurde, und wo das gelöste Modell ihn erwartet',
    'distanza fra un punto dove è stato trovato e dove lo pone il modello risolto',
  ],
  'term.response': ['response', 'Kennlinie', 'risposta'],
  'means.response': [
    'light of the projector as a function of the drive level',
    'Licht des Projektors in Abhängigkeit von der Ansteuerung',
    'luce del proiettore in funzione del livello di comando',
  ],
  'term.setup': ['setup', 'Aufspannung', 'piazzamento'],
  'means.setup': [
    'one clamping of the part on the turntable',
    'eine Lage, in der das Teil auf dem Drehtisch steht',
    'una posa in cui il pezzo sta sulla tavola rotante',
  ],
  'term.sigma': ['sigma', 'Sigma', 'sigma'],
  'means.sigma': [
    'standard uncertainty, with its unit',
    'Standardunsicherheit, mit ihrer Einheit',
    'incertezza tipo, con la sua unità',
  ],
  'term.station': ['station', 'Station', 'stazione'],
  'means.station': [
    'one position of the turntable at which a view is captured',
    'eine Stellung des Drehtischs, bei der eine Ansicht aufgenommen wird',
    'una posizione della tavola rotante in cui si riprende una vista',
  ],
  'term.systematic': ['systematic', 'systematisch', 'sistematica'],
  'means.systematic': [
    'part of the uncertainty that all observations share; fusion does not reduce it',
    'Teil der Unsicherheit, den alle Beobachtungen teilen; das Vereinen verringert ihn nicht',
    "parte dell'incertezza comune a tutte le osservazioni; la fusione non la riduce",
  ],
  'term.U95': ['U95', 'U95', 'U95'],
  'means.U95': [
    'expanded uncertainty: the value lies within it with a probability of 95 %; about two sigma',
    'erweiterte Unsicherheit: Der Wert liegt mit 95 % Wahrscheinlichkeit darin; etwa zwei Sigma',
    'incertezza estesa: il valore vi sta con una probabilità del 95 %; circa due sigma',
  ],
  'term.view': ['view', 'Ansicht', 'vista'],
  'means.view': ['all frames of one station', 'alle Bilder einer Station', 'tutte le immagini di una stazione'],
  'term.voxel': ['voxel', 'Voxel', 'voxel'],
  'means.voxel': [
    'cell of the grid on which the surface is sampled',
    'Zelle des Gitters, auf dem die Fläche abgetastet wird',
    'cella della griglia su cui la superficie è campionata',
  ],
} as const satisfies Rows;
