#include "core/files/archive_rasters.h"
#include "core/raster/raster_file.h"
#include "tests/support/make_raster.h"
#include "tests/support/run_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace marsview {
namespace {

using test::recipeFor;
using test::TempFolder;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

template <typename T>
test::RasterRecipe uniform(std::size_t columns, std::size_t rows, T value)
{
    return recipeFor(columns, std::vector<T>(columns * rows, value));
}

void writeInto(const TempFolder& folder,
               const std::string& subfolder,
               const std::string& file,
               const std::string& driver,
               const test::RasterRecipe& recipe,
               const std::vector<std::string>& options = {})
{
    std::filesystem::create_directories(folder.path() / subfolder);
    test::writeRaster(folder, file, driver, recipe, options);
    const std::string stem = file.substr(0, file.find('.') + 1);
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        names.push_back(entry.path().filename().string());
    }
    for (const std::string& name : names) {
        if (name.starts_with(stem) && name.find("-source.") == std::string::npos) {
            std::filesystem::rename(folder.path() / name, folder.path() / subfolder / name);
        }
    }
}

// Three rasters in folders, with a_small.tif first by name, and files that are not rasters.
void fill(const TempFolder& folder)
{
    writeInto(folder, "set", "a_small.tif", "GTiff", uniform<std::int16_t>(10, 10, 1));
    writeInto(folder, "set", "dem.tif", "GTiff", uniform<std::int16_t>(60, 50, 2));
    writeInto(folder, "set", "mask.tif", "GTiff", uniform<std::uint8_t>(90, 90, 3));
    folder.write("set/readme.txt", "text");
    folder.write("set/dem.prj", "none");
}

std::string
pack(const TempFolder& folder, const std::string& archive, const std::string& what = "set")
{
    const std::string path = folder.file(archive);
    const std::string in = folder.path().string();
    if (archive.ends_with(".zip")) {
        test::runTool({"python3", "-c",
                       "import os,sys,zipfile\n"
                       "z = zipfile.ZipFile(sys.argv[1], 'w', zipfile.ZIP_DEFLATED)\n"
                       "os.chdir(sys.argv[2])\n"
                       "[z.write(os.path.join(d, f)) for d, _, fs in os.walk(sys.argv[3]) "
                       "for f in sorted(fs)]\n"
                       "z.close()",
                       path, in, what});
    } else {
        test::runTool({"tar", archive.ends_with(".tar") ? "-cf" : "-czf", path, "-C", in, what});
    }
    return path;
}

TEST(Archive, OpensTheLargestElevationsAndNamesTheOthers)
{
    const TempFolder folder;
    fill(folder);
    for (const char* name : {"all.zip", "ALL.ZIP.zip", "all.tar", "all.tgz", "all.tar.gz"}) {
        SCOPED_TRACE(name);
        const std::string path = pack(folder, name);
        const auto file = RasterFile::open(path);
        ASSERT_TRUE(file) << file.error().message;
        const std::string root = archiveNameFor(path);
        EXPECT_EQ(file->info().path, root + "/set/dem.tif");
        EXPECT_EQ(file->info().columns, 60U);
        EXPECT_THAT(file->info().notices,
                    Contains("3 rasters were found in the archive; " + root +
                             "/set/dem.tif is open; open another one by its name: " + root +
                             "/set/a_small.tif (10 × 10), " + root + "/set/mask.tif (90 × 90)"));
        // Opened by that name.
        const auto other = RasterFile::open(root + "/set/a_small.tif");
        ASSERT_TRUE(other) << other.error().message;
        EXPECT_EQ(other->info().columns, 10U);
        EXPECT_THAT(other->info().notices, Not(Contains(HasSubstr("archive"))));
    }
}

TEST(Archive, OpensItsOnlyRasterWithoutListingOthers)
{
    const TempFolder folder;
    writeInto(folder, "one", "dem.tif", "GTiff", uniform<std::int16_t>(10, 10, 1));
    folder.write("one/notes.txt", "text");
    const std::string path = pack(folder, "one.zip", "one");
    const auto file = RasterFile::open(path);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_THAT(file->info().notices, testing::ElementsAre("opened dem.tif in place of one.zip"));
}

// A label and its data count as one raster.
TEST(Archive, CountsALabelWithItsDataOnce)
{
    const TempFolder folder;
    test::RasterRecipe recipe = uniform<std::int16_t>(40, 30, 7);
    recipe.band_xml = "<Scale>0.5</Scale><Offset>10</Offset>";
    recipe.transform.reset();
    writeInto(folder, "product", "cube.lbl", "ISIS3", recipe, {"-co", "DATA_LOCATION=EXTERNAL"});
    const std::string path = pack(folder, "product.zip", "product");
    const auto rasters = rastersInArchive(archiveNameFor(path));
    ASSERT_EQ(rasters.size(), 1U);
    EXPECT_TRUE(rasters[0].name.ends_with("cube.lbl")) << rasters[0].name;
    const auto file = RasterFile::open(path);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->info().elevationScale().height(7.0), 13.5);
}

TEST(Archive, OpensACompressedFile)
{
    const TempFolder folder;
    const std::string path =
        test::writeRaster(folder, "dem.tif", "GTiff", uniform<std::int16_t>(10, 20, 1));
    test::runTool({"gzip", path});
    const auto file = RasterFile::open(path + ".gz");
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->info().path, "/vsigzip/" + path + ".gz");
    EXPECT_EQ(file->info().rows, 20U);
    EXPECT_THAT(file->info().notices, testing::IsEmpty());
    EXPECT_FALSE(std::filesystem::exists(path + ".gz.properties")) << "written by GDAL";
}

TEST(Archive, WithoutARasterIsRefused)
{
    const TempFolder folder;
    std::filesystem::create_directories(folder.path() / "texts");
    folder.write("texts/a.txt", "text");
    const auto refused = RasterFile::open(pack(folder, "texts.zip", "texts"));
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("texts.zip"));
    EXPECT_TRUE(archiveNameFor("/maps/a.tif").empty());
    EXPECT_TRUE(archiveNameFor("https://example.org/a.zip").empty());
}

} // namespace
} // namespace marsview
