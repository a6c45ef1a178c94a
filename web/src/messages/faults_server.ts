import type { Rows } from './rows';

/** Refusals of the server in front of the service. `tools/check_faults.py` explains them. */
export const FAULTS_SERVER = {
  'fault.onlyOneOperates': [
    'another browser operates the scanner; take over to act here',
    'ein anderer Browser bedient den Scanner; übernehmen, um hier zu handeln',
    'un altro browser comanda lo scanner; prendere il controllo per agire qui',
  ],
  'fault.onlyTheMachineLetsIn': [
    'only a browser on the machine itself lets others in',
    'nur ein Browser auf dem Rechner selbst lässt andere zu',
    'solo un browser sul computer stesso può ammetterne altri',
  ],
  'fault.noSuchPage': ['there is no such page', 'diese Seite gibt es nicht', 'questa pagina non esiste'],
  'fault.ownPageOnly': [
    'this server answers only its own page on this machine',
    'dieser Server antwortet nur seiner eigenen Seite auf diesem Rechner',
    'questo server risponde solo alla propria pagina su questo computer',
  ],
  'fault.readWithGet': ['a page is read with GET', 'eine Seite wird mit GET gelesen', 'una pagina si legge con GET'],
  'fault.getAndPost': ['the methods are GET and POST', 'die Methoden sind GET und POST', 'i metodi sono GET e POST'],
  'fault.wrongBody': [
    'the wrong kind of body; send Content-Type: {0}',
    'die falsche Art von Inhalt; Content-Type: {0} senden',
    'tipo di contenuto sbagliato; inviare Content-Type: {0}',
  ],
  'fault.tokenByPost': [
    'a token is exchanged with POST',
    'ein Token wird mit POST eingelöst',
    'un token si scambia con POST',
  ],
  'fault.tokenTooLong': [
    'a token or a password is shorter than this',
    'ein Token oder Passwort ist kürzer',
    'un token o una password è più corto',
  ],
  'fault.noValidKey': [
    'no valid key was sent; open the app with a new link from `frangia serve --new-link`',
    'der Schlüssel fehlt oder ist ungültig; die App mit einem neuen Link öffnen',
    "manca una chiave valida; aprire l'app con un nuovo link",
  ],
  'fault.requestFailed': [
    'the request failed for a reason that has no words',
    'die Anfrage ist aus einem unbekannten Grund gescheitert',
    'la richiesta è fallita per una ragione sconosciuta',
  ],
  'fault.referenceNotShown': [
    'the reference is not shown; show it first',
    'die Referenz wird nicht gezeigt; sie erst zeigen',
    'il riferimento non è mostrato; mostrarlo prima',
  ],
  'fault.noSuchLevel': [
    'the surface has no such level',
    'diese Stufe hat die Oberfläche nicht',
    'la superficie non ha questo livello',
  ],
  'fault.noSuchComparison': [
    'there is no comparison of such a level',
    'für diese Stufe gibt es keinen Vergleich',
    "non c'è un confronto di questo livello",
  ],
  'fault.noEditPreviewed': [
    'no edit is previewed',
    'keine Bearbeitung wird vorgezeigt',
    'nessuna modifica è in anteprima',
  ],
  'fault.stationWithoutPoints': [
    'this station has no points',
    'diese Station hat keine Punkte',
    'questa stazione non ha punti',
  ],
  'fault.noScanSurface': [
    'no scan has made a surface yet',
    'noch kein Scan hat eine Oberfläche ergeben',
    'nessuna scansione ha ancora dato una superficie',
  ],
  'fault.noSuchSetup': ['there is no such setup', 'diese Aufspannung gibt es nicht', 'questo piazzamento non esiste'],
  'fault.nameNotEncoded': [
    'the name is not percent-encoded',
    'der Name ist nicht prozentkodiert',
    'il nome non è codificato con percentuali',
  ],
  'fault.noProjectPicture': [
    'this project has no picture',
    'dieses Projekt hat kein Bild',
    "questo progetto non ha un'immagine",
  ],
  'fault.noSuchResource': ['there is no such resource', 'diese Ressource gibt es nicht', 'questa risorsa non esiste'],
  'fault.addressOfMachine': [
    'address: is an IP address of this machine, or nothing to close',
    'nötig ist eine IP-Adresse dieses Rechners, oder nichts, um zu schließen',
    'serve un indirizzo IP di questo computer, o nulla per chiudere',
  ],
  'fault.wrongPassword': ['the password is wrong', 'das Passwort ist falsch', 'la password è sbagliata'],
  'fault.linkUsed': [
    'this link was used already, or is too old; get a new one with `frangia serve --new-link`',
    'dieser Link wurde schon benutzt oder ist zu alt; einen neuen holen',
    'questo link è già stato usato o è troppo vecchio; chiederne uno nuovo',
  ],
  'fault.exceptionWithoutWords': ['an exception without words', 'ein unbekannter Fehler', 'un errore sconosciuto'],
  'fault.noListenAddress': [
    "'{0}' is no IP address to listen on",
    '„{0}“ ist keine IP-Adresse zum Lauschen',
    '«{0}» non è un indirizzo IP su cui ascoltare',
  ],
  'fault.portInUseBySomebody': [
    'port {0} of {1} cannot be used: {2}; choose another one with `port`, or 0 for any',
    'Port {0} von {1} lässt sich nicht benutzen: {2}; einen anderen wählen oder 0 für einen beliebigen',
    "la porta {0} di {1} non si può usare: {2}; sceglierne un'altra o 0 per una qualsiasi",
  ],
  'fault.noSuchAddress': [
    'address: this machine has no such address in a network; choose one of the list',
    'dieser Rechner hat diese Adresse in keinem Netz; eine der Liste wählen',
    "questo computer non ha questo indirizzo in una rete; sceglierne uno dell'elenco",
  ],
  'fault.encryptedOrNot': ['encrypted: is true or false', 'ist wahr oder falsch', 'è vero o falso'],
  'fault.noCertificate': [
    'no certificate can be made for this machine; connect without encryption',
    'für diesen Rechner lässt sich kein Zertifikat erzeugen; unverschlüsselt verbinden',
    'non si può creare un certificato per questo computer; connettersi senza cifratura',
  ],
  'fault.noKey': ['no valid key', 'kein gültiger Schlüssel', 'nessuna chiave valida'],
} as const satisfies Rows;
