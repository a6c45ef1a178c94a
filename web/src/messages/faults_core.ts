import type { Rows } from './rows';

/** Failures and warnings of files and folders. `tools/check_faults.py` explains them. */
export const FAULTS_CORE = {
  'fault.cannotWritten': [
    '{0}: cannot be written: {1}',
    '{0}: kann nicht geschrieben werden: {1}',
    '{0}: non si può scrivere: {1}',
  ],
  'fault.folderWritableChoose': [
    'the folder is not writable; choose another folder or change its permissions',
    'in den Ordner darf nicht geschrieben werden; einen anderen wählen oder seine Rechte ändern',
    "nella cartella non si può scrivere; sceglierne un'altra o cambiarne i permessi",
  ],
  'fault.diskFullFree': [
    'the disk is full; free some space',
    'der Datenträger ist voll; Platz schaffen',
    'il disco è pieno; liberare spazio',
  ],
  'fault.folderNameFile': [
    'it is a folder; name a file',
    'es ist ein Ordner; eine Datei angeben',
    'è una cartella; indicare un file',
  ],
  'fault.deviceNamedPipe': [
    'it is a device or a named pipe; name a file',
    'es ist ein Gerät oder eine Pipe; eine Datei angeben',
    'è un dispositivo o una pipe; indicare un file',
  ],
  'fault.folderDoesExist': [
    'the folder {0} does not exist; create it first',
    'den Ordner {0} gibt es nicht; ihn erst anlegen',
    'la cartella {0} non esiste; crearla prima',
  ],
  'fault.diskFullFailing': [
    'the disk is full or failing; free some space',
    'der Datenträger ist voll oder defekt; Platz schaffen',
    'il disco è pieno o guasto; liberare spazio',
  ],
  'fault.keyMoreDotted': [
    'a key has more than {0} dotted parts',
    'ein Schlüssel hat mehr als {0} Teile mit Punkten',
    'una chiave ha più di {0} parti con punti',
  ],
  'fault.holdsMoreValues': [
    'it holds more than {0} values',
    'es enthält mehr als {0} Werte',
    'contiene più di {0} valori',
  ],
  'fault.bracketsNestedMore': [
    'brackets are nested more than {0} deep',
    'Klammern sind mehr als {0}-fach geschachtelt',
    'le parentesi sono annidate oltre {0} livelli',
  ],
  'fault.lineCorrectFile': [
    '{0}: line {1}: {2}; correct the file',
    '{0}: Zeile {1}: {2}; die Datei berichtigen',
    '{0}: riga {1}: {2}; correggere il file',
  ],
  'fault.cannotWrittenFree': [
    '{0}: cannot be written ({1}); free some space or check the disk',
    '{0}: kann nicht geschrieben werden ({1}); Platz schaffen oder den Datenträger prüfen',
    '{0}: non si può scrivere ({1}); liberare spazio o controllare il disco',
  ],
  'fault.writingFolderWait': [
    '{0}: {1} is writing to this folder; wait until it ends, or stop it',
    '{0}: {1} schreibt in diesen Ordner; warten, bis es fertig ist, oder es anhalten',
    '{0}: {1} sta scrivendo in questa cartella; aspettare che finisca o fermarlo',
  ],
  'fault.anotherNameHard': [
    '{0}: has another name (a hard link), under which it would change; remove it',
    '{0}: hat noch einen Namen (Hardlink), unter dem es sich ändern würde; ihn entfernen',
    '{0}: ha un altro nome (hard link), sotto cui cambierebbe; rimuoverlo',
  ],
  'fault.cannotLockedChoose': [
    '{0}: cannot be locked ({1}); choose a folder on a local disk that you may write to',
    '{0}: kann nicht gesperrt werden ({1}); einen beschreibbaren Ordner auf einem lokalen Datenträger wählen',
    '{0}: non si può bloccare ({1}); scegliere una cartella scrivibile su un disco locale',
  ],
  'fault.cannotCreated': [
    '{0}: cannot be created: {1}',
    '{0}: kann nicht angelegt werden: {1}',
    '{0}: non si può creare: {1}',
  ],
  'fault.setAllowMemory': [
    'set `allow_memory` to {0} to read it',
    'zum Lesen {0} Speicher zulassen',
    'concedere {0} di memoria per leggerlo',
  ],
  'fault.writeAgainFewer': [
    'write it again with fewer repeated parts',
    'mit weniger wiederholten Teilen neu schreiben',
    'scriverlo di nuovo con meno parti ripetute',
  ],
  'fault.expandMemoryMore': [
    '{0}: its {1} expand to {2} of memory, more than the {3} that are allowed; {4}',
    '{0}: {1} werden zu {2} Speicher, mehr als die erlaubten {3}; {4}',
    '{0}: {1} si espandono a {2} di memoria, più dei {3} ammessi; {4}',
  ],
  'fault.leadsOutFolder': [
    'leads out of its folder; name a file inside',
    'führt aus seinem Ordner hinaus; eine Datei darin angeben',
    'esce dalla sua cartella; indicare un file al suo interno',
  ],
  'fault.folderNameFileInside': [
    'is a folder; name a file inside',
    'ist ein Ordner; eine Datei darin angeben',
    'è una cartella; indicare un file al suo interno',
  ],
  'fault.linkLinksScan': [
    'is a link to {0}, and links in a scan, in a project and beside a rig are not followed; put the files themselves here, or bind-mount the other disk here',
    'ist ein Verweis auf {0}; Verweisen in einem Scan, einem Projekt und neben einem Aufbau wird nicht gefolgt; die Dateien selbst hierher legen',
    'è un collegamento a {0}, e i collegamenti in una scansione, in un progetto e accanto a un apparato non si seguono; mettere qui i file stessi',
  ],
  'fault.doesExistCheck': [
    'does not exist; check the path',
    'gibt es nicht; den Pfad prüfen',
    'non esiste; controllare il percorso',
  ],
  'fault.cannotOpened': ['cannot be opened: {0}', 'kann nicht geöffnet werden: {0}', 'non si può aprire: {0}'],
  'fault.fileReplace': [
    'is {0}, not a file; replace it',
    'ist {0}, keine Datei; ersetzen',
    'è {0}, non un file; sostituirlo',
  ],
  'fault.anotherNameHardLink': [
    'has another name (a hard link), under which it would change; remove it',
    'hat noch einen Namen (Hardlink), unter dem es sich ändern würde; ihn entfernen',
    'ha un altro nome (hard link), sotto cui cambierebbe; rimuoverlo',
  ],
  'fault.cannotReadCheck': [
    'cannot be read; check the disk',
    'kann nicht gelesen werden; den Datenträger prüfen',
    'non si può leggere; controllare il disco',
  ],
  'fault.bytesMoreLargest': [
    'has {0} bytes, more than the {1} of the largest file of its kind; check that it is the right file',
    'hat {0} Bytes, mehr als die {1} der größten Datei dieser Art; prüfen, ob es die richtige ist',
    'ha {0} byte, più dei {1} del file più grande di questo tipo; controllare che sia quello giusto',
  ],
  'fault.lengthWriteNumber': [
    "'{0}' is not a length: write a number and um, mm, cm, m or in, such as 1.5mm",
    '„{0}“ ist keine Länge: eine Zahl mit µm, mm, cm, m oder in schreiben, etwa 1.5mm',
    '«{0}» non è una lunghezza: scrivere un numero con µm, mm, cm, m o in, come 1.5mm',
  ],
  'fault.umMmCm': [
    'um, mm, cm, m, in, ft or a length such as 25.4mm',
    'um, mm, cm, m, in, ft oder eine Länge wie 25.4mm',
    'um, mm, cm, m, in, ft o una lunghezza come 25.4mm',
  ],
  'fault.nameContinuesAfter': [
    '{0}: the name continues after a NUL character; rename the file',
    '{0}: der Name geht nach einem NUL-Zeichen weiter; die Datei umbenennen',
    '{0}: il nome continua dopo un carattere NUL; rinominare il file',
  ],
  'fault.cannotRead2': ['cannot be read: {0}', 'kann nicht gelesen werden: {0}', 'non si può leggere: {0}'],
  'fault.bytesMoreBytes': [
    'has {0} bytes, more than the {1} bytes that it can need',
    'hat {0} Bytes, mehr als die {1} Bytes, die es brauchen kann',
    'ha {0} byte, più dei {1} che può richiedere',
  ],
  'fault.suchFileCheck': [
    'there is no such file; check its name',
    'die Datei gibt es nicht; den Namen prüfen',
    'il file non esiste; controllare il nome',
  ],
  'fault.regularFileName': [
    'this is not a regular file; name a file',
    'dies ist keine gewöhnliche Datei; eine Datei angeben',
    'non è un file normale; indicare un file',
  ],
  'fault.cannotOpenedCheck': [
    'it cannot be opened; check its read permission',
    'sie lässt sich nicht öffnen; das Leserecht prüfen',
    'non si può aprire; controllare il permesso di lettura',
  ],
  'fault.cannotReadCheckDisk': [
    'it cannot be read; check the disk',
    'sie lässt sich nicht lesen; den Datenträger prüfen',
    'non si può leggere; controllare il disco',
  ],
  'fault.bytesMoreLargestFile': [
    'it has {0} bytes, more than the {1} of the largest file of its kind; check that it is the right file',
    'sie hat {0} Bytes, mehr als die {1} der größten Datei dieser Art; prüfen, ob es die richtige ist',
    'ha {0} byte, più dei {1} del file più grande di questo tipo; controllare che sia quello giusto',
  ],
  'fault.cannotReadCompletely': [
    'it cannot be read completely; check the disk, and whether another program is writing it',
    'sie lässt sich nicht vollständig lesen; den Datenträger prüfen, und ob ein anderes Programm sie schreibt',
    'non si può leggere per intero; controllare il disco e se un altro programma lo sta scrivendo',
  ],
  'fault.stoppedUser': ['stopped by the user', 'vom Benutzer angehalten', "fermato dall'utente"],
  'fault.cannotReadCompute': [
    '{0}: it cannot be read to compute its checksum',
    '{0}: kann für die Prüfsumme nicht gelesen werden',
    '{0}: non si può leggere per calcolarne la somma di controllo',
  ],
  'fault.cannotWrittenDisk': [
    '{0}: cannot be written to the disk ({1}); free some space or check the disk',
    '{0}: kann nicht auf den Datenträger geschrieben werden ({1}); Platz schaffen oder den Datenträger prüfen',
    '{0}: non si può scrivere sul disco ({1}); liberare spazio o controllare il disco',
  ],
  'fault.xmlElementMore': [
    'its XML has an element of more than {0} bytes in line {1}; export it again',
    'ihr XML hat in Zeile {1} ein Element von mehr als {0} Bytes; neu exportieren',
    'il suo XML ha alla riga {1} un elemento di più di {0} byte; esportarlo di nuovo',
  ],
  'fault.xmlInvalidLine': [
    'its XML is invalid in line {0}: {1}',
    'ihr XML ist in Zeile {0} ungültig: {1}',
    'il suo XML non è valido alla riga {0}: {1}',
  ],
  'fault.logoReportPng': [
    '{0}: the logo of a report must be a PNG or JPEG picture',
    '{0}: das Logo eines Berichts muss ein PNG- oder JPEG-Bild sein',
    "{0}: il logo di un rapporto deve essere un'immagine PNG o JPEG",
  ],
  'fault.viewsCannotStored': [
    'the views cannot be stored in the temporary folder {0} ({1}); free some space, or set TMPDIR to a folder on a larger disk',
    'die Ansichten passen nicht in den temporären Ordner {0} ({1}); Platz schaffen oder TMPDIR auf einen Ordner eines größeren Datenträgers setzen',
    'le viste non si possono salvare nella cartella temporanea {0} ({1}); liberare spazio o impostare TMPDIR su un disco più grande',
  ],
  'fault.viewCannotRead': [
    'a view cannot be read back from the temporary folder {0}; check its disk, or set TMPDIR to a folder on another one',
    'eine Ansicht lässt sich nicht aus dem temporären Ordner {0} zurücklesen; den Datenträger prüfen oder TMPDIR auf einen anderen setzen',
    'una vista non si può rileggere dalla cartella temporanea {0}; controllarne il disco o impostare TMPDIR su un altro',
  ],
} as const satisfies Rows;
