#include "core/measure/cap_path.h"

#include "core/measure/constants.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace marsview {
namespace {

// A line is cut into parts that are straight in the plane of the circle and equally fast along
// their length, to this share of its radius, but not below the rounding of positions.
constexpr double kStraightShare = 1e-9;
constexpr double kRoundingM = 1e-7;
constexpr int kStraightDepthMax = 16;
// Shorter parts in a triangle are rounding.
constexpr double kSameShare = 1e-9;
constexpr double kFlatCapM = 1e-4; // elevation between the ends of a piece
constexpr int kFlatCapDepthMax = 10;

class CapTracer {
public:
    CapTracer(MeasuredTerrain& terrain,
              const CapTerrain& cap,
              const GroundLine& line,
              PathVisitor& visitor)
        : terrain_(terrain)
        , cap_(cap)
        , line_(line)
        , visitor_(visitor)
        , straight_(std::max(kStraightShare, kRoundingM / cap.radius_m))
    {}

    void run(double begin_m, double end_m)
    {
        cut_m_ = begin_m;
        const CapTerrain::Place begin = terrain_.placeIn(cap_, line_.at(begin_m));
        face_ = cap_.plane.faceAt(begin.column, begin.point);
        constexpr int kParts = 4;
        CapPlane::Point from = begin.point;
        double from_m = begin_m;
        for (int i = 1; i <= kParts; ++i) {
            const double to_m = i == kParts ? end_m : begin_m + (end_m - begin_m) * i / kParts;
            const CapPlane::Point to = pointAt(to_m);
            follow(from_m, to_m, from, to, 0);
            from = to;
            from_m = to_m;
        }
        // The rest, however short.
        flatten(face_, at(face_, cut_m_), at(face_, end_m), 0);
    }

private:
    struct Local {
        double distance_m = 0.0;
        double elevation_m = 0.0;
    };

    CapPlane::Point pointAt(double distance_m) const
    {
        return terrain_.placeIn(cap_, line_.at(distance_m)).point;
    }
    Local at(std::uint32_t face, double distance_m)
    {
        return {distance_m, terrain_.elevation(cap_, face, pointAt(distance_m))};
    }

    // Halved until straight.
    void follow(double begin_m,
                double end_m,
                const CapPlane::Point& begin,
                const CapPlane::Point& end,
                int depth)
    {
        const double middle_m = 0.5 * (begin_m + end_m);
        const CapPlane::Point middle = pointAt(middle_m);
        const auto is_near = [&](const CapPlane::Point& real, double share) {
            const CapPlane::Point off = begin + (end - begin) * share - real;
            return std::hypot(off.x, off.y) <= straight_;
        };
        const auto is_straight_at = [&](double share) {
            return is_near(pointAt(begin_m + share * (end_m - begin_m)), share);
        };
        if (depth < kStraightDepthMax &&
            !(is_near(middle, 0.5) && is_straight_at(0.25) && is_straight_at(0.75))) {
            follow(begin_m, middle_m, begin, middle, depth + 1);
            follow(middle_m, end_m, middle, end, depth + 1);
            return;
        }
        CapPlane::Point from = begin;
        face_ = cap_.plane.walk(face_, begin, end, [&](std::uint32_t face, double share) {
            const CapPlane::Point to = begin + (end - begin) * share;
            visitor_.visitCap(cap_, face, from, to);
            from = to;
            const double distance_m = begin_m + share * (end_m - begin_m);
            if (distance_m - cut_m_ > kSameShare * cap_.radius_m) {
                flatten(face, at(face, cut_m_), at(face, distance_m), 0);
                cut_m_ = distance_m;
            }
        });
        visitor_.visitCap(cap_, face_, from, end);
    }

    // Halved where the line is bent so much that the elevation is not linear along it.
    void flatten(std::uint32_t face, const Local& a, const Local& b, int depth)
    {
        const Local middle = at(face, 0.5 * (a.distance_m + b.distance_m));
        if (depth < kFlatCapDepthMax &&
            std::abs(middle.elevation_m - 0.5 * (a.elevation_m + b.elevation_m)) > kFlatCapM) {
            flatten(face, a, middle, depth + 1);
            flatten(face, middle, b, depth + 1);
            return;
        }
        visitor_.visit({a.distance_m, b.distance_m, std::isfinite(middle.elevation_m), true,
                        a.elevation_m, b.elevation_m});
    }

    MeasuredTerrain& terrain_;
    const CapTerrain& cap_;
    const GroundLine& line_;
    PathVisitor& visitor_;
    double straight_;
    std::uint32_t face_ = 0; // at the end of what was followed
    double cut_m_ = 0.0;     // where the line entered it
};

} // namespace

void traceCap(MeasuredTerrain& terrain,
              const CapTerrain& cap,
              const GroundLine& line,
              double begin_m,
              double end_m,
              PathVisitor& visitor)
{
    CapTracer(terrain, cap, line, visitor).run(begin_m, end_m);
}

} // namespace marsview
