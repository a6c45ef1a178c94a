import type { Rows } from './rows';

/** Failures and warnings of projects and jobs. `tools/check_faults.py` explains them. */
export const FAULTS_SERVICE = {
  'fault.passwordBytesChoose': [
    'a password has {0} to {1} bytes; choose another one',
    'ein Passwort hat {0} bis {1} Bytes; ein anderes wählen',
    "una password ha da {0} a {1} byte; sceglierne un'altra",
  ],
  'fault.passwordCannotHashed': [
    'the password cannot be hashed: memory is short',
    'das Passwort lässt sich nicht verschlüsseln: der Speicher reicht nicht',
    'la password non si può cifrare: manca memoria',
  ],
  'fault.tooManyWrong': [
    'too many wrong passwords from {0}; try again in {1} s',
    'zu viele falsche Passwörter von {0}; in {1} s wieder versuchen',
    'troppe password sbagliate da {0}; riprovare fra {1} s',
  ],
  'fault.cameraFocalPx': [
    'camera_focal_px must be above 0',
    'camera_focal_px muss größer als 0 sein',
    'camera_focal_px deve essere maggiore di 0',
  ],
  'fault.projectorFocalPx': [
    'projector_focal_px is of a digital projector; this rig has an interferometer',
    'projector_focal_px gehört zu einem Digitalprojektor; dieser Aufbau hat ein Interferometer',
    'projector_focal_px è di un proiettore digitale; questo apparato ha un interferometro',
  ],
  'fault.projectorFocalPxAbove': [
    'projector_focal_px must be above 0',
    'projector_focal_px muss größer als 0 sein',
    'projector_focal_px deve essere maggiore di 0',
  ],
  'fault.distanceMmAbove': [
    'distance_mm must be above 0',
    'distance_mm muss größer als 0 sein',
    'distance_mm deve essere maggiore di 0',
  ],
  'fault.distanceMmTurntable': [
    'distance_mm is to the turntable; this rig has none',
    'distance_mm reicht bis zum Drehtisch; dieser Aufbau hat keinen',
    'distance_mm è fino alla tavola rotante; questo apparato non ne ha',
  ],
  'fault.baselineMmAbove': [
    'baseline_mm must be above 0',
    'baseline_mm muss größer als 0 sein',
    'baseline_mm deve essere maggiore di 0',
  ],
  'fault.baselineMmProjector': [
    'baseline_mm: the projector stands at the camera, so that its direction is open',
    'der Projektor steht an der Kamera, so dass seine Richtung offen ist',
    'il proiettore è presso la camera, così che la sua direzione è indeterminata',
  ],
  'fault.patternsCalibrationWhite': [
    'the patterns of a calibration have no white one',
    'unter den Mustern einer Kalibrierung ist kein weißes',
    "fra i pattern di una calibrazione non ce n'è uno bianco",
  ],
  'fault.poseBoardWaited': [
    'no pose of the board is waited for',
    'es wird auf keine Lage des Bretts gewartet',
    'non si attende alcuna posa della scacchiera',
  ],
  'fault.exposureMsAbove': [
    '`exposure_ms` must be above 0',
    'die Belichtung muss größer als 0 sein',
    "l'esposizione deve essere maggiore di 0",
  ],
  'fault.exposuresMsNumbers': [
    '`exposures_ms` must be {0} numbers at most',
    'es sind höchstens {0} Belichtungen möglich',
    'le esposizioni possono essere al massimo {0}',
  ],
  'fault.exposuresMsNumbersAbove': [
    '`exposures_ms` must be numbers above 0',
    'die Belichtungen müssen größer als 0 sein',
    'le esposizioni devono essere maggiori di 0',
  ],
  'fault.gainDbMore': [
    'gain_db must be 0 or more',
    'gain_db muss 0 oder größer sein',
    'gain_db deve essere 0 o maggiore',
  ],
  'fault.blackLevelCounts': [
    'black_level_counts must be 0 or more',
    'black_level_counts muss 0 oder größer sein',
    'black_level_counts deve essere 0 o maggiore',
  ],
  'fault.shifts': [
    '`shifts` must be from {0} to {1}',
    'die Zahl der Verschiebungen muss zwischen {0} und {1} liegen',
    'gli sfasamenti devono essere da {0} a {1}',
  ],
  'fault.algorithmAutoName': [
    '`algorithm` must be auto or a name that `frangia algorithms` lists',
    'den Algorithmus gibt es nicht; einen der Liste oder auto wählen',
    "l'algoritmo non esiste; sceglierne uno dell'elenco o auto",
  ],
  'fault.damagedDeleteBegin': [
    '{0}: is damaged; delete it to begin with the defaults',
    '{0}: ist beschädigt; löschen, um mit den Vorgaben zu beginnen',
    '{0}: è danneggiato; cancellarlo per ripartire dai valori predefiniti',
  ],
  'fault.deviceAnotherKind': [
    'is a device of another kind; choose another driver',
    'ist ein Gerät anderer Art; einen anderen Treiber wählen',
    'è un dispositivo di altro tipo; scegliere un altro driver',
  ],
  'fault.fringesPhaseShifter': [
    '{0}: the fringes of a phase shifter need their geometry: create the project from a rig.toml with [projector] model = "angular", such as the example lab-piezo',
    '{0}: die Streifen eines Phasenschiebers brauchen ihre Geometrie: das Projekt aus einer rig.toml mit [projector] model = "angular" anlegen, wie das Beispiel lab-piezo',
    '{0}: le frange di uno sfasatore richiedono la loro geometria: creare il progetto da un rig.toml con [projector] model = "angular", come l\'esempio lab-piezo',
  ],
  'fault.chooseWhatShows': [
    'choose what shows the fringes: a projector or a phase shifter',
    'wählen, was die Streifen zeigt: ein Projektor oder ein Phasenschieber',
    'scegliere che cosa mostra le frange: un proiettore o uno sfasatore',
  ],
  'fault.namesFolderComputer': [
    'names a folder of this computer, which the app does not open for a browser',
    'nennt einen Ordner dieses Rechners, den die App nicht für einen Browser öffnet',
    "nomina una cartella di questo computer, che l'app non apre per un browser",
  ],
  'fault.builtPartApp': [
    'must be a built-in part; the app opens no file for a browser',
    'muss ein eingebautes Teil sein; die App öffnet keine Datei für einen Browser',
    "deve essere un pezzo incorporato; l'app non apre file per un browser",
  ],
  'fault.namesFileComputer': [
    'names a file of this computer, which the app does not open for a browser',
    'nennt eine Datei dieses Rechners, die die App nicht für einen Browser öffnet',
    "nomina un file di questo computer, che l'app non apre per un browser",
  ],
  'fault.serialPortVideo': [
    'must be a serial port or a video device, such as /dev/ttyUSB0 or /dev/video0',
    'muss ein serieller Anschluss oder ein Videogerät sein, etwa /dev/ttyUSB0 oder /dev/video0',
    'deve essere una porta seriale o un dispositivo video, come /dev/ttyUSB0 o /dev/video0',
  ],
  'fault.calibrationCovarianceName': [
    '{0}: calibration.covariance must name a CSV file beside rig.toml',
    '{0}: calibration.covariance muss eine CSV-Datei neben rig.toml nennen',
    '{0}: calibration.covariance deve nominare un file CSV accanto a rig.toml',
  ],
  'fault.rigTomlBelongs': [
    'this rig.toml belongs to {0}, which holds the uncertainty of its calibration; choose both files together',
    'diese rig.toml gehört zu {0}, worin die Unsicherheit ihrer Kalibrierung steht; beide Dateien zusammen wählen',
    "questo rig.toml va con {0}, che contiene l'incertezza della sua calibrazione; scegliere i due file insieme",
  ],
  'fault.tooManyTasks': [
    'too many tasks wait; let one finish, or stop one, first',
    'zu viele Aufgaben warten; erst eine beenden lassen oder anhalten',
    'troppe attività in attesa; lasciarne finire una o fermarla prima',
  ],
  'fault.taskFailedReason': [
    'the task failed for a reason that has no words',
    'die Aufgabe ist aus einem unbekannten Grund gescheitert',
    "l'attività è fallita per una ragione sconosciuta",
  ],
  'fault.previewEndedBecause': [
    'the preview ended because nobody watched it',
    'die Vorschau endete, weil niemand zusah',
    "l'anteprima è finita perché nessuno la guardava",
  ],
  'fault.cannotCopied': [
    '{0}: cannot be copied: {1}',
    '{0}: kann nicht kopiert werden: {1}',
    '{0}: non si può copiare: {1}',
  ],
  'fault.projectScanFolder': [
    '{0}: is not a project or a scan folder; it holds neither {1} nor scan.toml',
    '{0}: ist weder Projekt noch Scanordner; es enthält weder {1} noch scan.toml',
    '{0}: non è un progetto né una cartella di scansione; non contiene {1} né scan.toml',
  ],
  'fault.projectNameChoose': [
    'there is no project of this name; choose one of the list',
    'ein Projekt dieses Namens gibt es nicht; eines der Liste wählen',
    "non c'è un progetto con questo nome; sceglierne uno dell'elenco",
  ],
  'fault.projectSName': [
    "a project's name has 1 to {0} letters, no slash, and begins with a letter or a digit; write another one",
    'ein Projektname hat 1 bis {0} Zeichen, keinen Schrägstrich und beginnt mit einem Buchstaben oder einer Ziffer; einen anderen schreiben',
    'il nome di un progetto ha da 1 a {0} lettere, nessuna barra, e comincia con una lettera o una cifra; scriverne un altro',
  ],
  'fault.deletedProjectName': [
    'there is no deleted project of this name',
    'ein gelöschtes Projekt dieses Namens gibt es nicht',
    "non c'è un progetto eliminato con questo nome",
  ],
  'fault.damagedIgnored': [
    '{0}: is damaged and ignored ({1})',
    '{0}: ist beschädigt und wird nicht beachtet ({1})',
    '{0}: è danneggiato e viene ignorato ({1})',
  ],
  'fault.earlierRigNumber': [
    'there is no earlier rig of this number',
    'einen früheren Aufbau dieser Nummer gibt es nicht',
    "non c'è un apparato precedente con questo numero",
  ],
  'fault.keptRigName': [
    'there is no kept rig of this name; choose one of the list',
    'einen gespeicherten Aufbau dieses Namens gibt es nicht; einen der Liste wählen',
    "non c'è un apparato salvato con questo nome; sceglierne uno dell'elenco",
  ],
  'fault.keptRigAlready': [
    'there is a kept rig {0} already; write another name',
    'einen gespeicherten Aufbau {0} gibt es schon; einen anderen Namen schreiben',
    "c'è già un apparato salvato {0}; scrivere un altro nome",
  ],
  'fault.suchCommand': ['there is no such command', 'diesen Befehl gibt es nicht', 'questo comando non esiste'],
  'fault.projectOpenOpen': [
    'no project is open; open one, or create one, first',
    'kein Projekt ist offen; erst eines öffnen oder anlegen',
    'nessun progetto è aperto; aprirne o crearne uno prima',
  ],
  'fault.rigCalibratedProject': [
    'this rig was not calibrated in this project',
    'dieser Aufbau wurde nicht in diesem Projekt kalibriert',
    'questo apparato non è stato calibrato in questo progetto',
  ],
  'fault.exportedFileName': [
    'there is no exported file of this name; export it first',
    'eine exportierte Datei dieses Namens gibt es nicht; erst exportieren',
    "non c'è un file esportato con questo nome; esportarlo prima",
  ],
  'fault.taskFinishedAlready': [
    'this task has finished already',
    'diese Aufgabe ist schon beendet',
    'questa attività è già finita',
  ],
  'fault.surfacePointReconstruct': [
    'there is no surface to point at; reconstruct it first',
    'es gibt keine Oberfläche zum Anklicken; sie erst berechnen',
    "non c'è una superficie da indicare; ricostruirla prima",
  ],
  'fault.referenceShownYet': [
    'the reference is not shown yet; show it first',
    'die Referenz wird noch nicht gezeigt; sie erst zeigen',
    'il riferimento non è ancora mostrato; mostrarlo prima',
  ],
  'fault.operatingSystemGives': [
    'the operating system gives no random numbers for a key',
    'das Betriebssystem liefert keine Zufallszahlen für einen Schlüssel',
    'il sistema operativo non fornisce numeri casuali per una chiave',
  ],
  'fault.readableYouAlone': [
    '{0}: is not readable by you alone, and its sessions are not accepted; delete it',
    '{0}: ist nicht nur für den eigenen Benutzer lesbar, seine Sitzungen gelten nicht; löschen',
    '{0}: non è leggibile solo dal proprio utente, e le sue sessioni non sono accettate; cancellarlo',
  ],
  'fault.browsersWillNeed': [
    'browsers will need new links when the server starts again: {0}',
    'nach einem Neustart des Servers brauchen Browser neue Links: {0}',
    'al riavvio del server i browser avranno bisogno di nuovi link: {0}',
  ],
  'fault.partChooseOne': [
    "there is no part '{0}'; choose one of {1}",
    'das Teil „{0}“ gibt es nicht; wählen aus {1}',
    'il pezzo «{0}» non esiste; scegliere fra {1}',
  ],
  'fault.exampleChooseOne': [
    "there is no example '{0}'; choose one of {1}",
    'das Beispiel „{0}“ gibt es nicht; wählen aus {1}',
    "l'esempio «{0}» non esiste; scegliere fra {1}",
  ],
} as const satisfies Rows;
