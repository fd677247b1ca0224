// libmarsview-contact as other programs use it.
#include "core/contact/contact_model.h"
#include "core/geo/scene_frame.h"
#include "tests/support/make_terrain.h"
#include "tests/support/random.h"
#include "tests/support/run_program.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <marsview/contact.h>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace marsview::test {
namespace {

using contact::Contact;
using contact::Grid;
using contact::Model;
using contact::Surface;
using contact::Vector;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

template <typename T>
Grid gridOf(const std::vector<T>& samples, std::size_t columns, contact::SampleType type)
{
    return {.samples = samples.data(),
            .type = type,
            .columns = columns,
            .rows = samples.size() / columns};
}

std::vector<double> planeHeights(std::size_t columns, std::size_t rows, double east, double north)
{
    std::vector<double> heights;
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            heights.push_back(east * static_cast<double>(column) -
                              north * static_cast<double>(row));
        }
    }
    return heights;
}

std::string whyRefused(const std::function<void()>& action)
{
    try {
        action();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

TEST(ContactLibrary, ProxyOnAPlaneIsTheFootOfTheGoal)
{
    constexpr double kEast = 0.75;
    constexpr double kNorth = -0.5;
    const auto heights = planeHeights(40, 30, kEast, kNorth);
    const Surface surface = Surface::fromGrid(gridOf(heights, 40, contact::SampleType::Float64));
    // The plane z = 0.75 x - 0.5 y and its unit normal.
    const double norm = std::sqrt(kEast * kEast + kNorth * kNorth + 1.0);
    const Vector normal{-kEast / norm, -kNorth / norm, 1.0 / norm};
    for (const Model kind : {Model::ContinuousWalk, Model::SurfaceWalk, Model::GodObject}) {
        contact::ContactModel model(surface, {.model = kind});
        model.place({20.0, -15.0, 30.0});
        const Vector foot{18.3, -12.6, kEast * 18.3 + kNorth * -12.6};
        constexpr double kDepth = 1.7;
        const Contact contact = model.update(
            {foot.x - kDepth * normal.x, foot.y - kDepth * normal.y, foot.z - kDepth * normal.z});
        EXPECT_TRUE(contact.is_in_contact) << modelName(kind);
        EXPECT_NEAR(contact.proxy.x, foot.x, 1e-9) << modelName(kind);
        EXPECT_NEAR(contact.proxy.y, foot.y, 1e-9) << modelName(kind);
        EXPECT_NEAR(contact.proxy.z, foot.z, 1e-9) << modelName(kind);
        EXPECT_NEAR(contact.distance_m, kDepth, 1e-9) << modelName(kind);
        EXPECT_NEAR(contact.force_direction.x, normal.x, 1e-9) << modelName(kind);
        EXPECT_NEAR(contact.force_direction.y, normal.y, 1e-9) << modelName(kind);
        EXPECT_NEAR(contact.force_direction.z, normal.z, 1e-9) << modelName(kind);
    }
}

TEST(ContactLibrary, ModelsMoveAsThoseOfTheProgram)
{
    constexpr std::size_t kSide = 64;
    Random random(41);
    const auto heights = fractalHeights(random, kSide, kSide, 12.0, 0.6);
    std::vector<float> samples;
    for (const double height : heights) {
        samples.push_back(static_cast<float>(height));
    }
    const Heightfield heightfield = floatTerrain(kSide, kSide, heightsFrom(heights, kSide));
    JobMonitor monitor;
    const auto filled = std::make_shared<const FilledHeightfield>(
        FilledHeightfield::build(heightfield, analyzed(heightfield), monitor).value());
    const SceneFrame frame{.origin = {0.0, 0.0}};
    const Surface surface = Surface::fromGrid(gridOf(samples, kSide, contact::SampleType::Float32));
    for (const ContactModelKind kind : kContactModelKinds) {
        const auto ours =
            makeContactModel(kind, HeightfieldSurface(filled, frame, 2.0), {.radius_m = 0.5});
        contact::ContactModel theirs(
            surface, {.model = static_cast<Model>(kind), .radius_m = 0.5, .exaggeration = 2.0});
        Vec3 goal{20.0, -20.0, 0.0};
        for (int i = 0; i < 500; ++i) {
            goal = goal + Vec3{random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0),
                               random.uniform(-4.0, 4.0)};
            const ContactState expected = ours->update(goal);
            const Contact found = theirs.update({goal.x, goal.y, goal.z});
            ASSERT_EQ(found.proxy.x, expected.proxy.x) << contactModelName(kind) << " " << i;
            ASSERT_EQ(found.proxy.y, expected.proxy.y);
            ASSERT_EQ(found.proxy.z, expected.proxy.z);
            ASSERT_EQ(found.counters.faces, expected.counters.faces);
            ASSERT_EQ(found.is_in_contact, expected.is_in_contact);
        }
    }
}

TEST(ContactLibrary, StridesAndTypesDescribeTheSameSurface)
{
    constexpr std::size_t kColumns = 9;
    constexpr std::size_t kRows = 7;
    std::vector<std::int16_t> by_rows;
    std::vector<double> by_columns(kColumns * kRows);
    std::vector<std::uint8_t> upside_down(kColumns * kRows);
    for (std::size_t row = 0; row < kRows; ++row) {
        for (std::size_t column = 0; column < kColumns; ++column) {
            const std::size_t value = (7 * row * row + 3 * column * row + 5 * column) % 97;
            by_rows.push_back(static_cast<std::int16_t>(value));
            by_columns[column * kRows + row] = static_cast<double>(value);
            upside_down[(kRows - 1 - row) * kColumns + column] = static_cast<std::uint8_t>(value);
        }
    }
    const Surface plain = Surface::fromGrid(gridOf(by_rows, kColumns, contact::SampleType::Int16));
    Grid transposed = gridOf(by_columns, kColumns, contact::SampleType::Float64);
    transposed.column_stride_bytes = static_cast<std::ptrdiff_t>(kRows * sizeof(double));
    transposed.row_stride_bytes = sizeof(double);
    const Surface columns = Surface::fromGrid(transposed);
    Grid turned = gridOf(upside_down, kColumns, contact::SampleType::UInt8);
    turned.samples = upside_down.data() + (kRows - 1) * kColumns;
    turned.row_stride_bytes = -static_cast<std::ptrdiff_t>(kColumns);
    const Surface rows = Surface::fromGrid(turned);
    for (double y = 0.0; y >= -6.0; y -= 0.25) {
        for (double x = 0.0; x <= 8.0; x += 0.25) {
            ASSERT_EQ(columns.height(x, y), plain.height(x, y)) << x << " " << y;
            ASSERT_EQ(rows.height(x, y), plain.height(x, y)) << x << " " << y;
        }
    }
    EXPECT_EQ(plain.height(3.0, -2.0), static_cast<double>(by_rows[2 * kColumns + 3]));
}

TEST(ContactLibrary, PlacesSamplesByOriginAndCellSize)
{
    const std::vector<float> samples{1.0F, 2.0F, 3.0F, 4.0F};
    Grid grid = gridOf(samples, 2, contact::SampleType::Float32);
    grid.cell_x_m = 10.0;
    grid.cell_y_m = 20.0;
    grid.origin_x_m = 100.0;
    grid.origin_y_m = -300.0;
    grid.gain = 2.0;
    grid.offset_m = 0.5;
    const Surface surface = Surface::fromGrid(grid);
    EXPECT_EQ(surface.height(100.0, -300.0), 2.5);
    EXPECT_EQ(surface.height(110.0, -300.0), 4.5);
    EXPECT_EQ(surface.height(100.0, -280.0), 6.5);
    EXPECT_EQ(surface.height(110.0, -280.0), 8.5);
    EXPECT_TRUE(std::isnan(surface.height(kNan, 0.0)));
}

TEST(ContactLibrary, FillsVoids)
{
    std::vector<double> samples(100, 4.0);
    samples[55] = kNan;
    samples[33] = -9999.0;
    Grid grid = gridOf(samples, 10, contact::SampleType::Float64);
    grid.has_nodata = true;
    grid.nodata = -9999.0;
    const Surface surface = Surface::fromGrid(grid);
    EXPECT_NEAR(surface.height(5.0, -5.0), 4.0, 1e-5);
    EXPECT_NEAR(surface.height(3.0, -3.0), 4.0, 1e-5);
}

TEST(ContactLibrary, TouchesMeshes)
{
    // A square of two faces at z = 1.
    const std::vector<Vector> vertices{{0, 0, 1}, {4, 0, 1}, {4, 4, 1}, {0, 4, 1}};
    const Surface surface = Surface::fromMesh(vertices, {0, 1, 2, 0, 2, 3});
    EXPECT_FALSE(surface.isGrid());
    contact::ContactModel model(surface);
    model.place({1.0, 2.0, 3.0});
    const Contact contact = model.update({1.5, 2.5, 0.25});
    EXPECT_TRUE(contact.is_in_contact);
    EXPECT_NEAR(contact.proxy.x, 1.5, 1e-12);
    EXPECT_NEAR(contact.proxy.y, 2.5, 1e-12);
    EXPECT_NEAR(contact.proxy.z, 1.0, 1e-12);
    EXPECT_NEAR(contact.force_direction.z, 1.0, 1e-12);
    EXPECT_NEAR(contact.distance_m, 0.75, 1e-12);
    EXPECT_FALSE(model.setExaggeration(2.0));
}

TEST(ContactLibrary, ExplainsRefusals)
{
    const std::vector<float> samples(4, 1.0F);
    const Grid sound = gridOf(samples, 2, contact::SampleType::Float32);
    Grid grid = sound;
    grid.samples = nullptr;
    EXPECT_EQ(whyRefused([&] { Surface::fromGrid(grid); }), "the grid has no samples");
    grid = sound;
    grid.rows = 1;
    EXPECT_THAT(whyRefused([&] { Surface::fromGrid(grid); }), HasSubstr("2 × 1 samples"));
    grid = sound;
    grid.cell_x_m = kNan;
    EXPECT_THAT(whyRefused([&] { Surface::fromGrid(grid); }), HasSubstr("cell size"));
    grid = sound;
    grid.has_nodata = true;
    grid.nodata = 1.0;
    EXPECT_EQ(whyRefused([&] { Surface::fromGrid(grid); }), "the grid has no valid sample");
    EXPECT_THAT(whyRefused([] {
                    Surface::fromMesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {0, 1, 2});
                }),
                HasSubstr("without area"));
    EXPECT_THAT(whyRefused([] { Surface::fromMesh({}, {0, 1}); }), HasSubstr("three corners"));
    const Surface surface = Surface::fromGrid(sound);
    EXPECT_THAT(whyRefused([&] { contact::ContactModel(surface, {.radius_m = 0.0}); }),
                HasSubstr("positive"));
    EXPECT_EQ(whyRefused([] { contact::modelOfName("magnet"); }),
              "unknown contact model \"magnet\"");
    EXPECT_EQ(contact::modelOfName("god-object"), Model::GodObject);
}

TEST(ContactLibrary, CountsGoalsThatAreNotFinite)
{
    const std::vector<float> samples(4, 1.0F);
    contact::ContactModel model(
        Surface::fromGrid(gridOf(samples, 2, contact::SampleType::Float32)));
    model.place({0.5, -0.5, 2.0});
    const Contact contact = model.update({kNan, 0.0, 0.0});
    EXPECT_EQ(contact.counters.refused, 1U);
    EXPECT_EQ(contact.proxy.z, 2.0);
    EXPECT_EQ(contact.distance_m, 0.0);
}

// A changed or missing line breaks programs that were linked against an earlier version: raise
// SOVERSION. New lines are compatible.
TEST(ContactLibrary, ExportsTheSymbolsOfItsVersion)
{
    std::vector<std::string> found;
    std::istringstream lines(
        runTool({"nm", "-D", "--defined-only", "--format=posix", MARSVIEW_CONTACT_LIBRARY}));
    for (std::string line; std::getline(lines, line);) {
        found.push_back(line.substr(0, line.find(' ')));
    }
    std::sort(found.begin(), found.end());
    std::vector<std::string> expected;
    std::istringstream list(readFile(sourceRoot() / "app/library/symbols.txt"));
    for (std::string line; std::getline(list, line);) {
        expected.push_back(line);
    }
    EXPECT_EQ(found, expected);
}

TEST(ContactLibrary, NeedsNeitherQtNorGdal)
{
    const std::string dynamic = runTool({"readelf", "-d", MARSVIEW_CONTACT_LIBRARY});
    EXPECT_THAT(dynamic, HasSubstr("Library soname: [libmarsview-contact.so.1]"));
    for (const char* library : {"Qt", "gdal", "tiff", "Geographic"}) {
        EXPECT_THAT(dynamic, Not(HasSubstr(library)));
    }
}

TEST(ContactLibrary, BuildsAProgramOutsideTheTree)
{
    const TempFolder folder;
    const std::string prefix = folder.file("prefix");
    const std::string example = (sourceRoot() / "tests/library_example").string();
    const std::string build = folder.file("build");
    for (const char* component : {"contact_library", "contact_development"}) {
        runTool(
            {"cmake", "--install", MARSVIEW_BUILD, "--component", component, "--prefix", prefix});
    }
    runTool({"cmake", "-S", example, "-B", build, "-DCMAKE_PREFIX_PATH=" + prefix,
             "-DCMAKE_BUILD_TYPE=Debug"});
    runTool({"cmake", "--build", build});
    const std::string by_cmake = runTool({build + "/touch_a_crater"});
    EXPECT_THAT(by_cmake, testing::StartsWith("MarsView " MARSVIEW_VERSION ": "));
    EXPECT_THAT(by_cmake, Not(HasSubstr(": 0 of 2000")));

    std::string pc_folder;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(prefix)) {
        if (entry.path().filename() == "marsview-contact.pc") {
            pc_folder = entry.path().parent_path().string();
        }
    }
    std::istringstream words(runTool({"env", "PKG_CONFIG_PATH=" + pc_folder, "pkg-config",
                                      "--cflags", "--libs", "marsview-contact"}));
    std::vector<std::string> arguments{"c++",
                                       "-std=c++17",
                                       example + "/touch_a_crater.cpp",
                                       "-o",
                                       folder.file("by_pkg_config"),
                                       "-Wl,-rpath," + pc_folder + "/.."};
    for (std::string word; words >> word;) {
        arguments.push_back(word);
    }
    runTool(arguments);
    EXPECT_EQ(runTool({folder.file("by_pkg_config")}), by_cmake);
}

TEST(ContactLibrary, IsASubdirectoryOfAnotherProject)
{
    const TempFolder folder;
    const std::string source = folder.path().string();
    folder.write("CMakeLists.txt",
                 "cmake_minimum_required(VERSION 3.25)\n"
                 "project(outside LANGUAGES CXX)\n"
                 "add_subdirectory(\"" +
                     (sourceRoot() / "app/library").string() +
                     "\" contact)\n"
                     "add_executable(outside main.cpp)\n"
                     "target_link_libraries(outside PRIVATE marsview::contact)\n");
    folder.write("main.cpp", "int main() {}\n");
    runTool({"cmake", "-G", "Ninja", "-S", source, "-B", folder.file("build")});
    // The library itself is compiled by the main build; here only what would be done.
    EXPECT_THAT(runTool({"cmake", "--build", folder.file("build"), "--", "-n"}),
                HasSubstr("libmarsview-contact.so.1"));
}

} // namespace
} // namespace marsview::test
