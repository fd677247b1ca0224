#include "core/measure/closed_surface.h"

#include "core/geo/body_layout.h"
#include "core/measure/ground.h"
#include "core/terrain/seam.h"
#include "core/terrain/triangulation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

namespace marsview {
namespace {

// From the body's axis, at elevation 0.
std::optional<double> axisDistance(const Georeference& georeference, const GridPoint& grid)
{
    const auto place = georeference.toGeographic(grid);
    if (!place) {
        return std::nullopt;
    }
    if (std::abs(place->latitude.radians()) >= 0.5 * std::numbers::pi) {
        return 0.0; // beyond the pole by rounding
    }
    const Ground ground = Ground::onEllipsoid(*georeference.crs()->ellipsoid());
    const Vec3 point = ground.cartesian(ground.position(*place), 0.0);
    return std::hypot(point.x, point.y);
}

} // namespace

ClosedSurface::ClosedSurface(const Georeference& georeference, const Heightfield& heightfield)
    : georeference_(std::make_shared<const Georeference>(georeference))
    , heightfield_(heightfield)
{
    if (!georeference.crs() || !georeference.crs()->ellipsoid() || !georeference.crs()->turn() ||
        !hasMeridiansAsColumns(georeference)) {
        return;
    }
    const Result<BodyLayout> layout = bodyLayout(georeference);
    if (!layout || !layout->wraps) {
        return;
    }
    if (layout->closes_first && layout->first_row == 0) {
        radii_m_[0] = axisDistance(georeference, {0.0, 0.0});
    }
    if (layout->closes_last && !layout->has_row_after) {
        radii_m_[1] =
            axisDistance(georeference, {0.0, static_cast<double>(georeference.rows() - 1)});
    }
    if (radii_m_[0] || radii_m_[1]) {
        // The strip across the seam may be narrower or wider than other columns.
        period_ = *georeference.crs()->turn() / std::abs(georeference.transform().terms()[1]);
        std::vector<double> turns;
        turns.reserve(layout->columns);
        for (std::size_t column = 0; column < layout->columns; ++column) {
            turns.push_back(static_cast<double>(column) / period_);
        }
        caps_ = std::make_shared<const CapPlane>(turns);
    }
}

std::optional<std::size_t> ClosedSurface::capAt(double row) const
{
    if (row < 0.0 && radii_m_[0]) {
        return 0;
    }
    const auto last = static_cast<double>(heightfield_.rows() - 1);
    return row > last && radii_m_[1] ? std::optional<std::size_t>(1) : std::nullopt;
}

template <typename F>
double ClosedSurface::capHeight(const GridPoint& grid, F&& read) const
{
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    const std::size_t which = *capAt(grid.row);
    const auto distance_m = axisDistance(*georeference_, grid);
    if (!distance_m || !std::isfinite(grid.column)) {
        return kNaN;
    }
    const double column = grid.column - period_ * std::floor(grid.column / period_);
    const auto last_sample = static_cast<double>(caps_->size() - 1);
    const double sample = std::min(std::floor(column), last_sample);
    const double width = sample < last_sample ? 1.0 : period_ - last_sample;
    const auto edge = static_cast<std::size_t>(sample);
    const CapPlane::Point point = caps_->at(edge, std::min((column - sample) / width, 1.0),
                                            *distance_m / *radii_m_.at(which));
    const double row = which == 0 ? 0.0 : static_cast<double>(heightfield_.rows() - 1);
    const auto at_circle = [&](std::uint32_t number) {
        return read(GridPoint{static_cast<double>(number), row});
    };
    const std::uint32_t face = caps_->faceAt(edge, point);
    return caps_->height(face, point, caps_->poleHeight(at_circle), at_circle);
}

template <typename F>
double ClosedSurface::heightBy(const GridPoint& grid, F&& read) const
{
    if (capAt(grid.row)) {
        return capHeight(grid, read);
    }
    if (georeference_->wrapsAround()) {
        if (const auto seam = seamCell(grid, heightfield_.columns(), heightfield_.rows())) {
            const double last = static_cast<double>(heightfield_.columns() - 1);
            const double row = static_cast<double>(seam->row);
            return heightInCell({read({last, row}), read({0.0, row}), read({last, row + 1.0}),
                                 read({0.0, row + 1.0})},
                                seam->u, seam->v);
        }
    }
    return read(grid);
}

double ClosedSurface::height(const GridPoint& grid, Tiles tiles) const
{
    return heightBy(grid, [&](const GridPoint& at) {
        return tiles == Tiles::Waiting     ? heightfield_.heightWaiting(at)
               : tiles == Tiles::Requested ? heightfield_.height(at)
                                           : heightfield_.heightNow(at);
    });
}

bool ClosedSurface::isExact(const GridPoint& grid) const
{
    bool is_exact = true;
    heightBy(grid, [&](const GridPoint& at) {
        is_exact = is_exact && heightfield_.isExact(at);
        return 0.0;
    });
    return is_exact;
}

} // namespace marsview
