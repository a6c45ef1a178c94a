import type { Rows } from './rows';

/** Failures and warnings of a scan. `tools/check_faults.py` explains them. */
export const FAULTS_ACQUISITION = {
  'fault.planCalibrationNeeds': [
    'the plan of a calibration needs a board',
    'eine Kalibrierung braucht ein Brett',
    'una calibrazione richiede una scacchiera',
  ],
  'fault.exposuresChosenMs': [
    'exposures chosen: {0} ms',
    'gewählte Belichtungen: {0} ms',
    'esposizioni scelte: {0} ms',
  ],
  'fault.linesAnotherOrder': [
    'has its lines in another order',
    'hat seine Zeilen in anderer Reihenfolge',
    'ha le righe in un altro ordine',
  ],
  'fault.hadNow': ['had "{0}" and now has "{1}"', 'hatte „{0}“ und hat jetzt „{1}“', 'aveva «{0}» e ora ha «{1}»'],
  'fault.emptyNameNew': [
    '{0}: is not empty; name a new folder, or empty this one',
    '{0}: ist nicht leer; einen neuen Ordner angeben oder diesen leeren',
    '{0}: non è vuota; indicare una nuova cartella o svuotare questa',
  ],
  'fault.damagedReplaced': [
    '{0}: was damaged and is replaced',
    '{0}: war beschädigt und wird ersetzt',
    '{0}: era danneggiato e viene sostituito',
  ],
  'fault.holdsAnotherScan': [
    '{0}: holds another scan: {1} {2}; name a new folder, or use the options and the rig of the first session',
    '{0}: enthält einen anderen Scan: {1} {2}; einen neuen Ordner angeben oder mit den Einstellungen und dem Aufbau des ersten weitermachen',
    "{0}: contiene un'altra scansione: {1} {2}; indicare una nuova cartella o usare le impostazioni e l'apparato della prima",
  ],
  'fault.lineNewerVersion': [
    '{0}: line {1} is of a newer version of the program; update it, or start the scan in a new folder',
    '{0}: Zeile {1} stammt von einer neueren Programmversion; das Programm aktualisieren oder den Scan in einem neuen Ordner beginnen',
    '{0}: la riga {1} è di una versione più nuova del programma; aggiornarlo o iniziare la scansione in una nuova cartella',
  ],
  'fault.damagedLinesManifest': [
    'damaged lines of the manifest: {0}, frames recovered from the disk: {1}',
    'beschädigte Zeilen des Verzeichnisses: {0}, vom Datenträger wiederhergestellte Bilder: {1}',
    "righe danneggiate dell'elenco: {0}, fotogrammi recuperati dal disco: {1}",
  ],
  'fault.nextAttempt': ['; at the next attempt: {0}', '; beim nächsten Versuch: {0}', '; al prossimo tentativo: {0}'],
  'fault.viewCouldCaptured': [
    'no view could be captured; {0}',
    'keine Ansicht ließ sich aufnehmen; {0}',
    'nessuna vista si è potuta riprendere; {0}',
  ],
  'fault.greyRampCannot': [
    'is a grey ramp, which {0} cannot show; scan without `ramp`, or use a digital projector',
    'ist eine Graurampe, die {0} nicht zeigen kann; ohne Rampe scannen oder einen Digitalprojektor benutzen',
    'è una rampa di grigi, che {0} non può mostrare; scansionare senza rampa o usare un proiettore digitale',
  ],
  'fault.grayCodeCannot': [
    'is a Gray code, which {0} cannot show; choose another `sequence`, or use a digital projector',
    'ist ein Gray-Code, den {0} nicht zeigen kann; eine andere Sequenz wählen oder einen Digitalprojektor benutzen',
    "è un codice Gray, che {0} non può mostrare; scegliere un'altra sequenza o usare un proiettore digitale",
  ],
  'fault.fringesPerDegree': [
    'has no fringes_per_degree, which {0} needs',
    'hat kein fringes_per_degree, das {0} braucht',
    'non ha fringes_per_degree, che {0} richiede',
  ],
  'fault.fringesPerDegreeBut': [
    'has {0} fringes per degree, but {1} shows {2}; scan with patterns of its own pitch',
    'hat {0} Streifen je Grad, aber {1} zeigt {2}; mit Mustern seiner eigenen Teilung scannen',
    'ha {0} frange per grado, ma {1} ne mostra {2}; scansionare con pattern del suo passo',
  ],
  'fault.shiftDegreesCannot': [
    'has a shift of {0} degrees, which {1} cannot show: {2}',
    'hat eine Verschiebung von {0} Grad, die {1} nicht zeigen kann: {2}',
    'ha uno sfasamento di {0} gradi, che {1} non può mostrare: {2}',
  ],
  'fault.periodPxAbove': [
    'has no period_px above 0, which {0} needs',
    'hat kein period_px über 0, das {0} braucht',
    'non ha un period_px maggiore di 0, che {0} richiede',
  ],
  'fault.stripePxAbove': [
    'has no stripe_px above 0, which {0} needs',
    'hat kein stripe_px über 0, das {0} braucht',
    'non ha uno stripe_px maggiore di 0, che {0} richiede',
  ],
  'fault.levelLevels': [
    'has the level {0}; levels are from 0 to 1',
    'hat die Stufe {0}; Stufen liegen zwischen 0 und 1',
    'ha il livello {0}; i livelli vanno da 0 a 1',
  ],
  'fault.framesGiveShifts': [
    'has no frames; give it shifts, bits or levels, or leave it out',
    'hat keine Bilder; ihm Verschiebungen, Bits oder Stufen geben oder es weglassen',
    'non ha fotogrammi; dargli sfasamenti, bit o livelli, o toglierlo',
  ],
  'fault.shiftFiniteNumber': [
    'has a shift that is not a finite number; correct it',
    'hat eine Verschiebung, die keine endliche Zahl ist; sie berichtigen',
    'ha uno sfasamento che non è un numero finito; correggerlo',
  ],
  'fault.viewDegreesOutside': [
    '{0}: the view at {1} degrees is outside its limits, {2} to {3}; take other views, or correct min_deg and max_deg in rig.toml',
    '{0}: die Ansicht bei {1} Grad liegt außerhalb seiner Grenzen, {2} bis {3}; andere Ansichten wählen oder min_deg und max_deg in rig.toml berichtigen',
    '{0}: la vista a {1} gradi è fuori dai suoi limiti, da {2} a {3}; scegliere altre viste o correggere min_deg e max_deg in rig.toml',
  ],
  'fault.rigDevicesCamera': [
    'the rig has no [devices.camera-{0}], which takes the frames of its camera "{1}"; add it to rig.toml',
    'dem Aufbau fehlt das Gerät [devices.camera-{0}], das die Bilder seiner Kamera „{1}“ aufnimmt; in rig.toml ergänzen',
    "l'apparato non ha [devices.camera-{0}], che riprende i fotogrammi della camera «{1}»; aggiungerlo a rig.toml",
  ],
  'fault.damagedLacksExposures': [
    '{0}: {1} is damaged and lacks the exposures that were chosen; start the scan in a new folder',
    '{0}: {1} ist beschädigt, die gewählten Belichtungen fehlen; den Scan in einem neuen Ordner beginnen',
    '{0}: {1} è danneggiato e mancano le esposizioni scelte; iniziare la scansione in una nuova cartella',
  ],
  'fault.stepErrorPhase': [
    'step error of the phase shifter: {0} %, corrected from the first set on',
    'Schrittfehler des Phasenschiebers: {0} %, ab der ersten Aufnahme berichtigt',
    'errore di passo dello sfasatore: {0} %, corretto dalla prima serie in poi',
  ],
  'fault.homeSwitchMay': [
    'has no home switch, and may have been turned since the last session of this scan',
    'hat keinen Referenzschalter und wurde seit der letzten Sitzung dieses Scans vielleicht gedreht',
    "non ha interruttore di riferimento e può essere stata girata dopo l'ultima sessione di questa scansione",
  ],
  'fault.leftDegreesStill': [
    '{0}, which left it at {1} degrees; if it still stands there, set `table_at_rad` to {2}, otherwise turn it to 0 by hand and set `table_at_rad` to 0',
    '{0}, die ihn bei {1} Grad verließ; steht er noch dort, diesen Winkel angeben, sonst ihn von Hand auf 0 drehen und 0 angeben',
    "{0}, che l'ha lasciata a {1} gradi; se è ancora lì, indicare quell'angolo, altrimenti girarla a mano a 0 e indicare 0",
  ],
  'fault.endedWhileTurned': [
    '{0}, which ended while it turned{1} to {2} degrees; turn it to 0 by hand and set `table_at_rad` to 0',
    '{0}, die endete, während er{1} auf {2} Grad drehte; ihn von Hand auf 0 drehen und 0 angeben',
    '{0}, finita mentre girava{1} a {2} gradi; girarla a mano a 0 e indicare 0',
  ],
  'fault.findsAngleHome': [
    '{0}: finds its angle with its home switch; leave `table_at_rad` out',
    '{0}: findet seinen Winkel mit dem Referenzschalter; den Winkel nicht angeben',
    "{0}: trova il suo angolo con l'interruttore di riferimento; non indicare l'angolo",
  ],
  'fault.lastSessionLeft': [
    '{0}: the last session left it at {1} degrees, and `table_at_rad` is {2}; this is right only if it was turned since',
    '{0}: die letzte Sitzung verließ ihn bei {1} Grad, angegeben sind {2}; das stimmt nur, wenn er seither gedreht wurde',
    "{0}: l'ultima sessione l'ha lasciata a {1} gradi, ma è indicato {2}; è giusto solo se da allora è stata girata",
  ],
  'fault.captureViewAgain': [
    '{0}; capture the view again',
    '{0}; die Ansicht noch einmal aufnehmen',
    '{0}; riprendere di nuovo la vista',
  ],
  'fault.goodView': ['good', 'gut', 'buona'],
  'fault.contrastSaturatedPoints': [
    '{0}: contrast {1}, {2} % saturated, {3} points',
    '{0}: Kontrast {1}, {2} % gesättigt, {3} Punkte',
    '{0}: contrasto {1}, {2} % saturi, {3} punti',
  ],
  'fault.fringesMovedMm': [
    'the fringes moved by {0} mm at the part within {1} s',
    'die Streifen bewegten sich am Teil um {0} mm in {1} s',
    'le frange si sono mosse di {0} mm sul pezzo in {1} s',
  ],
  'fault.fringesStillMove': [
    'the fringes still move by {0} mm at the part within {1} s after {2} s: let the rig warm up, look for what moves, or allow more by `wait_for_drift`',
    'die Streifen bewegen sich am Teil nach {2} s noch um {0} mm in {1} s: den Aufbau warmlaufen lassen und suchen, was sich bewegt, oder mehr zulassen',
    "dopo {2} s le frange si muovono ancora di {0} mm sul pezzo in {1} s: lasciare scaldare l'apparato e cercare che cosa si muove, o ammettere di più",
  ],
  'fault.displayRoom': ['display and room', 'Projektor und Raum', 'proiettore e ambiente'],
  'fault.framesFlashesLate': [
    '{0}: its frames are {1} flashes late; correct its driver',
    '{0}: seine Bilder kommen {1} Blitze zu spät; seinen Treiber berichtigen',
    '{0}: i suoi fotogrammi arrivano {1} lampi in ritardo; correggere il driver',
  ],
  'fault.rigLineWrite': [
    'the rig has no line [{0}]; write this table on lines of its own',
    'der Aufbau hat keine Zeile [{0}]; diese Tabelle auf eigene Zeilen schreiben',
    "l'apparato non ha la riga [{0}]; scrivere questa tabella su righe proprie",
  ],
} as const satisfies Rows;
