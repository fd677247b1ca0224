// How the area of terrain is distributed over elevations.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace marsview {

/// Area by classes of elevation. The bounds of the classes are whole multiples of their width, so
/// that classes of one and five meters agree where they meet. Empty without terrain.
struct Hypsometry {
    std::int64_t first_class = 0; // the first one begins at first_class · step_m
    double step_m = 0.0;
    std::vector<double> area_m2; // of each class, upward; on the ellipsoid

    bool isEmpty() const noexcept { return area_m2.empty(); }
    /// The lower bound of a class; that of area_m2.size() ends the last one.
    double boundM(std::size_t i) const;
    double totalM2() const;
    /// Area of the terrain above an elevation. Exact at the bounds of classes, linear between them.
    double areaAboveM2(double elevation_m) const;
};

/// At most `classes_max` classes, whose width is the smallest of 1, 2 or 5 times a power of ten
/// that allows it; the same where these would not be wider. For a histogram.
Hypsometry withFewerClasses(const Hypsometry& hypsometry, std::size_t classes_max);

/// Adds up triangles. The area between two elevations is that of the triangles' surface there,
/// exactly: elevation is linear on a triangle, so that the area below a level is a quadratic
/// function of it (J. Strahler, Hypsometric (area-altitude) analysis of erosional topography, 1952,
/// defines the curve).
class HypsometrySum {
public:
    /// The most classes of a width that was chosen.
    static constexpr std::size_t kClassesMax = 100'000;

    /// Without a width, it is a power of ten, by which there are 200 to 2000 classes.
    explicit HypsometrySum(std::optional<double> step_m = {});

    /// A triangle with these elevations at its corners; nothing where they are not finite. Areas
    /// may be negative, to take something away.
    void add(const std::array<double, 3>& elevation_m, double area_m2);
    /// The chosen width is too small for kClassesMax.
    bool isOverfull() const noexcept { return is_overfull_; }
    double stepM() const noexcept { return sum_.step_m; }
    /// What was added. Rounding beyond the lowest and highest elevation goes to the classes there.
    Hypsometry result(double min_m, double max_m) const;

private:
    bool cover(double low_m, double high_m);
    void coarsen();
    double classOf(double elevation_m) const;

    bool is_step_chosen_ = false;
    bool is_overfull_ = false;
    int exponent_ = -6; // of the step, unless it was chosen
    Hypsometry sum_;
};

} // namespace marsview
