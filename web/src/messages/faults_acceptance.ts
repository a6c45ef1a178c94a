import type { Rows } from './rows';

/** What an acceptance test lacks or refuses. The first column is the sentence of the program. */
export const FAULTS_ACCEPTANCE = {
  'fault.fewArrangements': ['{0} of {1} arrangements', '{0} von {1} Anordnungen', '{0} disposizioni su {1}'],
  'fault.singleBall': [
    'a ball bar: a single ball tests neither spacing nor length',
    'ein Kugelstab: eine einzelne Kugel prüft weder Abstand noch Länge',
    'una barra a sfere: una sola sfera non verifica né distanza né lunghezza',
  ],
  'fault.endsUnseen': [
    'an arrangement in which both outer ends of the ball bar are seen',
    'eine Anordnung, in der beide äußeren Enden des Kugelstabs zu sehen sind',
    'una disposizione in cui si vedano le due estremità della barra',
  ],
  'fault.volumeUnknown': [
    'the size of the measuring volume (volume_mm), which the artifact must fit',
    'die Größe des Messvolumens, zu der der Prüfkörper passen muss',
    'la misura del volume di misura, a cui il campione deve adattarsi',
  ],
  'fault.ballsOfVolume': [
    'balls of {0} to {1} mm for this volume; {2} mm was used',
    'Kugeln von {0} bis {1} mm für dieses Volumen; verwendet wurden {2} mm',
    'sfere da {0} a {1} mm per questo volume; usata una di {2} mm',
  ],
  'fault.spacingOfVolume': [
    'a spacing of at least {0} mm for this volume; {1} mm was used',
    'ein Abstand von mindestens {0} mm für dieses Volumen; verwendet wurden {1} mm',
    'una distanza di almeno {0} mm per questo volume; usata una di {1} mm',
  ],
  'fault.ballsOverlap': [
    'is less than the sum of the radii: the balls would overlap',
    'ist kleiner als die Summe der Radien: die Kugeln würden sich überlappen',
    'è minore della somma dei raggi: le sfere si sovrapporrebbero',
  ],
  'fault.testNeedsProject': [
    'a test needs a project; this is a plain scan folder',
    'eine Prüfung braucht ein Projekt; dies ist nur ein Scan-Ordner',
    'una verifica ha bisogno di un progetto; questa è solo una cartella di scansione',
  ],
  'fault.noAcceptanceTest': [
    'there is no acceptance test; state the artifact first',
    'es gibt keine Prüfung; geben Sie zuerst den Prüfkörper an',
    "non c'è una verifica; indicate prima il campione",
  ],
  'fault.artifactNeedsScan': [
    'the artifact is measured in the surface of a scan; scan it and build the surface first',
    'der Prüfkörper wird in der Fläche eines Scans gemessen; scannen Sie ihn und bauen Sie die Fläche',
    'il campione si misura nella superficie di una scansione; scanditelo e costruite la superficie',
  ],
  'fault.artifactEdited': [
    'the surface was edited; an acceptance test measures what the scanner delivers: undo the edits, or build the surface again',
    'die Fläche wurde bearbeitet; eine Prüfung misst, was der Scanner liefert: nehmen Sie die Schritte zurück oder bauen Sie die Fläche neu',
    'la superficie è stata modificata; una verifica misura ciò che lo scanner fornisce: annullate le modifiche o ricostruite la superficie',
  ],
  'fault.surfaceUntrusted': [
    'the surface is not trustworthy: {0}; scan the artifact again',
    'die Fläche ist nicht vertrauenswürdig: {0}; scannen Sie den Prüfkörper noch einmal',
    'la superficie non è affidabile: {0}; scandite di nuovo il campione',
  ],
  'fault.noArrangement': [
    'no arrangement of the artifact was measured; measure one first',
    'keine Anordnung des Prüfkörpers wurde gemessen; messen Sie zuerst eine',
    'nessuna disposizione del campione è stata misurata; misuratene prima una',
  ],
  'fault.simulatedCamera': [
    'the camera of the rig is simulated; the certificate says nothing about a real scanner',
    'die Kamera des Aufbaus ist simuliert; das Zertifikat sagt nichts über einen wirklichen Scanner',
    "la camera dell'apparato è simulata; il certificato non dice nulla di uno scanner reale",
  ],
  'fault.ballPartlySeen': [
    'only {0} % of a ball of {1} mm is measured; at least {2} % are needed, from more views or a better place',
    'nur {0} % einer Kugel von {1} mm sind gemessen; mindestens {2} % sind nötig: mehr Ansichten oder ein besserer Platz',
    'solo il {0} % di una sfera di {1} mm è misurato; serve almeno il {2} %, con più viste o in un posto migliore',
  ],
  'fault.noBall': [
    'no ball of {0} mm is found; check diameters_mm and whether the ball is in view',
    'keine Kugel von {0} mm gefunden; prüfen Sie den Durchmesser und ob die Kugel im Bild ist',
    'nessuna sfera di {0} mm trovata; verificate il diametro e che la sfera sia inquadrata',
  ],
  'fault.noBar': [
    'no two balls {0} mm from each other are found; check spacing_mm and whether both balls are in view',
    'keine zwei Kugeln mit {0} mm Abstand gefunden; prüfen Sie den Abstand und ob beide Kugeln im Bild sind',
    'nessuna coppia di sfere a {0} mm trovata; verificate la distanza e che entrambe siano inquadrate',
  ],
  'fault.otherBallCount': [
    'the arrangement has another number of balls than the artifact',
    'die Anordnung hat eine andere Zahl von Kugeln als der Prüfkörper',
    'la disposizione ha un numero di sfere diverso dal campione',
  ],
  'fault.testPlanLong': [
    'the plan of a test has at most 20 kB; shorten its texts',
    'der Plan einer Prüfung hat höchstens 20 kB; kürzen Sie seine Texte',
    'il piano di una verifica ha al massimo 20 kB; accorciate i testi',
  ],
  'fault.arrangementName': ['name: has 1 to 100 bytes', 'name: hat 1 bis 100 Byte', 'name: ha da 1 a 100 byte'],
  'fault.certificateFormat': ['format: is html or pdf', 'format: ist html oder pdf', 'format: è html o pdf'],
  'fault.certificateNoPdf': [
    'this program makes no PDF files; write the certificate as HTML and print it',
    'dieses Programm erzeugt keine PDF-Dateien; schreiben Sie das Zertifikat als HTML und drucken Sie es',
    'questo programma non produce file PDF; scrivete il certificato in HTML e stampatelo',
  ],
  'fault.ballCount': [
    'must be the diameters of one ball or of two',
    'muss die Durchmesser einer oder zweier Kugeln sein',
    'deve contenere i diametri di una o due sfere',
  ],
  'fault.needsTwoBalls': [
    'needs the diameters of two balls',
    'braucht die Durchmesser zweier Kugeln',
    'richiede i diametri di due sfere',
  ],
  'fault.sameArrangement': [
    'is that of another arrangement, too; each needs a scan of its own',
    'ist schon der Scan einer anderen Anordnung; jede braucht einen eigenen',
    "è già di un'altra disposizione; ognuna richiede una scansione propria",
  ],
  'fault.noScansNamed': [
    '{0}: arrangements must name the scans: [[arrangements]] with name and scan',
    '{0}: arrangements muss die Scans nennen: [[arrangements]] mit name und scan',
    '{0}: arrangements deve indicare le scansioni: [[arrangements]] con name e scan',
  ],
  'fault.arrangementsOfScans': [
    'is for source = "scans"; leave it out, the usual ones are made',
    'gilt für source = "scans"; lassen Sie es weg, die üblichen werden erzeugt',
    'vale per source = "scans"; omettetelo, si fanno quelle usuali',
  ],
  'fault.nothingMeasuredOfArtifact': [
    'no arrangement of the artifact was measured',
    'keine Anordnung des Prüfkörpers wurde gemessen',
    'nessuna disposizione del campione è stata misurata',
  ],
  'fault.sizeAboveZero': ['must be above 0', 'muss größer als 0 sein', 'deve essere maggiore di 0'],
} as const satisfies Rows;
