// The arrows of the architecture, read from the sources themselves.
#include "tests/architecture/folder_graph.h"
#include "tests/architecture/include_rules.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string>
#include <utility>
#include <vector>

namespace marsview::test {
namespace {

namespace fs = std::filesystem;

// A folder with more files than this should be split.
constexpr std::size_t kFilesMax = 45;

bool isSource(const std::string& path)
{
    return path.ends_with(".h") || path.ends_with(".cpp") || path.ends_with(".c");
}

// Paths relative to the source root.
std::vector<std::string> filesOfTheProject()
{
    std::vector<std::string> paths;
    for (const char* folder : {"app", "core", "haptics", "ui", "tests"}) {
        const fs::path root = sourceRoot() / folder;
        if (!fs::exists(root)) {
            continue;
        }
        for (const auto& entry : fs::recursive_directory_iterator(root)) {
            if (entry.is_regular_file()) {
                paths.push_back(fs::relative(entry.path(), sourceRoot()).generic_string());
            }
        }
    }
    return paths;
}

// The names of all #include directives, in quotes and in brackets.
std::vector<Include> includesOfTheProject()
{
    std::vector<Include> includes;
    for (const std::string& path : filesOfTheProject()) {
        if (isSource(path)) {
            for (const std::string& header : includesOf(readFile(sourceRoot() / path))) {
                includes.push_back({path, header});
            }
        }
    }
    return includes;
}

std::vector<Include> ownIncludesOfTheProject()
{
    std::vector<Include> includes = includesOfTheProject();
    std::erase_if(includes, [](const Include& include) { return include.header.front() == '<'; });
    return includes;
}

TEST(Layering, EveryIncludeFollowsTheLayers)
{
    const std::vector<Include> includes = includesOfTheProject();
    for (const Include& include : includes) {
        if (const auto why = violation(include.file, include.header)) {
            ADD_FAILURE() << *why;
        }
    }
    std::printf("%zu includes\n", includes.size());
    EXPECT_GT(includes.size(), 200U); // or the test looks in the wrong place
}

TEST(Layering, FoldersHaveNoCycles)
{
    for (const FolderCycle& cycle : folderCycles(ownIncludesOfTheProject())) {
        std::string lines;
        for (const Include& include : cycle.includes) {
            lines += fmt::format("\n  {} includes {}", include.file, include.header);
        }
        ADD_FAILURE() << fmt::format("{} → {}:{}", fmt::join(cycle.folders, " → "),
                                     cycle.folders.front(), lines);
    }
}

TEST(Layering, NoFolderIsCrowded)
{
    const std::vector<std::string> paths = filesOfTheProject();
    for (const auto& [folder, files] : crowdedFolders(paths, kFilesMax)) {
        ADD_FAILURE() << fmt::format("{} has {} files; split it into rooms of at most {}", folder,
                                     files, kFilesMax);
    }
    for (const auto& [folder, files] : crowdedFolders(paths, kFilesMax - 5)) {
        std::printf("%s: %zu files of at most %zu\n", folder.c_str(), files, kFilesMax);
    }
    EXPECT_GT(paths.size(), 100U); // or the test looks in the wrong place
}

TEST(IncludeRules, ReadOnlyIncludeDirectives)
{
    const char* source =
        "// #include \"core/a.h\"\n"
        "#include \"core/b.h\"\n"
        "  #  include <QWidget> // why\n"
        "/* #include \"core/c.h\"\n"
        "#include \"core/d.h\"\n"
        "*/ #include \"core/e.h\"\n"
        "#ifdef X /* one line */\n"
        "#include <gdal_priv.h>\n"
        "const char* s = \"#include <nothing>\";\n"
        "#include \"core/last.h\"";
    const std::vector<std::string> expected{"core/b.h", "<QWidget>", "core/e.h", "<gdal_priv.h>",
                                            "core/last.h"};
    EXPECT_EQ(includesOf(source), expected);
}

TEST(IncludeRules, FindPlantedViolations)
{
    const std::pair<const char*, const char*> table[] = {
        {"core/geo/crs.cpp", "core/raster/raster_file.h"},
        {"core/base/angle.h", "core/geo/frames.h"},
        {"core/files/open_guard.cpp", "core/raster/raster_file.h"},
        {"core/raster/raster_file.cpp", "core/tiles/tile.h"},
        {"core/raster/raster_file.cpp", "core/terrain/heightfield.h"},
        {"core/tiles/tile_cache.cpp", "core/prepare/map_folder.h"},
        {"core/terrain/heightfield.h", "core/levels/level_file.h"},
        {"core/levels/level_file.cpp", "core/prepare/level_builder.h"},
        {"core/prepare/level_builder.cpp", "core/session/dataset.h"},
        {"core/terrain/heightfield.h", "core/contact/proxy.h"},
        {"core/contact/proxy.cpp", "core/view/camera.h"},
        {"core/measure/profile.cpp", "core/contact/proxy.h"},
        {"core/view/camera.cpp", "core/measure/profile.h"},
        {"core/view/camera.cpp", "core/session/map.h"},
        {"core/session/map.cpp", "haptics/device/device.h"},
        {"core/session/map.cpp", "ui/bridge/loader.h"},
        {"core/session/map.cpp", "app/cli/info.h"},
        {"core/session/map.cpp", "<QString>"},
        {"core/session/map.cpp", "<QtCore/QString>"},
        {"core/session/map.cpp", "<gdal_priv.h>"},
        {"core/terrain/heightfield.cpp", "<ogr_spatialref.h>"},
        {"core/base/check.cpp", "<cpl_conv.h>"},
        {"haptics/loop/loop.cpp", "ui/render/scene.h"},
        {"haptics/loop/loop.cpp", "<QThread>"},
        {"haptics/loop/loop.cpp", "<hidapi/hidapi.h>"},
        {"haptics/device/registry.cpp", "<hidapi.h>"},
        {"haptics/loop/loop.cpp", "<AL/al.h>"},
        {"ui/bridge/sound.cpp", "<AL/alc.h>"},
        {"ui/render/scene.cpp", "<QOpenGLContext>"},
        {"ui/render/scene.cpp", "ui/widgets/map_view.h"},
        {"ui/render/scene.cpp", "haptics/loop/loop.h"},
        {"ui/canvas/map_view.cpp", "app/gui/main_window.h"},
        {"ui/canvas/map_view.cpp", "<gdal.h>"},
        {"ui/canvas/map_view.cpp", "ui/controllers/session_controller.h"},
        {"ui/controllers/session_controller.cpp", "ui/panels/layers_panel.h"},
        {"ui/widgets/icons.cpp", "ui/controllers/preferences.h"},
        {"ui/text/number_text.cpp", "ui/widgets/icons.h"},
        {"app/cli/main.cpp", "<QCoreApplication>"},
        {"app/cli/main.cpp", "ui/widgets/map_view.h"},
        {"app/cli/main.cpp", "app/gui/main_window.h"},
        {"app/console/scene.cpp", "app/cli/commands.h"},
        {"app/bench/view_bench.cpp", "app/cli/commands.h"},
        {"app/documents/manual_page.cpp", "app/cli/commands.h"},
        {"app/bench/reference/flight.cpp", "ui/render/opengl/frame_buffer.h"},
        {"app/bench/view_bench.cpp", "<gdal_priv.h>"},
        {"app/probe/main.cpp", "core/session/session.h"},
        {"tests/core/raster/x_test.cpp", "app/gui/main_window.h"},
        {"tests/core/raster/x_test.cpp", "<gdal_priv.h>"},
        {"tests/core/view/x_test.cpp", "ui/widgets/map_view.h"},
        {"tests/architecture/x_test.cpp", "core/base/angle.h"},
        {"core/geo/crs.cpp", "crs.h"},
        {"core/geo/crs.cpp", "../base/angle.h"},
        {"core/geo/crs.cpp", "<core/base/angle.h>"},
        {"tools/helper.cpp", "core/base/angle.h"},
    };
    for (const auto& [path, include] : table) {
        EXPECT_TRUE(violation(path, include)) << path << " may include " << include;
    }
}

TEST(IncludeRules, AllowWhatTheArchitectureAllows)
{
    const std::pair<const char*, const char*> table[] = {
        {"core/geo/crs.cpp", "core/base/angle.h"},
        {"core/geo/crs.cpp", "<ogr_spatialref.h>"},
        {"core/geo/body.cpp", "<GeographicLib/Ellipsoid.hpp>"},
        {"core/raster/raster_file.cpp", "<gdal_priv.h>"},
        {"core/session/map.cpp", "core/raster/raster_file.h"},
        {"core/contact/proxy.cpp", "core/terrain/triangulation.h"},
        {"haptics/loop/loop.cpp", "core/contact/proxy.h"},
        {"haptics/drivers/hid_device.cpp", "<hidapi/hidapi.h>"},
        {"haptics/sound/sound_player.cpp", "<AL/alext.h>"},
        {"ui/render/scene.cpp", "core/view/camera.h"},
        {"ui/render/scene.cpp", "<epoxy/gl.h>"},
        {"ui/canvas/map_view.cpp", "ui/render/scene.h"},
        {"ui/canvas/map_view.cpp", "<QOpenGLWidget>"},
        {"app/gui/main.cpp", "ui/widgets/map_view.h"},
        {"app/cli/main.cpp", "ui/render/scene.h"},
        {"app/probe/main.cpp", "core/files/open_probe.h"},
        {"tests/ui/window_arguments_test.cpp", "app/gui/window_arguments.h"},
        {"tests/support/faulty_driver/faulty_driver.cpp", "<gdal_priv.h>"},
        {"tests/core/raster/x_test.cpp", "tests/support/random.h"},
        {"core/base/check.cpp", "<cstdio>"},
        {"core/base/x.cpp", "<queue>"},
    };
    for (const auto& [path, include] : table) {
        EXPECT_FALSE(violation(path, include)) << violation(path, include).value_or("");
    }
}

} // namespace
} // namespace marsview::test
