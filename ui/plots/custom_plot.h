// QCustomPlot, whose header uses Qt's keywords.
#pragma once

#pragma push_macro("signals")
#pragma push_macro("slots")
#pragma push_macro("foreach")
#undef signals
#undef slots
#undef foreach
#define signals Q_SIGNALS // NOLINT
#define slots Q_SLOTS     // NOLINT
#define foreach Q_FOREACH // NOLINT
#include <qcustomplot.h>
#pragma pop_macro("foreach")
#pragma pop_macro("slots")
#pragma pop_macro("signals")
