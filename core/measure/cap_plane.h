// The triangles that close a map at a pole, in the plane of the circle of samples around it.
#pragma once

#include "core/terrain/pole_cap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace marsview {

/// The triangles of a PoleCap as seen along the body's axis. The pole is the origin, the samples of
/// the circle have distance 1 and follow each other counter-clockwise. Immutable; any thread.
class CapPlane {
public:
    struct Point {
        double x = 0.0;
        double y = 0.0;

        friend Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y}; }
        friend Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y}; }
        friend Point operator*(const Point& a, double s) { return {a.x * s, a.y * s}; }
    };
    static double cross(const Point& a, const Point& b) noexcept { return a.x * b.y - a.y * b.x; }

    /// The samples of the circle as shares of a turn, in [0, 1), ascending: at least 3.
    explicit CapPlane(const std::vector<double>& turns);

    const PoleCap& shape() const noexcept { return shape_; }
    /// The number of samples of the circle.
    std::size_t size() const noexcept { return circle_.size(); }
    /// The point at a share of the distance from the pole to the circle, above the edge from a
    /// sample to the next one, of which `u` is the share in longitude. What lies beyond the edge,
    /// between it and the circle, is put on it: with `share` 1 this is the edge's point at `u`.
    Point at(std::size_t sample, double u, double share) const noexcept;
    Point vertex(std::uint32_t vertex) const noexcept
    {
        const PoleCap::Place place = shape_.placeOf(vertex);
        return vertex < circle_.size() ? circle_[vertex] : circle_[place.sample] * place.share;
    }
    /// The triangle with a point that at() puts above the edge from a sample; at an edge, one of
    /// the two.
    std::uint32_t faceAt(std::size_t sample, const Point& point) const noexcept;
    /// What the corners of a face contribute at a point of its plane: their sum is 1.
    std::array<double, 3> weights(std::uint32_t face, const Point& point) const noexcept;

    /// Elevations, from those of the circle, `at_circle(sample)`, and of the pole. They are linear
    /// along each of the ways from the pole to the samples of the circle.
    template <typename F>
    double poleHeight(F&& at_circle) const
    {
        double sum_m = 0.0;
        for (std::uint32_t i = 0; i < shape_.poleSampleCount(); ++i) {
            sum_m += at_circle(shape_.poleSample(i));
        }
        return sum_m / shape_.poleSampleCount();
    }
    template <typename F>
    std::array<double, 3> cornerHeights(std::uint32_t face, double pole_m, F&& at_circle) const
    {
        std::array<double, 3> heights{};
        for (std::size_t i = 0; i < heights.size(); ++i) {
            const std::uint32_t number = shape_.face(face)[i];
            if (number < circle_.size()) {
                heights[i] = at_circle(number);
                continue;
            }
            const PoleCap::Place place = shape_.placeOf(number);
            heights[i] = place.share == 0.0
                             ? pole_m
                             : pole_m + (at_circle(place.sample) - pole_m) * place.share;
        }
        return heights;
    }
    /// At a point of a face; NaN if a corner that counts there is void.
    template <typename F>
    double height(std::uint32_t face, const Point& point, double pole_m, F&& at_circle) const
    {
        constexpr double kRounding = 1e-9;
        const std::array<double, 3> heights = cornerHeights(face, pole_m, at_circle);
        const std::array<double, 3> shares = weights(face, point);
        double sum_m = 0.0;
        for (std::size_t i = 0; i < heights.size(); ++i) {
            sum_m += std::isnan(heights[i]) && std::abs(shares[i]) < kRounding
                         ? 0.0
                         : shares[i] * heights[i];
        }
        return sum_m;
    }

    /// Follows the straight line between two points of the cap from triangle to triangle, from
    /// `face`, which has the first one. Calls leave(face, share of the line) where it leaves a
    /// triangle. Returns the triangle of the second point. Through a vertex, or along an edge, it
    /// takes triangles on either side, some of them for no length.
    template <typename F>
    std::uint32_t walk(std::uint32_t face, const Point& from, const Point& to, F&& leave) const
    {
        const Point along = to - from;
        double share = 0.0;
        // No triangle comes twice in one direction: the bound is against rounding.
        for (std::uint32_t i = 0; i < shape_.faceCount(); ++i) {
            const Exit exit = exitOf(face, from, along);
            if (!(exit.share < 1.0)) {
                break;
            }
            share = std::max(share, exit.share);
            leave(face, share);
            face = exit.face;
        }
        return face;
    }

private:
    struct Exit {
        double share = 1.0; // of the line; 1: it ends before
        std::uint32_t face = 0;
    };
    Exit exitOf(std::uint32_t face, const Point& from, const Point& along) const noexcept;
    std::array<Point, 3> corners(std::uint32_t face) const noexcept;

    PoleCap shape_;
    std::vector<Point> circle_;
};

} // namespace marsview
