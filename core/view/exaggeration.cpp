#include "core/view/exaggeration.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace marsview {
namespace {

constexpr std::array kRoundNumbers{1.0, 1.5, 2.0, 3.0, 5.0, 7.0};

// Relief as a fraction of the extent: smaller relief is exaggerated to kReliefWanted, relief above
// kReliefTooHigh is reduced to kReliefBounded. Between the two it is unchanged.
constexpr double kReliefWanted = 1.0 / 60.0;
constexpr double kReliefTooHigh = 1.0 / 3.0;
constexpr double kReliefBounded = 1.0 / 6.0;

// The index of a factor in the infinite list of round numbers, rounded down, and the inverse.
int placeOf(double factor)
{
    const double decade = std::floor(std::log10(factor) + 1e-9);
    const double lead = factor / std::pow(10.0, decade) * (1.0 + 1e-9);
    const auto above = std::upper_bound(kRoundNumbers.begin(), kRoundNumbers.end(), lead);
    return static_cast<int>(decade) * static_cast<int>(kRoundNumbers.size()) +
           std::max(0, static_cast<int>(above - kRoundNumbers.begin()) - 1);
}

double factorAt(int place)
{
    const int count = static_cast<int>(kRoundNumbers.size());
    const int decade = place >= 0 ? place / count : -((count - 1 - place) / count);
    const auto lead = static_cast<std::size_t>(place - decade * count);
    // Dividing by an integer power gives exactly the doubles of the literals 0.5 and 0.1.
    return decade >= 0 ? kRoundNumbers[lead] * std::pow(10.0, decade)
                       : kRoundNumbers[lead] / std::pow(10.0, -decade);
}

} // namespace

double defaultExaggeration(double extent_m, double relief_m)
{
    const double share = relief_m / extent_m;
    if (!(share > 0.0) || !std::isfinite(share)) {
        return 1.0;
    }
    double wanted = 1.0;
    if (share < kReliefWanted) {
        wanted = std::min(kReliefWanted / share, 20.0);
    } else if (share > kReliefTooHigh) {
        wanted = kReliefBounded / share;
    }
    return std::clamp(factorAt(placeOf(wanted)), kExaggerationMin, kExaggerationMax);
}

double steppedExaggeration(double exaggeration, int steps)
{
    const double bounded = std::clamp(exaggeration, kExaggerationMin, kExaggerationMax);
    int place = placeOf(bounded);
    if (steps < 0 && factorAt(place) < bounded * (1.0 - 1e-6)) {
        ++place; // the round number below is itself a step away
    }
    return std::clamp(factorAt(place + steps), kExaggerationMin, kExaggerationMax);
}

ExaggerationRange exaggerationRange(double suitable)
{
    ExaggerationRange range;
    if (suitable < range.least) {
        range.least = steppedExaggeration(suitable, -static_cast<int>(kRoundNumbers.size()));
    }
    if (suitable > range.most) {
        range.most = steppedExaggeration(suitable, static_cast<int>(kRoundNumbers.size()));
    }
    return range;
}

OrbitCamera reexaggerated(OrbitCamera camera, double from, double to)
{
    camera.target.z *= to / from;
    return camera;
}

} // namespace marsview
