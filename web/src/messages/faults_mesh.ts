import type { Rows } from './rows';

/** Failures and warnings of edits of a mesh. `tools/check_faults.py` explains them. */
export const FAULTS_MESH = {
  'fault.operationHelpLists': [
    "there is no operation '{0}'; `help` lists the operations",
    'die Bearbeitung „{0}“ gibt es nicht',
    "l'operazione «{0}» non esiste",
  ],
  'fault.triangleMeshWould': [
    '{0}: no triangle of the mesh would be left',
    '{0}: vom Netz bliebe kein Dreieck übrig',
    '{0}: della mesh non resterebbe alcun triangolo',
  ],
  'fault.fileEditScript': [
    'the file is not an edit script (format frangia-edits)',
    'die Datei ist kein Bearbeitungsskript (Format frangia-edits)',
    'il file non è uno script di modifiche (formato frangia-edits)',
  ],
  'fault.versionWholeNumber': [
    'version is not a whole number; correct the file',
    'version ist keine ganze Zahl; die Datei berichtigen',
    'version non è un numero intero; correggere il file',
  ],
  'fault.newerVersionFrangia': [
    'a newer version of frangia wrote the script; update frangia',
    'eine neuere Version von Frangia schrieb das Skript; Frangia aktualisieren',
    'lo script è di una versione più nuova di Frangia; aggiornarla',
  ],
  'fault.doneButScript': [
    'done is {0}, but the script has {1} step{2}; correct the file',
    'done ist {0}, aber das Skript hat {1} Schritte; die Datei berichtigen',
    'done è {0}, ma lo script ha {1} passi; correggere il file',
  ],
  'fault.fileValidJson': [
    'the file is not valid JSON',
    'die Datei ist kein gültiges JSON',
    'il file non è JSON valido',
  ],
  'fault.fileEditScript2': [
    'the file is not an edit script ({0})',
    'die Datei ist kein Bearbeitungsskript ({0})',
    'il file non è uno script di modifiche ({0})',
  ],
  'fault.stepsTakeBytes': [
    'the steps take {0} bytes, more than the {1} that are read again; export the mesh, and begin a history with it',
    'die Schritte brauchen {0} Bytes, mehr als die {1}, die wieder gelesen werden; das Netz exportieren und damit neu beginnen',
    'i passi occupano {0} byte, più dei {1} che vengono riletti; esportare la mesh e ricominciare da lì',
  ],
  'fault.lengthMmUnit': [
    '; a length is in mm or has a unit: 10, 10mm, 1cm, 0.5in',
    '; eine Länge ist in mm oder hat eine Einheit: 10, 10mm, 1cm, 0.5in',
    "; una lunghezza è in mm o ha un'unità: 10, 10mm, 1cm, 0.5in",
  ],
  'fault.sizeLengthGreater': [
    '; a size is a length greater than 0, in mm or with a unit: 10, 10mm, 1cm, 0.5in',
    '; eine Größe ist eine Länge über 0, in mm oder mit Einheit: 10, 10mm, 1cm, 0.5in',
    '; una grandezza è una lunghezza maggiore di 0, in mm o con unità: 10, 10mm, 1cm, 0.5in',
  ],
  'fault.toleranceLengthLeast': [
    '; a tolerance is a length of at least 0, in mm or with a unit: 0.1, 0.1mm, 100um',
    '; eine Toleranz ist eine Länge ab 0, in mm oder mit Einheit: 0.1, 0.1mm, 100um',
    '; una tolleranza è una lunghezza da 0 in su, in mm o con unità: 0.1, 0.1mm, 100um',
  ],
  'fault.writeWholeNumber': [
    '; write a whole number greater than 0',
    '; eine ganze Zahl über 0 schreiben',
    '; scrivere un numero intero maggiore di 0',
  ],
  'fault.writeNumberList': [
    '; write the number that `list` shows for the component: 0',
    '; die Nummer der Komponente schreiben, etwa 0',
    '; scrivere il numero del componente, come 0',
  ],
  'fault.writeNumberListShows': [
    '; write the number that `list` shows for the hole: 0',
    '; die Nummer des Lochs schreiben, etwa 0',
    '; scrivere il numero del foro, come 0',
  ],
  'fault.writeNumberLeast': [
    '; write a number of at least 0',
    '; eine Zahl ab 0 schreiben',
    '; scrivere un numero da 0 in su',
  ],
  'fault.valueLettersMore': [
    'the value has {0} letters, more than {1} numbers need; shorten it',
    'der Wert hat {0} Zeichen, mehr als {1} Zahlen brauchen; kürzen',
    'il valore ha {0} caratteri, più di quanti ne servano per {1} numeri; accorciarlo',
  ],
  'fault.valueWritePoint': [
    'the value is not {0}; write the point of view and 3 to {1} corners of the outline, three coordinates each',
    'der Wert ist nicht {0}; den Blickpunkt und 3 bis {1} Ecken des Umrisses schreiben, je drei Koordinaten',
    'il valore non è {0}; scrivere il punto di vista e da 3 a {1} vertici del contorno, tre coordinate ciascuno',
  ],
  'fault.markWrite': [
    "'{0}' is not a mark; write {1}",
    '„{0}“ ist keine Markierung; {1} schreiben',
    '«{0}» non è un contrassegno; scrivere {1}',
  ],
  'fault.triangleSelected': [
    '{0}: no triangle is selected',
    '{0}: kein Dreieck ist ausgewählt',
    '{0}: nessun triangolo è selezionato',
  ],
  'fault.deleteSelectionHolds': [
    'delete: the selection holds no triangle, so nothing is deleted',
    'die Auswahl enthält kein Dreieck, es wird nichts gelöscht',
    'la selezione non contiene triangoli, non si cancella nulla',
  ],
  'fault.islandsUpMm': [
    'islands of up to {0} mm are all components; the one of the largest area, of {1} mm, stays: choose a smaller size',
    'Inseln bis {0} mm sind alle Komponenten; die mit der größten Fläche, {1} mm, bleibt: eine kleinere Größe wählen',
    'le isole fino a {0} mm sono tutti i componenti; quello di area maggiore, di {1} mm, resta: scegliere una grandezza minore',
  ],
  'fault.componentsRemovedTriangles': [
    '{0} of {1} components removed, {2} triangles in total',
    '{0} von {1} Komponenten entfernt, zusammen {2} Dreiecke',
    'rimossi {0} di {1} componenti, {2} triangoli in tutto',
  ],
  'fault.fitSpherePoints': [
    'fit_sphere: the points lie in a plane; a sphere needs points all around it',
    'die Punkte liegen in einer Ebene; eine Kugel braucht Punkte ringsum',
    "i punti stanno su un piano; una sfera richiede punti tutt'intorno",
  ],
  'fault.fitSphereAll': [
    'fit_sphere: all points are the same',
    'alle Punkte sind derselbe',
    'tutti i punti sono lo stesso',
  ],
  'fault.buildExactIntersection': [
    'this build has no exact intersection test: configure it with FRANGIA_CGAL=ON',
    'dieses Programm hat keine exakte Schnittprüfung (FRANGIA_CGAL)',
    'questo programma non ha il test esatto di intersezione (FRANGIA_CGAL)',
  ],
  'fault.triangulatePolygonHole': [
    'triangulate_polygon: a hole lies outside the boundary or crosses it',
    'ein Loch liegt außerhalb des Rands oder kreuzt ihn',
    'un foro è fuori dal bordo o lo attraversa',
  ],
  'fault.triangulatePolygonPolygon': [
    'triangulate_polygon: the polygon crosses itself or runs clockwise',
    'das Vieleck schneidet sich selbst oder läuft im Uhrzeigersinn',
    'il poligono interseca sé stesso o gira in senso orario',
  ],
  'fault.outlineCutIntersects': [
    'an outline of the cut intersects itself and stays open',
    'ein Umriss des Schnitts schneidet sich selbst und bleibt offen',
    'un contorno del taglio interseca sé stesso e resta aperto',
  ],
  'fault.meshStaysDecimation': [
    'the mesh stays as it is: no decimation within the tolerance was found',
    'das Netz bleibt, wie es ist: innerhalb der Toleranz ließ es sich nicht ausdünnen',
    "la mesh resta com'è: entro la tolleranza non si è potuta decimare",
  ],
  'fault.halfSurroundingCurvature': [
    'with half of the surrounding curvature',
    'mit der halben Krümmung der Umgebung',
    'con metà della curvatura circostante',
  ],
  'fault.minimalSurface': ['by a minimal surface', 'durch eine Minimalfläche', 'con una superficie minima'],
  'fault.holeEdgesSmooth': [
    'a hole of {0} edges has no smooth patch and is filled flat',
    'ein Loch mit {0} Kanten hat keine glatte Füllung und wird eben gefüllt',
    'un foro di {0} spigoli non ha un riempimento liscio e si riempie piano',
  ],
  'fault.holeEdgesFilled': [
    'a hole of {0} edges is filled by a fan around its centroid',
    'ein Loch mit {0} Kanten wird durch einen Fächer um seinen Schwerpunkt gefüllt',
    'un foro di {0} spigoli si riempie con un ventaglio attorno al centroide',
  ],
  'fault.holeEdgesFilledSmoother': [
    'a hole of {0} edges is filled {1}: a smoother patch would intersect the surface',
    'ein Loch mit {0} Kanten wird {1} gefüllt: eine glattere Füllung würde die Oberfläche schneiden',
    'un foro di {0} spigoli si riempie {1}: un riempimento più liscio intersecherebbe la superficie',
  ],
  'fault.patchesHolesIntersect': [
    'the patches of {0} of {1} holes intersect the surface or themselves; use `remove_self_intersections`',
    'die Füllungen von {0} von {1} Löchern schneiden die Oberfläche oder sich selbst; Selbstschnitte entfernen',
    'i riempimenti di {0} fori su {1} intersecano la superficie o sé stessi; rimuovere le autointersezioni',
  ],
  'fault.edgesJoinTwo': [
    '{0} edges join two triangles of opposite orientation, which {1} cannot tell from a fold; use `orient` first, and `make_manifold` for those that stay',
    'an {0} Kanten treffen sich zwei Dreiecke entgegengesetzter Orientierung, die {1} nicht von einer Falte unterscheidet; erst einheitlich orientieren, dann die übrigen reparieren',
    '{0} spigoli uniscono due triangoli di orientamento opposto, che {1} non distingue da una piega; prima orientarli, poi riparare quelli che restano',
  ],
  'fault.meshNonManifold': [
    'the mesh has {0} non-manifold edge{1}; {2} split them first, as `make_manifold` does',
    'das Netz hat {0} nicht-mannigfaltige Kanten; sie werden vorher getrennt',
    'la mesh ha {0} spigoli non-manifold; vengono prima separati',
  ],
  'fault.offsetMmLeaves': [
    'an offset of {0} mm leaves nothing of the surface; choose a smaller distance',
    'ein Versatz von {0} mm lässt nichts von der Oberfläche übrig; weniger wählen',
    'uno spostamento di {0} mm non lascia nulla della superficie; sceglierne uno minore',
  ],
  'fault.edgesMmNeed': [
    'edges of {0} mm need about {1} triangles, more than {2}; use edges of {3} mm or longer',
    'Kanten von {0} mm brauchen etwa {1} Dreiecke, mehr als {2}; Kanten von {3} mm oder länger wählen',
    'spigoli di {0} mm richiedono circa {1} triangoli, più di {2}; usare spigoli di {3} mm o più',
  ],
  'fault.buildCannotRemesh': [
    'this build cannot remesh: configure it with FRANGIA_CGAL=ON',
    'dieses Programm kann nicht neu vernetzen (FRANGIA_CGAL)',
    'questo programma non può rigenerare la mesh (FRANGIA_CGAL)',
  ],
  'fault.smoothingTakesMost': [
    'smoothing takes at most 10 000 iterations; choose fewer',
    'geglättet wird in höchstens 10 000 Durchgängen; weniger wählen',
    'si leviga in al massimo 10 000 iterazioni; sceglierne meno',
  ],
  'fault.someTrianglesStill': [
    'some triangles still intersect; select them with `select_self_intersections`, delete them and fill the holes',
    'einige Dreiecke schneiden sich noch; sie auswählen, löschen und die Löcher füllen',
    'alcuni triangoli si intersecano ancora; selezionarli, cancellarli e riempire i fori',
  ],
  'fault.moreMillionPairs': [
    'more than a million pairs of triangles intersect; remove the triangles that coincide',
    'mehr als eine Million Paare von Dreiecken schneiden sich; zusammenfallende Dreiecke entfernen',
    'più di un milione di coppie di triangoli si intersecano; rimuovere i triangoli coincidenti',
  ],
} as const satisfies Rows;
