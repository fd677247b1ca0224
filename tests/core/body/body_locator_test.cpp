#include "core/body/body_locator.h"
#include "core/body/body_positions.h"
#include "tests/core/contact/body_maps.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace marsview {
namespace {

class BodyLocatorTest : public testing::TestWithParam<test::BodyMap> {
protected:
    void SetUp() override
    {
        georeference_.emplace(test::georeferenceOf(GetParam()));
        JobMonitor monitor;
        grid_ = BodyGrid::make(*georeference_, monitor).value();
    }
    Vec3 pointAt(const GridPoint& at) const
    {
        return footOf(grid_->ellipsoid(), *georeference_->toGeographic(at)).surface_m;
    }

    std::optional<Georeference> georeference_;
    std::shared_ptr<const BodyGrid> grid_;
};

// The projection itself is the independent route.
TEST_P(BodyLocatorTest, FindsPlacesAmongTheSamples)
{
    if (georeference_->rows() < 4) {
        return; // three columns around a planet have no directions
    }
    const BodyLocator locator(grid_);
    test::Random random(5);
    const double turn = static_cast<double>(grid_->columns() - 1);
    for (int i = 0; i < 2000; ++i) {
        // Off the rows at a pole, where a column means nothing.
        const GridPoint at{random.uniform(0.0, static_cast<double>(georeference_->columns() - 1)),
                           random.uniform(1.0, static_cast<double>(georeference_->rows() - 2))};
        const auto found = locator.find(pointAt(at), std::nullopt);
        ASSERT_TRUE(found);
        double columns = found->column - at.column;
        if (grid_->closes()) {
            columns -= turn * std::round(columns / turn);
        }
        // Columns are short next to a pole.
        const BodyGrid::Steps steps =
            grid_->steps(static_cast<std::size_t>(at.column), static_cast<std::size_t>(at.row));
        const Vec3 off = steps.column * columns + steps.row * (found->row - at.row);
        const double cell_m = grid_->stepMaxM();
        // The cells of the smallest maps are as large as countries.
        const double curved = cell_m / grid_->ellipsoid().equatorial_m;
        EXPECT_LT(length(off) / cell_m, 0.01 + 0.5 * curved) << at.column << ", " << at.row;
    }
}

TEST_P(BodyLocatorTest, PlacesBeyondTheOutermostSamplesLieBeyond)
{
    const BodyLocator locator(grid_);
    test::Random random(6);
    const double last_column = static_cast<double>(georeference_->columns() - 1);
    const double last_row = static_cast<double>(georeference_->rows() - 1);
    int count = 0;
    for (int i = 0; i < 4000; ++i) {
        const GeographicPoint place{.longitude = Angle::degrees(random.uniform(-180.0, 180.0)),
                                    .latitude =
                                        Angle::radians(std::asin(random.uniform(-1.0, 1.0)))};
        const auto exact = georeference_->toGrid(place);
        const auto found = locator.find(footOf(grid_->ellipsoid(), place).surface_m, std::nullopt);
        if (!exact || grid_->closes()) {
            continue;
        }
        const auto inside = [&](const GridPoint& at, double margin) {
            return at.column >= -margin && at.column <= last_column + margin && at.row >= -margin &&
                   at.row <= last_row + margin;
        };
        if (inside(*exact, 0.5) && !inside(*exact, -0.5)) {
            continue; // too near to the edge to tell
        }
        ++count;
        EXPECT_EQ(found && inside(*found, 0.0), inside(*exact, 0.0))
            << place.longitude.degrees() << ", " << place.latitude.degrees();
    }
    EXPECT_TRUE(grid_->closes() || count > 1000);
}

INSTANTIATE_TEST_SUITE_P(Maps,
                         BodyLocatorTest,
                         testing::ValuesIn(test::bodyMaps()),
                         [](const auto& test) { return test.param.name; });

} // namespace
} // namespace marsview
