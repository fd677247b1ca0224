#include "core/files/raster_path.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace marsview {
namespace {

std::vector<std::string> namesFor(const std::string& path)
{
    auto names = rasterNamesFor(path);
    EXPECT_TRUE(names) << names.error().message;
    return names ? *names : std::vector<std::string>{};
}

TEST(RasterPath, AnOrdinaryFileIsItsOwnName)
{
    const test::TempFolder folder;
    const std::string path = folder.write("map.tif", "x");
    EXPECT_EQ(namesFor(path), std::vector<std::string>{path});
}

TEST(RasterPath, CompanionsAreFoundInAnyCase)
{
    const test::TempFolder folder;
    const std::string image = folder.write("MEGT90N000CB.IMG", "x");
    const std::string label = folder.write("megt90n000cb.lbl", "x");
    folder.write("other.lbl", "x");
    EXPECT_EQ(namesFor(image), (std::vector<std::string>{image, label}));
    const std::string header = folder.write("W100N40.HDR", "x");
    const std::string dem = folder.write("W100N40.DEM", "x");
    EXPECT_EQ(namesFor(header), (std::vector<std::string>{header, dem}));
}

TEST(RasterPath, AProjectionFileIsReplacedByItsData)
{
    const test::TempFolder folder;
    const std::string text = folder.write("map.prj", "x");
    EXPECT_EQ(namesFor(text), std::vector<std::string>{text});
    const std::string data = folder.write("map.flt", "x");
    EXPECT_EQ(namesFor(text).front(), data);
}

TEST(RasterPath, CompanionsInTheWorkingFolderKeepTheirBareNames)
{
    const test::TempFolder folder;
    folder.write("map.img", "x");
    folder.write("map.lbl", "x");
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    const std::vector<std::string> names = namesFor("map.img");
    std::filesystem::current_path(before);
    EXPECT_EQ(names, (std::vector<std::string>{"map.img", "map.lbl"}));
}

TEST(RasterPath, ConnectionStringsPassUnchecked)
{
    for (const char* name : {"/vsizip//nowhere/a.zip/b.tif", "/vsicurl/https://example.org/a.tif",
                             "NETCDF:/nowhere/a.nc:z", "HDF5:\"/nowhere/a.h5\"://z"}) {
        EXPECT_EQ(namesFor(name), std::vector<std::string>{name});
    }
}

TEST(RasterPath, RefusesMissingAndEmptyFiles)
{
    const test::TempFolder folder;
    const struct {
        std::string path;
        ErrorCode code;
    } cases[] = {
        {"", ErrorCode::NotFound},
        {folder.file("missing.tif"), ErrorCode::NotFound},
        {folder.file("no/such/folder/map.tif"), ErrorCode::NotFound},
        {folder.write("empty.tif", ""), ErrorCode::Invalid},
        {folder.write("file", "x") + "/below.tif", ErrorCode::NotFound},
        {folder.file(std::string(5000, 'a')), ErrorCode::Unreadable},
        {"/dev/null", ErrorCode::Unsupported},
    };
    for (const auto& c : cases) {
        const auto names = rasterNamesFor(c.path);
        ASSERT_FALSE(names) << c.path;
        EXPECT_EQ(names.error().code, c.code) << names.error().message;
        EXPECT_TRUE(names.error().message.starts_with(c.path)) << names.error().message;
    }
}

TEST(RasterPath, NamesAFileInAnArchiveThatIsWrittenLikeAFolder)
{
    const test::TempFolder folder;
    const std::string zip = folder.write("two.zip", "x");
    const auto in_zip = rasterNamesFor(zip + "/b/x.tif");
    ASSERT_FALSE(in_zip);
    EXPECT_EQ(in_zip.error().message,
              zip + "/b/x.tif: does not exist; a file in that archive is named /vsizip/" + zip +
                  "/b/x.tif");
    const std::string file = folder.write("map.tif", "x");
    const auto in_file = rasterNamesFor(file + "/x.tif");
    ASSERT_FALSE(in_file);
    EXPECT_EQ(in_file.error().message,
              file + "/x.tif: does not exist; " + file + " is a file, not a folder");
}

} // namespace
} // namespace marsview
