#include "ui/drawing/draped_geometry.h"

#include <cmath>
#include <utility>

namespace marsview {
namespace {

// A part of a line is drawn straight if it is not longer on the screen, in points.
constexpr double kPieceLength = 5.0;
constexpr int kSplitsMin = 5; // so that none is lost between places out of the picture
constexpr int kSplitsMax = 24;
constexpr std::size_t kPiecesMax = 6000; // of a line

} // namespace

void DrapedGeometry::update()
{
    if (map_ != scene_->map()) {
        map_ = scene_->map();
        geometry_ = map_ ? std::make_unique<MeasuredTerrain>(map_->georeference(),
                                                             readSamples(map_->heightfield()))
                         : nullptr;
    }
}

std::optional<GroundPosition> DrapedGeometry::positionOf(const DrawnVertex& vertex) const
{
    const auto* geographic = std::get_if<GeographicPoint>(&vertex);
    if (!geometry_ || (geographic != nullptr) != geometry_->ground().ellipsoid().has_value()) {
        return std::nullopt;
    }
    return geographic != nullptr ? geometry_->ground().position(*geographic)
                                 : geometry_->fromMap(std::get<MapPoint>(vertex));
}

std::optional<ScenePoint> DrapedGeometry::scenePoint(GroundPosition position) const
{
    return geometry_ ? scene_->onTerrain(*geometry_, position) : std::nullopt;
}

std::optional<ScenePoint> DrapedGeometry::scenePoint(const DrawnVertex& vertex) const
{
    const auto position = positionOf(vertex);
    return position ? scenePoint(*position) : std::nullopt;
}

std::optional<ScenePoint> DrapedGeometry::dotPoint(const DrawnVertex& vertex) const
{
    auto point = scenePoint(vertex);
    if (point) {
        point->z /= scene_->dotExaggeration();
    }
    return point;
}

std::vector<DrapedRun> DrapedGeometry::draped(const GroundLine& line) const
{
    struct Mark {
        double distance_m = 0.0;
        std::optional<ScenePoint> point;
        std::optional<QPointF> screen;
    };
    const auto mark_at = [&](double distance_m) {
        Mark mark{distance_m, scenePoint(line.at(distance_m)), std::nullopt};
        if (mark.point) {
            mark.screen = scene_->positionOf(*mark.point);
        }
        return mark;
    };
    const auto is_outside = [&](const Mark& a, const Mark& b) {
        return scene_->isOutOfSight(a.point, b.point, b.distance_m - a.distance_m);
    };
    const auto is_short = [](const Mark& a, const Mark& b) {
        return a.screen && b.screen &&
               std::hypot(a.screen->x() - b.screen->x(), a.screen->y() - b.screen->y()) <=
                   kPieceLength;
    };
    std::vector<DrapedRun> runs;
    DrapedRun run;
    const auto end_run = [&] {
        if (run.points.size() > 1) {
            runs.push_back(std::move(run));
        }
        run = {};
    };
    std::size_t pieces = 0;
    const auto add = [&](const Mark& mark) {
        if (!mark.point || scene_->isBehindHorizon(*mark.point)) {
            end_run(); // no terrain there, or not on this side of the body
            return;
        }
        run.points.push_back(*mark.point);
        run.distances_m.push_back(mark.distance_m);
        ++pieces;
    };
    const auto split = [&](const auto& self, const Mark& a, const Mark& b, int depth) -> void {
        const bool is_enough = depth >= kSplitsMax || pieces >= kPiecesMax ||
                               (depth >= kSplitsMin && (is_short(a, b) || is_outside(a, b)));
        if (is_enough) {
            add(b);
            return;
        }
        const Mark middle = mark_at(0.5 * (a.distance_m + b.distance_m));
        self(self, a, middle, depth + 1);
        self(self, middle, b, depth + 1);
    };
    const Mark first = mark_at(0.0);
    const Mark last = mark_at(line.lengthM());
    add(first);
    split(split, first, last, 0);
    end_run();
    return runs;
}

} // namespace marsview
