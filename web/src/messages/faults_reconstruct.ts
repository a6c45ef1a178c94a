import type { Rows } from './rows';

/** Failures and warnings of a build. `tools/check_faults.py` explains them. */
export const FAULTS_RECONSTRUCT = {
  'fault.surfaceSampledEvery': [
    'the surface is sampled every {0} mm: the points are {1} mm apart, their sigma is {2} mm',
    'die Oberfläche wird alle {0} mm abgetastet: die Punkte liegen {1} mm auseinander, ihr Sigma ist {2} mm',
    'la superficie è campionata ogni {0} mm: i punti distano {1} mm, il loro sigma è {2} mm',
  ],
  'fault.viewPointsMore': [
    'a view has points more than {0} mm from the origin, too far for voxels of {1} mm; correct the poses or enlarge the voxels',
    'eine Ansicht hat Punkte mehr als {0} mm vom Ursprung, zu weit für Voxel von {1} mm; die Lagen berichtigen oder die Voxel vergrößern',
    "una vista ha punti a più di {0} mm dall'origine, troppo lontani per voxel di {1} mm; correggere le pose o ingrandire i voxel",
  ],
  'fault.indirectLightLooked': [
    'indirect light is not looked for, because the scan holds no fringes',
    'indirektes Licht wird nicht gesucht, weil der Scan keine Streifen enthält',
    'la luce indiretta non viene cercata, perché la scansione non contiene frange',
  ],
  'fault.indirectLightLookedBecause': [
    'indirect light is not looked for, because the projector is a label: its phase is off alike in all cameras, which leaves the points where they are',
    'indirektes Licht wird nicht gesucht, weil der Projektor nur bezeichnet: seine Phase ist in allen Kameras gleich falsch, was die Punkte nicht verschiebt',
    'la luce indiretta non viene cercata, perché il proiettore serve solo da etichetta: la sua fase è sbagliata allo stesso modo in tutte le camere, il che non sposta i punti',
  ],
  'fault.pointsCorrectedIndirect': [
    'points are not corrected for indirect light, because several cameras determine them; sigma counts all of the predicted error',
    'Punkte werden nicht um indirektes Licht berichtigt, weil mehrere Kameras sie bestimmen; Sigma zählt den ganzen vorhergesagten Fehler',
    "i punti non sono corretti per la luce indiretta, perché li determinano più camere; sigma conta tutto l'errore previsto",
  ],
  'fault.pointsCorrectedIndirectLight': [
    'points are not corrected for indirect light, because two directions of fringes determine them; sigma counts all of the predicted error',
    'Punkte werden nicht um indirektes Licht berichtigt, weil zwei Streifenrichtungen sie bestimmen; Sigma zählt den ganzen vorhergesagten Fehler',
    "i punti non sono corretti per la luce indiretta, perché li determinano due direzioni di frange; sigma conta tutto l'errore previsto",
  ],
  'fault.surfaceReachesBeyond': [
    'the surface reaches beyond the silhouettes of the part before the lit background, by {0} mm in the median of {1} places in {2} views: no motion of part or rig explains that, but views that are not where they are taken to be, or a rig of another scale',
    'die Oberfläche ragt über die Silhouetten des Teils vor dem hellen Hintergrund hinaus, um {0} mm im Median an {1} Stellen in {2} Ansichten: keine Bewegung erklärt das, nur Ansichten, die anderswo stehen als angenommen, oder ein Aufbau in anderem Maßstab',
    'la superficie supera le sagome del pezzo davanti allo sfondo chiaro, di {0} mm in mediana in {1} punti di {2} viste: nessun movimento lo spiega, ma viste che non sono dove si suppone, o un apparato di altra scala',
  ],
  'fault.rimsSurfaceLie': [
    'the rims of the surface lie {0} mm {1} the silhouettes in {2} views, 99 % at most {3} mm outside: a surface that is farther out by more than {4} mm is excluded',
    'die Ränder der Oberfläche liegen in {2} Ansichten {0} mm {1} der Silhouetten, 99 % höchstens {3} mm außerhalb: eine Oberfläche, die um mehr als {4} mm weiter außen liegt, ist ausgeschlossen',
    'i bordi della superficie sono a {0} mm {1} delle sagome in {2} viste, il 99 % al massimo {3} mm fuori: una superficie più esterna di oltre {4} mm è esclusa',
  ],
  'fault.filledTrianglesMm': [
    '{0} filled with {1} triangles of {2} mm2 in total; they are not measured and are marked as synthesized',
    '{0} mit {1} Dreiecken gefüllt, zusammen {2} mm²; sie sind nicht gemessen und als ergänzt markiert',
    '{0} riempiti con {1} triangoli, {2} mm² in tutto; non sono misurati e sono contrassegnati come aggiunti',
  ],
  'fault.componentsRemovedIslands': [
    '{0} of {1} components removed: islands of at most {2} mm, {3} triangles in total, which are too small to be told from noise; `keep_islands` keeps them',
    '{0} von {1} Komponenten entfernt: Inseln von höchstens {2} mm, zusammen {3} Dreiecke, die sich nicht vom Rauschen unterscheiden lassen',
    'rimossi {0} di {1} componenti: isole di al massimo {2} mm, {3} triangoli in tutto, troppo piccole per distinguerle dal rumore',
  ],
  'fault.decimatedTrianglesWithin': [
    'decimated to {0} of {1} triangles within {2} mm',
    'auf {0} von {1} Dreiecken ausgedünnt, innerhalb von {2} mm',
    'decimata a {0} di {1} triangoli entro {2} mm',
  ],
  'fault.decimatedTrianglesMost': [
    'decimated to {0} of {1} triangles, at most {2} mm from the original surface',
    'auf {0} von {1} Dreiecken ausgedünnt, höchstens {2} mm von der ursprünglichen Oberfläche',
    'decimata a {0} di {1} triangoli, al massimo {2} mm dalla superficie originale',
  ],
  'fault.aboveBelow': ['above or below', 'über oder unter', 'sopra o sotto'],
  'fault.patternsDoDetermineFringe': [
    '{0}: the patterns do not determine fringe orders, which label the points that two cameras see; capture Gray code or coarser fringes, too',
    '{0}: die Muster bestimmen keine Streifenordnungen, die Punkte zweier Kameras bezeichnen; auch Gray-Code oder gröbere Streifen aufnehmen',
    '{0}: i pattern non determinano gli ordini di frangia, che identificano i punti visti da due camere; riprendere anche un codice Gray o frange più larghe',
  ],
  'fault.scanHoldsNeither': [
    'the scan holds neither an absolute pattern nor the laser sheet: distances are relative to the fringe through the projection axis',
    'der Scan enthält weder ein absolutes Muster noch das Laserblatt: Abstände gelten relativ zum Streifen durch die Projektionsachse',
    "la scansione non contiene né un pattern assoluto né il foglio laser: le distanze sono relative alla frangia sull'asse di proiezione",
  ],
  'fault.fringeOrderPoints': [
    '{0}: the fringe order of {1} of {2} points is unknown; capture a laser sheet, a coarse or Gray-code pattern, or more views that see the same surface',
    '{0}: die Streifenordnung von {1} von {2} Punkten ist unbekannt; ein Laserblatt, ein grobes oder Gray-Code-Muster oder mehr Ansichten derselben Oberfläche aufnehmen',
    "{0}: l'ordine di frangia di {1} punti su {2} è ignoto; riprendere un foglio laser, un pattern largo o in codice Gray, o più viste della stessa superficie",
  ],
  'fault.phasePixelLess': [
    '{0}: the phase of {1} pixel is less certain than `max_sigma`, {2} rad; set a larger one, such as the default of {3} rad',
    '{0}: die Phase von {1} Pixel ist weniger sicher als die Grenze, {2} rad; eine größere zulassen, etwa den Standard {3} rad',
    '{0}: la fase di {1} pixel è meno certa del limite, {2} rad; ammetterne uno maggiore, come il predefinito {3} rad',
  ],
  'fault.pointsDoForm': [
    'its {0} points do not form a surface',
    'seine {0} Punkte bilden keine Oberfläche',
    'i suoi {0} punti non formano una superficie',
  ],
  'fault.firstView': [
    '{0}: {1}; in the first view {2}',
    '{0}: {1}; in der ersten Ansicht {2}',
    '{0}: {1}; nella prima vista {2}',
  ],
  'fault.knownDistanceTarget': [
    'the known distance from target {0} to target {1} is not used: no view saw both',
    'der bekannte Abstand von Messmarke {0} zu {1} wird nicht benutzt: keine Ansicht sah beide',
    'la distanza nota dal marcatore {0} al marcatore {1} non è usata: nessuna vista li ha visti entrambi',
  ],
  'fault.knownDistancesContradict': [
    'the known distances contradict each other: chi squared is {0} for {1} of them; check the codes and the distances in [targets] of scan.toml',
    'die bekannten Abstände widersprechen sich: Chi-Quadrat ist {0} für {1} davon; Nummern und Abstände in [targets] von scan.toml prüfen',
    'le distanze note si contraddicono: il chi quadrato è {0} per {1} di esse; controllare codici e distanze in [targets] di scan.toml',
  ],
  'fault.knownDistanceBetween': [
    'no known distance between targets is used: no view saw both targets of one',
    'kein bekannter Abstand zwischen Messmarken wird benutzt: keine Ansicht sah beide Messmarken eines davon',
    'nessuna distanza nota fra marcatori è usata: nessuna vista ha visto entrambi i marcatori di una',
  ],
  'fault.triangulatedBecauseAccept': [
    '{0}: {1}; triangulated because `accept_inconsistent` is set',
    '{0}: {1}; trotzdem trianguliert, weil es erlaubt ist',
    '{0}: {1}; triangolato comunque, perché è ammesso',
  ],
  'fault.directionUsed': [
    '{0}: {1}; this direction is not used',
    '{0}: {1}; diese Richtung wird nicht benutzt',
    '{0}: {1}; questa direzione non è usata',
  ],
  'fault.nothingFramesDecides': [
    'nothing in the frames decides whether the patterns are those of scan.toml: a wrong start, direction or period would not be noticed',
    'nichts in den Bildern entscheidet, ob die Muster die von scan.toml sind: ein falscher Beginn, eine falsche Richtung oder Periode fiele nicht auf',
    'nulla nei fotogrammi decide se i pattern sono quelli di scan.toml: un inizio, una direzione o un periodo sbagliati non si noterebbero',
  ],
  'fault.nothingTriangulatedCorrect': [
    '{0}: {1}; nothing is triangulated: correct scan.toml, or set `accept_inconsistent`',
    '{0}: {1}; nichts wird trianguliert: scan.toml berichtigen',
    '{0}: {1}; nulla è triangolato: correggere scan.toml',
  ],
  'fault.targetsCommonMatch': [
    '{0} and {1} have {2} targets in common that match in more than one way: move one, or use coded ones',
    '{0} und {1} haben {2} Messmarken gemeinsam, die auf mehr als eine Weise passen: eine versetzen oder codierte nehmen',
    '{0} e {1} hanno in comune {2} marcatori che combaciano in più modi: spostarne uno o usarne di codificati',
  ],
  'fault.joinedTargetsAgree': [
    '{0} is joined to {1} by {2} targets, which agree to {3} mm',
    '{0} ist mit {1} durch {2} Messmarken verbunden, die auf {3} mm übereinstimmen',
    '{0} è unito a {1} da {2} marcatori, che concordano entro {3} mm',
  ],
  'fault.backgroundLeftOut': [
    'what stands still in front of the camera while the part turns (background, {0} mm from the axis and farther) is left out with {1} points; set `keep_background` to keep it',
    'was vor der Kamera stillsteht, während das Teil sich dreht (Hintergrund, ab {0} mm von der Achse), bleibt mit {1} Punkten weg',
    'ciò che sta fermo davanti alla camera mentre il pezzo gira (sfondo, da {0} mm dall’asse in poi) è escluso con {1} punti',
  ],
  'fault.standsStillUndecided': [
    '{0} % of the points stand still in all views, which do not show whether they turn with the table: if they are background, set `clip_radius` to the radius of the part',
    '{0} % der Punkte stehen in allen Ansichten still, und diese zeigen nicht, ob sie sich mit dem Tisch drehen: Hintergrund verdecken oder auf den Radius des Teils begrenzen',
    'il {0} % dei punti sta fermo in tutte le viste, che non mostrano se gira con la tavola: coprire lo sfondo o limitare al raggio del pezzo',
  ],
  'fault.heightMmRemoved': [
    '{0} at a height of {1} mm is removed with {2} points; set `keep_turntable_top` to keep it',
    '{0} in einer Höhe von {1} mm ist mit {2} Punkten entfernt',
    "{0} all'altezza di {1} mm è rimosso con {2} punti",
  ],
  'fault.rimTurntableTop': [
    'the rim of the turntable top, which is seen edge-on,',
    'der Rand der Tischplatte, von der Seite gesehen,',
    'il bordo del piano della tavola, visto di taglio,',
  ],
  'fault.turntableTop': ['the turntable top', 'die Tischplatte', 'il piano della tavola'],
  'fault.pointsRemovedBecause': [
    'points removed because neither the laser sheet nor another view determines their fringe order: {0}',
    'Punkte, die entfernt wurden, weil weder das Laserblatt noch eine andere Ansicht ihre Streifenordnung bestimmt: {0}',
    "punti rimossi perché né il foglio laser né un'altra vista ne determina l'ordine di frangia: {0}",
  ],
  'fault.pointsMovedWhole': [
    'points moved by whole fringes to agree with the other views: {0}',
    'Punkte, die um ganze Streifen verschoben wurden, damit sie zu den anderen Ansichten passen: {0}',
    'punti spostati di frange intere per accordarsi con le altre viste: {0}',
  ],
  'fault.scanTomlPattern': [
    'scan.toml has no pattern of kind "ambient"',
    'scan.toml hat kein Muster der Art "ambient"',
    'scan.toml non ha un pattern di tipo "ambient"',
  ],
  'fault.viewShowsTarget': [
    'no view shows a target of [targets] in scan.toml: check its sizes, whether the discs are dark or light, and that a target spans ten pixels',
    'keine Ansicht zeigt eine Messmarke aus [targets] in scan.toml: ihre Größen prüfen, ob die Scheiben dunkel oder hell sind, und ob eine Messmarke zehn Pixel misst',
    'nessuna vista mostra un marcatore di [targets] in scan.toml: controllarne le grandezze, se i dischi sono scuri o chiari, e che un marcatore copra dieci pixel',
  ],
  'fault.scanTomlTargets': [
    'scan.toml has [targets], which this build without calibration does not find; remove the table, or build with FRANGIA_CALIBRATION',
    'scan.toml hat [targets], die dieses Programm ohne Kalibrierung nicht findet; die Tabelle entfernen',
    'scan.toml ha [targets], che questo programma senza calibrazione non trova; togliere la tabella',
  ],
  'fault.viewsRegistered': [
    'the views are not registered; {0}',
    'die Ansichten sind nicht ausgerichtet; {0}',
    'le viste non sono registrate; {0}',
  ],
  'fault.calibrateRigAgain': [
    'calibrate the rig again, and check the fringes of both with `frangia decode`',
    'den Aufbau neu kalibrieren und die Streifen beider prüfen',
    "calibrare di nuovo l'apparato e controllare le frange di entrambe",
  ],
  'fault.twoDirectionsFringes': [
    'the two directions of fringes',
    'die beiden Streifenrichtungen',
    'le due direzioni di frange',
  ],
  'fault.mmApartMedian': [
    '{0} are {1} mm apart (median), {2} times their noise',
    '{0} liegen {1} mm auseinander (Median), das {2}-Fache ihres Rauschens',
    '{0} distano {1} mm (mediana), {2} volte il loro rumore',
  ],
  'fault.rigConsistent': ['{0}: the rig is consistent', '{0}: der Aufbau ist stimmig', "{0}: l'apparato è coerente"],
  'fault.moreNoiseCalibration': [
    ': more than noise and calibration explain; the difference is in sigma',
    ': mehr als Rauschen und Kalibrierung erklären; der Unterschied ist in Sigma',
    ': più di quanto spieghino rumore e calibrazione; la differenza è in sigma',
  ],
  'fault.contradictEachOther': [
    '{0} contradict each other: they are {1} mm apart (median), {2} times their noise, and {3} % of the pixels are beyond {4} standard deviations of all that is known; {5}',
    '{0} widersprechen sich: sie liegen {1} mm auseinander (Median), das {2}-Fache ihres Rauschens, und {3} % der Pixel liegen jenseits von {4} Standardabweichungen alles Bekannten; {5}',
    '{0} si contraddicono: distano {1} mm (mediana), {2} volte il loro rumore, e il {3} % dei pixel è oltre {4} deviazioni standard di tutto ciò che è noto; {5}',
  ],
  'fault.whatCausesDecided': [
    'what causes it is not decided',
    'die Ursache ist nicht entschieden',
    'la causa non è decisa',
  ],
  'fault.projectorCameraWhat': [
    'the projector or the camera is not what rig.toml states',
    'Projektor oder Kamera sind nicht so, wie rig.toml sie angibt',
    'il proiettore o la camera non è come indicato in rig.toml',
  ],
  'fault.calibrateRigAgainSet': [
    'calibrate the rig again, or set `refine_rig`',
    'den Aufbau neu kalibrieren',
    "calibrare di nuovo l'apparato",
  ],
  'fault.targetSeenSeveral': [
    '{0} target{1}, {2} of them seen by several views',
    '{0} Messmarken, {2} davon in mehreren Ansichten',
    '{0} marcatori, {2} dei quali visti da più viste',
  ],
  'fault.severalSetups': [
    ' and {0} by several setups',
    ' und {0} in mehreren Aufspannungen',
    ' e {0} da più piazzamenti',
  ],
  'fault.whosePlacesAgree': [
    ', whose places agree to {0} mm, {1} times their sigma',
    ', deren Orte auf {0} mm übereinstimmen, das {1}-Fache ihres Sigma',
    ', le cui posizioni concordano entro {0} mm, {1} volte il loro sigma',
  ],
  'fault.knownDistanceScale': [
    '; {0} known distance{1} scale{2} the surface by {3} with a standard uncertainty of {4}',
    '; {0} bekannte Abstände skalieren die Oberfläche um {3} mit einer Standardunsicherheit von {4}',
    "; {0} distanze note scalano la superficie di {3} con un'incertezza standard di {4}",
  ],
  'fault.setupElsewhere': [
    '{0} fits alike {1} mm away, where its surfaces contradict the others less: that pose is taken',
    '{0} passt {1} mm entfernt ebenso gut, und dort widersprechen ihre Flächen den anderen weniger: diese Lage gilt',
    '{0} combacia allo stesso modo a {1} mm, dove le sue superfici contraddicono meno le altre: vale quella posa',
  ],
  'fault.watchedTurn': [
    'the table turned by {0} degrees more or less, or the part on it',
    'der Tisch drehte sich um {0} Grad zu viel oder zu wenig, oder das Teil auf ihm',
    'la tavola è girata di {0} gradi in più o in meno, o il pezzo su di essa',
  ],
  'fault.watchedMove': ['the part moved', 'das Teil bewegte sich', 'il pezzo si è mosso'],
  'fault.watchedMoveBy': [
    'the part moved by {0} mm',
    'das Teil bewegte sich um {0} mm',
    'il pezzo si è mosso di {0} mm',
  ],
  'fault.watchedBefore': [
    '{0} before view {1}; hold it fast, and begin again if it must not be in two parts',
    '{0} vor Ansicht {1}; befestigen Sie es, und beginnen Sie neu, wenn es nicht aus zwei Gruppen bestehen darf',
    '{0} prima della vista {1}; fissatelo, e ricominciate se non deve restare in due gruppi',
  ],
} as const satisfies Rows;
