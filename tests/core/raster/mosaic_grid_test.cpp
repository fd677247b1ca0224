#include "core/raster/mosaic_grid.h"
#include "tests/support/random.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace marsview {
namespace {

using testing::HasSubstr;

GeoTransform transformOf(const GeoTransform::Terms& terms)
{
    return GeoTransform::fromTerms(terms).value();
}

MosaicPart partAt(double x, double y, double pixel, std::size_t columns, std::size_t rows)
{
    return {fmt::format("part at {}, {}", x, y),
            transformOf({x, pixel, 0.0, y, 0.0, -pixel}),
            {columns, rows}};
}

TEST(MosaicGrid, PlacesEverySample)
{
    test::Random random;
    for (int round = 0; round < 300; ++round) {
        // Pixel sizes that doubles cannot represent; corners printed with as many digits as in
        // headers.
        const double pixel = 1.0 / static_cast<double>(1 + random.below(4000));
        const double west = std::floor(random.uniform(-179.0, 100.0));
        const double north = std::floor(random.uniform(-80.0, 80.0));
        const double sign_x = random.chance(0.2) ? -1.0 : 1.0;
        const double sign_y = random.chance(0.2) ? 1.0 : -1.0;
        std::vector<MosaicPart> parts;
        std::vector<std::pair<std::int64_t, std::int64_t>> corners;
        for (std::size_t i = 0; i < 1 + random.below(8); ++i) {
            const auto column = static_cast<std::int64_t>(random.below(5000)) - 2500;
            const auto row = static_cast<std::int64_t>(random.below(5000)) - 2500;
            corners.emplace_back(column, row);
            const double x = west + sign_x * pixel * static_cast<double>(column);
            const double y = north + sign_y * pixel * static_cast<double>(row);
            parts.push_back(
                {fmt::format("{}", i),
                 transformOf({std::stod(fmt::format("{:.10f}", x)), sign_x * pixel, 0.0,
                              std::stod(fmt::format("{:.10f}", y)), 0.0, sign_y * pixel}),
                 {2 + random.below(900), 2 + random.below(900)}});
        }
        const auto grid = layOutMosaic(parts, std::nullopt);
        ASSERT_TRUE(grid) << grid.error().message;
        const auto first = std::min_element(corners.begin(), corners.end(),
                                            [](auto a, auto b) { return a.first < b.first; });
        const auto top = std::min_element(corners.begin(), corners.end(),
                                          [](auto a, auto b) { return a.second < b.second; });
        std::size_t end_column = 0;
        std::size_t end_row = 0;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const GridWindow& place = grid->places[i];
            ASSERT_EQ(place.column, static_cast<std::size_t>(corners[i].first - first->first));
            ASSERT_EQ(place.row, static_cast<std::size_t>(corners[i].second - top->second));
            ASSERT_EQ(place.columns, parts[i].size.columns);
            ASSERT_EQ(place.rows, parts[i].size.rows);
            end_column = std::max(end_column, place.column + place.columns);
            end_row = std::max(end_row, place.row + place.rows);
            // The same position from the part's transform and from the mosaic's, to the digits of
            // the headers.
            const MapPoint own = parts[i].transform.toMap({0.0, 0.0});
            const MapPoint whole = grid->transform.toMap(
                {static_cast<double>(place.column), static_cast<double>(place.row)});
            ASSERT_NEAR(own.x, whole.x, 2e-10);
            ASSERT_NEAR(own.y, whole.y, 2e-10);
        }
        ASSERT_EQ(grid->size, (GridSize{end_column, end_row}));
    }
}

TEST(MosaicGrid, ComputesTheCoveredFraction)
{
    test::Random random;
    for (int round = 0; round < 200; ++round) {
        std::vector<MosaicPart> parts;
        for (std::size_t i = 0; i < 1 + random.below(9); ++i) {
            parts.push_back(partAt(static_cast<double>(random.below(40)),
                                   static_cast<double>(random.below(40)), 1.0, 1 + random.below(30),
                                   1 + random.below(30)));
        }
        const auto grid = layOutMosaic(parts, std::nullopt);
        ASSERT_TRUE(grid);
        std::set<std::pair<std::size_t, std::size_t>> samples;
        for (const GridWindow& place : grid->places) {
            for (std::size_t r = 0; r < place.rows; ++r) {
                for (std::size_t c = 0; c < place.columns; ++c) {
                    samples.emplace(place.column + c, place.row + r);
                }
            }
        }
        ASSERT_EQ(grid->covered, static_cast<double>(samples.size()) /
                                     static_cast<double>(grid->size.columns * grid->size.rows));
    }
}

// Tries every place to cut the circle: before each of the parts, and as the parts are given.
std::size_t narrowest(const std::vector<MosaicPart>& parts, double turn)
{
    const auto width_from = [&](double west) {
        double end = west;
        for (const MosaicPart& part : parts) {
            double x = part.transform.terms()[0];
            x -= std::floor((x - west) / turn) * turn;
            end = std::max(end, x + static_cast<double>(part.size.columns));
        }
        return end - west;
    };
    double as_given_west = parts.front().transform.terms()[0];
    double as_given_east = as_given_west;
    double narrowest = HUGE_VAL;
    for (const MosaicPart& part : parts) {
        const double x = part.transform.terms()[0];
        narrowest = std::min(narrowest, width_from(x));
        as_given_west = std::min(as_given_west, x);
        as_given_east = std::max(as_given_east, x + static_cast<double>(part.size.columns));
    }
    return static_cast<std::size_t>(std::min(narrowest, as_given_east - as_given_west));
}

TEST(MosaicGrid, JoinsBothSidesOfTheAntimeridian)
{
    test::Random random;
    for (int round = 0; round < 500; ++round) {
        std::vector<MosaicPart> parts;
        for (std::size_t i = 0; i < 1 + random.below(6); ++i) {
            parts.push_back(partAt(static_cast<double>(random.below(360)) - 180.0, 10.0, 1.0,
                                   1 + random.below(60), 10));
        }
        const auto grid = layOutMosaic(parts, 360.0);
        ASSERT_TRUE(grid);
        ASSERT_EQ(grid->size.columns, narrowest(parts, 360.0));
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const double x =
                grid->transform.toMap({static_cast<double>(grid->places[i].column) - 0.5, 0.0}).x;
            const double turns = (x - parts[i].transform.terms()[0]) / 360.0;
            ASSERT_EQ(turns, std::round(turns));
        }
    }
}

TEST(MosaicGrid, DoesNotShiftAWholePlanet)
{
    std::vector<MosaicPart> parts;
    for (int i = 0; i < 8; ++i) {
        parts.push_back(partAt(-180.0 + 45.0 * i, 90.0, 0.25, 181, 720)); // shared edges
    }
    const auto grid = layOutMosaic(parts, 360.0);
    ASSERT_TRUE(grid);
    EXPECT_EQ(grid->size, (GridSize{1441, 720}));
    EXPECT_EQ(grid->transform.terms()[0], -180.0);
    EXPECT_EQ(grid->covered, 1.0);
}

TEST(MosaicGrid, DoesNotShiftGridsWithoutAWholeTurn)
{
    // 360 degrees are not a multiple of this pixel size: a full turn away, samples lie between
    // these.
    const std::vector<MosaicPart> parts{partAt(-180.0, 10.0, 0.7, 10, 10),
                                        partAt(-180.0 + 500 * 0.7, 10.0, 0.7, 10, 10)};
    const auto grid = layOutMosaic(parts, 360.0);
    ASSERT_TRUE(grid);
    EXPECT_EQ(grid->size.columns, 510U);
}

TEST(MosaicGrid, NamesTheRasterThatDoesNotFit)
{
    const MosaicPart first = partAt(0.0, 0.0, 1.0, 100, 100);
    const auto why = [&first](const MosaicPart& part) {
        const auto grid = layOutMosaic({first, part}, std::nullopt);
        EXPECT_FALSE(grid);
        return grid ? std::string() : grid.error().message;
    };
    EXPECT_THAT(why({"b.tif", transformOf({100.0, 1.0, 0.0, 0.0, 0.0, -2.0}), {9, 9}}),
                HasSubstr("b.tif has pixels of 1 × -2, part at 0, 0 of 1 × -1"));
    EXPECT_THAT(why({"b.tif", transformOf({100.25, 1.0, 0.0, 0.0, 0.0, -1.0}), {9, 9}}),
                HasSubstr("b.tif lies 0.25 columns and 0 rows off the grid of part at 0, 0"));
    EXPECT_THAT(why({"b.tif", transformOf({100.0, 1.0, 0.1, 0.0, 0.0, -1.0}), {9, 9}}),
                HasSubstr("b.tif is rotated"));
    EXPECT_THAT(why({"b.tif", transformOf({100.0, 1.001, 0.0, 0.0, 0.0, -1.0}), {100, 9}}),
                HasSubstr("b.tif has pixels of 1.001"));
    // A difference that stays negligible over the whole part.
    EXPECT_TRUE(layOutMosaic(
        {first, {"b.tif", transformOf({100.0, 1.0001, 0.0, 0.0, 0.0, -1.0}), {100, 9}}},
        std::nullopt));
}

} // namespace
} // namespace marsview
