// A polygon on the grid is summed up cell by cell, as a font renderer fills outlines: in each
// column of cells, going down the rows, the region below an edge is covered once if the edge runs
// to the right, and minus once if it runs to the left. Inside the polygon the sum is one, outside
// zero. It works on a cylinder too, that is on a map around the whole body, where a polygon around
// a pole covers all below its edges, or all above them. In a cell with edges, the region is a
// signed sum of trapezoids, each of which is clipped by both triangles and by the base of volumes,
// so that all integrals are exact for the triangulated surface. Where the map closes at a pole,
// what is covered at its outermost row continues in the cap there (cap_area.h).

#include "core/measure/terrain_area.h"

#include "core/measure/cap_area.h"
#include "core/measure/cell_part.h"
#include "core/measure/column_coverage.h"
#include "core/measure/constants.h"
#include "core/measure/grid_field.h"
#include "core/measure/hypsometry.h"
#include "core/measure/line_measures.h"
#include "core/measure/metric_field.h"
#include "core/measure/polygon_outline.h"
#include "core/measure/terrain_path.h"
#include "core/measure/volume_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

namespace marsview {
namespace {

constexpr double kBorderShare = 0.1; // of the time

struct EdgeInCap {
    const CapTerrain* cap = nullptr;
    CapEdge part;
};

// What is needed of the polygon's edges.
class Border final : public PathVisitor {
public:
    Border(const Ground& ground, const LocalFrame& frame)
        : plane(ground, frame)
    {}

    void visit(const PathPiece& piece) override { plane.visit(piece); }
    void visitCap(const CapTerrain& cap,
                  std::uint32_t face,
                  const CapPlane::Point& from,
                  const CapPlane::Point& to) override
    {
        in_caps.push_back({&cap, {face, from, to}});
    }

    BorderPlane plane;
    std::vector<EdgeInCap> in_caps;
};

class AreaSummer {
public:
    AreaSummer(MeasuredTerrain& terrain,
               MetricField& metric,
               const VolumeSurface& base,
               const LocalFrame& frame,
               std::optional<double> hypsometry_step_m)
        : hypsometry(hypsometry_step_m)
        , terrain_(terrain)
        , metric_(metric)
        , base_(base)
        , frame_(frame)
    {}

    // `outside` and `sign` turn a count of the edges above into a share of the polygon.
    Status run(std::vector<EdgePart> parts, double outside, double sign, JobMonitor& monitor)
    {
        sign_ = sign;
        constexpr std::size_t kChunk = 256; // columns: those of one or two tiles
        const std::size_t columns = terrain_.cellColumns();
        std::sort(parts.begin(), parts.end(), [](const EdgePart& a, const EdgePart& b) {
            if (a.column / kChunk != b.column / kChunk) {
                return a.column < b.column;
            }
            if (a.is_above != b.is_above) {
                return a.is_above;
            }
            return a.row != b.row ? a.row < b.row : a.column < b.column;
        });
        std::size_t next = 0;
        for (std::size_t first = 0; first < columns; first += kChunk) {
            const std::size_t last = std::min(first + kChunk, columns);
            std::size_t end = next;
            while (end < parts.size() && parts[end].column < last) {
                ++end;
            }
            if (end > next || outside != 0.0) {
                const JobPart part(monitor,
                                   static_cast<double>(first) / static_cast<double>(columns),
                                   static_cast<double>(last) / static_cast<double>(columns));
                if (Status status = runChunk(
                        first, last, std::span(parts).subspan(next, end - next), outside, monitor);
                    !status) {
                    return status;
                }
            }
            next = end;
        }
        return Done{};
    }

    /// After run(): of the polygon's edges in the caps.
    Status addCaps(const std::vector<EdgeInCap>& edges)
    {
        for (const EdgeInCap& edge : edges) {
            const std::size_t which = edge.cap->row == 0 ? kFirst : kLast;
            // Going down the rows, an edge begins what is away from the pole before the first row,
            // and what is next to it after the last one.
            capArea(which)->addEdge(edge.part, which == kFirst ? -sign_ : sign_);
        }
        for (const std::optional<CapArea>& cap : caps_) {
            if (!cap) {
                continue;
            }
            covered_m2 += cap->covered_m2;
            surface_m2 += cap->surface_m2;
            height_m3 += cap->height_m3;
            above_m3 += cap->above_m3;
            below_m3 += cap->below_m3;
            if (cap->hasPole()) {
                addHeight(cap->poleM());
            }
        }
        return terrain_.failure() ? Status(*terrain_.failure()) : Done{};
    }

    double covered_m2 = 0.0;
    double surface_m2 = 0.0;
    double height_m3 = 0.0; // ∫ elevation
    double above_m3 = 0.0;
    double below_m3 = 0.0;
    double min_m = kNoMeasure;
    double max_m = kNoMeasure;
    bool crosses_itself = false;
    HypsometrySum hypsometry;

private:
    Status runChunk(std::size_t first,
                    std::size_t last,
                    std::span<const EdgePart> parts,
                    double outside,
                    JobMonitor& monitor)
    {
        std::vector<ColumnCoverage> coverage(last - first);
        for (ColumnCoverage& column : coverage) {
            column.reset(outside);
        }
        std::size_t next = 0;
        for (; next < parts.size() && parts[next].is_above; ++next) {
            cover(coverage[parts[next].column - first], parts[next]);
        }
        for (ColumnCoverage& column : coverage) {
            column.normalize();
        }
        addCircle(kFirst, first, coverage);
        upper_row_ = kNoRow;
        lower_row_ = kNoRow;
        std::size_t row = 0;
        const std::size_t rows = terrain_.cellRows();
        while (row < rows) {
            const bool is_covered =
                std::any_of(coverage.begin(), coverage.end(),
                            [](const ColumnCoverage& c) { return !c.isEmpty(); });
            if (!is_covered) {
                if (next >= parts.size()) {
                    break;
                }
                row = parts[next].row;
            }
            readRows(first, last, row);
            for (std::size_t column = first; column < last; ++column) {
                std::size_t end = next;
                while (end < parts.size() && parts[end].row == row && parts[end].column == column) {
                    ++end;
                }
                addCell(column, row, coverage[column - first], parts.subspan(next, end - next),
                        column - first);
                next = end;
            }
            if (terrain_.failure()) {
                return *terrain_.failure();
            }
            if (monitor.isCanceled()) {
                return Error{ErrorCode::Canceled, "measuring was canceled"};
            }
            if (hypsometry.isOverfull()) {
                return Error{ErrorCode::OutOfRange,
                             fmt::format("elevation classes of {:g} m are too many, more than {}; "
                                         "use wider ones",
                                         hypsometry.stepM(), HypsometrySum::kClassesMax)};
            }
            ++row;
            monitor.report(static_cast<double>(row) / static_cast<double>(rows));
        }
        addCircle(kLast, first, coverage);
        return Done{};
    }

    // What is covered at the outermost row, in columns from `first` on.
    void addCircle(std::size_t which, std::size_t first, std::span<const ColumnCoverage> coverage)
    {
        for (std::size_t i = 0; i < coverage.size(); ++i) {
            CapArea* const cap = coverage[i].isEmpty() ? nullptr : capArea(which);
            if (cap != nullptr) {
                coverage[i].forEach([&](double from, double to, double weight) {
                    cap->addCircle(first + i, from, to, weight);
                });
            }
        }
    }

    // Null where the map does not close.
    CapArea* capArea(std::size_t which)
    {
        if (!caps_[which]) {
            constexpr double kBeyond = 0.5;
            const CapTerrain* const cap = terrain_.capBeyond(
                which == kFirst ? -kBeyond : terrain_.rowLine(terrain_.cellRows()) + kBeyond);
            if (cap == nullptr) {
                return nullptr;
            }
            caps_[which].emplace(terrain_, *cap, base_, frame_, hypsometry);
        }
        return &*caps_[which];
    }

    void readRows(std::size_t first, std::size_t last, std::size_t row)
    {
        if (lower_row_ == row) {
            upper_.swap(lower_);
            upper_row_ = row;
        }
        const auto read = [&](std::vector<double>& heights, std::size_t line) {
            heights.resize(last - first + 1);
            for (std::size_t i = 0; i < heights.size(); ++i) {
                heights[i] = terrain_.vertex(first + i, line);
            }
        };
        if (upper_row_ != row) {
            read(upper_, row);
            upper_row_ = row;
        }
        read(lower_, row + 1);
        lower_row_ = row + 1;
    }

    double signOf(const EdgePart& part) const { return part.u1 > part.u0 ? sign_ : -sign_; }

    void cover(ColumnCoverage& coverage, const EdgePart& part) const
    {
        coverage.add(std::min(part.u0, part.u1), std::max(part.u0, part.u1), signOf(part));
    }

    void addCell(std::size_t column,
                 std::size_t row,
                 ColumnCoverage& coverage,
                 std::span<const EdgePart> parts,
                 std::size_t i)
    {
        if (parts.empty() && coverage.isEmpty()) {
            return;
        }
        const CellHeights z{upper_[i], upper_[i + 1], lower_[i], lower_[i + 1]};
        // A sample belongs to the polygon if the terrain right below it does, or left of it.
        if (inside(coverage.at(kNextTo))) {
            addHeight(z.upper_left);
        }
        if (column + 1 == terrain_.cellColumns() && inside(coverage.at(1.0 - kNextTo))) {
            addHeight(z.upper_right);
        }
        const std::optional<double> whole = parts.empty() ? coverage.whole() : std::nullopt;
        beginCell(column, row, z, !whole);
        if (whole && addWhole(*whole)) {
            addLastRow(column, row, coverage, z);
            return;
        }
        coverage.forEach([&](double from, double to, double weight) {
            // Of a cell. Edges, which are curves, meet within their tolerance.
            constexpr double kSliver = 1e-5;
            if (to - from > kSliver) {
                noteWeight(weight);
            }
            addRegion({from, 0.0}, {to, 0.0}, weight);
        });
        for (const EdgePart& part : parts) {
            if (part.u0 != part.u1) {
                const bool is_right = part.u1 > part.u0;
                addRegion(is_right ? UvPoint{part.u0, part.v0} : UvPoint{part.u1, part.v1},
                          is_right ? UvPoint{part.u1, part.v1} : UvPoint{part.u0, part.v0},
                          signOf(part));
                cover(coverage, part);
            }
        }
        if (!parts.empty()) {
            coverage.normalize();
        }
        addLastRow(column, row, coverage, z);
    }

    // Of the samples below the last row of cells.
    void addLastRow(std::size_t column,
                    std::size_t row,
                    const ColumnCoverage& coverage,
                    const CellHeights& z)
    {
        if (row + 1 != terrain_.cellRows()) {
            return;
        }
        if (inside(coverage.at(kNextTo))) {
            addHeight(z.lower_left);
        }
        if (column + 1 == terrain_.cellColumns() && inside(coverage.at(1.0 - kNextTo))) {
            addHeight(z.lower_right);
        }
    }

    void noteWeight(double weight)
    {
        constexpr double kRounding = 1e-6;
        crosses_itself = crosses_itself || weight > 1.0 + kRounding || weight < -kRounding;
    }

    // Both triangles whole, in closed form; false if the base cuts one of them.
    bool addWhole(double weight)
    {
        noteWeight(weight);
        const auto corners = [](const LinearOnCell& f, std::size_t triangle) {
            return std::array{f.at_corner, f.at_corner + (triangle == 0 ? f.per_u : f.per_v),
                              f.at_corner + f.per_u + f.per_v};
        };
        std::array<std::array<double, 3>, 2> above{};
        if (base_.kind != VolumeBase::None) {
            for (std::size_t i = 0; i < 2; ++i) {
                const auto z = corners(triangles_[i].elevation_m, i);
                const auto base = corners(triangles_[i].base_m, i);
                const std::array g{z[0] - base[0], z[1] - base[1], z[2] - base[2]};
                const bool is_above = g[0] >= 0.0 && g[1] >= 0.0 && g[2] >= 0.0;
                const bool is_below = g[0] <= 0.0 && g[1] <= 0.0 && g[2] <= 0.0;
                if (triangles_[i].has_terrain && !is_above && !is_below) {
                    return false;
                }
                above[i] = g;
            }
        }
        for (std::size_t i = 0; i < 2; ++i) {
            const Triangle& t = triangles_[i];
            if (!t.has_terrain) {
                continue;
            }
            const auto z = corners(t.elevation_m, i);
            const auto m2 = corners(t.cell_m2, i);
            const double area_m2 = 0.5 * weight * (m2[0] + m2[1] + m2[2]) / 3.0;
            covered_m2 += area_m2;
            surface_m2 += area_m2 * t.stretch;
            height_m3 += 0.5 * weight * meanProduct(m2, z);
            hypsometry.add(z, area_m2);
            const double above_base_m3 = 0.5 * weight * meanProduct(m2, above[i]);
            (above_base_m3 * weight >= 0.0 ? above_m3 : below_m3) +=
                above_base_m3 * weight >= 0.0 ? above_base_m3 : -above_base_m3;
        }
        return true;
    }

    static bool inside(double weight) { return weight > 0.5; }

    void addHeight(double height_m)
    {
        min_m = std::fmin(min_m, height_m); // of two, fmin and fmax ignore NaN
        max_m = std::fmax(max_m, height_m);
    }

    // Whether the ground's area changes so much across a row of cells that it matters where in a
    // triangle the terrain is high: near a pole of a map in degrees.
    bool isUneven(std::size_t row, double column)
    {
        if (uneven_row_ != row) {
            constexpr double kShare = 0.01;
            const double top = metric_.at({column, terrain_.rowLine(row)}).cellArea();
            const double bottom = metric_.at({column, terrain_.rowLine(row + 1)}).cellArea();
            is_uneven_ = std::abs(top - bottom) > kShare * std::max(top, bottom);
            uneven_row_ = row;
        }
        return is_uneven_;
    }

    // One of the two triangles of a cell.
    struct Triangle {
        bool has_terrain = false;
        LinearOnCell cell_m2{}; // area of the cell
        double stretch = 1.0;   // of the terrain: its area over that of the ground
        LinearOnCell elevation_m{};
        LinearOnCell base_m{};
    };

    void beginCell(std::size_t column, std::size_t row, const CellHeights& z, bool is_partial)
    {
        const double left = terrain_.columnLine(column);
        const double right = terrain_.columnLine(column + 1);
        const double top = terrain_.rowLine(row);
        const double bottom = terrain_.rowLine(row + 1);
        CellHeights base{};
        if (base_.kind != VolumeBase::None) {
            base = {base_.at({left, top}), base_.at({right, top}), base_.at({left, bottom}),
                    base_.at({right, bottom})};
        }
        const double width = right - left;
        const double height = bottom - top;
        CellHeights areas{};
        if (is_partial ||
            isUneven(row, left)) { // otherwise the area of its center is that of a triangle
            const auto area = [&](double c, double r) { return metric_.at({c, r}).cellArea(); };
            areas = {area(left, top), area(right, top), area(left, bottom), area(right, bottom)};
        }
        const auto linear = [](const CellHeights& c, bool is_upper) {
            return LinearOnCell{
                .at_corner = c.upper_left,
                .per_u = is_upper ? c.upper_right - c.upper_left : c.lower_right - c.lower_left,
                .per_v = is_upper ? c.lower_right - c.upper_right : c.lower_left - c.upper_left};
        };
        const auto make = [&](bool is_upper) {
            Triangle t{.elevation_m = linear(z, is_upper), .base_m = linear(base, is_upper)};
            const LinearOnCell& m = t.elevation_m;
            t.has_terrain = std::isfinite(m.at_corner + m.per_u + m.per_v);
            const double share = is_upper ? 1.0 / 3.0 : 2.0 / 3.0;
            const UvPoint center{1.0 - share, share};
            const GroundMetric metric =
                metric_.at({left + center.u * width, top + center.v * height});
            const double cell_m2 = metric.cellArea() * width * height;
            t.cell_m2 = linear(areas, is_upper);
            t.cell_m2.per_u *= width * height;
            t.cell_m2.per_v *= width * height;
            t.cell_m2.at_corner = cell_m2 - center.u * t.cell_m2.per_u - center.v * t.cell_m2.per_v;
            t.stretch =
                cell_m2 > 0.0 ? metric.surface(width, height, m.per_u, m.per_v) / cell_m2 : 1.0;
            return t;
        };
        triangles_ = {make(true), make(false)};
    }

    // The part of the cell below the straight line from `a` to `b`, which runs to the right.
    void addRegion(const UvPoint& a, const UvPoint& b, double weight)
    {
        CellPart region;
        region.add(a);
        region.add(b);
        region.add({b.u, 1.0});
        region.add({a.u, 1.0});
        const CellPart upper = clipped(region, [](const UvPoint& p) { return p.u - p.v; });
        const CellPart lower = clipped(region, [](const UvPoint& p) { return p.v - p.u; });
        addPart(upper, triangles_[0], weight);
        addPart(lower, triangles_[1], weight);
    }

    void addPart(CellPart part, const Triangle& t, double weight)
    {
        if (!t.has_terrain) {
            return;
        }
        const PartSum sum = sumOver(part, t.cell_m2, t.elevation_m);
        covered_m2 += weight * sum.area_m2;
        surface_m2 += weight * sum.area_m2 * t.stretch;
        height_m3 += weight * sum.first;
        forEachTriangle(part, [&](const UvPoint& o, const UvPoint& a, const UvPoint& b,
                                  double cells) {
            const LinearOnCell& z = t.elevation_m;
            const double cell_m2 = t.cell_m2({(o.u + a.u + b.u) / 3.0, (o.v + a.v + b.v) / 3.0});
            hypsometry.add({z(o), z(a), z(b)}, weight * cells * cell_m2);
        });
        if (base_.kind == VolumeBase::None) {
            return;
        }
        for (std::size_t i = 0; i < part.count; ++i) {
            UvPoint& p = part.points[i];
            p.g = t.elevation_m(p) - t.base_m(p);
        }
        const auto g = [](const UvPoint& p) { return p.g; };
        const auto minus_g = [](const UvPoint& p) { return -p.g; };
        above_m3 += weight * sumOver(clipped(part, g), t.cell_m2, g).first;
        below_m3 += weight * sumOver(clipped(part, minus_g), t.cell_m2, minus_g).first;
    }

    static constexpr double kNextTo = 1e-9;  // from a line of the grid
    static constexpr std::size_t kFirst = 0; // of two caps
    static constexpr std::size_t kLast = 1;
    static constexpr std::size_t kNoRow = std::numeric_limits<std::size_t>::max();

    MeasuredTerrain& terrain_;
    MetricField& metric_;
    const VolumeSurface& base_;
    const LocalFrame& frame_;
    double sign_ = 1.0;
    std::array<std::optional<CapArea>, 2> caps_;
    std::vector<double> upper_;
    std::vector<double> lower_;
    std::size_t upper_row_ = kNoRow;
    std::size_t lower_row_ = kNoRow;
    std::size_t uneven_row_ = kNoRow;
    bool is_uneven_ = false;
    std::array<Triangle, 2> triangles_;
};

// How the count of edges above a place becomes a share of the polygon.
struct Sides {
    double outside = 0.0;
    double sign = 1.0;
};

// Of the two sides of the polygon, the smaller one counts.
Sides sidesOf(const MeasuredTerrain& terrain, const PolygonOutline& outline, double signed_area_m2)
{
    const GeoTransform::Terms& t = terrain.georeference().transform().terms();
    const Crs* crs = terrain.ground().ellipsoid() ? &*terrain.georeference().crs() : nullptr;
    const double east = crs != nullptr ? crs->eastSign() : 1.0;
    const double north = crs != nullptr ? crs->northSign() : 1.0;
    // Whether columns to rows is counterclockwise on the ground: for a map with north up it is not.
    const bool is_mirrored = (t[1] * t[5] - t[2] * t[4]) * east * north < 0.0;
    const bool is_left_smaller = signed_area_m2 >= 0.0;
    if (terrain.period() > 0.0 && std::abs(outline.turn_columns) > 0.5 * terrain.period()) {
        // Around a pole. To the right along the columns, the side below the edges is the right one
        // on a mirrored map.
        const bool runs_right = outline.turn_columns > 0.0;
        const bool is_below_left = runs_right ? !is_mirrored : is_mirrored;
        const double sign = runs_right ? 1.0 : -1.0;
        return is_below_left == is_left_smaller ? Sides{0.0, sign} : Sides{1.0, -sign};
    }
    const double sign = outline.area >= 0.0 ? 1.0 : -1.0;
    const bool is_inner_left = (outline.area >= 0.0) != is_mirrored;
    return is_inner_left == is_left_smaller ? Sides{0.0, sign} : Sides{1.0, -sign};
}

Status setPlane(const MeasuredTerrain& terrain,
                const BorderPlane& border,
                const LocalFrame& frame,
                double reach_m,
                GridPoint low,
                GridPoint high,
                VolumeSurface& base)
{
    if (terrain.ground().ellipsoid() &&
        reach_m > terrain.ground().ellipsoid()->equatorial_m * std::numbers::pi / 6.0) {
        return Error{ErrorCode::OutOfRange,
                     "the polygon is too large for a plane through its border; state the base's "
                     "elevation instead"};
    }
    if (!border.solve(base)) {
        return Error{
            ErrorCode::Invalid,
            "there is too little terrain along the polygon's border for a plane; state the "
            "base's elevation instead"};
    }
    constexpr double kTolerance = 1e-8;
    base.east_north = GridField<2>::of(
        low, high, kTolerance, [&](GridPoint grid) -> std::optional<std::array<double, 2>> {
            const auto position = terrain.fromGrid(grid);
            if (!position) {
                return std::nullopt;
            }
            const Vec3 local = frame.toLocal(terrain.ground().cartesian(*position, 0.0));
            return std::array{local.x, local.y};
        });
    if (!base.east_north) {
        return Error{ErrorCode::OutOfRange,
                     "the polygon reaches the edge of the map's projection, where no plane can be "
                     "placed; state the base's elevation instead"};
    }
    return Done{};
}

// Of level bases, above and below 0.
double farthestBaseM(const Ground& ground) noexcept
{
    constexpr double kOnPlaneM = 1e8; // more than the radius of any planet
    return ground.ellipsoid() ? ground.ellipsoid()->equatorial_m : kOnPlaneM;
}

} // namespace

Status checkVolumeBase(const Ground& ground, const AreaOptions& options)
{
    if (options.base != VolumeBase::Elevation ||
        std::abs(options.base_m) <= farthestBaseM(ground)) {
        return Done{};
    }
    return Error{ErrorCode::OutOfRange,
                 fmt::format("an elevation of {:g} m is farther from 0 than {}; use one between "
                             "{:.0f} and {:.0f} m",
                             options.base_m,
                             ground.ellipsoid() ? "the body's radius" : "any terrain",
                             -farthestBaseM(ground), farthestBaseM(ground))};
}

Result<TerrainArea> measureArea(MeasuredTerrain& terrain,
                                std::span<const GroundPosition> vertices,
                                const AreaOptions& options,
                                JobMonitor& monitor)
{
    if (vertices.size() > 3 && vertices.front() == vertices.back()) {
        vertices = vertices.first(vertices.size() - 1); // written closed
    }
    const Ground& ground = terrain.ground();
    if (Status status = checkPositions(ground, vertices, 3, "an area"); !status) {
        return std::move(status).error();
    }
    if (Status status = checkVolumeBase(ground, options); !status) {
        return std::move(status).error();
    }
    const GroundPolygon polygon = ground.polygon(vertices);
    Result<PolygonOutline> edges = outlineOf(terrain, vertices);
    if (!edges) {
        return std::move(edges).error();
    }
    PolygonOutline& outline = *edges;
    TerrainArea area;
    area.is_approximate = terrain.isApproximate();
    area.geodesic_m2 = std::abs(polygon.area_m2);
    area.perimeter_m = polygon.perimeter_m;

    Vec3 middle;
    for (const GroundPosition& vertex : vertices) {
        middle =
            middle + ground.cartesian(vertex, 0.0) * (1.0 / static_cast<double>(vertices.size()));
    }
    const GroundPosition center = ground.positionOf(middle);
    const LocalFrame frame = ground.frameAt(center);
    double reach_m = 0.0;
    Border border(ground, frame);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const GroundLine line = ground.line(vertices[i], vertices[(i + 1) % vertices.size()]);
        reach_m = std::max(reach_m, ground.distanceM(center, vertices[i]));
        const auto share = [&](std::size_t k) {
            return kBorderShare * static_cast<double>(k) / static_cast<double>(vertices.size());
        };
        const JobPart part(monitor, share(i), share(i + 1));
        border.plane.begin(line);
        if (Status status = tracePath(terrain, line, monitor, border); !status) {
            return std::move(status).error();
        }
    }
    const Sides sides = sidesOf(terrain, outline, polygon.area_m2);
    // Whole cells are summed up. Where columns are periodic, the outline may be in any turn.
    const double last_column = terrain.columnLine(terrain.cellColumns());
    const double last_row = terrain.rowLine(terrain.cellRows());
    const auto column = [&](double at) {
        return terrain.period() > 0.0 ? at : std::clamp(at, 0.0, last_column);
    };
    const double margin = terrain.columnLine(1);
    const GridPoint from{column(outline.low.column - margin),
                         std::clamp(outline.low.row - margin, 0.0, last_row)};
    const GridPoint to{column(outline.high.column + margin),
                       std::clamp(outline.high.row + margin, 0.0, last_row)};
    VolumeSurface base{.kind = options.base, .level_m = options.base_m};
    base.period = terrain.period();
    base.middle_column = 0.5 * (outline.low.column + outline.high.column);
    if (options.base == VolumeBase::BorderPlane) {
        if (Status status = setPlane(terrain, border.plane, frame, reach_m, from, to, base);
            !status) {
            return std::move(status).error();
        }
    }
    const std::unique_ptr<MetricField> metric = MetricField::of(terrain, from, to);
    AreaSummer sum(terrain, *metric, base, frame, options.hypsometry_step_m);
    const JobPart part(monitor, kBorderShare, 1.0);
    if (Status status = sum.run(std::move(outline.parts), sides.outside, sides.sign, monitor);
        !status) {
        return std::move(status).error();
    }
    if (Status status = sum.addCaps(border.in_caps); !status) {
        return std::move(status).error();
    }
    area.covered_m2 = sum.covered_m2;
    area.surface_m2 = sum.surface_m2;
    area.mean_m = sum.covered_m2 != 0.0 ? sum.height_m3 / sum.covered_m2 : kNoMeasure;
    area.min_m = std::fmin(sum.min_m, border.plane.min_m);
    area.max_m = std::fmax(sum.max_m, border.plane.max_m);
    area.hypsometry = sum.hypsometry.result(area.min_m, area.max_m);
    area.crosses_itself = sum.crosses_itself;
    if (options.base != VolumeBase::None) {
        area.volume_above_m3 = sum.above_m3;
        area.volume_below_m3 = sum.below_m3;
    }
    if (area.crosses_itself) {
        area.surface_m2 = area.mean_m = kNoMeasure;
        area.hypsometry = {};
        for (std::optional<double>* volume : {&area.volume_above_m3, &area.volume_below_m3}) {
            if (*volume) {
                *volume = kNoMeasure;
            }
        }
    }
    return area;
}

} // namespace marsview
