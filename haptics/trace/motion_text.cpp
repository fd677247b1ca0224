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
    const auto of = [](const Vec3& v) {
        return fmt::format("{} {} {}", asText(v.x), asText(v.y), asText(v.z));
    };
    return fmt::format("{} {} {} {}", of(motion.from), of(motion.to), asText(motion.scale),
                       motion.body_turn_rad ? of(*motion.body_turn_rad) : asText(motion.turn_rad));
}

std::optional<SceneMotion> parseMotion(std::string_view text)
{
    constexpr std::size_t kInPlane = 8;
    constexpr std::size_t kOnBody = 10;
    std::array<double, kOnBody> numbers{};
    std::size_t count = 0;
    for (bool is_last = false; !is_last; ++count) {
        const std::size_t end = text.find(' ');
        is_last = end == std::string_view::npos;
        const auto number = parseNumber(text.substr(0, end));
        if (count == kOnBody || !number || !std::isfinite(*number)) {
            return std::nullopt;
        }
        numbers[count] = *number;
        text.remove_prefix(is_last ? text.size() : end + 1);
    }
    SceneMotion motion{.from = {numbers[0], numbers[1], numbers[2]},
                       .to = {numbers[3], numbers[4], numbers[5]},
                       .scale = numbers[6]};
    if (count == kInPlane) {
        motion.turn_rad = numbers[7];
    } else if (count == kOnBody) {
        motion.body_turn_rad = Vec3{numbers[7], numbers[8], numbers[9]};
    } else {
        return std::nullopt;
    }
    return motion.scale > 0.0 ? std::optional(motion) : std::nullopt;
}

} // namespace marsview
