// The page that documents the JSON output lists exactly the fields that the program prints.
#include "tests/cli/run_cli.h"
#include "tests/support/make_raster.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

namespace marsview::test {
namespace {

using Names = std::set<std::string>;

struct DocumentedFields {
    Names always;
    Names sometimes; // marked "only" in the page's second column
};

// The tables of resources/guide/json.md by their headings: "| `field` | type | meaning |".
std::map<std::string, DocumentedFields> documentedFields()
{
    std::map<std::string, DocumentedFields> sections;
    std::istringstream page(readFile(sourceRoot() / "resources/guide/json.md"));
    std::string heading;
    for (std::string line; std::getline(page, line);) {
        constexpr std::string_view kHeading = "## `";
        if (line.starts_with(kHeading)) {
            heading = line.substr(kHeading.size(), line.rfind('`') - kHeading.size());
            sections[heading]; // a section may be empty
        }
        constexpr std::string_view kRow = "| `";
        if (line.starts_with(kRow)) {
            const std::string name =
                line.substr(kRow.size(), line.find('`', kRow.size()) - kRow.size());
            const std::size_t begin = line.find('|', 1) + 1;
            const std::string type = line.substr(begin, line.find('|', begin) - begin);
            auto& section = sections[heading];
            (type.find("only") != std::string::npos ? section.sometimes : section.always)
                .insert(name);
        }
    }
    return sections;
}

// "a", "a.b", "a[].b": fields of objects, and of objects in arrays.
void addNames(const nlohmann::json& json, const std::string& prefix, Names& names)
{
    if (json.is_object()) {
        for (const auto& [key, value] : json.items()) {
            const std::string name = prefix.empty() ? key : prefix + "." + key;
            names.insert(name);
            addNames(value, name, names);
        }
    } else if (json.is_array()) {
        for (const auto& item : json) {
            addNames(item, prefix + "[]", names);
        }
    }
}

// Names below one that is documented as free ("force_off_s.*") are not listed separately.
Names withoutFree(const Names& names, const DocumentedFields& documented)
{
    Names kept;
    for (const std::string& name : names) {
        const std::size_t dot = name.rfind('.');
        const bool is_free =
            dot != std::string::npos && documented.sometimes.contains(name.substr(0, dot) + ".*");
        if (!is_free) {
            kept.insert(name);
        }
    }
    return kept;
}

void expectDocumented(const std::string& heading, const nlohmann::json& json)
{
    SCOPED_TRACE(heading);
    const auto sections = documentedFields();
    ASSERT_TRUE(sections.contains(heading));
    const DocumentedFields& documented = sections.at(heading);
    EXPECT_EQ(json["schema"], 1);
    Names printed;
    addNames(json, "", printed);
    printed = withoutFree(printed, documented);
    for (const std::string& name : printed) {
        EXPECT_TRUE(documented.always.contains(name) || documented.sometimes.contains(name))
            << name << " is printed but not documented";
    }
    for (const std::string& name : documented.always) {
        EXPECT_TRUE(printed.contains(name)) << name << " is documented but not printed";
    }
}

nlohmann::json printed(const std::vector<std::string>& arguments, const std::string& input = "")
{
    const ProgramOutput output = runCli(arguments, input);
    EXPECT_EQ(output.exit_status, 0) << output.err;
    return nlohmann::json::parse(output.out);
}

} // namespace

TEST(JsonPage, ListsTheFieldsOfInfoAndSample)
{
    expectDocumented("info", cliInfo(bundledMars()));
    expectDocumented("info", cliInfo(bundledMountain()));
    expectDocumented("sample", printed({"sample", bundledMars(), "--pixel", "1,2", "--json"}));
}

TEST(JsonPage, ListsTheFieldsOfMeasurements)
{
    const std::string line = "226.2 18.65\n230 20\n228 15\n";
    for (const char* command : {"distance", "area", "profile", "attitude", "crater", "slope"}) {
        expectDocumented(
            fmt::format("measure {}", command),
            printed({"measure", command, bundledMars(), "--points", "-", "--json"}, line));
    }
    expectDocumented("measure area", printed({"measure", "area", bundledMars(), "--points", "-",
                                              "--base", "plane", "--json"},
                                             line));
    expectDocumented("measure area", printed({"measure", "area", bundledMars(), "--points", "-",
                                              "--hypsometry", "--json"},
                                             line));
    expectDocumented(
        "measure slope",
        printed({"measure", "slope", bundledMars(), "--points", "-", "--json"}, "226 18"));
}

TEST(JsonPage, ListsTheFieldsOfTraceAndLoop)
{
    const TempFolder folder;
    const std::string summary = folder.file("summary.json");
    ASSERT_EQ(runCli({"trace", bundledMars(), "--goals", "-", "--summary", summary},
                     "x,y,z\n225,18,25000\n226,18.5,15000\n")
                  .exit_status,
              0);
    expectDocumented("trace --summary", nlohmann::json::parse(readFile(summary)));
    expectDocumented(
        "loop", printed({"loop", bundledMars(), "--device", "sim:", "--seconds", "0.5", "--json"}));
}

TEST(JsonPage, ListsTheFieldsOfPrepareAndDevices)
{
    const TempFolder folder;
    expectDocumented("prepare",
                     printed({"prepare", bundledMars(), "-o", folder.file("mars.tif"), "--json"}));
    const auto part = [&folder](std::vector<std::string> which) {
        std::vector<std::string> arguments{
            "prepare", bundledMars(), "-o", folder.file("parts.tif"), "--parts", "2"};
        arguments.insert(arguments.end(), which.begin(), which.end());
        arguments.push_back("--json");
        return printed(arguments);
    };
    expectDocumented("prepare --part", part({"--part", "1"}));
    expectDocumented("prepare --part", part({"--part", "2"}));
    expectDocumented("prepare --join", part({"--join"}));
    expectDocumented("devices", printed({"devices", "--json"}));
    const std::string plugin = std::string(MARSVIEW_TEST_PLUGINS) + "/has_none.so";
    expectDocumented("devices --check", printed({"devices", "--check", plugin, "--json"}));
}

TEST(JsonPage, ListsTheFieldsOfBenchmarks)
{
    const TempFolder folder;
    expectDocumented("bench contact", printed({"bench", "contact", "--size", "64", "--updates",
                                               "20", "--speeds", "1", "--scales", "1", "--json"}));
    expectDocumented("bench view", printed({"bench", "view", bundledMountain(), "--size", "160x120",
                                            "--frames", "2", "--poses", "1", "--json"}));
    expectDocumented("bench view",
                     printed({"bench", "view", bundledMountain(), "--scene", "body", "--size",
                              "160x120", "--frames", "2", "--poses", "1", "--json"}));
    const std::string made = folder.file("made.tif");
    expectDocumented("bench terrain", printed({"bench", "terrain", bundledMountain(), "--only",
                                               "prepare", "--json"}));
    expectDocumented("bench terrain --make",
                     printed({"bench", "terrain", "--make", made, "--size", "1500x750", "--json"}));
}

TEST(JsonPage, ListsTheFieldsOfErrors)
{
    const ProgramOutput output = runCli({"info", "/no/such/map.tif", "--json"});
    expectDocumented("errors", nlohmann::json::parse(output.err));
}

} // namespace marsview::test
