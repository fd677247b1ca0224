#include "core/session/layer_groups.h"

#include <algorithm>

namespace marsview {
namespace {

const Body* bodyOf(const Layer& layer)
{
    return layer.map->info().body;
}

// The layers of the group of `id` without that layer, as indexes into the session without it.
std::vector<std::size_t> othersInGroup(const Session& session, std::size_t index)
{
    std::vector<std::size_t> others;
    for (std::size_t i = 0; i < session.layers.size(); ++i) {
        if (i != index && bodyOf(session.layers[i]) == bodyOf(session.layers[index])) {
            others.push_back(i > index ? i - 1 : i);
        }
    }
    return others;
}

} // namespace

std::vector<LayerGroup> layerGroups(const Session& session)
{
    std::vector<LayerGroup> groups;
    for (std::size_t i = 0; i < session.layers.size(); ++i) {
        const Body* body = bodyOf(session.layers[i]);
        auto group = std::find_if(groups.begin(), groups.end(),
                                  [body](const LayerGroup& g) { return g.body == body; });
        if (group == groups.end()) {
            group = groups.insert(groups.end(), LayerGroup{.body = body, .layers = {}});
        }
        group->layers.push_back(i);
    }
    return groups;
}

std::optional<std::size_t> indexForPlace(const Session& session, LayerId id, std::size_t place)
{
    const std::size_t index = indexOf(session, id);
    if (index == session.layers.size()) {
        return std::nullopt;
    }
    const std::vector<std::size_t> others = othersInGroup(session, index);
    if (others.empty()) {
        return std::nullopt;
    }
    return place == 0 ? others.front() : others[std::min(place, others.size()) - 1] + 1;
}

std::optional<std::size_t> indexBeside(const Session& session, LayerId id, GroupStep step)
{
    const std::size_t index = indexOf(session, id);
    if (index == session.layers.size()) {
        return std::nullopt;
    }
    const std::vector<std::size_t> others = othersInGroup(session, index);
    const auto below = std::lower_bound(others.begin(), others.end(), index);
    const auto place = static_cast<std::size_t>(below - others.begin());
    const bool is_up = step == GroupStep::Up;
    if (is_up ? place == 0 : place == others.size()) {
        return std::nullopt;
    }
    return indexForPlace(session, id, is_up ? place - 1 : place + 1);
}

} // namespace marsview
