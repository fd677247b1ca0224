// The menu that chooses the format of positions.
#pragma once

#include "core/geo/coordinate_format.h"
#include "core/raster/raster_info.h"

#include <QString>

#include <functional>

class QMenu;

namespace marsview {

/// "180° West to 180° East".
QString longitudeNotationText(LongitudeNotation notation);
/// The same for the body's usual notation; null if the body is unknown.
QString usualLongitudesText(const Body* body);

/// Puts the choices for a map into an empty menu. `chosen` gets the whole format; it is called from
/// the menu's actions.
void fillCoordinateMenu(QMenu& menu,
                        const CoordinateFormat& format,
                        const RasterInfo& info,
                        const std::function<void(const CoordinateFormat&)>& chosen);

} // namespace marsview
