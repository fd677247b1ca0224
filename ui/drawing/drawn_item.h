// What people draw on the map, as the tools hold it.
#pragma once

#include "core/annotations/drawn_vertex.h"
#include "core/session/session.h"
#include "ui/drawing/item_list.h"

#include <QDateTime>
#include <QPointF>
#include <QString>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace marsview {

/// What all kinds of items have.
struct DrawnItem {
    std::uint32_t id = 0;
    QString name;
    LayerId layer = LayerId::None; // that it was drawn on
    std::vector<DrawnVertex> vertices;
    bool is_finished = false; // clicks begin another one
    DrawnTime time{};         // at which it was begun
    QString note;
    std::optional<Rgb8> color; // empty: the usual one

    bool operator==(const DrawnItem&) const = default;
};

/// On the clock of the user.
inline QDateTime localTime(DrawnTime time)
{
    return QDateTime::fromMSecsSinceEpoch(time.time_since_epoch().count());
}

/// What the user did; undo returns to earlier ones.
template <typename Item>
struct DrawnState {
    ItemList<Item> items;      // in the order in which they were begun
    std::uint32_t current = 0; // shown in detail; 0: none
    std::uint32_t next_id = 1;

    bool operator==(const DrawnState&) const = default;
};

/// Ids of items, ascending.
struct DrawnChanges {
    std::vector<std::uint32_t> added;
    std::vector<std::uint32_t> changed;
    std::vector<std::uint32_t> removed;
};

/// A vertex of an item on the screen.
struct DrawnHandle {
    QPointF place; // in the view
    std::uint32_t item = 0;
    std::size_t index = 0;
    bool is_hidden = false; // by terrain in front of it
    bool is_dot = false;    // of an item that is a single point
};

/// Of items that have no color.
inline constexpr Rgb8 kDrawnColor{240, 240, 240};
inline constexpr Rgb8 kCurrentDrawnColor{255, 221, 64};

} // namespace marsview
