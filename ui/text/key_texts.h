/// @file  What is printed on the keys. Letters and signs are the same in all languages.

FLYTRI_TEXT(kKeySpace, "Space", "Leertaste", "Espace", "Espacio")
FLYTRI_TEXT(kKeyTab, "Tab", "Tab", "Tab", "Tab")
FLYTRI_TEXT(kKeyBackspace, "Backspace", "Rücktaste", "Retour arr.", "Retroceso")
FLYTRI_TEXT(kKeyDelete, "Delete", "Entf", "Suppr", "Supr")
FLYTRI_TEXT(kKeyEnter, "Enter", "Eingabe", "Entrée", "Intro")
FLYTRI_TEXT(kKeyEscape, "Esc", "Esc", "Échap", "Esc")
FLYTRI_TEXT(kKeyHome, "Home", "Pos1", "Début", "Inicio")
FLYTRI_TEXT(kKeyPageUp, "Page up", "Bild auf", "Page préc.", "Re Pág")
FLYTRI_TEXT(kKeyPageDown, "Page down", "Bild ab", "Page suiv.", "Av Pág")
FLYTRI_TEXT(kKeyControl, "Ctrl", "Strg", "Ctrl", "Ctrl")
FLYTRI_TEXT(kKeyShift, "Shift", "Umschalt", "Maj", "Mayús")
