import type { Rows } from './rows';

/** Failures and warnings of rig.toml and other TOML files. `tools/check_faults.py` explains them. */
export const FAULTS_RIG = {
  'fault.boardDictionaryOne': [
    'board.dictionary is "{0}"; it must be one of DICT_4X4_50 to DICT_7X7_250, with 50, 100 or 250 markers',
    'board.dictionary ist „{0}“; möglich sind DICT_4X4_50 bis DICT_7X7_250, mit 50, 100 oder 250 Markern',
    'board.dictionary è «{0}»; deve essere fra DICT_4X4_50 e DICT_7X7_250, con 50, 100 o 250 marcatori',
  ],
  'fault.boardFirstId': [
    'board.first_id must not be negative',
    'board.first_id darf nicht negativ sein',
    'board.first_id non deve essere negativo',
  ],
  'fault.boardDictionaryBut': [
    'board.dictionary is "{0}", but the board has {1} markers from id {2} on; choose a larger dictionary',
    'board.dictionary ist „{0}“, aber das Brett hat {1} Marker ab Nummer {2}; ein größeres Wörterbuch wählen',
    'board.dictionary è «{0}», ma la scacchiera ha {1} marcatori dal numero {2}; scegliere un dizionario più grande',
  ],
  'fault.boardMarkerMm': [
    'board.marker_mm is {0}; it must be above 0 and below square_mm = {1}',
    'board.marker_mm ist {0}; der Wert muss über 0 und unter square_mm = {1} liegen',
    'board.marker_mm è {0}; deve essere maggiore di 0 e minore di square_mm = {1}',
  ],
  'fault.boardCountLeast': [
    'board.{0} is [{1}, {2}]; count the {3}, at least {4} each way',
    'board.{0} ist [{1}, {2}]; zu zählen sind {3}, mindestens {4} je Richtung',
    'board.{0} è [{1}, {2}]; contare {3}, almeno {4} per direzione',
  ],
  'fault.boardGiveMillimetres': [
    'board.{0} is {1}; give the {2} in millimetres',
    'board.{0} ist {1}; {2} in Millimetern angeben',
    'board.{0} è {1}; indicare {2} in millimetri',
  ],
  'fault.distanceBetweenTwo': ['distance between two circles', 'Abstand zweier Kreise', 'distanza fra due cerchi'],
  'fault.sideSquare': ['side of a square', 'Seite eines Felds', 'lato di una casella'],
  'fault.boardDiameterMm': [
    'board.diameter_mm is {0}; it must be above 0 and below spacing_mm = {1}',
    'board.diameter_mm ist {0}; der Wert muss über 0 und unter spacing_mm = {1} liegen',
    'board.diameter_mm è {0}; deve essere maggiore di 0 e minore di spacing_mm = {1}',
  ],
  'fault.nameFileSame': [
    'must be the name of a file in the same folder',
    'muss der Name einer Datei im selben Ordner sein',
    'deve essere il nome di un file nella stessa cartella',
  ],
  'fault.lengthUnitVector': [
    'has length {0}; it must be a unit vector',
    'hat die Länge {0}; es muss ein Einheitsvektor sein',
    'ha lunghezza {0}; deve essere un versore',
  ],
  'fault.isItMustNot': [
    'is {0}; it must not be negative',
    'ist {0}; der Wert darf nicht negativ sein',
    'è {0}; non deve essere negativo',
  ],
  'fault.rotationRowsX': [
    'is not a rotation: its rows must be the x, y and z axes in the rig frame, of unit length, perpendicular and right-handed',
    'ist keine Drehung: ihre Zeilen müssen die Achsen x, y und z im Koordinatensystem des Aufbaus sein, mit Länge 1, senkrecht zueinander und rechtshändig',
    "non è una rotazione: le righe devono essere gli assi x, y e z nel sistema dell'apparato, di lunghezza 1, perpendicolari e destrorsi",
  ],
  'fault.twoWholeNumbersWidth': [
    'must be two whole numbers, width and height, from 1 to 65535',
    'müssen zwei ganze Zahlen von 1 bis 65535 sein, Breite und Höhe',
    'devono essere due numeri interi da 1 a 65535, larghezza e altezza',
  ],
  'fault.twoNumbersAbove': [
    'must be two numbers above 0',
    'müssen zwei Zahlen über 0 sein',
    'devono essere due numeri maggiori di 0',
  ],
  'fault.numbersOpencvS': [
    "has {0} numbers; it must have 4, 5, 8, 12 or 14, in OpenCV's order: k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 tau_x tau_y",
    'hat {0} Zahlen; es müssen 4, 5, 8, 12 oder 14 sein, in der Reihenfolge von OpenCV: k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 tau_x tau_y',
    "ha {0} numeri; devono essere 4, 5, 8, 12 o 14, nell'ordine di OpenCV: k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 tau_x tau_y",
  ],
  'fault.isItMustBeOr': [
    'is {0}; it must be 0 or above',
    'ist {0}; der Wert muss 0 oder größer sein',
    'è {0}; deve essere 0 o maggiore',
  ],
  'fault.namesFolderCamera': [
    'is "{0}"; it names the folder of the camera\'s frames: use letters, digits, - and _ only',
    'ist „{0}“; es benennt den Ordner der Bilder der Kamera: nur Buchstaben, Ziffern, - und _',
    'è «{0}»; dà il nome alla cartella dei fotogrammi della camera: solo lettere, cifre, - e _',
  ],
  'fault.rejectedFolderFrames': [
    'is "rejected", the folder of frames that showed motion; choose another',
    'ist "rejected", der Ordner der Bilder mit Bewegung; einen anderen wählen',
    'è "rejected", la cartella dei fotogrammi mossi; sceglierne un\'altra',
  ],
  'fault.anotherCameraGive': [
    'is "{0}", as of another camera; give each a name of its own',
    'ist „{0}“ wie bei einer anderen Kamera; jeder einen eigenen Namen geben',
    "è «{0}», come un'altra camera; dare a ognuna il suo nome",
  ],
  'fault.referenceCameraS': [
    "is the reference camera's own centre; correct one of them",
    'ist das Zentrum der Referenzkamera selbst; eines berichtigen',
    'è il centro della camera di riferimento stessa; correggerne uno',
  ],
  'fault.twoRisingAngles': [
    'must be two rising angles between -90 and 90',
    'müssen zwei steigende Winkel zwischen -90 und 90 sein',
    'devono essere due angoli crescenti fra -90 e 90',
  ],
  'fault.riseOneNumber': [
    'must rise from 0 to 1, one number per evenly spaced level',
    'muss von 0 bis 1 steigen, eine Zahl je gleichmäßiger Stufe',
    'deve crescere da 0 a 1, un numero per ogni livello equidistante',
  ],
  'fault.cameraSOwn': [
    "is the camera's own centre; triangulation needs a baseline",
    'ist das Zentrum der Kamera selbst; Triangulation braucht eine Basis',
    'è il centro della camera stessa; la triangolazione richiede una base',
  ],
  'fault.missingTriangulationNeedsCalibrated': [
    '{0}: {1} and {2} are missing; triangulation needs a calibrated rig, only `frangia decode` does not',
    '{0}: {1} und {2} fehlen; Triangulation braucht einen kalibrierten Aufbau',
    '{0}: {1} e {2} mancano; la triangolazione richiede un apparato calibrato',
  ],
  'fault.labelNeedsTwo': [
    'is "label", which needs two cameras: add [[more_cameras]], or calibrate the projector',
    'ist "label", was zwei Kameras braucht: [[more_cameras]] ergänzen oder den Projektor kalibrieren',
    'è "label", che richiede due camere: aggiungere [[more_cameras]] o calibrare il proiettore',
  ],
  'fault.calibrateRigAgainRemove': [
    '{0}: {1}; calibrate the rig again, or remove the key covariance from [calibration] of its rig.toml',
    '{0}: {1}; den Aufbau neu kalibrieren oder covariance aus [calibration] seiner rig.toml entfernen',
    "{0}: {1}; calibrare di nuovo l'apparato o togliere covariance da [calibration] del suo rig.toml",
  ],
  'fault.valueRowFinite': [
    "the value '{0}' in the row of {1} is not a finite number",
    'der Wert „{0}“ in der Zeile von {1} ist keine endliche Zahl',
    'il valore «{0}» nella riga di {1} non è un numero finito',
  ],
  'fault.variance': ['the variance of {0} is {1}', 'die Varianz von {0} ist {1}', 'la varianza di {0} è {1}'],
  'fault.varianceButCovariances': [
    '{0} has no variance, but covariances',
    '{0} hat keine Varianz, aber Kovarianzen',
    '{0} non ha varianza, ma covarianze',
  ],
  'fault.matrixSymmetricTwo': [
    'the matrix is not symmetric: {0} and {1} have two covariances, {2} and {3}',
    'die Matrix ist nicht symmetrisch: {0} und {1} haben zwei Kovarianzen, {2} und {3}',
    'la matrice non è simmetrica: {0} e {1} hanno due covarianze, {2} e {3}',
  ],
  'fault.matrixPositiveSemidefinite': [
    'the matrix is not positive semidefinite: its smallest eigenvalue, in parameters scaled to unit variance, is {0}',
    'die Matrix ist nicht positiv semidefinit: ihr kleinster Eigenwert, in Parametern der Varianz 1, ist {0}',
    'la matrice non è semidefinita positiva: il suo autovalore minimo, in parametri di varianza 1, è {0}',
  ],
  'fault.suchFileCopy': [
    '{0}: there is no such file; copy it to the folder of the rig.toml that names it, or remove the key covariance from [calibration]',
    '{0}: diese Datei gibt es nicht; sie in den Ordner der rig.toml kopieren, die sie nennt, oder covariance aus [calibration] entfernen',
    '{0}: il file non esiste; copiarlo nella cartella del rig.toml che lo nomina o togliere covariance da [calibration]',
  ],
  'fault.firstLineParameter': [
    'its first line is not parameter,NAME,...',
    'ihre erste Zeile ist nicht parameter,NAME,...',
    'la prima riga non è parameter,NAME,...',
  ],
  'fault.parameterRig': [
    "'{0}' is not a parameter of this rig",
    '„{0}“ ist kein Parameter dieses Aufbaus',
    '«{0}» non è un parametro di questo apparato',
  ],
  'fault.rowMissing': ['the row of {0} is missing', 'die Zeile von {0} fehlt', 'manca la riga di {0}'],
  'fault.rowStandsWhere': [
    "the row of '{0}' stands where that of {1} should be",
    'die Zeile von „{0}“ steht, wo die von {1} stehen müsste',
    'la riga di «{0}» è al posto di quella di {1}',
  ],
  'fault.rowValuesInstead': [
    'the row of {0} has {1} values instead of {2}',
    'die Zeile von {0} hat {1} Werte statt {2}',
    'la riga di {0} ha {1} valori invece di {2}',
  ],
  'fault.moreRowsCovariances': [
    'it has more than {0} rows of covariances',
    'sie hat mehr als {0} Zeilen mit Kovarianzen',
    'ha più di {0} righe di covarianze',
  ],
  'fault.dictionaryUnknownOne': [
    'the dictionary "{0}" is unknown; it must be one of DICT_4X4_50 to DICT_7X7_250',
    'das Wörterbuch „{0}“ ist unbekannt; möglich sind DICT_4X4_50 bis DICT_7X7_250',
    'il dizionario «{0}» è sconosciuto; deve essere fra DICT_4X4_50 e DICT_7X7_250',
  ],
  'fault.knownDistanceNames': [
    'a known distance names target {0}, but {1} has the codes 0 to {2}',
    'ein bekannter Abstand nennt Messmarke {0}, aber {1} hat die Nummern 0 bis {2}',
    'una distanza nota nomina il marcatore {0}, ma {1} ha i codici da 0 a {2}',
  ],
  'fault.isItMustBeAbove': [
    'is {0}; it must be above 0',
    'ist {0}; der Wert muss größer als 0 sein',
    'è {0}; deve essere maggiore di 0',
  ],
  'fault.listStrings': [
    'must be a list of strings',
    'muss eine Liste von Texten sein',
    'deve essere un elenco di testi',
  ],
  'fault.listNumbers2': [
    'must be a list of {0} numbers',
    'muss eine Liste von {0} Zahlen sein',
    'deve essere un elenco di {0} numeri',
  ],
  'fault.listsNumbers': [
    'must be {0} lists of {1} numbers',
    'müssen {0} Listen von {1} Zahlen sein',
    'devono essere {0} elenchi di {1} numeri',
  ],
  'fault.table': ['must be a table, [{0}]', 'muss eine Tabelle sein, [{0}]', 'deve essere una tabella, [{0}]'],
  'fault.written': ['must be written as [[{0}]]', 'muss als [[{0}]] geschrieben werden', 'va scritto come [[{0}]]'],
  'fault.unknownHere': ['is unknown here{0}', 'ist hier unbekannt{0}', 'qui è sconosciuta{0}'],
  'fault.lengthsInMetres': [
    'is {0} mm from the camera, so that the lengths of this file may be metres; they are read as millimetres',
    'ist {0} mm von der Kamera entfernt, so dass die Längen dieser Datei Meter sein können; sie gelten als Millimeter',
    'dista {0} mm dalla camera, quindi le lunghezze di questo file potrebbero essere metri; sono lette come millimetri',
  ],
  'fault.unknownIgnored': [
    '{0}: {1} is unknown and ignored',
    '{0}: {1} ist unbekannt und wird nicht beachtet',
    '{0}: {1} è sconosciuta e viene ignorata',
  ],
  'fault.perhapsMeantRename': [
    '; perhaps {0} was meant: rename it, or leave it out',
    '; vielleicht ist {0} gemeint: umbenennen oder weglassen',
    '; forse si intende {0}: rinominarla o toglierla',
  ],
  'fault.leaveOutKeys': [
    '; leave it out. The keys are {0}',
    '; weglassen. Die Schlüssel sind {0}',
    '; toglierla. Le chiavi sono {0}',
  ],
  'fault.perhapsMeantRename2': [
    '; perhaps {0} is meant as {1}: rename it',
    '; vielleicht ist {0} als {1} gemeint: umbenennen',
    '; forse {0} sta per {1}: rinominarla',
  ],
  'fault.number': ['must be a number', 'muss eine Zahl sein', 'deve essere un numero'],
  'fault.finiteNumber2': [
    'is {0}; it must be a finite number',
    'ist {0}; es muss eine endliche Zahl sein',
    'è {0}; deve essere un numero finito',
  ],
  'fault.butProgramReads': [
    'is {0}, but this program reads versions up to {1}: update the program',
    'ist {0}, aber dieses Programm liest Versionen bis {1}: das Programm aktualisieren',
    'è {0}, ma questo programma legge versioni fino a {1}: aggiornarlo',
  ],
} as const satisfies Rows;
