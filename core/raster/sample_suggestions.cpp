#include "core/raster/sample_suggestions.h"

#include "core/geo/known_elevations.h"

#include <cmath>
#include <fmt/format.h>

namespace marsview {
namespace {

KnownElevations ofEarth()
{
    return *knownElevations(*bodyNamed("Earth"));
}

std::string reasonOf(const ElevationMisfit& misfit)
{
    const bool is_high = misfit.elevation_m > misfit.limit_m;
    const bool has_article = misfit.body == "Moon" || misfit.body == "Earth";
    return fmt::format("the elevations reach {:.0f} m, but the {} place on {}{} is at {:.0f} m",
                       misfit.elevation_m, is_high ? "highest" : "lowest",
                       has_article ? "the " : "", misfit.body, misfit.limit_m);
}

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
            is_high ? ofEarth().highest_m : ofEarth().lowest_m);
    }
    return fmt::format("the elevations may be in {}, the unit of the CRS", suggestion.unit.name);
}

} // namespace

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
        if (!canBeOn(*info.body, value * suggestion.unit.meters)) {
            return std::nullopt; // not feet either
        }
        if (!suggestion.implausible_m && !canBeOn(*info.body, value * info.unit.meters)) {
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

bool isIsolated(const SampleStatistics& statistics, SampleEnd end, double share_of_rest)
{
    const bool is_high = end == SampleEnd::Highest;
    const double next = is_high ? statistics.raw_next_maximum : statistics.raw_next_minimum;
    const double gap = is_high ? statistics.raw_maximum - next : next - statistics.raw_minimum;
    const double rest = statistics.raw_next_maximum - statistics.raw_next_minimum;
    return !std::isfinite(next) || gap > share_of_rest * rest;
}

std::optional<ElevationMisfit> findMisfit(const RasterInfo& info,
                                          const SampleStatistics& statistics)
{
    const auto known = info.body != nullptr ? knownElevations(*info.body) : std::nullopt;
    if (!known || info.unit_suggestion) {
        return std::nullopt;
    }
    struct End {
        SampleEnd end;
        double raw;
        double next;
    };
    for (const End& end :
         {End{SampleEnd::Highest, statistics.raw_maximum, statistics.raw_next_maximum},
          End{SampleEnd::Lowest, statistics.raw_minimum, statistics.raw_next_minimum}}) {
        const double elevation_m = info.elevationScale().height(end.raw);
        if (end.raw == info.nodata_suggestion ||
            canBeOn(*info.body, elevation_m, info.reference_radius_m)) {
            continue;
        }
        // A mark of nodata is one value far from the rest, which are elevations.
        constexpr double kFarShare = 0.05;
        const bool is_mark =
            !std::isfinite(end.next) ||
            (isIsolated(statistics, end.end, kFarShare) &&
             canBeOn(*info.body, info.elevationScale().height(end.next), info.reference_radius_m));
        if (!is_mark) {
            return ElevationMisfit{.elevation_m = elevation_m,
                                   .limit_m =
                                       elevation_m > 0.0 ? known->highest_m : known->lowest_m,
                                   .body = std::string(info.body->name)};
        }
    }
    return std::nullopt;
}

void noteElevations(RasterInfo& info, const SampleStatistics& statistics)
{
    noteUnit(info, statistics);
    info.elevation_misfit = findMisfit(info, statistics);
    if (info.elevation_misfit) {
        info.notices.push_back(noticeOf(*info.elevation_misfit));
    }
}

std::string noticeOf(const ElevationMisfit& misfit)
{
    return reasonOf(misfit) +
           "; a scale or a unit may be missing, or the map shows another body; "
           "set the scale, the unit or the body";
}

std::string optionNoticeOf(const ElevationMisfit& misfit)
{
    return reasonOf(misfit) +
           "; a scale or a unit may be missing, or the map shows another body; "
           "set --scale, --unit or --body";
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
