// Names for new saved views.
#pragma once

#include "core/geo/coordinate_format.h"
#include "core/session/session.h"
#include "core/view/camera.h"
#include "ui/widgets/name_completer.h"

#include <QString>

namespace marsview {

/// What is in the middle of the picture that `camera` has of `map`: the largest named place that
/// the picture shows well, or else one that contains the middle, or else the position. Never empty.
QString viewNameFor(const Map& map,
                    const OrbitCamera& camera,
                    const NamesOnMap& names,
                    const CoordinateFormat& format);

/// `name`, or with a number if a view of the session has it.
QString uniqueViewName(const Session& session, const QString& name);

} // namespace marsview
