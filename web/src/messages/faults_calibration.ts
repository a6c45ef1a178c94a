import type { Rows } from './rows';

/** Failures and findings of a calibration and of the search for the axis. `tools/check_faults.py` explains them. */
export const FAULTS_CALIBRATION = {
  'fault.fewPoses': [
    'the scan has {0}; capture at least {1} poses, each tilted another way',
    'es sind nur {0}; mindestens {1} Lagen aufnehmen, jede anders geneigt',
    'ce ne sono solo {0}; riprendere almeno {1} pose, ognuna inclinata in modo diverso',
  ],
  'fault.boardFoundIn': [
    'the board is found in {0} of {1}, and {2} are needed; it is not found in {3}: show all of it, flat, sharp and lit',
    'das Brett ist in {0} von {1} zu finden, {2} sind nötig; nicht in {3}: es ganz zeigen, flach, scharf und beleuchtet',
    'la scacchiera si trova in {0} di {1}, e ne servono {2}; non in {3}: mostrarla tutta, piana, nitida e illuminata',
  ],
  'fault.parallel': [
    'all poses of the board are parallel within {0} degrees, which leaves the focal lengths open; tilt the board by 20 to 40 degrees, each time another way',
    'alle Lagen des Bretts sind auf {0} Grad parallel, was die Brennweiten offen lässt; das Brett um 20 bis 40 Grad neigen, jedes Mal anders',
    'tutte le pose sono parallele entro {0} gradi, e le focali restano indeterminate; inclinare la scacchiera di 20–40 gradi, ogni volta in modo diverso',
  ],
  'fault.noFringesOnBoard': [
    'the fringes cannot be measured on the board in {0}: light the whole board by the projector, in focus and out of bright room light',
    'in {0} sind die Streifen auf dem Brett nicht zu messen: das ganze Brett scharf vom Projektor beleuchten, nicht in hellem Raumlicht',
    'in {0} le frange non si misurano sulla scacchiera: illuminarla tutta col proiettore, a fuoco e lontano dalla luce forte',
  ],
  'fault.boardUnfocused': [
    'the image is out of focus or moving in {0}, so that the board is not found there; close the aperture or place the board nearer to the focus',
    'das Bild ist in {0} unscharf oder bewegt, so dass das Brett dort fehlt; die Blende schließen oder das Brett näher an den Fokus halten',
    "l'immagine è sfocata o mossa in {0}, e la scacchiera non si trova; chiudere il diaframma o avvicinarla al fuoco",
  ],
  'fault.notAPlane': [
    'the phases on the board in {0} are not those of a plane: frames are swapped, missing or out of step, or shifts_deg or period_px are wrong',
    'die Phasen auf dem Brett sind in {0} nicht die einer Ebene: Bilder vertauscht, fehlend oder nicht im Takt; die Verzögerung neu messen',
    'in {0} le fasi sulla scacchiera non sono quelle di un piano: fotogrammi scambiati, mancanti o fuori tempo; misurare di nuovo la latenza',
  ],
  'fault.otherBoard': [
    'board.corners in scan.toml is [{0}, {1}], but {2} {3} a checkerboard of {4} x {5} inner corners; set corners = [{6}, {7}]',
    'angegeben sind {0} × {1} Ecken, aber {2} {3} ein Schachbrett mit {4} × {5} inneren Ecken; diese angeben',
    'sono indicati {0} × {1} angoli, ma {2} {3} una scacchiera di {4} × {5} angoli interni; indicare questi',
  ],
  'fault.mirroredMarkers': [
    "the images of {0} show the markers of the board mirrored: switch off the camera's mirroring, or print the board again without mirroring",
    'die Bilder von {0} zeigen die Marken gespiegelt: die Spiegelung der Kamera abschalten oder das Brett ungespiegelt drucken',
    'le immagini di {0} mostrano i marcatori speculari: disattivare la specularità della camera o ristampare la scacchiera',
  ],
  'fault.mirroredFringes': [
    "one fringe direction runs backwards, so that the projector's or the camera's image is mirrored: switch off their mirroring (a ChArUco board tells which), or reverse the sign of shifts_deg of that direction",
    'eine Streifenrichtung läuft rückwärts, das Bild des Projektors oder der Kamera ist also gespiegelt: die Spiegelung abschalten',
    "una direzione delle frange corre all'indietro: l'immagine del proiettore o della camera è speculare; disattivare la specularità",
  ],
  'fault.outsideProjector': [
    '{0} of {1} points of the board lie outside of the projector of {2} x {3} pixels; check projector.size_px and the periods and directions of the patterns',
    '{0} von {1} Punkten des Bretts liegen außerhalb des Projektors von {2} × {3} Pixeln; die Auflösung des Projektors prüfen',
    '{0} di {1} punti della scacchiera sono fuori dal proiettore di {2} × {3} pixel; controllare la risoluzione del proiettore',
  ],
  'fault.darkBoard': [
    'the board is too dark in {0}: its light squares reach less than {1} % of white; expose longer or open the aperture',
    'das Brett ist in {0} zu dunkel: seine hellen Felder erreichen weniger als {1} % von Weiß; länger belichten oder die Blende öffnen',
    'la scacchiera è troppo scura in {0}: le caselle chiare restano sotto il {1} % del bianco; esporre di più o aprire il diaframma',
  ],
  'fault.brightBoard': [
    'the board is overexposed in {0}: more than {1} % of its pixels are saturated; expose shorter',
    'das Brett ist in {0} überbelichtet: mehr als {1} % seiner Pixel sind gesättigt; kürzer belichten',
    'la scacchiera è sovraesposta in {0}: più del {1} % dei pixel è saturo; esporre di meno',
  ],
  'fault.shiftsNotFollowed': [
    'the frames of pattern "{0}" in {1} do not follow its shifts: frames are swapped or out of step, or shifts_deg in scan.toml is wrong',
    'die Bilder des Musters „{0}“ in {1} folgen seinen Schritten nicht: vertauscht oder nicht im Takt; die Verzögerung neu messen',
    'i fotogrammi del motivo «{0}» in {1} non seguono i suoi passi: scambiati o fuori tempo; misurare di nuovo la latenza',
  ],
  'fault.blurredBoard': [
    'the board is out of focus or moving in {0}: its edges are blurred by {1} px; close the aperture or place the board nearer to the focus',
    'das Brett ist in {0} unscharf oder bewegt: seine Kanten sind um {1} px verwischt; die Blende schließen oder das Brett näher an den Fokus halten',
    'la scacchiera è sfocata o mossa in {0}: i bordi sono sfumati di {1} px; chiudere il diaframma o avvicinarla al fuoco',
  ],
  'fault.exchangedViews': [
    'pattern "{0}" in {1} shows the board at another place than the other frames of the view: frames of two views are exchanged, or the board was moved between the patterns',
    'das Muster „{0}“ in {1} zeigt das Brett an anderer Stelle als die übrigen Bilder: zwei Ansichten vertauscht, oder das Brett wurde bewegt',
    'il motivo «{0}» in {1} mostra la scacchiera in un altro posto: due viste scambiate, o la scacchiera è stata mossa',
  ],
  'fault.movedPose': [
    'the board or the camera moved during the capture of {0}, by {1} px up to pattern "{2}"; fix both while a pose is captured',
    'Brett oder Kamera bewegten sich während {0}, um {1} px bis zum Muster „{2}“; beide während der Aufnahme festhalten',
    'la scacchiera o la camera si è mossa durante {0}, di {1} px fino al motivo «{2}»; fissarle entrambe durante la ripresa',
  ],
  'fault.notLinear': [
    'the projector is not linear: its fringes deviate from a sinusoid by {0} % of their modulation; switch off its gamma and image enhancement, or measure its response',
    'der Projektor ist nicht linear: seine Streifen weichen um {0} % ihrer Modulation vom Sinus ab; Gamma und Bildverbesserung abschalten oder die Kennlinie messen',
    'il proiettore non è lineare: le frange deviano dalla sinusoide del {0} % della modulazione; disattivare gamma e miglioramenti, o misurarne la risposta',
  ],
  'fault.outlierPose': [
    '{0}: the reprojection error of {1} is {2} px, {3} times the median of all poses; the board or the camera moved during its capture, or its corners are blurred or badly lit',
    '{0}: der Rückprojektionsfehler von {1} ist {2} px, {3}-mal der Median aller Lagen; Brett oder Kamera bewegt, oder Ecken unscharf oder schlecht beleuchtet',
    "{0}: l'errore di riproiezione di {1} è {2} px, {3} volte la mediana delle pose; la scacchiera o la camera si è mossa, o gli angoli sono sfocati o mal illuminati",
  ],
  'fault.contradictingPoses': [
    'the poses contradict each other: the reprojection error of {0} is {1} px, largest in {2}; check board.corners and that the board is stiff',
    'die Lagen widersprechen sich: der Rückprojektionsfehler von {0} ist {1} px, am größten in {2}; die Zahl der Ecken prüfen und ob das Brett steif ist',
    "le pose si contraddicono: l'errore di riproiezione di {0} è {1} px, massimo in {2}; controllare il numero di angoli e che la scacchiera sia rigida",
  ],
  'fault.contradictingFringes': [
    "the fringes contradict the board: the projector's reprojection error, seen by {0}, is {1} px, largest in {2}; check the order of the frames, shifts_deg and that nothing moved during the capture",
    'die Streifen widersprechen dem Brett: der Rückprojektionsfehler des Projektors, gesehen von {0}, ist {1} px, am größten in {2}; Verzögerung neu messen und nichts bewegen',
    "le frange contraddicono la scacchiera: l'errore del proiettore, visto da {0}, è {1} px, massimo in {2}; misurare di nuovo la latenza e non muovere nulla",
  ],
  'fault.scaleOfBoard': [
    '{0} is {1} mm from the camera, but {2} in rig.toml states {3} mm: if that is right, board.{4} is {5} mm, not {6} mm',
    '{0} ist {1} mm von der Kamera entfernt, angegeben sind {3} mm: stimmt das, so misst ein Feld {5} mm, nicht {6} mm',
    '{0} dista {1} mm dalla camera, ma sono indicati {3} mm: se è giusto, una casella misura {5} mm, non {6} mm',
  ],
  'fault.undetermined': [
    'the poses do not determine {0}; capture more poses that fill the image and are tilted by 20 to 40 degrees, each another way',
    'die Lagen bestimmen nicht: {0}; mehr Lagen aufnehmen, die das Bild füllen und um 20 bis 40 Grad geneigt sind, jede anders',
    "le pose non determinano {0}; riprenderne altre che riempiano l'immagine, inclinate di 20–40 gradi, ognuna in modo diverso",
  ],
  'fault.boardNotFoundIn': [
    'the board is not found in {0}; the other {1} poses are used',
    'in {0} ist das Brett nicht zu finden; die anderen {1} Lagen werden benutzt',
    'in {0} la scacchiera non si trova; si usano le altre {1} pose',
  ],
  'fault.boardNotFoundInViews': [
    'the board is not found in {0}; the other {1} views are used',
    'in {0} ist das Brett nicht zu finden; die anderen {1} Ansichten werden benutzt',
    'in {0} la scacchiera non si trova; si usano le altre {1} viste',
  ],
  'fault.noConvergence': [
    "the calibration does not converge; check the board's corners and square, and the views for one that is swapped or out of step",
    'die Kalibrierung konvergiert nicht; Zahl der Ecken und Feldgröße prüfen, und ob Bilder nicht im Takt sind',
    'la calibrazione non converge; controllare angoli e casella, e che nessun fotogramma sia fuori tempo',
  ],
  'fault.fewBoardPoses': [
    'the board is found in {0} of at least {1} poses; capture more, each tilted another way',
    'das Brett ist in {0} von mindestens {1} Lagen zu finden; mehr aufnehmen, jede anders geneigt',
    'la scacchiera si trova in {0} di almeno {1} pose; riprenderne altre, ognuna inclinata in modo diverso',
  ],
  'fault.noPhaseBothWays': [
    'no point of the board has a phase in both fringe directions; capture both',
    'kein Punkt des Bretts hat eine Phase in beiden Streifenrichtungen; den Projektor auf das Brett richten',
    'nessun punto della scacchiera ha una fase in entrambe le direzioni; puntare il proiettore sulla scacchiera',
  ],
  'fault.fewAxisViews': [
    'the board is found in {0} of at least {1} views; turn the table by smaller steps, so that camera and projector see the board',
    'das Brett ist in {0} von mindestens {1} Ansichten zu finden; es so aufstellen, dass Kamera und Projektor es sehen',
    'la scacchiera si trova in {0} di almeno {1} viste; disporla in modo che camera e proiettore la vedano',
  ],
  'fault.doesNotTurn': [
    "the board does not turn by the angles of scan.toml: the camera's reprojection error is {0} px; check angle_deg of each view, and that the board stands still on the turntable",
    'das Brett dreht sich nicht um die befohlenen Winkel: der Rückprojektionsfehler ist {0} px; prüfen, ob der Tisch dreht und das Brett fest darauf steht',
    "la scacchiera non gira degli angoli comandati: l'errore di riproiezione è {0} px; controllare che la tavola giri e che la scacchiera vi stia ferma",
  ],
  'fault.axisDown': [
    'the axis of the turntable points down in the image: the table turns against the sense of angle_deg, or the camera is upside down',
    'die Achse zeigt im Bild nach unten: der Tisch dreht verkehrt herum, oder die Kamera steht auf dem Kopf',
    "l'asse della tavola punta verso il basso: la tavola gira al contrario, o la camera è capovolta",
  ],
  'fault.axisNoConvergence': [
    'the axis of the turntable does not converge',
    'die Achse des Drehtischs ist so nicht zu finden; das Brett steifer aufstellen und neu versuchen',
    "l'asse della tavola non converge; sistemare meglio la scacchiera e riprovare",
  ],
  'fault.boardUnknown': [
    'square_mm: the board is not known; state columns, rows and square_mm',
    'das Brett ist nicht bekannt; Ecken und Feldgröße angeben',
    'la scacchiera non è nota; indicare angoli e casella',
  ],
  'fault.rulerLength': [
    'ruler_mm: the ruler of a printed board is 100 mm long; measure it and state its length',
    'das Lineal auf dem Druck ist 100 mm lang; messen und seine Länge angeben',
    'il righello della stampa è lungo 100 mm; misurarlo e indicarne la lunghezza',
  ],
} as const satisfies Rows;
