import type { Rows } from './rows';

/** Failures and warnings of the places of views. `tools/check_faults.py` explains them. */
export const FAULTS_REGISTRATION = {
  'fault.viewsBeingEvenly': [
    ', the views being evenly spaced in time, as the scan states no times',
    ', wobei die Ansichten gleichmäßig in der Zeit liegen, da der Scan keine Zeiten angibt',
    ', con le viste equidistanti nel tempo, dato che la scansione non indica i tempi',
  ],
  'fault.betweenViews': ['between views {0} and {1}', 'zwischen den Ansichten {0} und {1}', 'fra le viste {0} e {1}'],
  'fault.rigTableStated': [
    'rig and table are as stated',
    'Aufbau und Tisch sind wie angegeben',
    'apparato e tavola sono come indicato',
  ],
  'fault.turntableSAxis': [
    "the turntable's axis or angles are farther from what the rig states than its standard deviations",
    'Achse oder Winkel des Drehtischs liegen weiter von den Angaben des Aufbaus als deren Standardabweichungen',
    "l'asse o gli angoli della tavola distano da quanto indica l'apparato più delle sue deviazioni standard",
  ],
  'fault.tableLostStep': [
    'the table lost a step or the part turned about the axis, by {0}°, {1}',
    'der Tisch verlor einen Schritt, oder das Teil drehte sich um die Achse, um {0}°, {1}',
    "la tavola ha perso un passo o il pezzo è ruotato attorno all'asse, di {0}°, {1}",
  ],
  'fault.tableTurnsTimes': [
    'the table turns by {0} times the commanded angles',
    'der Tisch dreht um das {0}-Fache der befohlenen Winkel',
    'la tavola gira di {0} volte gli angoli comandati',
  ],
  'fault.part': ['the part {0} by {1} {2}', 'das Teil {0} um {1} {2}', 'il pezzo {0} di {1} {2}'],
  'fault.partMovedUp': [
    'the part moved by up to {0} {1} and {2}',
    'das Teil bewegte sich um bis zu {0} {1} und {2}',
    'il pezzo si è mosso fino a {0} {1} e {2}',
  ],
  'fault.viewFitsOther': [
    'view {0} fits no other view: the part was elsewhere in it alone, by {1}',
    'Ansicht {0} passt zu keiner anderen: nur in ihr war das Teil anderswo, um {1}',
    "la vista {0} non combacia con nessun'altra: solo lì il pezzo era altrove, di {1}",
  ],
  'fault.viewsPartElsewhere': [
    'in views {0} the part was elsewhere, in each by itself and by up to {1}',
    'in den Ansichten {0} war das Teil anderswo, in jeder für sich und um bis zu {1}',
    'nelle viste {0} il pezzo era altrove, in ciascuna per conto suo e fino a {1}',
  ],
  'fault.partTableMoved': [
    'the part or the table moved {0} during the scan, by {1}{2}',
    'das Teil oder der Tisch bewegte sich {0} während des Scans, um {1}{2}',
    'il pezzo o la tavola si è mosso {0} durante la scansione, di {1}{2}',
  ],
  'fault.everMoreSlowly': ['ever more slowly', 'immer langsamer', 'sempre più lentamente'],
  'fault.tablePartMoved': [
    'table or part moved at random from view to view, with a standard deviation of {0} mm',
    'Tisch oder Teil bewegten sich zufällig von Ansicht zu Ansicht, mit einer Standardabweichung von {0} mm',
    'tavola o pezzo si sono mossi a caso da vista a vista, con una deviazione standard di {0} mm',
  ],
  'fault.rigWhatRig': [
    'the rig is not what rig.toml states, all through the scan ({0})',
    'der Aufbau ist den ganzen Scan hindurch nicht so, wie rig.toml ihn angibt ({0})',
    "l'apparato non è come indica rig.toml, per tutta la scansione ({0})",
  ],
  'fault.projectorCameraDrifted': [
    'projector or camera drifted{0} during the scan ({1}){2}',
    'Projektor oder Kamera drifteten{0} während des Scans ({1}){2}',
    'il proiettore o la camera è andato in deriva{0} durante la scansione ({1}){2}',
  ],
  'fault.everMoreSlowly2': [' ever more slowly', ' immer langsamer', ' sempre più lentamente'],
  'fault.everyViewElsewhere': [
    'every view is elsewhere, by {0} mm between views',
    'jede Ansicht ist anderswo, um {0} mm zwischen Ansichten',
    'ogni vista è altrove, di {0} mm fra le viste',
  ],
  'fault.rigTableStated2': [
    'rig and table as stated',
    'Aufbau und Tisch wie angegeben',
    'apparato e tavola come indicato',
  ],
  'fault.axisAnglesStated': [
    'an axis or angles that are not as stated',
    'eine Achse oder Winkel anders als angegeben',
    'un asse o angoli diversi da quelli indicati',
  ],
  'fault.lostStepTable': [
    'a lost step of the table',
    'ein verlorener Schritt des Tischs',
    'un passo perso della tavola',
  ],
  'fault.anglesAnotherProportion': [
    'angles in another proportion',
    'Winkel in anderem Verhältnis',
    'angoli in altra proporzione',
  ],
  'fault.partSlidOnce': ['a part that slid once', 'ein Teil, das einmal rutschte', 'un pezzo scivolato una volta'],
  'fault.partMovedTwice': ['a part that moved twice', 'ein Teil, das sich zweimal bewegte', 'un pezzo mosso due volte'],
  'fault.partElsewhereOne': [
    'a part that was elsewhere in one view',
    'ein Teil, das in einer Ansicht anderswo war',
    'un pezzo altrove in una vista',
  ],
  'fault.partElsewhereSeveral': [
    'a part that was elsewhere in several views',
    'ein Teil, das in mehreren Ansichten anderswo war',
    'un pezzo altrove in più viste',
  ],
  'fault.partTableMovedSteadily': [
    'a part or table that moved steadily',
    'ein Teil oder Tisch, der sich stetig bewegte',
    'un pezzo o una tavola in moto continuo',
  ],
  'fault.tableWobbles': ['a table that wobbles', 'ein Tisch, der wackelt', 'una tavola che oscilla'],
  'fault.rigStated': [
    'a rig that is not as stated',
    'ein Aufbau anders als angegeben',
    'un apparato diverso da quello indicato',
  ],
  'fault.driftProjectorCamera': [
    'a drift of projector or camera',
    'eine Drift von Projektor oder Kamera',
    'una deriva di proiettore o camera',
  ],
  'fault.viewsEachElsewhere': [
    'views that are each elsewhere',
    'Ansichten, die jede anderswo sind',
    'viste ognuna altrove',
  ],
  'fault.viewsDisagreeMm': [
    'the views disagree by {0} mm because of {1}, but before which views is not decided; what that leaves open is in sigma',
    'die Ansichten weichen um {0} mm voneinander ab wegen {1}, aber vor welchen Ansichten, ist nicht entschieden; was das offen lässt, ist in Sigma',
    'le viste discordano di {0} mm per {1}, ma prima di quali viste non è deciso; ciò che resta aperto è in sigma',
  ],
  'fault.viewsDisagreeMmReason': [
    'the views disagree by {0} mm for a reason that is not decided: {1} or {2}; their difference is in sigma',
    'die Ansichten weichen um {0} mm voneinander ab, und der Grund ist nicht entschieden: {1} oder {2}; ihr Unterschied ist in Sigma',
    'le viste discordano di {0} mm per una ragione non decisa: {1} o {2}; la loro differenza è in sigma',
  ],
  'fault.movesViewsAlike': [
    ', or {0}, which moves the views alike',
    ', oder {0}, was die Ansichten gleich verschiebt',
    ', o {0}, che sposta le viste allo stesso modo',
  ],
  'fault.bothGroupsJoined': [
    '{0}; both groups were joined',
    '{0}; beide Gruppen wurden verbunden',
    '{0}; i due gruppi sono stati uniti',
  ],
  'fault.groupsJoined': [
    '{0}; the groups were joined',
    '{0}; die Gruppen wurden verbunden',
    '{0}; i gruppi sono stati uniti',
  ],
  'fault.theyJoinedSurfaces': [
    '{0}; they were joined by their surfaces',
    '{0}; sie wurden durch ihre Oberflächen verbunden',
    '{0}; sono stati uniti dalle loro superfici',
  ],
  'fault.viewsCorrected': [
    '{0}; the views were corrected for it',
    '{0}; die Ansichten wurden dafür berichtigt',
    '{0}; le viste sono state corrette di conseguenza',
  ],
  'fault.leftOut2': ['{0}; it is left out', '{0}; sie fehlt', '{0}; è esclusa'],
  'fault.calibrateTurntableState': [
    'calibrate the turntable, or state its standard deviations',
    'den Drehtisch kalibrieren oder seine Standardabweichungen angeben',
    'calibrare la tavola rotante o indicarne le deviazioni standard',
  ],
  'fault.checkTableS': [
    "check the table's steps per turn and its load",
    'die Schritte je Umdrehung des Tischs und seine Last prüfen',
    'controllare i passi per giro della tavola e il suo carico',
  ],
  'fault.clampPart': ['clamp the part', 'das Teil festspannen', 'fissare il pezzo'],
  'fault.checkBearingTable': [
    'check the bearing of the table and how the part stands',
    'das Lager des Tischs prüfen, und wie das Teil steht',
    'controllare il cuscinetto della tavola e come sta il pezzo',
  ],
  'fault.calibrateRigAgain2': [
    'calibrate the rig again',
    'den Aufbau neu kalibrieren',
    "calibrare di nuovo l'apparato",
  ],
  'fault.refineRigRefine': [
    'refine the rig by `refine_rig`, or calibrate it',
    'den Aufbau aus dem Scan verfeinern oder kalibrieren',
    "raffinare l'apparato dalla scansione o calibrarlo",
  ],
  'fault.letProjectorWarm': [
    'let camera and projector warm up before a scan, and fasten them',
    'Kamera und Projektor vor einem Scan warmlaufen lassen und befestigen',
    'lasciare scaldare camera e proiettore prima di una scansione, e fissarli',
  ],
  'fault.tiltAxis': ['the tilt of the axis', 'die Neigung der Achse', "l'inclinazione dell'asse"],
  'fault.positionAxis': ['the position of the axis', 'die Lage der Achse', "la posizione dell'asse"],
  'fault.anglesViews': ['the angles of the views', 'die Winkel der Ansichten', 'gli angoli delle viste'],
  'fault.viewsDoOverlap': [
    'the views do not overlap',
    'die Ansichten überlappen nicht',
    'le viste non si sovrappongono',
  ],
  'fault.oneViewAlone': [
    'one view alone cannot be registered: the axis and angles of the rig are kept',
    'eine einzelne Ansicht lässt sich nicht ausrichten: Achse und Winkel des Aufbaus bleiben',
    "una sola vista non si può registrare: restano asse e angoli dell'apparato",
  ],
  'fault.axisMmAngles': [
    'axis {0} mm and {1}°, angles {2}°',
    'Achse {0} mm und {1}°, Winkel {2}°',
    'asse {0} mm e {1}°, angoli {2}°',
  ],
  'fault.viewsAgreeMm': [
    "views agree to {0} mm RMS with the rig's own axis and angles, which are kept because no others fit better; {1} % of the points overlap",
    'die Ansichten stimmen auf {0} mm RMS überein, mit Achse und Winkeln des Aufbaus, die bleiben, weil keine besser passen; {1} % der Punkte überlappen',
    "le viste concordano entro {0} mm RMS con asse e angoli dell'apparato, che restano perché nessun altro combacia meglio; il {1} % dei punti si sovrappone",
  ],
  'fault.viewsAgreeMmRms': [
    'views agree to {0} mm RMS (before: {1} mm), {2} % of the points overlap',
    'die Ansichten stimmen auf {0} mm RMS überein (vorher: {1} mm), {2} % der Punkte überlappen',
    'le viste concordano entro {0} mm RMS (prima: {1} mm), il {2} % dei punti si sovrappone',
  ],
  'fault.axisAnglesRig': [
    'the axis and angles of the rig are kept, and the places of the views rest on them alone',
    'Achse und Winkel des Aufbaus bleiben, und die Lage der Ansichten beruht allein auf ihnen',
    "restano asse e angoli dell'apparato, e la posizione delle viste si basa solo su di essi",
  ],
  'fault.turntableRigToml': [
    '[turntable] of rig.toml states that they are exact',
    '[turntable] in rig.toml gibt sie als exakt an',
    '[turntable] di rig.toml li dichiara esatti',
  ],
  'fault.sigmaCountsStandard': [
    'sigma counts {0} as their standard deviations',
    'Sigma rechnet mit {0} als ihren Standardabweichungen',
    'sigma conta {0} come loro deviazioni standard',
  ],
  'fault.becauseRigToml': [
    ', because rig.toml does not state point_sigma_mm, axis_sigma_deg and angle_sigma_deg of [turntable]',
    ', weil rig.toml in [turntable] kein point_sigma_mm, axis_sigma_deg und angle_sigma_deg angibt',
    ', perché rig.toml non indica point_sigma_mm, axis_sigma_deg e angle_sigma_deg di [turntable]',
  ],
  'fault.nothingVerifies': ['{0}; nothing verifies them', '{0}; nichts prüft sie nach', '{0}; nulla li verifica'],
  'fault.whereViewsOverlap': [
    '{0}; where the views overlap, they disagree by {1} mm, {2} times their noise',
    '{0}; wo die Ansichten überlappen, weichen sie um {1} mm voneinander ab, das {2}-Fache ihres Rauschens',
    '{0}; dove le viste si sovrappongono, discordano di {1} mm, {2} volte il loro rumore',
  ],
  'fault.axisMovedMm': [
    '; the axis moved by {0} mm and {1} degrees, the angles by up to {2} degrees',
    '; die Achse bewegte sich um {0} mm und {1} Grad, die Winkel um bis zu {2} Grad',
    "; l'asse si è spostato di {0} mm e {1} gradi, gli angoli fino a {2} gradi",
  ],
  'fault.fullTurnCloses': [
    '; the full turn closes to {0} degrees (before: {1})',
    '; die volle Drehung schließt auf {0} Grad (vorher: {1})',
    '; il giro completo si chiude entro {0} gradi (prima: {1})',
  ],
  'fault.partPoseFurther': [
    '; the part pose of 1 further setup is refined with them',
    '; die Lage des Teils in 1 weiteren Aufspannung ist mit ihnen verfeinert',
    '; la posa del pezzo in 1 altro piazzamento è raffinata con esse',
  ],
  'fault.partPosesFurther': [
    '; the part poses of {0} further setups are refined with them',
    '; die Lagen des Teils in {0} weiteren Aufspannungen sind mit ihnen verfeinert',
    '; le pose del pezzo in altri {0} piazzamenti sono raffinate con esse',
  ],
  'fault.partDoesDetermine': [
    "; the part does not determine {0}, so the rig's values stay",
    '; das Teil bestimmt {0} nicht, daher bleiben die Werte des Aufbaus',
    "; il pezzo non determina {0}, quindi restano i valori dell'apparato",
  ],
  'fault.twoTargetsCode': [
    'two targets have the code {0}: they are {1} mm apart in {2}; give each target on the part a code of its own',
    'zwei Messmarken haben die Nummer {0}: sie liegen in {2} {1} mm auseinander; jeder Messmarke auf dem Teil eine eigene Nummer geben',
    'due marcatori hanno il codice {0}: distano {1} mm in {2}; dare a ogni marcatore sul pezzo un codice proprio',
  ],
  'fault.tableKnocked': [
    'the table moved by {0}, or camera and projector together, {1}',
    'der Tisch bewegte sich um {0}, oder Kamera und Projektor zusammen, {1}',
    'la tavola si è mossa di {0}, o camera e proiettore insieme, {1}',
  ],
  'fault.rigKnocked': [
    'the {0} moved against the rest of the rig by {1} at the part {2}',
    '{0} bewegte sich gegen den übrigen Aufbau, am Teil um {1}, {2}',
    "{0}: si è mosso rispetto al resto dell'apparato, di {1} sul pezzo, {2}",
  ],
  'fault.aTableKnocked': ['a table that was knocked', 'ein angestoßener Tisch', 'una tavola urtata'],
  'fault.aRigKnocked': [
    'a camera or projector that was knocked',
    'eine angestoßene Kamera oder ein angestoßener Projektor',
    'una camera o un proiettore urtati',
  ],
  'fault.fixTable': [
    'fix the table against the rig',
    'den Tisch gegen den Aufbau festmachen',
    "fissare la tavola rispetto all'apparato",
  ],
  'fault.fixRig': [
    'fix camera and projector, and calibrate the rig again',
    'Kamera und Projektor festmachen und den Aufbau neu kalibrieren',
    "fissare camera e proiettore e calibrare di nuovo l'apparato",
  ],
  'fault.turnAboutAxis': ['its turn about the axis', 'seine Drehung um die Achse', "la sua rotazione attorno all'asse"],
  'fault.shiftAlong': ['its shift along', 'seine Verschiebung längs', 'il suo spostamento lungo'],
  'fault.anglesExchanged': [
    "views {0} have each other's angle",
    'die Ansichten {0} haben jede den Winkel der anderen',
    "le viste {0} hanno l'una l'angolo dell'altra",
  ],
  'fault.anglesEven': [
    'the views are evenly spaced by {0}°, where one angle is stated for all',
    'die Ansichten liegen gleichmäßig {0}° auseinander, angegeben ist ein Winkel für alle',
    'le viste distano regolarmente {0}°, mentre è dichiarato un solo angolo per tutte',
  ],
  'fault.angleOfView': [
    'the angle of view {0} is not the one stated: it is off by {1}°',
    'der Winkel der Ansicht {0} ist nicht der angegebene: er liegt um {1}° daneben',
    "l'angolo della vista {0} non è quello dichiarato: differisce di {1}°",
  ],
  'fault.anglesOfManyViews': [
    'the angles of {0} views are not those stated: they are off by up to {1}°',
    'die Winkel von {0} Ansichten sind nicht die angegebenen: sie liegen um bis zu {1}° daneben',
    'gli angoli di {0} viste non sono quelli dichiarati: differiscono fino a {1}°',
  ],
  'fault.anglesOfViews': [
    'the angles of views {0} are not those stated: they are off by {1}',
    'die Winkel der Ansichten {0} sind nicht die angegebenen: sie liegen um {1} daneben',
    'gli angoli delle viste {0} non sono quelli dichiarati: differiscono di {1}',
  ],
  'fault.otherAngles': [
    'other angles than those stated',
    'andere Winkel als die angegebenen',
    'angoli diversi da quelli dichiarati',
  ],
  'fault.correctAngles': [
    'correct the angles in scan.toml',
    'die Winkel in scan.toml berichtigen',
    'correggere gli angoli in scan.toml',
  ],
  'fault.restsOnStatement': [
    '; the overlap of the views hardly shows {0}: there what the rig states decides, and its standard deviation is in sigma',
    '; die Überlappung der Ansichten zeigt {0} kaum: dort entscheidet die Angabe des Aufbaus, deren Standardabweichung in Sigma steht',
    "; la sovrapposizione delle viste mostra appena {0}: lì decide quanto dichiara l'apparato, il cui scarto tipo è in sigma",
  ],
  'fault.statedAsExact': ['stated as exact', 'als exakt angegeben', 'indicato come esatto'],
} as const satisfies Rows;
