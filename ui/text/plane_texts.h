/// @file  The occlusal plane, shown and corrected.

FLYTRI_TEXT(kPlaneIsSought, "Looking for the occlusal plane…", "Okklusionsebene wird gesucht…",
            "Recherche du plan occlusal…", "Buscando el plano oclusal…")
FLYTRI_TEXT(kClickPlane,
            "To correct it, click three cusps or edges far apart: both last molars, an incisor "
            "({0} of 3)",
            "Zum Korrigieren drei Höcker oder Kanten anklicken: letzte Molaren, ein Schneidezahn "
            "({0} von 3)",
            "Pour corriger, cliquer trois cuspides ou bords éloignés : dernières molaires, une "
            "incisive ({0} sur 3)",
            "Para corregir, tres clics en cúspides o bordes alejados: últimos molares, un incisivo "
            "({0} de 3)")
FLYTRI_TEXT(kPlaneRefused, "The occlusal plane does not fit: {0}",
            "Die Okklusionsebene passt nicht: {0}", "Le plan occlusal ne convient pas : {0}",
            "El plano oclusal no encaja: {0}")
