import type { Rows } from './rows';

/** Failures and warnings of DXF, OBJ, OFF, STL and XYZ files. `tools/check_faults.py` explains them. */
export const FAULTS_FILES_TEXT = {
  'fault.blockContainsItself': [
    '{0}: a block contains itself, or blocks are nested more than {1} deep; export it again',
    '{0}: ein Block enthält sich selbst, oder Blöcke sind mehr als {1}-fach geschachtelt; neu exportieren',
    '{0}: un blocco contiene sé stesso, o i blocchi sono annidati oltre {1} livelli; esportarlo di nuovo',
  ],
  'fault.vertexLiesMore': [
    "{0}: a vertex lies more than 1 000 km away; check the mesh's units",
    '{0}: eine Ecke liegt mehr als 1 000 km entfernt; die Einheit des Netzes prüfen',
    "{0}: un vertice dista più di 1 000 km; controllare l'unità della mesh",
  ],
  'fault.triangleLargerMm': [
    "{0}: no triangle is larger than 0.0001 mm, the resolution of the DXF; check the mesh's units",
    '{0}: kein Dreieck ist größer als 0,0001 mm, die Auflösung der DXF-Datei; die Einheit des Netzes prüfen',
    "{0}: nessun triangolo supera 0,0001 mm, la risoluzione del DXF; controllare l'unità della mesh",
  ],
  'fault.blockAboveName': [
    'the block above has no name',
    'der Block davor hat keinen Namen',
    'il blocco precedente non ha nome',
  ],
  'fault.insertAboveNumber': [
    'the INSERT above has a number of rows or columns that is not valid',
    'das INSERT davor hat eine ungültige Zahl von Zeilen oder Spalten',
    "l'INSERT precedente ha un numero non valido di righe o colonne",
  ],
  'fault.layersOffFrozen': [
    'layers that are off or frozen',
    'Layer, die ausgeschaltet oder gefroren sind',
    'layer disattivati o congelati',
  ],
  'fault.meshInvisible': [
    '{0}{1} mesh{2} that {3} invisible',
    '{0}{1} Netze, die unsichtbar sind',
    '{0}{1} mesh invisibili',
  ],
  'fault.expectedCodeGroup': [
    'expected the code of a group, found {0}',
    'erwartet war der Code einer Gruppe, gefunden wurde {0}',
    'atteso il codice di un gruppo, trovato {0}',
  ],
  'fault.lastGroupValue': [
    'the last group has no value; the file is truncated',
    'die letzte Gruppe hat keinen Wert; die Datei ist abgeschnitten',
    "l'ultimo gruppo non ha valore; il file è troncato",
  ],
  'fault.isNotANumber': ['{0} is not a number', '{0} ist keine Zahl', '{0} non è un numero'],
  'fault.wholeNumber2': ['{0} is not a whole number', '{0} ist keine ganze Zahl', '{0} non è un numero intero'],
  'fault.coordinateAboveFinite': [
    'a coordinate above is not finite; remove it',
    'eine Koordinate davor ist nicht endlich; entfernen',
    'una coordinata precedente non è finita; rimuoverla',
  ],
  'fault.faceAboveMore': [
    'the face above has more than {0} corners',
    'die Fläche davor hat mehr als {0} Ecken',
    'la faccia precedente ha più di {0} vertici',
  ],
  'fault.polyfaceAboveRefers': [
    'the polyface above refers to vertex {0} of only {1}',
    'die Polyface davor nennt Ecke {0} von nur {1}',
    'la polyface precedente indica il vertice {0} di soli {1}',
  ],
  'fault.meshAboveStates': [
    'the mesh above states {0} x {1} vertices but has {2}',
    'das Netz davor gibt {0} × {1} Ecken an, hat aber {2}',
    'la mesh precedente indica {0} × {1} vertici ma ne ha {2}',
  ],
  'fault.faceMeshAbove': [
    'a face of the MESH above cannot have {0} corners',
    'eine Fläche des MESH davor kann nicht {0} Ecken haben',
    'una faccia del MESH precedente non può avere {0} vertici',
  ],
  'fault.meshAboveRefers': [
    'the MESH above refers to vertex {0}, counted from 0, of only {1}',
    'das MESH davor nennt Ecke {0}, ab 0 gezählt, von nur {1}',
    'il MESH precedente indica il vertice {0}, contando da 0, di soli {1}',
  ],
  'fault.insunitsUnitKnown': [
    '{0}: its $INSUNITS {1} is no unit that is known; mm are assumed',
    '{0}: sein $INSUNITS {1} ist keine bekannte Einheit; mm werden angenommen',
    "{0}: il suo $INSUNITS {1} non è un'unità nota; si assumono mm",
  ],
  'fault.imperialDrawingMeasurement': [
    '{0}: it is an imperial drawing ($MEASUREMENT 0) without a unit ($INSUNITS); mm are assumed',
    '{0}: es ist eine Zeichnung in Zoll ($MEASUREMENT 0) ohne Einheit ($INSUNITS); mm werden angenommen',
    '{0}: è un disegno in pollici ($MEASUREMENT 0) senza unità ($INSUNITS); si assumono mm',
  ],
  'fault.meshSubdividedProgram': [
    '{0}: {1} MESH {2} subdivided by the program that shows it; the cage is read, without the subdivision',
    '{0}: {1} MESH werden vom zeigenden Programm unterteilt; gelesen wird der Käfig ohne Unterteilung',
    '{0}: {1} MESH sono suddivise dal programma che le mostra; si legge la gabbia, senza suddivisione',
  ],
  'fault.autocadBinaryDxf': ['AutoCAD Binary DXF', 'AutoCAD-Binär-DXF', 'DXF binario di AutoCAD'],
  'fault.binaryDxfSave': [
    '{0}: this is a binary DXF; save it as text (ASCII) DXF',
    '{0}: dies ist ein binäres DXF; als Text (ASCII) speichern',
    '{0}: è un DXF binario; salvarlo come testo (ASCII)',
  ],
  'fault.dfacePolyfaceMesh': [
    '{0}: it has no 3DFACE, polyface or MESH with an area{1}{2}; save surfaces as meshes',
    '{0}: es hat kein 3DFACE, Polyface oder MESH mit Fläche{1}{2}; Flächen als Netze speichern',
    "{0}: non ha 3DFACE, polyface o MESH con un'area{1}{2}; salvare le superfici come mesh",
  ],
  'fault.fileTruncatedWithin': [
    '{0}: the file is truncated within a section, after {1} triangle{2}',
    '{0}: die Datei ist in einem Abschnitt abgeschnitten, nach {1} Dreiecken',
    '{0}: il file è troncato in una sezione, dopo {1} triangoli',
  ],
  'fault.leftOutInsert': [
    '{0}: left out {1} INSERT of blocks that the file does not hold',
    '{0}: {1} INSERT von Blöcken weggelassen, die die Datei nicht enthält',
    '{0}: esclusi {1} INSERT di blocchi che il file non contiene',
  ],
  'fault.leftOutInsertExternal': [
    '{0}: left out {1} INSERT of the external drawing {2}; bind it and save again',
    '{0}: {1} INSERT der externen Zeichnung {2} weggelassen; sie binden und neu speichern',
    '{0}: esclusi {1} INSERT del disegno esterno {2}; unirlo e salvare di nuovo',
  ],
  'fault.skippedMeshes': [
    '{0}: skipped {1}, which are not meshes',
    '{0}: {1} ausgelassen, was keine Netze sind',
    '{0}: saltati {1}, che non sono mesh',
  ],
  'fault.indexVertexNormal': [
    '{0} is not the index of a vertex or normal',
    '{0} ist nicht die Nummer einer Ecke oder Normalen',
    "{0} non è l'indice di un vertice o di una normale",
  ],
  'fault.skippedFreeForm': [
    '{0}: skipped {1} free-form curves and surfaces, which are not meshes',
    '{0}: {1} Freiformkurven und -flächen ausgelassen, die keine Netze sind',
    '{0}: saltate {1} curve e superfici a forma libera, che non sono mesh',
  ],
  'fault.skippedLineStatement': [
    '{0}: skipped {1} line{2} that {3} no statement of OBJ, the first with {4}',
    '{0}: {1} Zeilen ausgelassen, die keine OBJ-Anweisung sind, die erste mit {4}',
    '{0}: saltate {1} righe che non sono istruzioni OBJ, la prima con {4}',
  ],
  'fault.isNotACoordinate': ['{0} is not a coordinate', '{0} ist keine Koordinate', '{0} non è una coordinata'],
  'fault.faceCornerNeeds': [
    'a face has {0} corner{1}; it needs three',
    'eine Fläche hat {0} Ecken; sie braucht drei',
    'una faccia ha {0} vertici; ne servono tre',
  ],
  'fault.vertexEmptyObj': [
    '{0}: it has no vertex; it is empty or not an OBJ file',
    '{0}: sie hat keine Ecke; sie ist leer oder keine OBJ-Datei',
    '{0}: non ha vertici; è vuoto o non è un file OBJ',
  ],
  'fault.expectedOffFound': [
    "expected 'OFF', found {0}",
    'erwartet war „OFF“, gefunden wurde {0}',
    'atteso «OFF», trovato {0}',
  ],
  'fault.binaryOffSave': [
    'this is a binary OFF; save it as text (ASCII) OFF',
    'dies ist ein binäres OFF; als Text (ASCII) speichern',
    'è un OFF binario; salvarlo come testo (ASCII)',
  ],
  'fault.validNumber': [
    '{0} is not a valid number of {1}',
    '{0} ist keine gültige Zahl von {1}',
    '{0} non è un numero valido di {1}',
  ],
  'fault.headerStatesBut': [
    'the header states {0} {1}, but the file can hold at most {2}; it is truncated or its counts are wrong',
    'der Kopf gibt {0} {1} an, aber die Datei fasst höchstens {2}; sie ist abgeschnitten, oder ihre Zahlen sind falsch',
    "l'intestazione indica {0} {1}, ma il file può contenerne al massimo {2}; è troncato o i suoi numeri sono errati",
  ],
  'fault.numberCornersFace': [
    'the number of corners of a face is {0}; it must be at least 3',
    'eine Fläche hat {0} Ecken; es müssen mindestens 3 sein',
    'una faccia ha {0} vertici; devono essere almeno 3',
  ],
  'fault.vertexIndex': [
    '{0} is not a vertex index from 0 to {1}',
    '{0} ist keine Nummer einer Ecke von 0 bis {1}',
    '{0} non è un indice di vertice da 0 a {1}',
  ],
  'fault.expectedEndFound': [
    "expected 'end{0}', found {1}",
    'erwartet war „end{0}“, gefunden wurde {1}',
    'atteso «end{0}», trovato {1}',
  ],
  'fault.headerStatesNumber': [
    '{0}: its header states no number of facets; all {1} are read',
    '{0}: ihr Kopf gibt keine Zahl von Facetten an; alle {1} werden gelesen',
    '{0}: la sua intestazione non indica il numero di faccette; si leggono tutte le {1}',
  ],
  'fault.holdsSolids': ['{0}: it holds {1} solids', '{0}: sie enthält {1} Körper', '{0}: contiene {1} solidi'],
  'fault.headerStatesFacets': [
    '{0}: its header states {1} facets, but {2} more follow; export it again',
    '{0}: ihr Kopf gibt {1} Facetten an, aber {2} weitere folgen; neu exportieren',
    '{0}: la sua intestazione indica {1} faccette, ma ne seguono altre {2}; esportarlo di nuovo',
  ],
  'fault.byteLeftOut': [
    '{0}: {1} byte{2} left out behind its last facet',
    '{0}: {1} Bytes hinter der letzten Facette weggelassen',
    "{0}: esclusi {1} byte dopo l'ultima faccetta",
  ],
  'fault.bytesButHeader': [
    '{0}: it has {1} bytes, but its header states {2}; it is truncated or not an STL file',
    '{0}: sie hat {1} Bytes, aber ihr Kopf gibt {2} an; sie ist abgeschnitten oder keine STL-Datei',
    '{0}: ha {1} byte, ma la sua intestazione ne indica {2}; è troncato o non è un file STL',
  ],
  'fault.numbersDecimalCommas': [
    'its numbers have decimal commas; write points, 1.5',
    'ihre Zahlen haben Dezimalkommas; Punkte schreiben, 1.5',
    'i suoi numeri hanno la virgola decimale; scrivere il punto, 1.5',
  ],
  'fault.valueMissingBeside': [
    'a value is missing beside a comma or semicolon',
    'bei einem Komma oder Strichpunkt fehlt ein Wert',
    'manca un valore accanto a una virgola o a un punto e virgola',
  ],
  'fault.numberNamesColumns': [
    '{0} is not a number, and names of columns begin with x, y and z',
    '{0} ist keine Zahl, und Spaltennamen beginnen mit x, y und z',
    '{0} non è un numero, e i nomi delle colonne cominciano con x, y e z',
  ],
  'fault.numberPointNeeds': [
    'it has {0} number{1}; a point needs three',
    'es hat {0} Zahlen; ein Punkt braucht drei',
    'ha {0} numeri; un punto ne richiede tre',
  ],
  'fault.firstLineStates': [
    'its first line states {0} points, but it has {1}',
    'ihre erste Zeile gibt {0} Punkte an, sie hat aber {1}',
    'la prima riga indica {0} punti, ma ne ha {1}',
  ],
  'fault.whatBehindX': [
    '{0}: what is behind x, y and z is left out where it is neither normals nor colours of every point',
    '{0}: was hinter x, y und z steht, wird weggelassen, wo es weder Normalen noch Farben jedes Punkts sind',
    '{0}: ciò che segue x, y e z è escluso dove non sono normali o colori di ogni punto',
  ],
  'fault.fileMayTruncated': [
    '; the file may be truncated',
    '; die Datei ist vielleicht abgeschnitten',
    '; il file può essere troncato',
  ],
} as const satisfies Rows;
