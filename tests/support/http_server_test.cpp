#include "tests/support/gdal_tools.h"
#include "tests/support/http_server.h"
#include "tests/support/make_raster.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace marsview::test {
namespace {

using std::chrono_literals::operator""ms;

// Plain-text requests through the shell's sockets would need a client in this test; GDAL's tools
// are an independent client, based on libcurl.
ProgramOutput
copied(const std::string& url, const std::string& to, const std::vector<std::string>& more = {})
{
    std::vector<std::string> arguments{"gdal_translate", "-q"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    arguments.insert(arguments.end(), {"/vsicurl/" + url, to});
    return runProgram(arguments);
}

class HttpServerTest : public testing::Test {
protected:
    HttpServerTest()
    {
        std::vector<std::int16_t> samples(kColumns * kRows);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            samples[i] = static_cast<std::int16_t>(i * 7919 % 65521);
        }
        path_ = writeRaster(folder_, "map.tif", "GTiff", recipeFor(kColumns, samples),
                            {"-co", "TILED=YES"});
    }

    std::string pixelsOf(const std::string& path)
    {
        const std::string raw = folder_.file("pixels.raw");
        runTool({"gdal_translate", "-q", "-of", "ENVI", path, raw});
        return readFile(raw);
    }

    static constexpr std::size_t kColumns = 1024;
    static constexpr std::size_t kRows = 700;
    TempFolder folder_;
    std::string path_;
    HttpServer server_{folder_.path()};
};

TEST_F(HttpServerTest, GdalReadsTheSameSamplesAsFromDisk)
{
    const std::string copy = folder_.file("copy.tif");
    const ProgramOutput output = copied(server_.url("map.tif"), copy);
    ASSERT_EQ(output.exit_status, 0) << output.err;
    EXPECT_EQ(pixelsOf(copy), pixelsOf(path_));
    EXPECT_GT(server_.counts().ranges, 1U);
    EXPECT_GE(server_.counts().body_bytes, kColumns * kRows * 2);
}

TEST_F(HttpServerTest, GdalinfoReadsAFractionOfTheFile)
{
    const nlohmann::json info = gdalInfo("/vsicurl/" + server_.url("map.tif"));
    EXPECT_EQ(info["size"][0], kColumns);
    EXPECT_EQ(info["size"][1], kRows);
    const HttpCounts counts = server_.counts();
    EXPECT_GT(counts.body_bytes, 0U);
    EXPECT_LT(counts.body_bytes, std::filesystem::file_size(path_) / 4);
}

TEST_F(HttpServerTest, ManyRequestsShareAConnection)
{
    ASSERT_EQ(copied(server_.url("map.tif"), folder_.file("copy.tif"),
                     {"--config", "GDAL_HTTP_MULTIRANGE", "SERIAL"})
                  .exit_status,
              0);
    EXPECT_GT(server_.counts().requests, 2 * server_.counts().connections);
}

TEST_F(HttpServerTest, SendsSeveralRangesInOneResponse)
{
    const ProgramOutput output =
        runProgram({"curl", "-s", "-r", "0-3,10-19,-5", server_.url("map.tif")});
    if (output.exit_status == 127) {
        GTEST_SKIP() << "curl is not installed";
    }
    const std::string file = readFile(path_);
    for (const std::string& piece :
         {file.substr(0, 4), file.substr(10, 10), file.substr(file.size() - 5)}) {
        EXPECT_NE(output.out.find("\r\n\r\n" + piece + "\r\n--"), std::string::npos);
    }
    EXPECT_EQ(server_.counts().ranges, 3U);
    EXPECT_EQ(server_.counts().requests, 1U);
}

TEST_F(HttpServerTest, FailsAsOftenAsRequested)
{
    server_.failNext(2, 503);
    EXPECT_NE(copied(server_.url("map.tif"), folder_.file("a.tif")).exit_status, 0);
    server_.failNext(2, 503);
    const ProgramOutput output = copied(
        server_.url("map.tif"), folder_.file("b.tif"),
        {"--config", "GDAL_HTTP_MAX_RETRY", "3", "--config", "GDAL_HTTP_RETRY_DELAY", "0.01"});
    EXPECT_EQ(output.exit_status, 0) << output.err;
    EXPECT_EQ(pixelsOf(folder_.file("b.tif")), pixelsOf(path_));
}

TEST_F(HttpServerTest, MissingFilesAreNotFound)
{
    EXPECT_NE(copied(server_.url("absent.tif"), folder_.file("a.tif")).exit_status, 0);
    ASSERT_FALSE(server_.requests().empty());
    EXPECT_EQ(server_.requests().front().status, 404);
}

TEST_F(HttpServerTest, RefusesAndAcceptsAgainAtTheSamePort)
{
    const std::string url = server_.url("map.tif");
    server_.refuse();
    EXPECT_NE(copied(url, folder_.file("a.tif")).exit_status, 0);
    EXPECT_EQ(server_.counts().requests, 0U);
    server_.accept();
    EXPECT_EQ(server_.url("map.tif"), url);
    EXPECT_EQ(copied(url, folder_.file("b.tif")).exit_status, 0);
}

TEST_F(HttpServerTest, ATruncatedBodyIsShorterThanDeclared)
{
    server_.cutNext(1, 1000);
    const ProgramOutput output = runProgram({"curl", "-s", server_.url("map.tif")});
    if (output.exit_status == 127) {
        GTEST_SKIP() << "curl is not installed";
    }
    EXPECT_EQ(output.exit_status, 18); // "partial file"
    EXPECT_EQ(output.out.size(), 1000U);
}

TEST_F(HttpServerTest, AReplacedFileFailsTheConditionOfTheOldOne)
{
    const auto status_if = [&](const std::string& condition) {
        return runProgram({"curl", "-s", "-o", "/dev/null", "-w", "%{http_code}", "-H", condition,
                           server_.url("map.tif")})
            .out;
    };
    const std::string head = runProgram({"curl", "-s", "-I", server_.url("map.tif")}).out;
    const std::size_t begin = head.find("ETag: ");
    if (begin == std::string::npos) {
        GTEST_SKIP() << "curl is not installed";
    }
    const std::string etag = head.substr(begin + 6, head.find("\r\n", begin) - begin - 6);
    EXPECT_EQ(status_if("If-Match: " + etag), "200");
    std::filesystem::copy_file(path_, folder_.file("other.tif"));
    std::filesystem::rename(folder_.file("other.tif"), path_);
    EXPECT_EQ(status_if("If-Match: " + etag), "412");
}

TEST_F(HttpServerTest, WithoutRangesRespondsWithTheWholeFile)
{
    server_.setRanges(HttpRanges::Ignored);
    const ProgramOutput output = runProgram({"curl", "-s", "-r", "0-3", server_.url("map.tif")});
    if (output.exit_status == 127) {
        GTEST_SKIP() << "curl is not installed";
    }
    EXPECT_EQ(output.out, readFile(path_));
}

} // namespace
} // namespace marsview::test
