// What the session's datasets need for drawing, kept for as long as a session has them.
#pragma once

#include "core/session/loaded_map.h"

#include <map>
#include <memory>

namespace marsview {

/// Finds the LoadedMap of a dataset. The session and its undo steps know datasets only; the pointer
/// that keep() gives them owns the whole LoadedMap, so it goes when the last of them does, and this
/// store holds nothing.
class LoadedMapStore {
public:
    /// The dataset of `map` (not null), as an owner of all of it.
    std::shared_ptr<const Dataset> keep(const LoadedMap& map);
    /// Null where `dataset` did not come from keep().
    LoadedMap find(const std::shared_ptr<const Dataset>& dataset) const;
    /// The number of maps that somebody still holds.
    std::size_t count() const;

private:
    std::map<const Dataset*, std::weak_ptr<const LoadedMap>> maps_;
};

} // namespace marsview
