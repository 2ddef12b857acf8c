/// @file  The dialog of the export, and messages about exports.

FLYTRI_TEXT(kAfterFinish, "after Finish", "nach Abschließen", "après « Terminer »",
            "tras «Finalizar»")
FLYTRI_TEXT(kExists, "exists", "vorhanden", "existe", "existe")
FLYTRI_TEXT(kAboutSize, "about {0}", "etwa {0}", "environ {0}", "unos {0}")
FLYTRI_TEXT(kPointsOnly, "points only; the surface comes with Finish",
            "nur Punkte; die Oberfläche entsteht mit „Abschließen“",
            "points seuls ; la surface vient avec « Terminer »",
            "solo puntos; la superficie se crea con «Finalizar»")
FLYTRI_TEXT(kTriangles, "Triangles", "Dreiecke", "Triangles", "Triángulos")
FLYTRI_TEXT(kDensityFull, "All", "Alle", "Tous", "Todos")
FLYTRI_TEXT(kDensityCad, "For CAD", "Für CAD", "Pour la CAO", "Para CAD")
FLYTRI_TEXT(kDensityLight, "Few", "Wenige", "Peu", "Pocos")
FLYTRI_TEXT(kThousands, "{0} k", "{0} Tsd.", "{0} k", "{0} mil")
FLYTRI_TEXT(kDensityFullHint, "The surface as it was measured",
            "Die Fläche, wie sie gemessen wurde", "La surface telle que mesurée",
            "La superficie tal como se midió")
FLYTRI_TEXT(kDensityCadHint, "At most {0} mm from the full surface, {1} mm RMS",
            "Höchstens {0} mm neben der vollen Fläche, {1} mm RMS",
            "À {0} mm au plus de la surface complète, {1} mm RMS",
            "A {0} mm como máximo de la superficie completa, {1} mm RMS")
FLYTRI_TEXT(kDensityLightHint, "At most {0} mm from the full surface: for a look",
            "Höchstens {0} mm neben der vollen Fläche: zum Ansehen",
            "À {0} mm au plus de la surface complète : pour voir",
            "A {0} mm como máximo de la superficie completa: para ver")
FLYTRI_TEXT(kFolder, "Folder", "Ordner", "Dossier", "Carpeta")
FLYTRI_TEXT(kName, "Name", "Name", "Nom", "Nombre")
FLYTRI_TEXT(kAnd, "and", "und", "et", "y")
FLYTRI_TEXT(kFilesExist,
            "{1} exists already. Replace it, or choose another name.|{1} exist already. Replace "
            "them, or choose another name.",
            "{1} ist schon vorhanden. Ersetzen oder einen anderen Namen wählen.|{1} sind schon "
            "vorhanden. Ersetzen oder einen anderen Namen wählen.",
            "{1} existe déjà. Le remplacer ou choisir un autre nom.|{1} existent déjà. Les "
            "remplacer ou choisir un autre nom.",
            "{1} ya existe. Reemplazarlo o elegir otro nombre.|{1} ya existen. Reemplazarlos o "
            "elegir otro nombre.")
FLYTRI_TEXT(kWrittenTo, "Written to {0}: {1} in all", "Geschrieben nach {0}: insgesamt {1}",
            "Écrit dans {0} : {1} au total", "Escrito en {0}: {1} en total")
FLYTRI_TEXT(kWriting, "Writing…", "Wird geschrieben…", "Écriture…", "Escribiendo…")
FLYTRI_TEXT(kHolesLeft, "{0} hole is left in the surface|{0} holes are left in the surface",
            "In der Oberfläche ist noch {0} Loch|In der Oberfläche sind noch {0} Löcher",
            "Il reste {0} trou dans la surface|Il reste {0} trous dans la surface",
            "Queda {0} hueco en la superficie|Quedan {0} huecos en la superficie")
FLYTRI_TEXT(kExportsAsShown, "Exports the model as shown", "Exportiert das Modell wie angezeigt",
            "Exporte le modèle tel qu’affiché", "Exporta el modelo tal como se muestra")
FLYTRI_TEXT(kAllJaws, "All jaws", "Alle Kiefer", "Tout le cas", "Todo el caso")
FLYTRI_TEXT(kFileCount, "{0} file|{0} files", "{0} Datei|{0} Dateien", "{0} fichier|{0} fichiers",
            "{0} archivo|{0} archivos")
FLYTRI_TEXT(kExportsJawsClosed, "Exports all jaws in one frame, as they bite",
            "Exportiert alle Kiefer in einem Koordinatensystem, im Biss",
            "Exporte les mâchoires dans un même repère, en occlusion",
            "Exporta todos los maxilares en un mismo sistema, en oclusión")
FLYTRI_TEXT(kExportsJawsApart,
            "The jaws will not lie as they bite: each gets its own occlusal plane. Finish upper "
            "jaw, lower jaw and bite first.",
            "Die Kiefer liegen nicht im Biss: jeder in seiner eigenen Okklusionsebene. Zuerst "
            "Oberkiefer, Unterkiefer und Biss abschließen.",
            "Les mâchoires ne seront pas en occlusion : chacune a son propre plan occlusal. "
            "Terminer d’abord le maxillaire, la mandibule et le mordu.",
            "Los maxilares no quedarán en oclusión: cada uno en su propio plano oclusal. Finalizar "
            "antes el maxilar, la mandíbula y la mordida.")
FLYTRI_TEXT(kReport, "Report", "Bericht", "Rapport", "Informe")
FLYTRI_TEXT(kReportPurpose, "a page: how certain the scan is",
            "eine Seite: wie sicher der Scan ist", "une page : la fiabilité du scan",
            "una página: qué fiable es el escaneo")
FLYTRI_TEXT(kReportFor,
            "{0}: distances across the jaw with their uncertainty, coverage, holes, "
            "calibration, edits",
            "{0}: Abstände über den Kiefer mit ihrer Unsicherheit, Abdeckung, Löcher, "
            "Kalibrierung, Änderungen",
            "{0} : distances à travers la mâchoire avec leur incertitude, couverture, trous, "
            "étalonnage, modifications",
            "{0}: distancias a través del maxilar con su incertidumbre, cobertura, huecos, "
            "calibración, cambios")
FLYTRI_TEXT(kNoReport, "the report cannot be made: {0}", "Der Bericht ist nicht möglich: {0}",
            "Le rapport est impossible : {0}", "El informe no es posible: {0}")
FLYTRI_TEXT(kReportNeedsCase, "the scan is in no case; save it first",
            "Der Scan ist in keinem Fall; zuerst speichern",
            "Le scan n’est dans aucun cas ; l’enregistrer d’abord",
            "El escaneo no está en ningún caso; guardarlo antes")
FLYTRI_TEXT(kReplace, "Replace", "Ersetzen", "Remplacer", "Reemplazar")
FLYTRI_TEXT(kOpenFolder, "Open folder", "Ordner öffnen", "Ouvrir le dossier", "Abrir carpeta")
FLYTRI_TEXT(kExportedTo, "Exported to {0}", "Exportiert nach {0}", "Exporté vers {0}",
            "Exportado a {0}")

// Why an export is not possible.
FLYTRI_TEXT(kFinishFirst,
            "{0}: cannot be written before the scan is finished, as it needs the surface: press "
            "Finish, or export points as {1}",
            "{0}: kann erst nach dem Abschließen geschrieben werden, da es die Oberfläche braucht: "
            "„Abschließen“ drücken oder Punkte exportieren als {1}",
            "{0} : ne peut être écrit qu’une fois le scan terminé, car il faut la surface : "
            "appuyer sur « Terminer » ou exporter des points en {1}",
            "{0}: no se puede escribir antes de finalizar el escaneo, pues necesita la superficie: "
            "pulsar «Finalizar» o exportar puntos como {1}")
FLYTRI_TEXT(kNoFolderGiven, "no folder is given; type one, such as {0}",
            "Kein Ordner angegeben; einen eingeben, etwa {0}",
            "Aucun dossier indiqué ; en saisir un, par exemple {0}",
            "No se indicó ninguna carpeta; escribir una, por ejemplo {0}")
FLYTRI_TEXT(
    kOnlyOwnHome, "{0}: only ~/ means a home folder, your own; type the whole path",
    "{0}: nur ~/ steht für einen persönlichen Ordner, den eigenen; den ganzen Pfad eingeben",
    "{0} : seul ~/ désigne un dossier personnel, le vôtre ; saisir le chemin entier",
    "{0}: solo ~/ indica una carpeta personal, la propia; escribir la ruta completa")
FLYTRI_TEXT(kNotAFileName,
            "\"{0}\" cannot be the name of files: a name has no / or \\ and does not begin with a "
            "dot; the folder has a field of its own",
            "„{0}“ ist kein Dateiname: er enthält kein / oder \\ und beginnt nicht mit einem "
            "Punkt; für den Ordner gibt es ein eigenes Feld",
            "« {0} » ne peut pas être un nom de fichier : sans / ni \\ et sans point au début ; le "
            "dossier a son propre champ",
            "«{0}» no puede ser un nombre de archivo: sin / ni \\ y sin punto al principio; la "
            "carpeta tiene su propio campo")
FLYTRI_TEXT(kNoSurfaceToExport, "there is no surface to export yet; scan first",
            "Noch keine Oberfläche zu exportieren; zuerst scannen",
            "Aucune surface à exporter ; scanner d’abord",
            "Aún no hay superficie que exportar; escanear primero")
FLYTRI_TEXT(kNoSuchFolder, "{0}: there is no such folder any more; export again",
            "{0}: Ordner nicht mehr vorhanden; erneut exportieren",
            "{0} : ce dossier n’existe plus ; exporter à nouveau",
            "{0}: esta carpeta ya no existe; exportar de nuevo")
FLYTRI_TEXT(kCannotShowFolder,
            "{0}: cannot be shown, as {1} does not start: {2}; install xdg-utils, or open the "
            "folder yourself",
            "{0}: kann nicht angezeigt werden, da {1} nicht startet: {2}; xdg-utils installieren "
            "oder den Ordner selbst öffnen",
            "{0} : ne peut être affiché, car {1} ne démarre pas : {2} ; installer xdg-utils ou "
            "ouvrir le dossier soi-même",
            "{0}: no se puede mostrar, pues {1} no se inicia: {2}; instalar xdg-utils o abrir la "
            "carpeta a mano")
FLYTRI_TEXT(
    kNoFileManager,
    "{0}: no file manager shows the folder; install one, or open the folder yourself",
    "{0}: kein Dateimanager zeigt den Ordner an; einen installieren oder den Ordner selbst öffnen",
    "{0} : aucun gestionnaire de fichiers n’affiche le dossier ; en installer un ou ouvrir le "
    "dossier soi-même",
    "{0}: ningún gestor de archivos muestra la carpeta; instalar uno o abrir la carpeta a mano")
