#include "ui/controllers/loaded_map_store.h"

#include "core/base/check.h"

#include <algorithm>

namespace marsview {

std::shared_ptr<const Dataset> LoadedMapStore::keep(const LoadedMap& map)
{
    MARSVIEW_CHECK(map.dataset != nullptr);
    std::erase_if(maps_, [](const auto& entry) { return entry.second.expired(); });
    auto owner = std::make_shared<const LoadedMap>(map);
    const Dataset* dataset = owner->dataset.get();
    maps_[dataset] = owner;
    return {std::move(owner), dataset};
}

LoadedMap LoadedMapStore::find(const std::shared_ptr<const Dataset>& dataset) const
{
    const auto hit = maps_.find(dataset.get());
    const auto map = hit != maps_.end() ? hit->second.lock() : nullptr;
    return map ? *map : LoadedMap{};
}

std::size_t LoadedMapStore::count() const
{
    return static_cast<std::size_t>(std::count_if(
        maps_.begin(), maps_.end(), [](const auto& entry) { return !entry.second.expired(); }));
}

} // namespace marsview
