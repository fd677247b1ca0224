#include "core/globe/body_camera.h"
#include "core/globe/body_nodes.h"
#include "core/view/detail_selection.h"
#include "tests/core/contact/body_maps.h"
#include "tests/support/make_terrain.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace marsview {
namespace {

constexpr std::size_t kNode = DetailErrors::kNodeCells;

struct Drawn {
    Heightfield field;
    std::shared_ptr<const SurfaceAnalysis> analysis;
    std::shared_ptr<const BodyGrid> grid;

    explicit Drawn(const test::BodyMap& map)
        : field(terrain(map))
        , analysis(test::analyzed(field))
    {
        JobMonitor monitor;
        grid = BodyGrid::make(test::georeferenceOf(map), monitor).value();
    }

    static Heightfield terrain(const test::BodyMap& map)
    {
        test::Random random(9);
        return test::floatTerrain(
            map.columns, map.rows,
            test::heightsFrom(
                test::fractalHeights(random, map.columns, map.rows, 0.5 * map.relief_m, 0.5),
                map.columns));
    }
    // A sample's position as it is drawn; heights at the poles are not those of samples.
    ScenePoint at(std::size_t column, std::size_t row, double exaggeration) const
    {
        return grid->at(column, row, exaggeration * field.sample(grid->rasterColumn(column), row));
    }
};

std::vector<test::BodyMap> largeMaps()
{
    return {test::wholeMars(360, 180),
            test::wholeMars(321, 150),
            {"Registered", "IAU_2015:49900", 361, 181, {-0.5, 1, 0, 90.5, 0, -1}, 20000.0},
            {"OverThePole",
             "+proj=stere +lat_0=-90 +lon_0=0 +R=1737400 +units=m",
             201,
             210,
             {-155000, 1500, 0, 150000, 0, -1500},
             5000.0},
            {"Sinusoidal",
             "+proj=sinu +lon_0=137 +R=3396190 +units=m",
             300,
             200,
             {-150000, 1000, 0, 1200000, 0, -1000},
             6000.0},
            {"Utm", "EPSG:32611", 150, 130, {390045, 30, 0, 3797505, 0, -30}, 400.0}};
}

TEST(BodyNodes, BoxesHaveEveryVertexOfTheirNodes)
{
    for (const test::BodyMap& map : largeMaps()) {
        const Drawn drawn(map);
        BodyNodes nodes(drawn.analysis, drawn.grid);
        for (const double exaggeration : {1.0, 12.0}) {
            nodes.setExaggeration(exaggeration);
            const DetailErrors& errors = drawn.analysis->errors;
            for (std::size_t level = 0; level < errors.levelCount(); ++level) {
                for (std::size_t i = 0; i < errors.columns(level) * errors.rows(level); ++i) {
                    const DetailNode node{level, i % errors.columns(level),
                                          i / errors.columns(level)};
                    const OrientedBox box = nodes.boxOf(node);
                    const std::size_t side = kNode << level;
                    double worst_m = 0.0;
                    const std::size_t last_row =
                        std::min((node.row + 1) * side, drawn.grid->rows() - 1);
                    const std::size_t last_column =
                        std::min((node.column + 1) * side, drawn.grid->columns() - 1);
                    for (std::size_t row = node.row * side; row <= last_row; ++row) {
                        for (std::size_t c = node.column * side; c <= last_column; ++c) {
                            worst_m =
                                std::max(worst_m, box.distanceFrom(drawn.at(c, row, exaggeration)));
                        }
                    }
                    EXPECT_LT(worst_m, 1e-6) << map.name << " level " << level << " node " << i;
                    EXPECT_LT(box.diagonal_m(),
                              2.5 * nodes.diagonalM(node) +
                                  0.4 * drawn.grid->ellipsoid().equatorial_m *
                                      (static_cast<double>(side) > 30.0 ? 1.0 : 0.0));
                }
            }
        }
    }
}

// What is hidden is found by stepping along the line of sight.
TEST(Horizon, HidesOnlyWhatTheLoweredEllipsoidHides)
{
    test::Random random(41);
    const Ellipsoid mars{3396190.0, 3376200.0};
    constexpr double kLowest = -8000.0;
    const Horizon horizon(mars, kLowest);
    const auto is_inside = [&](const Vec3& p) {
        return placeOf(p, mars).height_m < kLowest; // under all terrain
    };
    int hidden = 0;
    int seen_behind = 0;
    for (int i = 0; i < 4000; ++i) {
        const auto direction = [&] {
            return normalized(Vec3{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                                   random.uniform(-1.0, 1.0)});
        };
        const Vec3 eye = direction() * (3.42e6 + std::pow(10.0, random.uniform(0.0, 7.0)));
        const double half_m = std::pow(10.0, random.uniform(1.0, 5.0));
        const Vec3 up = direction();
        const Vec3 aside = normalized(cross(up, direction()));
        const OrientedBox box{.center = up * (3.39e6 + random.uniform(-1e4, 4e4)),
                              .axes = {aside, cross(up, aside), up},
                              .half_m = {half_m, half_m, 0.3 * half_m}};
        const bool is_hidden = horizon.hides(box, eye);
        hidden += is_hidden ? 1 : 0;
        bool is_all_behind = true;
        for (int j = 0; j < 40; ++j) {
            const Vec3 p = box.center + box.axes[0] * random.uniform(-half_m, half_m) +
                           box.axes[1] * random.uniform(-half_m, half_m) +
                           box.axes[2] * random.uniform(-0.3 * half_m, 0.3 * half_m);
            bool is_behind = false;
            for (int step = 1; step < 200 && !is_behind; ++step) {
                is_behind = is_inside(eye + (p - eye) * (step / 200.0));
            }
            is_all_behind = is_all_behind && is_behind;
            EXPECT_TRUE(is_behind || !is_hidden || is_inside(p)) << "eye " << length(eye);
        }
        seen_behind += is_all_behind && !is_hidden ? 1 : 0;
    }
    EXPECT_GT(hidden, 1000);
    EXPECT_LT(seen_behind, 400); // it is not too careful either
}

struct Shot {
    CameraPose pose;
    DetailSelection selection;
};

Shot shotOf(const Drawn& drawn, const BodyCamera& camera, double exaggeration)
{
    DetailSelector selector(drawn.analysis,
                            std::make_unique<BodyNodes>(drawn.analysis, drawn.grid));
    const CameraPose pose = poseOf(camera, drawn.grid->ellipsoid());
    return {pose,
            selector.select(
                {.camera = {}, .viewport = {1000, 700}, .exaggeration = exaggeration, .pose = pose},
                {.error_px = 1.0})};
}

BodyCamera cameraOver(test::Random& random, const Drawn& drawn)
{
    const auto column =
        static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(drawn.grid->columns())));
    const auto row =
        static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(drawn.grid->rows())));
    const double size_m = drawn.grid->stepMaxM() * static_cast<double>(drawn.grid->columns());
    return {.target = placeOf(drawn.at(column, row, 1.0), drawn.grid->ellipsoid()).foot,
            .height_m = 3e4,
            .distance_m = size_m * std::pow(10.0, random.uniform(-2.0, 0.5)),
            .azimuth = Angle::degrees(random.uniform(0.0, 360.0)),
            .tilt = Angle::degrees(random.uniform(0.0, 80.0))};
}

// Whether the ellipsoid, lowered below all terrain, is in the way: in a space in which it is a
// sphere.
bool isHidden(const Ellipsoid& body, double lowest_m, const Vec3& eye, const Vec3& point)
{
    const double scale = body.equatorial_m / body.polar_m;
    const Vec3 from{eye.x, eye.y, scale * eye.z};
    const Vec3 way = Vec3{point.x, point.y, scale * point.z} - from;
    const double nearest = std::clamp(-dot(from, way) / dot(way, way), 0.0, 1.0);
    return length(from + way * nearest) < body.equatorial_m + scale * lowest_m;
}

// Brute force over all samples.
TEST(BodySelection, EverySampleInThePictureIsDrawn)
{
    test::Random random(42);
    for (const test::BodyMap& map : largeMaps()) {
        const Drawn drawn(map);
        const Ellipsoid& body = drawn.grid->ellipsoid();
        const double lowest_m = 2.0 * std::min(drawn.field.range()->minimum_m, 0.0);
        for (int i = 0; i < 12; ++i) {
            const Shot shot = shotOf(drawn, cameraOver(random, drawn), 2.0);
            std::vector<bool> is_drawn(drawn.field.columns() * drawn.field.rows());
            for (const SelectedNode& selected : shot.selection.nodes) {
                const std::size_t half = kNode / 2 << selected.node.level;
                for (std::size_t q = 0; q < kQuadrantCount; ++q) {
                    if ((selected.quadrants >> q & 1U) == 0) {
                        continue;
                    }
                    const std::size_t left = (2 * selected.node.column + q % 2) * half;
                    const std::size_t top = (2 * selected.node.row + q / 2) * half;
                    for (std::size_t r = top; r <= std::min(top + half, drawn.field.rows() - 1);
                         ++r) {
                        for (std::size_t c = left;
                             c <= std::min(left + half, drawn.field.columns() - 1); ++c) {
                            is_drawn[r * drawn.field.columns() + c] = true;
                        }
                    }
                }
            }
            std::size_t missing = 0;
            for (std::size_t r = 0; r < drawn.field.rows(); ++r) {
                for (std::size_t c = 0; c < drawn.field.columns(); ++c) {
                    const ScenePoint p = drawn.at(c, r, 2.0);
                    const auto pixel = project(shot.pose, {1000, 700}, p);
                    if (drawn.grid->isPole(r) || !pixel || pixel->x < 0.0 || pixel->x > 1000.0 ||
                        pixel->y < 0.0 || pixel->y > 700.0) {
                        continue;
                    }
                    missing += isHidden(body, lowest_m, shot.pose.eye, p) ||
                                       is_drawn[r * drawn.field.columns() + c]
                                   ? 0U
                                   : 1U;
                }
            }
            EXPECT_EQ(missing, 0U) << map.name << " view " << i;
        }
    }
}

// Nodes at the horizon are cut to their quadrants.
TEST(BodySelection, QuadrantsBehindTheHorizonAreNotDrawn)
{
    test::Random random(44);
    const Drawn drawn(test::wholeMars(360, 180));
    BodyNodes nodes(drawn.analysis, drawn.grid);
    nodes.setExaggeration(2.0);
    const double lowest_m = 2.0 * drawn.field.range()->minimum_m;
    const Horizon horizon(drawn.grid->ellipsoid(), lowest_m);
    std::size_t cut = 0;
    for (int i = 0; i < 12; ++i) {
        const Shot shot = shotOf(drawn, cameraOver(random, drawn), 2.0);
        for (const SelectedNode& selected : shot.selection.nodes) {
            cut += selected.quadrants != kAllQuadrants ? 1U : 0U;
            for (std::size_t q = 0; q < kQuadrantCount && selected.node.level > 0; ++q) {
                if ((selected.quadrants >> q & 1U) != 0) {
                    const DetailNode quadrant{selected.node.level - 1,
                                              2 * selected.node.column + q % 2,
                                              2 * selected.node.row + q / 2};
                    EXPECT_FALSE(horizon.hides(nodes.boxOf(quadrant), shot.pose.eye));
                }
            }
        }
    }
    EXPECT_GT(cut, 20U);
}

// Nodes at both ends of a map around the body meet: same ranges where they do.
TEST(BodySelection, RangesAreTheSameAtBothEndsOfAMapAroundTheBody)
{
    test::Random random(43);
    const Drawn drawn(test::wholeMars(360, 180));
    std::size_t compared = 0;
    for (int i = 0; i < 120; ++i) {
        BodyCamera camera = cameraOver(random, drawn);
        camera.target.longitude = Angle::degrees(random.uniform(-3.0, 3.0));
        const Shot shot = shotOf(drawn, camera, 3.0);
        // By level and row of the corner.
        std::map<std::pair<std::size_t, std::size_t>, float> first;
        std::map<std::pair<std::size_t, std::size_t>, float> last;
        for (const SelectedNode& selected : shot.selection.nodes) {
            const std::size_t level = selected.node.level + 1;
            if (level >= drawn.analysis->errors.levelCount()) {
                continue;
            }
            const std::size_t column = selected.node.column / 2;
            const std::size_t row = selected.node.row / 2;
            if (column == 0) {
                first[{level, row}] = selected.parent_ranges_m[0];
                first[{level, row + 1}] = selected.parent_ranges_m[2];
            }
            if (column + 1 == drawn.analysis->errors.columns(level)) {
                last[{level, row}] = selected.parent_ranges_m[1];
                last[{level, row + 1}] = selected.parent_ranges_m[3];
            }
        }
        for (const auto& [place, range] : first) {
            const auto other = last.find(place);
            if (other != last.end()) {
                EXPECT_EQ(range, other->second);
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 200U);
}

} // namespace
} // namespace marsview
