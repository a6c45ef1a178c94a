import type { Rows } from './rows';

/** Failures and warnings of simulated devices. `tools/check_faults.py` explains them. */
export const FAULTS_SIMULATE = {
  'fault.fringesPerDegreeAbove': [
    "`fringes_per_degree` is {0}; it must be above 0 and give at most {1} fringes over the projector's field",
    'es sind {0} Streifen je Grad; der Wert muss über 0 sein und höchstens {1} Streifen über das Projektorfeld ergeben',
    'le frange per grado sono {0}; devono essere più di 0 e dare al massimo {1} frange sul campo del proiettore',
  ],
  'fault.fringePeriodPixels': [
    'a fringe period is {0} pixels; it must be at least {1}',
    'eine Streifenperiode hat {0} Pixel; es müssen mindestens {1} sein',
    'un periodo delle frange ha {0} pixel; devono essere almeno {1}',
  ],
  'fault.holdsEachBegin': [
    'holds "{0}"; each must begin with one of {1}',
    'enthält „{0}“; jeder Eintrag muss mit einem davon beginnen: {1}',
    'contiene «{0}»; ognuno deve cominciare con uno di {1}',
  ],
  'fault.dumbbellOneBall': [
    'a dumbbell has one ball or two',
    'eine Hantel hat eine oder zwei Kugeln',
    'un manubrio ha una o due sfere',
  ],
  'fault.lineButRigLine': [
    'is a line, but the rig has no [line]',
    'ist eine Laserlinie, aber der Aufbau hat kein [line]',
    "è una linea laser, ma l'apparato non ha [line]",
  ],
  'fault.grayCodeAngular': [
    'is Gray code, which an angular projector cannot show',
    'ist Gray-Code, den ein Winkelprojektor nicht zeigen kann',
    'è un codice Gray, che un proiettore angolare non può mostrare',
  ],
  'fault.needsBitsStripes': [
    'needs bits and stripes above 0',
    'braucht Bits und Streifen über 0',
    'richiede bit e strisce maggiori di 0',
  ],
  'fault.needsFringesPer': [
    'needs fringes_per_degree above 0',
    'braucht fringes_per_degree über 0',
    'richiede fringes_per_degree maggiore di 0',
  ],
  'fault.horizontalButAngularProjector': [
    "is horizontal, but an angular projector's fringes are vertical",
    'ist waagerecht, aber die Streifen eines Winkelprojektors sind senkrecht',
    'è orizzontale, ma le frange di un proiettore angolare sono verticali',
  ],
  'fault.needsPeriodPxAbove': [
    'needs a period_px above 0',
    'braucht ein period_px über 0',
    'richiede un period_px maggiore di 0',
  ],
  'fault.calledTurntableTop': [
    'is called turntable_top_radius_mm now; rename it',
    'heißt jetzt turntable_top_radius_mm; umbenennen',
    'ora si chiama turntable_top_radius_mm; rinominarlo',
  ],
  'fault.oneStlPly': [
    'is "{0}"; it must be one of {1}, or a .stl, .ply or .obj file',
    'ist „{0}“; möglich sind {1} oder eine .stl-, .ply- oder .obj-Datei',
    'è «{0}»; deve essere uno di {1}, o un file .stl, .ply o .obj',
  ],
  'fault.cameraAnotherSize': [
    'has a camera of another size; correct [camera] size_px',
    'hat eine Kamera anderer Größe; size_px in [camera] berichtigen',
    'ha una camera di altra grandezza; correggere size_px in [camera]',
  ],
  'fault.showsSimulatedBoard': [
    'shows a simulated board to one camera; remove [[more_cameras]]',
    'zeigt ein simuliertes Brett nur einer Kamera; [[more_cameras]] entfernen',
    'mostra una scacchiera simulata a una sola camera; togliere [[more_cameras]]',
  ],
  'fault.xPixelsWhite': [
    '{0} x {1} pixels, white at {2}, exposure {3} ms',
    '{0} × {1} Pixel, Weiß bei {2}, Belichtung {3} ms',
    '{0} × {1} pixel, bianco a {2}, esposizione {3} ms',
  ],
  'fault.frameCameCheck': [
    'no frame came; check its cable',
    'kein Bild kam an; das Kabel prüfen',
    'nessun fotogramma arrivato; controllare il cavo',
  ],
  'fault.packetsLost': ['packets were lost', 'Pakete gingen verloren', 'si sono persi pacchetti'],
  'fault.digitalProjectorBut': [
    'is a digital projector, but the rig has none',
    'ist ein Digitalprojektor, aber der Aufbau hat keinen',
    "è un proiettore digitale, ma l'apparato non ne ha",
  ],
  'fault.simulatedLaserSheet': ['simulated laser sheet', 'simuliertes Laserblatt', 'foglio laser simulato'],
  'fault.isItMustBeFrom': [
    '{0} is {1}; it must be from {2} to {3}',
    '{0} ist {1}; möglich ist {2} bis {3}',
    '{0} è {1}; deve essere da {2} a {3}',
  ],
  'fault.bitsCamera': [
    'bits is {0}; a camera has 8, 10, 12 or 16',
    'bits ist {0}; eine Kamera hat 8, 10, 12 oder 16',
    'bits è {0}; una camera ne ha 8, 10, 12 o 16',
  ],
  'fault.paintedSquaresReplace': [
    'painted squares replace the texture: leave `texture` at 0',
    'bemalte Felder ersetzen die Textur: sie bei 0 lassen',
    'le caselle dipinte sostituiscono la texture: lasciarla a 0',
  ],
  'fault.displayGammaFault': [
    'display gamma is a fault of a digital projector, but the rig has an angular one; leave it at 1',
    'Gamma ist ein Fehler eines Digitalprojektors, der Aufbau hat einen Winkelprojektor; bei 1 lassen',
    "la gamma è un difetto di un proiettore digitale, ma l'apparato ne ha uno angolare; lasciarla a 1",
  ],
  'fault.binaryDitheredPatterns': [
    'binary and dithered patterns are those of a digital projector, but the rig has an angular one; leave `waveform` at sine',
    'binäre und gerasterte Muster sind die eines Digitalprojektors, der Aufbau hat einen Winkelprojektor; bei Sinus bleiben',
    "i pattern binari e retinati sono di un proiettore digitale, ma l'apparato ne ha uno angolare; lasciare il seno",
  ],
  'fault.rigSProjector': [
    "the rig's projector is a label, of which no fringes can be rendered; give its model and pose in rig.toml",
    'der Projektor des Aufbaus bezeichnet nur, seine Streifen lassen sich nicht simulieren; Modell und Lage in rig.toml angeben',
    "il proiettore dell'apparato è solo un'etichetta, e le sue frange non si possono simulare; indicarne modello e posa in rig.toml",
  ],
  'fault.rigTurntablePlaces': [
    'the rig has no [turntable], which places the part; add it to rig.toml',
    'der Aufbau hat kein [turntable], das dem Teil seinen Platz gibt; in rig.toml ergänzen',
    "l'apparato non ha [turntable], che dà il posto al pezzo; aggiungerlo a rig.toml",
  ],
  'fault.doesAnswerCable': [
    'does not answer; is its cable plugged in?',
    'antwortet nicht; steckt das Kabel?',
    'non risponde; il cavo è collegato?',
  ],
  'fault.degreesOutsideLimits2': [
    '{0} degrees is outside its limits, {1} to {2}',
    '{0} Grad liegen außerhalb der Grenzen, {1} bis {2}',
    '{0} gradi sono fuori dai limiti, da {1} a {2}',
  ],
  'fault.angleKnownHome': [
    'its angle is not known; home it first',
    'der Winkel ist nicht bekannt; erst referenzieren',
    "l'angolo non è noto; cercare prima il riferimento",
  ],
  'fault.stoppedAlarmSee': [
    'stopped with an alarm; see what blocks it, then home it',
    'hielt mit einem Alarm an; nachsehen, was ihn blockiert, dann referenzieren',
    'si è fermata con un allarme; vedere che cosa la blocca, poi cercare il riferimento',
  ],
  'fault.didReachDegrees': [
    'did not reach {0} degrees in time; see what blocks it',
    'erreichte {0} Grad nicht rechtzeitig; nachsehen, was ihn blockiert',
    'non ha raggiunto {0} gradi in tempo; vedere che cosa la blocca',
  ],
  'fault.didReachDegreesWithin': [
    'did not reach {0} degrees within {1} s; see what blocks it',
    'erreichte {0} Grad nicht innerhalb von {1} s; nachsehen, was ihn blockiert',
    'non ha raggiunto {0} gradi entro {1} s; vedere che cosa la blocca',
  ],
  'fault.isNotEnabled': ['is not enabled', 'ist nicht eingeschaltet', 'non è attivata'],
  'fault.builtPartChoose': [
    'there is no built-in part "{0}"; choose one of {1}',
    'das eingebaute Teil „{0}“ gibt es nicht; wählen aus {1}',
    'il pezzo incorporato «{0}» non esiste; scegliere fra {1}',
  ],
  'fault.builtRigChoose': [
    'there is no built-in rig "{0}"; choose one of {1}, or name a rig.toml',
    'den eingebauten Aufbau „{0}“ gibt es nicht; wählen aus {1} oder eine rig.toml angeben',
    "l'apparato incorporato «{0}» non esiste; scegliere fra {1} o indicare un rig.toml",
  ],
  'fault.rayTracedCamera': [
    'a ray-traced camera before a part',
    'eine simulierte Kamera vor einem Teil',
    'una camera simulata davanti a un pezzo',
  ],
  'fault.interferometerSPiezo': [
    "an interferometer's piezo with the faults of one",
    'der Piezo eines Interferometers mit dessen Fehlern',
    'il piezo di un interferometro con i suoi difetti',
  ],
  'fault.turntableBacklash': [
    'a turntable with backlash',
    'ein Drehtisch mit Umkehrspiel',
    'una tavola rotante con gioco',
  ],
  'fault.fringesLight': ["the fringes' light", 'das Licht der Streifen', 'la luce delle frange'],
} as const satisfies Rows;
