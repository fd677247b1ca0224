// Items that are a single point: where they are in the scene.
#pragma once

#include "core/annotations/drawn_vertex.h"
#include "ui/drawing/dot_index.h"
#include "ui/drawing/handle_grid.h"
#include "ui/drawing/item_list.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace marsview {

/// Follows a list of items: after a change, it looks at the items that changed. `Item` is a
/// DrawnItem with isSingle().
template <typename Item>
class DrawnDots {
public:
    /// The place of an item's only vertex without the exaggeration; empty if it is not shown.
    using Placing = std::function<std::optional<ScenePoint>(const Item&)>;

    /// All places are asked for again by the next follow().
    void forgetPlaces() { are_placed_ = false; }
    /// Takes the places of new and changed items from `place`.
    void follow(const ItemList<Item>& items, const Placing& place)
    {
        if (!are_placed_) {
            list(items, place);
            return;
        }
        // Many changes are cheaper as a whole: each may move all that follow it.
        std::size_t changes = 0;
        ItemList<Item>::forEachChange(items_, items,
                                      [&changes](const Item*, const Item*) { ++changes; });
        if (changes > kChangesMax) {
            list(items, place);
            return;
        }
        ItemList<Item>::forEachChange(items_, items, [&](const Item* was, const Item* is) {
            change(was != nullptr ? was->id : is->id, is, place);
        });
        items_ = items;
        indexIfNeeded();
    }

    /// Ids of the items that are more than a point, ascending.
    const std::vector<std::uint32_t>& others() const noexcept { return others_; }

    /// Calls `take` with dots that are in the area of the sight: one for each square of `grid` that
    /// is free, and takes the square.
    void thinned(const DotSight& sight,
                 HandleGrid& grid,
                 const std::function<void(const DotIndex::Dot&, QPointF)>& take) const
    {
        for (const std::uint32_t id : unindexed_) {
            const Dot* dot = dotOf(id);
            const auto place = dot != nullptr && dot->place ? sight.at(*dot->place) : std::nullopt;
            if (place && sight.area().contains(*place) && grid.take(*place)) {
                take({.id = id, .place = *dot->place}, *place);
            }
        }
        index_.thinned(sight, grid, take);
    }
    /// The dot that is nearest to a position on the screen, at most `reach` points away.
    std::optional<DotIndex::Near>
    nearest(const DotSight& sight, QPointF position, double reach) const
    {
        std::optional<DotIndex::Near> nearest = index_.nearest(sight, position, reach);
        for (const std::uint32_t id : unindexed_) {
            const Dot* dot = dotOf(id);
            const auto place = dot != nullptr && dot->place ? sight.at(*dot->place) : std::nullopt;
            if (!place) {
                continue;
            }
            const double away = std::hypot(place->x() - position.x(), place->y() - position.y());
            if (away <= (nearest ? nearest->away : reach)) {
                nearest = DotIndex::Near{
                    .dot = {.id = id, .place = *dot->place}, .place = *place, .away = away};
            }
        }
        return nearest;
    }

private:
    static constexpr std::uint32_t kNowhere = std::numeric_limits<std::uint32_t>::max();
    static constexpr std::size_t kChangesMax = 1000;
    // One more point is looked at beside the index, which is not made again for it.
    static constexpr std::size_t kUnindexedMax = 1000;

    struct Dot {
        std::uint32_t id = 0;
        std::uint32_t in_index = kNowhere;
        DrawnVertex vertex;
        std::optional<ScenePoint> place; // empty if it is not shown or not a dot any more
    };

    static bool isDot(const Item& item) { return item.isSingle() && item.vertices.size() == 1; }

    // Of `items` as a whole. Places that are known stay.
    void list(const ItemList<Item>& items, const Placing& place)
    {
        const std::vector<Dot> before = std::exchange(dots_, {});
        auto known = before.begin();
        const auto skip_until = [&](std::uint32_t id) {
            for (; known != before.end() && known->id < id; ++known) {
                unindex(*known);
            }
        };
        others_.clear();
        dots_.reserve(items.size());
        for (const Item& item : items) {
            if (!isDot(item)) {
                others_.push_back(item.id);
                continue;
            }
            skip_until(item.id);
            if (known != before.end() && known->id == item.id) {
                if (are_placed_ && known->place && known->vertex == item.vertices.front()) {
                    dots_.push_back(*known++);
                    continue;
                }
                unindex(*known++);
            }
            add(item, dots_.end(), place);
        }
        skip_until(std::numeric_limits<std::uint32_t>::max());
        items_ = items;
        are_placed_ = true;
        indexIfNeeded();
    }
    void change(std::uint32_t id, const Item* item, const Placing& place)
    {
        const bool is_other = item != nullptr && !isDot(*item);
        const auto other = std::lower_bound(others_.begin(), others_.end(), id);
        const bool was_other = other != others_.end() && *other == id;
        if (is_other && !was_other) {
            others_.insert(other, id);
        } else if (was_other && !is_other) {
            others_.erase(other);
        }
        const auto at = std::lower_bound(dots_.begin(), dots_.end(), id, isBefore);
        const bool was_dot = at != dots_.end() && at->id == id;
        if (was_dot) {
            unindex(*at);
            at->in_index = kNowhere;
            at->place.reset(); // and stays, in case that the item returns
        }
        if (item != nullptr && !is_other) {
            if (was_dot) {
                at->vertex = item->vertices.front();
                at->place = place(*item);
                unindexed_.push_back(id);
            } else {
                add(*item, at, place);
            }
        }
    }
    void add(const Item& item, typename std::vector<Dot>::iterator before, const Placing& place)
    {
        dots_.insert(before, {.id = item.id,
                              .in_index = kNowhere,
                              .vertex = item.vertices.front(),
                              .place = place(item)});
        unindexed_.push_back(item.id);
    }
    void unindex(const Dot& dot)
    {
        if (dot.in_index != kNowhere) {
            index_.remove(dot.in_index);
        }
    }
    void indexIfNeeded()
    {
        std::sort(unindexed_.begin(), unindexed_.end());
        unindexed_.erase(std::unique(unindexed_.begin(), unindexed_.end()), unindexed_.end());
        if (unindexed_.size() <= kUnindexedMax && index_.removed() <= index_.size() / 2) {
            return;
        }
        std::vector<DotIndex::Dot> placed;
        placed.reserve(dots_.size());
        for (Dot& dot : dots_) {
            dot.in_index = kNowhere;
            if (dot.place) {
                placed.push_back({.id = dot.id, .place = *dot.place});
            }
        }
        index_ = DotIndex(std::move(placed));
        unindexed_.clear();
        for (std::size_t i = 0; i < index_.size(); ++i) {
            find(dots_, index_.dots()[i].id)->in_index = static_cast<std::uint32_t>(i);
        }
    }
    static bool isBefore(const Dot& dot, std::uint32_t id) { return dot.id < id; }
    template <typename Dots>
    static auto* find(Dots& dots, std::uint32_t id)
    {
        // Without gaps, the place follows from the id.
        const std::uint32_t guess = dots.empty() ? 0 : id - dots.front().id;
        if (guess < dots.size() && dots[guess].id == id) {
            return &dots[guess];
        }
        const auto hit = std::lower_bound(dots.begin(), dots.end(), id, isBefore);
        return hit != dots.end() && hit->id == id ? &*hit : nullptr;
    }
    const Dot* dotOf(std::uint32_t id) const { return find(dots_, id); }

    ItemList<Item> items_; // that the rest is of
    bool are_placed_ = false;
    std::vector<Dot> dots_; // by id
    DotIndex index_;
    std::vector<std::uint32_t> unindexed_; // those that it lacks
    std::vector<std::uint32_t> others_;
};

} // namespace marsview
