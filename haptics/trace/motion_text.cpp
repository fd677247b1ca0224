#include "haptics/trace/motion_text.h"

#include "core/base/plain_number.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>

namespace marsview {
namespace {

constexpr std::array<std::string_view, 4> kNames{"hover", "press", "pan", "zoom"};

} // namespace

std::string_view stylusModeName(StylusMode mode) noexcept
{
    return kNames[static_cast<std::size_t>(mode)];
}

std::optional<StylusMode> stylusMode(std::string_view name) noexcept
{
    const auto found = std::find(kNames.begin(), kNames.end(), name);
    return found == kNames.end() ? std::nullopt
                                 : std::optional(static_cast<StylusMode>(found - kNames.begin()));
}

std::string motionText(const SceneMotion& motion)
{
    return fmt::format("{} {} {} {} {} {} {} {}", asText(motion.from.x), asText(motion.from.y),
                       asText(motion.from.z), asText(motion.to.x), asText(motion.to.y),
                       asText(motion.to.z), asText(motion.scale), asText(motion.turn_rad));
}

std::optional<SceneMotion> parseMotion(std::string_view text)
{
    std::array<double, 8> numbers{};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::size_t end = text.find(' ');
        if ((end == std::string_view::npos) != (i + 1 == numbers.size())) {
            return std::nullopt;
        }
        const auto number = parseNumber(text.substr(0, end));
        if (!number || !std::isfinite(*number)) {
            return std::nullopt;
        }
        numbers[i] = *number;
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    const SceneMotion motion{.from = {numbers[0], numbers[1], numbers[2]},
                             .to = {numbers[3], numbers[4], numbers[5]},
                             .scale = numbers[6],
                             .turn_rad = numbers[7]};
    return motion.scale > 0.0 ? std::optional(motion) : std::nullopt;
}

} // namespace marsview
