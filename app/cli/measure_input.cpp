#include "app/cli/measure_input.h"

#include "app/console/long_job.h"
#include "app/console/number_checks.h"
#include "core/base/bounded_text.h"
#include "core/base/plain_number.h"
#include "core/files/raster_path.h"
#include "core/levels/level_file_use.h"
#include "core/vector/vector_file.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <iostream>
#include <limits>
#include <sstream>
#include <utility>

namespace marsview {
namespace {

constexpr std::size_t kLineBytesMax = 4096;
constexpr std::size_t kTextBytesMax = std::size_t{1} << 28;

struct Pair {
    double first = 0.0;
    double second = 0.0;
};

std::vector<std::string> wordsOf(std::string line)
{
    for (char& c : line) {
        if (c == ',' || c == ';' || c == '\t' || c == '\r') {
            c = ' ';
        }
    }
    std::istringstream in(line);
    std::vector<std::string> words;
    for (std::string word; in >> word;) {
        words.push_back(word);
    }
    return words;
}

std::optional<Pair> pairIn(const std::vector<std::string>& words)
{
    if (words.size() != 2) {
        return std::nullopt;
    }
    const auto first = parseNumber(words[0]);
    const auto second = parseNumber(words[1]);
    const bool is_pair = first && second && std::isfinite(*first) && std::isfinite(*second);
    return is_pair ? std::optional(Pair{*first, *second}) : std::nullopt;
}

bool isHeader(const std::vector<std::string>& words)
{
    for (const std::string& word : words) {
        if (parseNumber(word)) {
            return false;
        }
    }
    return true;
}

// The fields of a line of CSV; quotes around one are dropped.
std::vector<std::string> fieldsOf(const std::string& line, char separator)
{
    std::vector<std::string> fields(1);
    bool is_quoted = false;
    for (const char c : line) {
        if (c == '"') {
            is_quoted = !is_quoted;
        } else if (c == separator && !is_quoted) {
            fields.emplace_back();
        } else if (c != '\r') {
            fields.back() += c;
        }
    }
    return fields;
}

// Where a header says that the positions are.
struct PositionColumns {
    std::size_t x = 0;
    std::size_t y = 1;
    char separator = 0; // 0: commas or blanks
};

std::optional<PositionColumns> columnsNamedIn(const std::string& header, bool is_map)
{
    constexpr std::array<std::string_view, 3> kLongitudes{"lon", "longitude", "long"};
    constexpr std::array<std::string_view, 2> kLatitudes{"lat", "latitude"};
    constexpr std::array<std::string_view, 2> kEastings{"x", "easting"};
    constexpr std::array<std::string_view, 2> kNorthings{"y", "northing"};
    PositionColumns columns;
    for (const char separator : {',', ';', '\t'}) {
        if (header.find(separator) != std::string::npos) {
            columns.separator = separator;
            break;
        }
    }
    std::vector<std::string> names =
        columns.separator != 0 ? fieldsOf(header, columns.separator) : wordsOf(header);
    for (std::string& name : names) {
        name.erase(0, name.find_first_not_of(' '));
        name.erase(name.find_last_not_of(' ') + 1);
        name = lowerCase(std::move(name));
    }
    const auto column_of = [&names](const auto& wanted) {
        const auto found =
            std::find_first_of(names.begin(), names.end(), wanted.begin(), wanted.end());
        return found == names.end() ? std::nullopt
                                    : std::optional<std::size_t>(found - names.begin());
    };
    const auto x = is_map ? column_of(kEastings) : column_of(kLongitudes);
    const auto y = is_map ? column_of(kNorthings) : column_of(kLatitudes);
    if (!x || !y) {
        return std::nullopt;
    }
    columns.x = *x;
    columns.y = *y;
    return columns;
}

std::optional<Pair> pairIn(const std::string& line, const PositionColumns& columns)
{
    const std::vector<std::string> fields =
        columns.separator != 0 ? fieldsOf(line, columns.separator) : wordsOf(line);
    if (fields.size() <= std::max(columns.x, columns.y)) {
        return std::nullopt;
    }
    const auto number_in = [&fields](std::size_t column) -> std::string {
        const std::vector<std::string> words = wordsOf(fields[column]);
        return words.size() == 1 ? words.front() : std::string();
    };
    return pairIn({number_in(columns.x), number_in(columns.y)});
}

std::string quoted(std::string line)
{
    constexpr std::size_t kQuotedMax = 60;
    if (line.size() > kQuotedMax) {
        line = line.substr(0, kQuotedMax) + "…";
    }
    return line;
}

// Two numbers a line, x and y on a map, otherwise longitude and latitude; or the columns that a
// header names so.
Result<std::vector<Pair>> readPairs(std::istream& in, const std::string& name, bool is_map)
{
    Result<std::string> text =
        readBoundedText(in, name, {.bytes_max = kTextBytesMax, .line_bytes_max = kLineBytesMax});
    if (!text) {
        return std::move(text).error();
    }
    std::vector<Pair> pairs;
    std::istringstream lines(*text);
    std::size_t number = 0;
    bool can_be_header = true;
    std::optional<PositionColumns> columns;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
        if (number == 1 && line.starts_with(kByteOrderMark)) {
            line.erase(0, kByteOrderMark.size());
        }
        const std::vector<std::string> words = wordsOf(line);
        if (words.empty()) {
            continue;
        }
        if (const auto pair = columns ? pairIn(line, *columns) : pairIn(words)) {
            pairs.push_back(*pair);
        } else if (can_be_header && isHeader(words)) {
            columns = columnsNamedIn(line, is_map);
        } else {
            return Error{ErrorCode::Invalid,
                         fmt::format("{}: line {} is \"{}\"; two finite numbers are required{}",
                                     name, number, quoted(line),
                                     words.size() > 2 && !columns
                                         ? fmt::format(", or a first line that names their "
                                                       "columns {}",
                                                       is_map ? "x and y" : "lon and lat")
                                         : "")};
        }
        can_be_header = false;
    }
    return pairs;
}

Result<std::vector<Pair>> readPairs(const MeasureOptions& options, bool is_map)
{
    if (options.points_path == "-") {
        return readPairs(std::cin, options.positionsName(), is_map);
    }
    std::ifstream file(options.points_path, std::ios::binary);
    if (!file) {
        return Error{ErrorCode::NotFound, options.points_path + ": cannot be opened for reading"};
    }
    return readPairs(file, options.points_path, is_map);
}

class Placer {
public:
    Placer(const MeasureOptions& options, const MeasuredTerrain& terrain, LatitudeKind kind)
        : options_(options)
        , terrain_(terrain)
        , kind_(kind)
        , is_map_(options.is_map || !terrain.ground().ellipsoid())
    {}

    /// Positions are x and y in the map's CRS.
    bool isMap() const noexcept { return is_map_; }
    Result<GroundPosition> place(Pair pair, std::size_t number) const
    {
        if (is_map_) {
            const auto position = terrain_.fromMap({pair.first, pair.second});
            if (!position) {
                return Error{ErrorCode::OutOfRange,
                             fmt::format("{}: position {} ({}, {}) is outside the map's projection",
                                         options_.positionsName(), number, pair.first,
                                         pair.second)};
            }
            return *position;
        }
        if (std::abs(pair.second) > 90.0) {
            return Error{ErrorCode::OutOfRange,
                         fmt::format("{}: position {} has latitude {}, which is outside -90 to 90 "
                                     "degrees; write longitude before latitude, or add --map for "
                                     "map coordinates",
                                     options_.positionsName(), number, pair.second)};
        }
        if (kind_ == LatitudeKind::Planetographic) {
            return GroundPosition{pair.first, pair.second};
        }
        const Angle latitude =
            terrain_.ground().ellipsoid()->planetographic(Angle::degrees(pair.second));
        return GroundPosition{pair.first, latitude.degrees()};
    }

private:
    const MeasureOptions& options_;
    const MeasuredTerrain& terrain_;
    LatitudeKind kind_;
    bool is_map_;
};

// The vertices of the first line or polygon, or all points before it.
std::vector<MapPoint> firstGeometry(const FeatureCollection& content)
{
    std::vector<MapPoint> points;
    for (const FeatureLayer& layer : content.layers) {
        for (const Feature& feature : layer.features) {
            const std::vector<MapPoint>& part = feature.parts.front().points;
            if (feature.shape != FeatureShape::Point) {
                return points.empty() ? part : points;
            }
            points.insert(points.end(), part.begin(), part.end());
        }
    }
    return points;
}

// In the CRS of the file; without one, as --lonlat and --map say.
Result<std::vector<GroundPosition>> readVector(const MeasureOptions& options,
                                               const RasterInfo& info,
                                               const Placer& placer,
                                               const MeasuredTerrain& terrain)
{
    LongJob job("reading");
    const Result<VectorFile> file = readVectorFile(options.vector_path, job.monitor());
    if (!file) {
        return file.error();
    }
    const FeatureCollection& content = file->content;
    if (Status same = checkSameBody(options.vector_path, content, info.crs, info.body); !same) {
        return std::move(same).error();
    }
    std::vector<GroundPosition> positions;
    for (const MapPoint& point : firstGeometry(content)) {
        const std::size_t number = positions.size() + 1;
        if (!content.crs || !terrain.ground().ellipsoid()) {
            Result<GroundPosition> position = placer.place({point.x, point.y}, number);
            if (!position) {
                return std::move(position).error();
            }
            positions.push_back(*position);
            continue;
        }
        const auto geographic = content.crs->toGeographic(point);
        if (!geographic) {
            return Error{ErrorCode::OutOfRange,
                         fmt::format("{}: position {} ({}, {}) is outside the projection of the "
                                     "file's CRS",
                                     options.vector_path, number, point.x, point.y)};
        }
        positions.push_back(terrain.ground().position(*geographic));
    }
    return positions;
}

} // namespace

void MeasureOptions::addTo(CLI::App& command)
{
    map.addTo(command);
    const std::string group = "Positions";
    command
        .add_option("--points", points_path,
                    "CSV with one position per line, or with a header that names the columns lon "
                    "and lat, with --map x and y; - reads standard input")
        ->type_name("FILE")
        ->transform(fileName())
        ->group(group);
    command
        .add_option("--vector", vector_path,
                    "GeoPackage, GeoJSON, KML, Shapefile or CSV: its first line or polygon, or its "
                    "points; its own CRS applies")
        ->type_name("FILE")
        ->transform(fileName())
        ->group(group);
    auto* lonlat = command.add_flag("--lonlat", is_lonlat,
                                    "positions are longitude and latitude in degrees, "
                                    "east-positive (default for a map with a CRS)");
    lonlat->group(group);
    command.add_flag("--map", is_map, "positions are x and y in the map's CRS")
        ->group(group)
        ->excludes(lonlat);
    command.add_flag("--json", is_json, "print JSON");
}

std::string MeasureOptions::positionsName() const
{
    if (!vector_path.empty()) {
        return vector_path;
    }
    return points_path == "-" ? std::string("--points") : points_path;
}

void MeasureOptions::checkSource() const
{
    if (points_path.empty() == vector_path.empty()) {
        throw CLI::ValidationError("--points, --vector", "exactly one is required");
    }
}

std::vector<GroundPosition> MeasureInput::openPositions() const
{
    std::vector<GroundPosition> open = positions;
    if (open.size() > 1 && open.front() == open.back()) {
        open.pop_back();
    }
    return open;
}

GroundPosition MeasureInput::lonLat(GroundPosition position) const
{
    if (!terrain->ground().ellipsoid()) {
        constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
        return {kNone, kNone};
    }
    if (latitude_kind == LatitudeKind::Planetocentric) {
        position.y =
            terrain->ground().ellipsoid()->planetocentric(Angle::degrees(position.y)).degrees();
    }
    return position;
}

Result<MeasureInput> openMeasureInput(const MeasureOptions& options)
{
    allowLargeBlockCache();
    Result<OpenRaster> raster = openRaster(options.map);
    if (!raster) {
        return std::move(raster).error();
    }
    if (Status surface = checkIsSurface(options.map.path, raster->info); !surface) {
        return std::move(surface).error();
    }
    Result<VerifiedTiles> verified = verifiedTiles(*raster);
    if (!verified) {
        return std::move(verified).error();
    }
    MeasureInput input;
    input.raster = std::make_unique<OpenRaster>(std::move(*raster));
    RasterInfo& info = input.raster->info;
    if (!verified->notice.empty()) {
        info.notices.push_back(std::move(verified->notice));
    }
    input.terrain = std::make_unique<MeasuredTerrain>(
        georeferenceOf(info), readSamples(*input.raster, std::move(verified->tiles)));
    if (options.is_lonlat && !input.terrain->ground().ellipsoid()) {
        return Error{
            ErrorCode::Invalid,
            fmt::format("{}: has no CRS, so it has no longitude and latitude; set one with "
                        "--crs or --body, or write map coordinates with --map",
                        options.map.path)};
    }
    input.latitude_kind = options.map.latitudeKind(info.body);
    const Placer placer(options, *input.terrain, input.latitude_kind);
    if (!options.vector_path.empty()) {
        Result<std::vector<GroundPosition>> positions =
            readVector(options, info, placer, *input.terrain);
        if (!positions) {
            return std::move(positions).error();
        }
        input.positions = std::move(*positions);
        return input;
    }
    const Result<std::vector<Pair>> pairs = readPairs(options, placer.isMap());
    if (!pairs) {
        return pairs.error();
    }
    for (std::size_t i = 0; i < pairs->size(); ++i) {
        const Result<GroundPosition> position = placer.place((*pairs)[i], i + 1);
        if (!position) {
            return position.error();
        }
        input.positions.push_back(*position);
    }
    return input;
}

Error measureError(const MeasureOptions& options, Error error)
{
    if (error.code == ErrorCode::Invalid || error.code == ErrorCode::OutOfRange) {
        error.message = options.positionsName() + ": " + error.message;
    } else if (error.code == ErrorCode::Canceled) {
        error.message = options.map.path + ": " + error.message;
    }
    return error;
}

} // namespace marsview
