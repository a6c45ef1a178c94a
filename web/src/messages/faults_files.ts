import type { Rows } from './rows';

/** Failures and warnings of meshes and points in files. `tools/check_faults.py` explains them. */
export const FAULTS_FILES = {
  'fault.countedFiniteRemove': [
    '{0} {1} (counted from 0) is {2} {3} {4}, which is not finite; remove it',
    '{0} {1} (ab 0 gezählt) ist {2} {3} {4}, nicht endlich; entfernen',
    '{0} {1} (contando da 0) è {2} {3} {4}, non finito; rimuoverlo',
  ],
  'fault.vertexFar': [
    'vertex {0} (counted from 0) is {1} {2} {3}, farther away than any part can be; remove it',
    'Punkt {0} (von 0 an gezählt) liegt bei {1} {2} {3}, weiter weg, als ein Teil sein kann; entfernen Sie ihn',
    'il vertice {0} (contato da 0) è in {1} {2} {3}, più lontano di quanto un pezzo possa essere; rimuovetelo',
  ],
  'fault.verticesGiveOne': [
    '{0} {1} for {2} vertices; give one per vertex, or none',
    '{0} {1} für {2} Ecken; eines je Ecke oder keines angeben',
    '{0} {1} per {2} vertici; darne uno per vertice o nessuno',
  ],
  'fault.valuesSigmaMm': ['values of sigma_mm', 'Werte von sigma_mm', 'valori di sigma_mm'],
  'fault.valuesSigmaNoise': ['values of sigma_noise_mm', 'Werte von sigma_noise_mm', 'valori di sigma_noise_mm'],
  'fault.valuesSigmaSystematic': [
    'values of sigma_systematic_mm',
    'Werte von sigma_systematic_mm',
    'valori di sigma_systematic_mm',
  ],
  'fault.countsViews': ['counts of views', 'Zahlen der Ansichten', 'numeri di viste'],
  'fault.marksTrianglesGive': [
    '{0} marks for {1} triangles; give one per triangle, or none',
    '{0} Markierungen für {1} Dreiecke; eine je Dreieck oder keine angeben',
    '{0} contrassegni per {1} triangoli; darne uno per triangolo o nessuno',
  ],
  'fault.triangleRefersVertex': [
    'triangle {0} refers to vertex {1}, counted from 0, of only {2}; export the mesh again',
    'Dreieck {0} nennt Ecke {1}, ab 0 gezählt, von nur {2}; das Netz neu exportieren',
    'il triangolo {0} indica il vertice {1}, contando da 0, di soli {2}; esportare di nuovo la mesh',
  ],
  'fault.triangleWriteWrite': [
    'there is no triangle to write; write points as .ply, .obj, .xyz or .pcd',
    'es gibt kein Dreieck zu schreiben; Punkte als .ply, .obj, .xyz oder .pcd schreiben',
    'non ci sono triangoli da scrivere; scrivere i punti come .ply, .obj, .xyz o .pcd',
  ],
  'fault.verticesJoinedWhere': [
    '{0}: {1}; {2} vertices were joined to {3} where edges meet',
    '{0}: {1}; {2} Ecken wurden an den Kanten zu {3} vereinigt',
    '{0}: {1}; {2} vertici sono stati uniti in {3} dove gli spigoli si incontrano',
  ],
  'fault.facesVerticesOwn': [
    'its faces have vertices of their own',
    'seine Flächen haben eigene Ecken',
    'le sue facce hanno vertici propri',
  ],
  'fault.verticesStandTwice': [
    'its vertices stand twice where faces meet, as at seams of normals or textures',
    'seine Ecken stehen doppelt, wo Flächen sich treffen, wie an Nähten von Normalen oder Texturen',
    'i suoi vertici sono doppi dove le facce si incontrano, come alle giunture di normali o texture',
  ],
  'fault.numberTypePly': [
    '{0} is not a number type of PLY',
    '{0} ist kein Zahlentyp von PLY',
    '{0} non è un tipo di numero di PLY',
  ],
  'fault.formatAsciiBinary': [
    'the format is {0}; it must be ascii, binary_little_endian or binary_big_endian',
    'das Format ist {0}; möglich sind ascii, binary_little_endian oder binary_big_endian',
    'il formato è {0}; deve essere ascii, binary_little_endian o binary_big_endian',
  ],
  'fault.validCount': [
    '{0} is not a valid count of {1}',
    '{0} ist keine gültige Anzahl von {1}',
    '{0} non è un numero valido di {1}',
  ],
  'fault.plyFileDoes': [
    'not a PLY file: it does not begin with the word ply',
    'keine PLY-Datei: sie beginnt nicht mit dem Wort ply',
    'non è un file PLY: non comincia con la parola ply',
  ],
  'fault.keywordPlyHeader': [
    '{0} is not a keyword of a PLY header',
    '{0} ist kein Schlüsselwort eines PLY-Kopfs',
    "{0} non è una parola chiave di un'intestazione PLY",
  ],
  'fault.headerStatesFormat': [
    'the header states no format',
    'der Kopf gibt kein Format an',
    "l'intestazione non indica un formato",
  ],
  'fault.fileTruncated': ['the file is truncated', 'die Datei ist abgeschnitten', 'il file è troncato'],
  'fault.listStatesValues': [
    "a list '{0}' states {1} values",
    'eine Liste „{0}“ gibt {1} Werte an',
    'un elenco «{0}» indica {1} valori',
  ],
  'fault.leftOutTriangle': [
    '{0}: left out {1} triangle{2} with two corners at one place',
    '{0}: {1} Dreiecke mit zwei Ecken an einer Stelle weggelassen',
    '{0}: esclusi {1} triangoli con due vertici nello stesso punto',
  ],
  'fault.facesMoreThree': [
    '{0}: {1} of its faces with more than three corners {2} not plane, by up to {3} mm; their triangles are those of the projection onto the mean plane',
    '{0}: {1} seiner Flächen mit mehr als drei Ecken sind uneben, um bis zu {3} mm; ihre Dreiecke sind die der Projektion auf die mittlere Ebene',
    '{0}: {1} delle sue facce con più di tre vertici non sono piane, fino a {3} mm; i loro triangoli sono quelli della proiezione sul piano medio',
  ],
  'fault.outlineFaceCrosses': [
    '{0}: the outline of {1} face{2} crosses itself; export triangles instead',
    '{0}: der Umriss von {1} Flächen schneidet sich selbst; Dreiecke exportieren',
    '{0}: il contorno di {1} facce interseca sé stesso; esportare triangoli',
  ],
  'fault.faceCornersMore': [
    '{0}: a face has {1} corners, more than {2}; export triangles instead',
    '{0}: eine Fläche hat {1} Ecken, mehr als {2}; Dreiecke exportieren',
    '{0}: una faccia ha {1} vertici, più di {2}; esportare triangoli',
  ],
  'fault.rangeGridRefers': [
    'its range_grid refers to point {0}, which is not a valid index',
    'sein range_grid nennt Punkt {0}, keine gültige Nummer',
    'il suo range_grid indica il punto {0}, che non è un indice valido',
  ],
  'fault.rangeGridCells': [
    '{0}: its range_grid has {1} cells, but obj_info states {2} columns and {3} rows; export it again',
    '{0}: sein range_grid hat {1} Zellen, aber obj_info gibt {2} Spalten und {3} Zeilen an; neu exportieren',
    '{0}: il suo range_grid ha {1} celle, ma obj_info indica {2} colonne e {3} righe; esportarlo di nuovo',
  ],
  'fault.rangeGridRefersPoint': [
    '{0}: its range_grid refers to point {1}, which does not exist; export it again',
    '{0}: sein range_grid nennt Punkt {1}, den es nicht gibt; neu exportieren',
    '{0}: il suo range_grid indica il punto {1}, che non esiste; esportarlo di nuovo',
  ],
  'fault.pointsXY': [
    'its points have no x, y or z',
    'seine Punkte haben kein x, y oder z',
    'i suoi punti non hanno x, y o z',
  ],
  'fault.viewpointPoseSensor': [
    '{0}: its VIEWPOINT, the pose of the sensor ({1}), is not applied: the points stay in the frame in which they are written',
    '{0}: sein VIEWPOINT, die Lage des Sensors ({1}), wird nicht angewandt: die Punkte bleiben im Koordinatensystem der Datei',
    '{0}: il suo VIEWPOINT, la posa del sensore ({1}), non viene applicato: i punti restano nel sistema del file',
  ],
  'fault.keywordPcdHeader': [
    '{0} is not a keyword of a PCD header',
    '{0} ist kein Schlüsselwort eines PCD-Kopfs',
    "{0} non è una parola chiave di un'intestazione PCD",
  ],
  'fault.isNotACount': ['{0} is not a count', '{0} ist keine Anzahl', '{0} non è un conteggio'],
  'fault.fieldTypeF': [
    '{0} is not a field type; it must be F, I or U',
    '{0} ist kein Feldtyp; möglich sind F, I oder U',
    '{0} non è un tipo di campo; deve essere F, I o U',
  ],
  'fault.pcdCompressedSave': [
    'this PCD is compressed; save it as binary (pcl_convert_pcd_ascii_binary)',
    'dieses PCD ist komprimiert; als binary speichern (pcl_convert_pcd_ascii_binary)',
    'questo PCD è compresso; salvarlo come binary (pcl_convert_pcd_ascii_binary)',
  ],
  'fault.dataAsciiBinary': [
    'the data is {0}; it must be ascii or binary',
    'die Daten sind {0}; möglich sind ascii oder binary',
    'i dati sono {0}; devono essere ascii o binary',
  ],
  'fault.fieldXBytes': [
    'a field of {0} x {1} bytes of type {2} is not valid PCD',
    'ein Feld von {0} × {1} Bytes der Art {2} ist kein gültiges PCD',
    'un campo di {0} × {1} byte di tipo {2} non è PCD valido',
  ],
  'fault.headerStatesPoints': [
    'the header states {0} points, but the file can hold at most {1}; it is truncated or its header is wrong',
    'der Kopf gibt {0} Punkte an, aber die Datei fasst höchstens {1}; sie ist abgeschnitten, oder ihr Kopf ist falsch',
    "l'intestazione indica {0} punti, ma il file può contenerne al massimo {1}; è troncato o l'intestazione è errata",
  ],
  'fault.omittedPointWithout': [
    '{0}: omitted {1} point{2} without finite coordinates',
    '{0}: {1} Punkte ohne endliche Koordinaten weggelassen',
    '{0}: esclusi {1} punti senza coordinate finite',
  ],
  'fault.verticesXY': [
    'its vertices have no x, y or z',
    'seine Ecken haben kein x, y oder z',
    'i suoi vertici non hanno x, y o z',
  ],
  'fault.faceRefersVertex': [
    'a face refers to vertex {0}, which is not a valid index',
    'eine Fläche nennt Ecke {0}, keine gültige Nummer',
    'una faccia indica il vertice {0}, che non è un indice valido',
  ],
  'fault.facesListNamed': [
    'its faces have no list named vertex_indices or vertex_index; export it again',
    'seine Flächen haben keine Liste vertex_indices oder vertex_index; neu exportieren',
    'le sue facce non hanno un elenco vertex_indices o vertex_index; esportarlo di nuovo',
  ],
  'fault.headerStatesButFile': [
    "the header states {0} of '{1}', but the file can hold at most {2}; it is truncated or its header is wrong",
    'der Kopf gibt {0} von „{1}“ an, aber die Datei fasst höchstens {2}; sie ist abgeschnitten, oder ihr Kopf ist falsch',
    "l'intestazione indica {0} di «{1}», ma il file può contenerne al massimo {2}; è troncato o l'intestazione è errata",
  ],
  'fault.triangleStripsSupported': [
    'triangle strips are not supported; export it with faces',
    'Dreiecksstreifen werden nicht gelesen; mit Flächen exportieren',
    'le strisce di triangoli non vengono lette; esportarlo con facce',
  ],
  'fault.elementVertex': ["it has no element 'vertex'", 'es hat kein Element „vertex“', "non ha l'elemento «vertex»"],
  'fault.byteLeftOutBehind': [
    '{0}: {1} byte{2} left out behind what its header counts; the header may be wrong',
    '{0}: {1} Bytes hinter dem, was der Kopf zählt, weggelassen; der Kopf ist vielleicht falsch',
    "{0}: esclusi {1} byte oltre quanto conta l'intestazione; l'intestazione può essere errata",
  ],
  'fault.liesMOrigin': [
    '{0}: it lies {1} m from the origin, so that coordinates are rounded to {2} mm; move it to the origin before it is saved',
    '{0}: es liegt {1} m vom Ursprung, so dass Koordinaten auf {2} mm gerundet werden; vor dem Speichern zum Ursprung verschieben',
    "{0}: dista {1} m dall'origine, così che le coordinate sono arrotondate a {2} mm; spostarlo all'origine prima di salvarlo",
  ],
  'fault.unknownMeshFormat': [
    '{0}: unknown mesh format; use a file that ends in {1}',
    '{0}: unbekanntes Netzformat; eine Datei mit der Endung {1} benutzen',
    '{0}: formato di mesh sconosciuto; usare un file che finisce in {1}',
  ],
  'fault.pointTrianglesName': [
    '{0}: it has {1} point{2} and no triangles; name a mesh with a surface',
    '{0}: sie hat {1} Punkte und keine Dreiecke; ein Netz mit Oberfläche angeben',
    '{0}: ha {1} punti e nessun triangolo; indicare una mesh con superficie',
  ],
  'fault.unknownMeshFormatUse': [
    '{0}: unknown mesh format; use a name that ends in {1}',
    '{0}: unbekanntes Netzformat; einen Namen mit der Endung {1} benutzen',
    '{0}: formato di mesh sconosciuto; usare un nome che finisce in {1}',
  ],
} as const satisfies Rows;
