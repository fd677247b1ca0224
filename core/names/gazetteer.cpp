#include "core/names/gazetteer.h"

#include "core/base/nearest_word.h"
#include "core/names/search_text.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace marsview {
namespace {

enum class Match { Whole, Begin, Word, Inside, None };

Match matchOf(std::string_view key, std::string_view text)
{
    const std::size_t at = key.find(text);
    if (at == std::string_view::npos) {
        return Match::None;
    }
    if (at == 0) {
        return key.size() == text.size() ? Match::Whole : Match::Begin;
    }
    return key.find(' ' + std::string(text)) != std::string_view::npos ? Match::Word
                                                                       : Match::Inside;
}

// The extent that a name is ranked by: long or flat features are less conspicuous than mountains
// and craters of their extent. Olympus Mons comes before the scarp around it, which is three times
// as long.
double prominenceM(const PlaceName& name)
{
    constexpr double kLongShare = 0.25;
    switch (name.kind) {
    case PlaceKind::CraterChain:
    case PlaceKind::Dunes:
    case PlaceKind::Ridge:
    case PlaceKind::Scarp:
    case PlaceKind::Trough:
    case PlaceKind::Valley:
        return kLongShare * name.diameter_m;
    default:
        return name.diameter_m;
    }
}

} // namespace

Gazetteer::Gazetteer(const Body* body, std::vector<PlaceName> names)
    : body_(body)
    , names_(std::move(names))
{
    std::stable_sort(names_.begin(), names_.end(), [](const PlaceName& a, const PlaceName& b) {
        return a.diameter_m > b.diameter_m;
    });
    has_sizes_ = !names_.empty() && names_.front().diameter_m > 0.0;
    keys_.reserve(names_.size());
    for (const PlaceName& name : names_) {
        keys_.push_back(searchText(name.name));
    }
}

std::vector<std::size_t> Gazetteer::find(std::string_view text, std::size_t count_max) const
{
    const std::string wanted = searchText(text);
    if (wanted.empty()) {
        return {};
    }
    // The last element refers to names_, the largest first.
    using Rank = std::tuple<Match, bool, double, std::size_t>;
    std::vector<Rank> found;
    for (std::size_t i = 0; i < keys_.size(); ++i) {
        const Match match = matchOf(keys_[i], wanted);
        if (match != Match::None) {
            found.emplace_back(match, names_[i].kind == PlaceKind::LetteredCrater,
                               -prominenceM(names_[i]), i);
        }
    }
    const std::size_t count = std::min(count_max, found.size());
    std::partial_sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count),
                      found.end());
    std::vector<std::size_t> indexes;
    for (std::size_t i = 0; i < count; ++i) {
        indexes.push_back(std::get<std::size_t>(found[i]));
    }
    return indexes;
}

std::string Gazetteer::nearest(std::string_view text) const
{
    const std::string key = nearestWord(searchText(text), keys_);
    const auto found = key.empty() ? keys_.end() : std::find(keys_.begin(), keys_.end(), key);
    return found == keys_.end() ? std::string()
                                : names_[static_cast<std::size_t>(found - keys_.begin())].name;
}

} // namespace marsview
