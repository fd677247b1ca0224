#include "core/raster/sample_suggestions.h"

#include <cmath>
#include <fmt/format.h>

namespace marsview {
namespace {

// Mount Everest (2020 survey) and the Challenger Deep.
constexpr double kEarthHighestM = 8849.0;
constexpr double kEarthLowestM = -10935.0;

bool isUnitOfCrs(const VerticalUnit& unit, const RasterInfo& info)
{
    constexpr double kSameShare = 1e-7; // the two feet differ by 2e-6
    return info.crs && info.crs->kind() == CrsKind::Projected &&
           std::abs(info.crs->unit() / unit.meters - 1.0) < kSameShare;
}

std::string reasonOf(const UnitSuggestion& suggestion)
{
    if (suggestion.implausible_m) {
        const bool is_high = *suggestion.implausible_m > 0.0;
        return fmt::format(
            "the elevations look like feet: read as meters they reach {:.0f} m, and the "
            "Earth's {} place is at {} m",
            *suggestion.implausible_m, is_high ? "highest" : "lowest",
            is_high ? kEarthHighestM : kEarthLowestM);
    }
    return fmt::format("the elevations may be in {}, the unit of the CRS", suggestion.unit.name);
}

} // namespace

bool isOnEarth(double elevation_m)
{
    constexpr double kTolerance = 1.01; // for the datum and for noise of single samples
    return elevation_m <= kEarthHighestM * kTolerance && elevation_m >= kEarthLowestM * kTolerance;
}

std::optional<double> certainNodata(const RasterInfo& info)
{
    // The highest place known is Olympus Mons, 21.2 km. Deep-sea trenches reach to -10.9 km, but a
    // map whose lowest sample there is exactly -9999 m is not to be expected.
    constexpr double kLowestM = -9990.0;
    constexpr double kHighestM = 25000.0;
    if (!info.nodata_suggestion) {
        return std::nullopt;
    }
    const double height_m = info.elevationScale().height(*info.nodata_suggestion);
    return height_m > kLowestM && height_m < kHighestM ? std::nullopt : info.nodata_suggestion;
}

std::optional<UnitSuggestion> suggestUnit(const RasterInfo& info,
                                          const SampleStatistics& statistics)
{
    if (info.is_unit_declared || info.reference_radius_m || info.body == nullptr ||
        info.body != bodyNamed("Earth")) {
        return std::nullopt;
    }
    const VerticalUnit foot = *verticalUnitFrom("ft");
    const VerticalUnit survey_foot = *verticalUnitFrom("US survey ft");
    const bool has_survey_feet = isUnitOfCrs(survey_foot, info);
    UnitSuggestion suggestion{.unit = has_survey_feet ? survey_foot : foot,
                              .implausible_m = std::nullopt};
    for (const double raw : {statistics.raw_maximum, statistics.raw_minimum}) {
        const double value = raw * info.scale + info.offset;
        if (raw == info.nodata_suggestion) {
            continue;
        }
        if (!isOnEarth(value * suggestion.unit.meters)) {
            return std::nullopt; // not feet either
        }
        if (!suggestion.implausible_m && !isOnEarth(value * info.unit.meters)) {
            suggestion.implausible_m = value * info.unit.meters;
        }
    }
    const bool is_in_feet = has_survey_feet || isUnitOfCrs(foot, info);
    return suggestion.implausible_m || is_in_feet ? std::optional(suggestion) : std::nullopt;
}

void noteUnit(RasterInfo& info, const SampleStatistics& statistics)
{
    info.unit_suggestion = suggestUnit(info, statistics);
    if (info.unit_suggestion) {
        info.notices.push_back(noticeOf(*info.unit_suggestion));
    }
}

std::string noticeOf(const UnitSuggestion& suggestion)
{
    return fmt::format(
        "no unit of elevation in the file, and {}; set the unit {}; until then, "
        "meters are assumed",
        reasonOf(suggestion), suggestion.unit.name);
}

std::string optionNoticeOf(const UnitSuggestion& suggestion)
{
    const std::string& name = suggestion.unit.name;
    const std::string quoted =
        name.find(' ') == std::string::npos ? name : fmt::format("\"{}\"", name);
    return fmt::format(
        "no unit of elevation in the file, and {}; set the unit with --unit {}; "
        "until then, meters are assumed",
        reasonOf(suggestion), quoted);
}

} // namespace marsview
