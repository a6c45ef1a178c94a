import type { Rows } from './rows';

/** Failures and warnings of patterns, directions and indirect light. `tools/check_faults.py` explains them. */
export const FAULTS_FRINGES = {
  'fault.laserSheetPoints': [
    'by the laser sheet, from {0} points',
    'durch das Laserblatt, aus {0} Punkten',
    'dal foglio laser, da {0} punti',
  ],
  'fault.startDegreesDegrees': [
    'a start of {0} degrees, not {1} degrees',
    'ein Beginn bei {0} Grad statt {1} Grad',
    'un inizio a {0} gradi, non {1} gradi',
  ],
  'fault.shiftsOppositeDirection': [
    'shifts in the opposite direction',
    'Verschiebungen in Gegenrichtung',
    'sfasamenti nel verso opposto',
  ],
  'fault.shiftsOppositeDirection2': [
    'shifts in the opposite direction and {0}',
    'Verschiebungen in Gegenrichtung und {0}',
    'sfasamenti nel verso opposto e {0}',
  ],
  'fault.indirectLightPart': [
    'indirect light: the part lights its own concave sides (reflectance {0}); {1} {2} mm {3} in sigma, more than half of the noise at {4} % of the points',
    'indirektes Licht: das Teil beleuchtet seine eigenen hohlen Seiten (Reflexionsgrad {0}); {1} {2} mm {3} in Sigma, mehr als die Hälfte des Rauschens bei {4} % der Punkte',
    'luce indiretta: il pezzo illumina le proprie parti concave (riflettanza {0}); {1} {2} mm {3} in sigma, più della metà del rumore nel {4} % dei punti',
  ],
  'fault.depthCorrectedWhat': [
    'the depth is corrected by what the surface predicts, and up to',
    'die Tiefe wird um die Vorhersage der Oberfläche berichtigt, und bis zu',
    'la profondità è corretta secondo la superficie, e fino a',
  ],
  'fault.depthCorrectedUp': [
    'the depth is not corrected, and up to',
    'die Tiefe wird nicht berichtigt, und bis zu',
    'la profondità non è corretta, e fino a',
  ],
  'fault.projectOnlyFine': [
    '{0}; project only fine fringes, as a plan for indirect light proposes',
    '{0}; nur feine Streifen projizieren, wie es ein Plan für indirektes Licht vorschlägt',
    '{0}; proiettare solo frange fini, come propone un piano per la luce indiretta',
  ],
  'fault.fringesOverField': [
    'fringes over the field are {0}; they must be from 1 to {1}',
    '{0} Streifen über dem Feld; es müssen 1 bis {1} sein',
    'le frange sul campo sono {0}; devono essere da 1 a {1}',
  ],
  'fault.sequenceChooseDoubling': [
    'there is no sequence "{0}"; choose doubling, negative-exponential, or heterodyne',
    'die Sequenz „{0}“ gibt es nicht; doubling, negative-exponential oder heterodyne wählen',
    'la sequenza «{0}» non esiste; scegliere doubling, negative-exponential o heterodyne',
  ],
  'fault.sequenceKeepsProbability': [
    'no sequence keeps the probability of a wrong order below {0} at a sigma of {1} rad; take more frames per map or more light',
    'keine Sequenz hält die Wahrscheinlichkeit einer falschen Ordnung bei einem Sigma von {1} rad unter {0}; mehr Bilder je Karte oder mehr Licht nehmen',
    'nessuna sequenza mantiene la probabilità di un ordine sbagliato sotto {0} con un sigma di {1} rad; usare più fotogrammi per mappa o più luce',
  ],
  'fault.stripeBrightPattern': [
    'is_stripe_bright: the pattern has no such frame',
    'das Muster hat kein solches Bild',
    'il pattern non ha un tale fotogramma',
  ],
  'fault.mapsFringesKeep': [
    'no {0} maps from {1} to {2} fringes keep the probability of a wrong order below {3} at a sigma of {4} rad; take more `maps`, a lower `lowest`, or more light',
    'keine {0} Karten von {1} bis {2} Streifen halten die Wahrscheinlichkeit einer falschen Ordnung bei einem Sigma von {4} rad unter {3}; mehr Karten, gröbere Streifen oder mehr Licht nehmen',
    'nessuna serie di {0} mappe da {1} a {2} frange mantiene la probabilità di un ordine sbagliato sotto {3} con un sigma di {4} rad; usare più mappe, frange più larghe o più luce',
  ],
  'fault.kindLineDigital': [
    'is of kind line, which a digital projector does not show',
    'ist von der Art line, die ein Digitalprojektor nicht zeigt',
    'è di tipo line, che un proiettore digitale non mostra',
  ],
  'fault.needsPeriodPx': [
    'needs a period_px above 0 to be shown by a digital projector',
    'braucht ein period_px über 0, damit ein Digitalprojektor es zeigt',
    'richiede un period_px maggiore di 0 perché un proiettore digitale lo mostri',
  ],
  'fault.frameNumber': [
    'has no frame of this number',
    'hat kein Bild dieser Nummer',
    'non ha un fotogramma con questo numero',
  ],
  'fault.fringesScanToml': [
    'the fringes that scan.toml calls vertical run horizontally: direction = "horizontal" fits',
    'die Streifen, die scan.toml senkrecht nennt, laufen waagerecht: direction = "horizontal" passt',
    'le frange che scan.toml chiama verticali sono orizzontali: va bene direction = "horizontal"',
  ],
  'fault.fringesScanTomlCalls': [
    'the fringes that scan.toml calls horizontal run vertically: direction = "vertical" fits',
    'die Streifen, die scan.toml waagerecht nennt, laufen senkrecht: direction = "vertical" passt',
    'le frange che scan.toml chiama orizzontali sono verticali: va bene direction = "vertical"',
  ],
  'fault.phaseVerticalFringes': [
    'the phase of the vertical fringes falls where the rig makes it rise: shifts in the opposite direction fit in all their patterns, or a projector or camera whose picture is mirrored left to right',
    'die Phase der senkrechten Streifen fällt, wo der Aufbau sie steigen lässt: Verschiebungen in Gegenrichtung passen in allen ihren Mustern, oder ein Projektor oder eine Kamera mit links-rechts gespiegeltem Bild',
    "la fase delle frange verticali cala dove l'apparato la fa crescere: vanno bene sfasamenti nel verso opposto in tutti i loro pattern, o un proiettore o una camera con l'immagine specchiata in orizzontale",
  ],
  'fault.phaseHorizontalFringes': [
    'the phase of the horizontal fringes falls where the rig makes it rise: shifts in the opposite direction fit in all their patterns, or a projector or camera whose picture is mirrored upside down',
    'die Phase der waagerechten Streifen fällt, wo der Aufbau sie steigen lässt: Verschiebungen in Gegenrichtung passen in allen ihren Mustern, oder ein Projektor oder eine Kamera mit kopfstehendem Bild',
    "la fase delle frange orizzontali cala dove l'apparato la fa crescere: vanno bene sfasamenti nel verso opposto in tutti i loro pattern, o un proiettore o una camera con l'immagine capovolta",
  ],
} as const satisfies Rows;
