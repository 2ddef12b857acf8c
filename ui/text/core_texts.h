/// @file  Fixed words of core and of devices. Texts::translated() finds them by their English
/// words, which must be those of the source that is named above them.

// hw/simulated/devices/live_sensor.h: the name of the sensor.
FLYTRI_TEXT(kVirtualSensor, "virtual sensor", "virtueller Sensor", "capteur virtuel",
            "sensor virtual")

// hw/device: states of cameras and lights.
FLYTRI_TEXT(kDeviceIdle, "idle", "bereit", "inactif", "inactivo")
FLYTRI_TEXT(kDeviceRunning, "running", "läuft", "en marche", "en marcha")
FLYTRI_TEXT(kDeviceFrozen, "frozen", "eingefroren", "figé", "bloqueado")
FLYTRI_TEXT(kDeviceLost, "lost", "verloren", "perdu", "perdido")
FLYTRI_TEXT(kDeviceFailed, "failed", "ausgefallen", "en panne", "averiado")

// core/reconstruct/finish_scan.h: steps of finishing.
FLYTRI_TEXT(kStepRecovering, "Recovering lost frames", "Verlorene Bilder zuordnen",
            "Récupération d’images", "Recuperando imágenes")
FLYTRI_TEXT(kStepAligning, "Aligning the scan", "Scan wird ausgerichtet", "Alignement du scan",
            "Alineando el escaneo")
FLYTRI_TEXT(kStepNormals, "Calculating normals", "Normalen berechnen", "Calcul des normales",
            "Calculando normales")
FLYTRI_TEXT(kStepSimplifying, "Simplifying", "Vereinfachen", "Simplification", "Simplificando")
FLYTRI_TEXT(kStepMeshing, "Meshing", "Oberfläche bilden", "Création de la surface",
            "Creando la superficie")
FLYTRI_TEXT(kStepTexturing, "Texturing", "Textur auftragen", "Application de la texture",
            "Aplicando la textura")

// core/reconstruct/jaw_spans.cpp: distances across a jaw.
FLYTRI_TEXT(kSpanLastTeeth, "last teeth, left to right", "Letzte Zähne, l.\u2013r.",
            "Dernières dents, g.\u2013d.", "Últimos dientes, i.\u2013d.")
FLYTRI_TEXT(kSpanPremolars, "premolars, left to right", "Prämolaren, l.\u2013r.",
            "Prémolaires, g.\u2013d.", "Premolares, i.\u2013d.")
FLYTRI_TEXT(kSpanHalfLeft, "front to last tooth, left", "Front bis hinten, links",
            "Avant à arrière, gauche", "Delante a detrás, izq.")
FLYTRI_TEXT(kSpanHalfRight, "front to last tooth, right", "Front bis hinten, rechts",
            "Avant à arrière, droite", "Delante a detrás, der.")
FLYTRI_TEXT(kSpanHalfOne, "front to last tooth, one side", "Front bis hinten, eine Seite",
            "Avant à arrière, un côté", "Delante a detrás, un lado")
FLYTRI_TEXT(kSpanLength, "end to end", "Ende zu Ende", "Bout à bout", "De extremo a extremo")

// core/io/models/model_formats.cpp: what a format is good for.
FLYTRI_TEXT(kForGlb, "one file, with texture", "eine Datei, mit Textur",
            "un seul fichier, avec texture", "un solo archivo, con textura")
FLYTRI_TEXT(kForPly, "surface with colors", "Oberfläche mit Farben", "surface avec couleurs",
            "superficie con colores")
FLYTRI_TEXT(kForStl, "shape only, for printing", "nur Form, zum Drucken",
            "forme seule, pour l’impression", "solo forma, para impresión")
FLYTRI_TEXT(kForObj, "with texture, for dental CAD", "mit Textur, für dentales CAD",
            "avec texture, pour CAO dentaire", "con textura, para CAD dental")

// core/calibration/guide/calibration_plan.cpp: targets and images.
FLYTRI_TEXT(kWhitePlane, "white plane", "weiße Ebene", "plan blanc", "plano blanco")
FLYTRI_TEXT(kDotTarget, "dot target", "Punktetafel", "mire de points", "placa de puntos")
FLYTRI_TEXT(kShotDark, "dark", "dunkel", "sombre", "oscuro")
FLYTRI_TEXT(kShotVertical, "vertical lines", "vertikale Linien", "lignes verticales",
            "líneas verticales")
FLYTRI_TEXT(kShotHorizontal, "horizontal lines", "horizontale Linien", "lignes horizontales",
            "líneas horizontales")
FLYTRI_TEXT(kShotVerticalAgain, "vertical lines again", "vertikale Linien erneut",
            "verticales à nouveau", "verticales de nuevo")
FLYTRI_TEXT(kShotDots, "dots", "Punkte", "points", "puntos")
FLYTRI_TEXT(kShotDotsInColor, "dots in color", "Punkte in Farbe", "points en couleur",
            "puntos en color")

// hw/shots/verification_shots.cpp: places of a check.
FLYTRI_TEXT(kPlaceMiddle, "in the middle of the volume", "in der Mitte des Volumens",
            "au milieu du volume", "en el centro del volumen")
FLYTRI_TEXT(kPlaceNear, "near", "nah", "près", "cerca")
FLYTRI_TEXT(kPlaceFar, "far", "fern", "loin", "lejos")
FLYTRI_TEXT(kPlaceTiltedLeft, "in the middle, tilted to the left",
            "in der Mitte, nach links geneigt", "au milieu, incliné à gauche",
            "en el centro, inclinado a la izquierda")
FLYTRI_TEXT(kPlaceTiltedUp, "in the middle, tilted upwards", "in der Mitte, nach oben geneigt",
            "au milieu, incliné vers le haut", "en el centro, inclinado hacia arriba")
FLYTRI_TEXT(kPlaceTiltedRight, "a little farther, tilted to the right",
            "etwas weiter weg, nach rechts geneigt", "un peu plus loin, incliné à droite",
            "un poco más lejos, inclinado a la derecha")

// core/calibration/guide/shot_verdict.cpp: what to do about an image.
FLYTRI_TEXT(kRemedyWrongImage,
            "Set the camera to the format and image size that the session started with.",
            "Kamera auf Format und Bildgröße einstellen, mit denen die Sitzung begann.",
            "Régler la caméra sur le format et la taille d’image du début de la session.",
            "Ajustar la cámara al formato y tamaño de imagen con que empezó la sesión.")
FLYTRI_TEXT(kRemedyStrayLight,
            "Turn off or move the lamp, and remove or tilt objects that reflect light.",
            "Lampe ausschalten oder wegdrehen; spiegelnde Gegenstände entfernen oder kippen.",
            "Éteindre ou déplacer la lampe, et retirer ou incliner les objets réfléchissants.",
            "Apagar o mover la lámpara, y retirar o inclinar los objetos que reflejan luz.")
FLYTRI_TEXT(kRemedyLightStaysOn,
            "Check the cables of the projectors: a light that stays on is connected wrongly.",
            "Kabel der Projektoren prüfen: ein Licht, das an bleibt, ist falsch angeschlossen.",
            "Vérifier les câbles des projecteurs : une lumière qui reste allumée est mal branchée.",
            "Comprobar los cables de los proyectores: una luz que no se apaga está mal conectada.")
FLYTRI_TEXT(
    kRemedyTooDark,
    "Increase the exposure time, open the aperture, or check that the light falls on the target.",
    "Belichtungszeit erhöhen, Blende öffnen oder prüfen, ob das Licht auf die Tafel fällt.",
    "Augmenter le temps d’exposition, ouvrir le diaphragme ou vérifier que la lumière tombe sur la "
    "mire.",
    "Aumentar el tiempo de exposición, abrir el diafragma o comprobar que la luz cae sobre la "
    "placa.")
FLYTRI_TEXT(kRemedySaturated, "Reduce the exposure time or the gain.",
            "Belichtungszeit oder Verstärkung senken.", "Réduire le temps d’exposition ou le gain.",
            "Reducir el tiempo de exposición o la ganancia.")
FLYTRI_TEXT(kRemedyDefocused,
            "Clean the lenses. Focus camera and projectors on the front of the volume and lock "
            "them. If the focus was changed, start the session again.",
            "Linsen reinigen. Kamera und Projektoren auf die Vorderseite des Volumens scharf "
            "stellen und feststellen. Nach einer Änderung die Sitzung neu beginnen.",
            "Nettoyer les objectifs. Faire la mise au point de la caméra et des projecteurs sur "
            "l’avant du volume et la bloquer. Si elle a changé, recommencer la session.",
            "Limpiar las lentes. Enfocar cámara y proyectores en la parte delantera del volumen y "
            "fijarlos. Si se cambió el enfoque, empezar de nuevo la sesión.")
FLYTRI_TEXT(kRemedyLinesMissing,
            "Clean the white plane. Check that it fills the image and has no shadow on it.",
            "Weiße Ebene reinigen. Prüfen, ob sie das Bild füllt und kein Schatten auf ihr liegt.",
            "Nettoyer le plan blanc. Vérifier qu’il remplit l’image et qu’il est sans ombre.",
            "Limpiar el plano blanco. Comprobar que llena la imagen y no tiene sombras.")
FLYTRI_TEXT(
    kRemedyOtherPattern,
    "Swap the cables of the vertical and the horizontal projector, or their lines in rig.json.",
    "Kabel des vertikalen und des horizontalen Projektors tauschen, oder ihre Zeilen in rig.json.",
    "Échanger les câbles des projecteurs vertical et horizontal, ou leurs lignes dans rig.json.",
    "Intercambiar los cables del proyector vertical y el horizontal, o sus líneas en rig.json.")
FLYTRI_TEXT(kRemedyRoomLight, "Do not change the room light while the images of a plane are taken.",
            "Raumlicht nicht ändern, während die Bilder einer Ebene aufgenommen werden.",
            "Ne pas changer l’éclairage de la pièce pendant la prise des images d’un plan.",
            "No cambiar la luz de la sala mientras se toman las imágenes de un plano.")
FLYTRI_TEXT(
    kRemedyPlaneMoved,
    "Wait until the stage is at rest, lock it, and do not touch it during the shots.",
    "Warten, bis der Tisch ruht, ihn feststellen und während der Aufnahmen nicht berühren.",
    "Attendre que la platine soit immobile, la bloquer et ne pas la toucher pendant les prises.",
    "Esperar a que la mesa esté en reposo, fijarla y no tocarla durante las tomas.")
FLYTRI_TEXT(kRemedyWrongDepth,
            "Set the stage to the requested depth. If it is already there, an earlier plane was "
            "wrong: go back and take that plane again.",
            "Tisch auf die verlangte Tiefe stellen. Steht er schon dort, war eine frühere Ebene "
            "falsch: zurückgehen und sie neu aufnehmen.",
            "Régler la platine à la profondeur demandée. Si elle y est déjà, un plan antérieur "
            "était faux : revenir en arrière et le refaire.",
            "Poner la mesa a la profundidad pedida. Si ya está ahí, un plano anterior era erróneo: "
            "volver atrás y repetirlo.")
FLYTRI_TEXT(
    kRemedyMovedSideways,
    "Put the target back into its holder as before. The stage must move it only in depth.",
    "Tafel wieder wie zuvor in den Halter setzen. Der Tisch darf sie nur in der Tiefe bewegen.",
    "Remettre la mire dans son support comme avant. La platine ne doit la déplacer qu’en "
    "profondeur.",
    "Volver a poner la placa en su soporte como antes. La mesa solo debe moverla en profundidad.")
FLYTRI_TEXT(
    kRemedyNoDots,
    "Insert the dot target so that it faces the sensor and fills the image. Clean and uncover it.",
    "Punktetafel so einsetzen, dass sie zum Sensor zeigt und das Bild füllt. Reinigen und "
    "freimachen.",
    "Placer la mire de points face au capteur pour qu’elle remplisse l’image. La nettoyer et la "
    "dégager.",
    "Colocar la placa de puntos de cara al sensor y que llene la imagen. Limpiarla y despejarla.")
FLYTRI_TEXT(kRemedyMarkersHidden,
            "Uncover and clean the three large dots near the center of the target.",
            "Die drei großen Punkte nahe der Tafelmitte freimachen und reinigen.",
            "Dégager et nettoyer les trois gros points près du centre de la mire.",
            "Despejar y limpiar los tres puntos grandes cerca del centro de la placa.")
FLYTRI_TEXT(kRemedyMirrored, "Turn the target around: its dots must face the sensor.",
            "Tafel umdrehen: ihre Punkte müssen zum Sensor zeigen.",
            "Retourner la mire : ses points doivent faire face au capteur.",
            "Dar la vuelta a la placa: sus puntos deben mirar al sensor.")
FLYTRI_TEXT(kFindingMirrored, "the three large dots are arranged as in a mirror image",
            "die drei großen Punkte sind spiegelverkehrt angeordnet",
            "les trois gros points sont disposés comme dans un miroir",
            "los tres puntos grandes están dispuestos como en un espejo")
FLYTRI_TEXT(kFindingNoDots, "no dots found", "keine Punkte gefunden", "aucun point trouvé",
            "no se encontraron puntos")

// core/calibration/verify: deviations.
FLYTRI_TEXT(kFigureOffset, "vertical minus horizontal", "vertikal minus horizontal",
            "vertical moins horizontal", "vertical menos horizontal")
FLYTRI_TEXT(kFigureOffsetX, "... left to right", "… links nach rechts", "… de gauche à droite",
            "… de izquierda a derecha")
FLYTRI_TEXT(kFigureOffsetY, "... top to bottom", "… oben nach unten", "… de haut en bas",
            "… de arriba abajo")
FLYTRI_TEXT(kFigureOffsetZ, "... near to far", "… nah nach fern", "… de près à loin",
            "… de cerca a lejos")
FLYTRI_TEXT(kFigureOwnBendX, "... bend left to right", "… Biegung links–rechts",
            "… courbure gauche-droite", "… curvatura izq.-der.")
FLYTRI_TEXT(kFigureOwnTwist, "... twist", "… Verwindung", "… torsion", "… torsión")
FLYTRI_TEXT(kFigureOwnBendY, "... bend top to bottom", "… Biegung oben–unten",
            "… courbure haut-bas", "… curvatura arriba-abajo")
FLYTRI_TEXT(kFigureBendX, "bend left to right", "Biegung links–rechts", "courbure gauche-droite",
            "curvatura izquierda-derecha")
FLYTRI_TEXT(kFigureTwist, "twist", "Verwindung", "torsion", "torsión")
FLYTRI_TEXT(kFigureBendY, "bend top to bottom", "Biegung oben–unten", "courbure haut-bas",
            "curvatura arriba-abajo")
FLYTRI_TEXT(kFigureDiameter, "diameter", "Durchmesser", "diamètre", "diámetro")
FLYTRI_TEXT(kFigureNotSquareX, "stage not square, along x", "Tisch nicht rechtwinklig, in x",
            "platine non perpendiculaire, en x", "mesa no perpendicular, en x")
FLYTRI_TEXT(kFigureNotSquareY, "stage not square, along y", "Tisch nicht rechtwinklig, in y",
            "platine non perpendiculaire, en y", "mesa no perpendicular, en y")
FLYTRI_TEXT(kFigureScatter, "scatter", "Streuung", "dispersion", "dispersión")

// core/calibration/verify/verification_report.cpp: what has probably happened.
FLYTRI_TEXT(kMeansRoll,
            "The difference between the patterns changes from left to right and from top to "
            "bottom: the camera has rolled about its axis, or both projectors have.",
            "Der Unterschied der Muster ändert sich von links nach rechts und von oben nach unten: "
            "die Kamera oder beide Projektoren haben sich um ihre Achse gedreht.",
            "L’écart entre les motifs varie de gauche à droite et de haut en bas : la caméra, ou "
            "les deux projecteurs, ont tourné autour de leur axe.",
            "La diferencia entre los patrones cambia de izquierda a derecha y de arriba abajo: la "
            "cámara, o ambos proyectores, han girado sobre su eje.")
FLYTRI_TEXT(
    kMeansRollY,
    "The difference between the patterns changes from top to bottom: the vertical projector has "
    "rolled about its axis, or the horizontal projector has moved along its axis.",
    "Der Unterschied der Muster ändert sich von oben nach unten: der vertikale Projektor hat sich "
    "um seine Achse gedreht, oder der horizontale hat sich entlang seiner Achse bewegt.",
    "L’écart entre les motifs varie de haut en bas : le projecteur vertical a tourné autour de son "
    "axe, ou le projecteur horizontal s’est déplacé le long du sien.",
    "La diferencia entre los patrones cambia de arriba abajo: el proyector vertical ha girado "
    "sobre su eje, o el horizontal se ha desplazado a lo largo del suyo.")
FLYTRI_TEXT(
    kMeansRollX,
    "The difference between the patterns changes from left to right: the horizontal projector has "
    "rolled about its axis, or the vertical projector has moved along its axis.",
    "Der Unterschied der Muster ändert sich von links nach rechts: der horizontale Projektor hat "
    "sich um seine Achse gedreht, oder der vertikale hat sich entlang seiner Achse bewegt.",
    "L’écart entre les motifs varie de gauche à droite : le projecteur horizontal a tourné autour "
    "de son axe, ou le projecteur vertical s’est déplacé le long du sien.",
    "La diferencia entre los patrones cambia de izquierda a derecha: el proyector horizontal ha "
    "girado sobre su eje, o el vertical se ha desplazado a lo largo del suyo.")
FLYTRI_TEXT(kMeansOffset,
            "Vertical and horizontal lines measure different depths: a projector or the camera has "
            "turned or moved across its lines.",
            "Vertikale und horizontale Linien messen verschiedene Tiefen: ein Projektor oder die "
            "Kamera hat sich quer zu den Linien gedreht oder bewegt.",
            "Les lignes verticales et horizontales mesurent des profondeurs différentes : un "
            "projecteur ou la caméra a tourné ou s’est déplacé en travers de ses lignes.",
            "Las líneas verticales y horizontales miden profundidades distintas: un proyector o la "
            "cámara ha girado o se ha movido a través de sus líneas.")
FLYTRI_TEXT(
    kMeansMagnification,
    "The image has another scale: the camera has moved along its axis, or its lens was refocused.",
    "Das Bild hat einen anderen Maßstab: die Kamera hat sich entlang ihrer Achse bewegt, oder ihr "
    "Objektiv wurde neu scharf gestellt.",
    "L’image a une autre échelle : la caméra s’est déplacée le long de son axe, ou son objectif a "
    "été réglé à nouveau.",
    "La imagen tiene otra escala: la cámara se ha movido a lo largo de su eje, o se ha reenfocado "
    "su lente.")
FLYTRI_TEXT(
    kMeansOwnBend,
    "The two patterns measure a different curvature: a projector's lens was moved or refocused.",
    "Die beiden Muster messen verschiedene Krümmungen: das Objektiv eines Projektors wurde bewegt "
    "oder neu scharf gestellt.",
    "Les deux motifs mesurent une courbure différente : l’objectif d’un projecteur a été déplacé "
    "ou réglé à nouveau.",
    "Los dos patrones miden una curvatura distinta: la lente de un proyector se ha movido o "
    "reenfocado.")
FLYTRI_TEXT(kMeansBend,
            "A flat surface is measured as curved: the camera's lens was moved or refocused, or "
            "the camera has moved.",
            "Eine ebene Fläche wird gekrümmt gemessen: das Objektiv der Kamera wurde bewegt oder "
            "neu scharf gestellt, oder die Kamera hat sich bewegt.",
            "Une surface plane est mesurée courbe : l’objectif de la caméra a été déplacé ou réglé "
            "à nouveau, ou la caméra s’est déplacée.",
            "Una superficie plana se mide curva: la lente de la cámara se ha movido o reenfocado, "
            "o la cámara se ha movido.")
FLYTRI_TEXT(
    kMeansDiameter,
    "Measured sizes are wrong: the camera has moved along its axis, or its lens was refocused.",
    "Gemessene Größen sind falsch: die Kamera hat sich entlang ihrer Achse bewegt, oder ihr "
    "Objektiv wurde neu scharf gestellt.",
    "Les dimensions mesurées sont fausses : la caméra s’est déplacée le long de son axe, ou son "
    "objectif a été réglé à nouveau.",
    "Los tamaños medidos son erróneos: la cámara se ha movido a lo largo de su eje, o se ha "
    "reenfocado su lente.")
FLYTRI_TEXT(
    kMeansShear,
    "A sphere is measured as a leaning egg: the stage did not move at right angles to the target "
    "when the sensor was calibrated. flytri calibrate --check --sphere MM --correct FILE corrects "
    "it.",
    "Eine Kugel wird als schiefes Ei gemessen: der Tisch fuhr beim Kalibrieren nicht rechtwinklig "
    "zur Tafel. flytri calibrate --check --sphere MM --correct DATEI korrigiert das.",
    "Une sphère est mesurée comme un œuf penché : lors de la calibration, la platine ne se "
    "déplaçait pas perpendiculairement à la mire. flytri calibrate --check --sphere MM --correct "
    "FICHIER le corrige.",
    "Una esfera se mide como un huevo inclinado: al calibrar, la mesa no se movía en ángulo recto "
    "con la diana. flytri calibrate --check --sphere MM --correct ARCHIVO lo corrige.")
FLYTRI_TEXT(kMeansForm,
            "Points scatter more than expected from noise: lenses are dirty or out of focus, or "
            "the object is not smooth enough.",
            "Punkte streuen stärker als durch Rauschen zu erwarten: Linsen sind verschmutzt oder "
            "unscharf, oder das Objekt ist nicht glatt genug.",
            "Les points se dispersent plus que le bruit ne l’explique : objectifs sales ou mal "
            "réglés, ou objet pas assez lisse.",
            "Los puntos se dispersan más de lo que explica el ruido: lentes sucias o desenfocadas, "
            "u objeto no lo bastante liso.")

// app/desktop/portal_file_chooser.cpp: why there is no file dialog.
FLYTRI_TEXT(kDialogIsAskedFor,
            "The desktop is being asked for its file dialog; type the path meanwhile",
            "Der Dateidialog des Desktops wird gesucht; den Pfad solange eintippen",
            "Recherche de la fenêtre de fichiers du bureau ; saisir le chemin entre-temps",
            "Se busca el diálogo de archivos del escritorio; escribir la ruta mientras")
FLYTRI_TEXT(kNoFileDialog,
            "This desktop offers no file dialog; install xdg-desktop-portal with a backend, or "
            "type the path",
            "Dieser Desktop hat keinen Dateidialog; xdg-desktop-portal mit einem Backend "
            "installieren oder den Pfad eintippen",
            "Ce bureau n’a pas de fenêtre de fichiers ; installer xdg-desktop-portal avec un "
            "backend, ou saisir le chemin",
            "Este escritorio no tiene diálogo de archivos; instalar xdg-desktop-portal con un "
            "backend, o escribir la ruta")
FLYTRI_TEXT(kNoSessionBus, "This desktop offers no file dialog (no D-Bus session); type the path",
            "Dieser Desktop hat keinen Dateidialog (keine D-Bus-Sitzung); den Pfad eintippen",
            "Ce bureau n’a pas de fenêtre de fichiers (pas de session D-Bus) ; saisir le chemin",
            "Este escritorio no tiene diálogo de archivos (sin sesión D-Bus); escribir la ruta")
