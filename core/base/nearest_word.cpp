#include "core/base/nearest_word.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vector>

namespace marsview {
namespace {

// Words are options and commands; a longer argument is not a mistyped one.
constexpr std::size_t kLettersMax = 64;

std::string inLowerCase(std::string_view word)
{
    std::string lower(word);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return lower;
}

// Optimal string alignment (Damerau-Levenshtein without overlapping swaps).
std::size_t editDistance(const std::string& a, const std::string& b)
{
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) {
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                d[i][j] = i + j;
                continue;
            }
            const std::size_t replaced = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0U : 1U);
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, replaced});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
            }
        }
    }
    return d[a.size()][b.size()];
}

} // namespace

std::string nearestWord(std::string_view word, std::span<const std::string> known)
{
    if (word.empty() || word.size() > kLettersMax) {
        return {};
    }
    const std::string typed = inLowerCase(word);
    const auto letters = static_cast<std::size_t>(std::count_if(
        typed.begin(), typed.end(), [](unsigned char c) { return std::isalnum(c) != 0; }));
    std::size_t least = std::max<std::size_t>(1, letters / 3) + 1;
    std::string nearest;
    for (const std::string& candidate : known) {
        if (candidate.size() > kLettersMax) {
            continue;
        }
        const std::string name = inLowerCase(candidate);
        constexpr std::size_t kBeginningMin = 2;
        const bool is_beginning = letters >= kBeginningMin && name.starts_with(typed);
        const std::size_t distance = is_beginning ? 1 : editDistance(typed, name);
        if (distance < least) {
            least = distance;
            nearest = candidate;
        }
    }
    return nearest;
}

std::string didYouMean(std::string_view word, std::span<const std::string> known)
{
    const std::string nearest = nearestWord(word, known);
    return nearest.empty() ? std::string() : ". Did you mean \"" + nearest + "\"?";
}

std::string didYouMeanOrKnown(std::string_view word, std::span<const std::string> known)
{
    const std::string nearest = didYouMean(word, known);
    return nearest.empty() ? fmt::format("; known ones are {}", fmt::join(known, ", ")) : nearest;
}

} // namespace marsview
