#include "core/graticule/graticule_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace marsview {
namespace {

// The first entry of a ladder that is at least `least`.
template <std::size_t Count>
std::optional<double> firstFrom(const std::array<double, Count>& ladder, double least)
{
    const auto* const found = std::find_if(ladder.begin(), ladder.end(), [least](double entry) {
        return entry >= least * (1.0 - 1e-9);
    });
    return found != ladder.end() ? std::optional(*found) : std::nullopt;
}

} // namespace

Angle graticuleStep(AngleNotation notation, Angle least)
{
    constexpr std::array kDegrees{1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 90.0};
    constexpr std::array kSixtieths{1.0, 2.0, 5.0, 10.0, 20.0, 30.0};
    const double least_deg = least.degrees();
    const auto decimal = [](double value) {
        const double power = std::pow(10.0, std::floor(std::log10(value)));
        for (const double factor : {1.0, 2.0, 5.0}) {
            if (factor * power >= value * (1.0 - 1e-9)) {
                return factor * power;
            }
        }
        return 10.0 * power;
    };
    if (notation == AngleNotation::DegreesMinutesSeconds && least_deg <= 0.5) {
        if (const double seconds = least_deg * 3600.0; seconds <= 30.0) {
            return Angle::degrees(
                firstFrom(kSixtieths, seconds < 1.0 ? 61.0 : seconds).value_or(decimal(seconds)) /
                3600.0);
        }
        return Angle::degrees(firstFrom(kSixtieths, least_deg * 60.0).value_or(30.0) / 60.0);
    }
    if (least_deg <= 0.5) {
        return Angle::degrees(decimal(least_deg));
    }
    return Angle::degrees(firstFrom(kDegrees, least_deg).value_or(90.0));
}

std::optional<GraticuleEnd>
labelEnd(const GraticuleLine& line, const CameraPose& camera, const Viewport& viewport)
{
    std::optional<GraticuleEnd> best;
    double best_score = -1.0;
    constexpr double kPreference = 0.3; // for the lower and the left side, of its length
    for (const ScenePoint& point : line.points) {
        const auto pixel = project(camera, viewport, point);
        if (!pixel || pixel->x < 0.0 || pixel->y < 0.0 || pixel->x > viewport.width ||
            pixel->y > viewport.height) {
            continue;
        }
        const double right = pixel->x - 0.5 * viewport.width;
        const double down = pixel->y - 0.5 * viewport.height;
        const bool is_meridian = line.axis == GraticuleAxis::Meridian;
        const double preferred = is_meridian && down > 0.0     ? kPreference * viewport.height
                                 : !is_meridian && right < 0.0 ? kPreference * viewport.width
                                                               : 0.0;
        if (const double score = std::hypot(right, down) + preferred; score > best_score) {
            best_score = score;
            best = GraticuleEnd{.place = point, .pixel = *pixel};
        }
    }
    return best;
}

} // namespace marsview
