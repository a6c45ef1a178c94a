import type { Rows } from './rows';

/** Failures and warnings of drivers. `tools/check_faults.py` explains them. */
export const FAULTS_DRIVERS = {
  'fault.commandValue': [
    "the command '{0}' has no {value} in it",
    'dem Befehl „{0}“ fehlt die Stelle für den Wert',
    'nel comando «{0}» manca il posto per il valore',
  ],
  'fault.commandCannotFilled': [
    "the command '{0}' cannot be filled: {1}",
    'der Befehl „{0}“ lässt sich nicht ausfüllen: {1}',
    'il comando «{0}» non si può completare: {1}',
  ],
  'fault.belowMaxDeg': ['must be below max_deg', 'muss kleiner als max_deg sein', 'deve essere minore di max_deg'],
  'fault.serialPortOpening': [
    'serial port {0}; opening it shows what is connected',
    'serieller Anschluss {0}; beim Öffnen zeigt sich, was angeschlossen ist',
    'porta seriale {0}; aprendola si vede che cosa è collegato',
  ],
  'fault.turntableBoard': [
    'turntable on a board with {0}',
    'Drehtisch an einer Platine mit {0}',
    'tavola rotante su una scheda con {0}',
  ],
  'fault.lampLaserOutput': [
    'lamp or laser on an output of a board with {0}',
    'Lampe oder Laser an einem Ausgang einer Platine mit {0}',
    "lampada o laser su un'uscita di una scheda con {0}",
  ],
  'fault.butContainsFrame': [
    'is "{0}", but it contains no frame such as views/000/fringe-0.png; name a scan folder',
    'ist „{0}“, enthält aber kein Bild wie views/000/fringe-0.png; einen Scanordner angeben',
    'è «{0}», ma non contiene fotogrammi come views/000/fringe-0.png; indicare una cartella di scansione',
  ],
  'fault.viewsXPixels': [
    '{0} views of {1} x {2} pixels',
    '{0} Ansichten mit {1} × {2} Pixeln',
    '{0} viste di {1} × {2} pixel',
  ],
  'fault.viewsSetViews': [
    'has {0} views; set `views` to no more than that',
    'hat {0} Ansichten; höchstens so viele aufnehmen',
    'ha {0} viste; riprenderne al massimo altrettante',
  ],
  'fault.missingAddUse': [
    '{0} is missing; add it, or use the patterns that exist',
    '{0} fehlt; ergänzen oder die vorhandenen Muster benutzen',
    '{0} manca; aggiungerlo o usare i pattern presenti',
  ],
  'fault.replaysFramesScan': [
    'replays the frames of a scan folder',
    'gibt die Bilder eines Scanordners wieder',
    'riproduce i fotogrammi di una cartella di scansione',
  ],
  'fault.limitSwitchHit': ['a limit switch was hit', 'ein Endschalter wurde getroffen', 'è stato toccato un finecorsa'],
  'fault.targetBeyondTravel': [
    'the target is beyond the travel of the axis, set in $130 to $133',
    'das Ziel liegt außerhalb des Wegs der Achse, eingestellt in $130 bis $133',
    "la meta è oltre la corsa dell'asse, impostata in $130–$133",
  ],
  'fault.resetWhileMoved': [
    'it was reset while it moved',
    'es wurde während der Bewegung zurückgesetzt',
    'è stata resettata durante il movimento',
  ],
  'fault.seeListAlarms': [
    'see the list of alarms of GRBL',
    'siehe die Liste der Alarme von GRBL',
    "vedere l'elenco degli allarmi di GRBL",
  ],
  'fault.homingEnabledSet': [
    'homing is not enabled; set $22=1, or home = "here"',
    'die Referenzfahrt ist nicht eingeschaltet; $22=1 setzen oder home = "here"',
    'la ricerca del riferimento non è attiva; impostare $22=1 o home = "here"',
  ],
  'fault.onlyPossibleStandstill': [
    'that is only possible at standstill',
    'das geht nur im Stillstand',
    'è possibile solo da fermo',
  ],
  'fault.lockedAfterAlarm': [
    'it is locked after an alarm; home the table again',
    'nach einem Alarm gesperrt; neu referenzieren',
    'bloccata dopo un allarme; cercare di nuovo il riferimento',
  ],
  'fault.targetBeyondTravel2': [
    'the target is beyond its travel',
    'das Ziel liegt außerhalb des Wegs',
    'la meta è oltre la corsa',
  ],
  'fault.commandUnknown': ['the command is unknown', 'der Befehl ist unbekannt', 'il comando è sconosciuto'],
  'fault.seeListErrors': [
    'see the list of errors of GRBL',
    'siehe die Liste der Fehler von GRBL',
    "vedere l'elenco degli errori di GRBL",
  ],
  'fault.scanSetsSteps': [
    'its ${0} is {1}; a scan sets it to the {2} steps of the rig',
    '${0} ist {1}; ein Scan setzt es auf die {2} Schritte des Aufbaus',
    "${0} è {1}; una scansione lo imposta ai {2} passi dell'apparato",
  ],
  'fault.angleLostHome': [
    '{0}; its angle is lost, home the table again',
    '{0}; der Winkel ist verloren, neu referenzieren',
    "{0}; l'angolo è perso, cercare di nuovo il riferimento",
  ],
  'fault.boardRestartedAngle': [
    'the board restarted; its angle is lost, home the table again',
    'die Platine startete neu; der Winkel ist verloren, neu referenzieren',
    "la scheda si è riavviata; l'angolo è perso, cercare di nuovo il riferimento",
  ],
  'fault.answeredCheckRuns': [
    "answered '{0}' to {1}; check that it runs GRBL at this baud rate",
    'antwortete „{0}“ auf {1}; prüfen, ob GRBL mit dieser Baudrate läuft',
    'ha risposto «{0}» a {1}; controllare che usi GRBL a questa velocità',
  ],
  'fault.doesReportSteps': [
    'does not report its ${0}, the steps of axis {1}; choose an axis that the board has, or leave out steps_per_degree',
    'meldet ${0}, die Schritte der Achse {1}, nicht; eine vorhandene Achse wählen oder steps_per_degree weglassen',
    "non comunica ${0}, i passi dell'asse {1}; scegliere un asse presente o togliere steps_per_degree",
  ],
  'fault.nowStepsRig': [
    'its ${0} was {1} and is now {2}, the steps of the rig; the board keeps it',
    '${0} war {1} und ist jetzt {2}, die Schritte des Aufbaus; die Platine behält es',
    "${0} era {1} e ora è {2}, i passi dell'apparato; la scheda lo conserva",
  ],
  'fault.doesIdentifyHorus': [
    'does not identify as Horus 0.2; check port and firmware',
    'meldet sich nicht als Horus 0.2; Anschluss und Firmware prüfen',
    'non si identifica come Horus 0.2; controllare porta e firmware',
  ],
  'fault.horusBoardsHome': [
    '{0}: Horus boards have no home switch; set home = "here"',
    '{0}: Horus-Platinen haben keinen Referenzschalter; home = "here" setzen',
    '{0}: le schede Horus non hanno interruttore di riferimento; impostare home = "here"',
  ],
  'fault.moveTakesMore': [
    'the move takes more than {0} s',
    'die Bewegung dauert länger als {0} s',
    'il movimento dura più di {0} s',
  ],
  'fault.belowMaxCommand': [
    'must be below max_command',
    'muss kleiner als max_command sein',
    'deve essere minore di max_command',
  ],
  'fault.lampLaserOutputScpi': [
    'lamp or laser on an output with SCPI',
    'Lampe oder Laser an einem Ausgang mit SCPI',
    "lampada o laser su un'uscita con SCPI",
  ],
  'fault.lampLaserAny': [
    'lamp or laser on any instrument, by the commands in its manual',
    'Lampe oder Laser an einem beliebigen Gerät, mit den Befehlen seiner Anleitung',
    'lampada o laser su uno strumento qualsiasi, con i comandi del suo manuale',
  ],
  'fault.missingListsCommands': [
    'is missing; it lists the commands that switch on',
    'fehlt; es nennt die Befehle zum Einschalten',
    'manca; elenca i comandi di accensione',
  ],
  'fault.missingListsCommandsSwitch': [
    'is missing; it lists the commands that switch off',
    'fehlt; es nennt die Befehle zum Ausschalten',
    'manca; elenca i comandi di spegnimento',
  ],
  'fault.piezoFunctionGenerator': [
    'piezo on a function generator or power supply with SCPI',
    'Piezo an Funktionsgenerator oder Netzteil mit SCPI',
    'piezo su generatore di funzioni o alimentatore con SCPI',
  ],
  'fault.piezoStagePhysik': [
    'piezo stage of Physik Instrumente (GCS 2)',
    'Piezotisch von Physik Instrumente (GCS 2)',
    'stadio piezo di Physik Instrumente (GCS 2)',
  ],
  'fault.piezoAnyInstrument': [
    'piezo on any instrument, by the commands in its manual',
    'Piezo an einem beliebigen Gerät, mit den Befehlen seiner Anleitung',
    'piezo su uno strumento qualsiasi, con i comandi del suo manuale',
  ],
  'fault.settledWithinS': [
    'has not settled within {0} s',
    'hat sich in {0} s nicht eingestellt',
    'non si è assestato entro {0} s',
  ],
  'fault.phaseShifter': ['phase shifter at {0}', 'Phasenschieber an {0}', 'sfasatore su {0}'],
  'fault.requestedAgainTimes': [
    "requested '{0}' again {1} times; check the cable and the baud rate",
    'verlangte „{0}“ noch {1}-mal; Kabel und Baudrate prüfen',
    'ha richiesto di nuovo «{0}» {1} volte; controllare cavo e velocità',
  ],
  'fault.haltedSwitchOff': [
    "halted ('{0}'); switch it off and on, then home the table again",
    'hielt an („{0}“); aus- und einschalten, dann neu referenzieren',
    'si è fermato («{0}»); spegnerlo e riaccenderlo, poi cercare di nuovo il riferimento',
  ],
  'fault.openCannotIdentify': [
    'open; it cannot identify itself',
    'offen; es kann sich nicht ausweisen',
    'aperto; non può identificarsi',
  ],
  'fault.emptyLine': ['an empty line', 'eine leere Zeile', 'una riga vuota'],
  'fault.reportsAfterCheck': [
    "reports {0} after '{1}'; check the command",
    'meldet {0} nach „{1}“; den Befehl prüfen',
    'segnala {0} dopo «{1}»; controllare il comando',
  ],
  'fault.acceptsDataS': [
    'accepts no data for {0} s; check the cable',
    'nimmt seit {0} s keine Daten an; das Kabel prüfen',
    'non accetta dati da {0} s; controllare il cavo',
  ],
  'fault.sendsLineWithout': [
    "sends a line without end ('{0}'); check the baud rate",
    'sendet eine Zeile ohne Ende („{0}“); die Baudrate prüfen',
    'invia una riga senza fine («{0}»); controllare la velocità',
  ],
  'fault.connectionBrokeCheck': [
    'the connection broke ({0}); check that it is plugged in',
    'die Verbindung brach ab ({0}); prüfen, ob es angesteckt ist',
    'la connessione si è interrotta ({0}); controllare che sia collegato',
  ],
  'fault.runFrangiaDevices': ["run 'frangia devices' to list the ports", 'die Anschlüsse suchen', 'cercare le porte'],
  'fault.doesSupportBaud': [
    'does not support {0} baud ({1})',
    'unterstützt {0} Baud nicht ({1})',
    'non supporta {0} baud ({1})',
  ],
  'fault.connectionWithinS': [
    'no connection within {0} s; check that the device is on and on this network',
    'keine Verbindung innerhalb von {0} s; prüfen, ob das Gerät an und in diesem Netz ist',
    'nessuna connessione entro {0} s; controllare che il dispositivo sia acceso e su questa rete',
  ],
  'fault.connectionCheckHost': [
    'no connection ({0}); check host and port',
    'keine Verbindung ({0}); Adresse und Port prüfen',
    'nessuna connessione ({0}); controllare indirizzo e porta',
  ],
  'fault.gpibAddressLie': [
    'gpib_address is {0}; it must lie between 0 and 30',
    'gpib_address ist {0}; der Wert muss zwischen 0 und 30 liegen',
    'gpib_address è {0}; deve stare fra 0 e 30',
  ],
  'fault.prologixAdapterAnswered': [
    "is not a Prologix adapter: it answered '{0}'",
    'ist kein Prologix-Adapter: die Antwort war „{0}“',
    'non è un adattatore Prologix: ha risposto «{0}»',
  ],
  'fault.numberStringTrue': [
    'must be a number, a string, true or false, or a list of those',
    'muss eine Zahl, ein Text, true oder false oder eine Liste davon sein',
    'deve essere un numero, un testo, true o false, o un elenco di questi',
  ],
  'fault.keyPlainWord': [
    'has a key that is not a plain word',
    'hat einen Schlüssel, der kein einfaches Wort ist',
    'ha una chiave che non è una parola semplice',
  ],
  'fault.holdTablesSuch': [
    'must hold tables, such as [devices.camera]',
    'muss Tabellen enthalten, etwa [devices.camera]',
    'deve contenere tabelle, come [devices.camera]',
  ],
  'fault.tableDevices': [
    'must be a table, [devices.{0}]',
    'muss eine Tabelle sein, [devices.{0}]',
    'deve essere una tabella, [devices.{0}]',
  ],
  'fault.enabledEnableBefore': [
    'it is not enabled; enable it before homing',
    'nicht eingeschaltet; vor dem Referenzieren einschalten',
    'non attivata; attivarla prima di cercare il riferimento',
  ],
  'fault.enabledEnableBeforeSetting': [
    'it is not enabled; enable it before setting its angle',
    'nicht eingeschaltet; vor dem Setzen des Winkels einschalten',
    "non attivata; attivarla prima di impostarne l'angolo",
  ],
  'fault.degreesOutsideLimits': [
    '{0} degrees are outside its limits, {1} to {2}',
    '{0} Grad liegen außerhalb der Grenzen, {1} bis {2}',
    '{0} gradi sono fuori dai limiti, da {1} a {2}',
  ],
  'fault.enabledEnableFirst': [
    'it is not enabled; enable it first',
    'nicht eingeschaltet; erst einschalten',
    'non attivata; attivarla prima',
  ],
  'fault.angleUnknownHome': [
    'its angle is unknown; home it first',
    'der Winkel ist unbekannt; erst referenzieren',
    "l'angolo è ignoto; cercare prima il riferimento",
  ],
} as const satisfies Rows;
