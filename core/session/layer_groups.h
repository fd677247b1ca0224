// Layers grouped by body, as lists present them.
//
// The order of a session is one list, top first. Layers on different bodies are never in the
// picture together, so the user sees one list for each body; the order within a group is that of
// the session.
#pragma once

#include "core/session/session.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace marsview {

struct LayerGroup {
    const Body* body = nullptr;      // null: unknown
    std::vector<std::size_t> layers; // indexes into Session::layers, top first; never empty
};

/// The groups in the order of their topmost layers.
std::vector<LayerGroup> layerGroups(const Session& session);

/// The index to give to moved() so that the layer has `place` other layers of its group above it;
/// values beyond the end mean the end. Empty if the layer does not exist or is alone in its group.
std::optional<std::size_t> indexForPlace(const Session& session, LayerId id, std::size_t place);

enum class GroupStep { Up, Down };

/// The index to give to moved() so that the layer changes places with its neighbor in its group.
/// Empty if it has no neighbor on that side.
std::optional<std::size_t> indexBeside(const Session& session, LayerId id, GroupStep step);

} // namespace marsview
