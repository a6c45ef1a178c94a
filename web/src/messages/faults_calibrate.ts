import type { Rows } from './rows';

/** Failures and warnings of a calibration. `tools/check_faults.py` explains them. */
export const FAULTS_CALIBRATE = {
  'fault.rowsColumnsProjector': [
    'rows and columns of the projector are exchanged: exchange the values "vertical" and "horizontal" of the key direction in scan.toml',
    'Zeilen und Spalten des Projektors sind vertauscht: in scan.toml die Werte "vertical" und "horizontal" von direction tauschen',
    'righe e colonne del proiettore sono scambiate: in scan.toml scambiare i valori "vertical" e "horizontal" di direction',
  ],
  'fault.view': ['this view is', 'diese Ansicht ist', 'questa vista è'],
  'fault.theseViews': ['these views are', 'diese Ansichten sind', 'queste viste sono'],
  'fault.imagesViewsShow': [
    'the images of {0} views show markers of {1}, ids {2} to {3}',
    'die Bilder von {0} Ansichten zeigen Marker aus {1}, Nummern {2} bis {3}',
    'le immagini di {0} viste mostrano marcatori di {1}, numeri da {2} a {3}',
  ],
  'fault.whiteBlackPrint': [
    '{0}{1}, in white on black: print the board again without inversion',
    '{0}{1}, weiß auf schwarz: das Brett ohne Umkehrung neu drucken',
    '{0}{1}, in bianco su nero: stampare di nuovo la scacchiera senza inversione',
  ],
  'fault.mirroredSwitchOff': [
    "{0}, mirrored: switch off the camera's mirroring, or print the board again without mirroring",
    '{0}, gespiegelt: die Spiegelung der Kamera abschalten oder das Brett ohne Spiegelung neu drucken',
    '{0}, specchiati: disattivare la specchiatura della camera o stampare di nuovo la scacchiera senza specchiarla',
  ],
  'fault.boardScanToml': [
    '{0}{1}, which is not the board of scan.toml{2}',
    '{0}{1}, also nicht das Brett aus scan.toml{2}',
    '{0}{1}, che non è la scacchiera di scan.toml{2}',
  ],
  'fault.rowsInnerCorners': [
    ', in rows of {0} inner corners',
    ', in Reihen von {0} inneren Ecken',
    ', in file di {0} angoli interni',
  ],
  'fault.checkCornersFirst': [
    '; check corners, first_id and legacy_layout',
    '; corners, first_id und legacy_layout prüfen',
    '; controllare corners, first_id e legacy_layout',
  ],
  'fault.setBoard': [': set {0} in [board]', ': in [board] {0} setzen', ': impostare {0} in [board]'],
  'fault.pageCannotDrawn': [
    '{0}: the page cannot be drawn: libharu reports error {1}',
    '{0}: die Seite lässt sich nicht zeichnen: libharu meldet Fehler {1}',
    "{0}: la pagina non si può disegnare: libharu segnala l'errore {1}",
  ],
  'fault.fringesAbsolutePhase': [
    'the {0} fringes have no absolute phase, which calibration needs; add coarser fringes, of which the coarsest has one period over the field',
    'die Streifen {0} haben keine absolute Phase, die eine Kalibrierung braucht; gröbere Streifen hinzufügen, die gröbsten mit einer Periode über das Feld',
    'le frange {0} non hanno una fase assoluta, che la calibrazione richiede; aggiungere frange più larghe, la più larga di un periodo su tutto il campo',
  ],
  'fault.tiltSideAway': [
    'tilt its {0} side away from the camera by 30 degrees',
    'die Seite {0} um 30 Grad von der Kamera wegkippen',
    'inclinare il lato {0} di 30 gradi via dalla camera',
  ],
  'fault.samePlaceAgain': [
    'the same place again, with the whole board in the image, sharp and evenly lit',
    'noch einmal dieselbe Stelle, das ganze Brett im Bild, scharf und gleichmäßig beleuchtet',
    "di nuovo lo stesso posto, con tutta la scacchiera nell'immagine, nitida e illuminata in modo uniforme",
  ],
  'fault.coverageSufficientAny': [
    'coverage is sufficient; any other tilt and place adds accuracy',
    'die Abdeckung reicht; jede weitere Neigung und Stelle erhöht die Genauigkeit',
    'la copertura basta; ogni altra inclinazione e posizione aumenta la precisione',
  ],
  'fault.moveBoardImage': [
    'move the board to the {0} of the image, and {1}',
    'das Brett im Bild nach {0} schieben, und {1}',
    "spostare la scacchiera verso {0} nell'immagine, e {1}",
  ],
  'fault.moveBoardNearer': [
    'move the board nearer by a tenth of its distance',
    'das Brett um ein Zehntel seines Abstands näher holen',
    'avvicinare la scacchiera di un decimo della distanza',
  ],
  'fault.moveBoardFarther': [
    'move the board farther away by a tenth of its distance',
    'das Brett um ein Zehntel seines Abstands entfernen',
    'allontanare la scacchiera di un decimo della distanza',
  ],
  'fault.boardXSquares': [
    'a board of {0} x {1} squares looks the same upside down; let one number of `corners` be odd and the other even',
    'ein Brett mit {0} × {1} Feldern sieht kopfüber gleich aus; eine Zahl muss gerade sein, die andere ungerade',
    "una scacchiera di {0} × {1} caselle appare uguale capovolta; un numero sia pari e l'altro dispari",
  ],
  'fault.squaresMmDo': [
    'squares of {0} mm do not fit on paper of {1} x {2} mm; set `square` to {3} mm or less',
    'Felder von {0} mm passen nicht auf Papier von {1} × {2} mm; {3} mm oder weniger wählen',
    'caselle di {0} mm non stanno su carta di {1} × {2} mm; scegliere {3} mm o meno',
  ],
  'fault.projectorSeen': [
    'the projector, seen by {0},',
    'der Projektor, gesehen von {0},',
    'il proiettore, visto da {0},',
  ],
  'fault.veryImageAnother': [
    '{0} {1} the very image of another view: copied files are no further poses; capture the board in another place',
    '{0} {1} genau das Bild einer anderen Ansicht: kopierte Dateien sind keine weiteren Lagen; das Brett an einer anderen Stelle aufnehmen',
    "{0} {1} la stessa immagine di un'altra vista: file copiati non sono altre pose; riprendere la scacchiera in un altro posto",
  ],
  'fault.onlyPointsBoard': [
    '{0}: only {1} points of the board are seen; leave the view out',
    '{0}: nur {1} Punkte des Bretts sind zu sehen; die Ansicht weglassen',
    '{0}: si vedono solo {1} punti della scacchiera; togliere la vista',
  ],
  'fault.cameraSeesBoard': [
    'camera "{0}" sees the board in {1} of the poses, and {2} are needed; capture poses that all cameras see',
    'Kamera „{0}“ sieht das Brett in {1} der Lagen, {2} sind nötig; Lagen aufnehmen, die alle Kameras sehen',
    'la camera «{0}» vede la scacchiera in {1} delle pose, e ne servono {2}; riprendere pose che tutte le camere vedono',
  ],
  'fault.pointsBoardDo': [
    'the points of the board do not give a pose; check board.corners and capture the poses again (OpenCV: {0})',
    'die Punkte des Bretts ergeben keine Lage; die Zahl der Ecken prüfen und die Lagen neu aufnehmen (OpenCV: {0})',
    'i punti della scacchiera non danno una posa; controllare il numero di angoli e riprendere le pose (OpenCV: {0})',
  ],
  'fault.cameraBoardFound': [
    'camera "{0}": the board is not found in {1}; the other {2} poses are used',
    'Kamera „{0}“: in {1} ist das Brett nicht zu finden; die anderen {2} Lagen werden benutzt',
    'camera «{0}»: la scacchiera non si trova in {1}; si usano le altre {2} pose',
  ],
  'fault.fringesSuchGray': [
    '{0}: there are no {1} fringes and no such Gray code; a board needs both directions, so add patterns with direction = "{2}" and capture the poses again',
    '{0}: es gibt keine Streifen {1} und keinen solchen Gray-Code; ein Brett braucht beide Richtungen: Muster mit direction = "{2}" hinzufügen und die Lagen neu aufnehmen',
    '{0}: non ci sono frange {1} né un tale codice Gray; una scacchiera richiede entrambe le direzioni: aggiungere pattern con direction = "{2}" e riprendere le pose',
  ],
  'fault.rowsColumnsProjectorExchanged': [
    '{0}: rows and columns of the projector are exchanged, the periods say: exchange the values "vertical" and "horizontal" of the key direction',
    '{0}: nach den Perioden sind Zeilen und Spalten des Projektors vertauscht: die Werte "vertical" und "horizontal" von direction tauschen',
    '{0}: secondo i periodi, righe e colonne del proiettore sono scambiate: scambiare i valori "vertical" e "horizontal" di direction',
  ],
  'fault.fringesAbsolutePhaseAdd': [
    "{0}: the {1} fringes have no absolute phase; add one with a period of the projector's {2}, and check the key direction of each pattern",
    '{0}: die Streifen {1} haben keine absolute Phase; eines mit der Periode {2} des Projektors hinzufügen und direction jedes Musters prüfen',
    '{0}: le frange {1} non hanno una fase assoluta; aggiungerne una col periodo {2} del proiettore e controllare direction di ogni pattern',
  ],
  'fault.boardMissingAdd': [
    '{0}: [board] is missing; add kind = "checkerboard", corners and square_mm',
    '{0}: [board] fehlt; kind = "checkerboard", corners und square_mm ergänzen',
    '{0}: manca [board]; aggiungere kind = "checkerboard", corners e square_mm',
  ],
  'fault.projectorModelAngular': [
    '{0}: projector.model is "angular", but a board calibrates a digital projector, model = "pinhole"',
    '{0}: projector.model ist "angular", aber ein Brett kalibriert einen Digitalprojektor, model = "pinhole"',
    '{0}: projector.model è "angular", ma una scacchiera calibra un proiettore digitale, model = "pinhole"',
  ],
  'fault.projectorModelLabel': [
    '{0}: projector.model is "label", which needs two cameras: add [[more_cameras]], or set model = "pinhole" to calibrate the projector',
    '{0}: projector.model ist "label", was zwei Kameras braucht: [[more_cameras]] ergänzen oder model = "pinhole" setzen, um den Projektor zu kalibrieren',
    '{0}: projector.model è "label", che richiede due camere: aggiungere [[more_cameras]] o impostare model = "pinhole" per calibrare il proiettore',
  ],
  'fault.boardMissingAddKind': [
    '{0}: [board] is missing; add kind, corners and square_mm',
    '{0}: [board] fehlt; kind, corners und square_mm ergänzen',
    '{0}: manca [board]; aggiungere kind, corners e square_mm',
  ],
  'fault.anglesViewsSpan': [
    'the angles of the views span {0} degrees; state angle_deg of each view in scan.toml, and turn the table by 60 to 90 degrees in all',
    'die Winkel der Ansichten umfassen {0} Grad; den Winkel jeder Ansicht angeben und den Tisch insgesamt um 60 bis 90 Grad drehen',
    "gli angoli delle viste coprono {0} gradi; indicare l'angolo di ogni vista e girare la tavola di 60–90 gradi in tutto",
  ],
} as const satisfies Rows;
