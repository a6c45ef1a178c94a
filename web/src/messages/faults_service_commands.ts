import type { Rows } from './rows';

/** Failures and warnings of commands. `tools/check_faults.py` explains them. */
export const FAULTS_SERVICE_COMMANDS = {
  'fault.idBelongsAnother': [
    'id: belongs to another command; send each command with an id of its own',
    'id gehört zu einem anderen Befehl; jeden Befehl mit eigener id senden',
    'id appartiene a un altro comando; inviare ogni comando con un id proprio',
  ],
  'fault.lettersDigitsMissing': [
    '8 to 64 letters, digits, - and _ are missing here',
    'hier fehlen 8 bis 64 Buchstaben, Ziffern, - und _',
    'qui mancano da 8 a 64 lettere, cifre, - e _',
  ],
  'fault.commandLongerMb': [
    'the command is longer than 1 MB; send a shorter one',
    'der Befehl ist länger als 1 MB; einen kürzeren senden',
    'il comando supera 1 MB; inviarne uno più corto',
  ],
  'fault.argumentsCommandJson': [
    'the arguments of a command are a JSON object; send one, such as {}',
    'die Argumente eines Befehls sind ein JSON-Objekt; eines senden, etwa {}',
    'gli argomenti di un comando sono un oggetto JSON; inviarne uno, come {}',
  ],
  'fault.textMissingHere': ['a text is missing here', 'hier fehlt ein Text', 'qui manca un testo'],
  'fault.wholeNumberMissing': [
    'a whole number from {0} to {1} is missing here',
    'hier fehlt eine ganze Zahl von {0} bis {1}',
    'qui manca un numero intero da {0} a {1}',
  ],
  'fault.numberMostMissing': [
    'a number of at most {0} is missing here',
    'hier fehlt eine Zahl bis {0}',
    'qui manca un numero fino a {0}',
  ],
  'fault.numberAboveMissing': [
    'a number above 0 is missing here',
    'hier fehlt eine Zahl über 0',
    'qui manca un numero maggiore di 0',
  ],
  'fault.numberMoreMissing': [
    'a number of 0 or more is missing here',
    'hier fehlt eine Zahl ab 0',
    'qui manca un numero da 0 in su',
  ],
  'fault.listNumbersMissing': [
    'a list of {0} numbers is missing here',
    'hier fehlt eine Liste von {0} Zahlen',
    'qui manca un elenco di {0} numeri',
  ],
  'fault.listMostNumbers': [
    'a list of at most {0} numbers is missing here',
    'hier fehlt eine Liste von höchstens {0} Zahlen',
    'qui manca un elenco di al massimo {0} numeri',
  ],
  'fault.trueFalseMissing': ['true or false is missing here', 'hier fehlt true oder false', 'qui manca true o false'],
  'fault.objectMostTexts': [
    'an object of at most {0} texts is missing here',
    'hier fehlt ein Objekt mit höchstens {0} Texten',
    'qui manca un oggetto di al massimo {0} testi',
  ],
  'fault.itIsMissing': ['it is missing', 'es fehlt', 'manca'],
  'fault.objectMissingHere': ['an object is missing here', 'hier fehlt ein Objekt', 'qui manca un oggetto'],
  'fault.commandSuchArgument': [
    'the command has no such argument',
    'der Befehl hat kein solches Argument',
    'il comando non ha questo argomento',
  ],
  'fault.folderHoldsFinished': [
    'this folder holds a finished scan; create a project to scan with devices',
    'dieser Ordner enthält einen fertigen Scan; zum Scannen mit Geräten ein Projekt anlegen',
    'questa cartella contiene una scansione finita; creare un progetto per scansionare con dispositivi',
  ],
  'fault.scanBegunThese': [
    'the scan has begun with these devices; create a project for other ones',
    'der Scan hat mit diesen Geräten begonnen; für andere ein Projekt anlegen',
    'la scansione è iniziata con questi dispositivi; creare un progetto per altri',
  ],
  'fault.devicesTablesCamera': [
    'devices: the tables are camera, fringes, line, light and turntable',
    'die Tabellen der Geräte sind camera, fringes, line, light und turntable',
    'le tabelle dei dispositivi sono camera, fringes, line, light e turntable',
  ],
  'fault.projectRigDevices': [
    'this project has no rig with devices',
    'dieses Projekt hat keinen Aufbau mit Geräten',
    'questo progetto non ha un apparato con dispositivi',
  ],
  'fault.picturePngJpeg': [
    'picture: is a PNG or JPEG of at most 300 kB, in base64',
    'das Bild ist ein PNG oder JPEG von höchstens 300 kB, in base64',
    "l'immagine è un PNG o JPEG di al massimo 300 kB, in base64",
  ],
  'fault.fileArrivedCannot': [
    'the file that arrived cannot be renamed: {0}',
    'die angekommene Datei lässt sich nicht umbenennen: {0}',
    'il file arrivato non si può rinominare: {0}',
  ],
  'fault.fileHasPoint': [
    'this file has no point; choose one with a surface or points',
    'diese Datei hat keinen Punkt; eine mit einer Oberfläche oder Punkten wählen',
    'questo file non ha punti; sceglierne uno con una superficie o dei punti',
  ],
  'fault.textNotesMost': [
    'text: notes have at most 4000 bytes; shorten them',
    'Notizen haben höchstens 4000 Bytes; kürzen',
    'le note hanno al massimo 4000 byte; accorciarle',
  ],
  'fault.nameMostLetters': [
    'name: has at most 120 letters; shorten it',
    'ein Name hat höchstens 120 Zeichen; kürzen',
    'un nome ha al massimo 120 lettere; accorciarlo',
  ],
  'fault.formatAppOpens': [
    'format: the app opens meshes, STEP and IGES files, and zip archives of a scan folder',
    'die App öffnet Netze, STEP- und IGES-Dateien und Zip-Archive eines Scanordners',
    "l'app apre mesh, file STEP e IGES e archivi zip di una cartella di scansione",
  ],
  'fault.projectScanSurface': [
    'this project has a scan or a surface; open the file in a project of its own',
    'dieses Projekt hat einen Scan oder eine Oberfläche; die Datei in einem eigenen Projekt öffnen',
    'questo progetto ha una scansione o una superficie; aprire il file in un progetto proprio',
  ],
  'fault.fileArrivedCompletely': [
    'the file has not arrived completely; send it again',
    'die Datei ist nicht vollständig angekommen; noch einmal senden',
    'il file non è arrivato per intero; inviarlo di nuovo',
  ],
  'fault.scanBegunSettings': [
    'the scan has begun with its settings; create a project to scan with others',
    'der Scan hat mit seinen Einstellungen begonnen; für andere ein Projekt anlegen',
    'la scansione è iniziata con le sue impostazioni; creare un progetto per altre',
  ],
  'fault.previewRunsStart': [
    'no preview runs; start it first',
    'keine Vorschau läuft; sie erst starten',
    'nessuna anteprima è in corso; avviarla prima',
  ],
  'fault.cannotMoved': [
    '{0}: cannot be moved: {1}',
    '{0}: kann nicht verschoben werden: {1}',
    '{0}: non si può spostare: {1}',
  ],
  'fault.folderProjectGone': [
    '{0}: the folder of this project is gone; put it back, or close the project and open another one',
    '{0}: der Ordner dieses Projekts ist weg; ihn zurücklegen, oder das Projekt schließen und ein anderes öffnen',
    "{0}: la cartella di questo progetto non c'è più; rimetterla, o chiudere il progetto e aprirne un altro",
  ],
  'fault.surface': ['there is no surface', 'es gibt keine Oberfläche', "non c'è una superficie"],
  'fault.exampleRigKept': [
    'example, rig, kept_rig and devices exclude each other; give one of them',
    'example, rig, kept_rig und devices schließen einander aus; eines angeben',
    'example, rig, kept_rig e devices si escludono; indicarne uno',
  ],
  'fault.projectRig': [
    'this project has no rig',
    'dieses Projekt hat keinen Aufbau',
    'questo progetto non ha un apparato',
  ],
  'fault.onlyPartsSimulated': [
    'only the parts of a simulated rig that is not calibrated can be moved here',
    'nur die Teile eines simulierten, nicht kalibrierten Aufbaus lassen sich hier bewegen',
    'qui si possono muovere solo le parti di un apparato simulato e non calibrato',
  ],
  'fault.squareMmSide': [
    'square_mm: the side of a square is missing here, or ruler_mm of a printed board',
    'die Seite eines Felds fehlt, oder die gemessene Länge des Lineals eines gedruckten Bretts',
    'manca il lato di una casella, o la lunghezza misurata del righello di una scacchiera stampata',
  ],
  'fault.calibrateRigFirst': [
    'calibrate the rig first; the axis needs camera and projector',
    'erst den Aufbau kalibrieren; die Achse braucht Kamera und Projektor',
    "calibrare prima l'apparato; l'asse richiede camera e proiettore",
  ],
  'fault.rigTurntableChoose': [
    'this rig has no turntable; choose one among the devices',
    'dieser Aufbau hat keinen Drehtisch; bei den Geräten einen wählen',
    'questo apparato non ha tavola rotante; sceglierne una fra i dispositivi',
  ],
  'fault.calibrationRunsStart': [
    'no calibration runs; start it first',
    'keine Kalibrierung läuft; sie erst starten',
    'nessuna calibrazione è in corso; avviarla prima',
  ],
  'fault.programBuiltWithoutCalibration': [
    'this program was built without calibration',
    'dieses Programm wurde ohne Kalibrierung gebaut',
    'questo programma è senza calibrazione',
  ],
  'fault.scanOpenedCaptured': [
    'this scan was opened, not captured here; create a project to scan with devices',
    'dieser Scan wurde geöffnet, nicht hier aufgenommen; zum Scannen mit Geräten ein Projekt anlegen',
    'questa scansione è stata aperta, non ripresa qui; creare un progetto per scansionare con dispositivi',
  ],
  'fault.projectRigDevicesCreate': [
    'this project has no rig with devices; create one to scan',
    'dieses Projekt hat keinen Aufbau mit Geräten; zum Scannen eines anlegen',
    'questo progetto non ha un apparato con dispositivi; crearne uno per scansionare',
  ],
  'fault.setupPartLies': [
    'setup: the part lies in another one; add the next, or go on',
    'das Teil liegt in einer anderen Aufspannung; die nächste hinzufügen oder weitermachen',
    'il pezzo è in un altro piazzamento; aggiungere il successivo o proseguire',
  ],
  'fault.scanBegunNumber': [
    'the scan has begun; its number of stations cannot change',
    'der Scan hat begonnen; die Zahl der Stationen lässt sich nicht ändern',
    'la scansione è iniziata; il numero di stazioni non si può cambiare',
  ],
  'fault.framesCapturedAlready': [
    '{0} frames captured, {1} already there',
    '{0} Bilder aufgenommen, {1} schon vorhanden',
    '{0} fotogrammi ripresi, {1} già presenti',
  ],
  'fault.projectStationsScan': [
    'this project has no stations; scan it first',
    'dieses Projekt hat keine Stationen; erst scannen',
    'questo progetto non ha stazioni; scansionare prima',
  ],
  'fault.partTurnedOver': [
    'the part was turned over since this station was captured; capture it in a new setup',
    'seit der Aufnahme dieser Station wurde das Teil umgedreht; sie in einer neuen Aufspannung aufnehmen',
    'il pezzo è stato girato dopo la ripresa di questa stazione; riprenderla in un nuovo piazzamento',
  ],
  'fault.listOfTexts': ['names: is a list of texts', 'names: ist eine Liste von Texten', 'names: è un elenco di testi'],
} as const satisfies Rows;
