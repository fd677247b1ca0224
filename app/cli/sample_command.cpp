// marsview-cli sample: elevations of the surface at single positions.

#include "app/cli/commands.h"
#include "app/console/map_options.h"
#include "app/console/number_checks.h"
#include "app/console/text_output.h"
#include "core/base/bounded_text.h"
#include "core/levels/level_file_use.h"
#include "core/raster/sample_suggestions.h"
#include "core/terrain/surface_reader.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

namespace marsview {
namespace {

using Json = nlohmann::ordered_json;

enum class PositionFrame { Map, LonLat, Pixel };

struct SampleOptions {
    MapOptions map;
    PositionFrame frame = PositionFrame::Map;
    std::pair<double, double> position;
    bool is_stdin = false;
    bool is_json = false;
};

struct Position {
    double first = 0.0;
    double second = 0.0;
};

// Null unless both are numbers.
Json pairJson(double first, double second)
{
    return std::isfinite(first) && std::isfinite(second) ? Json::array({first, second})
                                                         : Json(nullptr);
}

class Sampler {
public:
    // `tiles`: of the raster, where a level file verifies them; may be null.
    Sampler(OpenRaster& raster,
            const SampleOptions& options,
            std::shared_ptr<const TileSource> tiles)
        : info_(raster.info)
        , georeference_(georeferenceOf(raster.info))
        , reader_(raster.file, raster.info, georeference_, std::move(tiles))
        , frame_(options.frame)
        , latitude_kind_(options.map.latitudeKind(raster.info.body))
        , is_json_(options.is_json)
        , scale_(raster.info.elevationScale())
    {}

    Status print(Position position)
    {
        constexpr double kLatitudeMax = 90.0;
        if (frame_ == PositionFrame::LonLat && std::abs(position.second) > kLatitudeMax &&
            impossible_latitude_ == 0.0) {
            impossible_latitude_ = position.second;
        }
        Result<double> height = heightAt(position);
        if (!height) {
            return std::move(height).error();
        }
        if (std::isfinite(*height)) {
            const double raw = (*height - scale_.offset_m) / scale_.gain;
            ++statistics_.sample_count;
            statistics_.raw_minimum = std::min(statistics_.raw_minimum, raw);
            statistics_.raw_maximum = std::max(statistics_.raw_maximum, raw);
        }
        if (is_json_) {
            printJson(withSchema(asReport(position, *height)), JsonLayout::OneLine);
        } else {
            printLine(asText(*height));
        }
        return Done{};
    }

    /// Of what was printed.
    const SampleStatistics& statistics() const noexcept { return statistics_; }
    /// The first one that no place has, in degrees; 0 if there was none.
    double impossibleLatitude() const noexcept { return impossible_latitude_; }

private:
    Result<double> heightAt(Position p)
    {
        switch (frame_) {
        case PositionFrame::Pixel:
            return reader_.height(GridPoint{p.first, p.second});
        case PositionFrame::Map:
            return reader_.height(georeference_.toGrid(MapPoint{p.first, p.second}));
        case PositionFrame::LonLat:
            return reader_.height(geographic(p));
        }
        MARSVIEW_CHECK(false);
    }

    GeographicPoint geographic(Position p) const
    {
        const Angle latitude = Angle::degrees(p.second);
        return {Angle::degrees(p.first), latitude_kind_ == LatitudeKind::Planetographic
                                             ? info_.crs->ellipsoid()->planetocentric(latitude)
                                             : latitude};
    }

    Json asReport(Position p, double height_m) const
    {
        Json json;
        json["height"] = asJson(height_m);
        json["unit"] = "m";
        json["vertical_datum"] =
            info_.vertical_datum.empty() ? Json(nullptr) : Json(info_.vertical_datum);
        std::optional<GridPoint> grid;
        switch (frame_) {
        case PositionFrame::Pixel:
            grid = GridPoint{p.first, p.second};
            break;
        case PositionFrame::Map:
            grid = georeference_.toGrid(MapPoint{p.first, p.second});
            break;
        case PositionFrame::LonLat:
            grid = georeference_.toGrid(geographic(p));
            break;
        }
        json["pixel"] = nullptr;
        json["map"] = nullptr;
        json["lonlat"] = nullptr;
        if (grid) {
            json["pixel"] = pairJson(grid->column, grid->row);
            const MapPoint map = georeference_.toMap(*grid);
            json["map"] = pairJson(map.x, map.y);
            if (const auto point = georeference_.toGeographic(*grid)) {
                const Angle latitude = latitude_kind_ == LatitudeKind::Planetographic
                                           ? info_.crs->ellipsoid()->planetographic(point->latitude)
                                           : point->latitude;
                json["lonlat"] = pairJson(point->longitude.degrees(), latitude.degrees());
            }
        }
        json["latitude_kind"] =
            latitude_kind_ == LatitudeKind::Planetographic ? "planetographic" : "planetocentric";
        return json;
    }

    const RasterInfo& info_;
    Georeference georeference_;
    SurfaceReader reader_;
    PositionFrame frame_;
    LatitudeKind latitude_kind_;
    bool is_json_;
    ElevationScale scale_;
    SampleStatistics statistics_;
    double impossible_latitude_ = 0.0;
};

// Two numbers separated by blanks, a comma or a semicolon; "nan" is a number. An empty line is no
// position: it has no elevation, so that every line of the input has one in the output.
std::optional<Position> parsePosition(std::string line)
{
    for (char& c : line) {
        if (c == ',' || c == ';' || c == '\t' || c == '\r') {
            c = ' ';
        }
    }
    std::istringstream words(line);
    std::string first;
    std::string second;
    std::string rest;
    if (line.find_first_not_of(' ') == std::string::npos) {
        constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
        return Position{kNan, kNan};
    }
    if (!(words >> first >> second) || words >> rest) {
        return std::nullopt;
    }
    const auto x = parseNumber(first);
    const auto y = parseNumber(second);
    return x && y ? std::optional<Position>({*x, *y}) : std::nullopt;
}

Status sampleStdin(Sampler& sampler)
{
    std::ios::sync_with_stdio(false); // so that in_avail() of std::cin works
    constexpr std::size_t kLineBytesMax = 4096;
    std::string line;
    for (std::size_t number = 1;; ++number) {
        const LineOutcome outcome = readBoundedLine(std::cin, line, kLineBytesMax);
        if (outcome == LineOutcome::End) {
            break;
        }
        if (outcome == LineOutcome::TooLong) {
            return Error{ErrorCode::TooLarge,
                         fmt::format("--stdin: line {} is longer than {} bytes; write one position "
                                     "per line",
                                     number, kLineBytesMax)};
        }
        constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
        if (number == 1 && line.starts_with(kByteOrderMark)) {
            line.erase(0, kByteOrderMark.size());
        }
        const std::optional<Position> position = parsePosition(line);
        if (!position) {
            constexpr std::size_t kQuotedMax = 60;
            if (line.size() > kQuotedMax) {
                line = line.substr(0, kQuotedMax) + "…";
            }
            return Error{
                ErrorCode::Invalid,
                fmt::format("--stdin: line {} is \"{}\"; two numbers are required", number, line)};
        }
        if (Status status = sampler.print(*position); !status) {
            return status;
        }
        // A program at the other end of a pipe may wait for this result before it sends more.
        if (std::cin.rdbuf()->in_avail() <= 0) {
            std::fflush(stdout);
        }
    }
    return Done{};
}

Status runSample(const SampleOptions& options)
{
    if (options.is_stdin) {
        allowLargeBlockCache();
    }
    Result<OpenRaster> raster = openRaster(options.map);
    if (!raster) {
        return std::move(raster).error();
    }
    const bool has_lonlat = raster->info.crs && raster->info.crs->kind() != CrsKind::Local;
    if (options.frame == PositionFrame::LonLat && !has_lonlat) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: has no CRS, so it has no longitude and latitude; set "
                                 "one with --crs or --body",
                                 options.map.path)};
    }
    Result<VerifiedTiles> verified = verifiedTiles(*raster);
    if (!verified) {
        return std::move(verified).error();
    }
    if (!verified->notice.empty()) {
        raster->info.notices.push_back(std::move(verified->notice));
    }
    Sampler sampler(*raster, options, std::move(verified->tiles));
    Status status = options.is_stdin
                        ? sampleStdin(sampler)
                        : sampler.print({options.position.first, options.position.second});
    if (status) {
        if (sampler.statistics().hasSamples()) {
            noteUnit(raster->info, sampler.statistics());
        }
        if (const double latitude = sampler.impossibleLatitude(); latitude != 0.0) {
            raster->info.notices.push_back(fmt::format(
                "latitude {:g} is outside -90 to 90 degrees; write longitude before latitude",
                latitude));
        }
        printNotices(raster->info);
    }
    return status;
}

} // namespace

void addSampleCommand(CLI::App& app, CommandAction& run, bool has_stdin)
{
    const auto options = std::make_shared<SampleOptions>();
    CLI::App* command =
        app.add_subcommand("sample", "Print the elevation at a position, in meters");
    options->map.addTo(*command);
    const std::string group = "Position";
    struct FrameOption {
        const char* name;
        const char* metavar;
        const char* help;
        PositionFrame frame;
    };
    for (const FrameOption& entry :
         {FrameOption{"--map", "X Y", "map coordinates in the raster's CRS", PositionFrame::Map},
          FrameOption{"--lonlat", "LON LAT", "degrees, east-positive", PositionFrame::LonLat},
          FrameOption{"--pixel", "C R", "column and row; integers are sample centers",
                      PositionFrame::Pixel}}) {
        const auto set_frame = [options, frame = entry.frame] { options->frame = frame; };
        if (has_stdin) {
            command->add_flag_callback(entry.name, set_frame, entry.help)->group(group);
        } else {
            command->add_option(entry.name, options->position, entry.help)
                ->type_name(entry.metavar)
                ->group(group)
                ->check(finiteNumber())
                ->each([set_frame](const std::string&) { set_frame(); });
        }
    }
    command->add_flag(
        "--stdin", options->is_stdin,
        "read one position per line, print one elevation per line, nan for an empty one; the "
        "position options then take no numbers (default: --map)");
    command->add_flag("--json", options->is_json, "print JSON");
    command->callback([options, command, has_stdin, &run] {
        std::size_t count = 0;
        for (const char* name : {"--map", "--lonlat", "--pixel"}) {
            count += command->get_option(name)->count() > 0 ? 1U : 0U;
        }
        if (count > 1 || (count == 0 && !has_stdin)) {
            throw CLI::ValidationError("--map, --lonlat, --pixel", "exactly one is required");
        }
        run = [options] { return runSample(*options); };
    });
}

} // namespace marsview
