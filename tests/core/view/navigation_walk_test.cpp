// More than a million random inputs, combined from the pure functions as the view does it.

#include "core/raster/raster_file.h"
#include "core/session/map.h"
#include "core/terrain/ray_cast.h"
#include "core/view/exaggeration.h"
#include "core/view/navigation.h"
#include "tests/support/random.h"
#include "tests/support/shared_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace marsview {
namespace {

constexpr std::size_t kColumns = 97;
constexpr std::size_t kRows = 65;
constexpr double kCell = 30.0;
constexpr int kInputs = 175000; // per terrain; about six cameras each

using Height = std::function<double(double column, double row)>; // NaN for void

class Walk {
public:
    explicit Walk(const Height& height)
        : Walk(heightfieldOf(height),
               {.origin = {(kColumns - 1) / 2.0, (kRows - 1) / 2.0},
                .east_per_column = kCell,
                .north_per_row = -kCell},
               kCell)
    {}
    Walk(Heightfield heightfield, const SceneFrame& frame, double pixel_m)
        : heightfield_(std::move(heightfield))
        , frame_(frame)
        , pixel_m_(pixel_m)
    {
        JobMonitor monitor;
        pyramid_ =
            std::make_unique<MinMaxPyramid>(MinMaxPyramid::build(heightfield_, monitor).value());
        camera_ = bounded(homeCamera(box(), viewport_));
    }

    int stretchesInPlace() const { return stretches_in_place_; }
    int homes() const { return homes_; }

    void doSomething()
    {
        switch (random_.below(11)) {
        case 0:
            moveTo(orbited(onGround(), angle(180.0), angle(20.0)));
            break;
        case 1: // rotated with the mouse
            camera_ = onGround();
            for (int i = 0; i < 5; ++i) {
                camera_ = bounded(orbited(camera_, angle(6.0), angle(6.0)));
            }
            break;
        case 2: {
            const Drag drag{
                .from = pixel(), .to = pixel(), .grabbed_z_m = anchorAt(pixel(), camera_).z};
            camera_ = bounded(dragged(camera_, viewport_, drag));
            break;
        }
        case 3:
            moveTo(panned(onGround(), random_.uniform(-0.5, 0.5), random_.uniform(-0.5, 0.5)));
            break;
        case 4:
        case 5:
            zoom(random_.uniform(0.4, 2.0), pixel());
            break;
        case 6:
            moveTo(orbited(onGround(), {}, Angle::degrees(45.0)));
            break;
        case 7:
            stretch();
            break;
        case 8:
            if (const auto hit = cast(pickRay(camera_, viewport_, pixel()))) {
                OrbitCamera goal = onGround();
                goal.target = pointOf(*hit);
                goal.distance_m *= 0.3;
                moveTo(goal);
            }
            break;
        case 9: // a window of any aspect ratio, from twice as high as wide
            viewport_.height = 100 + static_cast<int>(random_.below(900));
            viewport_.width = viewport_.height / 2 + static_cast<int>(random_.below(2500));
            break;
        case 10:
            if (random_.chance(0.05)) {
                goHome();
            }
            break;
        }
    }

    // Limited so that the map does not become a needle. The terrain in the middle of the view stays
    // there unless the eye would be too low.
    void stretch()
    {
        const double before = exaggeration_;
        const OrbitCamera goal = onGround();
        const double ground_m = groundAt(goal.target.x, goal.target.y) / before;
        exaggeration_ =
            std::clamp(steppedExaggeration(before, random_.chance(0.5) ? 1 : -1), 0.1, 100.0);
        const OrbitCamera wanted = reexaggerated(goal, before, exaggeration_);
        camera_ = bounded(wanted);
        if (!std::isfinite(ground_m) || length(camera_.target - wanted.target) > 0.0 ||
            camera_.tilt != wanted.tilt ||
            std::abs(goal.target.z - ground_m * before) > 1e-6 * goal.distance_m) {
            return;
        }
        ++stretches_in_place_;
        const ScenePoint ground{goal.target.x, goal.target.y, ground_m * before};
        const auto was = project(goal, viewport_, ground);
        const auto is = project(camera_, viewport_, {ground.x, ground.y, ground_m * exaggeration_});
        ASSERT_TRUE(was && is);
        ASSERT_NEAR(is->x, was->x, 0.5);
        ASSERT_NEAR(is->y, was->y, 0.5);
    }

    void goHome()
    {
        camera_ = bounded(homeCamera(box(), viewport_));
        const double height_m = box().maximum.z - box().minimum.z;
        if (height_m > 5.0 * box().extent_m()) {
            return; // over a needle, constrained() lowers the target
        }
        ++homes_;
        for (const ScenePoint& corner : box().corners()) {
            const auto at = project(camera_, viewport_, corner);
            ASSERT_TRUE(at);
            ASSERT_GE(at->x, -0.5);
            ASSERT_LE(at->x, viewport_.width + 0.5);
            ASSERT_GE(at->y, -0.5);
            ASSERT_LE(at->y, viewport_.height + 0.5);
        }
    }

    void zoom(double factor, PixelPoint at)
    {
        const OrbitCamera goal = factor < 1.0 ? onGround() : camera_;
        moveTo(zoomed(goal, factor, anchorAt(at, goal), limits()));
    }

    // Wherever the pointer is, always by the same factor.
    void zoomOutCompletely()
    {
        const OrbitCamera start = camera_;
        const PixelPoint at = pixel();
        const double distance_max_m = limits().distance_max_m;
        while (camera_.distance_m < distance_max_m && !testing::Test::HasFailure()) {
            const double expected_m = std::min(1.25 * camera_.distance_m, distance_max_m);
            const OrbitCamera goal = zoomed(camera_, 1.25, anchorAt(at, camera_), limits());
            camera_ = bounded(goal);
            expectAllIsWell();
            EXPECT_NEAR(camera_.distance_m, expected_m, 1e-9 * expected_m);
        }
        camera_ = start;
    }

    void expectAllIsWell() const
    {
        const OrbitCamera& c = camera_;
        const ScenePoint eye = eyeOf(c);
        for (const double number : {c.target.x, c.target.y, c.target.z, c.distance_m,
                                    c.azimuth.radians(), c.tilt.radians(), eye.z}) {
            ASSERT_TRUE(std::isfinite(number));
        }
        const double ground_z = groundAt(eye.x, eye.y);
        if (std::isfinite(ground_z)) {
            ASSERT_GE(eye.z - ground_z, c.distance_m / 50.0 * (1.0 - 1e-6));
        }
        const double slack = 1e-9 * box().diagonal_m();
        ASSERT_GE(c.target.x, box().minimum.x - slack);
        ASSERT_LE(c.target.x, box().maximum.x + slack);
        ASSERT_GE(c.target.y, box().minimum.y - slack);
        ASSERT_LE(c.target.y, box().maximum.y + slack);
        ASSERT_GE(c.target.z, box().minimum.z - slack);
        ASSERT_LE(c.target.z, box().maximum.z + slack);

        // The surface is in the view: at the target, below it, or in front of it.
        const double target_ground_z = groundAt(c.target.x, c.target.y);
        if (std::isfinite(target_ground_z)) {
            const ScenePoint seen{c.target.x, c.target.y, std::min(c.target.z, target_ground_z)};
            const auto at = project(c, viewport_, seen);
            ASSERT_TRUE(at);
            ASSERT_NEAR(at->x, viewport_.width / 2.0, 1e-3);
            if (c.target.z >= target_ground_z) {
                ASSERT_GT(at->y, 0.4998 * viewport_.height);
                ASSERT_LT(at->y, 0.876 * viewport_.height);
            }
        } else if (over_voids_++ % 16 == 0) { // which is slow
            ASSERT_TRUE(isSurfaceSeen());
        }
    }

private:
    static Heightfield heightfieldOf(const Height& height)
    {
        SampleGrid grid = SampleGrid::create(SampleType::Float32, kColumns, kRows).value();
        std::vector<float> line(kColumns);
        for (std::size_t row = 0; row < kRows; ++row) {
            for (std::size_t column = 0; column < kColumns; ++column) {
                line[column] = static_cast<float>(
                    height(static_cast<double>(column), static_cast<double>(row)));
            }
            std::memcpy(grid.rowData(row), line.data(), kColumns * sizeof(float));
        }
        const SampleStatistics statistics = grid.applyRule({}, 0, kRows);
        return {std::make_shared<const SampleGrid>(std::move(grid)), statistics, {}};
    }

    SceneBox box() const
    {
        return sceneBox(frame_, heightfield_.columns(), heightfield_.rows(), *heightfield_.range(),
                        exaggeration_);
    }
    NavigationLimits limits() const { return navigationLimits(box(), pixel_m_); }
    double groundAt(double east_m, double north_m) const
    {
        return heightfield_.height(frame_.toGrid({east_m, north_m, 0.0})) * exaggeration_;
    }
    OrbitCamera bounded(const OrbitCamera& camera) const
    {
        return constrained(camera, limits(), [this](double east_m, double north_m) {
            return groundAt(east_m, north_m);
        });
    }
    std::optional<RayHit> cast(const Ray& ray) const
    {
        return castRay(heightfield_, *pyramid_,
                       gridRay(ray.origin, ray.direction, frame_, exaggeration_));
    }
    ScenePoint pointOf(const RayHit& hit) const
    {
        return frame_.toScene(hit.grid, hit.height_m * exaggeration_);
    }
    OrbitCamera onGround() const
    {
        const auto hit = cast({.origin = eyeOf(camera_), .direction = axesOf(camera_).forward});
        return hit && hit->t > limits().distance_min_m && hit->t < limits().distance_max_m
                   ? retargeted(camera_, hit->t)
                   : camera_;
    }
    ScenePoint anchorAt(PixelPoint at, const OrbitCamera& camera) const
    {
        const Ray ray = pickRay(camera_, viewport_, at);
        const auto hit = cast(ray);
        return hit ? pointOf(*hit) : anchorBesideMap(camera, ray);
    }
    // The pixel test finds cells larger than the picture; the sample test finds those that pixels
    // miss.
    bool isSurfaceSeen() const
    {
        for (const int step : {100, 10}) {
            for (int y = 5; y < viewport_.height; y += step) {
                for (int x = 5; x < viewport_.width; x += step) {
                    if (cast(pickRay(camera_, viewport_,
                                     {static_cast<double>(x), static_cast<double>(y)}))) {
                        return true;
                    }
                }
            }
        }
        for (std::size_t row = 0; row < heightfield_.rows(); ++row) {
            for (std::size_t column = 0; column < heightfield_.columns(); ++column) {
                const double height_m = heightfield_.sample(column, row) * exaggeration_;
                const ScenePoint p = frame_.toScene(
                    {static_cast<double>(column), static_cast<double>(row)}, height_m);
                const auto at = project(camera_, viewport_, p);
                if (std::isfinite(height_m) && at && at->x > 0.0 && at->x < viewport_.width &&
                    at->y > 0.0 && at->y < viewport_.height) {
                    return true;
                }
            }
        }
        return false;
    }
    // Some inputs arrive while the camera is still moving.
    void moveTo(const OrbitCamera& goal)
    {
        const OrbitCamera start = camera_;
        const double end = random_.chance(0.3) ? random_.unit() : 1.0;
        for (const double t : {0.3 * end, 0.7 * end, end}) {
            camera_ = bounded(interpolated(start, bounded(goal), t));
            expectAllIsWell();
        }
    }
    PixelPoint pixel()
    {
        return {random_.uniform(0.0, viewport_.width), random_.uniform(0.0, viewport_.height)};
    }
    Angle angle(double degrees_max)
    {
        return Angle::degrees(random_.uniform(-degrees_max, degrees_max));
    }

    test::Random random_;
    Heightfield heightfield_;
    SceneFrame frame_;
    double pixel_m_;
    Viewport viewport_{1000, 600};
    int stretches_in_place_ = 0;
    int homes_ = 0;
    mutable int over_voids_ = 0;
    std::unique_ptr<MinMaxPyramid> pyramid_;
    double exaggeration_ = 1.0;
    OrbitCamera camera_;
};

struct Terrain {
    const char* name;
    Height height;
};

void walkAround(Walk& walk)
{
    for (int i = 0; i < kInputs; ++i) {
        walk.doSomething();
        walk.expectAllIsWell();
        if (i % 1000 == 0) {
            walk.zoomOutCompletely();
        }
        if (testing::Test::HasFailure()) {
            FAIL() << "input " << i;
        }
    }
    std::printf("%d changes of exaggeration in place, %d times home\n", walk.stretchesInPlace(),
                walk.homes());
    EXPECT_GT(walk.stretchesInPlace(), kInputs / 100);
    EXPECT_GT(walk.homes(), kInputs / 1000);
}

class NavigationWalk : public testing::TestWithParam<Terrain> {};

TEST_P(NavigationWalk, NeverLosesTheMapNorEntersTheTerrain)
{
    Walk walk(GetParam().height);
    walkAround(walk);
}

class NavigationWalkOnMaps : public testing::TestWithParam<const char*> {};

TEST_P(NavigationWalkOnMaps, NeverLosesTheMapNorEntersTheTerrain)
{
    JobMonitor monitor;
    const auto dataset = readMap(RasterSpec{(test::bundledSamples() / GetParam()).string(), 1, {}},
                                 monitor, defaultMemoryBudget());
    ASSERT_TRUE(dataset);
    const Georeference& georeference = (*dataset)->georeference();
    Walk walk((*dataset)->heightfield(), georeference.sceneFrame(),
              std::min(georeference.pixelWidthMeters(), georeference.pixelHeightMeters()));
    walkAround(walk);
}

INSTANTIATE_TEST_SUITE_P(Bundled,
                         NavigationWalkOnMaps,
                         testing::Values("mars_mola_4ppd.tif", "mount_st_helens_30m.tif"),
                         [](const auto& map) { return std::string(map.param).substr(0, 4); });

double roughness(double column, double row)
{
    // Every two neighbors differ, yet the result is the same on every machine.
    return std::fmod(std::abs(std::sin(column * 12.9898 + row * 78.233)) * 43758.5453, 1.0);
}

const Terrain kTerrains[] = {
    {"Flat", [](double, double) { return 250.0; }},
    {"Rough",
     [](double column, double row) {
         return 300.0 * std::sin(column / 9.0) * std::cos(row / 7.0) +
                80.0 * roughness(column, row);
     }},
    {"Steep", [](double column, double row) { return column + row > 80.0 ? 2500.0 : 5.0 * row; }},
    {"Holed",
     [](double column, double row) {
         const bool is_void = std::hypot(column - 40.0, row - 30.0) < 9.0 || column < 6.0;
         return is_void ? std::nan("") : 400.0 * std::sin(column / 8.0) + 3.0 * row;
     }},
};

INSTANTIATE_TEST_SUITE_P(Terrains,
                         NavigationWalk,
                         testing::ValuesIn(kTerrains),
                         [](const auto& terrain) { return std::string(terrain.param.name); });

} // namespace
} // namespace marsview
