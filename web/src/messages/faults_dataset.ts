import type { Rows } from './rows';

/** Failures and warnings of a scan folder and its frames. `tools/check_faults.py` explains them. */
export const FAULTS_DATASET = {
  'fault.twoWholeNumbers': [
    'must be two whole numbers, along x and y, from 3 to 1000',
    'müssen zwei ganze Zahlen von 3 bis 1000 sein, entlang x und y',
    'devono essere due numeri interi da 3 a 1000, lungo x e y',
  ],
  'fault.twoWholeNumbersColumns': [
    'must be two whole numbers, columns and rows of the monitor',
    'müssen zwei ganze Zahlen sein, Spalten und Zeilen des Monitors',
    'devono essere due numeri interi, colonne e righe dello schermo',
  ],
  'fault.fileNamesBegin': [
    'is "{0}"; file names begin with it: use letters, digits, - and _ only',
    'ist „{0}“; Dateinamen beginnen damit: nur Buchstaben, Ziffern, - und _',
    'è «{0}»; i nomi dei file cominciano così: solo lettere, cifre, - e _',
  ],
  'fault.holdLeastShifts': [
    'must hold at least {0} shifts',
    'muss mindestens {0} Verschiebungen enthalten',
    'deve contenere almeno {0} sfasamenti',
  ],
  'fault.grayScreenShow': [
    'is "gray" on a screen; show fringes with a period of the screen\'s size',
    'ist "gray" auf einem Bildschirm; Streifen mit einer Periode von seiner Größe zeigen',
    'è "gray" su uno schermo; mostrare frange con un periodo della sua grandezza',
  ],
  'fault.grayAngularProjector': [
    'is "gray", which an angular projector cannot show',
    'ist "gray", was ein Winkelprojektor nicht zeigen kann',
    'è "gray", che un proiettore angolare non può mostrare',
  ],
  'fault.above': ['must be 0 or above', 'muss 0 oder größer sein', 'deve essere 0 o maggiore'],
  'fault.tooFewNumber': [
    "is {0}, too few to number the projector's {1} {2}",
    'ist {0}, zu wenig, um die {1} {2} des Projektors zu zählen',
    'è {0}, troppo poco per numerare le {1} {2} del proiettore',
  ],
  'fault.leastThreeRising': [
    'must be at least three rising shares of full light, from 0 to 1',
    'müssen mindestens drei steigende Anteile des vollen Lichts sein, von 0 bis 1',
    'devono essere almeno tre frazioni crescenti della luce piena, da 0 a 1',
  ],
  'fault.holdLeastOne': [
    'must hold at least one exposure, each above 0',
    'muss mindestens eine Belichtung enthalten, jede über 0',
    "deve contenere almeno un'esposizione, ognuna maggiore di 0",
  ],
  'fault.horizontalButAngular': [
    'is "horizontal", but an angular projector\'s fringes are vertical',
    'ist "horizontal", aber die Streifen eines Winkelprojektors sind senkrecht',
    'è "horizontal", ma le frange di un proiettore angolare sono verticali',
  ],
  'fault.lineButRig': [
    'is "line", but rig.toml has no [line] with the laser sheet\'s plane',
    'ist "line", aber rig.toml hat kein [line] mit der Ebene des Laserblatts',
    'è "line", ma rig.toml non ha [line] con il piano del foglio laser',
  ],
  'fault.surplusFramePattern': [
    '{0}: is a surplus frame: pattern "{1}" has {2} in scan.toml; remove the file or correct scan.toml',
    '{0}: ist ein überzähliges Bild: Muster „{1}“ hat in scan.toml {2}; die Datei entfernen oder scan.toml berichtigen',
    '{0}: è un fotogramma di troppo: il pattern «{1}» ne ha {2} in scan.toml; rimuovere il file o correggere scan.toml',
  ],
  'fault.xPixelsBut': [
    'is {0} x {1} pixels, but {2} in rig.toml is {3} x {4}',
    'hat {0} × {1} Pixel, aber {2} in rig.toml ist {3} × {4}',
    'ha {0} × {1} pixel, ma {2} in rig.toml è {3} × {4}',
  ],
  'fault.sizePxCamera': ['size_px of the camera "{0}"', 'size_px der Kamera „{0}“', 'size_px della camera «{0}»'],
  'fault.greyFloatingPoint': [
    'is not a grey floating-point TIFF, as [frames] in scan.toml states',
    'ist kein graues Gleitkomma-TIFF, wie es [frames] in scan.toml angibt',
    'non è un TIFF grigio in virgola mobile, come indica [frames] in scan.toml',
  ],
  'fault.neitherGreyNor': [
    'is neither grey nor red, green and blue; convert it',
    'ist weder grau noch rot, grün und blau; umwandeln',
    'non è né grigio né rosso, verde e blu; convertirlo',
  ],
  'fault.floatingPointImage': [
    'is a floating-point image in colour; convert it to 8 or 16 bits',
    'ist ein farbiges Gleitkommabild; in 8 oder 16 Bit umwandeln',
    "è un'immagine a colori in virgola mobile; convertirla a 8 o 16 bit",
  ],
  'fault.anotherBitDepth': [
    "has another bit depth than the view's first frame; capture the view again",
    'hat eine andere Bittiefe als das erste Bild der Ansicht; die Ansicht neu aufnehmen',
    'ha una profondità diversa dal primo fotogramma della vista; riprendere la vista',
  ],
  'fault.bitsButCamera': [
    'has 8 bits, but camera.white_level in rig.toml is {0}; set it to 255 or below',
    'hat 8 Bit, aber camera.white_level in rig.toml ist {0}; auf 255 oder weniger setzen',
    'ha 8 bit, ma camera.white_level in rig.toml è {0}; impostarlo a 255 o meno',
  ],
  'fault.holdsValueAbove': [
    "holds the value {0}, above camera.white_level = {1} in rig.toml; set it to the camera's full scale, such as 4095 for 12 bits",
    'enthält den Wert {0} über camera.white_level = {1} in rig.toml; auf den Höchstwert der Kamera setzen, etwa 4095 für 12 Bit',
    'contiene il valore {0}, oltre camera.white_level = {1} in rig.toml; impostarlo al fondo scala della camera, come 4095 per 12 bit',
  ],
  'fault.suchFolderBut': [
    '{0}: there is no such folder, but rig.toml has the camera "{1}" in [[more_cameras]]; restore its frames or remove the camera',
    '{0}: diesen Ordner gibt es nicht, aber rig.toml hat die Kamera „{1}“ in [[more_cameras]]; ihre Bilder wiederherstellen oder die Kamera entfernen',
    '{0}: la cartella non esiste, ma rig.toml ha la camera «{1}» in [[more_cameras]]; ripristinarne i fotogrammi o togliere la camera',
  ],
  'fault.suchFolderButScan': [
    '{0}: there is no such folder, but scan.toml names it; restore it or remove the view from scan.toml',
    '{0}: diesen Ordner gibt es nicht, aber scan.toml nennt ihn; ihn wiederherstellen oder die Ansicht aus scan.toml entfernen',
    '{0}: la cartella non esiste, ma scan.toml la nomina; ripristinarla o togliere la vista da scan.toml',
  ],
  'fault.rigTomlFrames': [
    '{0}: there is no rig.toml: frames of {1} x {2} pixels, white_level {3}',
    '{0}: es gibt kein rig.toml: Bilder mit {1} × {2} Pixeln, white_level {3}',
    "{0}: non c'è rig.toml: fotogrammi di {1} × {2} pixel, white_level {3}",
  ],
  'fault.projectorSSize': [
    "the projector's size is unknown: the field is taken as {0} columns and {1} rows, over which the patterns do not repeat",
    'die Größe des Projektors ist unbekannt: als Feld gelten {0} Spalten und {1} Zeilen, in denen sich die Muster nicht wiederholen',
    'la grandezza del proiettore è ignota: come campo si prendono {0} colonne e {1} righe, in cui i pattern non si ripetono',
  ],
  'fault.calledNowRename': [
    'is called {0} now; rename it',
    'heißt jetzt {0}; umbenennen',
    'ora si chiama {0}; rinominarlo',
  ],
  'fault.relativeScanFolder': [
    'is "{0}"; it must be relative to the scan folder and lie inside it',
    'ist „{0}“; es muss relativ zum Scanordner sein und darin liegen',
    'è «{0}»; deve essere relativo alla cartella della scansione e trovarsi al suo interno',
  ],
  'fault.rotationRowsUnit': [
    'is not a rotation: its rows must be of unit length, at right angles, and right-handed',
    'ist keine Drehung: ihre Zeilen müssen die Länge 1 haben, senkrecht zueinander und rechtshändig sein',
    'non è una rotazione: le righe devono avere lunghezza 1, essere perpendicolari e destrorse',
  ],
  'fault.twoSetupTables': [
    'is {0} in two [[setup]] tables; remove one',
    'ist {0} in zwei Tabellen [[setup]]; eine entfernen',
    'è {0} in due tabelle [[setup]]; toglierne una',
  ],
  'fault.scanCompleteRun': [
    '{0}: the scan is not complete: run `frangia {1}` again with the same options',
    '{0}: der Scan ist nicht vollständig; mit denselben Einstellungen weiter scannen',
    '{0}: la scansione non è completa; riprenderla con le stesse impostazioni',
  ],
  'fault.aboveZero': ['must be above zero', 'muss größer als null sein', 'deve essere maggiore di zero'],
  'fault.floatCameraWhite': [
    'is "float", for which camera.white_level in rig.toml must be {0}, not {1}',
    'ist "float", wofür camera.white_level in rig.toml {0} sein muss, nicht {1}',
    'è "float", per cui camera.white_level in rig.toml deve essere {0}, non {1}',
  ],
  'fault.nameTwiceRename': [
    'has the name "{0}" twice; rename one',
    'hat den Namen „{0}“ zweimal; einen ändern',
    'ha due volte il nome «{0}»; cambiarne uno',
  ],
  'fault.folderTwiceGive': [
    'has the folder "{0}" twice; give each view its own',
    'hat den Ordner „{0}“ zweimal; jeder Ansicht einen eigenen geben',
    'ha due volte la cartella «{0}»; dare a ogni vista la sua',
  ],
  'fault.nameScanFolder': [
    '{0}: {1}; name a scan, a folder that holds scan.toml',
    '{0}: {1}; einen Scan angeben, einen Ordner mit scan.toml',
    '{0}: {1}; indicare una scansione, una cartella che contiene scan.toml',
  ],
  'fault.isNotA': ['is not a folder', 'ist kein Ordner', 'non è una cartella'],
  'fault.doesExist': ['does not exist', 'gibt es nicht', 'non esiste'],
  'fault.missingTriangulationNeeds': [
    '{0}: is missing; triangulation needs a calibrated rig, only `frangia decode` does not',
    '{0}: fehlt; Triangulation braucht einen kalibrierten Aufbau',
    '{0}: manca; la triangolazione richiede un apparato calibrato',
  ],
  'fault.missingScanNeeds': [
    'is missing; a scan needs at least one',
    'fehlt; ein Scan braucht mindestens eines',
    'manca; una scansione ne richiede almeno uno',
  ],
  'fault.damagedPngImage': [
    'is a damaged PNG image ({0}); copy it again',
    'ist ein beschädigtes PNG-Bild ({0}); neu kopieren',
    "è un'immagine PNG danneggiata ({0}); copiarla di nuovo",
  ],
  'fault.truncatedDamagedCopy': [
    'is truncated or damaged ({0}); copy it again',
    'ist abgeschnitten oder beschädigt ({0}); neu kopieren',
    'è troncato o danneggiato ({0}); copiarlo di nuovo',
  ],
  'fault.damagedTiffCopy': [
    'is a damaged TIFF; copy it again',
    'ist ein beschädigtes TIFF; neu kopieren',
    'è un TIFF danneggiato; copiarlo di nuovo',
  ],
  'fault.tiffWithoutImage': [
    'is a TIFF without an image; write it again',
    'ist ein TIFF ohne Bild; neu schreiben',
    'è un TIFF senza immagine; scriverlo di nuovo',
  ],
  'fault.damagedPageCopy': [
    'has a damaged page {0}; copy it again',
    'hat eine beschädigte Seite {0}; neu kopieren',
    'ha la pagina {0} danneggiata; copiarlo di nuovo',
  ],
  'fault.pagesDifferentSizes': [
    'has pages of different sizes or types: page {0} differs from page 0; save each as a file',
    'hat Seiten verschiedener Größe oder Art: Seite {0} weicht von Seite 0 ab; jede als Datei speichern',
    'ha pagine di grandezza o tipo diversi: la pagina {0} differisce dalla pagina 0; salvarle come file separati',
  ],
  'fault.tiffCompressionSave': [
    'is a TIFF with compression {0}; save it without compression, or with LZW or deflate',
    'ist ein TIFF mit der Kompression {0}; ohne Kompression oder mit LZW oder deflate speichern',
    'è un TIFF con compressione {0}; salvarlo senza compressione o con LZW o deflate',
  ],
  'fault.tiffBitSamples': [
    'is a TIFF of {0}-bit samples of type {1}; save it with 8 or 16 bits or as 32-bit floating point',
    'ist ein TIFF mit {0}-Bit-Werten der Art {1}; mit 8 oder 16 Bit oder als 32-Bit-Gleitkomma speichern',
    'è un TIFF di campioni a {0} bit di tipo {1}; salvarlo a 8 o 16 bit o in virgola mobile a 32 bit',
  ],
  'fault.tiledTiffSave': [
    'is a tiled TIFF; save it in strips',
    'ist ein TIFF in Kacheln; in Streifen speichern',
    'è un TIFF a riquadri; salvarlo a strisce',
  ],
  'fault.tiffSeparatePlanes': [
    'is a TIFF with separate planes of colour; save it with interleaved samples',
    'ist ein TIFF mit getrennten Farbebenen; die Werte verschränkt speichern',
    'è un TIFF con piani di colore separati; salvarlo con campioni interlacciati',
  ],
  'fault.tiffSamplesPer': [
    'is a TIFF of {0} samples per pixel and photometric interpretation {1}; save it as grey or as red, green and blue',
    'ist ein TIFF mit {0} Werten je Pixel und Farbdeutung {1}; grau oder als Rot, Grün und Blau speichern',
    'è un TIFF con {0} campioni per pixel e interpretazione {1}; salvarlo in grigio o in rosso, verde e blu',
  ],
  'fault.truncatedDamagedRow': [
    'is truncated or damaged at row {0}; copy it again',
    'ist in Zeile {0} abgeschnitten oder beschädigt; neu kopieren',
    'è troncato o danneggiato alla riga {0}; copiarlo di nuovo',
  ],
  'fault.cannotDecodedCopy': [
    'cannot be decoded; copy or capture the frame again',
    'lässt sich nicht dekodieren; das Bild neu kopieren oder aufnehmen',
    'non si può decodificare; copiare o riprendere di nuovo il fotogramma',
  ],
  'fault.pngImageFrames': [
    'is not a PNG image ({0}); frames are grey PNGs',
    'ist kein PNG-Bild ({0}); Bilder sind graue PNG',
    "non è un'immagine PNG ({0}); i fotogrammi sono PNG grigi",
  ],
  'fault.colourPngFrames': [
    "is a colour PNG; frames are grey: convert it from the camera's raw data",
    'ist ein farbiges PNG; Bilder sind grau: aus den Rohdaten der Kamera umwandeln',
    'è un PNG a colori; i fotogrammi sono grigi: convertirlo dai dati grezzi della camera',
  ],
  'fault.xPixelsMore': [
    'has {0} x {1} pixels, more than the {2} million of the largest frame',
    'hat {0} × {1} Pixel, mehr als die {2} Millionen des größten Bildes',
    'ha {0} × {1} pixel, più dei {2} milioni del fotogramma più grande',
  ],
  'fault.truncatedDamagedBytes': [
    'is truncated or damaged: its {0} bytes cannot hold {1} x {2} pixels; copy or capture it again',
    'ist abgeschnitten oder beschädigt: seine {0} Bytes fassen keine {1} × {2} Pixel; neu kopieren oder aufnehmen',
    'è troncato o danneggiato: i suoi {0} byte non possono contenere {1} × {2} pixel; copiarlo o riprenderlo di nuovo',
  ],
  'fault.brokenHeader': ['has a broken header', 'hat einen beschädigten Kopf', "ha un'intestazione danneggiata"],
  'fault.truncatedDamagedCopyCapture': [
    'is truncated or damaged ({0}); copy or capture it again',
    'ist abgeschnitten oder beschädigt ({0}); neu kopieren oder aufnehmen',
    'è troncato o danneggiato ({0}); copiarlo o riprenderlo di nuovo',
  ],
  'fault.imageCannotEncoded': [
    'an image cannot be encoded as PNG: {0}',
    'ein Bild lässt sich nicht als PNG schreiben: {0}',
    "un'immagine non si può codificare come PNG: {0}",
  ],
  'fault.emptyFileBytes': [
    'is an empty file of 0 bytes; copy or capture the frame again',
    'ist eine leere Datei mit 0 Bytes; das Bild neu kopieren oder aufnehmen',
    'è un file vuoto di 0 byte; copiare o riprendere di nuovo il fotogramma',
  ],
  'fault.floatingPointSamples': [
    'floating-point samples do not fit into a PNG',
    'Gleitkommawerte passen nicht in ein PNG',
    'valori in virgola mobile non stanno in un PNG',
  ],
} as const satisfies Rows;
