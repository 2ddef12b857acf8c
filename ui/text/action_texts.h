/// @file  Names of the actions, their groups, and why they are not possible or how they are set.

// Groups of the list of keys.
FLYTRI_TEXT(kGroupScanning, "Scanning", "Scannen", "Scan", "Escaneo")
FLYTRI_TEXT(kGroupEditing, "Editing", "Bearbeiten", "Édition", "Edición")
FLYTRI_TEXT(kGroupView, "View", "Ansicht", "Vue", "Vista")
FLYTRI_TEXT(kGroupHand, "Arrow keys and sensor", "Pfeiltasten und Sensor", "Flèches et capteur",
            "Flechas y sensor")
FLYTRI_TEXT(kGroupCalibration, "Calibration", "Kalibrierung", "Étalonnage", "Calibración")
FLYTRI_TEXT(kGroupProgram, "Program", "Programm", "Programme", "Programa")

// Scanning.
FLYTRI_TEXT(kScanOrPause, "Scan or pause", "Scan / Pause", "Scan ou pause", "Escanear o pausar")
FLYTRI_TEXT(kFinish, "Finish", "Abschließen", "Terminer", "Finalizar")
FLYTRI_TEXT(kNextPlace, "Next place to resume", "Nächste Stelle", "Reprise suivante",
            "Siguiente lugar")
FLYTRI_TEXT(kNextHole, "Next hole", "Nächstes Loch", "Trou suivant", "Siguiente hueco")
FLYTRI_TEXT(kUpperJaw, "Upper jaw", "Oberkiefer", "Maxillaire", "Maxilar")
FLYTRI_TEXT(kLowerJaw, "Lower jaw", "Unterkiefer", "Mandibule", "Mandíbula")
FLYTRI_TEXT(kBite, "Bite", "Biss", "Mordu", "Mordida")
FLYTRI_TEXT(kBiteOtherSide, "Bite, other side", "Biss, Gegenseite", "Mordu, autre côté",
            "Mordida, otro lado")
FLYTRI_TEXT(kScansOfJaw, "Scans of this jaw", "Scans des Kiefers", "Scans de l’arcade",
            "Escaneos del arco")
FLYTRI_TEXT(kUpperPreop, "Upper jaw, pre-op", "Oberkiefer, Präop", "Maxillaire, pré-op",
            "Maxilar, preop")
FLYTRI_TEXT(kLowerPreop, "Lower jaw, pre-op", "Unterkiefer, Präop", "Mandibule, pré-op",
            "Mandíbula, preop")
FLYTRI_TEXT(kUpperScanBody, "Upper jaw, scan body", "Oberkiefer, Scanbody", "Maxillaire, scanbody",
            "Maxilar, scanbody")
FLYTRI_TEXT(kLowerScanBody, "Lower jaw, scan body", "Unterkiefer, Scanbody", "Mandibule, scanbody",
            "Mandíbula, scanbody")

// Editing.
FLYTRI_TEXT(kUndo, "Undo", "Rückgängig", "Annuler", "Deshacer")
FLYTRI_TEXT(kRedo, "Redo", "Wiederholen", "Rétablir", "Rehacer")
FLYTRI_TEXT(kTrim, "Trim", "Schneiden", "Découper", "Recortar")
FLYTRI_TEXT(kLock, "Lock", "Sperren", "Verrouiller", "Bloquear")
FLYTRI_TEXT(kUnlock, "Unlock", "Freigeben", "Déverrouiller", "Desbloquear")
FLYTRI_TEXT(kSmallerBrush, "Smaller brush", "Kleinerer Pinsel", "Pinceau plus petit",
            "Pincel menor")
FLYTRI_TEXT(kLargerBrush, "Larger brush", "Größerer Pinsel", "Pinceau plus grand", "Pincel mayor")
FLYTRI_TEXT(kMeasure, "Measure", "Messen", "Mesurer", "Medir")
FLYTRI_TEXT(kRemoveLastDistance, "Remove last distance", "Letzten Abstand löschen",
            "Effacer dernière mesure", "Borrar última medida")

FLYTRI_TEXT(kClearStage, "Clear stage", "Stufe leeren", "Vider l’étape", "Vaciar etapa")
FLYTRI_TEXT(kBringClearedBack, "Bring cleared back", "Geleertes holen", "Reprendre l’effacé",
            "Recuperar lo vaciado")

// View.
FLYTRI_TEXT(kShape, "Shape", "Form", "Forme", "Forma")
FLYTRI_TEXT(kTexture, "Texture", "Textur", "Texture", "Textura")
FLYTRI_TEXT(kCoverage, "Coverage", "Abdeckung", "Couverture", "Cobertura")
FLYTRI_TEXT(kUncertainty, "Uncertainty", "Unsicherheit", "Incertitude", "Incertidumbre")
FLYTRI_TEXT(kLessTexture, "Less texture", "Weniger Textur", "Moins de texture", "Menos textura")
FLYTRI_TEXT(kMoreTexture, "More texture", "Mehr Textur", "Plus de texture", "Más textura")
FLYTRI_TEXT(kOcclusalView, "Occlusal view", "Okklusale Ansicht", "Vue occlusale", "Vista oclusal")
FLYTRI_TEXT(kBuccalView, "Buccal view", "Bukkale Ansicht", "Vue vestibulaire", "Vista vestibular")
FLYTRI_TEXT(kLingualView, "Lingual view", "Linguale Ansicht", "Vue linguale", "Vista lingual")
FLYTRI_TEXT(kRightSide, "Right side", "Rechte Seite", "Côté droit", "Lado derecho")
FLYTRI_TEXT(kLeftSide, "Left side", "Linke Seite", "Côté gauche", "Lado izquierdo")
FLYTRI_TEXT(kShowAll, "Show all", "Alles zeigen", "Tout afficher", "Mostrar todo")
FLYTRI_TEXT(kHasGone, "What has gone", "Was weg ist", "Ce qui est parti", "Lo que se fue")
FLYTRI_TEXT(kNothingHasGone, "nothing yet", "noch nichts", "encore rien", "nada aún")
FLYTRI_TEXT(kOcclusalPlane, "Occlusal plane", "Okklusionsebene", "Plan occlusal", "Plano oclusal")
FLYTRI_TEXT(kAutomaticPlane, "Automatic plane", "Ebene automatisch", "Plan automatique",
            "Plano automático")
FLYTRI_TEXT(kZoomIn, "Zoom in", "Vergrößern", "Zoom avant", "Acercar")
FLYTRI_TEXT(kZoomOut, "Zoom out", "Verkleinern", "Zoom arrière", "Alejar")

// Arrow keys and sensor.
FLYTRI_TEXT(kTurnLeft, "Turn or move left", "Nach links", "Vers la gauche", "A la izquierda")
FLYTRI_TEXT(kTurnRight, "Turn or move right", "Nach rechts", "Vers la droite", "A la derecha")
FLYTRI_TEXT(kTurnUp, "Turn or move up", "Nach oben", "Vers le haut", "Arriba")
FLYTRI_TEXT(kTurnDown, "Turn or move down", "Nach unten", "Vers le bas", "Abajo")
FLYTRI_TEXT(kTiltLeft, "Tilt sensor left", "Kippen links", "Incliner à gauche",
            "Inclinar izquierda")
FLYTRI_TEXT(kTiltRight, "Tilt sensor right", "Kippen rechts", "Incliner à droite",
            "Inclinar derecha")
FLYTRI_TEXT(kTiltUp, "Tilt sensor up", "Kippen oben", "Incliner en haut", "Inclinar arriba")
FLYTRI_TEXT(kTiltDown, "Tilt sensor down", "Kippen unten", "Incliner en bas", "Inclinar abajo")
FLYTRI_TEXT(kMoveCloser, "Move sensor closer", "Sensor näher", "Rapprocher capteur",
            "Acercar sensor")
FLYTRI_TEXT(kMoveAway, "Move sensor away", "Sensor weiter weg", "Éloigner capteur", "Alejar sensor")
FLYTRI_TEXT(kMoveByHand, "Move sensor by hand", "Sensor von Hand", "Capteur à la main",
            "Sensor a mano")
FLYTRI_TEXT(kLiftOrReturn, "Lift or return sensor", "Sensor abheben", "Lever le capteur",
            "Levantar sensor")

FLYTRI_TEXT(kRecordRawImages, "Record raw images", "Rohbilder aufnehmen", "Enregistrer images",
            "Grabar imágenes")

// Calibration.
FLYTRI_TEXT(kCalibration, "Calibration", "Kalibrierung", "Étalonnage", "Calibración")
FLYTRI_TEXT(kCalibrateSensor, "Calibrate sensor", "Sensor kalibrieren", "Étalonner capteur",
            "Calibrar sensor")
FLYTRI_TEXT(kCheckOnPlane, "Check on a plane", "An Ebene prüfen", "Vérifier sur plan",
            "Comprobar en plano")
FLYTRI_TEXT(kCheckOnSphere, "Check on a sphere", "An Kugel prüfen", "Vérifier sur sphère",
            "Comprobar en esfera")
FLYTRI_TEXT(kRepeatPlace, "Repeat previous place", "Vorige wiederholen", "Refaire précédente",
            "Repetir anterior")

FLYTRI_TEXT(kSetUpSensor, "Set up sensor", "Sensor einrichten", "Installer capteur",
            "Instalar sensor")
FLYTRI_TEXT(kBeginSetup, "Find devices", "Geräte suchen", "Chercher appareils", "Buscar equipos")
FLYTRI_TEXT(kUseVirtualSensor, "Use virtual sensor", "Virtueller Sensor", "Capteur virtuel",
            "Sensor virtual")

// Program.
FLYTRI_TEXT(kExport, "Export", "Export", "Exporter", "Exportar")
FLYTRI_TEXT(kOpenExportFolder, "Open export folder", "Ordner öffnen", "Ouvrir le dossier",
            "Abrir carpeta")
FLYTRI_TEXT(kCases, "Cases", "Fälle", "Cas", "Casos")
FLYTRI_TEXT(kSettings, "Settings", "Einstellungen", "Réglages", "Ajustes")
FLYTRI_TEXT(kCamerasAndLights, "Cameras and lights", "Kameras und Lichter", "Caméras et éclairage",
            "Cámaras y luces")
FLYTRI_TEXT(kCheckDevices, "Check devices", "Geräte prüfen", "Vérifier appareils",
            "Comprobar equipos")
FLYTRI_TEXT(kKeys, "Keys", "Tasten", "Touches", "Teclas")
FLYTRI_TEXT(kSound, "Sound", "Ton", "Son", "Sonido")
FLYTRI_TEXT(kFullScreen, "Full screen", "Vollbild", "Plein écran", "Pantalla completa")
FLYTRI_TEXT(kLargerInterface, "Larger interface", "Größere Anzeige", "Affichage plus grand",
            "Interfaz mayor")
FLYTRI_TEXT(kSmallerInterface, "Smaller interface", "Kleinere Anzeige", "Affichage plus petit",
            "Interfaz menor")
FLYTRI_TEXT(kConfirm, "Confirm", "Bestätigen", "Valider", "Confirmar")
FLYTRI_TEXT(kCancelOrClose, "Cancel or close", "Abbrechen", "Annuler ou fermer",
            "Cancelar o cerrar")
FLYTRI_TEXT(kQuit, "Quit", "Beenden", "Quitter", "Salir")

// Why an action is not possible, or its setting: short, for the list of keys.
FLYTRI_TEXT(kOpeningTheCase, "opening the case", "Fall wird geöffnet", "ouverture du cas",
            "abriendo el caso")
FLYTRI_TEXT(kFinishing, "finishing", "schließt ab", "finalisation", "finalizando")
FLYTRI_TEXT(kFinished, "finished", "abgeschlossen", "terminé", "finalizado")
FLYTRI_TEXT(kCaseIsReadOnly, "the case is read-only", "Fall schreibgeschützt",
            "cas en lecture seule", "solo lectura")
FLYTRI_TEXT(kScanning, "scanning", "läuft", "en cours", "en curso")
FLYTRI_TEXT(kPaused, "paused", "angehalten", "en pause", "en pausa")
FLYTRI_TEXT(kNothingScanned, "nothing scanned yet", "noch kein Scan", "rien de scanné",
            "nada escaneado")
FLYTRI_TEXT(kOnlyWhenLost, "only when lost", "nur bei Verlust", "seulement si perdu",
            "solo si se pierde")
FLYTRI_TEXT(kNoHolesFound, "no holes found", "keine Löcher", "aucun trou", "sin huecos")
FLYTRI_TEXT(kScanned, "scanned", "gescannt", "scanné", "escaneado")
FLYTRI_TEXT(kEmpty, "empty", "leer", "vide", "vacío")
FLYTRI_TEXT(kNothingToUndo, "nothing to undo", "keine Änderung", "rien à annuler",
            "nada que deshacer")
FLYTRI_TEXT(kNothingToRedo, "nothing to redo", "nichts widerrufen", "rien à rétablir",
            "nada que rehacer")
FLYTRI_TEXT(kResumeFirst, "resume scanning first", "erst Scan fortsetzen", "reprendre d’abord",
            "reanudar primero")
FLYTRI_TEXT(kActive, "active", "aktiv", "actif", "activo")
FLYTRI_TEXT(kChooseBrushFirst, "choose a brush first", "erst Pinsel wählen", "choisir un pinceau",
            "elegir pincel")
FLYTRI_TEXT(kNoneYet, "none yet", "noch keiner", "aucune", "ninguna")
FLYTRI_TEXT(kOn, "on", "ein", "activé", "activado")
FLYTRI_TEXT(kOff, "off", "aus", "désactivé", "desactivado")
FLYTRI_TEXT(kOnlyWithTexture, "only with texture", "nur mit Textur", "avec texture seule",
            "solo con textura")
FLYTRI_TEXT(kNeedsWholeArch, "needs a whole arch", "braucht Zahnbogen", "arcade entière",
            "arcada completa")
FLYTRI_TEXT(kFollowsScan, "follows the scan", "folgt dem Scan", "suit le scan", "sigue el escaneo")
FLYTRI_TEXT(kSimulatedOnly, "simulated only", "nur simuliert", "simulé seulement", "solo simulado")
FLYTRI_TEXT(kMovesSensor, "moves sensor", "bewegt Sensor", "déplace le capteur", "mueve el sensor")
FLYTRI_TEXT(kTurnsView, "turns the view", "dreht die Ansicht", "tourne la vue", "gira la vista")
FLYTRI_TEXT(kByHandIsOff, "By hand is off", "Von Hand ist aus", "pas à la main",
            "a mano desactivado")
FLYTRI_TEXT(kLifted, "lifted", "abgehoben", "levé", "levantado")
FLYTRI_TEXT(kNotForRecordings, "needs the sensor", "Sensor nötig", "capteur requis",
            "requiere el sensor")
FLYTRI_TEXT(kRunning, "running", "läuft", "en cours", "en curso")
FLYTRI_TEXT(kOpenCalibration, "open Calibration", "Kalibrierung öffnen", "ouvrir Étalonnage",
            "abrir Calibración")
FLYTRI_TEXT(kOpenSetup, "open Set up sensor", "Einrichten öffnen", "ouvrir Installer",
            "abrir Instalar")
FLYTRI_TEXT(kInUse, "in use", "in Verwendung", "utilisé", "en uso")
FLYTRI_TEXT(kNoCalibration, "no calibration yet", "nicht kalibriert", "pas d’étalonnage",
            "sin calibración")
FLYTRI_TEXT(kRealSensorOnly, "real sensor only", "nur echter Sensor", "capteur réel seul",
            "solo sensor real")
FLYTRI_TEXT(kEnterDiameter, "enter its diameter", "Durchmesser fehlt", "saisir diamètre",
            "indicar diámetro")
FLYTRI_TEXT(kNotCalibrating, "not calibrating", "keine Kalibrierung", "pas en cours", "no en curso")
FLYTRI_TEXT(kNoImagesYet, "no images yet", "noch keine Bilder", "aucune image", "sin imágenes")
FLYTRI_TEXT(kNothingToExport, "nothing to export yet", "noch kein Scan", "rien à exporter",
            "nada que exportar")
FLYTRI_TEXT(kRealDevicesOnly, "real devices only", "nur echte Geräte", "appareils réels",
            "solo equipo real")
FLYTRI_TEXT(kProblemsFound, "problems found", "Probleme", "problèmes", "hay problemas")
FLYTRI_TEXT(kMuted, "muted", "stumm", "muet", "silenciado")
FLYTRI_TEXT(kChooseTaskFirst, "choose a task first", "erst Aufgabe wählen", "choisir une tâche",
            "elegir una tarea")
FLYTRI_TEXT(kDone, "done", "fertig", "terminé", "listo")
FLYTRI_TEXT(kChoosePlace, "choose a place", "Stelle wählen", "choisir un endroit",
            "elegir un lugar")
FLYTRI_TEXT(kFailed, "failed", "fehlgeschlagen", "échec", "error")
FLYTRI_TEXT(kPleaseWait, "please wait", "bitte warten", "patienter", "esperar")
FLYTRI_TEXT(kCloseDialogFirst, "close the dialog first", "erst Fenster schließen",
            "fermer la fenêtre", "cerrar la ventana")
FLYTRI_TEXT(kStopsCalibration, "stops the calibration", "beendet Kalibrierung",
            "arrête l’étalonnage", "detiene calibración")
FLYTRI_TEXT(kStopsSetup, "stops the setup", "beendet Einrichtung", "arrête l’installation",
            "detiene instalación")
FLYTRI_TEXT(kClosesDialog, "closes the dialog", "schließt das Fenster", "ferme la fenêtre",
            "cierra la ventana")
FLYTRI_TEXT(kPutsToolAway, "puts the tool away", "legt Werkzeug weg", "pose l’outil",
            "deja la herramienta")
FLYTRI_TEXT(kStopsFinishing, "stops finishing", "bricht Abschluss ab", "arrête le calcul",
            "detiene el cálculo")
FLYTRI_TEXT(kDeselectsHole, "deselects the hole", "hebt Auswahl auf", "désélectionne",
            "deselecciona")
FLYTRI_TEXT(kNothingToConfirm, "nothing to confirm", "nichts zu bestätigen", "rien à valider",
            "nada que confirmar")
FLYTRI_TEXT(kNoExportYet, "no export yet", "noch kein Export", "rien d’exporté", "nada exportado")
FLYTRI_TEXT(kNothingToCancel, "nothing to cancel", "nichts abzubrechen", "rien à annuler",
            "nada que cancelar")
FLYTRI_TEXT(kBringsScanBack, "brings the scan back", "holt den Scan zurück", "rétablit le scan",
            "recupera el escaneo")
FLYTRI_TEXT(kNotSavedYet, "not saved yet", "nicht gespeichert", "pas enregistré", "sin guardar")
FLYTRI_TEXT(kNotForTheBite, "not for the bite", "nicht für den Biss", "pas pour le mordu",
            "no para la mordida")
FLYTRI_TEXT(kPlaneIsAutomatic, "is automatic", "ist automatisch", "est automatique",
            "es automático")
FLYTRI_TEXT(kNothingCleared, "nothing cleared", "nichts geleert", "rien d’effacé", "nada vaciado")
FLYTRI_TEXT(kRecordingPlayed, "a recording is played", "eine Aufnahme läuft", "lecture en cours",
            "se reproduce una")
FLYTRI_TEXT(kIsRecording, "recording", "nimmt auf", "enregistre", "graba")
