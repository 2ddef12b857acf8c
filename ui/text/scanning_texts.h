/// @file  What the window shows while scanning: bars, status, the panels beside the scene.

// Top bar.
FLYTRI_TEXT(kNoCaseYet, "No case yet", "Noch kein Fall", "Aucun cas", "Sin caso")
FLYTRI_TEXT(kUnnamedCase, "Unnamed case", "Fall ohne Namen", "Cas sans nom", "Caso sin nombre")
FLYTRI_TEXT(kDamagedBadge, "DAMAGED", "BESCHÄDIGT", "ENDOMMAGÉ", "DAÑADO")
FLYTRI_TEXT(kNotSavedBadge, "NOT SAVED", "NICHT GESPEICHERT", "NON ENREGISTRÉ", "SIN GUARDAR")
FLYTRI_TEXT(kReadOnly, "Read-only", "Schreibgeschützt", "Lecture seule", "Solo lectura")
FLYTRI_TEXT(kSaving, "Saving…", "Speichert…", "Enregistrement…", "Guardando…")
FLYTRI_TEXT(kNameItHere, "Name it here", "Hier benennen", "Le nommer ici", "Dar nombre aquí")
FLYTRI_TEXT(kSavedWithoutName, "Saved without a name", "Ohne Namen gespeichert",
            "Enregistré sans nom", "Guardado sin nombre")
FLYTRI_TEXT(kSaved, "Saved", "Gespeichert", "Enregistré", "Guardado")
FLYTRI_TEXT(kCasesHint, "Cases ({0})", "Fälle ({0})", "Cas ({0})", "Casos ({0})")
FLYTRI_TEXT(kStageUpper, "Upper", "Oben", "Haut", "Superior")
FLYTRI_TEXT(kStageLower, "Lower", "Unten", "Bas", "Inferior")
FLYTRI_TEXT(kStageBite, "Bite", "Biss", "Mordu", "Mordida")
FLYTRI_TEXT(kStageBite2, "Bite 2", "Biss 2", "Mordu 2", "Mordida 2")
FLYTRI_TEXT(kFace, "Face", "Gesicht", "Visage", "Cara")
FLYTRI_TEXT(kOtherSide, "Other side", "Gegenseite", "Autre côté", "Otro lado")
FLYTRI_TEXT(kPreop, "Pre-op", "Präop", "Pré-op", "Preop")
FLYTRI_TEXT(kScanBody, "Scan body", "Scanbody", "Scanbody", "Scanbody")
FLYTRI_TEXT(kTime, "Time", "Zeit", "Durée", "Tiempo")
FLYTRI_TEXT(kTimeHint, "Time spent scanning, without pauses.", "Dauer des Scans, ohne Pausen.",
            "Durée du scan, sans les pauses.", "Duración del escaneo, sin las pausas.")
FLYTRI_TEXT(kViews, "Views", "Bilder", "Vues", "Vistas")
FLYTRI_TEXT(kViewsHint, "Camera images that became part of the surface.",
            "Kamerabilder, die Teil der Oberfläche wurden.",
            "Images de la caméra intégrées à la surface.",
            "Imágenes de la cámara que forman parte de la superficie.")
FLYTRI_TEXT(kRejected, "Rejected", "Verworfen", "Rejetées", "Rechazadas")
FLYTRI_TEXT(
    kRejectedHint,
    "Images that show too little, or do not fit the surface. Below a tenth of the views is good. "
    "If there are more, move slowly and stay near what is scanned already.",
    "Bilder, die zu wenig zeigen oder nicht zur Oberfläche passen. Gut ist weniger als ein Zehntel "
    "der Bilder. Bei mehr: langsamer bewegen und nahe am schon Gescannten bleiben.",
    "Images qui montrent trop peu ou ne s’accordent pas avec la surface. Moins d’un dixième des "
    "vues est bon. Au-delà, avancer lentement et rester près de ce qui est déjà scanné.",
    "Imágenes que muestran muy poco o no encajan con la superficie. Menos de una décima parte de "
    "las vistas es bueno. Si hay más, mover despacio y permanecer cerca de lo ya escaneado.")
FLYTRI_TEXT(kDropped, "Dropped", "Ausgelassen", "Omises", "Omitidas")
FLYTRI_TEXT(kDroppedHint,
            "Images that this computer had no time for. 0 is good. If there are more, close other "
            "programs.",
            "Bilder, für die dieser Rechner keine Zeit hatte. Gut ist 0. Bei mehr: andere "
            "Programme schließen.",
            "Images que cet ordinateur n’a pas eu le temps de traiter. 0 est bon. Au-delà, fermer "
            "d’autres programmes.",
            "Imágenes que este ordenador no tuvo tiempo de procesar. 0 es bueno. Si hay más, "
            "cerrar otros programas.")
FLYTRI_TEXT(kWellCovered, "Well covered", "Gut erfasst", "Bien couvert", "Bien cubierto")
FLYTRI_TEXT(kWellCoveredHint,
            "Share of the scanned surface that is measured often enough. Above 90 % is good. The "
            "colors of Coverage show where to scan again.",
            "Anteil der gescannten Oberfläche, der oft genug gemessen ist. Gut ist mehr als 90 %. "
            "Die Farben von „Abdeckung“ zeigen, wo noch einmal zu scannen ist.",
            "Part de la surface scannée qui est mesurée assez souvent. Plus de 90 % est bon. Les "
            "couleurs de « Couverture » montrent où scanner encore.",
            "Parte de la superficie escaneada que se ha medido lo suficiente. Más del 90 % es "
            "bueno. Los colores de «Cobertura» muestran dónde volver a escanear.")

// Bottom bar.
FLYTRI_TEXT(kScan, "Scan", "Scannen", "Scanner", "Escanear")
FLYTRI_TEXT(kPause, "Pause", "Pause", "Pause", "Pausa")
FLYTRI_TEXT(kResume, "Resume", "Fortsetzen", "Reprendre", "Reanudar")

// Status.
FLYTRI_TEXT(kStatusReady, "Ready", "Bereit", "Prêt", "Listo")
FLYTRI_TEXT(kStatusReadyHint, "Press Scan to start", "„Scannen“ drücken, um zu beginnen",
            "Appuyer sur « Scanner » pour commencer", "Pulsar «Escanear» para empezar")
FLYTRI_TEXT(kStatusReadOnlyHint, "Can be viewed and exported, but not changed",
            "Ansehen und exportieren möglich, ändern nicht",
            "Consultation et export possibles, sans modification",
            "Se puede ver y exportar, pero no modificar")
FLYTRI_TEXT(kStatusPaused, "Paused", "Pause", "En pause", "En pausa")
FLYTRI_TEXT(kStatusPausedHint, "Resume scanning, or finish the model",
            "Scan fortsetzen oder Modell abschließen", "Reprendre le scan ou terminer le modèle",
            "Reanudar el escaneo o finalizar el modelo")
FLYTRI_TEXT(kStatusDark, "Lights off", "Licht aus", "Éclairage coupé", "Luces apagadas")
FLYTRI_TEXT(kStatusDarkHint, "Click this window to turn them on",
            "Dieses Fenster anklicken, um es einzuschalten",
            "Cliquer dans cette fenêtre pour le rallumer",
            "Hacer clic en esta ventana para encenderlas")
FLYTRI_TEXT(kStatusScanning, "Scanning", "Scan läuft", "Scan en cours", "Escaneando")
FLYTRI_TEXT(kStatusFlat, "Flat here", "Flache Stelle", "Zone plate", "Zona plana")
FLYTRI_TEXT(kStatusFlatHint, "Include a tooth or the ridge",
            "Einen Zahn oder den Kieferkamm mit erfassen", "Inclure une dent ou la crête",
            "Incluir un diente o la cresta")
FLYTRI_TEXT(kStatusLost, "Tracking lost", "Position verloren", "Position perdue",
            "Posición perdida")
FLYTRI_TEXT(kStatusLostHint, "Return to the marked area", "Zur markierten Stelle zurückkehren",
            "Revenir à la zone marquée", "Volver a la zona marcada")
FLYTRI_TEXT(kStatusPreview, "Preview", "Vorschau", "Aperçu", "Vista previa")
FLYTRI_TEXT(kStatusPreviewHint, "Hold the sensor over the teeth", "Sensor über die Zähne halten",
            "Tenir le capteur au-dessus des dents", "Sostener el sensor sobre los dientes")
FLYTRI_TEXT(kStatusOpening, "Opening", "Öffnen", "Ouverture", "Abriendo")
FLYTRI_TEXT(kStatusOpeningHint, "The case is being read", "Der Fall wird gelesen",
            "Lecture du cas en cours", "Se está leyendo el caso")
FLYTRI_TEXT(kStatusProcessing, "Processing", "Verarbeitung", "Traitement", "Procesando")
FLYTRI_TEXT(kStatusProcessingHint, "Keep the sensor ready", "Sensor bereithalten",
            "Garder le capteur à portée de main", "Mantener el sensor a mano")
FLYTRI_TEXT(kStatusNoSensor, "No sensor", "Kein Sensor", "Pas de capteur", "Sin sensor")
FLYTRI_TEXT(
    kDeviceProblems,
    "{0} problem with its devices: press {1} to see it|{0} problems with its devices: press {1} to "
    "see them",
    "{0} Problem mit den Geräten: mit {1} anzeigen|{0} Probleme mit den Geräten: mit {1} anzeigen",
    "{0} problème d’appareil : appuyer sur {1} pour le voir|{0} problèmes d’appareils : appuyer "
    "sur {1} pour les voir",
    "{0} problema con los equipos: pulsar {1} para verlo|{0} problemas con los equipos: pulsar {1} "
    "para verlos")
FLYTRI_TEXT(kStatusDamaged, "Case damaged", "Fall beschädigt", "Cas endommagé", "Caso dañado")
FLYTRI_TEXT(kStatusDamagedHint, "Press {0} to see what is left, and to save it",
            "{0} drücken: sehen, was übrig ist, und es sichern",
            "Appuyer sur {0} pour voir ce qui reste et le sauver",
            "Pulsar {0} para ver lo que queda y guardarlo")
FLYTRI_TEXT(kStatusNotOpened, "Not opened", "Nicht geöffnet", "Non ouvert", "Sin abrir")
FLYTRI_TEXT(kStatusNotSaved, "Not saved", "Nicht gespeichert", "Non enregistré", "Sin guardar")
FLYTRI_TEXT(kStatusFinished, "Finished", "Abgeschlossen", "Terminé", "Finalizado")
FLYTRI_TEXT(kStatusFinishedHint, "Export the model, or resume scanning",
            "Modell exportieren oder Scan fortsetzen", "Exporter le modèle ou reprendre le scan",
            "Exportar el modelo o reanudar el escaneo")
FLYTRI_TEXT(kStatusStarting, "Starting", "Start", "Démarrage", "Iniciando")
FLYTRI_TEXT(kStatusStartingHint, "The sensor is getting ready", "Der Sensor wird vorbereitet",
            "Le capteur se prépare", "El sensor se está preparando")
FLYTRI_TEXT(kStatusRecordingEnded, "Recording ended", "Aufnahme zu Ende", "Fin de l’enregistrement",
            "Fin de la grabación")
FLYTRI_TEXT(kStatusRecordingEndedHint, "Finish the model", "Modell abschließen",
            "Terminer le modèle", "Finalizar el modelo")

// The way back after a loss.
FLYTRI_TEXT(kMoveAlongArrow, "Move {0:.0f} mm along the arrow",
            "{0:.0f} mm entlang des Pfeils bewegen", "Avancer de {0:.0f} mm le long de la flèche",
            "Mover {0:.0f} mm siguiendo la flecha")
FLYTRI_TEXT(kMoveAndTilt, "Move {0:.0f} mm along the arrow, tilt by {1:.0f}°",
            "{0:.0f} mm entlang des Pfeils bewegen, {1:.0f}° kippen",
            "Avancer de {0:.0f} mm le long de la flèche, incliner de {1:.0f}°",
            "Mover {0:.0f} mm siguiendo la flecha, inclinar {1:.0f}°")
FLYTRI_TEXT(kTooSmoothMove, "Too smooth here: move {0:.0f} mm along the arrow",
            "Hier zu glatt: {0:.0f} mm entlang des Pfeils bewegen",
            "Trop lisse ici : avancer de {0:.0f} mm le long de la flèche",
            "Demasiado liso aquí: mover {0:.0f} mm siguiendo la flecha")
FLYTRI_TEXT(kTooSmoothMoveAndTilt,
            "Too smooth here: move {0:.0f} mm along the arrow, tilt by {1:.0f}°",
            "Hier zu glatt: {0:.0f} mm entlang des Pfeils bewegen, {1:.0f}° kippen",
            "Trop lisse ici : avancer de {0:.0f} mm le long de la flèche, incliner de {1:.0f}°",
            "Demasiado liso aquí: mover {0:.0f} mm siguiendo la flecha, inclinar {1:.0f}°")
FLYTRI_TEXT(kReturnToThisPlace, "Return to this place", "Hierher zurückkehren",
            "Revenir à cet endroit", "Volver a este lugar")
FLYTRI_TEXT(kLiveImage, "Live image", "Livebild", "Image en direct", "Imagen en vivo")
FLYTRI_TEXT(kMatch, "Match", "Übereinstimmung", "Concordance", "Coincidencia")
FLYTRI_TEXT(kSuggestedPlaces, "Suggested places to resume ({0})",
            "Mögliche Stellen zum Fortsetzen ({0})", "Endroits proposés pour reprendre ({0})",
            "Lugares propuestos para reanudar ({0})")
FLYTRI_TEXT(kResumeAtPlace, "Resume at place {0}", "An Stelle {0} fortsetzen",
            "Reprendre à l’endroit {0}", "Reanudar en el lugar {0}")
FLYTRI_TEXT(kNoImage, "no image", "kein Bild", "pas d’image", "sin imagen")
FLYTRI_TEXT(kNoImageYet, "no image yet", "noch kein Bild", "pas encore d’image", "aún sin imagen")
FLYTRI_TEXT(kNoSensor, "no sensor", "kein Sensor", "pas de capteur", "sin sensor")

// Side panel.
FLYTRI_TEXT(kByHand, "By hand", "Von Hand", "À la main", "A mano")
FLYTRI_TEXT(kLiftSensor, "Lift sensor", "Abheben", "Lever", "Levantar")
FLYTRI_TEXT(kReturnSensor, "Return sensor", "Aufsetzen", "Reposer", "Apoyar")
FLYTRI_TEXT(kAlignmentError, "Alignment error", "Ausrichtungsfehler", "Erreur d’alignement",
            "Error de alineación")
FLYTRI_TEXT(
    kAlignmentErrorHint,
    "How far the latest lines lie from the surface scanned before, where they cross. Below {0} is "
    "good; more means noise, motion, or a wrong calibration.",
    "Abstand der neuesten Linien von der zuvor gescannten Oberfläche, wo sie sich kreuzen. Gut ist "
    "weniger als {0}; mehr bedeutet Rauschen, Bewegung oder eine falsche Kalibrierung.",
    "Écart entre les dernières lignes et la surface déjà scannée, là où elles se croisent. Moins "
    "de {0} est bon ; au-delà, il y a du bruit, un mouvement ou un étalonnage erroné.",
    "Distancia entre las últimas líneas y la superficie ya escaneada, donde se cruzan. Menos de "
    "{0} es bueno; más indica ruido, movimiento o una calibración errónea.")
FLYTRI_TEXT(kSpanUncertainty, "Uncertain by (95 %)", "Unsicherheit (95 %)", "Incertitude (95 %)",
            "Incertidumbre (95 %)")
FLYTRI_TEXT(
    kSpanHint,
    "A distance across this scan, and how far the true one may be from it: from "
    "the noise of the scan. An error of the calibration comes on top. The report lists all "
    "distances.",
    "Ein Abstand über diesen Scan, und wie weit der wahre davon abweichen kann: aus "
    "dem Rauschen des Scans. Ein Fehler der Kalibrierung kommt hinzu. Der Bericht nennt "
    "alle Abstände.",
    "Une distance à travers ce scan, et l’écart possible avec la vraie : d’après le "
    "bruit du scan. Une erreur d’étalonnage s’y ajoute. Le rapport donne toutes les "
    "distances.",
    "Una distancia a través de este escaneo y cuánto puede diferir de la verdadera: según el "
    "ruido del escaneo. Un error de calibración se suma. El informe da todas las "
    "distancias.")
FLYTRI_TEXT(kDelay, "Delay", "Verzögerung", "Retard", "Retardo")
FLYTRI_TEXT(kDelayHint,
            "From the arrival of a camera image until the surface on the screen shows it. Below "
            "100 ms is good.",
            "Vom Eintreffen eines Kamerabildes, bis die Oberfläche auf dem Bildschirm es zeigt. "
            "Gut ist weniger als 100 ms.",
            "De l’arrivée d’une image de la caméra jusqu’à son affichage sur la surface. Moins de "
            "100 ms est bon.",
            "Desde la llegada de una imagen de la cámara hasta que la superficie en pantalla la "
            "muestra. Menos de 100 ms es bueno.")
FLYTRI_TEXT(kLatestLines, "Latest lines", "Neueste Linien", "Dernières lignes", "Últimas líneas")
FLYTRI_TEXT(kDistance, "Distance", "Abstand", "Distance", "Distancia")
FLYTRI_TEXT(
    kDistanceHint,
    "Where the surface lies in the depth that the sensor measures. Keep the mark in the green "
    "part.",
    "Lage der Oberfläche in der Tiefe, die der Sensor misst. Die Marke im grünen Bereich halten.",
    "Position de la surface dans la profondeur mesurée par le capteur. Garder le repère dans la "
    "zone verte.",
    "Posición de la superficie en la profundidad que mide el sensor. Mantener la marca en la zona "
    "verde.")
FLYTRI_TEXT(kNoSurfaceInView, "no surface in view", "keine Oberfläche", "aucune surface",
            "sin superficie")
FLYTRI_TEXT(kTooNear, "too near", "zu nah", "trop près", "muy cerca")
FLYTRI_TEXT(kDistanceGood, "good", "gut", "bon", "bien")
FLYTRI_TEXT(kTooFar, "too far", "zu weit", "trop loin", "muy lejos")

// Colors.
FLYTRI_TEXT(kTextureStrength, "Texture strength ({0})", "Texturstärke ({0})", "Force texture ({0})",
            "Textura ({0})")
FLYTRI_TEXT(kLegendGood, "Good", "Gut", "Bon", "Bien")
FLYTRI_TEXT(kLegendScanAgain, "Scan again", "Erneut scannen", "Scanner encore", "Volver a escanear")
FLYTRI_TEXT(kLegendHole, "Hole", "Loch", "Trou", "Hueco")
FLYTRI_TEXT(kUncertaintyHint,
            "How far the surface may be off, as one standard deviation. Blue places were measured "
            "many times.",
            "Wie ungenau die Oberfläche sein kann, als eine Standardabweichung. Blaue Stellen "
            "wurden oft gemessen.",
            "Imprécision possible de la surface, en un écart type. Les zones bleues ont été "
            "mesurées de nombreuses fois.",
            "Imprecisión posible de la superficie, como una desviación estándar. Las zonas azules "
            "se midieron muchas veces.")

// Findings.
FLYTRI_TEXT(kHoles, "{0} hole|{0} holes", "{0} Loch|{0} Löcher", "{0} trou|{0} trous",
            "{0} hueco|{0} huecos")
FLYTRI_TEXT(kHolesSoFar, "{0} hole so far|{0} holes so far", "Bisher {0} Loch|Bisher {0} Löcher",
            "{0} trou pour l’instant|{0} trous pour l’instant",
            "{0} hueco hasta ahora|{0} huecos hasta ahora")
FLYTRI_TEXT(kDistances, "Distances", "Abstände", "Distances", "Distancias")
FLYTRI_TEXT(kDistanceNumber, "Distance {0}", "Abstand {0}", "Distance {0}", "Distancia {0}")
FLYTRI_TEXT(kRemoveThisDistance, "Remove this distance", "Diesen Abstand löschen",
            "Supprimer cette distance", "Borrar esta distancia")

// Tools.
FLYTRI_TEXT(kPaintToRemove, "Paint to remove", "Zum Entfernen übermalen", "Peindre pour retirer",
            "Pintar para eliminar")
FLYTRI_TEXT(kPaintToLock, "Paint to lock", "Zum Sperren übermalen", "Peindre pour bloquer",
            "Pintar para bloquear")
FLYTRI_TEXT(kPaintToUnlock, "Paint to unlock", "Zum Freigeben übermalen", "Peindre pour libérer",
            "Pintar para desbloquear")
FLYTRI_TEXT(kClickFirstPoint, "Click the first point", "Ersten Punkt anklicken",
            "Cliquer sur le premier point", "Pulsar el primer punto")
FLYTRI_TEXT(kClickSecondPoint, "Click the second point", "Zweiten Punkt anklicken",
            "Cliquer sur le second point", "Pulsar el segundo punto")
FLYTRI_TEXT(kToolDone, "Done", "Fertig", "Terminé", "Listo")

// Finishing.
FLYTRI_TEXT(kCancel, "Cancel", "Abbrechen", "Interrompre", "Cancelar")
FLYTRI_TEXT(kNotFinished, "The scan could not be finished", "Scan nicht abgeschlossen",
            "Le scan n’a pas pu être terminé", "No se pudo finalizar el escaneo")
FLYTRI_TEXT(kFewSecondsLeft, "a few seconds left", "noch wenige Sekunden",
            "encore quelques secondes", "quedan unos segundos")
FLYTRI_TEXT(kSecondsLeft, "about {0:.0f} s left", "noch etwa {0:.0f} s", "encore {0:.0f} s environ",
            "quedan unos {0:.0f} s")
FLYTRI_TEXT(kMinutesLeft, "about {0:.0f} min left", "noch etwa {0:.0f} min",
            "encore {0:.0f} min environ", "quedan unos {0:.0f} min")

// Hints of buttons: name, key, state.
FLYTRI_TEXT(kHintKey, "Key: {0}", "Taste: {0}", "Touche : {0}", "Tecla: {0}")
FLYTRI_TEXT(kHintNameAndKey, "{0}, key: {1}", "{0}, Taste: {1}", "{0}, touche : {1}",
            "{0}, tecla: {1}")

// The strip of the trim tool.
FLYTRI_TEXT(kClearAll, "Clear all", "Alles leeren", "Tout effacer", "Vaciar todo")

// The scans of a jaw.
FLYTRI_TEXT(kOtherSensor, "for another sensor", "für einen anderen Sensor", "pour un autre capteur",
            "para otro sensor")
FLYTRI_TEXT(kOnlyForAJaw, "only for a jaw", "nur für einen Kiefer", "arcade seulement",
            "solo un maxilar")
FLYTRI_TEXT(kScanAnew, "Scan anew", "Neu scannen", "Scanner", "Escanear")
FLYTRI_TEXT(kStartAsCopy, "Start as a copy", "Als Kopie beginnen", "Partir d’une copie",
            "Empezar como copia")
FLYTRI_TEXT(kKeepAsPreop, "Keep as pre-op", "Als Präop behalten", "Garder comme pré-op",
            "Guardar como preop")
FLYTRI_TEXT(kJawHint, "The jaw as it is restored, with the prepared teeth.",
            "Der Kiefer, wie er versorgt wird, mit den präparierten Zähnen.",
            "L’arcade à restaurer, avec les dents préparées.",
            "El maxilar que se restaura, con los dientes preparados.")
FLYTRI_TEXT(kPreopHint,
            "Before the preparation. Keep the scan here, then cut the tooth out of the jaw and "
            "scan it again.",
            "Vor der Präparation. Den Scan hier behalten, dann den Zahn aus dem Kiefer schneiden "
            "und neu scannen.",
            "Avant la préparation. Garder le scan ici, puis découper la dent de l’arcade et la "
            "scanner de nouveau.",
            "Antes de la preparación. Guardar aquí el escaneo; después recortar el diente del "
            "maxilar y volver a escanearlo.")
FLYTRI_TEXT(kScanBodyHint,
            "With scan bodies on the implants. Start as a copy, cut the place out and scan it "
            "again.",
            "Mit Scanbodys auf den Implantaten. Als Kopie beginnen, die Stelle ausschneiden und "
            "neu scannen.",
            "Avec les scanbodies sur les implants. Partir d’une copie, découper l’endroit et le "
            "scanner de nouveau.",
            "Con los scanbodies sobre los implantes. Empezar como copia, recortar la zona y volver "
            "a escanearla.")
FLYTRI_TEXT(
    kCopiesHint,
    "A copy lies in the frame of its jaw: exported together, they fit on each other. What "
    "is copied stays as it is.",
    "Eine Kopie liegt im Koordinatensystem ihres Kiefers: Zusammen exportiert liegen sie "
    "aufeinander. Das Original bleibt, wie es ist.",
    "Une copie garde le repère de son arcade : exportées ensemble, elles se "
    "superposent. L’original reste tel quel.",
    "Una copia conserva el sistema de su maxilar: exportados juntos, coinciden. El original "
    "queda como está.")
FLYTRI_TEXT(kKeptAsPreop, "Kept as pre-op. Cut out what is prepared, and scan it again.",
            "Als Präop behalten. Ausschneiden, was präpariert ist, und neu scannen.",
            "Gardé comme pré-op. Découper ce qui est préparé et le scanner de nouveau.",
            "Guardado como preop. Recortar lo preparado y volver a escanearlo.")
