#include "core/terrain/triangulation.h"
#include "tests/support/nan.h"
#include "tests/support/random.h"
#include "tests/support/reference_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

double ulp(double value)
{
    return std::nextafter(std::abs(value), INFINITY) - std::abs(value);
}

CellHeights randomCell(test::Random& random)
{
    const double scale = std::exp(random.uniform(-5.0, 12.0));
    const auto corner = [&] { return random.uniform(-scale, scale); };
    return {corner(), corner(), corner(), corner()};
}

double largest(const CellHeights& z)
{
    return std::max({std::abs(z.upper_left), std::abs(z.upper_right), std::abs(z.lower_left),
                     std::abs(z.lower_right)});
}

long double planeHeight(const CellHeights& z, double u, double v)
{
    return test::planeHeight({z.upper_left, z.upper_right, z.lower_left, z.lower_right}, u, v);
}

TEST(HeightInCell, IsExactAtTheCorners)
{
    test::Random random;
    for (int i = 0; i < 10000; ++i) {
        const CellHeights z = randomCell(random);
        EXPECT_EQ(heightInCell(z, 0.0, 0.0), z.upper_left);
        EXPECT_EQ(heightInCell(z, 1.0, 0.0), z.upper_right);
        EXPECT_EQ(heightInCell(z, 0.0, 1.0), z.lower_left);
        EXPECT_EQ(heightInCell(z, 1.0, 1.0), z.lower_right);
    }
}

TEST(HeightInCell, IsThePlaneThroughTheTrianglesCornersWithinFourUlp)
{
    test::Random random;
    double worst_ulp = 0.0;
    for (int i = 0; i < 200000; ++i) {
        const CellHeights z = randomCell(random);
        double u = random.unit();
        double v = random.unit();
        if (random.chance(0.1)) {
            v = u;
        }
        const double error = static_cast<double>(
            std::abs(static_cast<long double>(heightInCell(z, u, v)) - planeHeight(z, u, v)));
        worst_ulp = std::max(worst_ulp, error / ulp(largest(z)));
    }
    std::printf("worst error %.2f ulp of the largest corner\n", worst_ulp);
    EXPECT_LE(worst_ulp, 4.0);
}

TEST(HeightInCell, NeighboringCellsAgreeBitForBitOnTheirEdge)
{
    test::Random random;
    for (int i = 0; i < 100000; ++i) {
        const CellHeights left = randomCell(random);
        CellHeights right = randomCell(random);
        right.upper_left = left.upper_right;
        right.lower_left = left.lower_right;
        const double v = random.unit();
        ASSERT_EQ(heightInCell(left, 1.0, v), heightInCell(right, 0.0, v));
        CellHeights below = randomCell(random);
        below.upper_left = left.lower_left;
        below.upper_right = left.lower_right;
        const double u = random.unit();
        ASSERT_EQ(heightInCell(left, u, 1.0), heightInCell(below, u, 0.0));
    }
}

TEST(HeightInCell, TheTwoTrianglesMeetOnTheDiagonal)
{
    test::Random random;
    for (int i = 0; i < 100000; ++i) {
        const CellHeights z = randomCell(random);
        const double t = random.uniform(1e-9, 1.0);
        const double nearby = std::nextafter(t, 0.0);
        // A step of one ulp across the diagonal changes the height by no more than that.
        const double tolerance = 8.0 * ulp(largest(z));
        ASSERT_NEAR(heightInCell(z, t, nearby), heightInCell(z, t, t), tolerance);
        ASSERT_NEAR(heightInCell(z, nearby, t), heightInCell(z, t, t), tolerance);
    }
}

TEST(HeightInCell, StaysWithinTheTrianglesCorners)
{
    test::Random random;
    for (int i = 0; i < 100000; ++i) {
        const CellHeights z = randomCell(random);
        const double u = random.unit();
        const double v = random.unit();
        const double other = u >= v ? z.upper_right : z.lower_left;
        const double slack = 4.0 * ulp(largest(z));
        const double height = heightInCell(z, u, v);
        ASSERT_GE(height, std::min({z.upper_left, z.lower_right, other}) - slack);
        ASSERT_LE(height, std::max({z.upper_left, z.lower_right, other}) + slack);
    }
}

TEST(HeightInCell, ReproducesPlanesAndConstantsExactly)
{
    const CellHeights flat{7.25, 7.25, 7.25, 7.25};
    test::Random random;
    for (int i = 0; i < 10000; ++i) {
        const double u = random.unit();
        const double v = random.unit();
        EXPECT_NEAR(heightInCell(flat, u, v), 7.25, 2.0 * ulp(7.25));
        const CellHeights plane{10.0, 13.0, 6.0, 9.0}; // 10 + 3u - 4v
        EXPECT_NEAR(heightInCell(plane, u, v), 10.0 + 3.0 * u - 4.0 * v, 4.0 * ulp(13.0));
    }
}

TEST(HeightInCell, AVoidCornerAffectsOnlyItsOwnTriangle)
{
    test::Random random;
    for (int i = 0; i < 2000; ++i) {
        const CellHeights z = randomCell(random);
        CellHeights no_upper_right = z;
        no_upper_right.upper_right = kNan;
        CellHeights no_lower_left = z;
        no_lower_left.lower_left = kNan;
        const double a = random.uniform(0.01, 0.98);
        const double b = random.uniform(a + 0.005, 0.995);
        EXPECT_TRUE(std::isnan(heightInCell(no_upper_right, b, a)));
        EXPECT_EQ(heightInCell(no_upper_right, a, b), heightInCell(z, a, b));
        EXPECT_TRUE(std::isnan(heightInCell(no_lower_left, a, b)));
        EXPECT_EQ(heightInCell(no_lower_left, b, a), heightInCell(z, b, a));
        // On the diagonal only its two ends count, and neither is void here.
        EXPECT_EQ(heightInCell(no_upper_right, a, a), heightInCell(z, a, a));
        EXPECT_EQ(heightInCell(no_lower_left, a, a), heightInCell(z, a, a));
    }
}

TEST(HeightInCell, UsesOnlyTheTwoEndsOnAnEdge)
{
    const CellHeights top{1.0, 2.0, kNan, kNan};
    EXPECT_EQ(heightInCell(top, 0.5, 0.0), 1.5);
    const CellHeights left{1.0, kNan, 3.0, kNan};
    EXPECT_EQ(heightInCell(left, 0.0, 0.5), 2.0);
    const CellHeights bottom{kNan, kNan, 3.0, 5.0};
    EXPECT_EQ(heightInCell(bottom, 0.5, 1.0), 4.0);
    const CellHeights right{kNan, 2.0, kNan, 6.0};
    EXPECT_EQ(heightInCell(right, 1.0, 0.5), 4.0);
    const CellHeights diagonal{1.0, kNan, kNan, 3.0};
    EXPECT_EQ(heightInCell(diagonal, 0.5, 0.5), 2.0);
    const CellHeights corner{4.0, kNan, kNan, kNan};
    EXPECT_EQ(heightInCell(corner, 0.0, 0.0), 4.0);
    EXPECT_TRUE(std::isnan(heightInCell(corner, 0.5, 0.0)));
    EXPECT_TRUE(std::isnan(heightInCell(corner, 0.0, 0.5)));
    EXPECT_TRUE(std::isnan(heightInCell(corner, 0.5, 0.5)));
}

} // namespace
} // namespace marsview
