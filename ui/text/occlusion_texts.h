/// @file  How the jaws meet: the panel of the finished bite.

FLYTRI_TEXT(kStageEmpty, "not scanned", "nicht gescannt", "pas scanné", "sin escanear")
FLYTRI_TEXT(kStageScanned, "press Finish", "abschließen", "à terminer", "por finalizar")
FLYTRI_TEXT(kOcclusionMissing,
            "Scan and finish both jaws and the bite. Then they are brought together here.",
            "Scannen Sie beide Kiefer und den Biss und schließen Sie sie ab. Dann werden sie hier "
            "zusammengeführt.",
            "Scannez et terminez les deux mâchoires et le mordu. Ils sont ensuite réunis ici.",
            "Escanee y finalice ambos maxilares y la mordida. Después se unen aquí.")
FLYTRI_TEXT(kClosingJaws, "Bringing the jaws together", "Kiefer werden zusammengeführt",
            "Mise en occlusion", "Uniendo los maxilares")
FLYTRI_TEXT(kFinishEachStageAgain,
            "a model is older than its scan: open each stage and press Finish",
            "ein Modell ist älter als sein Scan: Stufe öffnen und abschließen",
            "un modèle est plus ancien que son scan : ouvrez chaque étape et terminez-la",
            "un modelo es anterior a su escaneo: abra cada etapa y finalícela")
FLYTRI_TEXT(kNoOcclusion, "The jaws were not brought together", "Keine Okklusion gefunden",
            "Mise en occlusion impossible", "No se pudieron unir los maxilares")
FLYTRI_TEXT(kBothJaws, "Both jaws", "Beide Kiefer", "Arcades", "Arcadas")
FLYTRI_TEXT(kClearance, "Clearance", "Abstände", "Espaces", "Distancias")
FLYTRI_TEXT(kOpening, "Opening", "Öffnung", "Ouverture", "Apertura")
FLYTRI_TEXT(kContactBelow, "Contact: nearer than", "Kontakt: näher als", "Contact : à moins de",
            "Contacto: a menos de")
FLYTRI_TEXT(kLegendContact, "Contact", "Kontakt", "Contact", "Contacto")
FLYTRI_TEXT(kLegendPenetration, "Penetration", "Durchdringung", "Pénétration", "Penetración")
FLYTRI_TEXT(kClearanceHint,
            "Distance to the other jaw. Without color: farther away, or not scanned.",
            "Abstand zum Gegenkiefer. Ohne Farbe: weiter entfernt oder nicht gescannt.",
            "Distance à l’arcade opposée. Sans couleur : plus loin, ou pas scannée.",
            "Distancia al maxilar opuesto. Sin color: más lejos o sin escanear.")
FLYTRI_TEXT(kBiteUncertainty, "Uncertainty, at the bite", "Unsicherheit am Biss",
            "Incertitude au mordu", "Incertidumbre en mordida")
FLYTRI_TEXT(kFarUncertainty, "{0} mm from there", "{0} mm davon entfernt", "à {0} mm de là",
            "a {0} mm de ahí")
FLYTRI_TEXT(
    kUncertaintyOfBiteHint,
    "Standard uncertainty of where the lower jaw is. A bite scanned on one side only leaves "
    "the other side less certain.",
    "Standardunsicherheit der Lage des Unterkiefers. Ein nur auf einer Seite gescannter Biss "
    "lässt die andere Seite weniger sicher.",
    "Incertitude type de la position de la mandibule. Un mordu scanné d’un seul côté rend "
    "l’autre côté moins sûr.",
    "Incertidumbre típica de la posición de la mandíbula. Una mordida escaneada en un solo "
    "lado deja el otro lado menos seguro.")
FLYTRI_TEXT(kFarSideUncertain,
            "The far side is uncertain by {0}. Scan the bite on the other side, too.",
            "Die andere Seite ist um {0} unsicher. Scannen Sie den Biss auch dort.",
            "L’autre côté est incertain de {0}. Scannez aussi le mordu de ce côté.",
            "El otro lado tiene {0} de incertidumbre. Escanee también la mordida allí.")
FLYTRI_TEXT(kFinishOtherBite,
            "The far side is uncertain by {0}. Finish the bite on the other side.",
            "Die andere Seite ist um {0} unsicher. Den Biss der Gegenseite abschließen.",
            "L’autre côté est incertain de {0}. Terminer le mordu de ce côté.",
            "El otro lado tiene {0} de incertidumbre. Finalizar la mordida de ese lado.")
FLYTRI_TEXT(kBitesOnOneSide,
            "The far side is uncertain by {0}: both bites are of the same side. Clear one and scan "
            "the other side.",
            "Die andere Seite ist um {0} unsicher: Beide Bisse zeigen dieselbe Seite. Einen leeren "
            "und die Gegenseite scannen.",
            "L’autre côté est incertain de {0} : les deux mordus sont du même côté. En vider "
            "un et scanner l’autre côté.",
            "El otro lado tiene {0} de incertidumbre: las dos mordidas son del mismo lado. Vaciar "
            "una y escanear el otro lado.")
FLYTRI_TEXT(kBothBitesUncertain,
            "The lower jaw is uncertain by {0} there. Scan more teeth in each bite.",
            "Der Unterkiefer ist dort um {0} unsicher. Mit jedem Biss mehr Zähne scannen.",
            "La mandibule y est incertaine de {0}. Scanner plus de dents dans chaque mordu.",
            "La mandíbula tiene ahí {0} de incertidumbre. Escanear más dientes en cada mordida.")
FLYTRI_TEXT(kBetweenBites, "Uncertainty, middle", "Unsicherheit, Mitte", "Incertitude au milieu",
            "Incertidumbre, centro")
FLYTRI_TEXT(kBiteFirst, "scan the bite first", "erst Biss scannen", "d’abord le mordu",
            "antes la mordida")
FLYTRI_TEXT(kNotForBothJaws, "not for both jaws", "nicht für beide Kiefer", "pas pour les deux",
            "no para ambos")
FLYTRI_TEXT(kNeedsOcclusion, "bite not finished", "Biss nicht fertig", "mordu à terminer",
            "mordida sin finalizar")
