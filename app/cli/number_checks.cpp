#include "app/cli/number_checks.h"

#include <charconv>
#include <cmath>
#include <string>
#include <system_error>

namespace marsview {
namespace {

// Refuses the numbers that `is_wanted` does not; what is no number is for the option to refuse.
template <typename IsWanted>
CLI::Validator numberCheck(const IsWanted& is_wanted, const char* wanted)
{
    return {[is_wanted, wanted](std::string& text) {
                double value = 0.0;
                return CLI::detail::lexical_cast(text, value) && !is_wanted(value)
                           ? text + " is no " + wanted
                           : std::string();
            },
            ""};
}

} // namespace

CLI::Validator finiteNumber()
{
    return numberCheck([](double value) { return std::isfinite(value); }, "finite number");
}

CLI::Validator positiveNumber()
{
    return numberCheck([](double value) { return std::isfinite(value) && value > 0.0; },
                       "positive number");
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
