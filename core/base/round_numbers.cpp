#include "core/base/round_numbers.h"

#include "core/base/check.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace marsview {
namespace {

constexpr std::array kLeads{1.0, 2.0, 5.0};
constexpr double kSlack = 1e-9;

// Dividing by an integer power gives exactly the doubles of the literals 0.5 and 0.1.
double scaled(double lead, int decade)
{
    return decade >= 0 ? lead * std::pow(10.0, decade) : lead / std::pow(10.0, -decade);
}

int decadeOf(double value)
{
    return static_cast<int>(std::floor(std::log10(value * (1.0 + kSlack))));
}

} // namespace

double roundNumberBelow(double value)
{
    MARSVIEW_CHECK(value > 0.0 && std::isfinite(value));
    const int decade = decadeOf(value);
    double below = scaled(1.0, decade);
    for (const double lead : kLeads) {
        const double candidate = scaled(lead, decade);
        if (candidate <= value * (1.0 + kSlack)) {
            below = candidate;
        }
    }
    return below;
}

double roundNumberAbove(double value)
{
    const double below = roundNumberBelow(value);
    if (below >= value * (1.0 - kSlack)) {
        return below;
    }
    const int decade = decadeOf(below);
    for (const double lead : kLeads) {
        const double candidate = scaled(lead, decade);
        if (candidate > below * (1.0 + kSlack)) {
            return candidate;
        }
    }
    return scaled(1.0, decade + 1);
}

int decimalsOf(double round_number)
{
    return std::max(0, -decadeOf(round_number));
}

RoundTicks roundTicks(double low, double high, int count_max)
{
    constexpr double kDigits = 1e-12;
    const double size = std::max(std::abs(low), std::abs(high));
    constexpr double kWidthMin = 1e-300; // smaller values have decimals beyond the range of doubles
    if (!std::isfinite(high - low) || !(high - low > std::max(size * kDigits, kWidthMin)) ||
        count_max < 1) {
        return {};
    }
    // An interval holds at least floor(width / step) multiples and at most one more.
    double step = roundNumberAbove((high - low) / (count_max + 1));
    for (;;) {
        const double first = std::ceil(low / step - kSlack);
        const double last = std::floor(high / step + kSlack);
        if (last - first + 1.0 <= count_max) {
            RoundTicks ticks{.step = step, .values = {}};
            const int count = static_cast<int>(last - first) + 1;
            for (int i = 0; i < count; ++i) {
                const double multiple = first + i;
                // Dividing if the step is a fraction: 3 × 0.1 is not the double 0.3.
                const double value =
                    step < 1.0 ? multiple / std::round(1.0 / step) : multiple * step;
                ticks.values.push_back(std::clamp(value, low, high) + 0.0);
            }
            return ticks;
        }
        step = roundNumberAbove(step * 1.5);
    }
}

} // namespace marsview
