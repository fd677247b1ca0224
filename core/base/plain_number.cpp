#include "core/base/plain_number.h"

#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <system_error>

namespace marsview {

std::string asText(double value)
{
    if (std::isnan(value)) {
        return "nan";
    }
    return fmt::format("{:#}", value);
}

std::optional<double> parseNumber(std::string_view word)
{
    if (word.starts_with('+')) {
        word.remove_prefix(1);
    }
    double value = 0.0;
    const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (failure != std::errc{} || end != word.data() + word.size()) {
        return std::nullopt;
    }
    return value;
}

} // namespace marsview
