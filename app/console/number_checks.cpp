#include "app/console/number_checks.h"

#include "core/base/nearest_word.h"
#include "core/base/plain_number.h"
#include "core/files/file_address.h"
#include "core/view/exaggeration.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

namespace marsview {
namespace {

// Rejects texts that are not numbers, and numbers for which `is_valid` is false.
template <typename IsValid>
CLI::Validator numberCheck(const IsValid& is_valid, const std::string& wanted)
{
    return {[is_valid, wanted](std::string& text) {
                const std::optional<double> value = parseNumber(text);
                if (!value) {
                    return fmt::format("\"{}\" is not a number", text);
                }
                return is_valid(*value) ? std::string()
                                        : fmt::format("{} is not a {}", text, wanted);
            },
            ""};
}

std::string lowered(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

} // namespace

CLI::Validator anyNumber()
{
    return numberCheck([](double) { return true; }, "number");
}

CLI::Validator finiteNumber()
{
    return numberCheck([](double value) { return std::isfinite(value); }, "finite number");
}

CLI::Validator positiveNumber()
{
    return numberCheck([](double value) { return std::isfinite(value) && value > 0.0; },
                       "positive number");
}

CLI::Validator nonZeroNumber()
{
    return numberCheck([](double value) { return std::isfinite(value) && value != 0.0; },
                       "finite number other than 0");
}

CLI::Validator numberFrom(double low, double high)
{
    return numberCheck([low, high](double value) { return value >= low && value <= high; },
                       fmt::format("number from {} to {}", low, high));
}

CLI::Validator exaggerationFactor()
{
    return numberFrom(kExaggerationMin, kExaggerationMax);
}

CLI::Validator wholeNumberFrom(std::uint64_t low, std::uint64_t high)
{
    return {[low, high](std::string& text) {
                std::uint64_t value = 0;
                const char* const end = text.data() + text.size();
                const auto [last, failure] = std::from_chars(text.data(), end, value);
                const bool is_valid =
                    failure == std::errc{} && last == end && value >= low && value <= high;
                return is_valid ? std::string()
                                : fmt::format("\"{}\" is not a whole number from {} to {}", text,
                                              low, high);
            },
            ""};
}

CLI::Validator oneOf(std::vector<std::string> words)
{
    const std::string all = fmt::format("{}", fmt::join(words, ", "));
    const std::string description = fmt::format("{{{}}}", fmt::join(words, ","));
    return {[words = std::move(words), all](std::string& text) {
                return std::find(words.begin(), words.end(), text) != words.end()
                           ? std::string()
                           : fmt::format("\"{}\" is not one of {}{}", text, all,
                                         didYouMean(text, words));
            },
            description};
}

CLI::Validator someText()
{
    return {[](std::string& text) {
                return text.find_first_not_of(" \t\r\n") != std::string::npos
                           ? std::string()
                           : std::string("the text is empty");
            },
            ""};
}

CLI::Validator fileName()
{
    return {[](std::string& name) {
                Result<std::string> path = localPathOf(name);
                if (!path) {
                    return path.error().message;
                }
                name = std::move(path).value();
                return std::string();
            },
            ""};
}

CLI::Validator fileNameEndingIn(std::vector<std::string> endings)
{
    return {[endings = std::move(endings)](std::string& text) {
                return std::any_of(endings.begin(), endings.end(),
                                   [&text](const std::string& ending) {
                                       return text.size() > ending.size() &&
                                              lowered(text).ends_with(ending);
                                   })
                           ? std::string()
                           : fmt::format(
                                 "\"{}\" does not end in {}; other formats are not "
                                 "written",
                                 text, fmt::join(endings, " or "));
            },
            ""};
}

} // namespace marsview
