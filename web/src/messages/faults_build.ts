import type { Rows } from './rows';

/** Failures and warnings of a build, and refusals of the app. `tools/check_faults.py` explains them. */
export const FAULTS_BUILD = {
  'fault.saturatedPixels': [
    '{0} % of the pixels are saturated; expose shorter, close the aperture, or correct white_level in rig.toml',
    '{0} % der Pixel sind gesättigt; kürzer belichten oder die Blende schließen',
    'il {0} % dei pixel è saturo; esporre di meno o chiudere il diaframma',
  ],
  'fault.darkFrames': [
    'the frames are dark, 99 % of their pixels stay below {0} % of the white level; expose about {1} times longer, open the aperture, add light, or correct white_level in rig.toml',
    'die Bilder sind dunkel, 99 % der Pixel bleiben unter {0} % von Weiß; etwa {1}-mal länger belichten, die Blende öffnen oder mehr Licht geben',
    'i fotogrammi sono scuri, il 99 % dei pixel resta sotto il {0} % del bianco; esporre circa {1} volte di più, aprire il diaframma o aggiungere luce',
  ],
  'fault.noFringesSeen': [
    'no frame shows fringes beyond the noise, although the brightest pixels reach {0} % of the white level; check that the projector shows the patterns in step with the camera, that they are in focus, and that the part is in view',
    'kein Bild zeigt Streifen über dem Rauschen, obwohl die hellsten Pixel {0} % von Weiß erreichen; prüfen, ob der Projektor im Takt mit der Kamera zeigt, ob beide scharf sind und das Teil im Bild steht',
    "nessun fotogramma mostra frange oltre il rumore, benché i pixel più chiari raggiungano il {0} % del bianco; controllare che il proiettore sia a tempo con la camera, il fuoco, e che il pezzo sia nell'immagine",
  ],
  'fault.noPoint': [
    '{0}: no point was measured, and the view is left out: {1} % of its pixels are unmodulated or less certain than `max_sigma`, and {2} % are saturated',
    '{0}: kein Punkt gemessen, die Ansicht fehlt: {1} % ihrer Pixel zeigen keine oder zu unsichere Streifen, {2} % sind gesättigt',
    '{0}: nessun punto misurato, la vista manca: il {1} % dei pixel non ha frange o è troppo incerto, il {2} % è saturo',
  ],
  'fault.noMeasuredPixel': [
    'no view has a measured pixel',
    'keine Ansicht hat einen gemessenen Pixel',
    'nessuna vista ha un pixel misurato',
  ],
  'fault.viewLeftOut': ['{0}: {1}; the view is left out', '{0}: {1}; die Ansicht fehlt', '{0}: {1}; la vista manca'],
  'fault.viewFitsNoOther': [
    'view {0} fits no other view and is left out: check whether the part moved before it was taken',
    'Ansicht {0} passt zu keiner anderen und fehlt: prüfen, ob sich das Teil vorher bewegte',
    'la vista {0} non combacia con nessun’altra e manca: controllare se il pezzo si è mosso prima',
  ],
  'fault.noAxis': [
    '{0}: the views are at different angles, but rig.toml has no [turntable]; find its axis with `frangia calibrate turntable`, by a board or by this scan',
    'die Ansichten stehen in verschiedenen Winkeln, aber die Achse des Drehtischs ist unbekannt; im Schritt Aufbau finden',
    "le viste sono ad angoli diversi, ma l'asse della tavola è ignoto; trovarlo nel passo Apparato",
  ],
  'fault.partShowsNoAxis': [
    'the part does not show the axis of the turntable, because {0}; stand a part without symmetry on the table, or a board',
    'das Teil zeigt die Achse des Drehtischs nicht: {0}; ein Teil ohne Symmetrie oder ein Brett auf den Tisch stellen',
    "il pezzo non mostra l'asse della tavola: {0}; mettere sulla tavola un pezzo senza simmetrie o una scacchiera",
  ],
  'fault.axisOnePose': [
    'its views do not fit together in exactly one pose',
    'seine Ansichten passen nicht in genau einer Lage zusammen',
    'le sue viste non combaciano in una sola posa',
  ],
  'fault.axisNoTurn': [
    'its views fit together in no turn about one axis',
    'seine Ansichten passen bei keiner Drehung um eine Achse zusammen',
    'le sue viste non combaciano in nessuna rotazione attorno a un asse',
  ],
  'fault.axisOpen': ['its shape leaves open {0}', 'seine Form lässt offen: {0}', 'la sua forma lascia aperto: {0}'],
  'fault.axisAngles': [
    'its views have {0} different angles, and an axis needs {1}; capture six stations or more around the part',
    'seine Ansichten haben {0} verschiedene Winkel, und eine Achse braucht {1}; sechs oder mehr Stationen rund um das Teil aufnehmen',
    'le sue viste hanno {0} angoli diversi, e un asse ne richiede {1}; acquisire sei o più stazioni attorno al pezzo',
  ],
  'fault.axisOrders': [
    'its fringe orders rest on the axis that is looked for; capture Gray code or coarser fringes, too',
    'seine Streifenordnungen beruhen auf der gesuchten Achse; auch Gray-Code oder gröbere Streifen aufnehmen',
    "i suoi ordini di frangia si basano sull'asse cercato; acquisire anche il codice Gray o frange più grosse",
  ],
  'fault.axisUnknown': [
    'the axis of the turntable is unknown: find it in step Rig, or scan a single station',
    'die Achse des Drehtischs ist unbekannt: im Schritt Aufbau finden oder eine einzige Station scannen',
    "l'asse della tavola è ignoto: trovarlo nel passo Apparato, o scansionare una sola stazione",
  ],
  'fault.axisStations': [
    'stations: a scan shows the axis from three stations or more, better six or more',
    'ein Scan zeigt die Achse ab drei Stationen, besser ab sechs',
    "una scansione mostra l'asse da tre stazioni in su, meglio da sei",
  ],
  'fault.axisNoScan': [
    'there is no complete scan that could show the axis',
    'es gibt keinen vollständigen Scan, der die Achse zeigen könnte',
    "non c'è una scansione completa che possa mostrare l'asse",
  ],
  'fault.axisKnownAlready': [
    'the axis of the turntable is known already',
    'die Achse des Drehtischs ist schon bekannt',
    "l'asse della tavola è già noto",
  ],
  'fault.wrongDirection': [
    '{0}: its {1} fringes do not measure depth, because the projector of rig.toml stands {2} the camera; capture {3} ones',
    '{0}: diese Streifen messen keine Tiefe, weil der Projektor so zur Kamera steht; die andere Richtung aufnehmen',
    '{0}: queste frange non misurano la profondità, perché il proiettore sta così rispetto alla camera; riprendere l’altra direzione',
  ],
  'fault.notRegistered': [
    'the registration is not trustworthy: {0}; {1} % of the points overlap',
    'die Ansichten passen nicht vertrauenswürdig zusammen: {0}; {1} % der Punkte überlappen',
    'la registrazione non è affidabile: {0}; il {1} % dei punti si sovrappone',
  ],
  'fault.quarterMissing': [
    '{0} of {1} views are left out, more than a quarter: what the surface shows is not the whole scan',
    '{0} von {1} Ansichten fehlen, mehr als ein Viertel: die Fläche zeigt nicht den ganzen Scan',
    'mancano {0} viste di {1}, più di un quarto: la superficie non mostra tutta la scansione',
  ],
  'fault.sideMissing': [
    'a whole side of the part is missing: without the views that are left out, no view looks from {0}° of the turn',
    'eine ganze Seite des Teils fehlt: ohne die fehlenden Ansichten schaut keine aus {0}° der Drehung',
    'manca un intero lato del pezzo: senza le viste escluse nessuna guarda da {0}° del giro',
  ],
  'fault.noSingleCause': [
    'the views disagree by {0} mm, and no single cause explains it: the part moved before several views, or fringe orders are wrong',
    'die Ansichten weichen um {0} mm voneinander ab, und keine Ursache allein erklärt es: das Teil bewegte sich mehrmals, oder Streifenordnungen sind falsch',
    'le viste discordano di {0} mm e nessuna causa da sola lo spiega: il pezzo si è mosso più volte, o gli ordini delle frange sono sbagliati',
  ],
  'fault.viewsContradict': [
    "the views contradict each other, up to {0} % of a view's points lie in front of the surface that another view measured: either the part moved between views, or the rig's calibration is wrong",
    'die Ansichten widersprechen sich, bis zu {0} % der Punkte einer Ansicht liegen vor der Fläche einer anderen: das Teil bewegte sich, oder die Kalibrierung stimmt nicht',
    'le viste si contraddicono, fino al {0} % dei punti di una sta davanti alla superficie di un’altra: il pezzo si è mosso, o la calibrazione è sbagliata',
  ],
  'fault.viewContradictsOthers': [
    'view {0} contradicts the surfaces of the others, which agree without it, and is left out: check that nothing moved while it was captured or covered the part, and that it is in focus',
    'Ansicht {0} widerspricht den Flächen der anderen, die ohne sie übereinstimmen, und bleibt weg: prüfen, ob sich bei ihrer Aufnahme etwas bewegte oder das Teil verdeckte und ob sie scharf ist',
    'la vista {0} contraddice le superfici delle altre, che senza di essa concordano, ed è esclusa: controllare che durante la ripresa nulla si sia mosso o abbia coperto il pezzo e che sia a fuoco',
  ],
  'fault.calibrateTable': [
    'where the views overlap, they disagree by {0} mm, {1} times what noise and the standard deviations of the turntable ({2}) explain: calibrate the turntable',
    'wo die Ansichten überlappen, weichen sie um {0} mm ab, das {1}-Fache dessen, was Rauschen und Drehtisch ({2}) erklären: die Achse neu bestimmen',
    "dove si sovrappongono, le viste discordano di {0} mm, {1} volte quanto spiegano rumore e tavola ({2}): trovare di nuovo l'asse",
  ],
  'fault.weakOverlap': [
    'the {0} % of the points that overlap determine the axis only to {1} mm, and the views may be displaced by more than that: add views between them, or calibrate the rig',
    'die {0} % der Punkte, die überlappen, bestimmen die Achse nur auf {1} mm; Ansichten dazwischen aufnehmen oder den Aufbau kalibrieren',
    "il {0} % dei punti che si sovrappongono determina l'asse solo a {1} mm; aggiungere viste intermedie o calibrare l'apparato",
  ],
  'fault.notTheRig': [
    'the views show that the rig is not what rig.toml states, and do not determine how: calibrate the rig again',
    'die Ansichten zeigen, dass der Aufbau nicht so ist wie kalibriert, aber nicht wie: neu kalibrieren',
    "le viste mostrano che l'apparato non è come calibrato, ma non come sia: calibrarlo di nuovo",
  ],
  'fault.relativeViews': [
    'the views do not fit together: the frames do not tell which fringe is which, so that each view may be off by whole fringes; capture coarser fringes or a Gray code, too, or the laser sheet',
    'die Ansichten passen nicht zusammen: die Bilder sagen nicht, welcher Streifen welcher ist, so dass jede Ansicht um ganze Streifen falsch liegen kann; auch gröbere Streifen oder einen Gray-Code aufnehmen, oder die Laserebene',
    'le viste non combaciano: i fotogrammi non dicono quale frangia sia quale, così ogni vista può essere spostata di frange intere; riprendere anche frange più larghe o un codice Gray, o il piano laser',
  ],
  'fault.copiedView': [
    '{0} and {1} hold the same frames to the last count, so that one of them is a copy; capture both again',
    '{0} und {1} haben auf die letzte Stufe gleiche Bilder, eine ist also eine Kopie; beide neu aufnehmen',
    '{0} e {1} hanno gli stessi fotogrammi, una è quindi una copia; riprenderle entrambe',
  ],
  'fault.uncertainOrders': [
    '{0}: {1}: the fringe orders of most lit pixels are uncertain or jump from pixel to pixel; see the warnings about the patterns, or capture more frames or coarser fringes',
    '{0}: {1}: die Streifenordnungen der meisten beleuchteten Pixel sind unsicher; mehr Bilder oder gröbere Streifen aufnehmen',
    '{0}: {1}: gli ordini delle frange sono incerti per la maggior parte dei pixel; riprendere più fotogrammi o frange più larghe',
  ],
  'fault.checkLight': [
    '{0}: {1}; check light, exposure and white_level',
    '{0}: {1}; Licht und Belichtung prüfen',
    '{0}: {1}; controllare luce ed esposizione',
  ],
  'fault.noSetupPose': [
    '{0} fits the other setups in no unique pose and is left out: add views of the surface that both show, or give its approximate part pose in a [[setup]] of scan.toml',
    '{0} passt zu den anderen Aufspannungen in keiner eindeutigen Lage und fehlt: Ansichten der gemeinsamen Fläche hinzufügen',
    '{0} non combacia in modo univoco con gli altri fissaggi e manca: aggiungere viste della superficie comune',
  ],
  'fault.noSurface': [
    'no surface is left at a voxel of {0} mm, for points that are {1} mm apart: the part is smaller than the voxel, or its points are no neighbours; set a smaller `voxel`',
    'bei einem Voxel von {0} mm bleibt keine Fläche, die Punkte liegen {1} mm auseinander; eine feinere Auflösung wählen',
    'con un voxel di {0} mm non resta superficie, i punti distano {1} mm; scegliere una risoluzione più fine',
  ],
  'fault.voxelMemory': [
    'voxels of {0} mm need {1} GB of memory, more than the {2} GB allowed; voxels of {3} mm fit',
    'Voxel von {0} mm brauchen {1} GB Speicher, mehr als die erlaubten {2} GB; {3} mm passen',
    'voxel di {0} mm richiedono {1} GB di memoria, più dei {2} GB consentiti; {3} mm ci stanno',
  ],
  'fault.openMesh': [
    'the mesh is not watertight: {0} could not be filled',
    'das Netz ist nicht dicht: {0} ließen sich nicht schließen',
    'la mesh non è chiusa: non si sono potuti chiudere {0}',
  ],
  'fault.refined': [
    'the rig is refined by the surfaces of the views, because they say that it is not what rig.toml states',
    'der Aufbau wird an den Flächen der Ansichten nachgestellt, weil sie zeigen, dass er nicht so ist wie kalibriert',
    "l'apparato viene affinato con le superfici delle viste, perché mostrano che non è come calibrato",
  ],
  'fault.untrusted': [
    'do not trust this surface: {0}',
    'dieser Fläche ist nicht zu trauen: {0}',
    'non fidarsi di questa superficie: {0}',
  ],
  'fault.memory': [
    'this does not fit into the memory of the machine',
    'das passt nicht in den Speicher der Maschine',
    'non sta nella memoria della macchina',
  ],
  'fault.taskRuns': [
    'a task is running; stop it, or let it finish, first',
    'eine Aufgabe läuft; erst anhalten oder abwarten',
    "un'attività è in corso; fermarla o attenderla",
  ],
  'fault.scanBegunRig': [
    'the scan has begun with this rig; create a project for another one',
    'der Scan hat mit diesem Aufbau begonnen; für einen anderen ein Projekt anlegen',
    'la scansione è iniziata con questo apparato; creare un progetto per un altro',
  ],
  'fault.scanBegunCalibrate': [
    'the scan has begun with this rig; create a project to calibrate',
    'der Scan hat mit diesem Aufbau begonnen; zum Kalibrieren ein Projekt anlegen',
    'la scansione è iniziata con questo apparato; creare un progetto per calibrare',
  ],
  'fault.setupIncomplete': [
    'the present setup is not complete; finish its scan before the part is turned over',
    'die Aufspannung ist nicht vollständig; erst ihren Scan beenden, dann das Teil umdrehen',
    'il piazzamento non è completo; finirne la scansione prima di girare il pezzo',
  ],
  'fault.noDevices': [
    'this project has no rig with devices; choose them in the step Rig',
    'dieses Projekt hat keinen Aufbau mit Geräten; im Schritt Aufbau wählen',
    'questo progetto non ha un apparato con dispositivi; sceglierli nel passo Apparato',
  ],
  'fault.nothingToExport': [
    'the surface has no triangles to export; undo, or scan again',
    'die Fläche hat keine Dreiecke; zurücknehmen oder neu scannen',
    'la superficie non ha triangoli; annullare o scansionare di nuovo',
  ],
  'fault.diskFull': [
    '{0}: cannot be written; is the disk full?',
    '{0}: kann nicht geschrieben werden; ist die Platte voll?',
    '{0}: non si può scrivere; il disco è pieno?',
  ],
  'fault.projectExists': [
    'there is a project {0} already; write another name',
    'es gibt schon ein Projekt {0}; einen anderen Namen wählen',
    'esiste già un progetto {0}; scegliere un altro nome',
  ],
  'fault.changedSince': [
    'the surface has changed since; measure again',
    'die Fläche hat sich seitdem geändert; neu messen',
    'la superficie nel frattempo è cambiata; misurare di nuovo',
  ],
  'fault.inspectAgain': [
    'the surface has changed; inspect it again',
    'die Fläche hat sich geändert; neu prüfen',
    'la superficie è cambiata; ispezionarla di nuovo',
  ],
  'fault.planChanged': [
    'the plan or the reference has changed; inspect again',
    'der Plan oder die Referenz hat sich geändert; neu prüfen',
    'il piano o il riferimento è cambiato; ispezionare di nuovo',
  ],
} as const satisfies Rows;
