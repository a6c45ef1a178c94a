import type { Rows } from './rows';

/** Failures and warnings of the frames of a view. `tools/check_faults.py` explains them. */
export const FAULTS_DECODE = {
  'fault.frameShowsFringes': [
    'frame {0} shows no fringes',
    'Bild {0} zeigt keine Streifen',
    'il fotogramma {0} non mostra frange',
  ],
  'fault.frameBlack': ['frame {0} is black', 'Bild {0} ist schwarz', 'il fotogramma {0} è nero'],
  'fault.frameWhite': ['frame {0} is white', 'Bild {0} ist weiß', 'il fotogramma {0} è bianco'],
  'fault.frameShowsInPart': [
    'frame {0} shows no fringes in {1} % of the lit part of the image',
    'Bild {0} zeigt in {1} % des beleuchteten Teils keine Streifen',
    'il fotogramma {0} non mostra frange nel {1} % della parte illuminata',
  ],
  'fault.frameShowsElse': [
    'frame {0} shows something else than the other frames and the other patterns',
    'Bild {0} zeigt etwas anderes als die übrigen Bilder und die anderen Muster',
    'il fotogramma {0} mostra altro rispetto agli altri fotogrammi e agli altri pattern',
  ],
  'fault.framesContradictPatterns': [
    'pattern "{0}": the frames contradict each other and the other patterns, and no known cause explains it',
    'Muster „{0}“: die Bilder widersprechen einander und den anderen Mustern, und keine bekannte Ursache erklärt es',
    'pattern «{0}»: i fotogrammi contraddicono se stessi e gli altri pattern, e nessuna causa nota lo spiega',
  ],
  'fault.partCovered': [
    '{0} % of the lit part of the image is covered or lost in {1}',
    '{0} % des beleuchteten Teils sind verdeckt oder verloren in {1}',
    'il {0} % della parte illuminata è coperto o perso in {1}',
  ],
  'fault.frameDisplaced': [
    'frame {0} is displaced by {1} px against the others, as where the camera or all that is seen shook',
    'Bild {0} ist um {1} px gegen die anderen verschoben, wie wenn die Kamera oder alles Sichtbare wackelte',
    'il fotogramma {0} è spostato di {1} px rispetto agli altri, come se la camera o tutto ciò che vede avesse vibrato',
  ],
  'fault.lightPerFrame': [
    'the light differs from frame to frame, from {0} to {1} of its middle, as where the camera sets its exposure by itself',
    'das Licht ist von Bild zu Bild anders, {0} bis {1} des mittleren, wie wenn die Kamera ihre Belichtung selbst einstellt',
    "la luce cambia da un fotogramma all'altro, da {0} a {1} di quella mediana, come se la camera regolasse l'esposizione da sola",
  ],
  'fault.switchOffExposure': [
    'switch off automatic exposure and gain of the camera, and capture the frames again',
    'automatische Belichtung und Verstärkung der Kamera ausschalten und die Bilder neu aufnehmen',
    'disattivare esposizione e guadagno automatici della camera e riprendere i fotogrammi',
  ],
  'fault.keepLightFree': [
    'keep everything out of the light while the frames are captured',
    'beim Aufnehmen der Bilder alles aus dem Licht halten',
    'tenere tutto fuori dalla luce durante la ripresa',
  ],
  'fault.holdCameraStill': [
    'hold camera and part still while the frames are captured',
    'Kamera und Teil beim Aufnehmen der Bilder stillhalten',
    'tenere fermi camera e pezzo durante la ripresa',
  ],
  'fault.pixelsContradictLeft': [
    '{0}; the pixels where the frames contradict each other are left out; {1}',
    '{0}; die Pixel, an denen sich die Bilder widersprechen, bleiben weg; {1}',
    '{0}; i pixel in cui i fotogrammi si contraddicono sono esclusi; {1}',
  ],
  'fault.correctOrderFrames': [
    'correct the order of the frames',
    'die Reihenfolge der Bilder berichtigen',
    "correggere l'ordine dei fotogrammi",
  ],
  'fault.holdPartStill': [
    'hold the part still while it is captured, and capture the frames again',
    'das Teil beim Aufnehmen stillhalten und die Bilder neu aufnehmen',
    'tenere fermo il pezzo durante la ripresa e riprendere i fotogrammi',
  ],
  'fault.correctShiftsDeg': [
    'correct shifts_deg of scan.toml, or hold rig and part still while they are captured',
    'shifts_deg in scan.toml berichtigen oder Aufbau und Teil beim Aufnehmen stillhalten',
    'correggere shifts_deg in scan.toml o tenere fermi apparato e pezzo durante la ripresa',
  ],
  'fault.keepLightRoom': [
    'keep the light of the room as it is, and capture the frames again',
    'das Raumlicht nicht ändern und die Bilder neu aufnehmen',
    "non cambiare la luce dell'ambiente e riprendere i fotogrammi",
  ],
  'fault.checkFramesThose': [
    'check that the frames are those of this pattern, and that nothing moved',
    'prüfen, ob die Bilder zu diesem Muster gehören und sich nichts bewegt hat',
    'controllare che i fotogrammi siano di questo pattern e che nulla si sia mosso',
  ],
  'fault.captureFramesAgain': [
    'capture the frames again, the projector and the camera in step',
    'die Bilder neu aufnehmen, Projektor und Kamera im Takt',
    'riprendere i fotogrammi, proiettore e camera a tempo',
  ],
  'fault.captureFramesAgain2': ['capture the frames again', 'die Bilder neu aufnehmen', 'riprendere i fotogrammi'],
  'fault.frameRepeatsFrame': [
    'frame {0} repeats frame {1}',
    'Bild {0} wiederholt Bild {1}',
    'il fotogramma {0} ripete il fotogramma {1}',
  ],
  'fault.framesLateOne': [
    'the frames from {0} on are late by one',
    'ab Bild {0} kommen die Bilder um eines zu spät',
    'dal fotogramma {0} in poi i fotogrammi sono in ritardo di uno',
  ],
  'fault.allFramesLate': [
    'all frames are late by {0}: each shows what should be seen {1} before',
    'alle Bilder kommen um {0} zu spät: jedes zeigt, was {1} früher zu sehen sein sollte',
    'tutti i fotogrammi sono in ritardo di {0}: ognuno mostra ciò che si dovrebbe vedere {1} prima',
  ],
  'fault.allFramesEarly': [
    'all frames are early by {0}: each shows what should be seen {1} later',
    'alle Bilder kommen um {0} zu früh: jedes zeigt, was {1} später zu sehen sein sollte',
    'tutti i fotogrammi sono in anticipo di {0}: ognuno mostra ciò che si dovrebbe vedere {1} dopo',
  ],
  'fault.tornAboveBefore': [
    'the frames are torn at about row {0}: above it each shows what should be seen one frame before',
    'die Bilder sind etwa in Zeile {0} zerrissen: darüber zeigt jedes, was ein Bild früher zu sehen sein sollte',
    'i fotogrammi sono spezzati circa alla riga {0}: sopra ognuno mostra ciò che si dovrebbe vedere un fotogramma prima',
  ],
  'fault.tornAboveLater': [
    'the frames are torn at about row {0}: above it each shows what should be seen one frame later',
    'die Bilder sind etwa in Zeile {0} zerrissen: darüber zeigt jedes, was ein Bild später zu sehen sein sollte',
    'i fotogrammi sono spezzati circa alla riga {0}: sopra ognuno mostra ciò che si dovrebbe vedere un fotogramma dopo',
  ],
  'fault.tornBelowBefore': [
    'the frames are torn at about row {0}: below it each shows what should be seen one frame before',
    'die Bilder sind etwa in Zeile {0} zerrissen: darunter zeigt jedes, was ein Bild früher zu sehen sein sollte',
    'i fotogrammi sono spezzati circa alla riga {0}: sotto ognuno mostra ciò che si dovrebbe vedere un fotogramma prima',
  ],
  'fault.tornBelowLater': [
    'the frames are torn at about row {0}: below it each shows what should be seen one frame later',
    'die Bilder sind etwa in Zeile {0} zerrissen: darunter zeigt jedes, was ein Bild später zu sehen sein sollte',
    'i fotogrammi sono spezzati circa alla riga {0}: sotto ognuno mostra ciò che si dovrebbe vedere un fotogramma dopo',
  ],
  'fault.oneFrame': ['one frame', 'ein Bild', 'un fotogramma'],
  'fault.twoFrames': ['two frames', 'zwei Bilder', 'due fotogrammi'],
  'fault.threeFrames': ['three frames', 'drei Bilder', 'tre fotogrammi'],
  'fault.decodedAsShown': [
    '{0}; decoded as what they show',
    '{0}; ausgewertet als das, was sie zeigen',
    '{0}; decodificati per ciò che mostrano',
  ],
  'fault.longerDelay': [
    'capture the frames again with a longer delay_s of the projector',
    'die Bilder mit einem längeren delay_s des Projektors neu aufnehmen',
    'riprendere i fotogrammi con un delay_s del proiettore più lungo',
  ],
  'fault.decodeAsShown': [
    ', or set `accept_remedy` to decode each frame as what it shows',
    ', oder jedes Bild als das auswerten, was es zeigt',
    ', o decodificare ogni fotogramma per ciò che mostra',
  ],
  'fault.frameTimesLight': [
    'frame {0} has {1} times the light',
    'Bild {0} hat das {1}-Fache des Lichts',
    'il fotogramma {0} ha {1} volte la luce',
  ],
  'fault.anotherLampLit': [
    'another lamp lit frame {0} alone',
    'eine andere Lampe beleuchtete nur Bild {0}',
    "un'altra lampada ha illuminato solo il fotogramma {0}",
  ],
  'fault.anotherLampSwitched': [
    'another lamp was switched on or off before frame {0}',
    'vor Bild {0} wurde eine andere Lampe ein- oder ausgeschaltet',
    "prima del fotogramma {0} si è accesa o spenta un'altra lampada",
  ],
  'fault.partMovedWhile': [
    'the part moved while the frames were taken',
    'das Teil bewegte sich, während die Bilder aufgenommen wurden',
    'il pezzo si è mosso durante la ripresa dei fotogrammi',
  ],
  'fault.partOrCameraMoved': [
    'the part or the camera moved while the frames were taken',
    'das Teil oder die Kamera bewegte sich, während die Bilder aufgenommen wurden',
    'il pezzo o la camera si è mosso durante la ripresa dei fotogrammi',
  ],
  'fault.partMovedBefore': [
    'the part moved before frame {0}',
    'das Teil bewegte sich vor Bild {0}',
    'il pezzo si è mosso prima del fotogramma {0}',
  ],
  'fault.shiftsDifferThose': [
    'the shifts differ from those of scan.toml, or all that is seen moved in depth',
    'die Verschiebungen sind andere als in scan.toml, oder alles Sichtbare bewegte sich in der Tiefe',
    'gli sfasamenti non sono quelli di scan.toml, o tutto ciò che si vede si è mosso in profondità',
  ],
  'fault.stepsDifferFactor': [
    'the steps differ from those of scan.toml by one factor, or all that is seen moved evenly in depth',
    'die Schritte weichen um einen Faktor von denen in scan.toml ab, oder alles Sichtbare bewegte sich gleichmäßig in der Tiefe',
    'i passi differiscono da quelli di scan.toml per un fattore, o tutto ciò che si vede si è mosso in modo uniforme in profondità',
  ],
  'fault.shiftsFrameDiffer': [
    'the shifts from frame {0} on differ from those of scan.toml, or all that is seen moved before it',
    'ab Bild {0} sind die Verschiebungen andere als in scan.toml, oder alles Sichtbare bewegte sich davor',
    'dal fotogramma {0} gli sfasamenti non sono quelli di scan.toml, o tutto ciò che si vede si è mosso prima',
  ],
  'fault.shiftsBeginElsewhere': [
    'the shifts begin elsewhere',
    'die Verschiebungen beginnen anderswo',
    'gli sfasamenti cominciano altrove',
  ],
  'fault.shiftsRunOpposite': [
    'the shifts run in the opposite direction',
    'die Verschiebungen laufen in Gegenrichtung',
    'gli sfasamenti vanno nel verso opposto',
  ],
  'fault.framesDescribed': [
    'the frames are as described',
    'die Bilder sind wie angegeben',
    'i fotogrammi sono come indicato',
  ],
  'fault.onePatternNotDescribed': [
    'one pattern is not as described',
    'ein Muster ist nicht wie angegeben',
    'un pattern non è come indicato',
  ],
  'fault.framesDifferFringes': [
    'the frames differ from fringes of these shifts, and no known cause explains it',
    'die Bilder weichen von Streifen mit diesen Verschiebungen ab, und keine bekannte Ursache erklärt es',
    'i fotogrammi differiscono da frange con questi sfasamenti, e nessuna causa nota lo spiega',
  ],
  'fault.framesExchanged': [
    'frames {0} and {1} are exchanged',
    'Bilder {0} und {1} sind vertauscht',
    'i fotogrammi {0} e {1} sono scambiati',
  ],
  'fault.frameOfPatternBefore': [
    'frame 0 shows the last frame of pattern "{0}"',
    'Bild 0 zeigt das letzte Bild von Muster „{0}“',
    "il fotogramma 0 mostra l'ultimo fotogramma del pattern «{0}»",
  ],
  'fault.framesSorted': [
    'the frames are in the alphabetical order of their numbers, 10 before 2',
    'die Bilder sind in der alphabetischen Reihenfolge ihrer Nummern, 10 vor 2',
    "i fotogrammi sono nell'ordine alfabetico dei loro numeri, 10 prima di 2",
  ],
  'fault.orderByNumber': [
    'bring the frames into the order of their numbers',
    'die Bilder in die Reihenfolge ihrer Nummern bringen',
    "mettere i fotogrammi nell'ordine dei loro numeri",
  ],
  'fault.frameDiffersToo': [
    ', and frame {0} differs, too',
    ', und auch Bild {0} weicht ab',
    ', e differisce anche il fotogramma {0}',
  ],
  'fault.patternFramesShow': [
    'pattern "{0}": the frames show no fringes with its shifts, and no known cause explains them; {1}',
    'Muster „{0}“: die Bilder zeigen keine Streifen mit seinen Verschiebungen, und keine bekannte Ursache erklärt es; {1}',
    'pattern «{0}»: i fotogrammi non mostrano frange con i suoi sfasamenti, e nessuna causa nota lo spiega; {1}',
  ],
  'fault.checkTheyFrames': [
    'check that they are the frames of this pattern, and that nothing moved',
    'prüfen, ob es die Bilder dieses Musters sind und sich nichts bewegt hat',
    'controllare che siano i fotogrammi di questo pattern e che nulla si sia mosso',
  ],
  'fault.pixelPhase': ['no pixel has a phase', 'kein Pixel hat eine Phase', 'nessun pixel ha una fase'],
  'fault.fringeOrdersPixels': [
    'fringe orders of {0} pixels corrected and of {1} discarded, at whose border the order jumps although all phases are smooth, as indirect light causes it',
    'Streifenordnungen von {0} Pixeln berichtigt und von {1} verworfen, an deren Rand die Ordnung springt, obwohl alle Phasen glatt sind, wie indirektes Licht es bewirkt',
    "ordini di frangia di {0} pixel corretti e di {1} scartati: al loro bordo l'ordine salta benché tutte le fasi siano continue, come fa la luce indiretta",
  ],
  'fault.grayCodeMeasured': [
    'the Gray code of {0} % of the measured pixels names {1} outside the projector of rig.toml, and they are not measured; check size_px there, and bits, stripe_px and offset_px of the code',
    'der Gray-Code von {0} % der gemessenen Pixel nennt {1} außerhalb des Projektors in rig.toml, sie werden nicht gemessen; dort size_px prüfen, und bits, stripe_px und offset_px des Codes',
    'il codice Gray del {0} % dei pixel misurati indica {1} fuori dal proiettore di rig.toml, e questi non sono misurati; controllare lì size_px, e bits, stripe_px e offset_px del codice',
  ],
  'fault.grayCodeOutside': [
    'the Gray code of {0} % of the measured pixels names {1} outside the projector of rig.toml; check size_px there, and bits, stripe_px and offset_px of the code',
    'der Gray-Code von {0} % der gemessenen Pixel nennt {1} außerhalb des Projektors in rig.toml; dort size_px prüfen, und bits, stripe_px und offset_px des Codes',
    'il codice Gray del {0} % dei pixel misurati indica {1} fuori dal proiettore di rig.toml; controllare lì size_px, e bits, stripe_px e offset_px del codice',
  ],
  'fault.patternsDoDetermine': [
    'the patterns do not determine fringe orders, and the rig has no geometry that does: the phase of each region has an offset of its own',
    'die Muster bestimmen keine Streifenordnungen, und der Aufbau hat keine Geometrie dafür: die Phase jedes Gebiets hat einen eigenen Versatz',
    "i pattern non determinano gli ordini di frangia, e la geometria dell'apparato nemmeno: la fase di ogni regione ha un suo scarto",
  ],
  'fault.acceptRemedyDecodes': [
    '{0}; `accept_remedy` decodes with the shifts that fit',
    '{0}; mit den passenden Verschiebungen lässt sich auswerten, wenn es erlaubt wird',
    '{0}; se lo si ammette, si decodifica con gli sfasamenti che combaciano',
  ],
  'fault.decodedShiftsFit': [
    '{0}; decoded with the shifts that fit',
    '{0}; mit den passenden Verschiebungen ausgewertet',
    '{0}; decodificato con gli sfasamenti che combaciano',
  ],
  'fault.patternPhaseOff': [
    'pattern "{0}": its phase is off by {1} rad RMS along each fringe, as the coarser patterns show, and its frames do not tell why; it is counted in sigma; take five steps or more, which show the frame at fault',
    'Muster „{0}“: wie die gröberen Muster zeigen, liegt seine Phase entlang jedes Streifens um {1} rad RMS daneben, und seine Bilder sagen nicht, warum; Sigma zählt es mit; fünf Schritte oder mehr aufnehmen, die das falsche Bild zeigen',
    'pattern «{0}»: come mostrano i pattern più larghi, la sua fase è sbagliata di {1} rad RMS lungo ogni frangia, e i suoi fotogrammi non dicono perché; sigma ne tiene conto; usare cinque passi o più, che mostrano il fotogramma sbagliato',
  ],
  'fault.framesCutOff': [
    'the frames are cut off at {0} counts, below their white level of {1}: {2} % of the samples are at it and count as saturated; expose shorter, and set white_level = {3} in rig.toml',
    'die Bilder sind bei {0} Stufen abgeschnitten, unter ihrem Weißwert {1}: {2} % der Werte liegen dort und gelten als gesättigt; kürzer belichten und white_level = {3} in rig.toml setzen',
    'i fotogrammi sono tagliati a {0} livelli, sotto il loro livello di bianco {1}: il {2} % dei campioni è lì e conta come saturo; esporre di meno e impostare white_level = {3} in rig.toml',
  ],
  'fault.darkEndCut': [
    'the camera cuts the dark end of the fringes off at {0} counts: {1} % of their samples are at it, and the fringes through the others reach {2} counts below it; the phase follows from the others; raise the black level or the brightness of the camera, or lower its contrast',
    'die Kamera schneidet das dunkle Ende der Streifen bei {0} Stufen ab: {1} % ihrer Werte liegen dort, und die Streifen durch die anderen reichen {2} Stufen darunter; die Phase folgt aus den anderen; Schwarzwert oder Helligkeit der Kamera erhöhen oder ihren Kontrast senken',
    'la camera taglia la parte scura delle frange a {0} livelli: il {1} % dei loro campioni è lì, e le frange per gli altri arrivano {2} livelli più in basso; la fase segue dagli altri; aumentare il livello del nero o la luminosità della camera, o ridurne il contrasto',
  ],
  'fault.leftOutPhase': [
    '{0}; {1} left out, and the phase is computed from the others; {2}',
    '{0}; {1} weggelassen, die Phase folgt aus den anderen; {2}',
    '{0}; {1} esclusi, la fase si calcola dagli altri; {2}',
  ],
  'fault.theseFrames': ['these frames are', 'diese Bilder sind', 'questi fotogrammi sono'],
  'fault.setAcceptRemedy': [
    ', or set `accept_remedy` to decode with shifts_deg = [{0}]',
    ', oder mit shifts_deg = [{0}] auswerten',
    ', o decodificare con shifts_deg = [{0}]',
  ],
  'fault.patternPhasePixels': [
    'pattern "{0}": the phase of {1} % of the pixels is uncertain by more than {2} rad, because the frames differ from fringes with its shifts and no known cause explains it; check that they are the frames of this pattern, and that nothing moved',
    'Muster „{0}“: die Phase von {1} % der Pixel ist um mehr als {2} rad unsicher, weil die Bilder von Streifen mit seinen Verschiebungen abweichen und keine bekannte Ursache es erklärt; prüfen, ob es die Bilder dieses Musters sind und sich nichts bewegt hat',
    'pattern «{0}»: la fase del {1} % dei pixel è incerta di oltre {2} rad, perché i fotogrammi differiscono da frange con i suoi sfasamenti e nessuna causa nota lo spiega; controllare che siano i fotogrammi di questo pattern e che nulla si sia mosso',
  ],
  'fault.yourOwnWrapping': [
    'your own wrapping function returned images of {0} x {1} pixels for pattern "{2}"; return them in the size of the frames, {3} x {4}',
    'die eigene Funktion gab für Muster „{2}“ Bilder mit {0} × {1} Pixeln zurück; sie in der Größe der Aufnahmen zurückgeben, {3} × {4}',
    'la funzione propria ha restituito immagini di {0} × {1} pixel per il pattern «{2}»; restituirle nella grandezza dei fotogrammi, {3} × {4}',
  ],
  'fault.patternOneSaturated': [
    'pattern "{0}": one saturated frame of {1} pixels recovered',
    'Muster „{0}“: ein gesättigtes Bild von {1} Pixeln wiederhergestellt',
    'pattern «{0}»: recuperato un fotogramma saturo di {1} pixel',
  ],
  'fault.scanTomlChoose': [
    'scan.toml has no {0} {1}; choose other `directions`',
    'scan.toml hat keine {0} {1}; andere Richtungen wählen',
    'scan.toml non ha {0} {1}; scegliere altre direzioni',
  ],
  'fault.coarsestMapEach': [
    ' of the coarsest map, each map those of the next finer one',
    ' der gröbsten Karte, jede Karte die der nächstfeineren',
    ' della mappa più larga, ogni mappa quelli della successiva più fine',
  ],
  'fault.yourOwnFunction': [
    'your own function or files give the absolute phase',
    'die eigene Funktion oder Dateien geben die absolute Phase',
    'la funzione propria o i file danno la fase assoluta',
  ],
  'fault.grayCodeGives': [
    'the Gray code gives the orders{0}',
    'der Gray-Code gibt die Ordnungen{0}',
    'il codice Gray dà gli ordini{0}',
  ],
  'fault.grayCodeGivesProjector': [
    "the Gray code gives the projector's {0}",
    'der Gray-Code gibt {0} des Projektors',
    'il codice Gray dà {0} del proiettore',
  ],
  'fault.oneFringeCovers': ['one fringe covers the field', 'ein Streifen deckt das Feld', 'una frangia copre il campo'],
  'fault.eachMapGives': [
    'each map gives the orders of the next finer one, from one fringe over the field on',
    'jede Karte gibt die Ordnungen der nächstfeineren, von einem Streifen über das Feld an',
    'ogni mappa dà gli ordini della successiva più fine, a partire da una frangia sul campo',
  ],
  'fault.allMapsGive': [
    'all maps give the phase, with the most likely of all orders',
    'alle Karten geben die Phase, mit den wahrscheinlichsten Ordnungen',
    'tutte le mappe danno la fase, con gli ordini più probabili',
  ],
  'fault.allMapsGivePhase': [
    'all maps give the phase, with orders level by level over maps and their beats{0}',
    'alle Karten geben die Phase, mit Ordnungen Stufe für Stufe aus Karten und ihren Schwebungen{0}',
    'tutte le mappe danno la fase, con gli ordini livello per livello da mappe e battimenti{0}',
  ],
  'fault.safeEveryPixel': [', safe for every pixel', ', sicher für jeden Pixel', ', sicuro per ogni pixel'],
  'fault.unwrappedSpaceLaser': [
    'unwrapped in space; the laser sheet gives the orders{0}',
    'räumlich entfaltet; das Laserblatt gibt die Ordnungen{0}',
    'srotolata nello spazio; il foglio laser dà gli ordini{0}',
  ],
  'fault.unwrappedSpaceDistance': [
    'unwrapped in space; the distance at which the axes of camera and projector cross gives the orders{0}',
    'räumlich entfaltet; der Abstand, in dem sich die Achsen von Kamera und Projektor kreuzen, gibt die Ordnungen{0}',
    'srotolata nello spazio; la distanza a cui si incrociano gli assi di camera e proiettore dà gli ordini{0}',
  ],
  'fault.unwrappedSpaceNothing': [
    'unwrapped in space; nothing gives the orders, and each region has an offset of its own',
    'räumlich entfaltet; nichts gibt die Ordnungen, und jedes Gebiet hat einen eigenen Versatz',
    'srotolata nello spazio; nulla dà gli ordini, e ogni regione ha un suo scarto',
  ],
  'fault.patternMeanStep': [
    'pattern "{0}": mean step error {1} % over {2} views; {3} % is the phase shifter\'s gain error and is corrected, the rest is scatter',
    'Muster „{0}“: mittlerer Schrittfehler {1} % über {2} Ansichten; {3} % sind der Verstärkungsfehler des Phasenschiebers und werden berichtigt, der Rest streut',
    "pattern «{0}»: errore medio di passo {1} % su {2} viste; il {3} % è l'errore di guadagno dello sfasatore ed è corretto, il resto è dispersione",
  ],
  'fault.same': [', or which is the same, ', ', oder, was dasselbe ist, ', ', o, che è lo stesso, '],
  'fault.ordersByChance': [
    'pattern "{0}": at {1} % of the pixels its phase is off by more than a quarter of a fringe of pattern "{2}", so that the fringe orders are little better than chance; check that they are its frames, in the order of its shifts',
    'Muster „{0}“: bei {1} % der Pixel weicht seine Phase um mehr als ein Viertel eines Streifens des Musters „{2}“ ab, sodass die Streifenordnungen kaum besser als Zufall sind; prüfen Sie, ob es seine Bilder sind, in der Reihenfolge seiner Verschiebungen',
    "motivo «{0}»: nel {1} % dei pixel la sua fase si scosta di più di un quarto di frangia del motivo «{2}», per cui gli ordini di frangia sono poco meglio del caso; verificate che siano le sue immagini, nell'ordine dei suoi sfasamenti",
  ],
} as const satisfies Rows;
