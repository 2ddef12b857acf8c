/// @file  Places and sides of a jaw, as dentists call them.

FLYTRI_TEXT(kFrontTeeth, "front teeth", "Frontzähne", "dents antérieures", "dientes anteriores")
FLYTRI_TEXT(kRightPremolars, "right premolars", "Prämolaren rechts", "prémolaires droites",
            "premolares derechos")
FLYTRI_TEXT(kLeftPremolars, "left premolars", "Prämolaren links", "prémolaires gauches",
            "premolares izquierdos")
FLYTRI_TEXT(kRightMolars, "right molars", "Molaren rechts", "molaires droites", "molares derechos")
FLYTRI_TEXT(kLeftMolars, "left molars", "Molaren links", "molaires gauches", "molares izquierdos")
FLYTRI_TEXT(kPalate, "palate", "Gaumen", "palais", "paladar")
FLYTRI_TEXT(kFloorOfMouth, "floor of the mouth", "Mundboden", "plancher buccal", "suelo de la boca")
FLYTRI_TEXT(kSideLabial, "labial", "labial", "vestibulaire", "vestibular")
FLYTRI_TEXT(kSideBuccal, "buccal", "bukkal", "vestibulaire", "vestibular")
FLYTRI_TEXT(kSidePalatal, "palatal", "palatinal", "palatin", "palatino")
FLYTRI_TEXT(kSideLingual, "lingual", "lingual", "lingual", "lingual")
FLYTRI_TEXT(kSideIncisal, "incisal", "inzisal", "incisif", "incisal")
FLYTRI_TEXT(kSideOcclusal, "occlusal", "okklusal", "occlusal", "oclusal")

// Buttons of the sides to look from.
FLYTRI_TEXT(kViewOcclusal, "Occlusal", "Okklusal", "Occlusal", "Oclusal")
FLYTRI_TEXT(kViewFront, "Front", "Frontal", "Face", "Frente")
FLYTRI_TEXT(kViewBuccal, "Buccal", "Bukkal", "Vestibulaire", "Vestibular")
FLYTRI_TEXT(kViewRight, "Right", "Rechts", "Droite", "Derecha")
FLYTRI_TEXT(kViewLeft, "Left", "Links", "Gauche", "Izquierda")
FLYTRI_TEXT(kViewLingual, "Lingual", "Lingual", "Lingual", "Lingual")
FLYTRI_TEXT(kViewPalatal, "Palatal", "Palatinal", "Palatin", "Palatino")
FLYTRI_TEXT(kAxisUp, "Up", "Oben", "Haut", "Arriba")
FLYTRI_TEXT(kViewAll, "All", "Alles", "Tout", "Todo")
