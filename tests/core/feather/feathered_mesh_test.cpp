// Maps with blended edges, joined with the maps below them to the surface that is touched.
#include "core/contact/contact_model.h"
#include "core/feather/feathered_map.h"
#include "tests/core/contact/nested_maps.h"
#include "tests/support/map_maker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace marsview {
namespace {

constexpr double kExaggeration = 2.0;
constexpr double kRaisedM = 300.0;
constexpr std::size_t kColumns = 41;
constexpr std::size_t kRows = 33;
constexpr double kCellM = 300.0;

double hills(std::size_t column, std::size_t row)
{
    return 40.0 * std::sin(0.9 * static_cast<double>(column)) *
           std::cos(0.7 * static_cast<double>(row));
}

bool isHole(std::size_t column, std::size_t row)
{
    return (column == 18 || column == 19) && row > 12 && row < 16;
}

// A map of 300 m cells with a hole, 300 m above one of 1.2 km, whose triangles lie up to 5 cm below
// the curved ground.
class FeatheredEdge : public testing::Test {
protected:
    std::shared_ptr<const LayeredMesh> joined(std::size_t cells)
    {
        JobMonitor monitor;
        const Ellipsoid ellipsoid = *lower_->georeference().crs()->ellipsoid();
        const BodyTerrain below(lower_, BodyGrid::make(lower_->georeference(), monitor).value());
        const auto grid = BodyGrid::make(upper_->georeference(), monitor, ellipsoid).value();
        shown_ =
            featheredMap(BodyTerrain(upper_, grid), std::vector{below}, cells, monitor).value();
        meshes_.clear();
        for (const auto& map : {shown_, lower_}) {
            meshes_.push_back(BodyMesh::build(map->filled(), map->georeference(), kExaggeration,
                                              monitor, ellipsoid)
                                  .value());
        }
        return LayeredMesh::build(meshes_, monitor).value();
    }

    test::MapMaker maker_;
    std::shared_ptr<const Map> lower_ =
        maker_.make({60, 60, {225.4, 0.02, 0, 18.6, 0, -0.02}, "+proj=longlat +R=3396190"},
                    [](std::size_t column, std::size_t row) { return 3.0 * hills(row, column); });
    std::shared_ptr<const Map> upper_ =
        maker_.make({kColumns,
                     kRows,
                     {-6150, kCellM, 0, 4950, 0, -kCellM},
                     "+proj=tmerc +lat_0=18 +lon_0=226 +R=3396190 +units=m"},
                    [](std::size_t column, std::size_t row) {
                        return isHole(column, row) ? std::numeric_limits<double>::quiet_NaN()
                                                   : kRaisedM + hills(column, row);
                    });
    std::shared_ptr<const Map> shown_;
    std::vector<std::shared_ptr<const BodyMesh>> meshes_; // the upper one first
};

// The surface straight below, by looking at all triangles.
TEST_F(FeatheredEdge, TheStepAtTheBorderIsZero)
{
    const double sag_m = 1200.0 * 1200.0 / (8.0 * 3396190.0);
    double plain_step_m = 0.0;
    for (const std::size_t cells : {0U, 8U}) {
        const auto mesh = joined(cells);
        double step_max_m = 0.0;
        for (const std::size_t at : {1U, 7U, 16U, 25U, 31U}) {
            const auto step_m = [&](std::size_t column, std::size_t row, long across, long down) {
                // A sample of the border, a little inside and a little outside.
                const BodyPositions& positions = meshes_[0]->positions();
                const ScenePoint border = positions.at(column, row, 0.0);
                const ScenePoint inside =
                    positions.at(static_cast<std::size_t>(static_cast<long>(column) + across),
                                 static_cast<std::size_t>(static_cast<long>(row) + down), 0.0);
                const Vec3 inward = (inside - border) * 1e-3;
                const auto within = test::below(*mesh, border + inward);
                const auto beyond = test::below(*mesh, border - inward);
                EXPECT_TRUE(within && beyond);
                return std::abs(within->height_m - beyond->height_m) / kExaggeration;
            };
            step_max_m = std::max({step_max_m, step_m(at, 0, 0, 1), step_m(at, kRows - 1, 0, -1),
                                   step_m(0, at, 1, 0), step_m(kColumns - 1, at, -1, 0)});
        }
        if (cells == 0) {
            plain_step_m = step_max_m;
            EXPECT_GT(step_max_m, kRaisedM - 100.0);
        } else {
            // Two thousandths of a cell apart, on slopes of less than 1 in 2.
            EXPECT_LE(step_max_m, sag_m + 0.002 * kCellM * 0.5);
        }
        std::printf("feather %zu: step at the border %.3f m of %.1f m\n", cells, step_max_m,
                    plain_step_m);
    }
}

TEST_F(FeatheredEdge, FurtherInsideItIsTheMapToTheBit)
{
    joined(8);
    for (std::size_t row = 8; row < kRows - 8; ++row) {
        for (std::size_t column = 8; column < kColumns - 8; ++column) {
            const bool is_near_hole = column > 9 && column < 28 && row > 3 && row < 25;
            if (!is_near_hole) {
                ASSERT_EQ(shown_->filled()->sample(column, row),
                          upper_->filled()->sample(column, row));
            }
        }
    }
    // Next to the hole it lies on the map below.
    const GridPoint rim{17.0, 14.0};
    const auto place = upper_->georeference().toGeographic(rim);
    EXPECT_NEAR(shown_->filled()->sample(17, 14), lower_->height(*place), 1e-3);
}

// What is left of the walls are the triangles of the map below between the upper one's samples.
TEST_F(FeatheredEdge, WallsAreAsHighAsTheMapBelowIsBentBetweenSamples)
{
    std::vector<double> highest_m;
    for (const std::size_t cells : {0U, 8U}) {
        const auto mesh = joined(cells);
        double high_m = 0.0;
        for (BodyIndex face = mesh->firstCutFace(); face < mesh->faceCount(); ++face) {
            if (mesh->isGone(face) || !mesh->isWall(face)) {
                continue;
            }
            const auto points = mesh->points(face);
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3 edge = points[(i + 1) % 3] - points[i];
                const Vec3 up = verticalAt(mesh->ellipsoid(), points[i]).up;
                if (std::abs(dot(edge, up)) > 0.999 * length(edge)) { // a vertical side
                    high_m = std::max(high_m, length(edge) / kExaggeration);
                }
            }
        }
        highest_m.push_back(high_m);
    }
    EXPECT_GT(highest_m[0], kRaisedM);
    // A fold of the lower map between two samples 300 m apart: its slopes change by less than 0.3.
    EXPECT_LT(highest_m[1], 25.0);
    std::printf("highest wall %.1f m, with a feather %.1f m\n", highest_m[0], highest_m[1]);
}

// As for maps without a feather: the same contact as on a list of the same triangles. A god-object
// may float.
TEST_F(FeatheredEdge, ProxiesAreThoseOnAListOfTheSameTriangles)
{
    const auto mesh = joined(6);
    for (const ContactModelKind kind :
         {ContactModelKind::ProxyGraph, ContactModelKind::SurfaceWalk,
          ContactModelKind::ContinuousWalk, ContactModelKind::GodObject}) {
        EXPECT_GT(test::contactsAsOnList(mesh, *meshes_.front(), kind), 20)
            << contactModelName(kind);
    }
}

} // namespace
} // namespace marsview
