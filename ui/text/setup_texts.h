/// @file  The panel in which a sensor is set up. The questions themselves come from hw/setup.

FLYTRI_TEXT(kSetupPurpose,
            "Plug in the cameras and the light switch, and put a white sheet before the sensor. "
            "flytri turns on one light after another, asks what you see, and sets the exposure. "
            "Its questions are in English.",
            "Kameras und Lichtschalter anschließen und ein weißes Blatt vor den Sensor legen. "
            "flytri schaltet ein Licht nach dem anderen ein, fragt, was zu sehen ist, und stellt "
            "die Belichtung ein. Die Fragen sind englisch.",
            "Brancher les caméras et le commutateur d’éclairage, et placer une feuille blanche "
            "devant le capteur. flytri allume chaque lampe, demande ce que l’on voit et règle "
            "l’exposition. Les questions sont en anglais.",
            "Conectar las cámaras y el interruptor de luces, y poner una hoja blanca ante el "
            "sensor. flytri enciende una luz tras otra, pregunta qué se ve y ajusta la exposición. "
            "Las preguntas están en inglés.")
FLYTRI_TEXT(kVirtualSensorPurpose, "Scans a sample jaw without devices, for practice.",
            "Scannt ohne Geräte einen Musterkiefer, zum Üben.",
            "Scanne une mâchoire modèle sans appareils, pour s’exercer.",
            "Escanea una mandíbula de muestra sin equipos, para practicar.")
FLYTRI_TEXT(kSetupIsKept,
            "The program scans with the chosen sensor after its next start, too. An earlier sensor "
            "is kept.",
            "Das Programm scannt auch nach dem nächsten Start mit dem gewählten Sensor. Ein "
            "früherer Sensor bleibt erhalten.",
            "Le programme garde ce capteur au prochain démarrage. Un capteur antérieur est "
            "conservé.",
            "El programa usará este sensor también la próxima vez. Un sensor anterior se conserva.")
FLYTRI_TEXT(kSettingUp, "Looking at the devices…", "Geräte werden untersucht…",
            "Examen des appareils…", "Examinando los equipos…")
FLYTRI_TEXT(kSensorIsSetUp, "The sensor is set up. Calibrate it next.",
            "Der Sensor ist eingerichtet. Als Nächstes kalibrieren.",
            "Le capteur est installé. Il reste à l’étalonner.",
            "El sensor está instalado. Ahora hay que calibrarlo.")
FLYTRI_TEXT(kSetupStopped, "Setup stopped", "Einrichtung abgebrochen", "Installation interrompue",
            "Instalación detenida")
FLYTRI_TEXT(kUseSensor, "Use this sensor", "Sensor verwenden", "Utiliser ce capteur",
            "Usar este sensor")
FLYTRI_TEXT(kSensorIsBeingSetUp, "A sensor is being set up", "Ein Sensor wird eingerichtet",
            "Un capteur est en cours d’installation", "Se está instalando un sensor")
