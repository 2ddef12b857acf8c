/// @file  The panel of the calibration: tasks, places, images, results.

FLYTRI_TEXT(kCalibratingTheSensor, "Calibrating the sensor", "Sensor kalibrieren",
            "Étalonnage du capteur", "Calibración del sensor")
FLYTRI_TEXT(kCalibrate, "Calibrate", "Kalibrieren", "Étalonner", "Calibrar")
FLYTRI_TEXT(kCalibratePurpose,
            "Needs a white plane and a dot target at several depths. Do it once, and again when a "
            "check fails.",
            "Benötigt eine weiße Ebene und eine Punktetafel in mehreren Tiefen. Einmal nötig, und "
            "wieder, wenn eine Prüfung nicht gelingt.",
            "Nécessite un plan blanc et une mire de points à plusieurs profondeurs. À faire une "
            "fois, puis quand une vérification échoue.",
            "Requiere un plano blanco y una placa de puntos a varias profundidades. Hacerlo una "
            "vez, y de nuevo cuando falle una comprobación.")
FLYTRI_TEXT(kCheckOnPlanePurpose,
            "Needs a flat white plate at six places. Shows whether the calibration is still valid, "
            "except for its scale.",
            "Benötigt eine ebene weiße Platte an sechs Stellen. Zeigt, ob die Kalibrierung noch "
            "gültig ist, außer ihrem Maßstab.",
            "Nécessite une plaque blanche plane à six endroits. Montre si l’étalonnage est encore "
            "valable, sauf son échelle.",
            "Requiere una placa blanca plana en seis lugares. Muestra si la calibración sigue "
            "siendo válida, salvo su escala.")
FLYTRI_TEXT(
    kCheckOnSpherePurpose,
    "Needs a matte sphere of known diameter at six places. Checks the scale, too.",
    "Benötigt eine matte Kugel mit bekanntem Durchmesser an sechs Stellen. Prüft auch den Maßstab.",
    "Nécessite une sphère mate de diamètre connu à six endroits. Vérifie aussi l’échelle.",
    "Requiere una esfera mate de diámetro conocido en seis lugares. Comprueba también la escala.")
FLYTRI_TEXT(kNotPossible, "Not possible: {0}.", "Nicht möglich: {0}.", "Impossible : {0}.",
            "No es posible: {0}.")
FLYTRI_TEXT(kSphereDiameter, "Sphere diameter, mm", "Kugeldurchmesser, mm", "Diamètre sphère, mm",
            "Diámetro esfera, mm")
FLYTRI_TEXT(kCalibrationFolder, "Folder for calibrations", "Ordner für Kalibrierungen",
            "Dossier des étalonnages", "Carpeta de calibraciones")
FLYTRI_TEXT(kCalibrationContinues,
            "A calibration that was started in this folder continues where it stopped. Scanning "
            "pauses meanwhile.",
            "Eine in diesem Ordner begonnene Kalibrierung wird fortgesetzt. Der Scan pausiert "
            "währenddessen.",
            "Un étalonnage commencé dans ce dossier reprend où il s’est arrêté. Le scan est en "
            "pause pendant ce temps.",
            "Una calibración iniciada en esta carpeta continúa donde se detuvo. Entretanto, el "
            "escaneo queda en pausa.")
FLYTRI_TEXT(kCalibrationNote, "Note, such as the temperature", "Notiz, z. B. Temperatur",
            "Note, par ex. la température", "Nota, por ejemplo la temperatura")
FLYTRI_TEXT(kCalibrationHistory, "Calibration in use", "Kalibrierung in Verwendung",
            "Étalonnage utilisé", "Calibración en uso")
FLYTRI_TEXT(kCalibrationMade, "calibrated", "kalibriert", "étalonné", "calibrado")
FLYTRI_TEXT(kCheckHasPassed, "check passed", "Prüfung bestanden", "contrôle réussi",
            "comprobación superada")
FLYTRI_TEXT(kCheckHasFailed, "check failed", "Prüfung nicht bestanden", "contrôle échoué",
            "comprobación fallida")
FLYTRI_TEXT(kCalibrationReplaced, "replaced", "ersetzt", "remplacé", "reemplazada")
FLYTRI_TEXT(kCalibrationReplacedKept, "replaced, kept as {0}", "ersetzt, aufbewahrt als {0}",
            "remplacé, gardé sous {0}", "reemplazada, guardada como {0}")
FLYTRI_TEXT(kDateUnknown, "date unknown", "Datum unbekannt", "date inconnue", "fecha desconocida")
FLYTRI_TEXT(kStartingDevices, "Starting cameras and lights…", "Kameras und Lichter starten…",
            "Démarrage des caméras et de l’éclairage…", "Iniciando cámaras y luces…")
FLYTRI_TEXT(kPutTarget, "Put the {0} {1}", "Aufstellen: {0}, {1}", "Placer : {0}, {1}",
            "Colocar: {0}, {1}")
FLYTRI_TEXT(kTakingImages, "Taking images: do not move it", "Aufnahme läuft: nicht bewegen",
            "Prise d’images : ne pas bouger", "Tomando imágenes: no mover")
FLYTRI_TEXT(kComputing, "Computing…", "Berechnung…", "Calcul…", "Calculando…")
FLYTRI_TEXT(kImagesDoNotFit, "The images do not fit together", "Die Bilder passen nicht zusammen",
            "Les images ne concordent pas", "Las imágenes no concuerdan")
FLYTRI_TEXT(kCalibrationStopped, "Calibration stopped", "Kalibrierung abgebrochen",
            "Étalonnage interrompu", "Calibración detenida")
FLYTRI_TEXT(kCheckStopped, "Check stopped", "Prüfung abgebrochen", "Vérification interrompue",
            "Comprobación detenida")
FLYTRI_TEXT(kChoosePlaceBelow, "Below, choose the place to take again.",
            "Unten die Stelle wählen, die neu aufzunehmen ist.",
            "Choisir ci-dessous l’endroit à refaire.", "Elegir abajo el lugar que se debe repetir.")
FLYTRI_TEXT(kHoldStill,
            "Place {0} of {1}. Hold still, then press {2}. The lights switch automatically.",
            "Stelle {0} von {1}. Ruhig halten, dann {2} drücken. Die Lichter schalten von selbst.",
            "Endroit {0} sur {1}. Ne plus bouger, puis appuyer sur {2}. L’éclairage change "
            "automatiquement.",
            "Lugar {0} de {1}. Mantener quieto y pulsar {2}. Las luces cambian automáticamente.")
FLYTRI_TEXT(kUseCalibration, "Use calibration", "Kalibrierung verwenden", "Utiliser l’étalonnage",
            "Usar calibración")
FLYTRI_TEXT(kTakeImages, "Take images", "Aufnehmen", "Prendre les images", "Tomar imágenes")
FLYTRI_TEXT(kClose, "Close", "Schließen", "Fermer", "Cerrar")
FLYTRI_TEXT(kStop, "Stop", "Beenden", "Arrêter", "Detener")
FLYTRI_TEXT(kSavedIn, "saved in {0}", "gespeichert in {0}", "enregistré dans {0}",
            "guardado en {0}")
FLYTRI_TEXT(kTakeAgain, "Take the {0} {1} again", "Neu aufnehmen: {0}, {1}", "Refaire : {0}, {1}",
            "Repetir: {0}, {1}")
FLYTRI_TEXT(kPositionErrors, "Position error of each plane", "Positionsfehler jeder Ebene",
            "Erreur de position de chaque plan", "Error de posición de cada plano")
FLYTRI_TEXT(kLegendVertical, "vertical lines", "vertikale Linien", "lignes verticales",
            "líneas verticales")
FLYTRI_TEXT(kLegendHorizontal, "horizontal lines", "horizontale Linien", "lignes horizontales",
            "líneas horizontales")
FLYTRI_TEXT(kDeviationOfLimit, "{0:.1f} of {1:.1f} µm", "{0:.1f} von {1:.1f} µm",
            "{0:.1f} sur {1:.1f} µm", "{0:.1f} de {1:.1f} µm")
FLYTRI_TEXT(kDeviations, "Deviations at the edge of the volume",
            "Abweichungen am Rand des Volumens", "Écarts au bord du volume",
            "Desviaciones en el borde del volumen")

// What a calibration or a check tells.
FLYTRI_TEXT(kAtDepth, "at z = {0} mm", "bei z = {0} mm", "à z = {0} mm", "en z = {0} mm")
FLYTRI_TEXT(kDotsUnderLamp, "dot target, lit by a lamp,",
            "Punktetafel, von einer Lampe beleuchtet,", "mire de points, éclairée par une lampe,",
            "placa de puntos, bajo una lámpara,")
FLYTRI_TEXT(kTargetSphere, "sphere", "Kugel", "sphère", "esfera")
FLYTRI_TEXT(kTargetPlane, "plane", "Ebene", "plan", "plano")
FLYTRI_TEXT(kPlaceNumber, "place {0}", "Stelle {0}", "endroit {0}", "lugar {0}")
FLYTRI_TEXT(kAtRest, "at rest", "in Ruhe", "immobile", "en reposo")
FLYTRI_TEXT(kFoundAndBrightness, "{0} found, brightness {1:.0f} %",
            "{0} gefunden, Helligkeit {1:.0f} %", "{0} trouvés, luminosité {1:.0f} %",
            "{0} encontrados, brillo {1:.0f} %")
FLYTRI_TEXT(kSensorIsCalibrated, "The sensor is calibrated", "Der Sensor ist kalibriert",
            "Le capteur est étalonné", "El sensor está calibrado")
FLYTRI_TEXT(kScatter,
            "Single samples scatter by {0:.1f} µm on vertical and {1:.1f} µm on horizontal lines; "
            "no plane is farther than {2:.1f} µm from its place.",
            "Einzelne Messpunkte streuen um {0:.1f} µm auf vertikalen und {1:.1f} µm auf "
            "horizontalen Linien; keine Ebene weicht mehr als {2:.1f} µm ab.",
            "Les points isolés se dispersent de {0:.1f} µm sur les lignes verticales et de {1:.1f} "
            "µm sur les horizontales ; aucun plan ne s’écarte de plus de {2:.1f} µm.",
            "Los puntos sueltos se dispersan {0:.1f} µm en líneas verticales y {1:.1f} µm en "
            "horizontales; ningún plano se desvía más de {2:.1f} µm.")
FLYTRI_TEXT(kWrittenFile, "Written: {0}", "Geschrieben: {0}", "Écrit : {0}", "Escrito: {0}")
FLYTRI_TEXT(kCalibrationValid, "Calibration valid", "Kalibrierung gültig", "Étalonnage valable",
            "Calibración válida")
FLYTRI_TEXT(kCalibrationInvalid, "Calibration no longer valid", "Kalibrierung nicht mehr gültig",
            "L’étalonnage n’est plus valable", "La calibración ya no es válida")
FLYTRI_TEXT(kCalibrateAgain, "Calibrate the sensor again.", "Den Sensor neu kalibrieren.",
            "Étalonner à nouveau le capteur.", "Calibrar de nuevo el sensor.")
FLYTRI_TEXT(kNoVerdict, "No verdict", "Kein Ergebnis", "Pas de verdict", "Sin veredicto")
FLYTRI_TEXT(
    kCalibrationIsOld,
    "The calibration was last found valid {0} days ago. Check it on the plane or the sphere.",
    "Die Kalibrierung wurde zuletzt vor {0} Tagen für gültig befunden. Sie an der Ebene oder "
    "der Kugel prüfen.",
    "Étalonnage trouvé valable il y a {0} jours. Le contrôler sur le plan ou la sphère.",
    "La calibración se dio por válida por última vez hace {0} días. Comprobarla con el plano "
    "o la esfera.")
FLYTRI_TEXT(kCalibrationFailedCheck,
            "The last check of the calibration failed. Calibrate the sensor again.",
            "Die letzte Prüfung der Kalibrierung ist fehlgeschlagen. Den Sensor neu kalibrieren.",
            "Le dernier contrôle de l’étalonnage a échoué. Étalonner à nouveau le capteur.",
            "La última comprobación de la calibración falló. Calibrar de nuevo el sensor.")
FLYTRI_TEXT(kProjectorMoved,
            "Vertical and horizontal lines disagree by {0:.0f} µm: a projector has probably moved. "
            "Check the calibration.",
            "Vertikale und horizontale Linien weichen um {0:.0f} µm voneinander ab: Ein Projektor "
            "hat sich wohl bewegt. Die Kalibrierung prüfen.",
            "Les lignes verticales et horizontales s’écartent de {0:.0f} µm : un projecteur a sans "
            "doute bougé. Contrôler l’étalonnage.",
            "Las líneas verticales y horizontales difieren en {0:.0f} µm: es probable que un "
            "proyector se haya movido. Comprobar la calibración.")
FLYTRI_TEXT(kCalibrationInUse, "In use: {0}", "In Verwendung: {0}", "Utilisé : {0}", "En uso: {0}")
FLYTRI_TEXT(kCheckNoted, "The check is noted in {0}", "Die Prüfung ist vermerkt in {0}",
            "Contrôle noté dans {0}", "Comprobación anotada en {0}")
FLYTRI_TEXT(kCheckNotNoted, "The check holds, but is not noted in the calibration: {0}",
            "Die Prüfung gilt, ist aber nicht in der Kalibrierung vermerkt: {0}",
            "Le contrôle est valable, mais n’est pas noté dans l’étalonnage : {0}",
            "La comprobación es válida, pero no está anotada en la calibración: {0}")
FLYTRI_TEXT(kVirtualHasItsOwn, "the virtual sensor has its own calibration",
            "der virtuelle Sensor hat seine eigene Kalibrierung",
            "le capteur virtuel a son propre étalonnage",
            "el sensor virtual tiene su propia calibración")
FLYTRI_TEXT(kSaveScansFirst, "save the scans in a case first",
            "Scans zuerst in einem Fall speichern", "enregistrer d’abord les scans dans un cas",
            "guardar antes los escaneos en un caso")
FLYTRI_TEXT(kSensorIsBeingCalibrated, "The sensor is being calibrated",
            "Der Sensor wird kalibriert", "Le capteur est en cours d’étalonnage",
            "El sensor se está calibrando")
FLYTRI_TEXT(
    kTeethPointAlong,
    "{0}: its teeth point along {1:.1f} {2:.1f} {3:.1f}, so the simulated hand scans it from there",
    "{0}: die Zähne zeigen in Richtung {1:.1f} {2:.1f} {3:.1f}, deshalb scannt die simulierte Hand "
    "von dort",
    "{0} : les dents pointent vers {1:.1f} {2:.1f} {3:.1f}, la main simulée scanne donc de ce côté",
    "{0}: los dientes apuntan hacia {1:.1f} {2:.1f} {3:.1f}, así que la mano simulada escanea "
    "desde allí")
