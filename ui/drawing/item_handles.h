// The handles of items in the picture: their vertices, as far as marks have room.
#pragma once

#include "ui/drawing/draped_geometry.h"
#include "ui/drawing/drawing_scene.h"
#include "ui/drawing/drawn_dots.h"
#include "ui/drawing/drawn_item.h"
#include "ui/drawing/handle_grid.h"

#include <QPointF>
#include <QRectF>
#include <QSize>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace marsview {

/// Lists handles once for a camera, and remembers where items that are single points are, since
/// converting positions takes longer than drawing. `Item` is a DrawnItem with isSingle().
template <typename Item>
class ItemHandles {
public:
    /// What the handles are of.
    struct Of {
        const DrawnState<Item>& state;
        const DrawingScene& scene;
        const DrapedGeometry& geometry;
        std::function<bool(const Item&)> has_handles; // in the picture
        bool is_moving = false;    // the camera has moved since the picture was complete
        std::uint64_t content = 0; // another number after every change of items and maps
    };

    /// The current item's first. Valid until the next call.
    const std::vector<DrawnHandle>& handles(const Of& of)
    {
        const CameraPose camera = of.scene.camera();
        const Picture now{.eye = camera.eye,
                          .forward = camera.axes.forward,
                          .up = camera.axes.up,
                          .field_of_view_deg = camera.field_of_view.degrees(),
                          .size = of.scene.view().size(),
                          .pixels_per_point = of.scene.view().devicePixelRatioF(),
                          .exaggeration = of.scene.exaggeration(),
                          .is_moving = of.is_moving,
                          .content = of.content};
        if (!(listed_in_ == now)) {
            listed_in_ = now;
            list(of);
            ++revision_;
        }
        return handles_;
    }
    /// Where those that were listed last are in the scene.
    const std::vector<ScenePoint>& places() const noexcept { return places_; }
    /// The same number as before if the same handles were listed.
    std::uint64_t revision() const noexcept { return revision_; }

    /// Ids of the items that are more than a point, ascending.
    const std::vector<std::uint32_t>& lineItems(const Of& of)
    {
        placeDots(of);
        return dots_.others();
    }
    /// The item that is a single point nearest to a position of the view, at most `reach` points
    /// away.
    std::optional<DotIndex::Near> dotNear(const Of& of, QPointF position, double reach)
    {
        placeDots(of);
        return dots_.nearest(of.scene.dotSight(areaOf(of)), position, reach);
    }
    /// The maps have changed.
    void forgetPlaces() { dots_.forgetPlaces(); }

private:
    // What the list depends on.
    struct Picture {
        ScenePoint eye;
        Vec3 forward;
        Vec3 up;
        double field_of_view_deg = 0.0;
        QSize size;
        double pixels_per_point = 1.0;
        double exaggeration = 1.0;
        bool is_moving = false;
        std::uint64_t content = 0;

        bool operator==(const Picture&) const = default;
    };
    // Marks that lie closer than this are not drawn one over the other, in points.
    static constexpr double kRestGap = 6.0;
    static constexpr double kMovingGap = 18.0;
    static constexpr std::size_t kMovingTestsMax = 100;
    // Beyond, a picture shows no single one; while it moves, what was hidden stays so.
    static constexpr std::size_t kHiddenTestsMax = 2000;

    static QRectF areaOf(const Of& of) { return QRectF(of.scene.view().rect()); }

    // Places are kept until items or maps change.
    void placeDots(const Of& of)
    {
        if (dots_of_ == of.content) {
            return;
        }
        dots_of_ = of.content;
        dots_.follow(of.state.items, [&of](const Item& item) {
            return of.has_handles(item) ? of.geometry.dotPoint(item.vertices.front())
                                        : std::nullopt;
        });
    }
    void list(const Of& of)
    {
        handles_.clear();
        places_.clear();
        HandleGrid grid(areaOf(of), of.is_moving ? kMovingGap : kRestGap);
        const Item* selected = of.state.items.find(of.state.current);
        if (selected != nullptr && of.has_handles(*selected)) {
            addVertices(of, *selected, grid); // grabbed first and drawn last
        }
        placeDots(of);
        addDots(of, grid);
        for (const std::uint32_t id : dots_.others()) {
            const Item& item = *of.state.items.find(id);
            if (id != of.state.current && of.has_handles(item)) {
                addVertices(of, item, grid);
            }
        }
        noteHidden(of);
    }
    void addVertices(const Of& of, const Item& item, HandleGrid& grid)
    {
        for (std::size_t i = 0; i < item.vertices.size(); ++i) {
            const auto point = of.geometry.scenePoint(item.vertices[i]);
            const auto place = point ? of.scene.positionOf(*point) : std::nullopt;
            if (place && areaOf(of).contains(*place)) {
                grid.take(*place);
                handles_.push_back(
                    {.place = *place, .item = item.id, .index = i, .is_dot = item.isSingle()});
                places_.push_back(*point);
            }
        }
    }
    // As far as there is room.
    void addDots(const Of& of, HandleGrid& grid)
    {
        const QRectF area = areaOf(of);
        const DotSight sight = of.scene.dotSight(area);
        // Dots stay as long as they have room, so that none flickers while the camera moves.
        if (shown_dots_of_ == of.content) {
            std::erase_if(shown_dots_, [&](std::pair<DotIndex::Dot, QPointF>& dot) {
                const auto place = sight.at(dot.first.place);
                if (!place || dot.first.id == of.state.current || !area.contains(*place) ||
                    !grid.take(*place)) {
                    return true;
                }
                dot.second = *place;
                return false;
            });
        } else {
            shown_dots_.clear();
        }
        shown_dots_of_ = of.content;
        dots_.thinned(sight, grid, [&](const DotIndex::Dot& dot, QPointF place) {
            if (dot.id != of.state.current) {
                shown_dots_.emplace_back(dot, place);
            }
        });
        std::sort(shown_dots_.begin(), shown_dots_.end(),
                  [](const auto& a, const auto& b) { return a.first.id < b.first.id; });
        for (const auto& [dot, place] : shown_dots_) {
            handles_.push_back({.place = place, .item = dot.id, .index = 0, .is_dot = true});
            places_.push_back({dot.place.x, dot.place.y, dot.place.z * of.scene.dotExaggeration()});
        }
    }
    void noteHidden(const Of& of)
    {
        if (!of.is_moving) {
            hidden_.clear();
        }
        for (std::size_t i = 0; i < handles_.size(); ++i) {
            const auto key = std::pair(handles_[i].item, handles_[i].index);
            if (of.is_moving && handles_.size() > kMovingTestsMax) {
                handles_[i].is_hidden = hidden_.contains(key);
            } else if (i < kHiddenTestsMax) {
                handles_[i].is_hidden = of.geometry.isHidden(places_[i]);
                if (handles_[i].is_hidden && !of.is_moving) {
                    hidden_.insert(key);
                }
            }
        }
    }

    DrawnDots<Item> dots_;
    std::optional<std::uint64_t> dots_of_;                   // content
    std::set<std::pair<std::uint32_t, std::size_t>> hidden_; // in the last picture
    std::vector<DrawnHandle> handles_;
    std::vector<ScenePoint> places_;
    std::vector<std::pair<DotIndex::Dot, QPointF>> shown_dots_; // in the last picture
    std::uint64_t shown_dots_of_ = 0;                           // content
    std::optional<Picture> listed_in_;
    std::uint64_t revision_ = 0;
};

} // namespace marsview
