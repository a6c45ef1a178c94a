import type { Rows } from './rows';

/** Failures and warnings of CAD files. `tools/check_faults.py` explains them. */
export const FAULTS_CAD = {
  'fault.faceCadModel': [
    'face {0} of the CAD model cannot be evaluated; export it again',
    'Fläche {0} des CAD-Modells lässt sich nicht auswerten; neu exportieren',
    'la faccia {0} del modello CAD non si può valutare; esportarlo di nuovo',
  ],
  'fault.shapeExportAgain': [
    'it has no shape; export it again',
    'es hat keine Form; neu exportieren',
    'non ha forma; esportarlo di nuovo',
  ],
  'fault.shapeValidExport': [
    'its shape is not valid; export it again',
    'seine Form ist ungültig; neu exportieren',
    'la sua forma non è valida; esportarlo di nuovo',
  ],
  'fault.takesMoreS': [
    'it takes more than {0} s of processor time to read; export it again, or raise `allow_time_s`',
    'das Lesen dauert länger als {0} s Rechenzeit; neu exportieren oder mehr Zeit zulassen',
    'la lettura richiede più di {0} s di calcolo; esportarlo di nuovo o concedere più tempo',
  ],
  'fault.needsMoreRead': [
    'it needs more than {0} to read; export it again, or raise `allow_memory`',
    'das Lesen braucht mehr als {0}; neu exportieren oder mehr Speicher zulassen',
    'la lettura richiede più di {0}; esportarlo di nuovo o concedere più memoria',
  ],
  'fault.damagedNeedsMore': [
    'it is damaged, or needs more than {0} to read; export it again, or raise `allow_memory`',
    'es ist beschädigt oder braucht zum Lesen mehr als {0}; neu exportieren oder mehr Speicher zulassen',
    'è danneggiato o per leggerlo serve più di {0}; esportarlo di nuovo o concedere più memoria',
  ],
  'fault.secondProcessCan': [
    'no second process can read the CAD file: no pipe is left',
    'kein zweiter Prozess kann die CAD-Datei lesen: es ist keine Pipe mehr frei',
    'nessun secondo processo può leggere il file CAD: non restano pipe',
  ],
  'fault.secondProcessCanStarted': [
    'no second process can be started to read the CAD file',
    'zum Lesen der CAD-Datei lässt sich kein zweiter Prozess starten',
    'non si può avviare un secondo processo per leggere il file CAD',
  ],
  'fault.shapeDamagedExport': [
    'its shape is damaged: {0}; export it again',
    'seine Form ist beschädigt: {0}; neu exportieren',
    'la sua forma è danneggiata: {0}; esportarlo di nuovo',
  ],
  'fault.edgeDoesEnd': [
    'its edge {0} does not end at two finite parameters',
    'seine Kante {0} endet nicht an zwei endlichen Parametern',
    'il suo spigolo {0} non termina a due parametri finiti',
  ],
  'fault.curveEdgeCoordinate': [
    'the curve of its edge {0} has a coordinate that is no number',
    'die Kurve seiner Kante {0} hat eine Koordinate, die keine Zahl ist',
    'la curva del suo spigolo {0} ha una coordinata che non è un numero',
  ],
  'fault.faceSurface': [
    'its face {0} has no surface',
    'seine Fläche {0} hat keine Oberfläche',
    'la sua faccia {0} non ha superficie',
  ],
  'fault.surfaceFaceCoordinate': [
    'the surface of its face {0} has a coordinate that is no number',
    'die Oberfläche seiner Fläche {0} hat eine Koordinate, die keine Zahl ist',
    'la superficie della sua faccia {0} ha una coordinata che non è un numero',
  ],
  'fault.edgeFaceCoordinate': [
    'an edge of its face {0} has a coordinate that is no number',
    'eine Kante seiner Fläche {0} hat eine Koordinate, die keine Zahl ist',
    'uno spigolo della sua faccia {0} ha una coordinata che non è un numero',
  ],
  'fault.vertexCoordinateNumber': [
    'its vertex {0} has a coordinate that is no number',
    'seine Ecke {0} hat eine Koordinate, die keine Zahl ist',
    'il suo vertice {0} ha una coordinata che non è un numero',
  ],
  'fault.faceStatesAccuracy': [
    'its face {0} states no accuracy of its triangles',
    'seine Fläche {0} gibt keine Genauigkeit ihrer Dreiecke an',
    'la sua faccia {0} non indica la precisione dei triangoli',
  ],
  'fault.pointFaceNumber': [
    'point {0} of its face {1} is no number',
    'Punkt {0} seiner Fläche {1} ist keine Zahl',
    'il punto {0} della sua faccia {1} non è un numero',
  ],
  'fault.triangleFaceNames': [
    'a triangle of its face {0} names point {1} of {2}',
    'ein Dreieck seiner Fläche {0} nennt Punkt {1} von {2}',
    'un triangolo della sua faccia {0} nomina il punto {1} di {2}',
  ],
  'fault.edgeFaceNames': [
    'an edge of its face {0} names point {1} of {2}',
    'eine Kante seiner Fläche {0} nennt Punkt {1} von {2}',
    'uno spigolo della sua faccia {0} nomina il punto {1} di {2}',
  ],
  'fault.validStepFile': [
    'it is no valid STEP file; export it again',
    'es ist keine gültige STEP-Datei; neu exportieren',
    'non è un file STEP valido; esportarlo di nuovo',
  ],
  'fault.validIgesFile': [
    'it is no valid IGES file; export it again',
    'es ist keine gültige IGES-Datei; neu exportieren',
    'non è un file IGES valido; esportarlo di nuovo',
  ],
  'fault.facesPartMeasured': [
    'it has no faces, which a part is measured against; export its surfaces',
    'es hat keine Flächen, an denen ein Teil gemessen wird; seine Flächen exportieren',
    'non ha facce con cui confrontare un pezzo; esportarne le superfici',
  ],
  'fault.moreFacesName': [
    'it has more than {0} faces; name one part of it',
    'es hat mehr als {0} Flächen; ein einzelnes Teil daraus angeben',
    'ha più di {0} facce; indicarne un solo pezzo',
  ],
  'fault.sizeNonePart': [
    'its size is none of a part: less than 0.1 um or more than 1 km; check its unit',
    'seine Größe ist die keines Teils: weniger als 0,1 µm oder mehr als 1 km; die Einheit prüfen',
    "la sua grandezza non è quella di un pezzo: meno di 0,1 µm o più di 1 km; controllare l'unità",
  ],
  'fault.statesUnitLength': [
    'it states no unit of length; state it with `units`',
    'es gibt keine Längeneinheit an; sie angeben',
    "non indica un'unità di lunghezza; indicarla",
  ],
  'fault.statesUnitLeave': [
    'it states its unit, the {0}; leave out `units`',
    'es gibt seine Einheit selbst an, {0}; keine angeben',
    'indica già la sua unità, {0}; non indicarne una',
  ],
  'fault.partsCannotTranslated': [
    '{0} of its {1} parts cannot be translated and are left out',
    '{0} seiner {1} Teile lassen sich nicht übersetzen und fehlen',
    '{0} delle sue {1} parti non si possono tradurre e mancano',
  ],
  'fault.itIsNo': ['it is no file', 'es ist keine Datei', 'non è un file'],
  'fault.suchFile': ['there is no such file', 'die Datei gibt es nicht', 'il file non esiste'],
  'fault.cannotRead': ['{0}: it cannot be read', '{0}: kann nicht gelesen werden', '{0}: non si può leggere'],
  'fault.stepFileDoes': [
    'it is no STEP file: it does not begin with ISO-10303-21; export it again',
    'es ist keine STEP-Datei: sie beginnt nicht mit ISO-10303-21; neu exportieren',
    'non è un file STEP: non comincia con ISO-10303-21; esportarlo di nuovo',
  ],
  'fault.cutShortDoes': [
    'it is cut short: it does not end with END-ISO-10303-21; copy or export it again',
    'sie ist abgeschnitten: sie endet nicht mit END-ISO-10303-21; neu kopieren oder exportieren',
    'è troncato: non finisce con END-ISO-10303-21; copiarlo o esportarlo di nuovo',
  ],
  'fault.igesFileFirst': [
    'it is no IGES file: its first line has no S in column 73; export it again',
    'es ist keine IGES-Datei: ihre erste Zeile hat kein S in Spalte 73; neu exportieren',
    'non è un file IGES: la prima riga non ha S nella colonna 73; esportarlo di nuovo',
  ],
  'fault.cutShortLast': [
    'it is cut short: its last line has no T in column 73; copy or export it again',
    'sie ist abgeschnitten: ihre letzte Zeile hat kein T in Spalte 73; neu kopieren oder exportieren',
    "è troncato: l'ultima riga non ha T nella colonna 73; copiarlo o esportarlo di nuovo",
  ],
  'fault.cadFileEnds': [
    'a CAD file ends in .step, .stp, .igs or .iges',
    'eine CAD-Datei endet auf .step, .stp, .igs oder .iges',
    'un file CAD finisce in .step, .stp, .igs o .iges',
  ],
  'fault.emptyCopyExport': [
    'it is empty; copy or export it again',
    'sie ist leer; neu kopieren oder exportieren',
    'è vuoto; copiarlo o esportarlo di nuovo',
  ],
  'fault.noneFacesArea': [
    'none of its faces has an area; export it again',
    'keine ihrer Flächen hat einen Flächeninhalt; neu exportieren',
    "nessuna delle sue facce ha un'area; esportarlo di nuovo",
  ],
  'fault.programBuiltWithout': [
    'this program was built without OpenCASCADE, which reads CAD files; give a mesh, or build it with libocct-data-exchange-dev',
    'dieses Programm wurde ohne OpenCASCADE gebaut, das CAD-Dateien liest; ein Netz angeben',
    'questo programma è senza OpenCASCADE, che legge i file CAD; indicare una mesh',
  ],
} as const satisfies Rows;
