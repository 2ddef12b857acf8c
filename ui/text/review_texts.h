/// @file  Measuring on a finished model: distances, angles, sections, undercut, margin lines.

// Measuring on a finished model: its modes.
FLYTRI_TEXT(kMeasureDistance, "Distance", "Abstand", "Distance", "Distancia")
FLYTRI_TEXT(kMeasureAngle, "Angle", "Winkel", "Angle", "Ángulo")
FLYTRI_TEXT(kSection, "Section", "Schnitt", "Coupe", "Corte")
FLYTRI_TEXT(kUndercut, "Undercut", "Unterschnitt", "Contre-dépouille", "Socavado")
FLYTRI_TEXT(kMargin, "Margin line", "Präparationsgrenze", "Limite", "Línea de margen")
FLYTRI_TEXT(kFinishTheScan, "finish the scan first", "erst abschließen", "terminer d’abord",
            "finalizar primero")
FLYTRI_TEXT(kTakesClickBack, "takes a point back", "nimmt Punkt zurück", "retire un point",
            "retira un punto")

// What to do.
FLYTRI_TEXT(kClickAngle, "Click three points. The angle is at the second one.",
            "Drei Punkte anklicken. Der Winkel liegt am zweiten.",
            "Cliquer sur trois points. L’angle est au deuxième.",
            "Pulsar tres puntos. El ángulo está en el segundo.")
FLYTRI_TEXT(kClickSection, "Click where to cut. Drag to move the cut along the jaw.",
            "Schnittstelle anklicken. Ziehen verschiebt den Schnitt.",
            "Cliquer où couper. Glisser déplace la coupe.",
            "Pulsar dónde cortar. Arrastrar mueve el corte.")
FLYTRI_TEXT(kClickPrepared, "Click the prepared tooth", "Präparierten Zahn anklicken",
            "Cliquer sur la dent préparée", "Pulsar el diente tallado")
FLYTRI_TEXT(kClickMargin, "Click at least three points along the edge, in order",
            "Mindestens drei Punkte entlang der Kante anklicken, der Reihe nach",
            "Cliquer sur au moins trois points le long du bord, dans l’ordre",
            "Pulsar al menos tres puntos a lo largo del borde, en orden")
FLYTRI_TEXT(kClickInSection, "Click two points in the picture to measure.",
            "Zum Messen zwei Punkte im Bild anklicken.",
            "Cliquer sur deux points dans l’image pour mesurer.",
            "Pulsar dos puntos en la imagen para medir.")

// What was found.
FLYTRI_TEXT(kReviewHint,
            "The number after ± is the standard uncertainty, from the noise of the points alone. "
            "How the whole scan bends comes on top.",
            "Die Zahl nach ± ist die Standardunsicherheit allein aus dem Rauschen der Punkte. Die "
            "Verbiegung des ganzen Scans kommt hinzu.",
            "Le nombre après ± est l’incertitude type due au seul bruit des points. La déformation "
            "de tout le scan s’y ajoute.",
            "El número tras ± es la incertidumbre típica debida solo al ruido de los puntos. La "
            "deformación de todo el escaneo se añade.")
FLYTRI_TEXT(kAngleNumber, "Angle {0}", "Winkel {0}", "Angle {0}", "Ángulo {0}")
FLYTRI_TEXT(kRemoveThisAngle, "Remove this angle", "Diesen Winkel löschen", "Supprimer cet angle",
            "Borrar este ángulo")
FLYTRI_TEXT(kStraight, "Straight", "Gerade", "En ligne droite", "En línea recta")
FLYTRI_TEXT(kAlongSurface, "Along surface", "Entlang Fläche", "Le long de la surface",
            "Por la superficie")
FLYTRI_TEXT(kOtherOutline, "other outline", "andere Kontur", "autre contour", "otro contorno")
FLYTRI_TEXT(kAxisAsSeen, "Axis as seen", "Achse wie Blick", "Axe de la vue", "Eje de la vista")
FLYTRI_TEXT(kAxisAsSeenHint, "The insertion axis is the direction from which you look.",
            "Die Einschubrichtung ist die Blickrichtung.",
            "L’axe d’insertion est la direction du regard.",
            "El eje de inserción es la dirección de la mirada.")
FLYTRI_TEXT(kFindAxis, "Find axis", "Achse suchen", "Chercher l’axe", "Buscar eje")
FLYTRI_TEXT(kFindAxisHint, "Finds the insertion axis with the least undercut.",
            "Sucht die Einschubrichtung mit dem geringsten Unterschnitt.",
            "Cherche l’axe d’insertion avec le moins de contre-dépouille.",
            "Busca el eje de inserción con el menor socavado.")
FLYTRI_TEXT(kAroundClick, "Around the click: {0}", "Um den Klick: {0}", "Autour du clic : {0}",
            "Alrededor del clic: {0}")
FLYTRI_TEXT(kUndercutArea, "Undercut area", "Unterschnitt", "Contre-dépouille", "Área socavada")
FLYTRI_TEXT(kLookedAt, "of the surface", "von der Fläche", "de la surface", "de la superficie")
FLYTRI_TEXT(kDeepest, "Deepest", "Am tiefsten", "Profondeur max.", "Más profundo")
FLYTRI_TEXT(kAxesAsGood, "Axes as good within", "Achsen so gut bis", "Axes équivalents à",
            "Ejes iguales hasta")
FLYTRI_TEXT(kLegendFree, "Free", "Frei", "Libre", "Libre")
FLYTRI_TEXT(kUndercutHint,
            "How far across the axis the way out begins. Pale blue is free, a place without color "
            "was not looked at.",
            "Wie weit quer zur Achse der freie Weg beginnt. Blassblau ist frei, ohne Farbe wurde "
            "nicht geprüft.",
            "Distance, en travers de l’axe, jusqu’à la sortie libre. Bleu pâle est libre, sans "
            "couleur n’a pas été examiné.",
            "A qué distancia, a través del eje, empieza la salida libre. Azul pálido está libre, "
            "sin color no se examinó.")
FLYTRI_TEXT(kMarginLength, "Length", "Länge", "Longueur", "Longitud")
FLYTRI_TEXT(kMarginAcross, "Across the line", "Quer zur Linie", "En travers",
            "A través de la línea")
FLYTRI_TEXT(kMarginOnEdge, "On an edge", "Auf einer Kante", "Sur un bord", "Sobre un borde")
FLYTRI_TEXT(kMarginLeastTurn, "Bluntest edge", "Stumpfste Kante", "Bord le plus émoussé",
            "Borde más romo")
FLYTRI_TEXT(kMarginAcrossHint, "Standard uncertainty of the line’s points across the line, RMS.",
            "Standardunsicherheit der Punkte quer zur Linie, RMS.",
            "Incertitude type des points en travers de la ligne, RMS.",
            "Incertidumbre típica de los puntos a través de la línea, RMS.")
FLYTRI_TEXT(kKeepMargin, "Keep the line", "Linie behalten", "Garder la ligne", "Guardar la línea")
FLYTRI_TEXT(kNoMargin, "No margin line", "Keine Präparationsgrenze", "Pas de limite",
            "Sin línea de margen")
FLYTRI_TEXT(kNoUndercut, "No undercut was found", "Kein Unterschnitt berechnet",
            "Contre-dépouille non calculée", "Socavado sin calcular")
FLYTRI_TEXT(kNoSection, "No section", "Kein Schnitt", "Pas de coupe", "Sin corte")
FLYTRI_TEXT(kMargins, "Margin lines", "Präparationsgrenzen", "Limites", "Líneas de margen")
FLYTRI_TEXT(kMarginNumber, "Line {0}", "Linie {0}", "Ligne {0}", "Línea {0}")
FLYTRI_TEXT(kRemoveThisMargin, "Remove this margin line", "Diese Linie löschen",
            "Supprimer cette ligne", "Borrar esta línea")
FLYTRI_TEXT(kMarginOutdated, "outdated", "veraltet", "dépassée", "obsoleta")
FLYTRI_TEXT(
    kMarginOutdatedHint,
    "It was drawn on an older model, and the edge is no longer there. It is not exported: draw it "
    "again.",
    "Sie wurde auf einem älteren Modell gezeichnet, und die Kante ist nicht mehr dort. Sie wird "
    "nicht exportiert: neu zeichnen.",
    "Elle a été tracée sur un modèle plus ancien, et le bord n’y est plus. Elle n’est pas "
    "exportée : la retracer.",
    "Se trazó en un modelo anterior y el borde ya no está ahí. No se exporta: trazarla de nuevo.")
