import type { Rows } from './rows';

/** Texts of the list of projects. */
export const HOME = {
  'home.title': ['From an empty table to a measured surface.', 'Vom leeren Tisch zur gemessenen Fläche.'],
  'home.lead': [
    'Project fringes, turn the table, fuse the views. Every vertex comes with its uncertainty.',
    'Streifen projizieren, Tisch drehen, Ansichten vereinen. Jeder Punkt kommt mit seiner Unsicherheit.',
  ],
  'home.try': ['Try the simulated rig', 'Simulierten Aufbau ausprobieren'],
  'home.tryHint': [
    'No hardware needed: camera, projector and turntable are ray-traced.',
    'Ohne Geräte: Kamera, Projektor und Drehtisch werden berechnet.',
  ],
  'home.new': ['New project', 'Neues Projekt'],
  'home.name': ['Name', 'Name'],
  'home.part': ['Part before the camera', 'Teil vor der Kamera'],
  'home.stations': ['Turntable stations', 'Drehtischstationen'],
  'home.source': ['Rig', 'Aufbau'],
  'home.source.simulated': ['Simulated', 'Simuliert'],
  'home.source.devices': ['My devices', 'Meine Geräte'],
  'home.source.file': ['rig.toml', 'rig.toml'],
  'home.source.example': ['Example', 'Beispiel'],
  'home.devicesHint': [
    'The step Rig searches for what is connected to the computer of the server; sizes are read from the devices, the rest from the calibration.',
    'Der Schritt Aufbau sucht, was am Rechner des Servers angeschlossen ist; Größen melden die Geräte, den Rest ergibt die Kalibrierung.',
  ],
  'home.chooseFile': ['Choose the files', 'Dateien wählen'],
  'home.file': [
    'rig.toml, with the CSV file of its covariance if it names one',
    'rig.toml, mit der CSV-Datei seiner Kovarianz, falls es eine nennt',
  ],
  'home.example': ['Example', 'Beispiel'],
  'home.create': ['Create', 'Anlegen'],
  'home.recent': ['Recent', 'Zuletzt'],
  'home.none': ['Projects appear here.', 'Hier erscheinen Projekte.'],
  'home.scanned': ['scanned', 'gescannt'],
  'home.surface': ['surface', 'Fläche'],
  'home.empty': ['empty', 'leer'],
  'home.close': ['Close project', 'Projekt schließen'],
} as const satisfies Rows;
