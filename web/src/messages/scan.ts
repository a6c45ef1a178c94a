import type { Rows } from './rows';

/** Texts of the step Scan. */
export const SCAN = {
  'scan.start': ['Start the scan', 'Scan starten', 'Avvia la scansione'],
  'scan.continue': ['Continue the scan', 'Scan fortsetzen', 'Continua la scansione'],
  'scan.pause': ['Pause', 'Pause', 'Pausa'],
  'scan.complete': ['Scan complete', 'Scan vollständig', 'Scansione completa'],
  'scan.left': ['{time} left', 'noch {time}', 'ancora {time}'],
  'scan.stations': ['{done} of {count} stations', '{done} von {count} Stationen', '{done} di {count} stazioni'],
  'scan.stationsNoun': ['stations', 'Stationen', 'stazioni'],
  'scan.angle': ['Angle', 'Winkel', 'Angolo'],
  'scan.contrast': ['Contrast', 'Kontrast', 'Contrasto'],
  'scan.saturated': ['Saturated', 'Übersteuert', 'Saturi'],
  'scan.points': ['Points', 'Punkte', 'Punti'],
  'scan.lead': [
    'The table turns through its stations; each view is decoded and judged while the next one is captured.',
    'Der Tisch fährt die Stationen an; jede Ansicht wird ausgewertet, während die nächste aufgenommen wird.',
    'La tavola passa per le sue stazioni; ogni vista è decodificata e giudicata mentre si riprende la seguente.',
  ],
  'scan.resume': [
    'This scan was interrupted. Nothing that was captured is lost.',
    'Dieser Scan wurde unterbrochen. Nichts Aufgenommenes ist verloren.',
    'Questa scansione è stata interrotta. Nulla di ciò che è ripreso è perso.',
  ],
  'scan.tableAngle': [
    'Present angle of the turntable, °',
    'Jetziger Winkel des Drehtischs, °',
    'Angolo attuale della tavola, °',
  ],
  'scan.noAxis': [
    'The axis of the turntable is not known yet; without it the stations cannot be joined.',
    'Die Achse des Drehtischs ist noch nicht bekannt; ohne sie lassen sich die Stationen nicht verbinden.',
    "L'asse della tavola rotante non è ancora noto; senza di esso le stazioni non si possono unire.",
  ],
  'scan.toAxis': ['Find the axis', 'Achse suchen', "Cerca l'asse"],
  'scan.axisOfScan': [
    'Find the axis from this scan',
    'Achse aus diesem Scan suchen',
    "Cerca l'asse da questa scansione",
  ],
  'scan.axisSought': [
    'The axis is looked for in the views of this scan.',
    'Die Achse wird in den Ansichten dieses Scans gesucht.',
    "L'asse viene cercato nelle viste di questa scansione.",
  ],
  'scan.axisFound': [
    'The axis of the turntable was found from this scan, by {views} views: ± {direction}° in direction, ± {place} mm in place.',
    'Die Achse des Drehtischs wurde aus diesem Scan gefunden, aus {views} Ansichten: ± {direction}° in der Richtung, ± {place} mm im Ort.',
    "L'asse della tavola è stato trovato da questa scansione, da {views} viste: ± {direction}° in direzione, ± {place} mm in posizione.",
  ],
  'scan.framesKept': [
    'The frames of the scan are kept: find the axis another way, then build the surface from them.',
    'Die Bilder des Scans bleiben: die Achse anders suchen, dann daraus die Fläche berechnen.',
    "Le immagini della scansione restano: cercare l'asse in altro modo, poi calcolare da esse la superficie.",
  ],
  'scan.noRig': [
    'This folder holds a finished scan without devices.',
    'Dieser Ordner enthält einen fertigen Scan ohne Geräte.',
    'Questa cartella contiene una scansione finita, senza dispositivi.',
  ],
  'scan.rescan': ['Scan this station again', 'Diese Station neu aufnehmen', 'Riprendi questa stazione'],
  'scan.build': ['Build the surface', 'Fläche berechnen', 'Calcola la superficie'],
  'scan.setup': ['Setup {number}', 'Aufspannung {number}', 'Piazzamento {number}'],
  'scan.setups': ['Setups', 'Aufspannungen', 'Piazzamenti'],
  'scan.otherSide': ['The other side', 'Die andere Seite', "L'altro lato"],
  'scan.otherSideHint': [
    'The face that the part stands on is not measured yet. Turn the part over and scan it again: the setups are joined by their shape.',
    'Die Fläche, auf der das Teil steht, fehlt noch. Teil umdrehen und noch einmal scannen: Die Aufspannungen werden über ihre Form verbunden.',
    'La faccia su cui poggia il pezzo non è ancora misurata. Girare il pezzo e scandirlo di nuovo: i piazzamenti si uniscono secondo la forma.',
  ],
  'scan.turnOver': ['Turn the part over', 'Teil umdrehen', 'Gira il pezzo'],
  'scan.turnOverPicture': [
    'A part that stands on the turntable is turned over, so that its underside is seen',
    'Ein Teil auf dem Drehtisch wird umgedreht, sodass man seine Unterseite sieht',
    'Un pezzo che sta sulla tavola viene girato, così che si veda il suo lato inferiore',
  ],
  'scan.turnOver1': [
    'Take the part off and put it back upside down or on its side, anywhere near the middle.',
    'Das Teil abnehmen und kopfüber oder auf die Seite gelegt zurückstellen, irgendwo nahe der Mitte.',
    "Togliere il pezzo e rimetterlo capovolto o sul fianco, all'incirca al centro.",
  ],
  'scan.turnOver2': [
    'Leave a third of the surface in view of both setups; a part that looks alike from all sides needs a mark of its shape.',
    'Ein Drittel der Oberfläche soll in beiden Aufspannungen zu sehen sein; ein Teil, das von allen Seiten gleich aussieht, braucht ein Merkmal.',
    'Un terzo della superficie resti visibile in entrambi i piazzamenti; un pezzo uguale da ogni lato ha bisogno di un segno nella forma.',
  ],
  'scan.turnOver3': [
    'Leave the turntable and the camera as they are.',
    'Drehtisch und Kamera bleiben, wie sie sind.',
    'Lasciare la tavola e la camera come sono.',
  ],
  'scan.turnOverSimulated': [
    'The simulated part turns over by itself.',
    'Das simulierte Teil dreht sich von selbst um.',
    'Il pezzo simulato si gira da solo.',
  ],
  'scan.startSetup': ['Scan setup {number}', 'Aufspannung {number} scannen', 'Scandisci il piazzamento {number}'],
  'scan.notYet': ['Not now', 'Jetzt nicht', 'Non ora'],
  'scan.turnedSince': [
    'The part was turned over since',
    'Das Teil wurde seither umgedreht',
    'Il pezzo è stato girato da allora',
  ],
} as const satisfies Rows;
