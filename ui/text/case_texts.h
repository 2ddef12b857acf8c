/// @file  The dialog of cases, and messages about cases.

FLYTRI_TEXT(kTabThisCase, "This case", "Dieser Fall", "Ce cas", "Este caso")
FLYTRI_TEXT(kTabNew, "New", "Neu", "Nouveau", "Nuevo")
FLYTRI_TEXT(kTabOpen, "Open", "Öffnen", "Ouvrir", "Abrir")
FLYTRI_TEXT(kPatient, "Patient", "Patient", "Patient", "Paciente")
FLYTRI_TEXT(kDateOfBirth, "Date of birth (year-month-day)", "Geburtsdatum (Jahr-Monat-Tag)",
            "Date de naissance (année-mois-jour)", "Fecha de nacimiento (año-mes-día)")
FLYTRI_TEXT(kPatientNumber, "Patient or case number", "Patienten- oder Fallnummer",
            "Numéro du patient ou du cas", "Número de paciente o de caso")
FLYTRI_TEXT(kDentist, "Dentist", "Behandler", "Praticien", "Odontólogo")
FLYTRI_TEXT(kNotes, "Notes", "Notizen", "Notes", "Notas")
FLYTRI_TEXT(kFile, "File", "Datei", "Fichier", "Archivo")
FLYTRI_TEXT(kNewPassphrase, "Passphrase (empty: not encrypted)", "Passwort (leer: unverschlüsselt)",
            "Mot de passe (vide : non chiffré)", "Contraseña (vacía: sin cifrar)")
FLYTRI_TEXT(kPassphraseAgain, "The same passphrase again", "Dasselbe Passwort noch einmal",
            "Le même mot de passe à nouveau", "La misma contraseña otra vez")
FLYTRI_TEXT(kPassphrase, "Passphrase, if encrypted", "Passwort, falls verschlüsselt",
            "Mot de passe, si chiffré", "Contraseña, si está cifrado")
FLYTRI_TEXT(kSaveTheScan, "Save the scan", "Scan speichern", "Enregistrer le scan",
            "Guardar el escaneo")
FLYTRI_TEXT(kCreate, "Create", "Anlegen", "Créer", "Crear")
FLYTRI_TEXT(kSave, "Save", "Speichern", "Enregistrer", "Guardar")
FLYTRI_TEXT(kOpen, "Open", "Öffnen", "Ouvrir", "Abrir")
FLYTRI_TEXT(kScanWithoutName, "Scan without a name", "Scan ohne Namen", "Scan sans nom",
            "Escaneo sin nombre")
FLYTRI_TEXT(kNoCasesYet, "No cases yet", "Noch keine Fälle", "Aucun cas", "Aún no hay casos")
FLYTRI_TEXT(kNoCaseFits, "No case fits the search", "Kein Fall passt zur Suche",
            "Aucun cas ne correspond à la recherche", "Ningún caso coincide con la búsqueda")
FLYTRI_TEXT(kMoreCases, "{0} more: type in Search to find it|{0} more: type in Search to find them",
            "{0} weiterer: über die Suche zu finden|{0} weitere: über die Suche zu finden",
            "{0} autre : à trouver par la recherche|{0} autres : à trouver par la recherche",
            "{0} más: se encuentra con la búsqueda|{0} más: se encuentran con la búsqueda")
FLYTRI_TEXT(kSearchCases, "Search: patient, number or date", "Suche: Patient, Nummer oder Datum",
            "Recherche : patient, numéro ou date", "Buscar: paciente, número o fecha")
FLYTRI_TEXT(kDiscard, "Discard…", "Verwerfen…", "Supprimer…", "Descartar…")
FLYTRI_TEXT(kDeleteForGood, "Delete for good", "Endgültig löschen", "Supprimer définitivement",
            "Eliminar definitivamente")
FLYTRI_TEXT(kAskDelete, "Delete this scan? It cannot be brought back.",
            "Diesen Scan löschen? Das kann nicht rückgängig gemacht werden.",
            "Supprimer ce scan ? Il ne pourra pas être récupéré.",
            "¿Eliminar este escaneo? No se podrá recuperar.")
FLYTRI_TEXT(kScanIsBeingSaved, "The scan is being saved in its case.",
            "Der Scan wird in seinem Fall gespeichert.",
            "Enregistrement du scan dans son cas en cours.",
            "El escaneo se está guardando en su caso.")
FLYTRI_TEXT(kCaseIsBeingOpened, "The case is being opened.", "Der Fall wird geöffnet.",
            "Ouverture du cas en cours.", "El caso se está abriendo.")
FLYTRI_TEXT(kWriteDate, "Write the date of birth as year-month-day: 1984-03-12",
            "Geburtsdatum als Jahr-Monat-Tag angeben: 1984-03-12",
            "Écrire la date de naissance sous la forme année-mois-jour : 1984-03-12",
            "Escribir la fecha de nacimiento como año-mes-día: 1984-03-12")
FLYTRI_TEXT(kNameTheFile, "Name the file", "Datei benennen", "Nommer le fichier",
            "Dar nombre al archivo")
FLYTRI_TEXT(kChooseACase, "Choose a case", "Fall wählen", "Choisir un cas", "Elegir un caso")
FLYTRI_TEXT(kPassphrasesDiffer, "The two passphrases differ",
            "Die beiden Passwörter sind verschieden", "Les deux mots de passe sont différents",
            "Las dos contraseñas son diferentes")

// Messages.
FLYTRI_TEXT(kWaitForFinishing, "The scan is finishing. Wait until it is done, or cancel it ({0}).",
            "Der Scan wird gerade abgeschlossen. Warten, bis er fertig ist, oder abbrechen ({0}).",
            "Le scan est en cours de finalisation. Attendre la fin ou interrompre ({0}).",
            "El escaneo se está finalizando. Esperar a que termine o cancelar ({0}).")
FLYTRI_TEXT(kWaitForSensor,
            "A case contains the calibration of its sensor. Wait until the sensor is ready.",
            "Ein Fall enthält die Kalibrierung seines Sensors. Warten, bis der Sensor bereit ist.",
            "Un cas contient l’étalonnage de son capteur. Attendre que le capteur soit prêt.",
            "Un caso contiene la calibración de su sensor. Esperar a que el sensor esté listo.")
FLYTRI_TEXT(
    kOpenReadOnly,
    "The case is open read-only. It can be viewed and exported, but not changed. To scan, open "
    "another case.",
    "Der Fall ist schreibgeschützt geöffnet. Er kann betrachtet und exportiert werden, aber nicht "
    "geändert. Zum Scannen einen anderen Fall öffnen.",
    "Le cas est ouvert en lecture seule. On peut le consulter et l’exporter, mais pas le "
    "modifier. Pour scanner, ouvrir un autre cas.",
    "El caso está abierto en modo de solo lectura. Se puede ver y exportar, pero no modificar. "
    "Para escanear, abrir otro caso.")
FLYTRI_TEXT(
    kOtherCalibration,
    "This case was scanned with another calibration. New scans are measured with the sensor's "
    "present calibration. For the texture of the earlier scans, use: flytri reconstruct {0}",
    "Dieser Fall wurde mit einer anderen Kalibrierung gescannt. Neue Scans verwenden die jetzige "
    "Kalibrierung des Sensors. Textur der früheren Scans: flytri reconstruct {0}",
    "Ce cas a été scanné avec un autre étalonnage. Les nouveaux scans utilisent l’étalonnage "
    "actuel du capteur. Pour la texture des scans antérieurs : flytri reconstruct {0}",
    "Este caso se escaneó con otra calibración. Los nuevos escaneos usan la calibración actual del "
    "sensor. Para la textura de los escaneos anteriores: flytri reconstruct {0}")
FLYTRI_TEXT(kModelUnreadable, "the finished model cannot be read ({0}): finish again",
            "Das fertige Modell ist nicht lesbar ({0}): erneut abschließen",
            "Le modèle terminé est illisible ({0}) : le terminer à nouveau",
            "El modelo finalizado no se puede leer ({0}): finalizar de nuevo")
FLYTRI_TEXT(kSavedAgain, "Everything is saved again: {0}", "Alles ist wieder gespeichert: {0}",
            "Tout est de nouveau enregistré : {0}", "Todo está guardado de nuevo: {0}")
FLYTRI_TEXT(kNotSavedBecause, "Not saved: {0}", "Nicht gespeichert: {0}", "Non enregistré : {0}",
            "Sin guardar: {0}")
FLYTRI_TEXT(kUnknownCommand, "Unknown command: {0}", "Unbekannter Befehl: {0}",
            "Commande inconnue : {0}", "Comando desconocido: {0}")

// A damaged case.
FLYTRI_TEXT(kCaseIsDamaged,
            "This case is damaged. Its file stays as it is, and nothing is saved in it.",
            "Dieser Fall ist beschädigt. Seine Datei bleibt, wie sie ist, und nichts wird darin "
            "gespeichert.",
            "Ce cas est endommagé. Son fichier reste tel quel, et rien n’y est enregistré.",
            "Este caso está dañado. Su archivo queda como está y no se guarda nada en él.")
FLYTRI_TEXT(kRescueCopyFile, "Rescue copy: a new file", "Rettungskopie: eine neue Datei",
            "Copie de secours : un nouveau fichier", "Copia de rescate: un archivo nuevo")
FLYTRI_TEXT(kSaveRescueCopy, "Save a rescue copy", "Rettungskopie speichern",
            "Enregistrer une copie de secours", "Guardar una copia de rescate")
FLYTRI_TEXT(kRescueIsBeingSaved, "The rescue copy is being saved.",
            "Die Rettungskopie wird gespeichert.",
            "Enregistrement de la copie de secours en cours.",
            "La copia de rescate se está guardando.")
FLYTRI_TEXT(kRescueOpened, "Rescue copy saved and opened: {0}. The damaged case stays as it is.",
            "Rettungskopie gespeichert und geöffnet: {0}. Der beschädigte Fall bleibt, wie er ist.",
            "Copie de secours enregistrée et ouverte : {0}. Le cas endommagé reste tel quel.",
            "Copia de rescate guardada y abierta: {0}. El caso dañado queda como está.")
FLYTRI_TEXT(kLookingAtDamage, "Looking at what can be read…", "Es wird geprüft, was lesbar ist…",
            "Recherche de ce qui est lisible…", "Buscando lo que se puede leer…")
FLYTRI_TEXT(kReadable,
            "This can be read:", "Das ist lesbar:", "Ceci est lisible :", "Esto se puede leer:")
FLYTRI_TEXT(kNothingReadable, "No scan in it can be read.", "Kein Scan darin ist lesbar.",
            "Aucun scan n’y est lisible.", "No se puede leer ningún escaneo.")
FLYTRI_TEXT(kCopyCanBeScanned, "A copy with all of that can be scanned on.",
            "Eine Kopie mit all dem kann weiter gescannt werden.",
            "Le scan peut continuer dans une copie avec tout cela.",
            "Se puede seguir escaneando en una copia con todo eso.")
FLYTRI_TEXT(kCountViews, "{0} view|{0} views", "{0} Ansicht|{0} Ansichten", "{0} vue|{0} vues",
            "{0} vista|{0} vistas")
FLYTRI_TEXT(kCountTextures, "{0} texture image|{0} texture images",
            "{0} Texturbild|{0} Texturbilder", "{0} image de texture|{0} images de texture",
            "{0} imagen de textura|{0} imágenes de textura")
FLYTRI_TEXT(kCountDistances, "{0} distance|{0} distances", "{0} Abstand|{0} Abstände",
            "{0} mesure|{0} mesures", "{0} medida|{0} medidas")
FLYTRI_TEXT(kTheFinishedModel, "the finished model", "das fertige Modell", "le modèle terminé",
            "el modelo finalizado")
FLYTRI_TEXT(kTheScannedSurface, "the scanned surface", "die gescannte Oberfläche",
            "la surface scannée", "la superficie escaneada")
FLYTRI_TEXT(kTrimsAndLocks, "trims and locks", "Schnitte und Sperren", "découpes et verrous",
            "recortes y bloqueos")
FLYTRI_TEXT(kAndMore, "and {0} more", "und {0} weitere", "et {0} autres", "y {0} más")
FLYTRI_TEXT(kDamageAndMore, "{0}, and {1} more", "{0}, und {1} weitere", "{0}, et {1} autres",
            "{0}, y {1} más")

// Questions before something is lost.
FLYTRI_TEXT(kAskClear, "{0}: clear everything?", "{0}: alles leeren?", "{0} : tout effacer ?",
            "{0}: ¿vaciar todo?")
FLYTRI_TEXT(
    kClearText,
    "This goes: {0}. The case keeps it until the stage is cleared again, and Undo brings it back.",
    "Das geht weg: {0}. Der Fall behält es, bis die Stufe erneut geleert wird, und Rückgängig holt "
    "es zurück.",
    "Ceci disparaît : {0}. Le cas le garde jusqu’à ce que l’étape soit vidée à nouveau, et Annuler "
    "le rétablit.",
    "Esto desaparece: {0}. El caso lo conserva hasta que la etapa se vacíe de nuevo, y Deshacer lo "
    "recupera.")
FLYTRI_TEXT(kClearAgainText,
            "The scan that was cleared before is deleted for good. To go on with that one instead, "
            "bring it back.",
            "Der zuvor geleerte Scan wird endgültig gelöscht. Um stattdessen mit ihm "
            "weiterzumachen, diesen zurückholen.",
            "Le scan effacé auparavant est supprimé définitivement. Pour continuer plutôt avec "
            "lui, le rétablir.",
            "El escaneo vaciado antes se elimina definitivamente. Para seguir con él, recuperarlo.")
FLYTRI_TEXT(kClear, "Clear", "Leeren", "Effacer", "Vaciar")
FLYTRI_TEXT(kBringBack, "Bring back", "Zurückholen", "Rétablir", "Recuperar")
FLYTRI_TEXT(kAskScanAgain, "Scan again?", "Weiter scannen?", "Reprendre le scan ?",
            "¿Escanear de nuevo?")
FLYTRI_TEXT(kScanAgainText,
            "The finished model was not exported. Once you scan, Finish makes another model, with "
            "the new views. Export this one first if you need it.",
            "Das fertige Modell wurde nicht exportiert. Nach weiterem Scannen entsteht beim "
            "Abschließen ein anderes Modell, mit den neuen Ansichten. Dieses vorher exportieren, "
            "wenn es gebraucht wird.",
            "Le modèle terminé n’a pas été exporté. Après un nouveau scan, Terminer crée un autre "
            "modèle, avec les nouvelles vues. Exporter d’abord celui-ci s’il est nécessaire.",
            "El modelo finalizado no se exportó. Tras escanear más, Finalizar crea otro modelo, "
            "con las nuevas vistas. Exportar antes este si se necesita.")
FLYTRI_TEXT(kButtonScanAgain, "Scan again", "Weiter scannen", "Reprendre", "Escanear")
FLYTRI_TEXT(kAskLeave, "Leave without saving?", "Ohne Speichern verlassen?",
            "Quitter sans enregistrer ?", "¿Salir sin guardar?")
FLYTRI_TEXT(kLeaveText, "Not everything is saved, and what is not is lost: {0}",
            "Nicht alles ist gespeichert, und der Rest geht verloren: {0}",
            "Tout n’est pas enregistré, et le reste sera perdu : {0}",
            "No todo está guardado, y el resto se pierde: {0}")
FLYTRI_TEXT(kAskLeaveExport, "Leave before the export is written?",
            "Beenden, bevor der Export geschrieben ist?", "Quitter avant la fin de l’exportation ?",
            "¿Salir antes de que termine la exportación?")
FLYTRI_TEXT(kLeaveExportText,
            "The files of the export are still being written. If you leave now, they are missing.",
            "Die Dateien des Exports werden noch geschrieben. Wenn Sie jetzt beenden, fehlen sie.",
            "Les fichiers de l’exportation sont en cours d’écriture. Si vous quittez maintenant, "
            "ils manqueront.",
            "Los archivos de la exportación se están escribiendo. Si sale ahora, faltarán.")
FLYTRI_TEXT(kLeave, "Leave", "Verlassen", "Quitter quand même", "Salir igualmente")
