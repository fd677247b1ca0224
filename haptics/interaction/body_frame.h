// The placement of a device's workspace on a body.
#pragma once

#include "core/base/angle.h"
#include "core/body/body_mesh.h"
#include "core/geo/georeference.h"
#include "haptics/interaction/workspace_frame.h"

#include <memory>
#include <optional>

namespace marsview {

/// Where on a body the workspace is level, and its direction away from the user.
struct BodySite {
    GeographicPoint place{}; // of the foot point on the ellipsoid
    Angle heading{};         // clockwise from north
};

/// Right, away and up at a site, in the body-fixed frame.
Rotation axesAt(const Ellipsoid& body, const BodySite& site);

/// The frame in which `reach` covers a box over a site, with the local vertical up. `box` is in
/// meters to the right, away from the user and up from the foot point.
WorkspaceFrame frameOverSite(const Ellipsoid& body,
                             const BodySite& site,
                             const SceneBox& box,
                             const WorkspaceBox& reach);

/// The frame in which `reach` covers all of a map, with the middle of its grid up and north away
/// from the user; of a map around the body, the half that faces up. If `width_m` is given, `reach`
/// is so wide and the terrain at the middle is at its center.
WorkspaceFrame frameForBodyMap(const std::shared_ptr<const BodyMesh>& mesh,
                               const Georeference& georeference,
                               const WorkspaceBox& reach,
                               std::optional<double> width_m = std::nullopt);

} // namespace marsview
