/// @file  The settings, the list of keys, and the frame of dialogs.

FLYTRI_TEXT(kCloseHint, "Close ({0})", "Schließen ({0})", "Fermer ({0})", "Cerrar ({0})")
FLYTRI_TEXT(kLanguage, "Language", "Sprache", "Langue", "Idioma")
FLYTRI_TEXT(kAutomatic, "Automatic", "Automatisch", "Automatique", "Automático")
FLYTRI_TEXT(kInterfaceSize, "Interface size", "Größe der Anzeige", "Taille de l’affichage",
            "Tamaño de la interfaz")
FLYTRI_TEXT(kTrackingSounds, "Tracking sounds", "Töne bei Verlust und Rückkehr", "Sons de suivi",
            "Sonidos de seguimiento")
FLYTRI_TEXT(kButtonMuted, "Muted", "Stumm", "Muet", "Silenciado")
FLYTRI_TEXT(kButtonOn, "On", "Ein", "Oui", "Sí")
FLYTRI_TEXT(kButtonOff, "Off", "Aus", "Non", "No")
FLYTRI_TEXT(kCloseHoles, "Close holes at Finish, up to", "Löcher beim Abschließen füllen, bis",
            "Fermer les trous en terminant, jusqu’à", "Cerrar huecos al finalizar, hasta")
FLYTRI_TEXT(kCloseHolesHint,
            "What fills a hole was not measured. It is drawn in violet and marked in the files.",
            "Was ein Loch füllt, wurde nicht gemessen. Es ist violett und in den Dateien markiert.",
            "Ce qui ferme un trou n’a pas été mesuré. C’est violet, et marqué dans les fichiers.",
            "Lo que cierra un hueco no se midió. Se ve violeta y queda marcado en los archivos.")
FLYTRI_TEXT(kShow, "Show", "Anzeigen", "Afficher", "Mostrar")
FLYTRI_TEXT(kSensorCalibration, "Sensor calibration", "Sensorkalibrierung", "Étalonnage du capteur",
            "Calibración del sensor")

// Recording raw images.
FLYTRI_TEXT(kRecordingFolder, "Folder for recordings", "Ordner für Aufnahmen",
            "Dossier des enregistrements", "Carpeta para grabaciones")
FLYTRI_TEXT(kRecordingIsOff, "Helps to find out what went wrong",
            "Hilft herauszufinden, was schiefging", "Aide à trouver ce qui n’a pas marché",
            "Ayuda a saber qué falló")
FLYTRI_TEXT(kRecordingNow, "Recording: {0} images, {1}", "Aufnahme: {0} Bilder, {1}",
            "Enregistrement : {0} images, {1}", "Grabando: {0} imágenes, {1}")
FLYTRI_TEXT(kRecorded, "Recorded: {0} images, {1}", "Aufgenommen: {0} Bilder, {1}",
            "Enregistré : {0} images, {1}", "Grabado: {0} imágenes, {1}")
FLYTRI_TEXT(kSpaceFree, "{0} free", "{0} frei", "{0} libres", "{0} libres")
FLYTRI_TEXT(kRecordingHint, "Raw images are saved in {0}. They show the patient’s teeth.",
            "Rohbilder werden in {0} gespeichert. Sie zeigen die Zähne des Patienten.",
            "Les images brutes sont enregistrées dans {0}. Elles montrent les dents du patient.",
            "Las imágenes se guardan en {0}. Muestran los dientes del paciente.")

// The file dialog of the desktop.
FLYTRI_TEXT(kChooseOnComputer, "Choose on this computer", "Auf diesem Computer wählen",
            "Choisir sur cet ordinateur", "Elegir en este equipo")
FLYTRI_TEXT(kOpenACase, "Open a case", "Fall öffnen", "Ouvrir un cas", "Abrir un caso")
FLYTRI_TEXT(kSaveACase, "Save a case", "Fall speichern", "Enregistrer un cas", "Guardar un caso")
FLYTRI_TEXT(kFolderForModels, "Folder for models", "Ordner für Modelle", "Dossier des modèles",
            "Carpeta para modelos")

// The pointer, in the list of keys.
FLYTRI_TEXT(kPointer, "Pointer", "Zeiger", "Pointeur", "Puntero")
FLYTRI_TEXT(kDrag, "Drag", "Ziehen", "Glisser", "Arrastrar")
FLYTRI_TEXT(kDragDoes, "turns the view or uses the tool", "dreht oder nutzt das Werkzeug",
            "tourne ou utilise l’outil", "gira o usa la herramienta")
FLYTRI_TEXT(kRightDrag, "Right drag", "Rechte Taste", "Bouton droit", "Botón derecho")
FLYTRI_TEXT(kRightDragDoes, "turns; with Shift, moves", "dreht; mit Umschalt: verschiebt",
            "tourne ; avec Maj, déplace", "gira; con Mayús, mueve")
FLYTRI_TEXT(kMiddleDrag, "Middle drag", "Mittlere Taste", "Bouton milieu", "Botón central")
FLYTRI_TEXT(kMiddleDragDoes, "moves the view", "verschiebt die Ansicht", "déplace la vue",
            "mueve la vista")
FLYTRI_TEXT(kDoubleClick, "Double click", "Doppelklick", "Double clic", "Doble clic")
FLYTRI_TEXT(kDoubleClickDoes, "brings the place to the middle", "holt die Stelle in die Mitte",
            "centre l’endroit", "centra el lugar")
FLYTRI_TEXT(kWheel, "Wheel", "Rad", "Molette", "Rueda")
FLYTRI_TEXT(kWheelDoes, "zooms or resizes the brush", "zoomt, ändert den Pinsel",
            "zoome, règle le pinceau", "acerca, ajusta el pincel")
