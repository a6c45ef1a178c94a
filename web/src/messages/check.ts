import type { Rows } from './rows';

/** Texts of what is checked before a scan, and of what was found about a surface. */
export const CHECK = {
  'check.title': ['Before the scan', 'Vor dem Scan', 'Prima della scansione'],
  'check.run': ['Check everything now', 'Jetzt alles prüfen', 'Controlla tutto ora'],
  'check.answer': ['All answer.', 'Alle antworten.', 'Tutti rispondono.'],
  'check.answered': [
    'Answered when last used.',
    'Antworteten beim letzten Gebrauch.',
    "Hanno risposto all'ultimo uso.",
  ],
  'check.untested': ['Not tested yet.', 'Noch nicht geprüft.', 'Non ancora provati.'],
  'check.uncalibrated': [
    'The rig is not calibrated.',
    'Der Aufbau ist nicht kalibriert.',
    "L'apparato non è calibrato.",
  ],
  'check.exact': ['Simulated: known exactly.', 'Simuliert: genau bekannt.', 'Simulato: noto esattamente.'],
  'check.undated': [
    'Geometry without a date or uncertainty.',
    'Geometrie ohne Datum und Unsicherheit.',
    'Geometria senza data né incertezza.',
  ],
  'check.today': ['Of today, ± {sigma} mm.', 'Von heute, ± {sigma} mm.', 'Di oggi, ± {sigma} mm.'],
  'check.yesterday': ['Of yesterday, ± {sigma} mm.', 'Von gestern, ± {sigma} mm.', 'Di ieri, ± {sigma} mm.'],
  'check.days': [
    '{days} days old, ± {sigma} mm.',
    '{days} Tage alt, ± {sigma} mm.',
    'Di {days} giorni fa, ± {sigma} mm.',
  ],
  'check.noTable': [
    'No turntable: one station, or turned by hand.',
    'Kein Drehtisch: eine Station, oder von Hand gedreht.',
    'Senza tavola: una stazione, o girata a mano.',
  ],
  'check.noAxis': [
    'Not known; the stations cannot be joined.',
    'Nicht bekannt; die Stationen lassen sich nicht verbinden.',
    'Non noto; le stazioni non si possono unire.',
  ],
  'check.axisFound': ['Found, ± {sigma}°.', 'Gefunden, ± {sigma}°.', 'Trovato, ± {sigma}°.'],
  'check.axisOfScan': [
    'Found from this scan, ± {sigma}°.',
    'Aus diesem Scan gefunden, ± {sigma}°.',
    'Trovato da questa scansione, ± {sigma}°.',
  ],
  'check.byScan': [
    'A part without symmetry, such as a figure, shows it in its own scan.',
    'Ein Teil ohne Symmetrie, etwa eine Figur, zeigt sie im eigenen Scan.',
    'Un pezzo senza simmetrie, come una figura, lo mostra nella propria scansione.',
  ],
  'check.axisKnown': ['Known from the rig.', 'Aus dem Aufbau bekannt.', "Noto dall'apparato."],
  'check.home': ['Home of the turntable', 'Nullstellung des Drehtischs', 'Zero della tavola'],
  'check.homeKnown': [
    'It answers; 0° is its home, or where it stands.',
    'Er antwortet; 0° ist seine Nullstellung oder wo er steht.',
    'Risponde; 0° è il suo zero, o dove sta.',
  ],
  'check.homeLost': [
    'Where it stands is not known: state its angle.',
    'Wo er steht, ist nicht bekannt: Winkel angeben.',
    'Dove sta non è noto: indicare il suo angolo.',
  ],
  'check.focus': ['Focus', 'Schärfe', 'Fuoco'],
  'check.unseen': ['Not looked at yet.', 'Noch nicht angesehen.', 'Non ancora guardato.'],
  'check.afterCalibration': [
    'Can be judged when the rig is calibrated.',
    'Lässt sich nach der Kalibrierung beurteilen.',
    'Si può giudicare dopo la calibrazione.',
  ],
  'check.contrast': [
    'Contrast of the finest fringes {contrast}.',
    'Kontrast der feinsten Streifen {contrast}.',
    'Contrasto delle frange più fini {contrast}.',
  ],
  'check.blurred': [
    'Contrast of the finest fringes only {contrast}: sharpen camera and projector, darken the room.',
    'Kontrast der feinsten Streifen nur {contrast}: Kamera und Projektor scharf stellen, Raum abdunkeln.',
    'Contrasto delle frange più fini solo {contrast}: mettere a fuoco camera e proiettore, oscurare la stanza.',
  ],
  'check.light': [
    '{saturated} % saturated, {points} points.',
    '{saturated} % übersteuert, {points} Punkte.',
    '{saturated} % saturi, {points} punti.',
  ],
  'check.nothing': [
    'No point was measured: is the part in the light?',
    'Kein Punkt gemessen: Steht das Teil im Licht?',
    'Nessun punto misurato: il pezzo è nella luce?',
  ],
  'findings.title': ['Findings', 'Befunde', 'Riscontri'],
  'findings.untrusted': ['Do not trust this surface', 'Dieser Fläche nicht trauen', 'Non fidarsi di questa superficie'],
  'findings.leftOut': [
    'Views missing from this surface: {count} of {all}.',
    'In dieser Fläche fehlende Ansichten: {count} von {all}.',
    'Viste che mancano in questa superficie: {count} su {all}.',
  ],
  'findings.toScan': [
    'To the scan: capture views again',
    'Zum Scan: Ansichten neu aufnehmen',
    'Alla scansione: riprendere viste',
  ],
  'findings.view': ['view {number}', 'Ansicht {number}', 'vista {number}'],
} as const satisfies Rows;
