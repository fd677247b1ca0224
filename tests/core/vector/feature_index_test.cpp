#include "core/vector/feature_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>

namespace marsview::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();

bool overlaps(const PlaneBox& a, const PlaneBox& b)
{
    return a.min_x <= b.max_x && b.min_x <= a.max_x && a.min_y <= b.max_y && b.min_y <= a.max_y;
}

FeatureIndex::Resolution within(const PlaneBox& window, double resolution)
{
    return [=](const PlaneBox& box) { return overlaps(box, window) ? resolution : kInfinity; };
}

PlaneFeatures randomDots(std::mt19937& random, std::uint32_t count)
{
    std::uniform_real_distribution<double> even(0.0, 1000.0);
    std::normal_distribution<double> cluster(300.0, 2.0);
    PlaneFeatures features;
    for (std::uint32_t i = 0; i < count; ++i) {
        features.addDot(i, i % 2 == 0 ? PlanePoint{even(random), even(random)}
                                      : PlanePoint{cluster(random), cluster(random)});
    }
    return features;
}

// Away from the nearest segment of the pieces.
double distanceToPieces(const FeatureIndex::Selection& selection, const PlanePoint& p)
{
    double nearest = kInfinity;
    for (const auto& piece : selection.pieces) {
        for (std::size_t i = piece.begin; i + 1 < piece.end; ++i) {
            const PlanePoint a = selection.points[i];
            const PlanePoint b = selection.points[i + 1];
            const double square = std::pow(b.x - a.x, 2) + std::pow(b.y - a.y, 2);
            const double share =
                square > 0.0
                    ? std::clamp(((p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y)) / square,
                                 0.0, 1.0)
                    : 0.0;
            nearest = std::min(nearest, std::hypot(p.x - a.x - share * (b.x - a.x),
                                                   p.y - a.y - share * (b.y - a.y)));
        }
    }
    return nearest;
}

// A coast of 20 000 vertices around (500, 500).
std::vector<PlanePoint> coast()
{
    std::vector<PlanePoint> ring;
    constexpr int kVertices = 20000;
    for (int i = 0; i < kVertices; ++i) {
        const double t = 2.0 * std::numbers::pi * i / kVertices;
        const double r = 300.0 + 40.0 * std::sin(7.0 * t) + 5.0 * std::sin(97.0 * t) +
                         0.5 * std::sin(1501.0 * t);
        ring.push_back({500.0 + r * std::cos(t), 500.0 + r * std::sin(t)});
    }
    ring.push_back(ring.front());
    return ring;
}

} // namespace

TEST(FeatureIndex, SelectsAllDotsOfAWindowAtFullResolution)
{
    std::mt19937 random(1);
    const PlaneFeatures features = randomDots(random, 5000);
    const FeatureIndex index(features);
    const PlaneBox window{250.0, 280.0, 340.0, 420.0};
    std::set<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < 5000; ++i) {
        if (window.distance(features.points[i]) == 0.0) {
            expected.insert(i);
        }
    }
    std::set<std::uint32_t> selected;
    for (const auto& piece : index.select(within(window, 1e-9), kUnlimited).pieces) {
        EXPECT_TRUE(selected.insert(piece.feature).second) << "twice: " << piece.feature;
    }
    EXPECT_EQ(selected, expected);
    EXPECT_GT(expected.size(), 1000U);
}

TEST(FeatureIndex, EveryOmittedDotHasASelectedOneWithinTheResolution)
{
    std::mt19937 random(2);
    const PlaneFeatures features = randomDots(random, 5000);
    const FeatureIndex index(features);
    const PlaneBox all{0.0, 0.0, 1000.0, 1000.0};
    for (const double resolution : {1.0, 10.0, 60.0, 2000.0}) {
        const auto selection = index.select(within(all, resolution), kUnlimited);
        EXPECT_LT(selection.pieces.size(), 5000U);
        for (const PlanePoint& dot : features.points) {
            EXPECT_TRUE(std::any_of(selection.points.begin(), selection.points.end(),
                                    [&](const PlanePoint& shown) {
                                        return std::abs(shown.x - dot.x) <= resolution &&
                                               std::abs(shown.y - dot.y) <= resolution;
                                    }));
        }
    }
}

TEST(FeatureIndex, ZoomingInKeepsTheDotsThatAreSelected)
{
    std::mt19937 random(3);
    const FeatureIndex index(randomDots(random, 5000));
    const PlaneBox all{0.0, 0.0, 1000.0, 1000.0};
    std::set<std::uint32_t> before;
    for (const double resolution : {500.0, 100.0, 20.0, 5.0, 1.0, 0.1}) {
        std::set<std::uint32_t> now;
        for (const auto& piece : index.select(within(all, resolution), kUnlimited).pieces) {
            now.insert(piece.feature);
        }
        EXPECT_TRUE(std::includes(now.begin(), now.end(), before.begin(), before.end()));
        EXPECT_GT(now.size(), before.size());
        before = now;
    }
}

TEST(FeatureIndex, NoVertexIsFartherFromTheSimplifiedLineThanTheResolution)
{
    PlaneFeatures features;
    features.add(0, PlaneShape::Ring, coast());
    const FeatureIndex index(features);
    std::size_t before = 0;
    for (const double resolution : {100.0, 10.0, 1.0, 0.1, 1e-9}) {
        const auto selection =
            index.select(within({0.0, 0.0, 1000.0, 1000.0}, resolution), kUnlimited);
        EXPECT_GE(selection.points.size(), before);
        before = selection.points.size();
        double farthest = 0.0;
        for (std::size_t i = 0; i < features.points.size(); i += 97) {
            farthest = std::max(farthest, distanceToPieces(selection, features.points[i]));
        }
        EXPECT_LE(farthest, resolution * (1.0 + 1e-12));
    }
    EXPECT_EQ(before, features.points.size()) << "all vertices at last";
}

TEST(FeatureIndex, ALineIsSelectedOnlyWhereItIsVisible)
{
    PlaneFeatures features;
    features.add(0, PlaneShape::Ring, coast());
    const FeatureIndex index(features);
    const PlaneBox window{780.0, 450.0, 860.0, 550.0};
    const auto selection = index.select(within(window, 1e-9), kUnlimited);
    EXPECT_LT(selection.points.size(), features.points.size() / 10);
    for (const PlanePoint& vertex : features.points) {
        if (window.distance(vertex) == 0.0) {
            EXPECT_LE(distanceToPieces(selection, vertex), 1e-9);
        }
    }
}

// Of a selection that is looked for from the coarsening of a moment ago.
TEST(FeatureIndex, ALikelyCoarseningChangesNothing)
{
    std::mt19937 random(6);
    const FeatureIndex index(randomDots(random, 5000));
    for (const double resolution : {0.01, 5.0, 1e6}) {
        const auto visible = within({0.0, 0.0, 1000.0, 1000.0}, resolution);
        const auto expected = index.select(visible, 300);
        for (const double likely : {1.0, 1.5, 30.0, 2000.0, 1e15}) {
            const auto selection = index.select(visible, 300, likely);
            EXPECT_EQ(selection.coarsening, expected.coarsening);
            EXPECT_EQ(selection.points, expected.points);
        }
    }
}

TEST(FeatureIndex, ALimitOnPointsMakesTheSelectionCoarserInsteadOfIncomplete)
{
    std::mt19937 random(4);
    const PlaneFeatures features = randomDots(random, 20000);
    const FeatureIndex index(features);
    const auto selection = index.select(within({0.0, 0.0, 1000.0, 1000.0}, 0.01), 500);
    EXPECT_LE(selection.points.size(), 500U);
    EXPECT_GT(selection.points.size(), 50U);
    EXPECT_GT(selection.coarsening, 1.0);
    std::array<int, 4> quarters{};
    for (const PlanePoint& p : selection.points) {
        ++quarters[(p.x > 500.0 ? 1U : 0U) + (p.y > 500.0 ? 2U : 0U)];
    }
    EXPECT_GT(*std::min_element(quarters.begin(), quarters.end()), 5);
}

TEST(FeatureIndex, FindsDotsBeforeBordersAndSmallPolygonsBeforeLargeOnes)
{
    PlaneFeatures features;
    const std::array<PlanePoint, 5> large{{{0, 0}, {100, 0}, {100, 100}, {0, 100}, {0, 0}}};
    const std::array<PlanePoint, 5> hole{{{60, 60}, {90, 60}, {90, 90}, {60, 90}, {60, 60}}};
    const std::array<PlanePoint, 5> small{{{10, 10}, {30, 10}, {30, 30}, {10, 30}, {10, 10}}};
    const std::array<PlanePoint, 2> line{{{0, 50}, {100, 50}}};
    features.add(1, PlaneShape::Ring, large);
    features.add(1, PlaneShape::Ring, hole);
    features.add(2, PlaneShape::Ring, small);
    features.add(3, PlaneShape::Line, line);
    features.addDot(4, {50, 51});
    const FeatureIndex index(features);
    EXPECT_EQ(index.find({20, 20}, 1.0), 2U) << "the smaller polygon";
    EXPECT_EQ(index.find({45, 20}, 1.0), 1U);
    EXPECT_EQ(index.find({75, 75}, 1.0), std::nullopt) << "in the hole";
    EXPECT_EQ(index.find({20, 50.5}, 1.0), 3U) << "the line in the polygon";
    EXPECT_EQ(index.find({50, 50}, 2.0), 4U) << "the dot next to the line";
    EXPECT_EQ(index.find({100.5, 40}, 1.0), 1U) << "just outside the border";
    EXPECT_EQ(index.find({103, 40}, 1.0), std::nullopt);
    EXPECT_EQ(FeatureIndex().find({0, 0}, 1.0), std::nullopt);
}

TEST(FeatureIndex, FindsTheNearestOfManyDots)
{
    std::mt19937 random(5);
    const PlaneFeatures features = randomDots(random, 3000);
    const FeatureIndex index(features);
    std::uniform_real_distribution<double> even(0.0, 1000.0);
    for (int i = 0; i < 200; ++i) {
        const PlanePoint place{even(random), even(random)};
        std::optional<std::uint32_t> nearest;
        double distance = 20.0;
        for (std::uint32_t dot = 0; dot < features.points.size(); ++dot) {
            const double away =
                std::hypot(features.points[dot].x - place.x, features.points[dot].y - place.y);
            if (away <= distance) {
                distance = away;
                nearest = dot;
            }
        }
        EXPECT_EQ(index.find(place, 20.0), nearest);
    }
}

// Brute force over dots, and over the vertices of lines that have points for their course too.
TEST(FeatureIndex, FindsTheNearestVertexButNoPointOfTheCourseOfALine)
{
    std::mt19937 random(6);
    PlaneFeatures features = randomDots(random, 500);
    const std::size_t dot_count = features.points.size();
    const std::vector<PlanePoint> ring = coast();
    std::vector<bool> is_course(ring.size());
    for (std::size_t i = 0; i < ring.size(); ++i) {
        is_course[i] = i % 5 != 0;
    }
    features.add(1000, PlaneShape::Ring, ring, is_course);
    features.addDot(1001, {500.0, 500.0});
    const FeatureIndex index(features);
    const auto is_vertex = [&](std::size_t i) {
        return i < dot_count || i == features.points.size() - 1 || !is_course[i - dot_count];
    };
    std::uniform_real_distribution<double> even(0.0, 1000.0);
    std::uniform_real_distribution<double> beside(-1.0, 1.0);
    constexpr double kReach = 5.0;
    int found = 0;
    for (int i = 0; i < 1000; ++i) {
        PlanePoint place{even(random), even(random)};
        if (i % 2 == 0) { // near the coast
            const PlanePoint& near = ring[static_cast<std::size_t>(i) * 17];
            place = {near.x + beside(random), near.y + beside(random)};
        }
        double distance = kReach;
        std::optional<PlanePoint> nearest;
        for (std::size_t p = 0; p < features.points.size(); ++p) {
            const PlanePoint& point = features.points[p];
            const double away = std::hypot(point.x - place.x, point.y - place.y);
            if (is_vertex(p) && away <= distance) {
                distance = away;
                nearest = point;
            }
        }
        EXPECT_EQ(index.nearestVertex(place, kReach), nearest);
        found += nearest ? 1 : 0;
    }
    EXPECT_GT(found, 300);
    EXPECT_LT(found, 1000);
    EXPECT_EQ(FeatureIndex().nearestVertex({0, 0}, 1.0), std::nullopt);
}

} // namespace marsview::test
