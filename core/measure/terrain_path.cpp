#include "core/measure/terrain_path.h"

#include "core/measure/cap_path.h"
#include "core/measure/constants.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace marsview {
namespace {

constexpr double kFitTolerance = 1e-7;     // samples; times a steep 10 m a sample: a micrometer
constexpr double kProjectionNoiseM = 2e-7; // several times that of Crs
constexpr double kFlatM = 1e-4;            // elevation between the ends of a piece
constexpr double kSameCut = 1e-9;          // samples, as Georeference rounds positions
// A line is halved until a curve fits. What does not fit in 1e-12 of it crosses an edge of the
// projection.
constexpr int kDepthMax = 40;
constexpr std::size_t kCurvesMax = 1'000'000; // a bound on work, not met on any known map
constexpr int kFlatDepthMax = 10;

double valueAt(const std::array<double, 4>& a, double t)
{
    return ((a[3] * t + a[2]) * t + a[1]) * t + a[0];
}

// The cubic through four values at t = 0, 1/3, 2/3 and 1.
std::array<double, 4> cubicThrough(const std::array<double, 4>& p)
{
    // Differences, so that a constant stays exactly constant.
    const double d1 = p[1] - p[0];
    const double d2 = p[2] - p[1];
    const double d3 = p[3] - p[2];
    const double second = d2 - d1;
    const double third = d3 - 2.0 * d2 + d1;
    // Newton's form in 3t, expanded.
    return {p[0], 3.0 * d1 - 1.5 * second + third, 4.5 * second - 4.5 * third, 4.5 * third};
}

class CurveFitter {
public:
    CurveFitter(const MeasuredTerrain& terrain, const GroundLine& line)
        : terrain_(terrain)
        , line_(line)
        , tolerance_(
              std::max(kFitTolerance,
                       kProjectionNoiseM / std::min(terrain.georeference().pixelWidthMeters(),
                                                    terrain.georeference().pixelHeightMeters())))
    {}

    std::vector<GridCurve> run()
    {
        const double length_m = line_.lengthM();
        // A turn of longitude is followed from node to node: no part may be longer than half of it.
        constexpr int kParts = 4;
        for (int i = 0; i < kParts; ++i) {
            const double begin_m = length_m * i / kParts;
            const double end_m = i + 1 == kParts ? length_m : length_m * (i + 1) / kParts;
            fit(begin_m, end_m, gridAt(begin_m), gridAt(end_m), 0);
        }
        return std::move(curves_);
    }

private:
    using Place = std::optional<GridPoint>;

    Place gridAt(double distance_m) { return terrain_.toGrid(line_.at(distance_m)); }

    // `place` in the turn of longitude nearest to `column`.
    Place near(Place place, double column) const
    {
        if (place && terrain_.period() > 0.0) {
            place->column +=
                terrain_.period() * std::round((column - place->column) / terrain_.period());
        }
        return place;
    }

    void fit(double begin_m, double end_m, Place begin, Place end, int depth)
    {
        const auto between = [&](double t) { return begin_m + t * (end_m - begin_m); };
        if (begin && !curves_.empty() && curves_.back().is_on_map) {
            begin = near(begin, curves_.back().at(1.0).column);
        }
        GridCurve curve{.begin_m = begin_m, .end_m = end_m};
        if (begin && end) {
            const Place third = near(gridAt(between(1.0 / 3.0)), begin->column);
            const Place two_thirds =
                third ? near(gridAt(between(2.0 / 3.0)), third->column) : third;
            const Place last = two_thirds ? near(end, two_thirds->column) : two_thirds;
            if (last) {
                curve.column =
                    cubicThrough({begin->column, third->column, two_thirds->column, last->column});
                curve.row = cubicThrough({begin->row, third->row, two_thirds->row, last->row});
                if (fits(curve)) {
                    curves_.push_back(curve);
                    return;
                }
            }
        }
        const double middle_m = between(0.5);
        if (depth >= kDepthMax || curves_.size() >= kCurvesMax ||
            !(middle_m > begin_m && middle_m < end_m)) {
            addUnfit(begin_m, end_m, begin, end);
            return;
        }
        const Place middle = gridAt(middle_m);
        if (!begin && !middle && !end && isOutside(begin_m, end_m)) {
            curve.is_on_map = false;
            curves_.push_back(curve);
            return;
        }
        fit(begin_m, middle_m, begin, middle, depth + 1);
        fit(middle_m, end_m, middle, end, depth + 1);
    }

    // A jump of the projection, or positions that are rounded by more than the tolerance.
    void addUnfit(double begin_m, double end_m, const Place& begin, const Place& end)
    {
        GridCurve curve{.begin_m = begin_m, .end_m = end_m, .is_on_map = false};
        if (begin && end) {
            const Place last = near(end, begin->column);
            constexpr double kJump = 1e-3; // samples
            const double columns = last->column - begin->column;
            const double rows = last->row - begin->row;
            curve.column = {begin->column, columns, 0.0, 0.0};
            curve.row = {begin->row, rows, 0.0, 0.0};
            curve.is_on_map = std::hypot(columns, rows) < kJump;
            curve.is_along_pole =
                !curve.is_on_map && terrain_.period() > 0.0 && std::abs(rows) < kJump;
        }
        curves_.push_back(curve);
    }

    // How far a position is beyond the raster, in samples.
    double beyond(const GridPoint& grid) const
    {
        const auto excess = [](double at, double last) { return std::max({0.0, -at, at - last}); };
        const Georeference& georeference = terrain_.georeference();
        const double rows = excess(grid.row, static_cast<double>(georeference.rows() - 1));
        return terrain_.period() > 0.0
                   ? rows
                   : std::max(rows,
                              excess(grid.column, static_cast<double>(georeference.columns() - 1)));
    }

    bool fits(const GridCurve& curve)
    {
        constexpr double kShareBeyond = 1e-3;
        double away = std::min(beyond(curve.at(0.0)), beyond(curve.at(1.0)));
        for (const double t : {1.0 / 6.0, 0.5, 5.0 / 6.0}) {
            const GridPoint expected = curve.at(t);
            const Place real =
                near(gridAt(curve.begin_m + t * (curve.end_m - curve.begin_m)), expected.column);
            if (!real) {
                return false;
            }
            away = std::min(away, beyond(*real));
            const double tolerance = tolerance_ + kShareBeyond * away;
            if (!(std::abs(real->column - expected.column) <= tolerance) ||
                !(std::abs(real->row - expected.row) <= tolerance)) {
                return false;
            }
        }
        return true;
    }

    bool isOutside(double begin_m, double end_m)
    {
        constexpr int kTried = 16;
        for (int i = 1; i < kTried; ++i) {
            if (gridAt(begin_m + (end_m - begin_m) * i / kTried)) {
                return false;
            }
        }
        return true;
    }

    const MeasuredTerrain& terrain_;
    const GroundLine& line_;
    double tolerance_;
    std::vector<GridCurve> curves_;
};

// The parameters at which the derivative vanishes, ascending, within (0, 1).
int extrema(const std::array<double, 4>& a, std::array<double, 2>& found)
{
    const double qa = 3.0 * a[3];
    const double qb = 2.0 * a[2];
    const double qc = a[1];
    int count = 0;
    const auto add = [&](double t) {
        if (t > 0.0 && t < 1.0) {
            found[static_cast<std::size_t>(count++)] = t;
        }
    };
    const double discriminant = qb * qb - 4.0 * qa * qc;
    if (qa == 0.0) {
        if (qb != 0.0) {
            add(-qc / qb);
        }
    } else if (discriminant > 0.0) {
        const double q = -0.5 * (qb + std::copysign(std::sqrt(discriminant), qb));
        add(q / qa);
        if (q != 0.0) {
            add(qc / q);
        }
    }
    if (count == 2 && found[0] > found[1]) {
        std::swap(found[0], found[1]);
    }
    return count;
}

// The root of a monotone part, whose ends have different signs: Newton's steps within a bracket.
double rootBetween(const std::array<double, 4>& a, double value, double low, double high)
{
    const bool is_rising = valueAt(a, high) > value;
    double t = 0.5 * (low + high);
    for (int i = 0; i < 60; ++i) {
        const double f = valueAt(a, t) - value;
        if (f == 0.0) {
            return t;
        }
        ((f < 0.0) == is_rising ? low : high) = t;
        const double slope = (3.0 * a[3] * t + 2.0 * a[2]) * t + a[1];
        double next = t - f / slope;
        if (!(next > low && next < high)) {
            next = 0.5 * (low + high);
        }
        if (std::abs(next - t) <= 1e-16) {
            return next;
        }
        t = next;
    }
    return t;
}

class CutFinder {
public:
    CutFinder(const MeasuredTerrain& terrain, std::vector<CellCut>& cuts)
        : terrain_(terrain)
        , cuts_(cuts)
    {}

    void run(const GridCurve& curve)
    {
        cuts_.clear();
        cuts_.push_back({.t = 0.0});
        addCuts(
            curve.column, terrain_.cellColumns(), terrain_.period(),
            [this](std::size_t index) { return terrain_.columnLine(index); },
            [this](double t, double line) { cuts_.push_back({.t = t, .column = line}); });
        addCuts(
            curve.row, terrain_.cellRows(), 0.0,
            [this](std::size_t index) { return terrain_.rowLine(index); },
            [this](double t, double line) { cuts_.push_back({.t = t, .row = line}); });
        cuts_.push_back({.t = 1.0});
        std::sort(cuts_.begin(), cuts_.end(),
                  [](const CellCut& a, const CellCut& b) { return a.t < b.t; });
        // Through a sample a curve meets two lines at once, in the order of rounding.
        std::size_t kept = 0;
        for (std::size_t i = 1; i < cuts_.size(); ++i) {
            const GridPoint a = curve.at(cuts_[kept].t);
            const GridPoint b = curve.at(cuts_[i].t);
            if (std::hypot(a.column - b.column, a.row - b.row) <= kSameCut &&
                cuts_[i].t - cuts_[kept].t <= 0.5) {
                CellCut& cut = cuts_[kept];
                cut.column = std::isnan(cut.column) ? cuts_[i].column : cut.column;
                cut.row = std::isnan(cut.row) ? cuts_[i].row : cut.row;
                if (cuts_[i].t == 1.0) {
                    cut.t = kept == 0 ? cut.t : 1.0;
                    if (kept == 0) {
                        cuts_[++kept] = {.t = 1.0, .column = cut.column, .row = cut.row};
                    }
                }
            } else {
                cuts_[++kept] = cuts_[i];
            }
        }
        cuts_.resize(kept + 1);
    }

private:
    template <typename Line, typename Add>
    void addCuts(const std::array<double, 4>& cubic,
                 std::size_t cells,
                 double period,
                 const Line& line,
                 const Add& add)
    {
        std::array<double, 2> turning{};
        const int count = extrema(cubic, turning);
        double begin_t = 0.0;
        for (int part = 0; part <= count; ++part) {
            const double end_t = part == count ? 1.0 : turning[static_cast<std::size_t>(part)];
            const double from = valueAt(cubic, begin_t);
            const double to = valueAt(cubic, end_t);
            const double low = std::min(from, to);
            const double high = std::max(from, to);
            const auto first_turn =
                static_cast<long>(period > 0.0 ? std::floor((low - line(cells)) / period) : 0.0);
            const auto last_turn = static_cast<long>(period > 0.0 ? std::ceil(high / period) : 0.0);
            for (long turn = first_turn; turn <= last_turn; ++turn) {
                const double offset = static_cast<double>(turn) * period;
                // The seam's end is the first line of the next turn.
                const std::size_t lines =
                    period > 0.0 && terrain_.wrapsAround() ? cells : cells + 1;
                for (std::size_t i = firstLine(line, cells, low - offset); i < lines; ++i) {
                    const double value = line(i) + offset;
                    if (value >= high) {
                        break;
                    }
                    if (value > low) {
                        add(rootBetween(cubic, value, begin_t, end_t), value);
                    }
                }
            }
            begin_t = end_t;
        }
    }

    template <typename Line>
    static std::size_t firstLine(const Line& line, std::size_t cells, double above)
    {
        std::size_t low = 0;
        std::size_t high = cells + 1;
        while (low < high) {
            const std::size_t middle = (low + high) / 2;
            if (line(middle) > above) {
                high = middle;
            } else {
                low = middle + 1;
            }
        }
        return low;
    }

    const MeasuredTerrain& terrain_;
    std::vector<CellCut>& cuts_;
};

class PathTracer {
public:
    PathTracer(MeasuredTerrain& terrain, const GroundLine& line, PathVisitor& visitor)
        : terrain_(terrain)
        , line_(line)
        , visitor_(visitor)
    {}

    Status trace(const GridCurve& curve, JobMonitor& monitor)
    {
        if (!curve.is_on_map) {
            if (curve.is_along_pole && isOfCap(curve.at(0.5).row, curve.begin_m, curve.end_m)) {
                return Done{};
            }
            finish();
            visitor_.visit(acrossGap(curve));
            return Done{};
        }
        findCellCuts(terrain_, curve, cuts_);
        for (std::size_t i = 0; i + 1 < cuts_.size(); ++i) {
            constexpr std::size_t kCutsBetweenLooks = 256;
            if (i % kCutsBetweenLooks == 0 && monitor.isCanceled()) {
                return Error{ErrorCode::Canceled, "measuring was canceled"};
            }
            traceCell(curve, cuts_[i], cuts_[i + 1]);
            if (terrain_.failure()) {
                return *terrain_.failure();
            }
        }
        return Done{};
    }

    /// After the last curve.
    void finish()
    {
        if (cap_ != nullptr) {
            traceCap(terrain_, *std::exchange(cap_, nullptr), line_, cap_begin_m_, cap_end_m_,
                     visitor_);
        }
    }

private:
    // Parts that follow each other within a cap are traced as one.
    bool isOfCap(double row, double begin_m, double end_m)
    {
        const CapTerrain* cap = terrain_.capBeyond(row);
        if (cap == nullptr) {
            return false;
        }
        if (cap != cap_) {
            finish();
            cap_ = cap;
            cap_begin_m_ = begin_m;
        }
        cap_end_m_ = end_m;
        return true;
    }

    // What is not on the map, unless it lies at a pole that is a row of the grid.
    PathPiece acrossGap(const GridCurve& curve)
    {
        const auto begin = terrain_.placeOf(curve.at(0.0));
        const auto end = terrain_.placeOf(curve.at(1.0));
        PathPiece piece{curve.begin_m, curve.end_m, false, false, kNoMeasure, kNoMeasure};
        if (curve.is_along_pole && begin && end) {
            piece.begin_elevation_m = terrain_.elevation(*begin);
            piece.end_elevation_m = terrain_.elevation(*end);
            piece.has_terrain =
                std::isfinite(piece.begin_elevation_m) && std::isfinite(piece.end_elevation_m);
            piece.is_on_map = true;
        }
        return piece;
    }

    // The part of the curve between two cuts, which is in one cell.
    void traceCell(const GridCurve& curve, const CellCut& begin, const CellCut& end)
    {
        const std::optional<CellPlace> middle = terrain_.placeOf(curve.at(0.5 * (begin.t + end.t)));
        if (!middle) {
            if (!isOfCap(curve.at(0.5 * (begin.t + end.t)).row, distance(curve, begin.t),
                         distance(curve, end.t))) {
                emit(curve, begin.t, end.t, nullptr, {}, {});
            }
            return;
        }
        cell_.column = middle->column;
        cell_.row = middle->row;
        cell_.heights = terrain_.cell(cell_.column, cell_.row);
        const double turn = terrain_.turnOf(curve.at(0.5 * (begin.t + end.t)).column);
        cell_.left = terrain_.columnLine(cell_.column) + turn * terrain_.period();
        cell_.width = terrain_.columnLine(cell_.column + 1) - terrain_.columnLine(cell_.column);
        if (curve.at(0.5 * (begin.t + end.t)).column < cell_.left) {
            cell_.left -= terrain_.period(); // the seam, left of the first column
        }
        cell_.top = terrain_.rowLine(cell_.row);
        cell_.height = terrain_.rowLine(cell_.row + 1) - cell_.top;
        const Local a = localAt(curve, begin);
        const Local b = localAt(curve, end);
        split(curve, a, b);
    }

    struct Cell {
        std::size_t column = 0;
        std::size_t row = 0;
        double left = 0.0;
        double width = 1.0;
        double top = 0.0;
        double height = 1.0;
        CellHeights heights{};
    };
    // A point of the curve in the cell.
    struct Local {
        double t = 0.0;
        double u = 0.0;
        double v = 0.0;
    };

    Local localAt(const GridCurve& curve, const CellCut& cut) const
    {
        const GridPoint grid = curve.at(cut.t);
        const double column = std::isnan(cut.column) ? grid.column : cut.column;
        const double row = std::isnan(cut.row) ? grid.row : cut.row;
        return {cut.t, std::clamp((column - cell_.left) / cell_.width, 0.0, 1.0),
                std::clamp((row - cell_.top) / cell_.height, 0.0, 1.0)};
    }
    Local localAt(const GridCurve& curve, double t) const
    {
        return localAt(curve, CellCut{.t = t});
    }

    double heightAt(const Local& at) const { return heightInCell(cell_.heights, at.u, at.v); }

    // At the diagonal, which a curve may cross twice within the cell.
    void split(const GridCurve& curve, const Local& a, const Local& b)
    {
        const Local middle = localAt(curve, 0.5 * (a.t + b.t));
        const auto side = [](const Local& p) { return p.u - p.v; };
        const double begin_side = side(a);
        const double middle_side = side(middle);
        const double end_side = side(b);
        if (begin_side * end_side < 0.0) {
            const Local cut = diagonalCut(curve, a, b);
            flatten(curve, a, cut, 0);
            flatten(curve, cut, b, 0);
        } else if (begin_side * middle_side < 0.0 && middle_side * end_side < 0.0) {
            const Local first = diagonalCut(curve, a, middle);
            const Local second = diagonalCut(curve, middle, b);
            flatten(curve, a, first, 0);
            flatten(curve, first, second, 0);
            flatten(curve, second, b, 0);
        } else {
            flatten(curve, a, b, 0);
        }
    }

    Local diagonalCut(const GridCurve& curve, Local a, Local b) const
    {
        const bool begins_above = a.u > a.v;
        for (int i = 0; i < 60; ++i) {
            const double fa = a.u - a.v;
            const double fb = b.u - b.v;
            // The secant, kept off the ends so that the bracket shrinks.
            const double share = std::clamp(fa / (fa - fb), 1e-3, 1.0 - 1e-3);
            const double t = a.t + share * (b.t - a.t);
            if (!(t > a.t && t < b.t)) {
                break;
            }
            const Local at = localAt(curve, t);
            if (std::abs(at.u - at.v) <= 1e-14) {
                a = at;
                break;
            }
            ((at.u > at.v) == begins_above ? a : b) = at;
        }
        const double on = 0.5 * (a.u + a.v);
        return {a.t, on, on};
    }

    // Halved where the curve is bent so much that the elevation is not linear along it.
    void flatten(const GridCurve& curve, const Local& a, const Local& b, int depth)
    {
        const Local middle = localAt(curve, 0.5 * (a.t + b.t));
        const double begin_m = heightAt(a);
        const double middle_m = heightAt(middle);
        const double end_m = heightAt(b);
        if (depth < kFlatDepthMax && std::abs(middle_m - 0.5 * (begin_m + end_m)) > kFlatM) {
            flatten(curve, a, middle, depth + 1);
            flatten(curve, middle, b, depth + 1);
            return;
        }
        emit(curve, a.t, b.t, &middle_m, begin_m, end_m);
    }

    void emit(const GridCurve& curve,
              double begin_t,
              double end_t,
              const double* middle_m,
              double begin_m,
              double end_m)
    {
        finish();
        const bool has_terrain = middle_m != nullptr && std::isfinite(*middle_m);
        visitor_.visit({distance(curve, begin_t), distance(curve, end_t), has_terrain,
                        middle_m != nullptr, middle_m != nullptr ? begin_m : kNoMeasure,
                        middle_m != nullptr ? end_m : kNoMeasure});
    }

    static double distance(const GridCurve& curve, double t)
    {
        return t == 1.0 ? curve.end_m : curve.begin_m + t * (curve.end_m - curve.begin_m);
    }

    MeasuredTerrain& terrain_;
    const GroundLine& line_;
    PathVisitor& visitor_;
    // What is not traced yet; null: nothing.
    const CapTerrain* cap_ = nullptr;
    double cap_begin_m_ = 0.0;
    double cap_end_m_ = 0.0;
    std::vector<CellCut> cuts_;
    Cell cell_;
};

} // namespace

void findCellCuts(const MeasuredTerrain& terrain,
                  const GridCurve& curve,
                  std::vector<CellCut>& cuts)
{
    CutFinder(terrain, cuts).run(curve);
}

std::vector<GridCurve> gridCurves(const MeasuredTerrain& terrain, const GroundLine& line)
{
    return CurveFitter(terrain, line).run();
}

Status tracePath(MeasuredTerrain& terrain,
                 const GroundLine& line,
                 JobMonitor& monitor,
                 PathVisitor& visitor)
{
    PathTracer tracer(terrain, line, visitor);
    for (const GridCurve& curve : gridCurves(terrain, line)) {
        if (Status status = tracer.trace(curve, monitor); !status) {
            return status;
        }
        monitor.report(line.lengthM() > 0.0 ? curve.end_m / line.lengthM() : 1.0);
    }
    tracer.finish();
    if (terrain.failure()) {
        return *terrain.failure();
    }
    return Done{};
}

double estimatedPieces(const MeasuredTerrain& terrain, std::span<const GroundPosition> positions)
{
    constexpr int kSteps = 64;
    double pieces = 0.0;
    for (std::size_t i = 0; i + 1 < positions.size(); ++i) {
        const GroundLine line = terrain.ground().line(positions[i], positions[i + 1]);
        std::optional<GridPoint> before;
        for (int k = 0; k <= kSteps; ++k) {
            const auto here = terrain.toGrid(line.at(line.lengthM() * k / kSteps));
            if (before && here) {
                double columns = std::abs(here->column - before->column);
                if (terrain.period() > 0.0) {
                    columns = std::min(columns, std::abs(terrain.period() - columns));
                }
                pieces += 2.0 * (columns + std::abs(here->row - before->row)) + 1.0;
            }
            before = here;
        }
    }
    return pieces;
}

} // namespace marsview
