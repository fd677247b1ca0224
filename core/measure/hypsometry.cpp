#include "core/measure/hypsometry.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace marsview {
namespace {

constexpr std::size_t kAutomaticClassesMax = 2000;
constexpr double kClassNumberMax = 1e15; // whole numbers are exact in a double

// 10^exponent times `factor`, correctly rounded for small whole factors.
double decimal(double factor, int exponent)
{
    return exponent >= 0 ? factor * std::pow(10.0, exponent) : factor / std::pow(10.0, -exponent);
}

std::int64_t floorDivided(std::int64_t number, std::int64_t divisor)
{
    return number >= 0 ? number / divisor : -((-number + divisor - 1) / divisor);
}

// Classes of `factor` times the width.
Hypsometry merged(const Hypsometry& from, std::int64_t factor, double step_m)
{
    Hypsometry to;
    to.step_m = step_m;
    to.first_class = floorDivided(from.first_class, factor);
    for (std::size_t i = 0; i < from.area_m2.size(); ++i) {
        const auto index = static_cast<std::size_t>(
            floorDivided(from.first_class + static_cast<std::int64_t>(i), factor) - to.first_class);
        to.area_m2.resize(std::max(to.area_m2.size(), index + 1));
        to.area_m2[index] += from.area_m2[i];
    }
    return to;
}

// Of a triangle with these elevations, ascending: the share that lies below `level`.
double shareBelow(const std::array<double, 3>& z, double level)
{
    if (level <= z[0]) {
        return 0.0;
    }
    if (level >= z[2]) {
        return 1.0;
    }
    if (level < z[1]) {
        const double d = level - z[0];
        return d * d / ((z[1] - z[0]) * (z[2] - z[0]));
    }
    const double d = z[2] - level;
    return 1.0 - d * d / ((z[2] - z[1]) * (z[2] - z[0]));
}

} // namespace

double Hypsometry::boundM(std::size_t i) const
{
    const auto number = static_cast<double>(first_class + static_cast<std::int64_t>(i));
    // 0.1 has no exact value, ten does.
    const double inverse = std::round(1.0 / step_m);
    return step_m < 1.0 && std::abs(inverse * step_m - 1.0) < 1e-12 ? number / inverse
                                                                    : number * step_m;
}

double Hypsometry::totalM2() const
{
    return std::accumulate(area_m2.begin(), area_m2.end(), 0.0);
}

double Hypsometry::areaAboveM2(double elevation_m) const
{
    double above_m2 = 0.0;
    for (std::size_t i = area_m2.size(); i-- > 0;) {
        const double low = boundM(i);
        if (elevation_m > low) {
            const double share = (boundM(i + 1) - elevation_m) / step_m;
            return above_m2 + std::clamp(share, 0.0, 1.0) * area_m2[i];
        }
        above_m2 += area_m2[i];
    }
    return above_m2;
}

Hypsometry withFewerClasses(const Hypsometry& hypsometry, std::size_t classes_max)
{
    if (hypsometry.area_m2.size() <= std::max<std::size_t>(classes_max, 1)) {
        return hypsometry;
    }
    for (std::int64_t power = 1;; power *= 10) {
        for (const std::int64_t factor : {power, 2 * power, 5 * power}) {
            Hypsometry fewer =
                merged(hypsometry, factor, static_cast<double>(factor) * hypsometry.step_m);
            if (fewer.area_m2.size() <= classes_max || fewer.area_m2.size() <= 2) {
                return fewer; // two may meet at zero, whatever their width
            }
        }
    }
}

HypsometrySum::HypsometrySum(std::optional<double> step_m)
    : is_step_chosen_(step_m.has_value())
{
    sum_.step_m = step_m.value_or(decimal(1.0, exponent_));
}

double HypsometrySum::classOf(double elevation_m) const
{
    const double number = std::floor(elevation_m / sum_.step_m);
    // The quotient is rounded: an elevation at a bound belongs to the class above it.
    Hypsometry at;
    at.step_m = sum_.step_m;
    if (std::abs(number) > kClassNumberMax) {
        return number;
    }
    at.first_class = static_cast<std::int64_t>(number);
    return at.boundM(1) <= elevation_m  ? number + 1.0
           : at.boundM(0) > elevation_m ? number - 1.0
                                        : number;
}

void HypsometrySum::coarsen()
{
    ++exponent_;
    const double step_m = decimal(1.0, exponent_);
    if (sum_.area_m2.empty()) {
        sum_.step_m = step_m;
    } else {
        sum_ = merged(sum_, 10, step_m);
    }
}

// Makes classes for these elevations; false if there would be too many.
bool HypsometrySum::cover(double low_m, double high_m)
{
    const auto count_max =
        static_cast<double>(is_step_chosen_ ? kClassesMax : kAutomaticClassesMax);
    while (true) {
        const double low = classOf(low_m);
        const double high = classOf(high_m);
        const bool is_first = sum_.area_m2.empty();
        const auto begin = static_cast<double>(sum_.first_class);
        const double from = is_first ? low : std::min(low, begin);
        const double to =
            is_first ? high
                     : std::max(high, begin + static_cast<double>(sum_.area_m2.size()) - 1.0);
        if (to - from + 1.0 <= count_max && std::abs(from) < kClassNumberMax &&
            std::abs(to) < kClassNumberMax) {
            const auto first = static_cast<std::int64_t>(from);
            const auto count = static_cast<std::size_t>(to - from + 1.0);
            if (!is_first && first < sum_.first_class) {
                sum_.area_m2.insert(sum_.area_m2.begin(),
                                    static_cast<std::size_t>(sum_.first_class - first), 0.0);
            }
            sum_.first_class = first;
            sum_.area_m2.resize(count);
            return true;
        }
        if (is_step_chosen_) {
            is_overfull_ = true;
            return false;
        }
        coarsen();
    }
}

void HypsometrySum::add(const std::array<double, 3>& elevation_m, double area_m2)
{
    std::array<double, 3> z = elevation_m;
    if (!std::isfinite(z[0] + z[1] + z[2]) || area_m2 == 0.0 || is_overfull_) {
        return;
    }
    std::sort(z.begin(), z.end());
    if (!cover(z[0], z[2])) {
        return;
    }
    const auto first =
        static_cast<std::size_t>(static_cast<std::int64_t>(classOf(z[0])) - sum_.first_class);
    const auto last =
        static_cast<std::size_t>(static_cast<std::int64_t>(classOf(z[2])) - sum_.first_class);
    double below = 0.0;
    for (std::size_t i = first; i < last; ++i) {
        const double share = shareBelow(z, sum_.boundM(i + 1));
        sum_.area_m2[i] += (share - below) * area_m2;
        below = share;
    }
    sum_.area_m2[last] += (1.0 - below) * area_m2;
}

Hypsometry HypsometrySum::result(double min_m, double max_m) const
{
    if (sum_.area_m2.empty() || !(min_m <= max_m)) {
        return {};
    }
    Hypsometry result;
    result.step_m = sum_.step_m;
    const auto end = sum_.first_class + static_cast<std::int64_t>(sum_.area_m2.size()) - 1;
    const auto number = [&](double elevation_m) {
        return static_cast<std::int64_t>(std::clamp(
            classOf(elevation_m), static_cast<double>(sum_.first_class), static_cast<double>(end)));
    };
    result.first_class = number(min_m);
    const std::int64_t last = number(max_m);
    result.area_m2.resize(static_cast<std::size_t>(last - result.first_class + 1));
    for (std::size_t i = 0; i < sum_.area_m2.size(); ++i) {
        const std::int64_t kept =
            std::clamp(sum_.first_class + static_cast<std::int64_t>(i), result.first_class, last);
        result.area_m2[static_cast<std::size_t>(kept - result.first_class)] += sum_.area_m2[i];
    }
    // Regions that cancel leave rounding.
    for (double& area : result.area_m2) {
        area = std::max(area, 0.0);
    }
    return result;
}

} // namespace marsview
