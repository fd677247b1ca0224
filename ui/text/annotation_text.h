// Annotations as people read them.
#pragma once

#include "core/annotations/annotation.h"

#include <QString>

namespace marsview {

/// "Point", "Line" or "Polygon".
QString shapeText(FeatureShape shape);
QString symbolText(MarkSymbol symbol);

} // namespace marsview
