import type { Rows } from './rows';

/** Failures and warnings of glTF, 3MF and zip files. `tools/check_faults.py` explains them. */
export const FAULTS_FILES_PACKAGES = {
  'fault.transformPartFinite': [
    'the transform of a part is not finite; export it again',
    'die Transformation eines Teils ist nicht endlich; neu exportieren',
    'la trasformazione di una parte non è finita; esportarlo di nuovo',
  ],
  'fault.gltfTruncatedExport': [
    'it is not glTF 2.0, or it is truncated; export it again',
    'es ist kein glTF 2.0, oder es ist abgeschnitten; neu exportieren',
    'non è glTF 2.0, o è troncato; esportarlo di nuovo',
  ],
  'fault.chunkBytesExceeds': [
    'a chunk of {0} bytes exceeds the {1} bytes that are left; the file is truncated',
    'ein Abschnitt von {0} Bytes ist länger als die restlichen {1} Bytes; die Datei ist abgeschnitten',
    'una sezione di {0} byte supera i {1} byte rimasti; il file è troncato',
  ],
  'fault.bufferFileSame': [
    'its buffer {0} is not a file in the same folder or below; export it as .glb',
    'der Puffer {0} ist keine Datei in diesem Ordner oder darunter; als .glb exportieren',
    'il buffer {0} non è un file in questa cartella o sotto; esportarlo come .glb',
  ],
  'fault.embeddedBufferBase': [
    'an embedded buffer is not base64; export it again',
    'ein eingebetteter Puffer ist nicht base64; neu exportieren',
    'un buffer incorporato non è base64; esportarlo di nuovo',
  ],
  'fault.compressedExportWithout': [
    'it is compressed ({0}); export it without compression',
    'es ist komprimiert ({0}); ohne Kompression exportieren',
    'è compresso ({0}); esportarlo senza compressione',
  ],
  'fault.bufferBytesHolds': [
    'a buffer of {0} bytes holds only {1}; the file is truncated',
    'ein Puffer von {0} Bytes enthält nur {1}; die Datei ist abgeschnitten',
    'un buffer di {0} byte ne contiene solo {1}; il file è troncato',
  ],
  'fault.requiresExtensionRead': [
    'it requires the extension {0}, which is not read; export it {1}',
    'es braucht die Erweiterung {0}, die nicht gelesen wird; neu exportieren, {1}',
    "richiede l'estensione {0}, che non viene letta; esportarlo {1}",
  ],
  'fault.refersElementDoes': [
    'it refers to element {0} of its {1}, which does not exist; export it again',
    'es nennt Element {0} von {1}, das es nicht gibt; neu exportieren',
    "indica l'elemento {0} di {1}, che non esiste; esportarlo di nuovo",
  ],
  'fault.validCountIndex': [
    '{0} is not a valid count or index; export it again',
    '{0} ist keine gültige Anzahl oder Nummer; neu exportieren',
    '{0} non è un numero o indice valido; esportarlo di nuovo',
  ],
  'fault.listExportAgain': [
    'its {0} are not a list; export it again',
    '{0} ist keine Liste; neu exportieren',
    '{0} non è un elenco; esportarlo di nuovo',
  ],
  'fault.jsonInvalidExport': [
    'its JSON is invalid; export it again',
    'das JSON ist ungültig; neu exportieren',
    'il JSON non è valido; esportarlo di nuovo',
  ],
  'fault.compressedDataSupported': [
    'compressed data is not supported; export it without compression',
    'komprimierte Daten werden nicht gelesen; ohne Kompression exportieren',
    'i dati compressi non vengono letti; esportarlo senza compressione',
  ],
  'fault.accessorWrongType': [
    'accessor {0} has the wrong type; export it again',
    'Accessor {0} hat den falschen Typ; neu exportieren',
    "l'accessor {0} è di tipo sbagliato; esportarlo di nuovo",
  ],
  'fault.refersBufferDoes': [
    'it refers to a buffer that does not exist; export it again',
    'es nennt einen Puffer, den es nicht gibt; neu exportieren',
    'indica un buffer che non esiste; esportarlo di nuovo',
  ],
  'fault.elementsExceedBuffer': [
    '{0} elements exceed their buffer; the file is truncated or its counts are wrong',
    '{0} Elemente sind mehr als ihr Puffer; die Datei ist abgeschnitten, oder ihre Zahlen sind falsch',
    '{0} elementi superano il loro buffer; il file è troncato o i suoi numeri sono errati',
  ],
  'fault.indicesSparseAccessor': [
    'the indices of a sparse accessor have the wrong type; export it again',
    'die Nummern eines dünnen Accessors haben den falschen Typ; neu exportieren',
    'gli indici di un accessor sparso sono di tipo sbagliato; esportarlo di nuovo',
  ],
  'fault.sparseAccessorRefers': [
    'a sparse accessor refers to element {0}, counted from 0, of only {1}; export it again',
    'ein dünner Accessor nennt Element {0}, ab 0 gezählt, von nur {1}; neu exportieren',
    "un accessor sparso indica l'elemento {0}, contando da 0, di soli {1}; esportarlo di nuovo",
  ],
  'fault.compressedGzipUnpack': [
    'it is compressed by gzip; unpack it with gunzip',
    'es ist mit gzip komprimiert; mit gunzip entpacken',
    'è compresso con gzip; estrarlo con gunzip',
  ],
  'fault.zipArchiveUnpack': [
    'it is a zip archive; unpack it, and name the file inside',
    'es ist ein Zip-Archiv; entpacken und die Datei darin angeben',
    'è un archivio zip; estrarlo e indicare il file al suo interno',
  ],
  'fault.compressedBzipUnpack': [
    'it is compressed by bzip2; unpack it with bunzip2',
    'es ist mit bzip2 komprimiert; mit bunzip2 entpacken',
    'è compresso con bzip2; estrarlo con bunzip2',
  ],
  'fault.compressedXzUnpack': [
    'it is compressed by xz; unpack it with unxz',
    'es ist mit xz komprimiert; mit unxz entpacken',
    'è compresso con xz; estrarlo con unxz',
  ],
  'fault.compressedZstdUnpack': [
    'it is compressed by zstd; unpack it with unzstd',
    'es ist mit zstd komprimiert; mit unzstd entpacken',
    'è compresso con zstd; estrarlo con unzstd',
  ],
  'fault.zArchiveUnpack': [
    'it is a 7z archive; unpack it, and name the file inside',
    'es ist ein 7z-Archiv; entpacken und die Datei darin angeben',
    'è un archivio 7z; estrarlo e indicare il file al suo interno',
  ],
  'fault.rarArchiveUnpack': [
    'it is a RAR archive; unpack it, and name the file inside',
    'es ist ein RAR-Archiv; entpacken und die Datei darin angeben',
    'è un archivio RAR; estrarlo e indicare il file al suo interno',
  ],
  'fault.dwgDrawingSave': [
    'it is a DWG drawing; save it as a text (ASCII) DXF',
    'es ist eine DWG-Zeichnung; als Text-DXF (ASCII) speichern',
    'è un disegno DWG; salvarlo come DXF di testo (ASCII)',
  ],
  'fault.stepFileName': [
    'it is a STEP file; name it .step, and use it as a reference',
    'es ist eine STEP-Datei; sie .step nennen und als Referenz benutzen',
    'è un file STEP; chiamarlo .step e usarlo come riferimento',
  ],
  'fault.pdfExportMesh': [
    'it is a PDF; export the mesh itself',
    'es ist ein PDF; das Netz selbst exportieren',
    'è un PDF; esportare la mesh stessa',
  ],
  'fault.mfPackageModel': [
    'not a 3MF package: it has no model {0}',
    'kein 3MF-Paket: es hat kein Modell {0}',
    'non è un pacchetto 3MF: non ha il modello {0}',
  ],
  'fault.objectsMoreFiles': [
    'its objects are in more than {0} files; export it again',
    'seine Objekte stehen in mehr als {0} Dateien; neu exportieren',
    'i suoi oggetti sono in più di {0} file; esportarlo di nuovo',
  ],
  'fault.leftOutObject': [
    '{0}: left out {1} object{2} that {3} no part: supports, or modifiers of a slicer',
    '{0}: {1} Objekte weggelassen, die kein Teil sind: Stützen oder Modifikatoren eines Slicers',
    '{0}: esclusi {1} oggetti che non sono parti: supporti o modificatori di uno slicer',
  ],
  'fault.leftOutBeam': [
    '{0}: left out {1} beam{2} or shape{3} of extensions, which are no triangles; export it as triangles',
    '{0}: {1} Balken oder Formen von Erweiterungen weggelassen, die keine Dreiecke sind; als Dreiecke exportieren',
    '{0}: escluse {1} travi o forme di estensioni, che non sono triangoli; esportarlo come triangoli',
  ],
  'fault.buildItemsTriangles': [
    '{0}: its build items have no triangles',
    '{0}: seine Bauobjekte haben keine Dreiecke',
    '{0}: i suoi oggetti da costruire non hanno triangoli',
  ],
  'fault.nodeWrongLength': [
    'the {0} of a node has the wrong length; export it again',
    'das Feld {0} eines Knotens hat die falsche Länge; neu exportieren',
    '{0} di un nodo ha la lunghezza sbagliata; esportarlo di nuovo',
  ],
  'fault.skippedPrimitivePoints': [
    '{0}: skipped {1} primitive{2} of points or lines',
    '{0}: {1} Elemente aus Punkten oder Linien ausgelassen',
    '{0}: saltate {1} primitive di punti o linee',
  ],
  'fault.meshReadRest': [
    '{0}: {1} mesh{2} read at rest, without the pose of a skeleton or shape key',
    '{0}: {1} Netze in Ruhe gelesen, ohne die Pose eines Skeletts oder Formschlüssels',
    '{0}: {1} mesh lette a riposo, senza la posa di uno scheletro o di una shape key',
  ],
  'fault.leftOutNode': [
    '{0}: left out {1} node{2} hidden',
    '{0}: {1} verborgene Knoten weggelassen',
    '{0}: esclusi {1} nodi nascosti',
  ],
  'fault.sceneTriangle': ['its scene has no triangle', 'seine Szene hat kein Dreieck', 'la sua scena non ha triangoli'],
  'fault.nodeTwoParents': [
    'a node has two parents, is its own descendant, or is nested too deeply; export it again',
    'ein Knoten hat zwei Eltern, ist sein eigener Nachfahre oder zu tief geschachtelt; neu exportieren',
    'un nodo ha due genitori, discende da sé stesso o è annidato troppo; esportarlo di nuovo',
  ],
  'fault.copiesValuesExport': [
    'its copies have {0} values of {1}; export it again',
    'seine Kopien haben {0} Werte von {1}; neu exportieren',
    'le sue copie hanno {0} valori di {1}; esportarlo di nuovo',
  ],
  'fault.primitiveUnknownMode': [
    'a primitive has the unknown mode {0}; export it again',
    'ein Element hat die unbekannte Art {0}; neu exportieren',
    'una primitiva ha il modo sconosciuto {0}; esportarlo di nuovo',
  ],
  'fault.compressedDracoExport': [
    'it is compressed (Draco); export it without compression',
    'es ist komprimiert (Draco); ohne Kompression exportieren',
    'è compresso (Draco); esportarlo senza compressione',
  ],
  'fault.valuesOnePer': [
    'its {0} values are not one per vertex; export it again',
    'seine Werte {0} sind nicht einer je Ecke; neu exportieren',
    'i suoi valori {0} non sono uno per vertice; esportarlo di nuovo',
  ],
  'fault.colorNeitherVec': [
    'its COLOR_0 is neither VEC3 nor VEC4; export it again',
    'sein COLOR_0 ist weder VEC3 noch VEC4; neu exportieren',
    'il suo COLOR_0 non è VEC3 né VEC4; esportarlo di nuovo',
  ],
  'fault.numberIndicesMultiple': [
    'the number of its indices is not a multiple of three; export it again',
    'die Zahl seiner Indizes ist kein Vielfaches von drei; neu exportieren',
    'il numero dei suoi indici non è multiplo di tre; esportarlo di nuovo',
  ],
  'fault.triangleRefersVertexCounted': [
    'a triangle refers to vertex {0}, counted from 0, of only {1}; export it again',
    'ein Dreieck nennt Ecke {0}, ab 0 gezählt, von nur {1}; neu exportieren',
    'un triangolo indica il vertice {0}, contando da 0, di soli {1}; esportarlo di nuovo',
  ],
  'fault.validGltfExport': [
    '{0}: it is not valid glTF ({1}); export it again',
    '{0}: es ist kein gültiges glTF ({1}); neu exportieren',
    '{0}: non è glTF valido ({1}); esportarlo di nuovo',
  ],
  'fault.unitDefinedMf': [
    'its unit {0} is not defined by 3MF; export it in millimeters',
    'seine Einheit {0} gibt es in 3MF nicht; in Millimetern exportieren',
    'la sua unità {0} non è definita in 3MF; esportarlo in millimetri',
  ],
  'fault.validIdIndex': [
    '{0} is not a valid id or index',
    '{0} ist keine gültige Kennung oder Nummer',
    '{0} non è un identificatore o indice valido',
  ],
  'fault.vertexNumber': [
    '{0}={1} of a vertex is not a number',
    '{0}={1} einer Ecke ist keine Zahl',
    '{0}={1} di un vertice non è un numero',
  ],
  'fault.requiresExtensionReadExport': [
    'it requires an extension that is not read, {0}; export it as triangles',
    'es braucht eine Erweiterung, die nicht gelesen wird, {0}; als Dreiecke exportieren',
    "richiede un'estensione che non viene letta, {0}; esportarlo come triangoli",
  ],
  'fault.vertexTriangleComponent': [
    'a vertex, triangle or component is outside any object; export it again',
    'eine Ecke, ein Dreieck oder eine Komponente steht außerhalb jedes Objekts; neu exportieren',
    'un vertice, triangolo o componente è fuori da ogni oggetto; esportarlo di nuovo',
  ],
  'fault.objectDefinedTwice': [
    'object {0} is defined twice; export it again',
    'Objekt {0} ist zweimal definiert; neu exportieren',
    "l'oggetto {0} è definito due volte; esportarlo di nuovo",
  ],
  'fault.triangleObjectRefers': [
    'a triangle of object {0} refers to vertex {1}, counted from 0, of only {2}',
    'ein Dreieck des Objekts {0} nennt Ecke {1}, ab 0 gezählt, von nur {2}',
    "un triangolo dell'oggetto {0} indica il vertice {1}, contando da 0, di soli {2}",
  ],
  'fault.objectBuiltBut': [
    'object {0} is built but not defined; export it again',
    'Objekt {0} wird gebaut, ist aber nicht definiert; neu exportieren',
    "l'oggetto {0} si costruisce ma non è definito; esportarlo di nuovo",
  ],
  'fault.objectContainsItself': [
    'an object contains itself, or components are nested too deeply; export it again',
    'ein Objekt enthält sich selbst, oder Komponenten sind zu tief geschachtelt; neu exportieren',
    'un oggetto contiene sé stesso, o i componenti sono annidati troppo; esportarlo di nuovo',
  ],
  'fault.meshOpenNon': [
    '{0}: the mesh has {1} open or non-manifold edge{2}, but 3MF is meant for closed parts; set `watertight` or `fill_holes` to close it before printing',
    '{0}: das Netz hat {1} offene oder nicht-mannigfaltige Kanten, aber 3MF ist für geschlossene Teile; vor dem Drucken schließen',
    '{0}: la mesh ha {1} spigoli aperti o non-manifold, ma 3MF è per pezzi chiusi; chiuderla prima di stampare',
  ],
  'fault.meshExceedsGb': [
    '{0}: the mesh exceeds the 4 GB that glTF can hold; decimate it or write .ply',
    '{0}: das Netz ist größer als die 4 GB, die glTF fasst; ausdünnen oder als .ply schreiben',
    '{0}: la mesh supera i 4 GB che glTF può contenere; decimarla o scrivere .ply',
  ],
  'fault.itIsA': ['it is a zip', 'es ist ein Zip', 'è uno zip'],
  'fault.zipArchiveTruncated': [
    'it is not a zip archive, or it is truncated',
    'es ist kein Zip-Archiv, oder es ist abgeschnitten',
    'non è un archivio zip, o è troncato',
  ],
  'fault.directoryArchiveDamaged': [
    'the directory of the archive is damaged; copy the file again',
    'das Verzeichnis des Archivs ist beschädigt; die Datei neu kopieren',
    "l'indice dell'archivio è danneggiato; copiare di nuovo il file",
  ],
  'fault.entryWouldExpand': [
    'entry {0} would expand from {1} to {2} bytes, which no mesh and no scan does; it is refused',
    'Eintrag {0} würde von {1} auf {2} Bytes wachsen, was kein Netz und kein Scan tut; abgelehnt',
    'la voce {0} si espanderebbe da {1} a {2} byte, cosa che nessuna mesh o scansione fa; rifiutata',
  ],
  'fault.entryDamagedUses': [
    'entry {0} is damaged or uses an unsupported compression; save it with deflate',
    'Eintrag {0} ist beschädigt oder anders komprimiert; mit deflate speichern',
    'la voce {0} è danneggiata o ha una compressione non supportata; salvarla con deflate',
  ],
  'fault.entryDamagedCopy': [
    'entry {0} is damaged; copy the file again',
    'Eintrag {0} ist beschädigt; die Datei neu kopieren',
    'la voce {0} è danneggiata; copiare di nuovo il file',
  ],
  'fault.entryLongerStated': [
    'entry {0} is longer than its stated size; it is refused',
    'Eintrag {0} ist länger als angegeben; abgelehnt',
    'la voce {0} è più lunga di quanto indicato; rifiutata',
  ],
  'fault.nameEntryToo': [
    'the name of entry {0}... is too long; shorten it',
    'der Name des Eintrags {0}... ist zu lang; kürzen',
    'il nome della voce {0}... è troppo lungo; accorciarlo',
  ],
  'fault.holdsMoreEntries': [
    'it holds more than {0} entries; pack one scan alone',
    'es enthält mehr als {0} Einträge; nur einen Scan packen',
    'contiene più di {0} voci; impacchettare una sola scansione',
  ],
  'fault.cannotWrittenDiskMay': [
    '{0}: cannot be written; the disk may be full',
    '{0}: kann nicht geschrieben werden; vielleicht ist der Datenträger voll',
    '{0}: non si può scrivere; il disco può essere pieno',
  ],
  'fault.holdsChooseAnother': [
    'holds no {0}; choose another archive',
    'enthält kein {0}; ein anderes Archiv wählen',
    'non contiene {0}; scegliere un altro archivio',
  ],
  'fault.holdsFilesPack': [
    'holds {0} files {1}; pack each of them on its own',
    'enthält {0} Dateien {1}; jede für sich packen',
    'contiene {0} file {1}; impacchettarli uno per uno',
  ],
  'fault.entriesWouldAltogether': [
    'its entries would altogether expand to more than {0} bytes, which no scan does; it is refused',
    'seine Einträge würden zusammen auf mehr als {0} Bytes wachsen, was kein Scan tut; abgelehnt',
    'le sue voci si espanderebbero in tutto oltre {0} byte, cosa che nessuna scansione fa; rifiutato',
  ],
  'fault.entryLeadsOut': [
    'entry {0} leads out of the archive; it is refused',
    'Eintrag {0} führt aus dem Archiv hinaus; abgelehnt',
    "la voce {0} esce dall'archivio; rifiutata",
  ],
  'fault.cannotRead3': ['{0}: cannot be read', '{0}: kann nicht gelesen werden', '{0}: non si può leggere'],
} as const satisfies Rows;
