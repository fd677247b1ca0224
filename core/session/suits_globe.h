// The scene that suits a session's layers, where the user has not chosen one.
#pragma once

#include "core/session/session.h"

namespace marsview {

/// Layers that cover at least this share of their body are shown as a globe.
inline constexpr double kGlobeShare = 0.1;

/// Whether the visible layers on the body of the topmost one should be shown on it rather than as a
/// flat map: they are in several CRSs, or cover kGlobeShare of it together. False if that body is
/// unknown. The share is measured at 4096 places, evenly spread over the body, with an error below
/// 0.002; takes milliseconds per layer.
bool suitsGlobe(const Session& session);

} // namespace marsview
