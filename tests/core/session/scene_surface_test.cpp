// Against brute force: every triangle of every map, placed with the geotransforms directly.
#include "core/session/scene_surface.h"
#include "tests/support/map_maker.h"
#include "tests/support/nan.h"
#include "tests/support/random.h"
#include "tests/support/reference_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

namespace marsview {
namespace {

using test::MapMaker;

// From one raster's grid to another's, through map coordinates, in long double.
struct Affine {
    long double c0 = 0.0L;
    long double cc = 1.0L;
    long double cr = 0.0L;
    long double r0 = 0.0L;
    long double rc = 0.0L;
    long double rr = 1.0L;

    GridPoint operator()(GridPoint g) const
    {
        return {static_cast<double>(c0 + cc * g.column + cr * g.row),
                static_cast<double>(r0 + rc * g.column + rr * g.row)};
    }
};

using Terms = std::array<double, 6>;

// `x_shift` is added to the map coordinates of `from`.
Affine between(const Terms& from, const Terms& to, double x_shift)
{
    const long double det =
        static_cast<long double>(to[1]) * to[5] - static_cast<long double>(to[2]) * to[4];
    const auto at = [&](long double column, long double row) {
        const long double x =
            from[0] + x_shift + (column + 0.5L) * from[1] + (row + 0.5L) * from[2] - to[0];
        const long double y = from[3] + (column + 0.5L) * from[4] + (row + 0.5L) * from[5] - to[3];
        return std::array{(x * to[5] - y * to[2]) / det - 0.5L,
                          (y * to[1] - x * to[4]) / det - 0.5L};
    };
    const auto o = at(0.0L, 0.0L);
    const auto c = at(1.0L, 0.0L);
    const auto r = at(0.0L, 1.0L);
    return {o[0], c[0] - o[0], r[0] - o[0], o[1], c[1] - o[1], r[1] - o[1]};
}

// The maps as lists of triangles in the scene.
class BruteScene {
public:
    struct Part {
        Heightfield heightfield;
        Affine from_scene_grid;
        Affine to_scene_grid;
    };

    // `x_shifts` moves each map's coordinates to the turn of the first.
    BruteScene(const std::vector<std::shared_ptr<const Map>>& maps,
               const std::vector<double>& x_shifts)
        : frame_(maps.front()->georeference().sceneFrame())
    {
        const Terms& scene = maps.front()->georeference().transform().terms();
        for (std::size_t i = 0; i < maps.size(); ++i) {
            const Terms& terms = maps[i]->georeference().transform().terms();
            const Affine to = between(terms, scene, x_shifts[i]);
            Terms shifted = terms;
            shifted[0] += x_shifts[i];
            parts_.push_back({maps[i]->heightfield(), between(scene, shifted, 0.0), to});
        }
    }

    std::size_t size() const { return parts_.size(); }

    ScenePoint scene(std::size_t index, GridPoint grid, double z) const
    {
        return frame_.toScene(parts_[index].to_scene_grid(grid), z);
    }

    double heightOf(std::size_t index, double east_m, double north_m) const
    {
        const Part& part = parts_[index];
        const GridPoint g = part.from_scene_grid(frame_.toGrid({east_m, north_m, 0.0}));
        const double last_column = static_cast<double>(part.heightfield.columns() - 1);
        const double last_row = static_cast<double>(part.heightfield.rows() - 1);
        if (!(g.column >= 0.0 && g.column <= last_column && g.row >= 0.0 && g.row <= last_row)) {
            return kNan;
        }
        const auto c = static_cast<std::size_t>(std::min(std::floor(g.column), last_column - 1.0));
        const auto r = static_cast<std::size_t>(std::min(std::floor(g.row), last_row - 1.0));
        const auto sample = [&](std::size_t column, std::size_t row) {
            return static_cast<long double>(part.heightfield.sample(column, row));
        };
        return static_cast<double>(test::planeHeight(
            {sample(c, r), sample(c + 1, r), sample(c, r + 1), sample(c + 1, r + 1)},
            static_cast<long double>(g.column) - static_cast<long double>(c),
            static_cast<long double>(g.row) - static_cast<long double>(r)));
    }

    struct Height {
        double height_m;
        std::size_t index;
    };
    Height height(double east_m, double north_m) const
    {
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            const double height_m = heightOf(i, east_m, north_m);
            if (!std::isnan(height_m)) {
                return {height_m, i};
            }
        }
        return {kNan, parts_.size()};
    }
    // Whether the same map is on top within `slack_m` on all sides, so that rounding cannot change
    // the result.
    bool isClear(double east_m, double north_m, double slack_m) const
    {
        const std::size_t index = height(east_m, north_m).index;
        for (const double dx : {-slack_m, slack_m}) {
            for (const double dy : {-slack_m, slack_m}) {
                if (height(east_m + dx, north_m + dy).index != index) {
                    return false;
                }
            }
        }
        return true;
    }

    struct Hit {
        std::size_t index;
        double distance_m;
    };
    // Every triangle that the ray crosses, in order along the ray (Möller and Trumbore 1997).
    std::vector<Hit> crossings(const Ray& ray, double exaggeration) const
    {
        std::vector<Hit> hits;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            const Heightfield& h = parts_[i].heightfield;
            const auto corner = [&](std::size_t c, std::size_t r) {
                return scene(i, {static_cast<double>(c), static_cast<double>(r)},
                             h.sample(c, r) * exaggeration);
            };
            for (std::size_t r = 0; r + 1 < h.rows(); ++r) {
                for (std::size_t c = 0; c + 1 < h.columns(); ++c) {
                    for (const bool is_upper : {true, false}) {
                        const ScenePoint a = corner(c, r);
                        const Vec3 u = corner(c + 1, r + 1) - a;
                        const Vec3 v = corner(is_upper ? c + 1 : c, is_upper ? r : r + 1) - a;
                        const Vec3 p = cross(ray.direction, v);
                        const double det = dot(u, p);
                        const Vec3 s = ray.origin - a;
                        const double x = dot(s, p) / det;
                        const Vec3 q = cross(s, u);
                        const double y = dot(ray.direction, q) / det;
                        const double t = dot(v, q) / det;
                        // NaN, from voids and from rays within a triangle's plane, fails this test.
                        if (x >= -1e-12 && y >= -1e-12 && x + y <= 1.0 + 1e-12 && t >= 0.0) {
                            hits.push_back({i, t});
                        }
                    }
                }
            }
        }
        std::sort(hits.begin(), hits.end(),
                  [](const Hit& a, const Hit& b) { return a.distance_m < b.distance_m; });
        return hits;
    }

private:
    SceneFrame frame_;
    std::vector<Part> parts_;
};

struct Scene {
    const char* name;
    std::vector<std::shared_ptr<const Map>> maps;
    std::vector<double> x_shifts;
};

double wave(std::size_t c, std::size_t r, double amplitude)
{
    return amplitude * std::sin(static_cast<double>(c) * 0.9) *
               std::cos(static_cast<double>(r) * 0.7) +
           amplitude * 0.3 * static_cast<double>((c * 7 + r * 13) % 5);
}

bool isHole(std::size_t c, std::size_t r, double column, double row, double radius)
{
    return std::hypot(static_cast<double>(c) - column, static_cast<double>(r) - row) < radius;
}

MapMaker::Height waves(double base, double amplitude)
{
    return [=](std::size_t c, std::size_t r) { return base + wave(c, r, amplitude); };
}

MapMaker::Height holed(double base, double amplitude)
{
    return [=](std::size_t c, std::size_t r) {
        return isHole(c, r, 8.0, 7.0, 4.0) || (c == 15 && r == 3) ? kNan
                                                                  : base + wave(c, r, amplitude);
    };
}

std::vector<Scene> scenes()
{
    static const char* const kMars =
        "GEOGCS[\"Mars 2000\",DATUM[\"D_Mars_2000\",SPHEROID[\"Mars_2000\",3396190,"
        "169.89444722361179]],PRIMEM[\"Reference_Meridian\",0],UNIT[\"degree\","
        "0.0174532925199433]]";
    static MapMaker maker;
    std::vector<Scene> scenes;
    const std::shared_ptr<const Map> one = maker.make({}, holed(100.0, 60.0));
    scenes.push_back({"one map", {one}, {0.0}});
    const std::shared_ptr<const Map> lower = maker.make(
        {.columns = 25, .rows = 22, .transform = {499820.0, 41.0, 0.0, 4000160.0, 0.0, -37.0}},
        waves(-50.0, 150.0));
    scenes.push_back({"two maps that cross", {one, lower}, {0.0, 0.0}});
    const std::shared_ptr<const Map> turned = maker.make(
        {.columns = 24, .rows = 20, .transform = {500050.0, 17.0, 9.0, 3999990.0, 10.0, -18.0}},
        holed(300.0, 40.0));
    scenes.push_back({"three, one turned", {one, turned, lower}, {0.0, 0.0, 0.0}});
    scenes.push_back({"turned on top", {turned, one, lower}, {0.0, 0.0, 0.0}});
    const std::shared_ptr<const Map> mirrored = maker.make(
        {.columns = 20, .rows = 20, .transform = {500600.0, -28.0, 0.0, 3999500.0, 3.0, 26.0}},
        holed(0.0, 90.0));
    scenes.push_back({"mirrored on top", {mirrored, turned, lower}, {0.0, 0.0, 0.0}});
    const char* const kUtm = "EPSG:32611";
    scenes.push_back({"projected",
                      {maker.make({.srs = kUtm}, holed(100.0, 60.0)),
                       maker.make({.columns = 30,
                                   .rows = 30,
                                   .transform = {499900.0, 33.0, 0.0, 4000100.0, 0.0, -33.0},
                                   .srs = kUtm},
                                  waves(0.0, 100.0))},
                      {0.0, 0.0}});
    const std::shared_ptr<const Map> east = maker.make(
        {.transform = {200.0, 0.5, 0.0, 20.0, 0.0, -0.5}, .srs = kMars}, holed(2000.0, 3000.0));
    const std::shared_ptr<const Map> west =
        maker.make({.columns = 30,
                    .rows = 24,
                    .transform = {-162.0, 0.47, 0.0, 22.0, 0.0, -0.45},
                    .srs = kMars},
                   waves(0.0, 5000.0));
    const std::shared_ptr<const Map> holed_west =
        maker.make({.columns = 30,
                    .rows = 24,
                    .transform = {-162.0, 0.47, 0.0, 22.0, 0.0, -0.45},
                    .srs = kMars},
                   holed(0.0, 5000.0));
    scenes.push_back({"longitudes a turn apart", {east, west}, {0.0, 360.0}});
    scenes.push_back({"and the other way", {holed_west, east}, {0.0, -360.0}});
    // All of Mars from 0 to 360 degrees below a map that counts from -180 to 180.
    const std::shared_ptr<const Map> all = maker.make(
        {.columns = 72, .rows = 36, .transform = {0.0, 5.0, 0.0, 90.0, 0.0, -5.0}, .srs = kMars},
        [](std::size_t c, std::size_t r) {
            return isHole(c, r, 40.5, 14.5, 2.5) ? kNan : wave(c, r, 4000.0) - 1000.0;
        });
    scenes.push_back({"all of Mars on top", {all, west}, {0.0, 360.0}});
    return scenes;
}

double cellMeters(const Scene& scene)
{
    return SceneSurface(scene.maps).pixelMeters();
}

class SceneSurfaceTest : public testing::Test {
protected:
    // Anywhere in the box, slightly more often on the grid of the first map.
    ScenePoint somewhere(const SceneSurface& surface)
    {
        const SceneBox box = surface.box(1.0);
        const ScenePoint p{random_.uniform(box.minimum.x, box.maximum.x),
                           random_.uniform(box.minimum.y, box.maximum.y), 0.0};
        if (random_.chance(0.2)) {
            const SceneFrame& frame = surface.maps().front().frame;
            const GridPoint g = frame.toGrid(p);
            return frame.toScene({std::round(g.column), std::round(2.0 * g.row) / 2.0}, 0.0);
        }
        return p;
    }

    test::Random random_;
};

TEST_F(SceneSurfaceTest, HeightIsThatOfTheUppermostMap)
{
    for (const Scene& scene : scenes()) {
        const SceneSurface surface(scene.maps);
        const BruteScene brute(scene.maps, scene.x_shifts);
        std::array<int, 4> found{};
        int unclear = 0;
        for (int i = 0; i < 5000; ++i) {
            const ScenePoint p = somewhere(surface);
            if (!brute.isClear(p.x, p.y, 1e-5 * cellMeters(scene))) {
                ++unclear;
                continue;
            }
            const auto expected = brute.height(p.x, p.y);
            const double height_m = surface.height(p.x, p.y);
            ++found[expected.index];
            ASSERT_EQ(std::isnan(height_m), std::isnan(expected.height_m)) << scene.name;
            ASSERT_EQ(surface.mapAt(p.x, p.y).value_or(brute.size()), expected.index) << scene.name;
            if (!std::isnan(height_m)) {
                ASSERT_NEAR(height_m, expected.height_m, 1e-6 * 5000.0) << scene.name;
            }
        }
        std::printf("%-24s %5d %5d %5d %5d, unclear %d\n", scene.name, found[0], found[1], found[2],
                    found[3], unclear);
        EXPECT_LT(unclear, 600) << scene.name;
        for (std::size_t i = 0; i < scene.maps.size(); ++i) {
            EXPECT_GT(found[i], 5) << scene.name << ": map " << i;
        }
    }
}

TEST_F(SceneSurfaceTest, OutermostSamplesAreTerrain)
{
    for (const Scene& scene : scenes()) {
        const SceneSurface surface(scene.maps);
        for (std::size_t i = 0; i < scene.maps.size(); ++i) {
            const SceneMap& map = surface.maps()[i];
            const Heightfield& h = map.map->heightfield();
            for (std::size_t r = 0; r < h.rows(); ++r) {
                for (const std::size_t c : {std::size_t{0}, h.columns() - 1}) {
                    const ScenePoint p =
                        map.frame.toScene({static_cast<double>(c), static_cast<double>(r)}, 0.0);
                    if (!std::isnan(h.sample(c, r))) {
                        EXPECT_TRUE(surface.mapAt(p.x, p.y)) << scene.name;
                        EXPECT_TRUE(std::isfinite(surface.height(p.x, p.y))) << scene.name;
                    }
                }
            }
        }
    }
}

TEST_F(SceneSurfaceTest, CastFindsTheFirstUncoveredSurface)
{
    int after_covered_in_all = 0;
    for (const Scene& scene : scenes()) {
        const SceneSurface surface(scene.maps);
        const BruteScene brute(scene.maps, scene.x_shifts);
        const double cell_m = cellMeters(scene);
        int hits = 0;
        int misses = 0;
        int after_covered = 0;
        int unclear = 0;
        for (int i = 0; i < 1200; ++i) {
            const double exaggeration = std::exp(random_.uniform(-2.0, 3.0));
            const SceneBox box = surface.box(exaggeration);
            // From near and far, above, below and between the maps.
            ScenePoint to = somewhere(surface);
            to.z = random_.uniform(box.minimum.z, box.maximum.z);
            Vec3 way{random_.uniform(-1.0, 1.0), random_.uniform(-1.0, 1.0),
                     random_.uniform(-1.0, 0.3)};
            way = random_.chance(0.05) ? Vec3{0.0, 0.0, -1.0} : normalized(way);
            const double back_m = box.diagonal_m() * std::exp(random_.uniform(-7.0, 2.0));
            const Ray ray{.origin = to - way * back_m, .direction = way};
            std::optional<BruteScene::Hit> expected;
            bool is_clear = true;
            bool has_covered = false;
            for (const BruteScene::Hit& hit : brute.crossings(ray, exaggeration)) {
                const ScenePoint p = ray.at(hit.distance_m);
                is_clear = is_clear && hit.distance_m > 1e-6 * cell_m;
                if (brute.height(p.x, p.y).index == hit.index) {
                    is_clear = is_clear && brute.isClear(p.x, p.y, 1e-5 * cell_m);
                    expected = hit;
                    break;
                }
                is_clear = is_clear && brute.isClear(p.x, p.y, 1e-5 * cell_m);
                has_covered = true;
            }
            if (!is_clear) {
                ++unclear;
                continue;
            }
            const auto found = surface.cast(ray, exaggeration);
            ASSERT_EQ(found.has_value(), expected.has_value()) << scene.name << ", ray " << i;
            (found ? hits : misses) += 1;
            if (!found) {
                continue;
            }
            after_covered += has_covered ? 1 : 0;
            ASSERT_EQ(found->index, expected->index) << scene.name << ", ray " << i;
            ASSERT_NEAR(found->distance_m, expected->distance_m,
                        1e-7 * (cell_m + expected->distance_m))
                << scene.name << ", ray " << i;
            const ScenePoint p = ray.at(found->distance_m);
            const ScenePoint q = brute.scene(found->index, found->grid, p.z);
            ASSERT_LT(length(p - q), 1e-6 * (cell_m + back_m)) << scene.name;
            ASSERT_NEAR(found->height_m, brute.height(q.x, q.y).height_m, 0.01) << scene.name;
        }
        std::printf("%-24s hits %d, past covered %d, misses %d, unclear %d\n", scene.name, hits,
                    after_covered, misses, unclear);
        EXPECT_GT(hits, 300) << scene.name;
        EXPECT_LT(unclear, 120) << scene.name;
        after_covered_in_all += after_covered;
    }
    EXPECT_GT(after_covered_in_all, 500);
}

// A lower map that rises above the upper one and is crossed many times before the upper map ends.
TEST_F(SceneSurfaceTest, CastPassesAnyNumberOfCoveredSurfaces)
{
    MapMaker maker;
    const std::shared_ptr<const Map> plate =
        maker.make({.columns = 300, .rows = 3, .transform = {0.0, 1.0, 0.0, 3.0, 0.0, -1.0}},
                   [](std::size_t, std::size_t) { return 0.0; });
    const std::shared_ptr<const Map> comb =
        maker.make({.columns = 400, .rows = 3, .transform = {0.0, 1.0, 0.0, 3.0, 0.0, -1.0}},
                   [](std::size_t c, std::size_t) { return c % 2 == 0 ? 90.0 : 110.0; });
    const SceneSurface surface({plate, comb});
    const ScenePoint from = surface.maps().front().frame.toScene({0.3, 1.0}, 100.0);
    const auto hit = surface.cast({.origin = from, .direction = {1.0, 0.0, 0.0}}, 1.0);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->index, 1U);
    EXPECT_NEAR(hit->grid.column, 299.5, 1e-6);
}

TEST_F(SceneSurfaceTest, CastPassesCoveredSurfacesRightInFrontOfTheEye)
{
    MapMaker maker;
    const std::shared_ptr<const Map> plate =
        maker.make({}, [](std::size_t, std::size_t) { return -500.0; });
    const std::shared_ptr<const Map> comb =
        maker.make({}, [](std::size_t c, std::size_t) { return c % 2 == 0 ? -9.0 : 9.0; });
    const SceneSurface surface({plate, comb});
    for (int i = 0; i < 3000; ++i) {
        ScenePoint at = somewhere(surface);
        at.z = comb->heightfield().height(surface.maps()[1].frame.toGrid(at));
        const Vec3 way = normalized(Vec3{random_.uniform(-1.0, 1.0), random_.uniform(-1.0, 1.0),
                                         random_.uniform(-0.5, -0.01)});
        const Ray ray{.origin = at - way * std::exp(random_.uniform(-12.0, 4.0)), .direction = way};
        const double t = (-500.0 - ray.origin.z) / way.z;
        const ScenePoint end = ray.at(t);
        const auto hit = surface.cast(ray, 1.0);
        const auto ends_on = surface.mapAt(end.x, end.y);
        if (ends_on) {
            ASSERT_TRUE(hit);
            ASSERT_EQ(hit->index, 0U);
            ASSERT_NEAR(hit->distance_m, t, 1e-6 * t);
        }
    }
}

TEST_F(SceneSurfaceTest, BoxIsTightAroundAllSamples)
{
    for (const Scene& scene : scenes()) {
        const SceneSurface surface(scene.maps);
        const BruteScene brute(scene.maps, scene.x_shifts);
        const double exaggeration = 3.0;
        ScenePoint low{HUGE_VAL, HUGE_VAL, HUGE_VAL};
        ScenePoint high = -low;
        std::vector<ScenePoint> terrain;
        for (std::size_t i = 0; i < scene.maps.size(); ++i) {
            const Heightfield& h = scene.maps[i]->heightfield();
            for (std::size_t r = 0; r < h.rows(); ++r) {
                for (std::size_t c = 0; c < h.columns(); ++c) {
                    // Voids affect only the horizontal extent, not the range of heights.
                    const double z = h.sample(c, r) * exaggeration;
                    const ScenePoint p =
                        brute.scene(i, {static_cast<double>(c), static_cast<double>(r)}, z);
                    if (!std::isnan(z)) {
                        terrain.push_back(p);
                    }
                    low = {std::min(low.x, p.x), std::min(low.y, p.y),
                           std::isnan(z) ? low.z : std::min(low.z, z)};
                    high = {std::max(high.x, p.x), std::max(high.y, p.y),
                            std::isnan(z) ? high.z : std::max(high.z, z)};
                }
            }
        }
        const SceneBox box = surface.box(exaggeration);
        const double slack = 1e-6 * cellMeters(scene);
        EXPECT_LT(length(box.minimum - low), slack) << scene.name;
        EXPECT_LT(length(box.maximum - high), slack) << scene.name;
        const std::vector<SceneBox> parts = surface.partBoxes(exaggeration);
        const auto is_in_part = [&](const ScenePoint& p) {
            return std::any_of(parts.begin(), parts.end(), [&](const SceneBox& part) {
                const ScenePoint above = part.maximum - p;
                const ScenePoint below = p - part.minimum;
                return std::min({above.x, above.y, above.z, below.x, below.y, below.z}) > -slack;
            });
        };
        EXPECT_TRUE(std::all_of(terrain.begin(), terrain.end(), is_in_part)) << scene.name;
    }
}

TEST_F(SceneSurfaceTest, IsEmptyWithoutMaps)
{
    const SceneSurface none;
    EXPECT_TRUE(none.isEmpty());
    EXPECT_TRUE(SceneSurface(std::vector<std::shared_ptr<const Map>>{}).isEmpty());
    EXPECT_TRUE(std::isnan(none.height(0.0, 0.0)));
    EXPECT_FALSE(none.mapAt(0.0, 0.0));
    EXPECT_FALSE(none.cast({.origin = {0.0, 0.0, 1.0}, .direction = {0.0, 0.0, -1.0}}, 1.0));
    EXPECT_EQ(none.box(1.0).diagonal_m(), 0.0);
}

// Every corner of every map, far from its center, is where the geotransforms place it.
TEST(FrameWithin, PlacesAWholeMapWithinAMillionthOfASample)
{
    test::Random random;
    for (int i = 0; i < 2000; ++i) {
        const auto placed = [&random](std::size_t columns, std::size_t rows) {
            const double cell = std::exp(random.uniform(-3.0, 6.0));
            const double turn = random.chance(0.5) ? 0.0 : random.uniform(-3.0, 3.0);
            return Georeference(
                columns, rows,
                GeoTransform::fromTerms({random.uniform(-1e6, 1e6), cell * std::cos(turn),
                                         cell * std::sin(turn), random.uniform(-1e6, 1e6),
                                         cell * std::sin(turn), -cell * std::cos(turn)})
                    .value(),
                std::nullopt);
        };
        const Georeference scene = placed(1000, 700);
        const Georeference map = placed(2 + random.below(40000), 2 + random.below(40000));
        const SceneFrame frame = frameWithin(scene, map);
        const Affine to_scene = between(map.transform().terms(), scene.transform().terms(), 0.0);
        const double last_column = static_cast<double>(map.columns() - 1);
        const double last_row = static_cast<double>(map.rows() - 1);
        for (const GridPoint grid : {GridPoint{0.0, 0.0}, GridPoint{last_column, 0.0},
                                     GridPoint{0.0, last_row}, GridPoint{last_column, last_row}}) {
            const ScenePoint expected = scene.sceneFrame().toScene(to_scene(grid), 0.0);
            const GridPoint back = frame.toGrid(expected);
            ASSERT_NEAR(back.column, grid.column, 1e-6) << "pair " << i;
            ASSERT_NEAR(back.row, grid.row, 1e-6) << "pair " << i;
        }
    }
}

TEST(FrameWithin, IsTheSceneFrameForTheSceneItself)
{
    MapMaker maker;
    const std::shared_ptr<const Map> map = maker.make({.srs = "EPSG:32611"}, waves(0.0, 10.0));
    const Georeference& georeference = map->georeference();
    const SceneFrame frame = frameWithin(georeference, georeference);
    EXPECT_NEAR(frame.origin.column, georeference.sceneFrame().origin.column, 1e-9);
    EXPECT_NEAR(frame.origin.row, georeference.sceneFrame().origin.row, 1e-9);
    EXPECT_NEAR(frame.east_per_column, georeference.sceneFrame().east_per_column, 1e-9);
    EXPECT_NEAR(frame.north_per_row, georeference.sceneFrame().north_per_row, 1e-9);
}

} // namespace
} // namespace marsview
