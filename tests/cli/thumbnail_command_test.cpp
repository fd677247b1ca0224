// `thumbnail` as a file manager calls it: by the line in the installed .thumbnailer file.
#include "tests/cli/run_cli.h"
#include "tests/support/gdal_tools.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

namespace marsview::test {
namespace {

namespace fs = std::filesystem;

class Thumbnail : public testing::Test {
protected:
    void SetUp() override
    {
        const ProgramOutput output = thumbnail(bundledMars(), 16, file("first.png"));
        if (output.err.find("no OpenGL") != std::string::npos) {
            GTEST_SKIP() << output.err;
        }
    }

    // The value of a key of the .thumbnailer file.
    static std::string value(const std::string& key)
    {
        std::ifstream file(sourceRoot() / "packaging/linux/org.marsview.MarsView.thumbnailer");
        std::string line;
        while (std::getline(file, line)) {
            if (line.starts_with(key + "=")) {
                return line.substr(key.size() + 1);
            }
        }
        ADD_FAILURE() << key << " is missing";
        return {};
    }

    // Runs the line "Exec" with its fields filled in, and the cache in a folder of the test.
    ProgramOutput thumbnail(const std::string& input, int size, const std::string& output) const
    {
        std::istringstream line(value("Exec"));
        std::string word;
        line >> word;
        EXPECT_EQ(word, "marsview-cli");
        EXPECT_EQ(word, value("TryExec"));
        std::vector<std::string> arguments;
        while (line >> word) {
            word = word == "%i"   ? input
                   : word == "%o" ? output
                   : word == "%s" ? std::to_string(size)
                                  : word;
            EXPECT_EQ(word.find('%'), std::string::npos) << word;
            arguments.push_back(word);
        }
        return runCliWith(
            {"DISPLAY", "WAYLAND_DISPLAY", "MARSVIEW_HELD_MB=0", "MARSVIEW_CACHE_DIR=" + cache()},
            arguments);
    }

    void expectPicture(const std::string& input, int size) const
    {
        const std::string png = file("picture"); // file managers may leave out the extension
        const ProgramOutput output = thumbnail(input, size, png);
        ASSERT_EQ(output.exit_status, 0) << output.err;
        EXPECT_EQ(output.out, "");
        const nlohmann::json info = gdalInfo(png);
        EXPECT_EQ(info["driverShortName"], "PNG");
        EXPECT_EQ(info["size"], (nlohmann::json{size, size}));
        expectNothingPrepared();
    }

    // The cache has at most the note that a file was opened safely.
    void expectNothingPrepared() const
    {
        std::error_code none;
        for (const fs::directory_entry& entry : fs::directory_iterator(cache(), none)) {
            EXPECT_EQ(entry.path().filename(), "opened");
        }
    }

    std::string file(const std::string& name) const { return folder_.file(name); }
    std::string cache() const { return file("cache"); }
    // Mars with so many columns and half as many rows, without overviews.
    std::string enlargedMars(int columns) const
    {
        const std::string path = file("large.vrt");
        runTool({"gdal_translate", "-q", "-of", "VRT", "-outsize", std::to_string(columns),
                 std::to_string(columns / 2), bundledMars(), path});
        return path;
    }

    TempFolder folder_;
};

} // namespace

TEST_F(Thumbnail, IsAPictureOfTheRequestedSize)
{
    expectPicture(bundledMars(), 128);
    expectPicture(bundledMountain(), 256);
}

// 80 billion samples: preparing them would take hours.
TEST_F(Thumbnail, OfAMapLargerThanMemoryNeedsNoPreparing)
{
    const std::string large = enlargedMars(400'000);
    expectPicture(large, 64);
    for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(large).parent_path())) {
        EXPECT_TRUE(entry.path() == large || !entry.path().filename().string().starts_with("large"))
            << entry.path() << " was written next to the map";
    }
}

TEST_F(Thumbnail, OfAProjectShowsItsTopmostVisibleLayer)
{
    const auto project = [this](const std::string& name, const std::string& layers) {
        std::ofstream(file(name)) << R"({"format": "MarsView project", "version": 1, "layers": [)"
                                  << layers << "]}";
        return file(name);
    };
    const auto layer = [](const std::string& path, bool is_visible) {
        return fmt::format(R"({{"file": "{}", "visible": {}}})", path, is_visible);
    };
    expectPicture(project("mars.mvproj",
                          layer(file("missing.tif"), false) + "," + layer(bundledMars(), true)),
                  96);
    const std::string drawn = readFile(file("picture"));
    ASSERT_EQ(thumbnail(bundledMars(), 96, file("mars.png")).exit_status, 0);
    EXPECT_TRUE(drawn == readFile(file("mars.png")));

    const ProgramOutput empty = thumbnail(project("empty.mvproj", ""), 96, file("no.png"));
    EXPECT_EQ(empty.exit_status, 1);
    EXPECT_NE(empty.err.find("has no layers to draw"), std::string::npos) << empty.err;
    EXPECT_FALSE(fs::exists(file("no.png")));
}

} // namespace marsview::test
