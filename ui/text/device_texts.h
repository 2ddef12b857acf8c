/// @file  The panel of cameras and lights: images and exposure, devices, problems.

FLYTRI_TEXT(kVerticalLines, "Vertical lines", "Vertikale Linien", "Lignes verticales",
            "Líneas verticales")
FLYTRI_TEXT(kHorizontalLines, "Horizontal lines", "Horizontale Linien", "Lignes horizontales",
            "Líneas horizontales")
FLYTRI_TEXT(kFlash, "Flash", "Blitz", "Flash", "Flash")
FLYTRI_TEXT(kNoFlashYet, "no flash image yet", "noch kein Blitzbild", "pas encore d’image flash",
            "aún sin imagen con flash")
FLYTRI_TEXT(kDarkWithoutFocus, "Lights off while you use another window",
            "Licht aus, während ein anderes Fenster aktiv ist",
            "Éclairage coupé hors de cette fenêtre", "Luces apagadas mientras se usa otra ventana")
FLYTRI_TEXT(kTooDark, "too dark", "zu dunkel", "trop sombre", "muy oscuro")
FLYTRI_TEXT(kTooBright, "too bright", "zu hell", "trop clair", "muy claro")
FLYTRI_TEXT(kExposureGoodLines, "Good: the lines reach {0:.0f} % of full scale",
            "Gut: Linien bei {0:.0f} % des Höchstwerts", "Bon : lignes à {0:.0f} % du maximum",
            "Bien: líneas al {0:.0f} % del máximo")
FLYTRI_TEXT(kExposureGoodTeeth, "Good: the teeth reach {0:.0f} % of full scale",
            "Gut: Zähne bei {0:.0f} % des Höchstwerts", "Bon : dents à {0:.0f} % du maximum",
            "Bien: dientes al {0:.0f} % del máximo")
FLYTRI_TEXT(kExposureReduceLines, "Reduce exposure or gain: {0:.0f} % of the lines are overexposed",
            "Belichtung oder Verstärkung senken: {0:.0f} % der Linien überbelichtet",
            "Réduire l’exposition ou le gain : {0:.0f} % des lignes surexposées",
            "Reducir exposición o ganancia: {0:.0f} % de las líneas sobreexpuestas")
FLYTRI_TEXT(kExposureReduceImage, "Reduce exposure or gain: {0:.0f} % of the image is overexposed",
            "Belichtung oder Verstärkung senken: {0:.0f} % des Bildes überbelichtet",
            "Réduire l’exposition ou le gain : {0:.0f} % de l’image surexposée",
            "Reducir exposición o ganancia: {0:.0f} % de la imagen sobreexpuesta")
FLYTRI_TEXT(kExposureIncreaseLines,
            "Increase exposure or gain: the lines reach {0:.0f} % of full scale",
            "Belichtung oder Verstärkung erhöhen: Linien bei {0:.0f} % des Höchstwerts",
            "Augmenter l’exposition ou le gain : lignes à {0:.0f} % du maximum",
            "Aumentar exposición o ganancia: líneas al {0:.0f} % del máximo")
FLYTRI_TEXT(kExposureIncreaseTeeth,
            "Increase exposure or gain: the teeth reach {0:.0f} % of full scale",
            "Belichtung oder Verstärkung erhöhen: Zähne bei {0:.0f} % des Höchstwerts",
            "Augmenter l’exposition ou le gain : dents à {0:.0f} % du maximum",
            "Aumentar exposición o ganancia: dientes al {0:.0f} % del máximo")
FLYTRI_TEXT(kExposureNoLines,
            "No lines found: hold the sensor over the teeth, or increase the exposure",
            "Keine Linien gefunden: Sensor über die Zähne halten oder Belichtung erhöhen",
            "Aucune ligne : tenir le capteur au-dessus des dents ou augmenter l’exposition",
            "Sin líneas: sostener el sensor sobre los dientes o aumentar la exposición")

FLYTRI_TEXT(kMeasurementCamera, "Measurement camera", "Messkamera", "Caméra de mesure",
            "Cámara de medición")
FLYTRI_TEXT(kTextureCamera, "Texture camera", "Texturkamera", "Caméra de texture",
            "Cámara de textura")
FLYTRI_TEXT(kLights, "Lights", "Lichter", "Éclairage", "Luces")
FLYTRI_TEXT(kLabeled, "labeled", "zugeordnet", "attribuées", "asignadas")
FLYTRI_TEXT(kMixedLight, "mixed light", "Mischlicht", "mixtes", "luz mixta")
FLYTRI_TEXT(kUnknown, "unknown", "unbekannt", "inconnues", "sin asignar")
FLYTRI_TEXT(kGaps, "gaps", "Lücken", "lacunes", "perdidas")
FLYTRI_TEXT(kDamaged, "damaged", "beschädigt", "abîmées", "dañadas")
FLYTRI_TEXT(kInterrupted, "interrupted", "Ausfälle", "coupures", "cortes")
FLYTRI_TEXT(kLatency, "latency", "Latenz", "latence", "latencia")
FLYTRI_TEXT(kMeasuring, "measuring", "misst", "mesure", "midiendo")
FLYTRI_TEXT(kSwitched, "switched", "geschaltet", "commutés", "cambios")
FLYTRI_TEXT(kRefused, "refused", "abgelehnt", "refusés", "rechazos")
FLYTRI_TEXT(kSkipped, "skipped", "entfallen", "omis", "omitidos")
FLYTRI_TEXT(kSlowest, "slowest", "längste", "maximum", "máximo")
FLYTRI_TEXT(kAPattern, "a pattern", "je Muster", "par motif", "por patrón")
FLYTRI_TEXT(kFramesPerPattern, "{0} frame|{0} frames", "{0} Bild|{0} Bilder",
            "{0} image|{0} images", "{0} imagen|{0} imágenes")
FLYTRI_TEXT(kInStep, "in step", "im Takt", "synchro", "en fase")
FLYTRI_TEXT(kYes, "yes", "ja", "oui", "sí")
FLYTRI_TEXT(kNo, "no", "nein", "non", "no")

FLYTRI_TEXT(kRigWithoutCalibration,
            "{0}: names no \"calibration\"; calibrate here ({1}) or with flytri calibrate --live, "
            "and name the file in rig.json or with --calibration FILE",
            "{0}: nennt keine \"calibration\"; hier kalibrieren ({1}) oder mit flytri calibrate "
            "--live, und die Datei in rig.json oder mit --calibration FILE nennen",
            "{0} : n’indique pas de \"calibration\" ; étalonner ici ({1}) ou avec flytri calibrate "
            "--live, et indiquer le fichier dans rig.json ou avec --calibration FILE",
            "{0}: no indica \"calibration\"; calibrar aquí ({1}) o con flytri calibrate --live, e "
            "indicar el archivo en rig.json o con --calibration FILE")
FLYTRI_TEXT(kProblems, "Problems", "Probleme", "Problèmes", "Problemas")
FLYTRI_TEXT(kCheckAgain, "Check again", "Erneut prüfen", "Revérifier", "Comprobar de nuevo")
FLYTRI_TEXT(kCheckingDevices, "Checking the devices…", "Geräte werden geprüft…",
            "Vérification des appareils…", "Comprobando los equipos…")
FLYTRI_TEXT(kNoProblemsFound, "No problems found", "Keine Probleme gefunden",
            "Aucun problème trouvé", "No se encontraron problemas")
FLYTRI_TEXT(kNotCheckedYet, "Not checked yet", "Noch nicht geprüft", "Pas encore vérifié",
            "Aún sin comprobar")
FLYTRI_TEXT(kMoreProblems, "{0} more: run \"flytri devices\" to see all",
            "{0} weitere: alle zeigt „flytri devices“",
            "{0} de plus : tous avec « flytri devices »", "{0} más: todos con «flytri devices»")
