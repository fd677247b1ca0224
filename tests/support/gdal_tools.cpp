#include "tests/support/gdal_tools.h"

#include "tests/support/run_program.h"
#include "tests/support/temp_folder.h"

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace marsview::test {

nlohmann::json gdalInfo(const std::string& path)
{
    return nlohmann::json::parse(runTool({"gdalinfo", "-json", path}));
}

const nlohmann::json& firstBand(const nlohmann::json& info)
{
    return info.at("bands").at(0);
}

double jsonNumber(const nlohmann::json& value)
{
    return value.is_string() ? std::strtod(value.get<std::string>().c_str(), nullptr)
                             : value.get<double>();
}

std::vector<double> rawSamples(const std::string& path, const std::vector<Pixel>& pixels)
{
    std::string input;
    for (const Pixel& pixel : pixels) {
        input += fmt::format("{} {}\n", pixel.column, pixel.row);
    }
    std::istringstream lines(runTool({"gdallocationinfo", "-valonly", "-b", "1", path}, input));
    std::vector<double> values;
    std::string line;
    while (std::getline(lines, line)) {
        values.push_back(line.empty() ? std::numeric_limits<double>::quiet_NaN()
                                      : std::strtod(line.c_str(), nullptr));
    }
    if (values.size() != pixels.size()) {
        throw std::runtime_error(fmt::format("gdallocationinfo {}: {} values for {} positions",
                                             path, values.size(), pixels.size()));
    }
    return values;
}

std::vector<unsigned char> maskOf(const std::string& path)
{
    const TempFolder folder;
    const std::string mask = folder.file("mask.raw");
    runTool({"gdal_translate", "-q", "-of", "ENVI", "-b", "mask", path, mask});
    const std::string bytes = readFile(mask);
    return {bytes.begin(), bytes.end()};
}

std::vector<Position>
transformed(const std::string& from, const std::string& to, const std::vector<Position>& positions)
{
    std::string input;
    for (const Position& p : positions) {
        input += fmt::format("{:.17g} {:.17g}\n", p.x, p.y);
    }
    std::istringstream lines(runTool({"gdaltransform", "-s_srs", from, "-t_srs", to}, input));
    std::vector<Position> results;
    std::string line;
    while (std::getline(lines, line)) {
        char* rest = nullptr;
        const double x = std::strtod(line.c_str(), &rest);
        results.push_back({x, std::strtod(rest, nullptr)});
    }
    if (results.size() != positions.size()) {
        throw std::runtime_error(fmt::format("gdaltransform {} to {}: {} results for {} positions",
                                             from, to, results.size(), positions.size()));
    }
    return results;
}

std::string compactWkt(const std::string& wkt)
{
    std::string compact;
    bool is_quoted = false;
    for (const char c : wkt) {
        is_quoted = c == '"' ? !is_quoted : is_quoted;
        if (is_quoted || std::isspace(static_cast<unsigned char>(c)) == 0) {
            compact += c;
        }
    }
    static const std::regex kEnsemble(
        R"re(ENSEMBLE\["([^"]*) ensemble",(?:MEMBER\["[^"]*"\],)*(ELLIPSOID\[[^\]]*\]\]),)re"
        R"re(ENSEMBLEACCURACY\[[^\]]*\]\])re");
    return std::regex_replace(compact, kEnsemble, R"re(DATUM["$1",$2])re");
}

} // namespace marsview::test
