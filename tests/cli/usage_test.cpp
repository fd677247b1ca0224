// Usage errors reported before any file is opened, and the argument forms that are accepted.
#include "tests/cli/run_cli.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <thread>

namespace marsview::test {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;
using Words = std::vector<std::string>;

// The first line on stderr of a command that must exit with status 2.
std::string refusal(const Words& arguments)
{
    const ProgramOutput output = runCli(arguments);
    EXPECT_EQ(output.exit_status, 2) << fmt::format("{}", fmt::join(arguments, " ")) << "\n"
                                     << output.out << output.err;
    EXPECT_EQ(output.out, "");
    return output.err.substr(0, output.err.find('\n'));
}

Words with(Words arguments, const Words& more)
{
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

} // namespace

TEST(Usage, NamesUnknownCommandsAndSuggestsTheNearest)
{
    EXPECT_EQ(refusal({"inof", bundledMars()}),
              "marsview-cli: inof: unknown command. Did you mean \"info\"?");
    EXPECT_EQ(refusal({"bench", "contcat"}),
              "marsview-cli: contcat: unknown command of bench. Did you mean \"contact\"?");
    EXPECT_EQ(refusal({"juggle"}),
              "marsview-cli: juggle: unknown command; known ones are info, sample, measure, trace, "
              "loop, prepare, render, thumbnail, devices, bench");
    // The unknown command is named, not the option before it.
    EXPECT_THAT(refusal({"--json", "inof", bundledMars()}),
                HasSubstr("\"what\":\"inof\",\"message\":\"unknown command. Did you mean"));
    EXPECT_THAT(
        refusal({"--json", "info", bundledMars()}),
        HasSubstr("\"what\":\"--json\",\"message\":\"belongs after the command: info --json"));
    EXPECT_EQ(refusal({"--exaggeration", "3", "render", bundledMars()}),
              "marsview-cli: --exaggeration: unknown option");
    EXPECT_THAT(refusal({}), StartsWith("marsview-cli: a command is missing; known ones are info"));
    EXPECT_THAT(refusal({"bench"}), StartsWith("marsview-cli: bench: a command is missing; known "
                                               "ones are view"));
}

TEST(Usage, NamesUnknownOptionsAndSuggestsTheNearest)
{
    EXPECT_EQ(refusal({"info", bundledMars(), "--jsno"}),
              "marsview-cli: --jsno: unknown option of info. Did you mean \"--json\"?");
    EXPECT_EQ(refusal({"info", bundledMars(), "--js"}),
              "marsview-cli: --js: unknown option of info. Did you mean \"--json\"?");
    EXPECT_EQ(refusal({"render", bundledMars(), "-o", "x.png", "--exagerration=3"}),
              "marsview-cli: --exagerration: unknown option of render. Did you mean "
              "\"--exaggeration\"?");
    EXPECT_EQ(refusal({"--frobnicate"}), "marsview-cli: --frobnicate: unknown option");
    EXPECT_THAT(refusal({"info", bundledMars(), "-x"}), HasSubstr("-x: unknown option of info"));
    EXPECT_THAT(refusal({"devices", "everything"}),
                HasSubstr("everything: unexpected argument of devices"));
}

TEST(Usage, RefusesOptionsAfterTheDoubleDashAndOptionsThatAreGivenTwice)
{
    EXPECT_EQ(refusal({"sample", "--", bundledMars(), "--pixel", "1", "2"}),
              "marsview-cli: --pixel: unexpected argument of sample");
    EXPECT_EQ(refusal({"sample", bundledMars(), "--pixel", "1", "2", "--pixel=3,4"}),
              "marsview-cli: --pixel: given twice");
    EXPECT_EQ(refusal({"render", bundledMars(), "-o", "a.png", "--output", "b.png"}),
              "marsview-cli: --output: given twice");
}

TEST(Usage, RefusesValuesOfTheWrongFormOrOutsideTheirRange)
{
    const Words render{"render", bundledMars(), "-o", "x.png"};
    const Words trace{"trace", bundledMars(), "--goals", "-"};
    const Words loop{"loop", bundledMars(), "--device", "null:"};
    const Words sample{"sample", bundledMars()};
    const Words info{"info", bundledMars()};
    struct Case {
        Words arguments;
        std::string option;
    };
    const std::vector<Case> cases{
        {with(render, {"--size", "12"}), "--size"},
        {with(render, {"--size", "12x"}), "--size"},
        {with(render, {"--size", "0x10"}), "--size"},
        {with(render, {"--size", "99999x10"}), "--size"},
        {{"render", bundledMars(), "-o", "x.gif"}, "-o"},
        {{"render", bundledMars(), "-ox.gif"}, "-o"},
        {{"render", bundledMars(), "--output", "x.gif"}, "--output"},
        {{"render", bundledMars(), "--output=x.gif"}, "--output"},
        {{"render", bundledMars(), "-o", ".png"}, "-o"},
        {{"prepare", bundledMars(), "-o", "x.gif"}, "-o"},
        {with(render, {"--tilt", "200"}), "--tilt"},
        {with(render, {"--tilt", "nan"}), "--tilt"},
        {with(render, {"--azimuth", "inf"}), "--azimuth"},
        {with(render, {"--distance", "-5"}), "--distance"},
        {with(render, {"--exaggeration", "0"}), "--exaggeration"},
        {with(render, {"--error-px", "-1"}), "--error-px"},
        {with(render, {"--samples", "1.5"}), "--samples"},
        {with(render, {"--samples", "17"}), "--samples"},
        {with(render, {"--shading", "tnit"}), "--shading"},
        {with(render, {"--ramp", "rainbow"}), "--ramp"},
        {with(render, {"--light", "315"}), "--light"},
        {with(render, {"--light", "315,45,3"}), "--light"},
        {with(render, {"--scene", "body", "--sun-at", "315"}), "--sun-at"},
        {with(render, {"--scene", "body", "--sun-at", "1,2,3"}), "--sun-at"},
        {with(render, {"--scene", "body", "--sun-at", "1,nan"}), "--sun-at"},
        {with(render, {"--scene", "body", "--sun-at", "east,2"}), "--sun-at"},
        {with(render, {"--scene", "body", "--sun-at", "1,90.1"}), "--sun-at"},
        {with(render, {"--scene", "body", "--sun-at", "1,2", "--light", "1,2"}), "--light"},
        {with(render, {"--sun-at", "1,2"}), "--sun-at"},
        {with(render, {"--scene", "flat", "--sun-at", "1,2"}), "--sun-at"},
        {with(render, {"--look-at", "1,nan"}), "--look-at"},
        {with(render, {"--look-at", "1"}), "--look-at"},
        {with(render, {"--full", "--error-px", "2"}), "--error-px"},
        {with(trace, {"--model", "foo"}), "--model"},
        {with(trace, {"--radius", "1"}), "--radius"},
        {with(trace, {"--model", "virtual-proxy", "--radius", "nan"}), "--radius"},
        {with(trace, {"--exaggeration", "1e"}), "--exaggeration"},
        {{"trace", bundledMars()}, "--goals"},
        {with(loop, {"--seconds", "-1"}), "--seconds"},
        {{"loop", bundledMars(), "--device", "foo"}, "--device"},
        {{"loop", bundledMars(), "--device", "foo:"}, "--device"},
        {{"loop", bundledMars(), "--device", "null"}, "--device"},
        {with(loop, {"--stiffness", "soft"}), "--stiffness"},
        {with(loop, {"--across", "0"}), "--across"},
        {{"loop", bundledMars()}, "--device"},
        {with(sample, {"--pixel", "1"}), "--pixel"},
        {with(sample, {"--pixel", "1", "nan"}), "--pixel"},
        {with(sample, {"--pixel", "one,2"}), "--pixel"},
        {with(sample, {"--lonlat", "1,,2"}), "--lonlat"},
        {with(sample, {"--pixel", "1,2", "--map", "1,2"}), "--map"},
        {sample, "--map"},
        {with(info, {"--band", "0"}), "--band"},
        {with(info, {"--band", "1.5"}), "--band"},
        {with(info, {"--body", "Vulcan"}), "--body"},
        {with(info, {"--crs", "EPSG:999999"}), "--crs"},
        {with(info, {"--unit", "cubits"}), "--unit"},
        {with(info, {"--radii", "3e6,-1"}), "--radii"},
        {with(info, {"--radii", "1,2,3"}), "--radii"},
        {with(info, {"--radii", "1"}), "--radii"},
        {with(info, {"--radii", "3376200,3396190"}), "--radii"},
        {with(info, {"--geotransform", "0,0,0,0,0,0"}), "--geotransform"},
        {with(info, {"--geotransform", "0,1,1,0,1,1"}), "--geotransform"},
        {with(info, {"--crs", "EPSG:5703"}), "--crs"},
        {with(info, {"--vertical-datum", " "}), "--vertical-datum"},
        {with(render, {"--exaggeration", "1e300"}), "--exaggeration"},
        {with(loop, {"--exaggeration", "1e-300"}), "--exaggeration"},
        {with(trace, {"--exaggeration", "1e7"}), "--exaggeration"},
        {{"render", bundledMars(), "-o", "file://elsewhere/x.png"}, "-o"},
        {{"measure", "slope", bundledMars(), "--points", "file:///a%zz"}, "--points"},
        {with(loop, {"--record", "file://elsewhere/x.csv"}), "--record"},
        {with(info, {"--geotransform", "0,1,0,0,0"}), "--geotransform"},
        {with(info, {"--geotransform", "0,1,0,0,0,inf"}), "--geotransform"},
        {with(info, {"--geotransform", "0", "1", "0", "0", "0", "-inf"}), "--geotransform"},
        {with(info, {"--nodata", "void"}), "--nodata"},
        {with(info, {"--scale", "0"}), "--scale"},
        {with(info, {"--offset", "inf"}), "--offset"},
        {with(info, {"--latitude", "magnetic"}), "--latitude"},
        {with(info, {"--json=yes"}), "--json"},
        {with(info, {"--band"}), "--band"},
        {with(info, {"--band", "--crs", "EPSG:4326"}), "--band"},
        {with(info, {"--crs", ""}), "--crs"},
        {{"info", ""}, "DEM"},
        {{"info"}, "DEM"},
        {{"info", "file://elsewhere/a.tif"}, "DEM"},
        {{"prepare", bundledMars(), "--checkpoint", "-1"}, "--checkpoint"},
        {{"bench", "contact", "--size", "3"}, "--size"},
        {{"bench", "contact", "--models", "proxy-graph,foo"}, "--models"},
        {{"bench", "contact", "--speeds", "1,-2"}, "--speeds"},
        {{"bench", "contact", "--plot", "x.png"}, "--plot"},
        {{"bench", "view", "--poses", "-1"}, "--poses"},
        {{"bench", "stability", "--jitter-ms", "1"}, "--jitter-ms"},
        {{"bench", "stability", "--seed", "-1"}, "--seed"},
        {{"bench", "terrain", "--size", "10x10"}, "--size"},
        {{"bench", "terrain", "--only", "everything"}, "--only"},
    };
    for (const Case& c : cases) {
        EXPECT_THAT(refusal(c.arguments), StartsWith("marsview-cli: " + c.option))
            << fmt::format("{}", fmt::join(c.arguments, " "));
    }
}

TEST(Usage, SuggestsTheNearestOfAListOfValues)
{
    EXPECT_THAT(refusal({"render", bundledMars(), "-o", "x.png", "--shading", "tnit"}),
                HasSubstr("Did you mean \"tint\"?"));
    EXPECT_THAT(refusal({"info", bundledMars(), "--body", "Marz"}),
                HasSubstr("Did you mean \"Mars\"?"));
    EXPECT_THAT(
        refusal({"info", bundledMars(), "--body", "Vulcan"}),
        StartsWith("marsview-cli: --body: unknown body \"Vulcan\"; known ones are Mercury, Venus"));
    EXPECT_THAT(refusal({"info", bundledMars(), "--latitude", "magnetic"}),
                EndsWith("is not one of planetocentric, planetographic"));
}

TEST(Usage, AcceptsCommasOrBlanksBetweenNumbers)
{
    const auto out = [](const Words& arguments) {
        const ProgramOutput output = runCli(arguments);
        EXPECT_EQ(output.exit_status, 0) << output.err;
        return output.out;
    };
    const std::string mars = bundledMars();
    const std::string truth = out({"sample", mars, "--lonlat", "-133.8", "18.65"});
    for (const Words& form :
         {Words{"--lonlat", "-133.8,18.65"}, Words{"--lonlat=-133.8,18.65"},
          Words{"--lonlat", "-133.8, 18.65"}, Words{"--lonlat", "-133.8,", "18.65"},
          Words{"--lonlat", "-133.8 18.65"}, Words{"--lonlat=-133.8", "18.65"}}) {
        EXPECT_EQ(out(with({"sample", mars}, form)), truth)
            << fmt::format("{}", fmt::join(form, "|"));
        EXPECT_EQ(out(with(with({"sample"}, form), {mars})), truth) << "before the map is opened";
    }
    const std::string info =
        out({"info", mars, "--geotransform", "-180", "0.25", "0", "90", "0", "-0.25"});
    EXPECT_EQ(out({"info", mars, "--geotransform", "-180,0.25,0,90,0,-0.25"}), info);
    EXPECT_EQ(out({"info", "--geotransform", "-180,0.25", "0,90", "0 -0.25", mars}), info);
    EXPECT_EQ(out({"info", mars, "--geotransform", "-180,.25,0,90,0,-.25"}), info);
    EXPECT_EQ(out({"info", mars, "--geotransform", "-180", ".25", "0", "90", "0", "-.25"}), info);
    const std::string radii = out({"info", mars, "--radii", "3396190", "3376200"});
    EXPECT_EQ(out({"info", mars, "--radii", "3396190,3376200"}), radii);
    EXPECT_EQ(out({"info", "--radii", "3396190", "3376200", mars}), radii);
    EXPECT_EQ(out({"info", "--radii", "3396190", mars}), out({"info", mars, "--radii=3396190"}));
}

TEST(Usage, AcceptsSizesWithACrossACommaOrABlank)
{
    const TempFolder folder;
    std::vector<std::string> pictures;
    int number = 0;
    for (const Words& form : {Words{"--size", "80x60"}, Words{"--size", "80,60"},
                              Words{"--size", "80", "60"}, Words{"--size=80 60"}}) {
        const std::string file = folder.file(fmt::format("{}.png", number++));
        const ProgramOutput output = runCli(with({"render", bundledMars(), "-o", file}, form));
        ASSERT_EQ(output.exit_status, 0) << output.err;
        pictures.push_back(readFile(file));
        EXPECT_EQ(pictures.back(), pictures.front());
    }
}

TEST(Usage, AnswersHelpAndVersionAtAnyPosition)
{
    const std::string mars = bundledMars();
    const std::string version = runCli({"--version"}).out;
    for (const Words& arguments :
         {Words{"sample", mars, "--lonlat", "--version"},
          Words{"sample", mars, "--version", "--lonlat"}, Words{"sample", "--version"},
          Words{"trace", mars, "--goals", "--version"},
          Words{"bench", "contact", "--speeds", "1", "--version"}, Words{"bench", "--version"}}) {
        const ProgramOutput output = runCli(arguments);
        EXPECT_EQ(output.exit_status, 0) << output.err;
        EXPECT_EQ(output.out, version);
    }
    const ProgramOutput help = runCli({"render", mars, "--tilt", "--help"});
    EXPECT_EQ(help.exit_status, 0);
    EXPECT_THAT(help.out, HasSubstr("--exaggeration"));
    EXPECT_EQ(help.err, "");
}

TEST(Usage, OpensFileAddresses)
{
    const TempFolder folder;
    const std::string path = folder.file("a b%.tif");
    std::filesystem::copy_file(bundledMars(), path);
    const std::string encoded = folder.path().string() + "/a%20b%25.tif";
    for (const std::string& address : {"file://" + encoded, "file://localhost" + encoded}) {
        EXPECT_EQ(runCli({"sample", address, "--pixel", "3,4"}).out,
                  runCli({"sample", path, "--pixel", "3,4"}).out);
        EXPECT_EQ(cliInfo(address)["file"], path);
    }
    folder.write("goals a.csv", "x,y,z\n226.2,18.65,30000\n");
    const auto traced = [](const std::string& goals) {
        const test::ProgramOutput output = runCli({"trace", bundledMars(), "--goals", goals});
        EXPECT_EQ(output.exit_status, 0) << output.err;
        return output.out;
    };
    EXPECT_EQ(traced("file://" + folder.path().string() + "/goals%20a.csv"),
              traced(folder.file("goals a.csv")));
}

TEST(Usage, ReadsAndWritesFileAddressesWithEveryOption)
{
    const TempFolder folder;
    const std::string base = "file://" + folder.path().string();
    const std::string mars = bundledMars();
    folder.write("goals a.csv", "x,y,z\n226.2,18.65,30000\n");
    folder.write("points a.csv", "lon,lat\n226.2,18.65\n226.9,18.9\n");
    struct Case {
        Words arguments;
        std::string written{}; // may be empty
    };
    const std::vector<Case> cases{
        {{"measure", "distance", mars, "--points", base + "/points%20a.csv"}},
        {{"measure", "distance", mars, "--vector", base + "/points%20a.csv"}},
        {{"loop", mars, "--device", "replay:" + base + "/goals%20a.csv", "--seconds", "0.1"}},
        {{"loop", mars, "--device", "record:" + base + "/touch%20a.csv,null:", "--seconds", "0.1"},
         "touch a.csv"},
        {{"loop", mars, "--device", "null:", "--seconds", "0.1", "--record", base + "/r%20a.csv"},
         "r a.csv"},
        {{"loop", mars, "--device", "null:", "--seconds", "0.1", "--flight", base + "/f%20a.csv"},
         "f a.csv"},
        {{"trace", mars, "--goals", base + "/goals%20a.csv", "-o", base + "/t%20a.csv"}, "t a.csv"},
        {{"trace", mars, "--goals", base + "/goals%20a.csv", "--summary", base + "/s%20a.json"},
         "s a.json"},
        {{"render", mars, "--size", "40x30", "-o", base + "/p%20a.png"}, "p a.png"},
        {{"prepare", mars, "-o", base + "/m%20a.tif"}, "m a.tif"},
        {{"bench", "terrain", "--make", base + "/b%20a.tif", "--size", "64x64"}, "b a.tif"},
    };
    for (const Case& c : cases) {
        const ProgramOutput output = runCli(c.arguments);
        EXPECT_EQ(output.exit_status, 0) << fmt::format("{}", fmt::join(c.arguments, " ")) << "\n"
                                         << output.err;
        EXPECT_TRUE(c.written.empty() || std::filesystem::exists(folder.file(c.written)))
            << c.written;
    }
}

TEST(Usage, SaysThatExactlyOneOfTwoIsRequired)
{
    const Words distance{"measure", "distance", bundledMars()};
    const std::string problem = "marsview-cli: --points, --vector: exactly one is required";
    EXPECT_EQ(refusal(distance), problem);
    EXPECT_EQ(refusal(with(distance, {"--points", "a.csv", "--vector", "b.csv"})), problem);
    EXPECT_EQ(refusal(with({"sample", bundledMars()}, {"--pixel", "1,2", "--map", "1,2"})),
              "marsview-cli: --map, --lonlat, --pixel: exactly one is required");
}

// Sanitizers reserve terabytes of address space.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kCanLimitMemory = false;
#else
constexpr bool kCanLimitMemory = true;
#endif

TEST(Usage, FailsInOneLineOnEndlessInput)
{
    if (!kCanLimitMemory) {
        GTEST_SKIP() << "built with a sanitizer";
    }
    const TempFolder folder;
    const std::string cli = MARSVIEW_CLI;
    const std::string mars = bundledMars();
    const auto shell = [&](const std::string& line) {
        // 2 GB of address space are enough for the program, and stop it if it keeps reading.
        return runProgram({"bash", "-c", "ulimit -v 4000000; " + line});
    };
    for (const std::string& line :
         {fmt::format("'{}' trace '{}' --goals /dev/zero", cli, mars),
          fmt::format("'{}' trace '{}' --goals - < /dev/zero", cli, mars),
          fmt::format("tr '\\0' 1 < /dev/zero | '{}' trace '{}' --goals -", cli, mars),
          fmt::format("'{}' sample '{}' --pixel --stdin < /dev/zero", cli, mars),
          fmt::format("'{}' loop '{}' --device replay:/dev/zero", cli, mars),
          fmt::format("'{}' info /dev/zero", cli)}) {
        const ProgramOutput output = shell(line);
        EXPECT_EQ(output.exit_status, 1) << line;
        EXPECT_THAT(output.err, StartsWith("marsview-cli: ")) << line;
        EXPECT_THAT(output.err, testing::Not(HasSubstr("bad_alloc"))) << line;
        EXPECT_EQ(std::count(output.err.begin(), output.err.end(), '\n'), 1) << output.err;
    }
    const std::string mesh = folder.file("endless.obj");
    std::filesystem::create_symlink("/dev/zero", mesh);
    const ProgramOutput output = runCli({"trace", mesh, "--goals", "-"}, "x,y,z\n0,0,0\n");
    EXPECT_EQ(output.exit_status, 1);
    EXPECT_THAT(output.err, HasSubstr("is not a regular file"));
}

TEST(Usage, ReportsALackOfMemoryInOneLine)
{
    if (!kCanLimitMemory) {
        GTEST_SKIP() << "built with a sanitizer";
    }
    const ProgramOutput output =
        runProgram({"bash", "-c",
                    fmt::format("ulimit -v 1500000; '{}' bench contact --size 65536 --updates 2",
                                MARSVIEW_CLI)});
    EXPECT_EQ(output.exit_status, 1) << output.err;
    EXPECT_THAT(output.err, StartsWith("marsview-cli: "));
    EXPECT_EQ(std::count(output.err.begin(), output.err.end(), '\n'), 1) << output.err;
}

TEST(Usage, ReportsErrorsAsJsonWithJson)
{
    const auto errorOf = [](const ProgramOutput& output) {
        EXPECT_EQ(output.out, "");
        EXPECT_EQ(std::count(output.err.begin(), output.err.end(), '\n'), 1) << output.err;
        const nlohmann::json json = nlohmann::json::parse(output.err);
        EXPECT_EQ(json["schema"], 1);
        EXPECT_EQ(json["error"]["exit_status"], output.exit_status);
        return json["error"];
    };
    const nlohmann::json missing = errorOf(runCli({"info", "/no/such/map.tif", "--json"}));
    EXPECT_EQ(missing["what"], "/no/such/map.tif");
    EXPECT_EQ(missing["exit_status"], 1);
    const nlohmann::json wrong = errorOf(runCli({"info", bundledMars(), "--jsno", "--json"}));
    EXPECT_EQ(wrong["what"], "--jsno");
    EXPECT_EQ(wrong["exit_status"], 2);
    EXPECT_THAT(wrong["message"].get<std::string>(), HasSubstr("Did you mean \"--json\"?"));
}

TEST(Usage, DescribesSeveralFilesAndReportsFailures)
{
    const ProgramOutput text =
        runCli({"info", bundledMars(), "/no/such/map.tif", bundledMountain()});
    EXPECT_EQ(text.exit_status, 1);
    EXPECT_EQ(text.out,
              runCli({"info", bundledMars()}).out + "\n" + runCli({"info", bundledMountain()}).out);
    EXPECT_EQ(text.err, runCli({"info", "/no/such/map.tif"}).err);

    const ProgramOutput json =
        runCli({"info", bundledMars(), bundledMountain(), "/no/such/map.tif", "--json"});
    EXPECT_EQ(json.exit_status, 1);
    const nlohmann::json array = nlohmann::json::parse(json.out);
    ASSERT_EQ(array.size(), 2U);
    EXPECT_EQ(array[0], cliInfo(bundledMars()));
    EXPECT_EQ(array[1], cliInfo(bundledMountain()));
    EXPECT_EQ(nlohmann::json::parse(json.err)["error"]["what"], "/no/such/map.tif");
}

TEST(Usage, LeavesNoUnfinishedOutputBehind)
{
    const TempFolder folder;
    const std::string goals = folder.write("goals.csv", "x,y,z\n225,18,25000\n");
    const std::string trace = folder.file("trace.csv");
    EXPECT_EQ(runCli({"trace", bundledMars(), "--goals", goals, "-o", trace}).exit_status, 0);
    EXPECT_THAT(readFile(trace), StartsWith("x,y,z,contact"));
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        names.push_back(entry.path().filename().string());
    }
    EXPECT_THAT(names, testing::UnorderedElementsAre("goals.csv", "trace.csv"));
    const ProgramOutput refused =
        runCli({"trace", bundledMars(), "--goals", goals, "-o", "/no/such/folder/trace.csv"});
    EXPECT_EQ(refused.exit_status, 1);
    EXPECT_THAT(
        refused.err,
        StartsWith(
            "marsview-cli: /no/such/folder/trace.csv: the folder /no/such/folder does not exist"));
}

TEST(Usage, LeavesNoUnfinishedOutputBehindAfterControlC)
{
    namespace fs = std::filesystem;
    const TempFolder folder;
    const fs::path map = folder.path() / "out" / "made.tif";
    fs::create_directories(map.parent_path());
    const std::string printed = folder.file("printed");
    RunningProgram program(
        {MARSVIEW_CLI, "bench", "terrain", "--make", map.string(), "--size", "20000x20000"},
        printed);
    const auto until = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!fs::exists(map.string() + ".part") && std::chrono::steady_clock::now() < until) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    program.signal(SIGINT);
    EXPECT_EQ(program.wait(), 1);
    EXPECT_TRUE(fs::is_empty(map.parent_path()));
    EXPECT_THAT(readFile(printed), StartsWith("marsview-cli: "));
}

} // namespace marsview::test
