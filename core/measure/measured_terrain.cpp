#include "core/measure/measured_terrain.h"

#include "core/geo/body_layout.h"
#include "core/measure/constants.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace marsview {
namespace {

bool isOnBody(const Georeference& georeference)
{
    return georeference.crs() && georeference.crs()->kind() != CrsKind::Local &&
           georeference.crs()->ellipsoid();
}

double metersPerUnit(const Georeference& georeference)
{
    return georeference.crs() ? georeference.crs()->unit() : 1.0;
}

} // namespace

MeasuredTerrain::MeasuredTerrain(const Georeference& georeference,
                                 std::unique_ptr<SampleReader> samples,
                                 TerrainDetail detail)
    : georeference_(georeference)
    , ground_(isOnBody(georeference) ? Ground::onEllipsoid(*georeference.crs()->ellipsoid())
                                     : Ground::onPlane())
    , samples_(std::move(samples))
    , detail_(detail)
{
    const std::size_t step = samples_->step();
    const auto axis = [step](std::size_t count) {
        return Axis{.cells = (count - 1 + step - 1) / step, .step = step, .last = count - 1};
    };
    columns_ = axis(georeference_.columns());
    rows_ = axis(georeference_.rows());
    const GeoTransform::Terms& terms = georeference_.transform().terms();
    if (isOnBody(georeference) && georeference_.crs()->turn()) {
        const auto center = georeference_.toGeographic(georeference_.sceneFrame().origin);
        center_longitude_deg_ = center ? center->longitude.degrees() : 0.0;
    }
    if (isOnBody(georeference) && georeference_.crs()->turn() && terms[2] == 0.0 &&
        terms[4] == 0.0) {
        constexpr double kRounding = 1e-6; // columns
        const auto count = static_cast<double>(georeference_.columns());
        period_ = *georeference_.crs()->turn() / std::abs(terms[1]);
        if (std::abs(period_ - count) < kRounding) {
            period_ = count;
        }
        turn_begin_ = 0.5 * (count - 1.0) - 0.5 * period_;
        if (georeference_.wrapsAround()) {
            columns_.cells += 1;
            columns_.seam_end = period_;
        }
        findCaps();
    }
}

void MeasuredTerrain::findCaps()
{
    constexpr double kRounding = 1e-6; // columns
    if (std::abs(columnLine(cellColumns()) - period_) > kRounding ||
        !hasMeridiansAsColumns(georeference_)) {
        return;
    }
    const Result<BodyLayout> layout = bodyLayout(georeference_);
    const auto first = georeference_.toGeographic(GridPoint{0.0, 0.0});
    const auto second = georeference_.toGeographic(GridPoint{1.0, 0.0});
    if (!layout || !first || !second) {
        return;
    }
    has_cap_ = {layout->closes_first && layout->first_row == 0,
                layout->closes_last && !layout->has_row_after};
    first_longitude_deg_ = first->longitude.degrees();
    constexpr double kTurnDeg = 360.0;
    columns_per_degree_ =
        std::copysign(period_ / kTurnDeg, second->longitude.degrees() - first_longitude_deg_);
}

const CapTerrain* MeasuredTerrain::capBeyond(double row)
{
    const std::size_t which = row < 0.0 ? 0 : 1;
    if (!has_cap_[which] || (which == 1 && row <= rowLine(cellRows()))) {
        return nullptr;
    }
    if (!caps_[which]) {
        caps_[which] = capAt(which == 0 ? 0 : cellRows());
    }
    return caps_[which].get();
}

std::unique_ptr<const CapTerrain> MeasuredTerrain::capAt(std::size_t row)
{
    std::vector<double> turns;
    turns.reserve(cellColumns());
    for (std::size_t column = 0; column < cellColumns(); ++column) {
        turns.push_back(columnLine(column) / period_);
    }
    const auto position = fromGrid({0.0, rowLine(row)});
    if (!position) {
        return nullptr;
    }
    const Vec3 sample = ground_.cartesian(*position, 0.0);
    CapTerrain cap{
        .plane = CapPlane(turns), .row = row, .radius_m = std::hypot(sample.x, sample.y)};
    cap.pole_m =
        cap.plane.poleHeight([this, row](std::uint32_t number) { return vertex(number, row); });
    return std::make_unique<const CapTerrain>(std::move(cap));
}

CapTerrain::Place MeasuredTerrain::placeIn(const CapTerrain& cap, GroundPosition position) const
{
    const CellPlace cell = placeInColumns((position.x - first_longitude_deg_) * columns_per_degree_)
                               .value_or(CellPlace{});
    const Vec3 point = ground_.cartesian(position, 0.0);
    return {cell.column,
            cap.plane.at(cell.column, cell.u, std::hypot(point.x, point.y) / cap.radius_m)};
}

CapPlane::Point MeasuredTerrain::outwardIn(GroundPosition position) const
{
    const double turns = (position.x - first_longitude_deg_) * columns_per_degree_ / period_;
    const double angle = 2.0 * std::numbers::pi * turns;
    return {std::cos(angle), std::sin(angle)};
}

std::array<double, 3> MeasuredTerrain::corners(const CapTerrain& cap, std::uint32_t face)
{
    return cap.plane.cornerHeights(
        face, cap.pole_m, [this, &cap](std::uint32_t number) { return vertex(number, cap.row); });
}

double
MeasuredTerrain::elevation(const CapTerrain& cap, std::uint32_t face, const CapPlane::Point& point)
{
    return cap.plane.height(face, point, cap.pole_m,
                            [this, &cap](std::uint32_t number) { return vertex(number, cap.row); });
}

std::optional<GroundPosition> MeasuredTerrain::fromMap(MapPoint map) const
{
    if (!ground_.ellipsoid()) {
        const double unit_m = metersPerUnit(georeference_);
        return GroundPosition{map.x * unit_m, map.y * unit_m};
    }
    const auto geographic = georeference_.crs()->toGeographic(map);
    return geographic ? std::optional(ground_.position(*geographic)) : std::nullopt;
}

std::optional<GroundPosition> MeasuredTerrain::fromGrid(GridPoint grid) const
{
    if (!ground_.ellipsoid()) {
        return fromMap(georeference_.toMap(grid));
    }
    const auto geographic = georeference_.toGeographic(grid);
    return geographic ? std::optional(ground_.position(*geographic)) : std::nullopt;
}

std::optional<GridPoint> MeasuredTerrain::toGrid(GroundPosition position) const
{
    if (!ground_.ellipsoid()) {
        const double unit_m = metersPerUnit(georeference_);
        return georeference_.toGrid(MapPoint{position.x / unit_m, position.y / unit_m});
    }
    return georeference_.toGrid(ground_.geographic(position));
}

std::optional<MapPoint> MeasuredTerrain::toMap(GroundPosition position) const
{
    const auto grid = toGrid(position);
    return grid ? std::optional(georeference_.toMap(*grid)) : std::nullopt;
}

GroundPosition MeasuredTerrain::inTurn(GroundPosition position) const
{
    if (ground_.ellipsoid()) {
        const double turns = std::round((center_longitude_deg_ - position.x) / 360.0);
        if (turns != 0.0) {
            position.x += 360.0 * turns;
        }
    }
    return position;
}

std::optional<CellPlace> MeasuredTerrain::placeInColumns(double column) const
{
    column -= turnOf(column) * period_;
    if (columns_.seam_end != 0.0 && column < 0.0) {
        column += period_;
    }
    CellPlace place;
    return columns_.find(column, place.column, place.u) ? std::optional(place) : std::nullopt;
}

std::optional<CellPlace> MeasuredTerrain::placeOf(GridPoint grid) const
{
    std::optional<CellPlace> place = placeInColumns(grid.column);
    return place && rows_.find(grid.row, place->row, place->v) ? place : std::nullopt;
}

bool MeasuredTerrain::Axis::find(double at, std::size_t& cell, double& share) const
{
    const double end = line(cells);
    constexpr double kBeyond = 1e-6; // rounding of a way there and back
    if (!(at >= -kBeyond && at <= end + kBeyond)) {
        return false;
    }
    at = std::clamp(at, 0.0, end);
    cell = std::min(static_cast<std::size_t>(at) / step, cells - 1);
    if (at < line(cell)) { // in the last cell before a seam
        --cell;
    } else if (cell + 1 < cells && at >= line(cell + 1)) {
        ++cell;
    }
    share = std::clamp((at - line(cell)) / (line(cell + 1) - line(cell)), 0.0, 1.0);
    return true;
}

CellHeights MeasuredTerrain::cell(std::size_t column, std::size_t row)
{
    const std::size_t left = columns_.sample(column);
    const std::size_t right = columns_.sample(column + 1);
    const std::size_t upper = rows_.sample(row);
    const std::size_t lower = rows_.sample(row + 1);
    return {samples_->sample(left, upper), samples_->sample(right, upper),
            samples_->sample(left, lower), samples_->sample(right, lower)};
}

double MeasuredTerrain::elevation(const CellPlace& place)
{
    return heightInCell(cell(place.column, place.row), place.u, place.v);
}

double MeasuredTerrain::elevation(GroundPosition position)
{
    const auto grid = toGrid(position);
    const auto place = grid ? placeOf(*grid) : std::nullopt;
    if (place) {
        return elevation(*place);
    }
    const CapTerrain* cap = grid ? capBeyond(grid->row) : nullptr;
    if (!cap) {
        return kNoMeasure;
    }
    const CapTerrain::Place in_cap = placeIn(*cap, position);
    return elevation(*cap, cap->plane.faceAt(in_cap.column, in_cap.point), in_cap.point);
}

} // namespace marsview
