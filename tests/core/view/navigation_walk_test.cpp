// Thousands of random inputs in a row, put together from the pure functions as the view does it.

#include "core/terrain/ray_cast.h"
#include "core/view/exaggeration.h"
#include "core/view/navigation.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace marsview {
namespace {

constexpr std::size_t kColumns = 97;
constexpr std::size_t kRows = 65;
constexpr double kCell = 30.0;
constexpr Viewport kViewport{1000, 600};
constexpr int kInputs = 8000; // per terrain

using Height = std::function<double(double column, double row)>; // NaN for void

class Walk {
public:
    explicit Walk(const Height& height)
        : heightfield_(heightfieldOf(height))
    {
        JobMonitor monitor;
        pyramid_ =
            std::make_unique<MinMaxPyramid>(MinMaxPyramid::build(heightfield_, monitor).value());
        camera_ = bounded(homeCamera(box(), kViewport));
    }

    const OrbitCamera& camera() const { return camera_; }

    void doSomething()
    {
        switch (random_.below(9)) {
        case 0:
            moveTo(orbited(onGround(), angle(180.0), angle(20.0)));
            break;
        case 1: // turned with the mouse
            camera_ = onGround();
            for (int i = 0; i < 5; ++i) {
                camera_ = bounded(orbited(camera_, angle(6.0), angle(6.0)));
            }
            break;
        case 2: {
            const Drag drag{
                .from = pixel(), .to = pixel(), .grabbed_z_m = anchorAt(pixel(), camera_).z};
            camera_ = bounded(dragged(camera_, kViewport, drag));
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
        case 7: { // not so high that the map becomes a needle
            const double before = exaggeration_;
            const OrbitCamera goal = onGround();
            exaggeration_ =
                std::clamp(steppedExaggeration(before, random_.chance(0.5) ? 1 : -1), 0.1, 100.0);
            camera_ = bounded(reexaggerated(goal, before, exaggeration_));
            break;
        }
        case 8:
            if (const auto hit = cast(pickRay(camera_, kViewport, pixel()))) {
                OrbitCamera goal = onGround();
                goal.target = pointOf(*hit);
                goal.distance_m *= 0.3;
                moveTo(goal);
            }
            break;
        }
    }

    void zoom(double factor, PixelPoint at)
    {
        const OrbitCamera goal = factor < 1.0 ? onGround() : camera_;
        moveTo(zoomed(goal, factor, anchorAt(at, goal), limits()));
    }

    // Wherever the pointer is, each time by the same factor.
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

        // There is surface in the picture: at the target, under it, or before it.
        const double target_ground_z = groundAt(c.target.x, c.target.y);
        if (std::isfinite(target_ground_z)) {
            const ScenePoint seen{c.target.x, c.target.y, std::min(c.target.z, target_ground_z)};
            const auto at = project(c, kViewport, seen);
            ASSERT_TRUE(at);
            ASSERT_NEAR(at->x, 500.0, 1e-3);
            if (c.target.z >= target_ground_z) {
                ASSERT_GT(at->y, 299.9);
                ASSERT_LT(at->y, 0.876 * 600.0);
            }
        } else {
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
        return sceneBox(frame_, kColumns, kRows, *heightfield_.range(), exaggeration_);
    }
    NavigationLimits limits() const { return navigationLimits(box(), kCell); }
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
        const Ray ray = pickRay(camera_, kViewport, at);
        const auto hit = cast(ray);
        return hit ? pointOf(*hit) : anchorBesideMap(camera, ray);
    }
    // Pixels find cells that are larger than the picture, samples find what pixels miss.
    bool isSurfaceSeen() const
    {
        for (int y = 5; y < kViewport.height; y += 10) {
            for (int x = 5; x < kViewport.width; x += 10) {
                if (cast(pickRay(camera_, kViewport,
                                 {static_cast<double>(x), static_cast<double>(y)}))) {
                    return true;
                }
            }
        }
        for (std::size_t row = 0; row < kRows; ++row) {
            for (std::size_t column = 0; column < kColumns; ++column) {
                const double height_m = heightfield_.sample(column, row) * exaggeration_;
                const ScenePoint p = frame_.toScene(
                    {static_cast<double>(column), static_cast<double>(row)}, height_m);
                const auto at = project(camera_, kViewport, p);
                if (std::isfinite(height_m) && at && at->x > 0.0 && at->x < kViewport.width &&
                    at->y > 0.0 && at->y < kViewport.height) {
                    return true;
                }
            }
        }
        return false;
    }
    // Some inputs come while the camera still moves.
    void moveTo(const OrbitCamera& goal)
    {
        const OrbitCamera start = camera_;
        const double end = random_.chance(0.3) ? random_.unit() : 1.0;
        for (const double t : {0.3 * end, 0.7 * end, end}) {
            camera_ = bounded(interpolated(start, bounded(goal), t));
            expectAllIsWell();
        }
    }
    PixelPoint pixel() { return {random_.uniform(0.0, 1000.0), random_.uniform(0.0, 600.0)}; }
    Angle angle(double degrees_max)
    {
        return Angle::degrees(random_.uniform(-degrees_max, degrees_max));
    }

    test::Random random_;
    Heightfield heightfield_;
    SceneFrame frame_{.origin = {(kColumns - 1) / 2.0, (kRows - 1) / 2.0},
                      .east_per_column = kCell,
                      .north_per_row = -kCell};
    std::unique_ptr<MinMaxPyramid> pyramid_;
    double exaggeration_ = 1.0;
    OrbitCamera camera_;
};

struct Terrain {
    const char* name;
    Height height;
};

class NavigationWalk : public testing::TestWithParam<Terrain> {};

TEST_P(NavigationWalk, NeverLosesTheMapNorEntersTheGround)
{
    Walk walk(GetParam().height);
    for (int i = 0; i < kInputs; ++i) {
        walk.doSomething();
        walk.expectAllIsWell();
        if (i % 100 == 0) {
            walk.zoomOutCompletely();
        }
        if (HasFailure()) {
            FAIL() << "input " << i;
        }
    }
}

double roughness(double column, double row)
{
    // No two neighbours alike, yet the same on every machine.
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
