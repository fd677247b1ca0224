// Maps on a server give the same contact as their files on disk.
#include "tests/cli/run_cli.h"
#include "tests/support/http_server.h"
#include "tests/support/make_raster.h"
#include "tests/support/random.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <sstream>
#include <string>
#include <vector>

namespace marsview::test {
namespace {

constexpr std::size_t kSide = 2048;

class RemoteMap : public testing::Test {
protected:
    // The proxies of a trace without the counters, which depend on how the proxies were found.
    std::string proxies(const std::string& dem, const std::string& goals) const
    {
        const ProgramOutput output =
            runCliWith({"MARSVIEW_CACHE_DIR=" + cache_.path().string()},
                       {"trace", dem, "--goals", folder_.write("goals.csv", goals)});
        EXPECT_EQ(output.exit_status, 0) << output.err;
        std::string found;
        std::istringstream lines(output.out);
        for (std::string line; std::getline(lines, line);) {
            std::size_t end = 0;
            for (int i = 0; i < 5 && end != std::string::npos; ++i) {
                end = line.find(',', end + 1);
            }
            found += line.substr(0, end) + '\n';
        }
        return found;
    }

    // A plain with single samples that stand out of it. No overview shows them.
    std::string writeMap(const std::string& name,
                         const std::vector<std::size_t>& peaks,
                         std::int16_t plain_m) const
    {
        std::vector<std::int16_t> samples(kSide * kSide, plain_m);
        for (const std::size_t peak : peaks) {
            samples[peak] = 3000;
        }
        return writeRaster(served_, name, "COG", recipeFor(kSide, samples),
                           {"-co", "COMPRESS=NONE", "-co", "RESAMPLING=AVERAGE"});
    }

    // One goal above each place, and one inside the peak there.
    static std::string goalsAt(const std::vector<std::size_t>& places, double inside_m)
    {
        std::string goals = "x,y,z\n";
        for (const std::size_t place : places) {
            const double x = 1000.5 + static_cast<double>(place % kSide);
            const double y = 1999.5 - static_cast<double>(place / kSide);
            goals += fmt::format("{},{},4000\n{},{},{}\n", x, y, x, y, inside_m);
        }
        return goals;
    }

    TempFolder folder_;
    TempFolder cache_;
    TempFolder served_;
    HttpServer server_{served_.path()};
};

TEST_F(RemoteMap, PeaksMissingFromOverviewsAreFelt)
{
    Random random;
    std::vector<std::size_t> peaks;
    for (int i = 0; i < 20; ++i) {
        peaks.push_back(static_cast<std::size_t>(random.uniform(1.0, 2046.0)) * kSide +
                        static_cast<std::size_t>(random.uniform(1.0, 2046.0)));
    }
    const std::string file = writeMap("peaks.tif", peaks, 100);
    const std::string goals = goalsAt(peaks, 1500.0);
    const std::string truth = proxies(file, goals);
    EXPECT_THAT(truth, testing::HasSubstr(",1,")); // is in contact
    EXPECT_EQ(proxies(server_.url("peaks.tif"), goals), truth);
}

TEST_F(RemoteMap, IsFetchedAgainFromAServerThatReportsNoVersions)
{
    server_.setValidators(HttpValidators::None);
    const std::string file = writeMap("map.tif", {}, 100);
    const auto size = std::filesystem::file_size(file);
    const std::string goals = goalsAt({5 * kSide + 7, 900 * kSide + 1200}, -50.0);
    const std::string before = proxies(server_.url("map.tif"), goals);
    EXPECT_EQ(before, proxies(file, goals));
    writeMap("map.tif", {}, 200);
    ASSERT_EQ(std::filesystem::file_size(file), size); // otherwise the size would reveal the change
    const std::string after = proxies(server_.url("map.tif"), goals);
    EXPECT_NE(after, before);
    EXPECT_EQ(after, proxies(file, goals));
}

} // namespace
} // namespace marsview::test
