#include "core/mesh/predicates.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace marsview {
namespace {

// Coordinates are integers of at most 2^38 times a power of two, so that __int128 is exact.
__extension__ using Whole = __int128;

struct Lattice {
    std::array<std::int64_t, 3> at;
    Vec3 point(double unit) const
    {
        return {static_cast<double>(at[0]) * unit, static_cast<double>(at[1]) * unit,
                static_cast<double>(at[2]) * unit};
    }
};

Whole axis(const Lattice& a, const Lattice& b, std::size_t i)
{
    return Whole{b.at[i]} - Whole{a.at[i]};
}

int signOf(Whole value)
{
    return value > 0 ? 1 : value < 0 ? -1 : 0;
}

int exactSide(const Lattice& a, const Lattice& b, const Lattice& c, const Lattice& p)
{
    const auto minor = [&](std::size_t i, std::size_t j) {
        return axis(a, b, i) * axis(a, c, j) - axis(a, b, j) * axis(a, c, i);
    };
    return signOf(axis(a, p, 0) * minor(1, 2) + axis(a, p, 1) * minor(2, 0) +
                  axis(a, p, 2) * minor(0, 1));
}

Lattice randomLattice(test::Random& random, std::int64_t reach, std::int64_t offset)
{
    Lattice l{};
    for (auto& value : l.at) {
        value = offset +
                static_cast<std::int64_t>(random.below(static_cast<std::size_t>(2 * reach + 1))) -
                reach;
    }
    return l;
}

TEST(Predicates, SideOfPlaneIsExactWhereDoublesAreNot)
{
    test::Random random;
    int on = 0;
    int wrong_in_doubles = 0;
    for (int i = 0; i < 200000; ++i) {
        const std::int64_t reach = random.chance(0.5) ? 3 : std::int64_t{1} << random.below(38);
        const std::int64_t offset = random.chance(0.3) ? std::int64_t{1} << 37 : 0;
        std::array<Lattice, 4> l{};
        for (Lattice& point : l) {
            point = randomLattice(random, reach, offset);
        }
        if (random.chance(0.5)) { // in the plane, or one step off it
            const auto s = static_cast<std::int64_t>(random.below(5)) - 2;
            const auto t = static_cast<std::int64_t>(random.below(5)) - 2;
            for (std::size_t k = 0; k < 3; ++k) {
                l[3].at[k] =
                    l[0].at[k] + s * (l[1].at[k] - l[0].at[k]) + t * (l[2].at[k] - l[0].at[k]);
            }
            l[3].at[random.below(3)] += static_cast<std::int64_t>(random.below(3)) - 1;
        }
        const double unit = random.chance(0.5) ? 1.0 : 0x1p-20;
        const std::array<Vec3, 4> p{l[0].point(unit), l[1].point(unit), l[2].point(unit),
                                    l[3].point(unit)};
        const int truth = exactSide(l[0], l[1], l[2], l[3]);
        on += truth == 0 ? 1 : 0;
        const double naive = dot(cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]);
        wrong_in_doubles += (naive > 0.0) - (naive < 0.0) != truth ? 1 : 0;
        ASSERT_EQ(sideOfPlane(p[0], p[1], p[2], p[3]), truth);
        ASSERT_EQ(sideOfPlane(p[1], p[0], p[2], p[3]), -truth);
    }
    std::printf("%d on the plane; doubles alone are wrong in %d\n", on, wrong_in_doubles);
    EXPECT_GT(on, 10000);
    EXPECT_GT(wrong_in_doubles, 100);
}

TEST(Predicates, TheSideSurvivesCoordinatesOfAllMagnitudes)
{
    // Off a plane far from the origin by the smallest distance that doubles can represent.
    const Vec3 a{1e12, 1e-3, 3.0};
    const Vec3 b{1e12, 1e6 + 0.1, 5.0};
    const Vec3 c{1e12, 7.0, 1e-9};
    const double above = std::nextafter(1e12, 2e12);
    const double below = std::nextafter(1e12, 0.0);
    const int side = sideOfPlane(a, b, c, {above, 2.0, 3.0});
    EXPECT_NE(side, 0);
    EXPECT_EQ(sideOfPlane(a, b, c, {below, 2.0, 3.0}), -side);
    EXPECT_EQ(sideOfPlane(a, b, c, {1e12, 2.0, 3.0}), 0);
}

TEST(Predicates, TheSideOfAPointInTwoPartsIsExact)
{
    // The sum of the parts is not representable as a double: integers plus multiples of 2^-40.
    test::Random random;
    int on = 0;
    for (int i = 0; i < 50000; ++i) {
        const std::int64_t reach = random.chance(0.5) ? 3 : std::int64_t{1} << random.below(20);
        std::array<Lattice, 3> l{};
        for (Lattice& point : l) {
            point = randomLattice(random, reach, std::int64_t{1} << 20);
        }
        Lattice p = randomLattice(random, reach, std::int64_t{1} << 20);
        Lattice rest = randomLattice(random, 2, 0);
        if (random.chance(0.5)) {
            p = l[random.below(3)];
            for (std::size_t k = 0; k < 3; ++k) { // on the line of an edge, or slightly off it
                rest.at[k] = 2 * (l[1].at[k] - l[0].at[k]);
            }
            rest.at[0] += static_cast<std::int64_t>(random.below(3)) - 1;
        }
        constexpr int kShift = 40;
        const auto grown = [](Lattice a) {
            for (auto& value : a.at) {
                value <<= kShift;
            }
            return a;
        };
        // Of the three factors of the volume, only the vector to the point has 62 bits.
        const auto minor = [&](std::size_t m, std::size_t n) {
            return axis(l[0], l[1], m) * axis(l[0], l[2], n) -
                   axis(l[0], l[1], n) * axis(l[0], l[2], m);
        };
        Whole volume = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Whole way = axis(grown(l[0]), grown(p), k) + Whole{rest.at[k]};
            volume += way * minor((k + 1) % 3, (k + 2) % 3);
        }
        on += volume == 0 ? 1 : 0;
        const double unit = std::ldexp(1.0, -kShift);
        ASSERT_EQ(sideOfPlane(l[0].point(1.0), l[1].point(1.0), l[2].point(1.0), p.point(1.0),
                              rest.point(unit)),
                  signOf(volume));
    }
    EXPECT_GT(on, 5000);
}

TEST(Predicates, SideOfLineAndDeterminantAreExact)
{
    test::Random random;
    for (int i = 0; i < 200000; ++i) {
        const std::int64_t reach = random.chance(0.5) ? 3 : std::int64_t{1} << random.below(38);
        const Lattice a = randomLattice(random, reach, std::int64_t{1} << 37);
        const Lattice b = randomLattice(random, reach, std::int64_t{1} << 37);
        Lattice p = randomLattice(random, reach, std::int64_t{1} << 37);
        if (random.chance(0.5)) {
            const auto s = static_cast<std::int64_t>(random.below(7)) - 3;
            for (std::size_t k = 0; k < 2; ++k) {
                p.at[k] = a.at[k] + s * (b.at[k] - a.at[k]);
            }
            p.at[0] += static_cast<std::int64_t>(random.below(3)) - 1;
        }
        const Whole cross = axis(a, b, 0) * axis(a, p, 1) - axis(a, b, 1) * axis(a, p, 0);
        const Vec3 da = a.point(0x1p-7);
        const Vec3 db = b.point(0x1p-7);
        const Vec3 dp = p.point(0x1p-7);
        ASSERT_EQ(sideOfLine(da.x, da.y, db.x, db.y, dp.x, dp.y), signOf(cross));
        const Whole determinant = Whole{a.at[0]} * Whole{p.at[1]} - Whole{a.at[1]} * Whole{p.at[0]};
        ASSERT_EQ(signOfDeterminant(da.x, da.y, dp.x, dp.y), signOf(determinant));
    }
}

TEST(Predicates, PointsOfOneLineAreCollinear)
{
    EXPECT_TRUE(areCollinear({0, 0, 0}, {1, 2, 3}, {3, 6, 9}));
    EXPECT_TRUE(areCollinear({1, 1, 1}, {1, 1, 1}, {3, 6, 9}));
    EXPECT_FALSE(areCollinear({0, 0, 0}, {1, 2, 3}, {3, 6, std::nextafter(9.0, 10.0)}));
}

} // namespace
} // namespace marsview
