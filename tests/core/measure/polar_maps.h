// Maps that close at a pole, and the triangles there.
#pragma once

#include "core/body/body_mesh.h"
#include "tests/support/map_maker.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace marsview::test {

struct PolarMap {
    std::string name;
    MapMaker::Place place;
    double pole_deg;         // 90 or -90
    double row_distance_deg; // of the outermost row from it
    friend std::ostream& operator<<(std::ostream& out, const PolarMap& map)
    {
        return out << map.name;
    }
};

inline const std::vector<PolarMap> kPolarMaps{
    {"North", {1440, 6, {0, 0.25, 0, 90, 0, -0.25}, "IAU_2015:49900"}, 90.0, 0.125},
    {"South", {720, 5, {-180, 0.5, 0, -87.5, 0, -0.5}, "IAU_2015:30100"}, -90.0, 0.25},
    {"OddColumns", {45, 22, {0, 8, 0, 90, 0, -8}, "IAU_2015:49900"}, 90.0, 4.0},
    {"Westward", {360, 180, {360, -1, 0, 90, 0, -1}, "IAU_2015:49900"}, 90.0, 0.5},
    {"Northward", {360, 20, {0, 1, 0, -90, 0, 1}, "IAU_2015:49900"}, -90.0, 0.5},
    {"RepeatsAColumn", {361, 10, {-0.5, 1, 0, 90, 0, -1}, "IAU_2015:49900"}, 90.0, 0.5},
    {"AWholeCellAway", {360, 10, {0, 1, 0, 89.5, 0, -1}, "IAU_2015:49900"}, 90.0, 1.0},
    {"Projected",
     {720,
      12,
      {-5458203.0762, 15161.6752, 0, 2729101.5381, 0, -15161.6752},
      "+proj=eqc +R=1737400 +units=m"},
     90.0,
     0.25},
};

/// Random elevations from 0 to `relief_m`.
inline std::shared_ptr<const Map> rough(MapMaker& maker, const PolarMap& map, double relief_m)
{
    Random random(11);
    std::vector<double> heights;
    for (std::size_t i = 0; i < map.place.columns * map.place.rows; ++i) {
        heights.push_back(random.uniform(0.0, relief_m));
    }
    const std::size_t columns = map.place.columns;
    return maker.make(map.place, [&](std::size_t c, std::size_t r) {
        const bool is_repeated = map.name == "RepeatsAColumn" && c + 1 == columns;
        return heights[r * columns + (is_repeated ? 0 : c)];
    });
}

/// The triangles of a pole one by one in space, as the globe has them.
class ListedCap {
public:
    ListedCap(const Map& map, double pole_deg)
    {
        JobMonitor monitor;
        const auto mesh = BodyMesh::build(map.filled(), map.georeference(), 1.0, monitor);
        EXPECT_TRUE(mesh) << (mesh ? "" : mesh.error().message);
        const BodyIndex cells = BodyIndex{2} * (*mesh)->cellColumns() * (*mesh)->cellRows();
        for (BodyIndex face = cells; face < (*mesh)->faceCount(); ++face) {
            const auto points = (*mesh)->points(face);
            if ((points[0].z > 0.0) == (pole_deg > 0.0)) {
                faces_.push_back(points);
            }
        }
    }

    /// How far above a point, along a line, a triangle lies; NaN without one.
    double heightAbove(const Vec3& foot, const Vec3& up) const
    {
        for (const auto& [a, b, c] : faces_) {
            const Big along = big(up);
            const Big ab = big(b - a);
            const Big ac = big(c - a);
            const Big to = big(a - foot);
            const Big normal = cross(ab, ac);
            const long double height = dot(to, normal) / dot(along, normal);
            Big at;
            for (std::size_t i = 0; i < 3; ++i) {
                at[i] = along[i] * height - to[i];
            }
            const long double square = dot(normal, normal);
            const long double second = dot(cross(at, ac), normal) / square;
            const long double third = dot(cross(ab, at), normal) / square;
            constexpr long double kRounding = 1e-9L;
            if (second >= -kRounding && third >= -kRounding && second + third <= 1 + kRounding) {
                return static_cast<double>(height);
            }
        }
        return std::numeric_limits<double>::quiet_NaN();
    }

private:
    using Big = std::array<long double, 3>;
    static Big big(const Vec3& v) { return {v.x, v.y, v.z}; }
    static Big cross(const Big& a, const Big& b)
    {
        return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    }
    static long double dot(const Big& a, const Big& b)
    {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }

    std::vector<std::array<ScenePoint, 3>> faces_;
};

/// A map with 2 m of relief, and how far its triangles at the pole lie above those without relief.
class CapRelief {
public:
    CapRelief(MapMaker& maker, const PolarMap& tested)
        : map_(rough(maker, tested, kReliefM))
        , cap_(*map_, tested.pole_deg)
        , base_(*maker.make(tested.place, [](std::size_t, std::size_t) { return 0.0; }),
                tested.pole_deg)
        , row_distance_(tested.row_distance_deg / 57.29578)
    {}

    const std::shared_ptr<const Map>& map() const { return map_; }
    /// NaN without a triangle.
    double above(const Vec3& foot, const Vec3& up) const
    {
        return cap_.heightAbove(foot, up) - base_.heightAbove(foot, up);
    }
    /// Of effects of second order.
    double toleranceM() const
    {
        return kReliefM * (2.0 * row_distance_ * row_distance_ + 1e-5) + 1e-4;
    }

private:
    static constexpr double kReliefM = 2.0;

    std::shared_ptr<const Map> map_;
    ListedCap cap_;
    ListedCap base_;
    double row_distance_; // of the outermost row from the pole, radians
};

} // namespace marsview::test
