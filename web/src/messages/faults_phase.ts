import type { Rows } from './rows';

/** Failures and warnings of phases and Gray codes. `tools/check_faults.py` explains them. */
export const FAULTS_PHASE = {
  'fault.patternSetShifts': [
    'pattern "{0}": no set of shifts fits the frames within their noise (residual variance {1} counts squared, {2} expected), so the shifts of scan.toml are used',
    'Muster „{0}“: keine Verschiebungen passen innerhalb des Rauschens zu den Bildern (Restvarianz {1} Stufen², erwartet {2}), daher gelten die von scan.toml',
    'pattern «{0}»: nessuno sfasamento combacia con i fotogrammi entro il rumore (varianza residua {1} livelli², attesa {2}), quindi si usano quelli di scan.toml',
  ],
  'fault.patternAlgorithmFrames': [
    'pattern "{0}": algorithm {1}, for {2} frames of {3}',
    'Muster „{0}“: Algorithmus {1}, für {2} Bilder mit {3}',
    'pattern «{0}»: algoritmo {1}, per {2} fotogrammi di {3}',
  ],
  'fault.algorithmMadeFrames': [
    'algorithm "{0}" is made for frames at {1} degrees, and pattern "{2}" has others; change shifts_deg and the coefficients, or choose another algorithm',
    'Algorithmus „{0}“ ist für Bilder bei {1} Grad, Muster „{2}“ hat andere; shifts_deg und die Koeffizienten ändern oder einen anderen Algorithmus wählen',
    "l'algoritmo «{0}» è per fotogrammi a {1} gradi, il pattern «{2}» ne ha altri; cambiare shifts_deg e i coefficienti o scegliere un altro algoritmo",
  ],
  'fault.returnsNegativePhase': [
    'it returns the negative phase; change the sign of the numerator',
    'er gibt die negative Phase; das Vorzeichen des Zählers ändern',
    'dà la fase negativa; cambiare il segno del numeratore',
  ],
  'fault.sumsDoDepend': [
    'its sums do not depend on the phase; check the coefficients and the shifts',
    'seine Summen hängen nicht von der Phase ab; Koeffizienten und Verschiebungen prüfen',
    'le sue somme non dipendono dalla fase; controllare coefficienti e sfasamenti',
  ],
  'fault.resultDependsMean': [
    'its result depends on the mean intensity; each list must sum to zero',
    'sein Ergebnis hängt von der mittleren Helligkeit ab; jede Liste muss die Summe null haben',
    "il risultato dipende dall'intensità media; ogni elenco deve avere somma zero",
  ],
  'fault.twoSumsSine': [
    'its two sums are not the sine and the cosine of one angle: the phase would have an error of up to {0} rad; check the coefficients and the shifts',
    'seine Summen sind nicht Sinus und Kosinus eines Winkels: die Phase hätte einen Fehler bis {0} rad; Koeffizienten und Verschiebungen prüfen',
    'le due somme non sono seno e coseno di un angolo: la fase avrebbe un errore fino a {0} rad; controllare coefficienti e sfasamenti',
  ],
  'fault.shiftsCoefficientsNumerator': [
    'there are {0} shifts, {1} coefficients of the numerator and {2} of the denominator; give one of each for each frame',
    'es gibt {0} Verschiebungen, {1} Koeffizienten des Zählers und {2} des Nenners; für jedes Bild je eines angeben',
    'ci sono {0} sfasamenti, {1} coefficienti del numeratore e {2} del denominatore; darne uno per fotogramma',
  ],
  'fault.algorithmTakesShifts': [
    'the algorithm "{0}" takes {1}, which the {2} shifts of the pattern do not match; {3}',
    'Algorithmus „{0}“ braucht {1}, die {2} Verschiebungen des Musters passen nicht; {3}',
    "l'algoritmo «{0}» richiede {1}, e i {2} sfasamenti del pattern non corrispondono; {3}",
  ],
  'fault.giveLeast': ['give at least 3', 'mindestens 3 angeben', 'darne almeno 3'],
  'fault.algorithmChoose': [
    'there is no algorithm "{0}"; choose from {1}',
    'den Algorithmus „{0}“ gibt es nicht; wählen aus {1}',
    "l'algoritmo «{0}» non esiste; scegliere fra {1}",
  ],
  'fault.phaseCorrectedEdges': [
    'the phase is corrected at edges of brightness for the blur of the camera, {0} px (`ignore_blur` leaves it)',
    'an Helligkeitskanten wird die Phase um die Unschärfe der Kamera berichtigt, {0} px',
    'ai bordi di luminosità la fase è corretta per la sfocatura della camera, {0} px',
  ],
  'fault.cameraSharpensFrames': [
    'the camera sharpens its frames, which shifts the phase at edges of brightness: their noise is that of an unsharp mask of amount {0} and radius {1} px, and the mask is taken out; switch the sharpness of the camera off',
    'die Kamera schärft ihre Bilder nach, was die Phase an Helligkeitskanten verschiebt: ihr Rauschen ist das einer Unscharfmaskierung der Stärke {0} mit einem Radius von {1} px, und diese wird herausgerechnet; die Schärfe der Kamera ausschalten',
    'la camera aumenta la nitidezza dei fotogrammi, il che sposta la fase ai bordi di luminosità: il loro rumore è quello di una maschera di contrasto di intensità {0} e raggio {1} px, che viene tolta; disattivare la nitidezza della camera',
  ],
  'fault.patternComplementEach': [
    'pattern "{0}": {1} {2} and {3} not complement each other, so that one of them is lost, repeated, inverted or in another place; correct the order of the frames, or capture them again',
    'Muster „{0}“: {1} {2} und {3} sind keine Umkehrungen voneinander, also ist eines verloren, wiederholt, umgekehrt oder an anderer Stelle; die Reihenfolge der Bilder berichtigen oder sie neu aufnehmen',
    "pattern «{0}»: {1} {2} e {3} non sono complementari, quindi uno è perso, ripetuto, invertito o fuori posto; correggere l'ordine dei fotogrammi o riprenderli",
  ],
  'fault.inverseDo': ['its inverse do', 'und seine Umkehrung', 'e il suo inverso'],
  'fault.inversesDo': ['their inverses do', 'und ihre Umkehrungen', 'e i loro inversi'],
  'fault.missingFrameFrame': [
    'a missing frame: frame {0} shows no stripes',
    'ein fehlendes Bild: Bild {0} zeigt keine Streifen',
    'un fotogramma mancante: il fotogramma {0} non mostra strisce',
  ],
  'fault.capturePngAgain': ['capture {0}-{1}.png again', '{0}-{1}.png neu aufnehmen', 'riprendere {0}-{1}.png'],
  'fault.patternBordersStripes': [
    'pattern "{0}": at {1} % of the borders of its stripes the number changes by more than one, and no other order of the frames explains it; check bits, code and order in scan.toml',
    'Muster „{0}“: an {1} % der Ränder seiner Streifen ändert sich die Nummer um mehr als eins, und keine andere Reihenfolge der Bilder erklärt es; bits, code und order in scan.toml prüfen',
    'pattern «{0}»: nel {1} % dei bordi delle sue strisce il numero cambia di più di uno, e nessun altro ordine dei fotogrammi lo spiega; controllare bits, code e order in scan.toml',
  ],
  'fault.bitsGrayCode': [
    'has {0} bits; Gray code takes 1 to {1}',
    'hat {0} Bits; Gray-Code hat 1 bis {1}',
    'ha {0} bit; il codice Gray ne ammette da 1 a {1}',
  ],
  'fault.framesInstead': [
    'has {0} frames instead of {1}',
    'hat {0} Bilder statt {1}',
    'ha {0} fotogrammi invece di {1}',
  ],
  'fault.invertedFramesThreshold': [
    'has no inverted frames, and no threshold of the size of its frames is given',
    'hat keine umgekehrten Bilder, und keine Schwelle von der Größe der Bilder ist angegeben',
    'non ha fotogrammi invertiti, e non è data una soglia della grandezza dei fotogrammi',
  ],
  'fault.anotherDirectionFringes': [
    'has another direction than the fringes "{0}"',
    'hat eine andere Richtung als die Streifen „{0}“',
    'ha una direzione diversa dalle frange «{0}»',
  ],
  'fault.stripesPxWider': [
    'its stripes of {0} px are wider than the fringes of "{1}", {2} px; take more bits',
    'seine Streifen von {0} px sind breiter als die von „{1}“, {2} px; mehr Bits nehmen',
    'le sue strisce di {0} px sono più larghe delle frange di «{1}», {2} px; usare più bit',
  ],
  'fault.framesDifferSize': [
    'its frames differ in size from those of the fringes',
    'seine Bilder haben eine andere Größe als die der Streifen',
    'i suoi fotogrammi hanno una grandezza diversa da quelli delle frange',
  ],
  'fault.missingFrameFrameRepeats': [
    'a missing frame: frame {0} repeats frame {1}',
    'ein fehlendes Bild: Bild {0} wiederholt Bild {1}',
    'un fotogramma mancante: il fotogramma {0} ripete il fotogramma {1}',
  ],
  'fault.framesLateOneFrame': [
    'frames that are late by one from frame {0} on',
    'Bilder, die ab Bild {0} um eines zu spät kommen',
    'fotogrammi in ritardo di uno dal fotogramma {0} in poi',
  ],
  'fault.stripesPxPx': [
    'stripes of {0} px, not {1} px',
    'Streifen von {0} px statt {1} px',
    'strisce di {0} px, non {1} px',
  ],
  'fault.periodPxPx': [
    'a period of {0} px, not {1} px',
    'eine Periode von {0} px statt {1} px',
    'un periodo di {0} px, non {1} px',
  ],
  'fault.grayCode2': ['by the Gray code', 'durch den Gray-Code', 'dal codice Gray'],
  'fault.bitsOppositeOrder': [
    'its bits in the opposite order',
    'seine Bits in umgekehrter Reihenfolge',
    "i suoi bit nell'ordine opposto",
  ],
  'fault.otherCode': ['the other code', 'der andere Code', "l'altro codice"],
  'fault.invertedFramesAlternate': [
    'inverted frames that alternate',
    'umgekehrte Bilder im Wechsel',
    'fotogrammi invertiti alternati',
  ],
  'fault.invertedFramesAfter': [
    'inverted frames after the others',
    'umgekehrte Bilder nach den anderen',
    'fotogrammi invertiti dopo gli altri',
  ],
  'fault.framesExchanged2': [
    'frames {0} and {1} exchanged',
    'Bilder {0} und {1} vertauscht',
    'fotogrammi {0} e {1} scambiati',
  ],
  'fault.exchangePngPng': [
    'exchange {0}-{1}.png and {2}-{3}.png',
    '{0}-{1}.png und {2}-{3}.png tauschen',
    'scambiare {0}-{1}.png e {2}-{3}.png',
  ],
  'fault.allFramesInverted': ['all frames inverted', 'alle Bilder umgekehrt', 'tutti i fotogrammi invertiti'],
  'fault.invertAllFrames': ['invert all frames', 'alle Bilder umkehren', 'invertire tutti i fotogrammi'],
  'fault.phaseNeedsLeast': [
    'a phase needs at least 3 shifts, but the pattern has {0}',
    'eine Phase braucht mindestens 3 Verschiebungen, das Muster hat {0}',
    'una fase richiede almeno 3 sfasamenti, ma il pattern ne ha {0}',
  ],
  'fault.shiftsDegDoes': [
    'shifts_deg does not determine a phase: at least three shifts must differ, modulo 360 degrees',
    'shifts_deg bestimmt keine Phase: mindestens drei Verschiebungen müssen verschieden sein, modulo 360 Grad',
    'shifts_deg non determina una fase: almeno tre sfasamenti devono differire, modulo 360 gradi',
  ],
  'fault.patternDisagreesFinest': [
    'pattern "{0}" disagrees with the finest one by {1} rad at {2} % of the pixels, beyond their noise: indirect light (a concave part that lights itself, or scattering below the surface; the finest fringes have {3} % of the modulation of the coarsest); it is counted in sigma; project only fine fringes, as a plan for indirect light proposes',
    'Muster „{0}“ weicht vom feinsten bei {2} % der Pixel um {1} rad ab, mehr als ihr Rauschen: indirektes Licht (ein hohles Teil, das sich selbst beleuchtet, oder Streuung unter der Oberfläche; die feinsten Streifen haben {3} % der Modulation der gröbsten); Sigma zählt es mit; nur feine Streifen projizieren, wie es ein Plan für indirektes Licht vorschlägt',
    'il pattern «{0}» differisce dal più fine di {1} rad nel {2} % dei pixel, oltre il rumore: luce indiretta (un pezzo concavo che illumina sé stesso, o diffusione sotto la superficie; le frange più fini hanno il {3} % della modulazione delle più larghe); sigma ne tiene conto; proiettare solo frange fini, come propone un piano per la luce indiretta',
  ],
  'fault.framesOppositeOrder': [
    'frames in the opposite order',
    'Bilder in umgekehrter Reihenfolge',
    "fotogrammi nell'ordine opposto",
  ],
  'fault.framesBeginFrame': [
    'frames that begin with frame {0} of the declared order',
    'Bilder, die mit Bild {0} der angegebenen Reihenfolge beginnen',
    "fotogrammi che cominciano con il numero {0} dell'ordine indicato",
  ],
  'fault.fringesPerDegree2': ['{0} fringes per degree', '{0} Streifen je Grad', '{0} frange per grado'],
  'fault.periodPx': ['a period of {0} px', 'eine Periode von {0} px', 'un periodo di {0} px'],
  'fault.framesEachOther': [
    'the frames of each other',
    'jeweils die Bilder des anderen',
    "i fotogrammi l'uno dell'altro",
  ],
  'fault.namesBothPatterns': [
    'the names of both patterns exchanged',
    'die Namen beider Muster vertauscht',
    'i nomi di entrambi i pattern scambiati',
  ],
  'fault.same2': [', which is the same as {0}', ', was dasselbe ist wie {0}', ', che è lo stesso di {0}'],
  'fault.framesDoFit': [
    'the frames do not fit scan.toml, and they do not decide what does: {0}',
    'die Bilder passen nicht zu scan.toml, und sie entscheiden nicht, was passt: {0}',
    'i fotogrammi non corrispondono a scan.toml, e non decidono che cosa corrisponde: {0}',
  ],
  'fault.framesPatternDo': [
    'the frames of pattern {0} do not fit its shifts, and no exchange of two frames does; check shifts_deg and the order of the frames',
    'die Bilder des Musters {0} passen nicht zu seinen Verschiebungen, auch nicht nach Tausch zweier Bilder; shifts_deg und die Reihenfolge der Bilder prüfen',
    "i fotogrammi del pattern {0} non corrispondono ai suoi sfasamenti, nemmeno scambiandone due; controllare shifts_deg e l'ordine dei fotogrammi",
  ],
  'fault.patternsPlaceBoth': [
    "the patterns {0} place both ends of the projector's field next to each other on the object; check their starts and periods",
    'nach den Mustern {0} liegen beide Enden des Projektorfelds auf dem Objekt nebeneinander; ihren Beginn und ihre Perioden prüfen',
    "i pattern {0} pongono le due estremità del campo del proiettore una accanto all'altra sull'oggetto; controllarne inizi e periodi",
  ],
  'fault.patternsDisagreeChange': [
    'the patterns {0} disagree, and no change of one start, period, direction or order of frames makes them agree; check scan.toml against what was projected',
    'die Muster {0} widersprechen sich, und keine Änderung eines Beginns, einer Periode, Richtung oder Reihenfolge gleicht sie an; scan.toml mit dem Projizierten vergleichen',
    'i pattern {0} si contraddicono, e nessun cambio di un inizio, periodo, direzione o ordine li accorda; confrontare scan.toml con ciò che fu proiettato',
  ],
  'fault.harmonicFringes': [
    'a {0} harmonic of {1} % of the fringes',
    'eine {0}. Oberschwingung von {1} % der Streifen',
    "un'armonica {0} pari al {1} % delle frange",
  ],
  'fault.hardlyAffectsPhase': [
    '{0}, which hardly affects the phase by this algorithm',
    '{0}, was die Phase bei diesem Algorithmus kaum berührt',
    '{0}, che con questo algoritmo non influisce quasi sulla fase',
  ],
  'fault.shiftsPhaseRad': [
    '{0} shifts the phase by {1} rad rms: the projector or the camera is not linear; measure the response with `frangia response` and give it as `undo_response`, or {2}',
    '{0} verschiebt die Phase um {1} rad rms: Projektor oder Kamera sind nicht linear; die Kennlinie messen und berichtigen lassen, oder {2}',
    '{0} sposta la fase di {1} rad rms: il proiettore o la camera non è lineare; misurare la curva di risposta e farla correggere, o {2}',
  ],
  'fault.setAlgorithmLeast': [
    'set `algorithm` to least-squares',
    'die kleinsten Quadrate als Algorithmus wählen',
    'scegliere i minimi quadrati come algoritmo',
  ],
  'fault.contrastMoreAny': [
    "a contrast of {0} is more than that of any sine: the projector or the camera is not linear, or the camera cuts dark pixels off at 0; measure the response with `frangia response`, and raise the camera's black level",
    'ein Kontrast von {0} ist mehr als der jedes Sinus: Projektor oder Kamera sind nicht linear, oder die Kamera schneidet dunkle Pixel bei 0 ab; die Kennlinie messen und den Schwarzwert der Kamera anheben',
    'un contrasto di {0} è più di quello di qualsiasi seno: il proiettore o la camera non è lineare, o la camera taglia a 0 i pixel scuri; misurare la curva di risposta e alzare il livello del nero',
  ],
  'fault.placeInImage': [
    'columns {0} to {1} and rows {2} to {3}',
    'den Spalten {0} bis {1} und Zeilen {2} bis {3}',
    'colonne da {0} a {1} e righe da {2} a {3}',
  ],
  'fault.framesContradictThere': [
    'pattern "{0}": at {1} % of the measured pixels, most of them in {2}, the frames contradict each other, and these pixels are left out: check that nothing covered the part or shook while they were captured',
    'Muster „{0}“: an {1} % der gemessenen Pixel, die meisten in {2}, widersprechen sich die Bilder, und diese Pixel bleiben weg: prüfen, ob bei der Aufnahme etwas das Teil verdeckte oder wackelte',
    'motivo «{0}»: nel {1} % dei pixel misurati, per lo più in {2}, i fotogrammi si contraddicono, e questi pixel sono esclusi: controllare che durante la ripresa nulla abbia coperto il pezzo o vibrato',
  ],
  'fault.lightFlickeredRms': [
    'the light flickered by {0} % rms between the frames, which is compensated',
    'das Licht flackerte zwischen den Bildern um {0} % rms, was ausgeglichen ist',
    'la luce è variata del {0} % rms fra i fotogrammi, ed è compensata',
  ],
  'fault.lightBands': [
    'pattern "{0}": the light differs from row to row by {1} % rms, in bands that move from frame to frame, as a camera with a rolling shutter sees light that flickers; it is compensated; expose for whole periods of the projector or the lamp',
    'Muster „{0}“: das Licht ist von Zeile zu Zeile um {1} % rms verschieden, in Bändern, die von Bild zu Bild wandern, wie eine Kamera mit Rolling Shutter flackerndes Licht sieht; es ist ausgeglichen; ganze Perioden des Projektors oder der Lampe belichten',
    'pattern "{0}": la luce varia da riga a riga del {1} % rms, in bande che si spostano da un fotogramma all\'altro, come una camera con otturatore rolling vede una luce che sfarfalla; è compensata; esporre per periodi interi del proiettore o della lampada',
  ],
  'fault.compressedFrames': [
    'the frames were compressed with loss before they were stored, as JPEG or MJPEG of quality {0} does it; the noise of {1} counts that this adds is counted in sigma; store them as the camera takes them',
    'die Bilder wurden vor dem Speichern mit Verlust komprimiert, wie JPEG oder MJPEG der Qualität {0} es tut; das Rauschen von {1} Stufen, das so hinzukommt, steckt in Sigma; so speichern, wie die Kamera sie aufnimmt',
    'i fotogrammi sono stati compressi con perdita prima di essere salvati, come fa JPEG o MJPEG di qualità {0}; il rumore di {1} conteggi che ne deriva è contato in sigma; salvarli come li acquisisce la camera',
  ],
  'fault.fewLevels': [
    'the frames hold few levels, {0} counts apart; the noise of {1} counts that this adds is counted in sigma; store them with all bits of the camera',
    'die Bilder haben nur wenige Werte, im Abstand von {0} Stufen; das Rauschen von {1} Stufen, das so hinzukommt, steckt in Sigma; mit allen Bits der Kamera speichern',
    'i fotogrammi hanno pochi livelli, distanti {0} conteggi; il rumore di {1} conteggi che ne deriva è contato in sigma; salvarli con tutti i bit della camera',
  ],
  'fault.frameHoldsBefore': [
    'each frame holds {0} % of the one before it, as a camera delivers them that reduces noise over time; it is taken out; switch that off, or capture each frame several times and keep the last',
    'jedes Bild enthält {0} % des vorigen, wie sie eine Kamera liefert, die Rauschen über die Zeit mindert; es ist herausgerechnet; das abschalten, oder jedes Bild mehrmals aufnehmen und das letzte behalten',
    "ogni fotogramma contiene il {0} % del precedente, come li consegna una camera che riduce il rumore nel tempo; è tolto; disattivare questa funzione, o riprendere ogni fotogramma più volte e tenere l'ultimo",
  ],
  'fault.frameHoldsLightBefore': [
    'each frame holds {0} % of the light of the one before it, as where exposures begin before the projector has switched; it is taken out; leave more time between projecting and exposing',
    'jedes Bild enthält {0} % des Lichts des vorigen, wie wo Belichtungen beginnen, bevor der Projektor gewechselt hat; es ist herausgerechnet; zwischen Projizieren und Belichten mehr Zeit lassen',
    'ogni fotogramma contiene il {0} % della luce del precedente, come dove le esposizioni iniziano prima che il proiettore abbia cambiato; è tolta; lasciare più tempo tra proiezione ed esposizione',
  ],
  'fault.lightShiftsDiffered': [
    'light or shifts that differed between the frames shift the phase by {0} rad rms, which is counted in sigma',
    'Licht oder Verschiebungen, die sich zwischen den Bildern unterschieden, verschieben die Phase um {0} rad rms; Sigma zählt es mit',
    'luce o sfasamenti diversi fra i fotogrammi spostano la fase di {0} rad rms; sigma ne tiene conto',
  ],
  'fault.lightFlickeredBetween': [
    'the light flickered between the frames, which shifts the phase by {0} rad rms; {1} frames do not determine it: take {2} steps or more, or expose for whole periods of the lamp',
    'das Licht flackerte zwischen den Bildern, was die Phase um {0} rad rms verschiebt; {1} Bilder bestimmen es nicht: {2} Schritte oder mehr nehmen oder ganze Perioden der Lampe belichten',
    'la luce è variata fra i fotogrammi e sposta la fase di {0} rad rms; {1} fotogrammi non la determinano: usare {2} passi o più, o esporre per periodi interi della lampada',
  ],
  'fault.responseProjectorCorrected': [
    'the response of the projector is corrected in the phase of {0} {1}: the frames show harmonics of up to {2} % of the fringes (`undo_response`)',
    'die Kennlinie des Projektors ist in der Phase berichtigt, {0} {1}: die Bilder zeigen Oberschwingungen bis {2} % der Streifen',
    'la curva di risposta del proiettore è corretta nella fase, {0} {1}: i fotogrammi mostrano armoniche fino al {2} % delle frange',
  ],
  'fault.stepDegreesNominal': [
    'step {0} +- {1} degrees (nominal {2}), ',
    'Schritt {0} ± {1} Grad (nominell {2}), ',
    'passo {0} ± {1} gradi (nominale {2}), ',
  ],
  'fault.stepJitterDegrees': [
    'step jitter {0} degrees, ',
    'Schrittstreuung {0} Grad, ',
    'dispersione dei passi {0} gradi, ',
  ],
  'fault.contrastMeasuredSaturated': [
    'contrast {0}, {1} % measured, {2} % saturated',
    'Kontrast {0}, {1} % gemessen, {2} % gesättigt',
    'contrasto {0}, {1} % misurati, {2} % saturi',
  ],
  'fault.residualVarianceTimes': [
    ', {0} (residual variance {1} times the noise)',
    ', {0} (Restvarianz das {1}-Fache des Rauschens)',
    ', {0} (varianza residua {1} volte il rumore)',
  ],
  'fault.framesDifferBeyond': [
    'frames differ beyond their noise',
    'die Bilder unterscheiden sich stärker als ihr Rauschen',
    'i fotogrammi differiscono più del rumore',
  ],
} as const satisfies Rows;
