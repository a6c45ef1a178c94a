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
} as const satisfies Rows;
