import type { Rows } from './rows';

/** Failures and warnings of devices, of the measurement of the display, and of a scan. `tools/check_faults.py` explains them. */
export const FAULTS_CAPTURE = {
  'fault.incompleteFrame': [
    'frame {0} of "{1}" arrived incomplete {2} times ({3}); check its cable and network',
    'Bild {0} von „{1}“ kam {2}-mal unvollständig an ({3}); Kabel und Netz prüfen',
    'il fotogramma {0} di «{1}» è arrivato incompleto {2} volte ({3}); controllare cavo e rete',
  ],
  'fault.frameSize': [
    'its frame is {0} x {1} pixels, but {2}size_px in rig.toml is {3} x {4}; correct one of them',
    'das Bild hat {0} × {1} Pixel, aber {2}size_px in rig.toml ist {3} × {4}; eines davon berichtigen',
    'il fotogramma ha {0} × {1} pixel, ma {2}size_px in rig.toml è {3} × {4}; correggere uno dei due',
  ],
  'fault.angleLost': [
    'its angle was lost and it has no home switch; turn it to 0 by hand and scan again with `table_at_rad` 0, which continues this scan',
    'der Winkel ging verloren, und es gibt keinen Referenzschalter; von Hand auf 0 drehen und den Scan fortsetzen',
    "l'angolo è andato perso e manca l'interruttore di riferimento; girarla a mano su 0 e continuare la scansione",
  ],
  'fault.unknownAngle': [
    'the turntable has no home switch and may have been turned since the scan stopped{0}; state its present angle, or turn it to 0 by hand and state 0',
    'der Drehtisch hat keinen Referenzschalter und wurde vielleicht gedreht, seit der Scan anhielt{0}; seinen Winkel angeben, oder von Hand auf 0 drehen und 0 angeben',
    "la tavola non ha interruttore di riferimento e forse è stata girata da quando la scansione si è fermata{0}; indicare l'angolo, oppure girarla a mano su 0 e indicare 0",
  ],
  'fault.notReturned': [
    'the scan is complete, but the turntable did not return to 0: {0}',
    'der Scan ist vollständig, aber der Drehtisch kehrte nicht auf 0 zurück: {0}',
    'la scansione è completa, ma la tavola non è tornata a 0: {0}',
  ],
  'fault.interruptedView': [
    'view {0} was interrupted and is left out',
    'Ansicht {0} wurde unterbrochen und fehlt',
    'la vista {0} è stata interrotta e manca',
  ],
  'fault.viewAgain': [
    'view {0} is captured again: {1}',
    'Ansicht {0} wird noch einmal aufgenommen: {1}',
    'la vista {0} viene ripresa di nuovo: {1}',
  ],
  'fault.damagedFrames': [
    'frames missing or damaged on the disk, captured again: {0}',
    'fehlende oder beschädigte Bilder auf der Platte, neu aufgenommen: {0}',
    'fotogrammi mancanti o danneggiati sul disco, ripresi di nuovo: {0}',
  ],
  'fault.noView': [
    'no view was captured; the same command begins again',
    'keine Ansicht wurde aufgenommen; noch einmal starten',
    'nessuna vista è stata ripresa; avviare di nuovo',
  ],
  'fault.motion': [
    'view {0}: the frames of "{1}" show motion and are captured again',
    'Ansicht {0}: die Bilder von „{1}“ zeigen Bewegung und werden neu aufgenommen',
    'vista {0}: i fotogrammi di «{1}» mostrano movimento e vengono ripresi di nuovo',
  ],
  'fault.viewAssessed': [
    'view {0} of {1} at {2} degrees: {3}',
    'Ansicht {0} von {1} bei {2} Grad: {3}',
    'vista {0} di {1} a {2} gradi: {3}',
  ],
  'fault.viewAt': ['view {0} at {1} degrees: {2}', 'Ansicht {0} bei {1} Grad: {2}', 'vista {0} a {1} gradi: {2}'],
  'fault.nothingMeasured': [
    'nothing measured, check light and exposure',
    'nichts gemessen, Licht und Belichtung prüfen',
    'niente di misurato, controllare luce ed esposizione',
  ],
  'fault.beyondNoise': [
    'frames differ beyond their noise, check the mounting and the light',
    'die Bilder unterscheiden sich stärker als ihr Rauschen, Halterung und Licht prüfen',
    'i fotogrammi differiscono più del rumore, controllare il fissaggio e la luce',
  ],
  'fault.overexposed': [
    'overexposed, shorten or bracket the exposure',
    'überbelichtet, kürzer oder in mehreren Stufen belichten',
    "sovraesposto, accorciare l'esposizione o usarne più di una",
  ],
  'fault.lowContrast': [
    'low contrast, reduce ambient light',
    'wenig Kontrast, Raumlicht verringern',
    "contrasto basso, ridurre la luce dell'ambiente",
  ],
  'fault.cannotDecode': [
    'cannot be decoded: {0}',
    'kann nicht ausgewertet werden: {0}',
    'non si può decodificare: {0}',
  ],
  'fault.jpeg': [
    'the camera delivers JPEGs of quality {0}: the compression adds noise of {1} counts to each pixel, and sigma counts it; a camera with a grey or YUYV format, or a smaller size, gives the full accuracy',
    'die Kamera liefert JPEG der Qualität {0}: die Kompression fügt jedem Pixel {1} Stufen Rauschen hinzu, das Sigma mitzählt; ein Grau- oder YUYV-Format oder ein kleineres Bild gibt die volle Genauigkeit',
    'la camera fornisce JPEG di qualità {0}: la compressione aggiunge a ogni pixel un rumore di {1} livelli, contato in sigma; un formato grigio o YUYV, o un formato più piccolo, dà la piena precisione',
  ],
  'fault.exposureUneven': [
    'exposures of {0} ms see the light of room and display uneven; expose for {1} ms, a whole multiple of the exposure_step_ms of [devices.camera]',
    'Belichtungen von {0} ms sehen Raumlicht und Projektor ungleich; {1} ms belichten, ein ganzes Vielfaches des gemessenen Schritts',
    "esposizioni di {0} ms vedono in modo disuguale la luce dell'ambiente e del proiettore; esporre {1} ms, un multiplo intero del passo misurato",
  ],
  'fault.exposureRange': [
    'the exposure {0} ms is outside the range of {1}, {2} to {3} ms',
    'die Belichtung {0} ms liegt außerhalb des Bereichs von {1}, {2} bis {3} ms',
    "l'esposizione {0} ms è fuori dall'intervallo di {1}, da {2} a {3} ms",
  ],
  'fault.needsCamera': [
    'the rig has no [devices.camera]; add it to rig.toml',
    'der Aufbau hat keine Kamera; eine wählen',
    "l'apparato non ha camera; sceglierne una",
  ],
  'fault.needsTable': [
    'the rig has no [devices.turntable], which several views need; add it to rig.toml, or set `views` to 1',
    'der Aufbau hat keinen Drehtisch, den mehrere Ansichten brauchen; einen wählen oder eine einzige Ansicht aufnehmen',
    "l'apparato non ha tavola rotante, che più viste richiedono; sceglierne una o riprendere una sola vista",
  ],
  'fault.wantsDisplay': [
    'measuring a display needs [devices.camera] and a digital projector in [devices.fringes]; add them to rig.toml',
    'dafür braucht der Aufbau eine Kamera und einen Projektor; beide wählen',
    'servono una camera e un proiettore; sceglierli',
  ],
  'fault.displayTooDark': [
    'the display lights too few pixels of the camera; put a white sheet of paper where both look, and make it brighter than the room',
    'der Projektor beleuchtet zu wenige Pixel der Kamera; ein weißes Blatt dorthin stellen, wohin beide schauen, heller als der Raum',
    "il proiettore illumina troppo pochi pixel della camera; mettere un foglio bianco dove entrambi guardano, più chiaro dell'ambiente",
  ],
  'fault.noSaturation': [
    'no pixel could be saturated to find the level of white; come closer, or open the aperture',
    'kein Pixel ließ sich sättigen, um den Weißwert zu finden; näher herangehen oder die Blende öffnen',
    'nessun pixel si è potuto saturare per trovare il livello del bianco; avvicinarsi o aprire il diaframma',
  ],
  'fault.fewerBits': [
    'saturated pixels have {0} to {1} of {2} counts: the camera has fewer bits than its numbers, or changes them; correct its pixel format and switch its enhancements off',
    'gesättigte Pixel haben {0} bis {1} von {2} Stufen: die Kamera hat weniger Bits als ihre Zahlen oder ändert sie; Pixelformat berichtigen, Bildverbesserungen abschalten',
    'i pixel saturi hanno da {0} a {1} di {2} livelli: la camera ha meno bit dei suoi numeri o li cambia; correggere il formato dei pixel e disattivare i miglioramenti',
  ],
  'fault.oddFlicker': [
    'the light of the room flickers, but with neither 50 nor 60 Hz; switch it off',
    'das Raumlicht flimmert, aber weder mit 50 noch mit 60 Hz; ausschalten',
    "la luce dell'ambiente sfarfalla, ma né a 50 né a 60 Hz; spegnerla",
  ],
  'fault.flickerHides': [
    "the light of the room flickers in the frames by {0} % of the display's light, too much to see its flashes; darken the room",
    'das Raumlicht flimmert in den Bildern um {0} % des Projektorlichts, zu viel für seine Blitze; den Raum verdunkeln',
    "la luce dell'ambiente sfarfalla del {0} % della luce del proiettore, troppo per vederne i lampi; oscurare la stanza",
  ],
  'fault.tooBright': [
    'exposures of {0} ms, whole periods of the light of {1}, would be too bright: {2}',
    'Belichtungen von {0} ms, ganze Perioden des Lichts von {1}, wären zu hell: {2}',
    'esposizioni di {0} ms, periodi interi della luce di {1}, sarebbero troppo chiare: {2}',
  ],
  'fault.theRoom': ['the room', 'Raum', "dell'ambiente"],
  'fault.closeRoom': [
    'darken the room, or close the aperture',
    'den Raum verdunkeln oder die Blende schließen',
    'oscurare la stanza o chiudere il diaframma',
  ],
  'fault.closeDisplay': [
    'close the aperture, or make the display darker',
    'die Blende schließen oder den Projektor dunkler stellen',
    'chiudere il diaframma o abbassare la luce del proiettore',
  ],
  'fault.noFlashes': [
    'the camera does not follow the flashes of the display, even {0} s after each; show it the lit sheet, fix its exposure, and keep still',
    'die Kamera folgt den Blitzen des Projektors nicht, auch {0} s danach nicht; ihr das beleuchtete Blatt zeigen, ihre Belichtung fest einstellen und stillhalten',
    "la camera non segue i lampi del proiettore, nemmeno {0} s dopo; mostrarle il foglio illuminato, fissarne l'esposizione e non muovere nulla",
  ],
  'fault.latencyChanges': [
    'the latency of display and camera changes from flash to flash; switch off the image enhancement of the projector, and all that is automatic in the camera',
    'die Verzögerung ändert sich von Blitz zu Blitz; am Projektor die Bildverbesserung und an der Kamera alle Automatik abschalten',
    'la latenza cambia da lampo a lampo; disattivare i miglioramenti del proiettore e ogni automatismo della camera',
  ],
  'fault.lateFrames': [
    'frames are late by {0}: the camera has them under way when it is asked; skip_frames drops them',
    'die Bilder kommen um {0} zu spät: die Kamera hat sie schon unterwegs; skip_frames verwirft sie',
    'i fotogrammi arrivano in ritardo di {0}: la camera li ha già in corso; skip_frames li scarta',
  ],
  'fault.noResponse': [
    "the response was not measured, as the light of the room flickers in the frames by {0} % of the display's light; darken the room and measure again",
    'die Kennlinie wurde nicht gemessen, da das Raumlicht um {0} % des Projektorlichts flimmert; den Raum verdunkeln und neu messen',
    "la curva di risposta non è stata misurata, perché la luce dell'ambiente sfarfalla del {0} % di quella del proiettore; oscurare la stanza e misurare di nuovo",
  ],
  'fault.noCoarseFringes': [
    'coarse fringes are not seen; give the display more light',
    'grobe Streifen sind nicht zu sehen; dem Projektor mehr Licht geben',
    'le frange larghe non si vedono; dare più luce al proiettore',
  ],
  'fault.unfocused': [
    'fringes of {0} px keep {1} % of their contrast; focus the projector, then the camera',
    'Streifen von {0} px behalten {1} % ihres Kontrasts; erst den Projektor, dann die Kamera scharf stellen',
    'le frange di {0} px mantengono il {1} % del contrasto; mettere a fuoco il proiettore, poi la camera',
  ],
  'fault.darkZeros': [
    "{0} % of the lit pixels have 0 counts in the dark, where noise is cut off; raise the camera's level of black",
    '{0} % der beleuchteten Pixel haben im Dunkeln 0 Stufen, wo das Rauschen abgeschnitten wird; den Schwarzwert der Kamera anheben',
    'il {0} % dei pixel illuminati ha 0 livelli al buio, dove il rumore è tagliato; alzare il livello del nero della camera',
  ],
  'fault.noFringes': [
    'no fringes are seen, so that their drift cannot be measured: check the light and the exposure, or leave out `wait_for_drift`',
    'keine Streifen zu sehen: Licht und Belichtung prüfen',
    'non si vedono frange: controllare luce ed esposizione',
  ],
  'fault.otherCameraSize': [
    '{0}: this rig is calibrated for a camera of {1} x {2} pixels, but the chosen one has {3} x {4}; choose another one, set its region_px, or create a project for these devices',
    'dieser Aufbau ist für eine Kamera mit {1} × {2} Pixeln kalibriert, die gewählte hat {3} × {4}; eine andere oder einen anderen Modus wählen, oder ein Projekt für diese Geräte anlegen',
    'questo apparato è calibrato per una camera di {1} × {2} pixel, quella scelta ne ha {3} × {4}; sceglierne un’altra o un altro modo, o creare un progetto per questi dispositivi',
  ],
  'fault.otherProjectorSize': [
    '{0}: this rig is calibrated for a projector of {1} x {2} pixels, but the chosen one shows {3} x {4}; choose another one, or create a project for these devices',
    'dieser Aufbau ist für einen Projektor mit {1} × {2} Pixeln kalibriert, der gewählte zeigt {3} × {4}; einen anderen wählen, oder ein Projekt für diese Geräte anlegen',
    'questo apparato è calibrato per un proiettore di {1} × {2} pixel, quello scelto ne mostra {3} × {4}; sceglierne un altro, o creare un progetto per questi dispositivi',
  ],
  'fault.inUse': [
    'is in use by another program; close that one',
    'wird von einem anderen Programm benutzt; dieses schließen',
    'è usata da un altro programma; chiuderlo',
  ],
  'fault.portInUse': [
    'is in use by another program; close that first',
    'wird von einem anderen Programm benutzt; dieses zuerst schließen',
    'è usata da un altro programma; chiuderlo prima',
  ],
  'fault.unplugged': [
    'is unplugged; plug it in and scan again',
    'ist abgesteckt; anstecken und weiter scannen',
    'è scollegata; collegarla e riprendere la scansione',
  ],
  'fault.framesStopped': [
    'its frames stopped ({0}); reconnect it',
    'es kommen keine Bilder mehr ({0}); neu anstecken',
    'i fotogrammi si sono fermati ({0}); ricollegarla',
  ],
  'fault.noFrameUsb': [
    'no frame within {0} s; check that it is plugged in',
    'kein Bild innerhalb von {0} s; prüfen, ob sie angesteckt ist',
    'nessun fotogramma entro {0} s; controllare che sia collegata',
  ],
  'fault.noFrameNetwork': [
    'no frame within {0} s; check its cable and the firewall',
    'kein Bild innerhalb von {0} s; Kabel und Firewall prüfen',
    'nessun fotogramma entro {0} s; controllare cavo e firewall',
  ],
  'fault.noAnswer': [
    'no answer within {0} s; check that the device is on and this is its port',
    'keine Antwort innerhalb von {0} s; prüfen, ob das Gerät an ist und dies sein Anschluss ist',
    'nessuna risposta entro {0} s; controllare che il dispositivo sia acceso e la porta giusta',
  ],
  'fault.cameraDenied': [
    "cannot be opened ({0}); run 'frangia devices' to list the cameras, and check that your user is in the group video",
    'kann nicht geöffnet werden ({0}); prüfen, ob die Kamera angesteckt ist und der Benutzer in der Gruppe video ist',
    "non si può aprire ({0}); controllare che la camera sia collegata e l'utente nel gruppo video",
  ],
  'fault.portDenied': [
    'cannot be opened ({0}); {1}',
    'kann nicht geöffnet werden ({0}); {1}',
    'non si può aprire ({0}); {1}',
  ],
  'fault.dialout': [
    'join the group dialout and log in again',
    'der Gruppe dialout beitreten und neu anmelden',
    'entrare nel gruppo dialout e accedere di nuovo',
  ],
  'fault.notAtBaud': [
    "does not run GRBL: it sent '{0}'; check port and baud",
    'läuft nicht mit GRBL: gesendet wurde „{0}“; Anschluss und Baudrate prüfen',
    'non usa GRBL: ha inviato «{0}»; controllare porta e velocità',
  ],
  'fault.noGreeting': [
    'no greeting from GRBL within {0} s; check the port',
    'keine Begrüßung von GRBL innerhalb von {0} s; den Anschluss prüfen',
    'nessun saluto da GRBL entro {0} s; controllare la porta',
  ],
  'fault.homing': [
    'homing failed; check the home switch',
    'die Referenzfahrt ist gescheitert; den Referenzschalter prüfen',
    "la ricerca del riferimento è fallita; controllare l'interruttore",
  ],
  'fault.noMonitor': [
    'no monitor found; connect the projector',
    'kein Bildschirm gefunden; den Projektor anschließen',
    'nessuno schermo trovato; collegare il proiettore',
  ],
  'fault.scaled': [
    'the desktop scales its image; set the scale to 100 %',
    'der Desktop skaliert das Bild; die Skalierung auf 100 % stellen',
    "il desktop scala l'immagine; impostare la scala al 100 %",
  ],
  'fault.noScreen': [
    'no screen found ({0}); run this in a desktop session, or set DISPLAY',
    'kein Bildschirm gefunden ({0}); in einer Desktop-Sitzung starten',
    'nessuno schermo trovato ({0}); avviare in una sessione desktop',
  ],
  'fault.autofocus': [
    'its autofocus was on and is now off, also after the scan; calibrate it with this focus',
    'ihr Autofokus war an und ist jetzt aus, auch nach dem Scan; mit diesem Fokus kalibrieren',
    'la messa a fuoco automatica era attiva e ora è spenta, anche dopo la scansione; calibrare con questo fuoco',
  ],
  'fault.jpegFell': [
    'its JPEG quality fell from {0} to {1}; use a smaller size',
    'ihre JPEG-Qualität fiel von {0} auf {1}; ein kleineres Bild wählen',
    'la qualità JPEG è scesa da {0} a {1}; usare un formato più piccolo',
  ],
} as const satisfies Rows;
