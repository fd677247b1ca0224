// The saved views in a project file. Only for project.cpp.
#pragma once

#include "core/json/json_members.h"
#include "core/session/project.h"

#include <cstddef>

namespace marsview {

/// Adds the members of a camera.
void putCamera(Json& json, const ViewCamera& camera);
ViewCamera viewCameraFrom(Members& members);
Json viewJson(const ProjectView& view);
/// Of a project with `layer_count` layers.
ProjectView viewFrom(Members& members, std::size_t layer_count);

} // namespace marsview
