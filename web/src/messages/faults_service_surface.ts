import type { Rows } from './rows';

/** Failures and warnings of commands on surfaces, measurements and exports. `tools/check_faults.py` explains them. */
export const FAULTS_SERVICE_SURFACE = {
  'fault.cannotCreated2': ['{0}: cannot be created', '{0}: kann nicht angelegt werden', '{0}: non si può creare'],
  'fault.kindPlaneCylinder': [
    'kind: is plane, cylinder or sphere',
    'möglich sind plane, cylinder oder sphere',
    'deve essere plane, cylinder o sphere',
  ],
  'fault.completeScanPut': [
    'there is no complete scan to put into a zip; scan first',
    'es gibt keinen vollständigen Scan für ein Zip; erst scannen',
    "non c'è una scansione completa per uno zip; scansionare prima",
  ],
  'fault.stlBinaryAscii': ['stl: is binary or ascii', 'möglich sind binary oder ascii', 'deve essere binary o ascii'],
  'fault.suchFormatChoose': [
    'there is no such format; choose one of the list',
    'dieses Format gibt es nicht; eines der Liste wählen',
    "questo formato non esiste; sceglierne uno dell'elenco",
  ],
  'fault.formatSizeZip': [
    'format: the size of a zip is known when it is written',
    'die Größe eines Zips steht fest, wenn es geschrieben ist',
    'la grandezza di uno zip si sa quando è scritto',
  ],
  'fault.surfaceExportReconstruct': [
    'there is no surface to export; reconstruct it first',
    'es gibt keine Oberfläche zu exportieren; sie erst berechnen',
    "non c'è una superficie da esportare; ricostruirla prima",
  ],
  'fault.writtenButDisk': [
    '{0} is written, but the disk did not confirm it; check the disk: the file may be lost when the power fails',
    '{0} ist geschrieben, aber der Datenträger bestätigte es nicht; ihn prüfen: die Datei kann bei einem Stromausfall verloren gehen',
    "{0} è scritto, ma il disco non l'ha confermato; controllare il disco: il file può andare perso se manca la corrente",
  ],
  'fault.planMostKb': [
    'a plan has at most 500 kB; choose another file',
    'ein Plan hat höchstens 500 kB; eine andere Datei wählen',
    'un piano ha al massimo 500 kB; scegliere un altro file',
  ],
  'fault.nothingInspectChoose': [
    'there is nothing to inspect; choose a reference to compare with, or add features to the plan',
    'es gibt nichts zu prüfen; eine Referenz zum Vergleich wählen oder dem Plan Elemente hinzufügen',
    "non c'è nulla da ispezionare; scegliere un riferimento o aggiungere elementi al piano",
  ],
  'fault.nextPartNeeds': [
    'the next part needs a project; this is a plain scan folder',
    'das nächste Teil braucht ein Projekt; dies ist ein bloßer Scanordner',
    'il pezzo successivo richiede un progetto; questa è una semplice cartella di scansione',
  ],
  'fault.formatHtmlPdf': [
    'format: is html, pdf, csv, qif or toml',
    'möglich sind html, pdf, csv, qif oder toml',
    'deve essere html, pdf, csv, qif o toml',
  ],
  'fault.reportLanguage': ['language: is en, de or it', 'möglich sind en, de oder it', 'deve essere en, de o it'],
  'fault.inspectionReportInspect': [
    'there is no inspection to report; inspect the surface first',
    'es gibt keine Prüfung für einen Bericht; erst die Oberfläche prüfen',
    "non c'è un'ispezione da riportare; ispezionare prima la superficie",
  ],
  'fault.programMakesPdf': [
    'this program makes no PDF files; write the report as HTML and print it',
    'dieses Programm erzeugt keine PDF-Dateien; den Bericht als HTML schreiben und drucken',
    'questo programma non crea file PDF; scrivere il rapporto come HTML e stamparlo',
  ],
  'fault.surfaceYetReconstruct': [
    'there is no surface yet; reconstruct it first',
    'es gibt noch keine Oberfläche; sie erst berechnen',
    "non c'è ancora una superficie; ricostruirla prima",
  ],
  'fault.projectMeasurementsRemove': [
    'this project has 500 measurements; remove some',
    'dieses Projekt hat 500 Messungen; einige entfernen',
    'questo progetto ha 500 misure; toglierne alcune',
  ],
  'fault.placesListMost': [
    'places: is a list of at most 3 places',
    'höchstens 3 Stellen sind möglich',
    'sono possibili al massimo 3 punti',
  ],
  'fault.placesEachObject': ['places: each is an object', 'jede Stelle ist ein Objekt', 'ogni punto è un oggetto'],
  'fault.surfaceMeasureReconstruct': [
    'there is no surface to measure; reconstruct it first',
    'es gibt keine Oberfläche zu messen; sie erst berechnen',
    "non c'è una superficie da misurare; ricostruirla prima",
  ],
  'fault.labelsListMost': [
    'labels: is a list of at most 500 labels',
    'höchstens 500 Beschriftungen sind möglich',
    'sono possibili al massimo 500 etichette',
  ],
  'fault.surfaceCutReconstruct': [
    'there is no surface to cut; reconstruct it first',
    'es gibt keine Oberfläche zu schneiden; sie erst berechnen',
    "non c'è una superficie da tagliare; ricostruirla prima",
  ],
  'fault.formatDxfSvg': ['format: is dxf or svg', 'möglich sind dxf oder svg', 'deve essere dxf o svg'],
  'fault.planeDoesMeet': [
    'the plane does not meet the surface; move it into the part',
    'die Ebene trifft die Oberfläche nicht; sie in das Teil schieben',
    'il piano non incontra la superficie; spostarlo nel pezzo',
  ],
  'fault.referenceStlPly': [
    'a reference is an STL, PLY, OBJ, 3MF or STEP file; choose another file',
    'eine Referenz ist eine STL-, PLY-, OBJ-, 3MF- oder STEP-Datei; eine andere wählen',
    'un riferimento è un file STL, PLY, OBJ, 3MF o STEP; sceglierne un altro',
  ],
  'fault.fileMostMb': [
    'a file has at most 512 MB; choose a smaller one',
    'eine Datei hat höchstens 512 MB; eine kleinere wählen',
    'un file ha al massimo 512 MB; sceglierne uno più piccolo',
  ],
  'fault.piecesFileArrive': [
    'the pieces of a file arrive in order; begin at 0',
    'die Stücke einer Datei kommen der Reihe nach; bei 0 beginnen',
    'le parti di un file arrivano in ordine; cominciare da 0',
  ],
  'fault.nameLettersShorten': [
    'name: has 1 to 120 letters; shorten it',
    'ein Name hat 1 bis 120 Zeichen; kürzen',
    'un nome ha da 1 a 120 lettere; accorciarlo',
  ],
  'fault.cannotRenamed': [
    '{0}: cannot be renamed: {1}',
    '{0}: kann nicht umbenannt werden: {1}',
    '{0}: non si può rinominare: {1}',
  ],
  'fault.cannotDeleted': [
    '{0}: cannot be deleted: {1}',
    '{0}: kann nicht gelöscht werden: {1}',
    '{0}: non si può eliminare: {1}',
  ],
  'fault.referenceShowChoose': [
    'there is no reference to show; choose one',
    'es gibt keine Referenz zu zeigen; eine wählen',
    "non c'è un riferimento da mostrare; sceglierne uno",
  ],
  'fault.versionSurfaceNumber': [
    'version: there is no surface of this number',
    'eine Oberfläche dieser Nummer gibt es nicht',
    "non c'è una superficie con questo numero",
  ],
  'fault.versionTheseEdits': [
    'version: these edits are of the surface itself',
    'diese Bearbeitungen gehören zur Oberfläche selbst',
    'queste modifiche sono della superficie stessa',
  ],
  'fault.versionSurfaceEdits': [
    'version: this surface has no edits',
    'diese Oberfläche hat keine Bearbeitungen',
    'questa superficie non ha modifiche',
  ],
  'fault.surfaceEditReconstruct': [
    'there is no surface to edit; reconstruct it first',
    'es gibt keine Oberfläche zu bearbeiten; sie erst berechnen',
    "non c'è una superficie da modificare; ricostruirla prima",
  ],
  'fault.surfaceShownWithout': [
    '{0}; the surface is shown without its figures',
    '{0}; die Oberfläche wird ohne ihre Kennzahlen gezeigt',
    '{0}; la superficie è mostrata senza i suoi valori',
  ],
  'fault.savedEditsDo': [
    'the saved edits do not suit the saved surface',
    'die gespeicherten Bearbeitungen passen nicht zur gespeicherten Oberfläche',
    'le modifiche salvate non corrispondono alla superficie salvata',
  ],
  'fault.editsDoSuit': [
    'the edits do not suit this surface, and nothing was changed',
    'die Bearbeitungen passen nicht zu dieser Oberfläche, nichts wurde geändert',
    'le modifiche non corrispondono a questa superficie, e nulla è stato cambiato',
  ],
  'fault.surfaceSuchTriangle': [
    'the surface has no such triangle; pick another one',
    'die Oberfläche hat dieses Dreieck nicht; ein anderes wählen',
    'la superficie non ha questo triangolo; sceglierne un altro',
  ],
  'fault.curvatureOfBoundary': [
    'the curvature at a boundary is unknown; pick a place inside the surface',
    'die Krümmung an einem Rand ist unbekannt; eine Stelle innerhalb der Oberfläche wählen',
    'la curvatura su un bordo è ignota; scegliere un punto interno alla superficie',
  ],
  'fault.surfaceWithoutSigma': [
    'this surface states no sigma; select by something else',
    'diese Oberfläche nennt kein Sigma; nach etwas anderem auswählen',
    'questa superficie non indica sigma; selezionare secondo altro',
  ],
  'fault.nothingSelectedSelect': [
    'nothing is selected; select the surface to be fitted',
    'nichts ist ausgewählt; die einzupassende Oberfläche auswählen',
    'nulla è selezionato; selezionare la superficie da adattare',
  ],
  'fault.stepUndo': [
    'there is no step to undo',
    'es gibt keinen Schritt, der sich zurücknehmen lässt',
    "non c'è un passo da annullare",
  ],
  'fault.stepRedo': [
    'there is no step to redo',
    'es gibt keinen Schritt, der sich wiederholen lässt',
    "non c'è un passo da ripetere",
  ],
  'fault.isNoNumber': [
    '{0} is no number from {1} to {2}',
    '{0} ist keine Zahl von {1} bis {2}',
    '{0} non è un numero da {1} a {2}',
  ],
  'fault.formatFrangiaVersions': [
    'its format is not frangia-versions',
    'das Format ist nicht frangia-versions',
    'il formato non è frangia-versions',
  ],
  'fault.versionsOrder': [
    'its versions are not in order',
    'die Versionen stehen nicht der Reihe nach',
    'le versioni non sono in ordine',
  ],
  'fault.currentVersionNone': [
    'its current version is none of them',
    'die aktuelle Version ist keine davon',
    'la versione attuale non è fra queste',
  ],
  'fault.jsonObject': ['it is no JSON object', 'es ist kein JSON-Objekt', 'non è un oggetto JSON'],
  'fault.doesStateSurfaces': [
    '{0}: does not state the surfaces of this project ({1}); restore the file, or rename it and build the surface again',
    '{0}: nennt die Oberflächen dieses Projekts nicht ({1}); die Datei wiederherstellen, oder sie umbenennen und die Oberfläche neu berechnen',
    '{0}: non indica le superfici di questo progetto ({1}); ripristinare il file, o rinominarlo e ricostruire la superficie',
  ],
  'fault.projectBeenChanged': [
    'this project has been changed too often; begin another one',
    'dieses Projekt wurde zu oft geändert; ein anderes beginnen',
    'questo progetto è stato cambiato troppe volte; iniziarne un altro',
  ],
  'fault.doesFitMemory': ['it does not fit into the memory', 'es passt nicht in den Speicher', 'non sta nella memoria'],
  'fault.changeCouldWritten': [
    'the change could not be written, and the project cannot be read ({0}); check the disk and open the project again',
    'die Änderung ließ sich nicht schreiben, und das Projekt ist nicht lesbar ({0}); den Datenträger prüfen und das Projekt neu öffnen',
    'la modifica non si è potuta scrivere, e il progetto non si legge ({0}); controllare il disco e riaprire il progetto',
  ],
  'fault.changeProjectBut': [
    'the change is in the project, but the disk did not confirm it ({0}); it may be lost when the power fails',
    'die Änderung ist im Projekt, aber der Datenträger bestätigte sie nicht ({0}); sie kann bei einem Stromausfall verloren gehen',
    "la modifica è nel progetto, ma il disco non l'ha confermata ({0}); può andare persa se manca la corrente",
  ],
} as const satisfies Rows;
