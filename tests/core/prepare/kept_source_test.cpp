#include "core/levels/level_file.h"
#include "core/prepare/kept_source.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace marsview {
namespace {

namespace fs = std::filesystem;

// The file in the folder has been replaced since it was opened.
class StrangeSource final : public TileSource {
public:
    const TileLayout& layout() const noexcept override { return layout_; }
    const std::string& name() const noexcept override { return name_; }
    Result<std::unique_ptr<TileReader>> open() const override
    {
        return Error{ErrorCode::Invalid, "x.map.tif.marsview: was made from another raster"};
    }

private:
    TileLayout layout_;
    std::string name_ = "mars.tif";
};

} // namespace

TEST(KeptSource, ReportsThatAnotherProgramHasRebuiltTheMap)
{
    const test::TempFolder folder;
    const std::string path = folder.file("x.map.tif");
    const std::string level_path = LevelFile::pathFor(path);
    folder.write(fs::path(level_path).filename().string(), "levels");
    const MapFolder maps = MapFolder::at(folder.path());
    const auto source =
        keptSource(std::make_shared<const StrangeSource>(),
                   {.folder = maps, .path = path, .lock = std::nullopt, .is_copy = true});
    EXPECT_EQ(source->open().error().message, "x.map.tif.marsview: was made from another raster");
    fs::last_write_time(level_path, fs::last_write_time(level_path) + std::chrono::hours(1));
    EXPECT_EQ(source->open().error().message,
              "mars.tif: was found damaged and has been rebuilt since it was opened; open it "
              "again");
    EXPECT_FALSE(maps.damage(path)) << "the current file is not damaged";
}

} // namespace marsview
