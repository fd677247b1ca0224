#include "app/cli/devices_command.h"
#include "tests/cli/run_cli.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tuple>

namespace marsview::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

// The program with its own folders for plugins and for their stored state.
class DevicesCommand : public testing::Test {
protected:
    void SetUp() override { fs::create_directories(plugins()); }

    fs::path plugins() const { return folder_.path() / "data" / "marsview" / "plugins"; }
    void add(const std::string& behaviour) const
    {
        const std::string name = behaviour + ".so";
        fs::copy_file(fs::path(MARSVIEW_TEST_PLUGINS) / name, plugins() / name);
    }
    ProgramOutput devices(const std::vector<std::string>& options = {}) const
    {
        std::vector<std::string> arguments{"devices"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return runCliWith({"XDG_DATA_HOME=" + folder_.file("data"),
                           "XDG_STATE_HOME=" + folder_.file("state"), "MARSVIEW_PLUGIN_PATH="},
                          arguments);
    }
    // The report about the plugin with this behavior.
    nlohmann::json entry(const std::string& behaviour) const
    {
        const ProgramOutput output = devices({"--json"});
        EXPECT_EQ(output.exit_status, 0) << output.err;
        const nlohmann::json report = nlohmann::json::parse(output.out);
        for (const auto& device : report["devices"]) {
            const auto uri = device["uri"].get<std::string>();
            if (uri.find(behaviour + ".so") != std::string::npos) {
                return device;
            }
        }
        return {};
    }

    TempFolder folder_;
};

} // namespace

TEST_F(DevicesCommand, ListsPluginsOfTheUsersFolderAndWhyOneIsRefused)
{
    add("is_good");
    add("has_other_version");
    const nlohmann::json good = entry("is_good");
    EXPECT_EQ(good["uri"], "plugin:" + (plugins() / "is_good.so").string());
    EXPECT_EQ(good["name"], "Tiny");
    EXPECT_EQ(good["usable"], true);
    EXPECT_TRUE(good["reason"].is_null());
    const nlohmann::json other = entry("has_other_version");
    EXPECT_EQ(other["usable"], false);
    EXPECT_THAT(other["reason"].get<std::string>(), HasSubstr("is built for version 2"));

    const ProgramOutput table = devices();
    EXPECT_EQ(table.exit_status, 0) << table.err;
    EXPECT_THAT(table.out, StartsWith("URI "));
    EXPECT_THAT(table.out, HasSubstr("is_good.so            Tiny  "));
    EXPECT_THAT(table.out, HasSubstr("is built for version 2"));
}

TEST_F(DevicesCommand, ListsTheSchemes)
{
    const ProgramOutput output = devices({"--json"});
    ASSERT_EQ(output.exit_status, 0) << output.err;
    const auto schemes =
        nlohmann::json::parse(output.out)["schemes"].get<std::vector<std::string>>();
    EXPECT_NE(std::find(schemes.begin(), schemes.end(), "plugin"), schemes.end());
}

TEST_F(DevicesCommand, SkipsACrashedPluginUntilRetried)
{
    add("crashes_loading");
    EXPECT_NE(devices().exit_status, 0);
    const nlohmann::json refused = entry("crashes_loading");
    EXPECT_EQ(refused["usable"], false);
    EXPECT_THAT(refused["reason"].get<std::string>(), HasSubstr("skipped"));
    EXPECT_NE(devices({"--retry"}).exit_status, 0);
}

TEST_F(DevicesCommand, ReportsTheLastProblemOfADevice)
{
    add("fails_opening");
    const std::string uri = "plugin:" + (plugins() / "fails_opening.so").string();
    const ProgramOutput loop = runCliWith({"XDG_STATE_HOME=" + folder_.file("state")},
                                          {"loop", bundledMars(), "--device", uri});
    EXPECT_EQ(loop.exit_status, 1);
    const nlohmann::json found = entry("fails_opening");
    EXPECT_EQ(found["usable"], true);
    EXPECT_EQ(found["reason"], "last time it was used: could not be opened: the cover is open");
    EXPECT_THAT(devices().out, HasSubstr("ready; last time it was used: could not be opened"));
}

TEST(DevicesTable, AlignsColumnsWithOneDevicePerLine)
{
    EXPECT_EQ(devicesAsTable({{"null:", "Nothing", ""}, {"x:1\n2", "A hand", "no\npower"}}),
              "URI    name     state\n"
              "null:  Nothing  ready\n"
              "x:1 2  A hand   no power");
    EXPECT_EQ(devicesAsTable({{"x:", "A hand", "the last\ntime: no power", true}}),
              "URI  name    state\n"
              "x:   A hand  ready; the last time: no power");
    EXPECT_EQ(devicesAsTable({{"x:", "A h\xe4nd", ""}}),
              "URI  name    state\n"
              "x:   A h\xef\xbf\xbdnd  ready");
}

// The outcome of the last check that `devices --check` began.
nlohmann::json lastCheck(const std::string& behaviour, int exit_status)
{
    const fs::path plugin = fs::path(MARSVIEW_TEST_PLUGINS) / (behaviour + ".so");
    const ProgramOutput output = runCli({"devices", "--check", plugin.string(), "--json"});
    EXPECT_EQ(output.exit_status, exit_status) << behaviour << ": " << output.out << output.err;
    return nlohmann::json::parse(output.out)["checks"].back();
}

TEST(PluginCheck, PassesAPluginWithoutFaults)
{
    EXPECT_EQ(lastCheck("is_good", 0)["check"], "can be closed");
    EXPECT_EQ(lastCheck("is_first", 0)["check"], "can be closed"); // against the first header
    EXPECT_THAT(lastCheck("has_none", 0)["check"], "refuses an unknown device");
}

TEST(PluginCheck, NamesTheFault)
{
    for (const auto& [behaviour, check, reason] :
         {std::tuple{"lacks_read", "loads", "lacks the function \"read\""},
          std::tuple{"has_other_version", "loads", "version"},
          std::tuple{"crashes_listing", "lists", "crashes: "},
          std::tuple{"crashes_reading", "delivers", "crashes: "},
          std::tuple{"is_negative", "opens", "peak force of -"},
          std::tuple{"says_nan", "delivers", "not finite"},
          std::tuple{"is_lost", "delivers", "its cable is out"},
          std::tuple{"says_unready", "delivers", "gives no reason"}}) {
        const nlohmann::json last = lastCheck(behaviour, 1);
        EXPECT_FALSE(last["passed"]) << behaviour;
        EXPECT_THAT(last["check"].get<std::string>(), StartsWith(check)) << behaviour;
        EXPECT_THAT(last["reason"].get<std::string>(), HasSubstr(reason)) << behaviour;
    }
    const ProgramOutput missing = runCli({"devices", "--check", "no/such.so"});
    EXPECT_EQ(missing.exit_status, 1);
    EXPECT_EQ(missing.err, "marsview-cli: no/such.so: there is no such file\n");
}

// As a plugin author would build it: against an installed program, with CMake and with pkg-config.
TEST_F(DevicesCommand, ListsTheExamplePluginBuiltAsDocumented)
{
    const std::string prefix = folder_.file("prefix");
    const std::string example = (sourceRoot() / "tests/plugin_example").string();
    const std::string build = folder_.file("build");
    runTool({"cmake", "--install", MARSVIEW_BUILD, "--component", "plugin_development", "--prefix",
             prefix});
    runTool({"cmake", "-S", example, "-B", build, "-DCMAKE_PREFIX_PATH=" + prefix,
             "-DCMAKE_BUILD_TYPE=Release"});
    runTool({"cmake", "--build", build});
    runTool({"cmake", "--install", build});
    fs::path installed;
    for (const auto& entry : fs::recursive_directory_iterator(prefix)) {
        if (entry.path().filename() == "rocking_hand.so") {
            installed = entry.path();
        }
    }
    EXPECT_THAT(installed.string(), HasSubstr("/marsview/plugins/rocking_hand.so"));

    const std::string variable = "PKG_CONFIG_PATH=" + prefix + "/share/pkgconfig";
    std::string flags = runTool({"env", variable, "pkg-config", "--cflags", "marsview-plugin"});
    flags.erase(flags.find_last_not_of(" \n") + 1);
    const std::string plugin_folder =
        runTool({"env", variable, "pkg-config", "--variable=plugindir", "marsview-plugin"});
    EXPECT_EQ(fs::weakly_canonical(plugin_folder.substr(0, plugin_folder.find('\n'))),
              fs::weakly_canonical(installed.parent_path()));
    runTool({"cc", "-std=c99", "-shared", "-fPIC", flags, example + "/rocking_hand.c", "-lm", "-o",
             (plugins() / "rocking_hand.so").string()});
    const nlohmann::json found = entry("rocking_hand");
    EXPECT_EQ(found["name"], "Rocking hand");
    EXPECT_EQ(found["usable"], true) << found["reason"];
    EXPECT_THAT(found["uri"].get<std::string>(), testing::EndsWith("rocking_hand.so#left"));
}

} // namespace marsview::test
