import type { Rows } from './rows';

/** Failures and warnings of alignment and inspection. `tools/check_faults.py` explains them. */
export const FAULTS_INSPECTION = {
  'fault.overlapRmsMm': [
    '{0}{1}: overlap {2} %, RMS {3} mm',
    '{0}{1}: Überlappung {2} %, RMS {3} mm',
    '{0}{1}: sovrapposizione {2} %, RMS {3} mm',
  ],
  'fault.turnedDegreesAbout': [
    ', turned by {0} degrees about ({1}, {2}, {3})',
    ', gedreht um {0} Grad um ({1}, {2}, {3})',
    ', girata di {0} gradi attorno a ({1}, {2}, {3})',
  ],
  'fault.onlyMeshLies': [
    'only {0} % of the mesh lies within {1} mm of the reference in the pose near the given points, and {2} % are needed; choose other points, or leave them out to try every pose',
    'nur {0} % des Netzes liegen in der Lage bei den angegebenen Punkten im Abstand von {1} mm zur Referenz, {2} % sind nötig; andere Punkte wählen oder sie weglassen, um jede Lage zu versuchen',
    'solo il {0} % della mesh è entro {1} mm dal riferimento nella posa presso i punti dati, e serve il {2} %; scegliere altri punti o toglierli per provare ogni posa',
  ],
  'fault.startDoesExist': [
    '`start` {0} does not exist: the mesh fits in {1} pose{2}',
    'die Lage {0} gibt es nicht: das Netz passt in {1} Lagen',
    'la posa {0} non esiste: la mesh combacia in {1} pose',
  ],
  'fault.meshFitsReference': [
    'the mesh fits the reference alike in {0} poses, choose one by `start`: {1}',
    'das Netz passt in {0} Lagen gleich gut auf die Referenz, eine wählen: {1}',
    'la mesh combacia ugualmente con il riferimento in {0} pose, sceglierne una: {1}',
  ],
  'fault.datumDeterminesNothing': [
    'datum "{0}" determines nothing that the datums before it leave free; choose another',
    'der Bezug „{0}“ bestimmt nichts, was die Bezüge davor offen lassen; einen anderen wählen',
    'il riferimento «{0}» non determina nulla che i precedenti lascino libero; sceglierne un altro',
  ],
  'fault.datumSurfaceNominal': [
    'datum "{0}" must be a surface, nominal and measured of one kind',
    'der Bezug „{0}“ muss eine Fläche sein, Soll und Ist von derselben Art',
    'il riferimento «{0}» deve essere una superficie, nominale e misurata dello stesso tipo',
  ],
  'fault.pointsThoseLie': [
    'points: those of the {0} lie on one line, about which the part could turn; choose a point off that line',
    'Punkte: die der Menge {0} liegen auf einer Geraden, um die sich das Teil drehen kann; einen Punkt abseits davon wählen',
    'punti: quelli di {0} stanno su una retta, attorno a cui il pezzo può girare; scegliere un punto fuori dalla retta',
  ],
  'fault.pointsThoseReference': [
    'points: those of the reference are {0} times as far apart as those of the scan; choose the same places, or state the unit of the reference by `units`',
    'Punkte: die der Referenz liegen {0}-mal so weit auseinander wie die des Scans; dieselben Stellen wählen oder die Einheit der Referenz angeben',
    "punti: quelli del riferimento distano {0} volte quelli della scansione; scegliere gli stessi posti o indicare l'unità del riferimento",
  ],
  'fault.pointsAlignmentNeeds': [
    'points: there {0} {1}, and an alignment needs three pairs or more',
    'Punkte: es gibt {1}, eine Ausrichtung braucht drei Paare oder mehr',
    "punti: ce n'è {1}, e un allineamento richiede almeno tre coppie",
  ],
  'fault.pointsPairDoes': [
    'points: pair {0} does not match the others: its points are {1} mm apart after the best motion; choose the same places on both',
    'Punkte: Paar {0} passt nicht zu den anderen: seine Punkte liegen nach der besten Bewegung {1} mm auseinander; auf beiden dieselben Stellen wählen',
    'punti: la coppia {0} non combacia con le altre: dopo il miglior movimento i suoi punti distano {1} mm; scegliere gli stessi posti su entrambi',
  ],
  'fault.aboutThroughMm': ['about {0} through {1} mm', 'um {0} durch {1} mm', 'attorno a {0} per {1} mm'],
  'fault.readUnitMm': [
    'it was read by a unit of {0} mm, and {1} fits: state that by `units`',
    'sie wurde mit der Einheit {0} mm gelesen, und {1} passt: diese Einheit angeben',
    "è stato letto con l'unità {0} mm, e {1} combacia: indicare quella",
  ],
  'fault.referenceMayState': [
    'the reference may be in {0}; state `units` {1}',
    'die Referenz ist vielleicht in {0}; die Einheit {1} angeben',
    "il riferimento può essere in {0}; indicare l'unità {1}",
  ],
  'fault.writeMeshMm': [
    '{0}write the mesh in mm, or state `units` {1}mm',
    '{0}das Netz in mm schreiben oder die Einheit {1}mm angeben',
    "{0}scrivere la mesh in mm o indicare l'unità {1}mm",
  ],
  'fault.meshMay': ['the mesh may be in {0}', 'das Netz ist vielleicht in {0}', 'la mesh può essere in {0}'],
  'fault.meshLiesReference': [
    'the mesh lies on the reference only when the reference is {0} times as large: {1} % within {2} mm then, RMS {3} mm, and {4} % as it is; {5}',
    'das Netz liegt nur dann auf der Referenz, wenn sie {0}-mal so groß ist: dann {1} % im Abstand von {2} mm, RMS {3} mm, so wie sie ist {4} %; {5}',
    "la mesh combacia con il riferimento solo se questo è {0} volte più grande: allora {1} % entro {2} mm, RMS {3} mm, e {4} % così com'è; {5}",
  ],
  'fault.referenceFitsMirror': [
    'the reference fits the mirror image of the mesh: {0} % of the mesh itself lies on it; mirror one of them, or give the part of the other hand as `reference`',
    'die Referenz passt zum Spiegelbild des Netzes: {0} % des Netzes selbst liegen auf ihr; eines von beiden spiegeln oder das Teil der anderen Hand als Referenz nehmen',
    "il riferimento combacia con l'immagine speculare della mesh: vi giace il {0} % della mesh stessa; specchiare uno dei due o usare come riferimento il pezzo dell'altra mano",
  ],
  'fault.onlyMeshLiesWithin': [
    'only {0} % of the mesh lies within {1} mm of the reference in the best pose, and {2} % are needed: it is a reference of another part, or too little of the part was measured',
    'nur {0} % des Netzes liegen in der besten Lage im Abstand von {1} mm zur Referenz, {2} % sind nötig: die Referenz ist die eines anderen Teils, oder vom Teil wurde zu wenig gemessen',
    'solo il {0} % della mesh è entro {1} mm dal riferimento nella posa migliore, e serve il {2} %: è il riferimento di un altro pezzo, o se ne è misurato troppo poco',
  ],
  'fault.chooseAnotherFeature': [
    'a {0} has no {1}; choose another feature or another characteristic',
    '{0} hat kein Merkmal {1}; ein anderes Element oder ein anderes Merkmal wählen',
    "{0} non ha {1}; scegliere un altro elemento o un'altra caratteristica",
  ],
  'fault.relativeDatumName': [
    '{0} is relative to a datum; name one',
    '{0} bezieht sich auf einen Bezug; einen angeben',
    '{0} è relativo a un riferimento; indicarne uno',
  ],
  'fault.surfacePlaneCylinder': [
    'the surface at ({0}, {1}, {2}) is no plane, cylinder, sphere, cone or torus; pick a point there, or another face',
    'die Oberfläche bei ({0}, {1}, {2}) ist weder Ebene noch Zylinder, Kugel, Kegel oder Torus; dort einen Punkt oder eine andere Fläche wählen',
    "la superficie in ({0}, {1}, {2}) non è piano, cilindro, sfera, cono né toro; scegliere lì un punto o un'altra faccia",
  ],
  'fault.wallBehindPoint': [
    'no wall is behind this point: the surface is open there; pick another point',
    'hinter diesem Punkt ist keine Wand: die Oberfläche ist dort offen; einen anderen Punkt wählen',
    "dietro questo punto non c'è parete: lì la superficie è aperta; scegliere un altro punto",
  ],
  'fault.wallBehindPointInclined': [
    'the wall behind this point is inclined by more than 75 degrees; pick another point',
    'die Wand hinter diesem Punkt ist um mehr als 75 Grad geneigt; einen anderen Punkt wählen',
    'la parete dietro questo punto è inclinata oltre 75 gradi; scegliere un altro punto',
  ],
  'fault.diameterPickCylinder': [
    'a {0} has no diameter; pick a cylinder, a sphere, a cone or a torus',
    '{0} hat keinen Durchmesser; einen Zylinder, eine Kugel, einen Kegel oder einen Torus wählen',
    '{0} non ha diametro; scegliere un cilindro, una sfera, un cono o un toro',
  ],
  'fault.angleBetweenTwo': [
    'an angle is between two faces, or at the second of three points',
    'ein Winkel liegt zwischen zwei Flächen oder am zweiten von drei Punkten',
    'un angolo è fra due facce o nel secondo di tre punti',
  ],
  'fault.sphereDirectionMakes': [
    'a sphere has no direction, so it makes no angle; pick another face',
    'eine Kugel hat keine Richtung und bildet keinen Winkel; eine andere Fläche wählen',
    "una sfera non ha direzione, quindi non forma angoli; scegliere un'altra faccia",
  ],
  'fault.twoPointsFaces': ['two points or faces', 'zwei Punkte oder Flächen', 'due punti o facce'],
  'fault.twoFacesThree': ['two faces or three points', 'zwei Flächen oder drei Punkte', 'due facce o tre punti'],
  'fault.surfaceSuchPlace': [
    'the surface has no such place; pick it again',
    'diese Stelle hat die Oberfläche nicht; neu wählen',
    'la superficie non ha questo punto; sceglierlo di nuovo',
  ],
  'fault.meshLiesMm': [
    'the mesh lies {0} mm beside the reference, so that nothing of it can be compared: set `align` to best-fit, or give files of one frame',
    'das Netz liegt {0} mm neben der Referenz, so dass sich nichts vergleichen lässt: durch Einpassen ausrichten oder Dateien in einem Koordinatensystem angeben',
    'la mesh è a {0} mm dal riferimento, così che non si può confrontare nulla: allinearla per adattamento o dare file nello stesso sistema',
  ],
  'fault.pointMeshLies': [
    'no point of the mesh lies within {0} mm of the reference, so that nothing of it can be compared: set `align` to best-fit, check the `units` of the reference, or give files of one frame',
    'kein Punkt des Netzes liegt im Abstand von {0} mm zur Referenz, so dass sich nichts vergleichen lässt: durch Einpassen ausrichten, die Einheit der Referenz prüfen oder Dateien in einem Koordinatensystem angeben',
    "nessun punto della mesh è entro {0} mm dal riferimento, così che non si può confrontare nulla: allinearla per adattamento, controllare l'unità del riferimento o dare file nello stesso sistema",
  ],
  'fault.surfaceJudgedPatches': [
    'the surface is judged by patches of {0} mm and not of {1} mm, of which there would be too many; state a min_feature_mm of {2} mm',
    'die Oberfläche wird nach Flecken von {0} mm beurteilt statt {1} mm, von denen es zu viele gäbe; ein min_feature_mm von {2} mm angeben',
    'la superficie è giudicata per zone di {0} mm e non di {1} mm, che sarebbero troppe; indicare un min_feature_mm di {2} mm',
  ],
  'fault.meshTrianglesWalls': [
    'the mesh has no triangles: it has no walls',
    'das Netz hat keine Dreiecke und damit keine Wände',
    'la mesh non ha triangoli, quindi non ha pareti',
  ],
  'fault.datumNearCheck': [
    '{0}: datum "{1}": there is no {2} near ({3}, {4}, {5}); check its near_mm, in the frame of the reference',
    '{0}: Bezug „{1}“: bei ({3}, {4}, {5}) gibt es kein Element {2}; sein near_mm prüfen, im Koordinatensystem der Referenz',
    "{0}: riferimento «{1}»: non c'è {2} presso ({3}, {4}, {5}); controllare near_mm, nel sistema del riferimento",
  ],
  'fault.liesReferenceAnother': [
    '{0}: {1} % of it lies on the reference; it is another part, or `align` best-fit must find its pose',
    '{0}: {1} % davon liegen auf der Referenz; es ist ein anderes Teil, oder die Lage muss durch Einpassen gefunden werden',
    '{0}: il {1} % giace sul riferimento; è un altro pezzo, o la posa va trovata per adattamento',
  ],
  'fault.partMeshCan': [
    'no part of the mesh can be compared with the reference; vertices left out: {0}; `align` best-fit finds the pose, and `units` states the unit of the reference',
    'kein Teil des Netzes lässt sich mit der Referenz vergleichen; weggelassene Ecken: {0}; Einpassen findet die Lage, oder die Einheit der Referenz angeben',
    "nessuna parte della mesh si può confrontare con il riferimento; vertici esclusi: {0}; l'adattamento trova la posa, oppure indicare l'unità del riferimento",
  ],
  'fault.alignButReference': [
    '{0}: `align` is {1}, but there is no reference to align the mesh to; give one, or leave out `align`',
    '{0}: die Ausrichtung ist {1}, aber es gibt keine Referenz dafür; eine angeben oder ohne Ausrichtung prüfen',
    "{0}: l'allineamento è {1}, ma non c'è un riferimento; darne uno o togliere l'allineamento",
  ],
  'fault.hasNoWidth': [
    'has no width, which no part and no measurement keeps; state [LOWER, UPPER]',
    'hat keine Breite, die kein Teil und keine Messung einhält; [UNTEN, OBEN] angeben',
    'non ha ampiezza, che nessun pezzo e nessuna misura rispetta; indicare [INFERIORE, SUPERIORE]',
  ],
  'fault.uncertaintyOfRow': [
    'undecided: its uncertainty is not known, because too few points were measured; scan it from more stations',
    'unentschieden: die Unsicherheit ist nicht bekannt, weil zu wenige Punkte gemessen sind; von mehr Stationen scannen',
    'indeciso: la sua incertezza non è nota, perché sono stati misurati troppo pochi punti; scansionare da più stazioni',
  ],
  'fault.lowerUpperLower': [
    'must be [LOWER, UPPER], the lower one first',
    'muss [UNTEN, OBEN] sein, die untere Grenze zuerst',
    'deve essere [INFERIORE, SUPERIORE], prima il minore',
  ],
  'fault.statedFaceCad': [
    'is stated by the face of the CAD reference; leave it out',
    'steht in der Fläche der CAD-Referenz; weglassen',
    'è indicato dalla faccia del riferimento CAD; toglierlo',
  ],
  'fault.differenceNominalValue': [
    'is of the difference from the nominal value; state nominal',
    'betrifft die Abweichung vom Nennwert; nominal angeben',
    'riguarda la differenza dal valore nominale; indicare nominal',
  ],
  'fault.zero': ['must not be zero', 'darf nicht null sein', 'non deve essere zero'],
  'fault.largerMinMm': [
    'must be larger than min_mm along x, y and z',
    'muss entlang x, y und z größer als min_mm sein',
    'deve essere maggiore di min_mm lungo x, y e z',
  ],
  'fault.most': ['must be 1 at most', 'darf höchstens 1 sein', 'deve essere al massimo 1'],
  'fault.more': ['must be 0 or more', 'muss 0 oder größer sein', 'deve essere 0 o maggiore'],
  'fault.isItMustBe': [
    'is "{0}"; it must be A4 or Letter',
    'ist „{0}“; möglich sind A4 oder Letter',
    'è «{0}»; deve essere A4 o Letter',
  ],
  'fault.unique': ['"{0}" is not unique', '„{0}“ kommt mehrmals vor', '«{0}» non è unico'],
  'fault.isItMustBe2': ['is "{0}"; it must be {1}', 'ist „{0}“; es muss {1} sein', 'è «{0}»; deve essere {1}'],
  'fault.needsThreePairs': [
    'needs three pairs or more, each with scan_mm and reference_mm',
    'braucht drei Paare oder mehr, jedes mit scan_mm und reference_mm',
    'richiede tre coppie o più, ognuna con scan_mm e reference_mm',
  ],
  'fault.nameOneThree': [
    'must name one to three of [[features]], in their order',
    'muss ein bis drei Namen aus [[features]] nennen, in ihrer Reihenfolge',
    'deve nominare da uno a tre [[features]], nel loro ordine',
  ],
  'fault.namesNameFeatures': [
    'names "{0}", which is no name of [[features]]',
    'nennt „{0}“, keinen Namen aus [[features]]',
    'nomina «{0}», che non è un nome di [[features]]',
  ],
  'fault.refersNameSections': [
    '"{0}" refers to "{1}", which is no name of [[sections]]',
    '„{0}“ bezieht sich auf „{1}“, keinen Namen aus [[sections]]',
    '«{0}» si riferisce a «{1}», che non è un nome di [[sections]]',
  ],
  'fault.refersNameFeatures': [
    '"{0}" refers to "{1}", which is no name of [[features]]',
    '„{0}“ bezieht sich auf „{1}“, keinen Namen aus [[features]]',
    '«{0}» si riferisce a «{1}», che non è un nome di [[features]]',
  ],
  'fault.nothingMeasuredWell': [
    '{0}: nothing was measured well enough there; its value is missing',
    '{0}: dort wurde nichts gut genug gemessen; der Wert fehlt',
    '{0}: lì nulla è misurato abbastanza bene; il valore manca',
  ],
  'fault.needsReferenceGive': [
    '"{0}" is a {1}, which needs a reference; give one, or leave it out of the plan',
    '„{0}“ ist ein Merkmal der Art {1}, das eine Referenz braucht; eine angeben oder es aus dem Plan entfernen',
    '«{0}» è di tipo {1}, che richiede un riferimento; darne uno o toglierlo dal piano',
  ],
  'fault.verticesMeshDo': [
    '{0}: the vertices of the mesh do not cover {1}; inspect the mesh before it is decimated',
    '{0}: die Ecken des Netzes decken {1} nicht ab; das Netz vor dem Ausdünnen prüfen',
    '{0}: i vertici della mesh non coprono {1}; ispezionare la mesh prima di decimarla',
  ],
  'fault.foundNearValues': [
    '{0}: no {1} was found near ({2}, {3}, {4}); its values are missing',
    '{0}: bei ({2}, {3}, {4}) ist kein Element {1} zu finden; seine Werte fehlen',
    '{0}: nessun elemento {1} trovato presso ({2}, {3}, {4}); i suoi valori mancano',
  ],
  'fault.nearestIsThatOf': [
    '{0}: the {1} that is nearest to it is that of {2}; its values are missing; scan it, or correct its near_mm',
    '{0}: das nächste Element {1} gehört zu {2}; seine Werte fehlen; es scannen oder near_mm berichtigen',
    "{0}: l'elemento {1} più vicino è quello di {2}; i suoi valori mancano; scansionarlo o correggere near_mm",
  ],
  'fault.farFromNearMm': [
    '{0}: its values are those of a {1} that is {2} mm from its near_mm; check that it is not another one',
    '{0}: seine Werte sind die eines Elements {1}, das {2} mm von near_mm entfernt ist; prüfen, ob es ein anderes ist',
    '{0}: i suoi valori sono quelli di un elemento {1} che dista {2} mm da near_mm; verificare che non sia un altro',
  ],
  'fault.toleranceMmDiameter': [
    'tolerance_mm is of a diameter, which a {0} does not have; leave it out',
    'tolerance_mm gilt einem Durchmesser, den {0} nicht hat; weglassen',
    'tolerance_mm è di un diametro, che {0} non ha; toglierlo',
  ],
  'fault.toleranceMmDiameterState': [
    'tolerance_mm is of the diameter; state diameter_mm, the nominal size',
    'tolerance_mm gilt dem Durchmesser; diameter_mm, das Nennmaß, angeben',
    'tolerance_mm è del diametro; indicare diameter_mm, la misura nominale',
  ],
  'fault.faceButReference': [
    'face = {0}, but the reference has {1} faces',
    'face = {0}, aber die Referenz hat {1} Flächen',
    'face = {0}, ma il riferimento ha {1} facce',
  ],
  'fault.faceFreeForm': [
    'face {0} is a free-form surface',
    'Fläche {0} ist eine Freiformfläche',
    'la faccia {0} è una superficie a forma libera',
  ],
  'fault.faceButReferenceCad': [
    'face = {0}, but the reference is no CAD model; give a .step or .iges file, or state kind and near_mm',
    'face = {0}, aber die Referenz ist kein CAD-Modell; eine .step- oder .iges-Datei angeben oder kind und near_mm',
    'face = {0}, ma il riferimento non è un modello CAD; dare un file .step o .iges, o indicare kind e near_mm',
  ],
  'fault.measured': ['{0} was not measured', '{0} wurde nicht gemessen', '{0} non è stato misurato'],
  'fault.worst': ['the worst is {0}: {1} {2}', 'am schlechtesten ist {0}: {1} {2}', 'il peggiore è {0}: {1} {2}'],
} as const satisfies Rows;
