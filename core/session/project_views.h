// The saved views in a project file. Only for project.cpp.
#pragma once

#include "core/json/json_members.h"
#include "core/session/project.h"

#include <cstddef>

namespace marsview {

Json viewJson(const ProjectView& view);
/// Of a project with `layer_count` layers.
ProjectView viewFrom(Members& members, std::size_t layer_count);

} // namespace marsview
