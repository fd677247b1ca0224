#include "core/measure/line_measures.h"

#include "core/measure/constants.h"
#include "core/measure/terrain_path.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace marsview {
namespace {

// Progress in proportion to lengths.
class LegProgress {
public:
    LegProgress(const Ground& ground, std::span<const GroundPosition> positions)
    {
        ends_m_.push_back(0.0);
        for (std::size_t i = 0; i + 1 < positions.size(); ++i) {
            lines_.push_back(ground.line(positions[i], positions[i + 1]));
            ends_m_.push_back(ends_m_.back() + lines_.back().lengthM());
        }
    }

    const std::vector<GroundLine>& lines() const { return lines_; }
    const std::vector<double>& ends() const { return ends_m_; }
    double totalM() const { return ends_m_.back(); }
    double share(std::size_t leg) const
    {
        return totalM() > 0.0 ? std::min(1.0, ends_m_[leg] / totalM()) : 0.0;
    }

private:
    std::vector<GroundLine> lines_;
    std::vector<double> ends_m_;
};

class SurfaceLength final : public PathVisitor {
public:
    void visit(const PathPiece& piece) override
    {
        const double length_m = piece.end_m - piece.begin_m;
        if (piece.has_terrain) {
            surface_m += std::hypot(length_m, piece.end_elevation_m - piece.begin_elevation_m);
        } else {
            void_m += length_m;
        }
    }

    double surface_m = 0.0;
    double void_m = 0.0;
};

class ProfileMaker final : public PathVisitor {
public:
    ProfileMaker(const MeasuredTerrain& terrain, std::vector<ProfilePoint>& points)
        : terrain_(terrain)
        , points_(points)
    {}

    void begin(const GroundLine& line, double offset_m)
    {
        line_ = &line;
        offset_m_ = offset_m;
        is_first_ = points_.empty();
        offset_index_ = points_.size();
        was_outside_ = false;
    }

    void visit(const PathPiece& piece) override
    {
        if (is_first_) {
            add(piece.begin_m, piece.begin_elevation_m);
            is_first_ = false;
        } else if (std::isnan(points_.back().elevation_m)) {
            // The end of a gap belongs to the triangle beyond it.
            points_.back().elevation_m = piece.begin_elevation_m;
        }
        if (piece.end_m <= piece.begin_m) {
            return;
        }
        if (!piece.has_terrain && std::isfinite(points_.back().elevation_m)) {
            add(0.5 * (piece.begin_m + piece.end_m), kNoMeasure);
        }
        // Outside the map, one point at the end of a gap is enough.
        const bool is_outside = !piece.is_on_map && points_.size() > offset_index_ + 1 &&
                                std::isnan(points_.back().elevation_m) && was_outside_;
        if (is_outside) {
            points_.pop_back();
        }
        add(piece.end_m, piece.end_elevation_m);
        was_outside_ = !piece.is_on_map;
    }

private:
    void add(double distance_m, double elevation_m)
    {
        points_.push_back(
            {offset_m_ + distance_m, terrain_.inTurn(line_->at(distance_m)), elevation_m});
    }

    const MeasuredTerrain& terrain_;
    std::vector<ProfilePoint>& points_;
    const GroundLine* line_ = nullptr;
    double offset_m_ = 0.0;
    std::size_t offset_index_ = 0; // of the first point of the leg
    bool is_first_ = true;
    bool was_outside_ = false;
};

Status sampleByStep(MeasuredTerrain& terrain,
                    const LegProgress& legs,
                    double step_m,
                    JobMonitor& monitor,
                    Profile& profile)
{
    constexpr double kPointsMax = 1e7;
    const double total_m = legs.totalM();
    if (!(total_m / step_m <= kPointsMax)) {
        return Error{ErrorCode::OutOfRange,
                     fmt::format("a step of {} m makes more than {:.0f} points over {:.6g} m; "
                                 "choose a longer step",
                                 step_m, kPointsMax, total_m)};
    }
    std::size_t leg = 0;
    for (std::size_t i = 0;; ++i) {
        const double distance_m = std::min(static_cast<double>(i) * step_m, total_m);
        while (leg + 1 < legs.lines().size() && distance_m > legs.ends()[leg + 1]) {
            ++leg;
        }
        const GroundPosition position = legs.lines()[leg].at(distance_m - legs.ends()[leg]);
        profile.points.push_back(
            {distance_m, terrain.inTurn(position), terrain.elevation(position)});
        if (terrain.failure()) {
            return *terrain.failure();
        }
        if (distance_m >= total_m) {
            return Done{};
        }
        constexpr std::size_t kPointsBetweenLooks = 256;
        if (i % kPointsBetweenLooks == 0) {
            if (monitor.isCanceled()) {
                return Error{ErrorCode::Canceled, "measuring was canceled"};
            }
            monitor.report(distance_m / total_m);
        }
    }
}

} // namespace

Status checkPositions(const Ground& ground,
                      std::span<const GroundPosition> positions,
                      std::size_t count_min,
                      const char* what)
{
    if (positions.size() < count_min) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{} needs at least {} positions, but there {} {}", what, count_min,
                                 positions.size() == 1 ? "is" : "are", positions.size())};
    }
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const GroundPosition& p = positions[i];
        if (!std::isfinite(p.x) || !std::isfinite(p.y)) {
            return Error{ErrorCode::Invalid,
                         fmt::format("position {} is {}, {}; two finite numbers are required",
                                     i + 1, p.x, p.y)};
        }
        if (ground.ellipsoid() && std::abs(p.y) > 90.0) {
            return Error{ErrorCode::OutOfRange,
                         fmt::format("position {} has latitude {}, which is outside -90 to 90 "
                                     "degrees; write longitude before latitude",
                                     i + 1, p.y)};
        }
    }
    return Done{};
}

Result<Distance> measureDistance(MeasuredTerrain& terrain,
                                 std::span<const GroundPosition> positions,
                                 JobMonitor& monitor)
{
    if (Status status = checkPositions(terrain.ground(), positions, 2, "a distance"); !status) {
        return std::move(status).error();
    }
    const LegProgress legs(terrain.ground(), positions);
    Distance distance;
    distance.is_approximate = terrain.isApproximate();
    for (std::size_t i = 0; i < legs.lines().size(); ++i) {
        const GroundLine& line = legs.lines()[i];
        const JobPart part(monitor, legs.share(i), legs.share(i + 1));
        SurfaceLength length;
        if (Status status = tracePath(terrain, line, monitor, length); !status) {
            return std::move(status).error();
        }
        distance.legs.push_back(
            {.geodesic_m = line.lengthM(),
             .azimuth_deg = line.azimuthDeg(),
             .surface_m = length.surface_m,
             .void_m = length.void_m,
             .rise_m = terrain.elevation(positions[i + 1]) - terrain.elevation(positions[i])});
        distance.geodesic_m += line.lengthM();
        distance.surface_m += length.surface_m;
        distance.void_m += length.void_m;
    }
    const double begin_m = terrain.elevation(positions.front());
    const double end_m = terrain.elevation(positions.back());
    distance.rise_m = end_m - begin_m;
    distance.straight_m = length(terrain.ground().cartesian(positions.back(), end_m) -
                                 terrain.ground().cartesian(positions.front(), begin_m));
    return distance;
}

Result<Profile> measureProfile(MeasuredTerrain& terrain,
                               std::span<const GroundPosition> positions,
                               std::optional<double> step_m,
                               JobMonitor& monitor)
{
    if (Status status = checkPositions(terrain.ground(), positions, 2, "a profile"); !status) {
        return std::move(status).error();
    }
    const LegProgress legs(terrain.ground(), positions);
    Profile profile;
    profile.is_approximate = terrain.isApproximate();
    profile.vertices_m = legs.ends();
    if (step_m) {
        if (Status status = sampleByStep(terrain, legs, *step_m, monitor, profile); !status) {
            return std::move(status).error();
        }
        return profile;
    }
    ProfileMaker maker(terrain, profile.points);
    for (std::size_t i = 0; i < legs.lines().size(); ++i) {
        const JobPart part(monitor, legs.share(i), legs.share(i + 1));
        maker.begin(legs.lines()[i], legs.ends()[i]);
        if (Status status = tracePath(terrain, legs.lines()[i], monitor, maker); !status) {
            return std::move(status).error();
        }
    }
    return profile;
}

std::size_t profileLevel(const MeasuredTerrain& terrain,
                         std::span<const GroundPosition> positions,
                         double points_min)
{
    const double pieces = estimatedPieces(terrain, positions);
    constexpr double kLevelMax = 30.0;
    return static_cast<std::size_t>(
        std::clamp(std::floor(std::log2(pieces / points_min)), 0.0, kLevelMax));
}

} // namespace marsview
