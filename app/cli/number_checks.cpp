#include "app/cli/number_checks.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

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

} // namespace marsview
