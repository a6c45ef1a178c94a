import type { Rows } from './rows';

/** Texts of the step Scan. */
export const SCAN = {
  'scan.start': ['Start the scan', 'Scan starten'],
  'scan.continue': ['Continue the scan', 'Scan fortsetzen'],
  'scan.pause': ['Pause', 'Pause'],
  'scan.complete': ['Scan complete', 'Scan vollständig'],
  'scan.ready': ['Ready', 'Bereit'],
  'scan.left': ['{time} left', 'noch {time}'],
  'scan.stations': ['{done} of {count} stations', '{done} von {count} Stationen'],
  'scan.stationsNoun': ['stations', 'Stationen'],
  'scan.angle': ['Angle', 'Winkel'],
  'scan.contrast': ['Contrast', 'Kontrast'],
  'scan.saturated': ['Saturated', 'Übersteuert'],
  'scan.points': ['Points', 'Punkte'],
  'scan.quality': ['Quality', 'Qualität'],
  'scan.lead': [
    'The table turns through its stations; each view is decoded and judged while the next one is captured.',
    'Der Tisch fährt die Stationen an; jede Ansicht wird ausgewertet, während die nächste aufgenommen wird.',
  ],
  'scan.resume': [
    'This scan was interrupted. Nothing that was captured is lost.',
    'Dieser Scan wurde unterbrochen. Nichts Aufgenommenes ist verloren.',
  ],
  'scan.tableAngle': ['Present angle of the turntable, °', 'Jetziger Winkel des Drehtischs, °'],
  'scan.noAxis': [
    'The axis of the turntable is not known yet; without it the stations cannot be joined.',
    'Die Achse des Drehtischs ist noch nicht bekannt; ohne sie lassen sich die Stationen nicht verbinden.',
  ],
  'scan.toAxis': ['Find the axis', 'Achse suchen'],
  'scan.noRig': [
    'This folder holds a finished scan without devices.',
    'Dieser Ordner enthält einen fertigen Scan ohne Geräte.',
  ],
  'scan.rescan': ['Scan this station again', 'Diese Station neu aufnehmen'],
  'scan.build': ['Build the surface', 'Fläche berechnen'],
  'scan.setup': ['Setup {number}', 'Aufspannung {number}'],
  'scan.setups': ['Setups', 'Aufspannungen'],
  'scan.otherSide': ['The other side', 'Die andere Seite'],
  'scan.otherSideHint': [
    'The face that the part stands on is not measured yet. Turn the part over and scan it again: the setups are joined by their shape.',
    'Die Fläche, auf der das Teil steht, fehlt noch. Teil umdrehen und noch einmal scannen: Die Aufspannungen werden über ihre Form verbunden.',
  ],
  'scan.turnOver': ['Turn the part over', 'Teil umdrehen'],
  'scan.turnOverPicture': [
    'A part that stands on the turntable is turned over, so that its underside is seen',
    'Ein Teil auf dem Drehtisch wird umgedreht, sodass man seine Unterseite sieht',
  ],
  'scan.turnOver1': [
    'Take the part off and put it back upside down or on its side, anywhere near the middle.',
    'Das Teil abnehmen und kopfüber oder auf die Seite gelegt zurückstellen, irgendwo nahe der Mitte.',
  ],
  'scan.turnOver2': [
    'Leave a third of the surface in view of both setups; a part that looks alike from all sides needs a mark of its shape.',
    'Ein Drittel der Oberfläche soll in beiden Aufspannungen zu sehen sein; ein Teil, das von allen Seiten gleich aussieht, braucht ein Merkmal.',
  ],
  'scan.turnOver3': ['Leave the turntable and the camera as they are.', 'Drehtisch und Kamera bleiben, wie sie sind.'],
  'scan.turnOverSimulated': [
    'The simulated part turns over by itself.',
    'Das simulierte Teil dreht sich von selbst um.',
  ],
  'scan.startSetup': ['Scan setup {number}', 'Aufspannung {number} scannen'],
  'scan.notYet': ['Not now', 'Jetzt nicht'],
  'scan.turnedSince': ['The part was turned over since', 'Das Teil wurde seither umgedreht'],
  'scan.good': ['good', 'gut'],
} as const satisfies Rows;
