// Names of places as people read them.
#pragma once

#include "core/geo/body.h"
#include "core/names/gazetteer.h"

#include <QString>

namespace marsview {

/// "mountain"; empty for Other.
QString placeKindText(PlaceKind kind);

/// "mountain, 610 km": what is known about a place besides its name; may be empty.
QString placeDetailText(const PlaceName& place);

/// Why there are no names on a body, and what to do, in two lines. `body` is null if unknown.
QString noNamesText(const Body* body);

/// That a place is not on the map.
QString outsideMapText(const PlaceName& place);

/// Why a search found nothing; if there is a name that is spelled similarly, in a second line.
QString notFoundText(const QString& text, const Gazetteer& names);

} // namespace marsview
