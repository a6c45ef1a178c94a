import type { Rows } from './rows';

/** Failures and warnings of devices and their settings. `tools/check_faults.py` explains them. */
export const FAULTS_DEVICES = {
  'fault.exposureMsOutside': [
    'an exposure of {0} ms is outside its range, {1} to {2}',
    'eine Belichtung von {0} ms liegt außerhalb ihres Bereichs, {1} bis {2}',
    "un'esposizione di {0} ms è fuori dal suo intervallo, da {1} a {2}",
  ],
  'fault.trueFalse': ['must be true or false', 'muss true oder false sein', 'deve essere true o false'],
  'fault.stringQuotes': [
    'must be a string in quotes',
    'muss ein Text in Anführungszeichen sein',
    'deve essere un testo tra virgolette',
  ],
  'fault.nameQuotesWhole': [
    'must be a name in quotes or a whole number from 0',
    'muss ein Name in Anführungszeichen oder eine ganze Zahl ab 0 sein',
    'deve essere un nome tra virgolette o un numero intero da 0',
  ],
  'fault.isItMust': ['is "{0}"; it must be one of {1}', 'ist „{0}“; möglich sind {1}', 'è «{0}»; sono possibili {1}'],
  'fault.finiteNumber': ['must be a finite number', 'muss eine endliche Zahl sein', 'deve essere un numero finito'],
  'fault.lieBetween': [
    'is {0}; it must lie between {1} and {2}',
    'ist {0}; der Wert muss zwischen {1} und {2} liegen',
    'è {0}; il valore deve stare fra {1} e {2}',
  ],
  'fault.wholeNumber': ['must be a whole number', 'muss eine ganze Zahl sein', 'deve essere un numero intero'],
  'fault.listNumbers': [
    'must be a list of numbers',
    'muss eine Liste von Zahlen sein',
    'deve essere un elenco di numeri',
  ],
  'fault.listStringsQuotes': [
    'must be a list of strings in quotes',
    'muss eine Liste von Texten in Anführungszeichen sein',
    'deve essere un elenco di testi tra virgolette',
  ],
  'fault.devicesUnknownIgnored': [
    '{0}: devices.{1}.{2} is unknown and ignored',
    '{0}: devices.{1}.{2} ist unbekannt und wird nicht beachtet',
    '{0}: devices.{1}.{2} è sconosciuta e viene ignorata',
  ],
  'fault.driversDevices': [
    'is "{0}"; the drivers for [devices.{1}] are {2}',
    'ist „{0}“; die Treiber für [devices.{1}] sind {2}',
    'è «{0}»; i driver per [devices.{1}] sono {2}',
  ],
  'fault.searchDevicesFailed': [
    'the search for {0} devices failed: {1}',
    'die Suche nach Geräten von {0} ist gescheitert: {1}',
    'la ricerca di dispositivi {0} è fallita: {1}',
  ],
  'fault.guardianProcessSwitches': [
    'the guardian process, which switches light off when the program dies, {0}',
    'der Wächterprozess, der das Licht löscht, wenn das Programm endet, {0}',
    'il processo guardiano, che spegne la luce se il programma si interrompe, {0}',
  ],
  'fault.cannotStarted': [
    'cannot be started from {0} ({1})',
    'kann nicht von {0} gestartet werden ({1})',
    'non si può avviare da {0} ({1})',
  ],
  'fault.commandsSwitchOff': [
    '{0}: the commands that switch it off are longer than {1} bytes, or it has no open line',
    '{0}: die Befehle zum Abschalten sind länger als {1} Bytes, oder es fehlt eine offene Leitung',
    '{0}: i comandi di spegnimento superano {1} byte, o manca una linea aperta',
  ],
  'fault.endedStartProgram': [
    'has ended; start the program again',
    'hat sich beendet; das Programm neu starten',
    'è terminato; riavviare il programma',
  ],
  'fault.socket': ['has no socket ({0})', 'hat keinen Socket ({0})', 'non ha un socket ({0})'],
  'fault.doesStartCheck': ['does not start; check {0}', 'startet nicht; {0} prüfen', 'non si avvia; controllare {0}'],
  'fault.phaseCurveNeeds': [
    '{0}: a phase curve needs two points or more, rising commands and as many phases that only rise or only fall; calibrate the phase shifter again',
    '{0}: eine Phasenkurve braucht zwei Punkte oder mehr, steigende Stellwerte und ebenso viele Phasen, die nur steigen oder nur fallen; den Phasenschieber neu kalibrieren',
    '{0}: una curva di fase richiede due o più punti, comandi crescenti e altrettante fasi che solo crescano o solo calino; calibrare di nuovo lo sfasatore',
  ],
  'fault.phaseCurveSpans': [
    'the phase curve spans {0} degrees and cannot reach a shift of {1}; widen the range of the phase shifter',
    'die Phasenkurve umfasst {0} Grad und erreicht keine Verschiebung von {1}; den Bereich des Phasenschiebers erweitern',
    "la curva di fase copre {0} gradi e non raggiunge uno sfasamento di {1}; ampliare l'intervallo dello sfasatore",
  ],
  'fault.commandOneTurn': [
    'is 0; it must be the command for one turn of phase',
    'ist 0; es muss der Stellwert für eine Periode der Phase sein',
    'è 0; deve essere il comando per un giro di fase',
  ],
  'fault.pitchFringesPer': [
    'its pitch is {0} fringes per degree, but the pattern needs {1}; scan with patterns of its own pitch',
    'seine Teilung ist {0} Streifen je Grad, das Muster braucht {1}; mit Mustern seiner Teilung scannen',
    'il suo passo è {0} frange per grado, ma il pattern ne richiede {1}; scansionare con pattern del suo passo',
  ],
  'fault.outsideRange': [
    '{0} {1} is outside its range, {2} to {3}',
    '{0} {1} liegt außerhalb des Bereichs, {2} bis {3}',
    "{0} {1} è fuori dall'intervallo, da {2} a {3}",
  ],
  'fault.driverOpenedDevice': [
    'the driver opened a device of another kind; choose another driver',
    'der Treiber öffnete ein Gerät anderer Art; einen anderen Treiber wählen',
    'il driver ha aperto un dispositivo di altro tipo; scegliere un altro driver',
  ],
  'fault.xPixelsCorrect': [
    "{0}: {1} is not the {2} x {3} pixels of {4}; correct the rig or the device's region",
    '{0}: {1} ist nicht {2} × {3} Pixel wie {4}; den Aufbau oder den Bildausschnitt des Geräts berichtigen',
    "{0}: {1} non è {2} × {3} pixel come {4}; correggere l'apparato o la regione del dispositivo",
  ],
  'fault.whiteLevelBut': [
    '{0}: {1}.white_level is {2}, but {3} is saturated at {4} or a little below',
    '{0}: {1}.white_level ist {2}, aber {3} ist bei {4} oder etwas darunter gesättigt',
    '{0}: {1}.white_level è {2}, ma {3} è satura a {4} o poco sotto',
  ],
  'fault.devicesFringesPhase': [
    '{0}: [devices.fringes] is a phase shifter, but projector.model is "pinhole"',
    '{0}: [devices.fringes] ist ein Phasenschieber, aber projector.model ist "pinhole"',
    '{0}: [devices.fringes] è uno sfasatore, ma projector.model è "pinhole"',
  ],
  'fault.cameraMoreCameras': [
    'is of a camera "{0}" that [[more_cameras]] does not have; add it, or remove the device',
    'gehört zu einer Kamera „{0}“, die in [[more_cameras]] fehlt; ergänzen oder das Gerät entfernen',
    'è di una camera «{0}» che manca in [[more_cameras]]; aggiungerla o togliere il dispositivo',
  ],
  'fault.angleCannotSet': [
    'its angle cannot be set; home it',
    'der Winkel lässt sich nicht setzen; referenzieren',
    "l'angolo non si può impostare; cercare il riferimento",
  ],
} as const satisfies Rows;
