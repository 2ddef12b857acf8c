/// @file  The rows of the table of texts, for texts.h, which says what FLYTRI_TEXT makes of them.
/// Those of core and devices come first: Texts::translated() looks for them by their English words.

#include "ui/text/core_texts.h"

#include "ui/text/action_texts.h"
#include "ui/text/calibration_texts.h"
#include "ui/text/case_texts.h"
#include "ui/text/device_texts.h"
#include "ui/text/export_texts.h"
#include "ui/text/jaw_texts.h"
#include "ui/text/key_texts.h"
#include "ui/text/occlusion_texts.h"
#include "ui/text/plane_texts.h"
#include "ui/text/review_texts.h"
#include "ui/text/scanning_texts.h"
#include "ui/text/settings_texts.h"
#include "ui/text/setup_texts.h"
