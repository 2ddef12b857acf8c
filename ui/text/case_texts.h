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
    kOpenReadOnly, "The case is open read-only. New scans are not saved in it.",
    "Der Fall ist schreibgeschützt geöffnet. Neue Scans werden nicht darin gespeichert.",
    "Le cas est ouvert en lecture seule. Les nouveaux scans n’y sont pas enregistrés.",
    "El caso está abierto en modo de solo lectura. Los nuevos escaneos no se guardan en él.")
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
