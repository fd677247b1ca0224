#include "tests/cli/level_maps.h"
#include "tests/cli/run_cli.h"
#include "tests/support/run_program.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace marsview::test {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

nlohmann::json looped(std::vector<std::string> more)
{
    std::vector<std::string> arguments{"loop", bundledMars(), "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramOutput output = runCli(arguments);
    EXPECT_EQ(output.exit_status, 0) << output.err;
    return output.exit_status == 0 ? nlohmann::json::parse(output.out) : nlohmann::json();
}

// The given columns of a file (numbered from 0), line by line.
std::vector<std::string> columnsOf(const std::string& text, const std::vector<std::size_t>& wanted)
{
    std::vector<std::string> lines;
    for (std::size_t at = text.find('\n') + 1; at < text.size();) {
        const std::size_t end = text.find('\n', at);
        std::vector<std::string> words{""};
        for (const char c : text.substr(at, end - at)) {
            if (c == ',') {
                words.emplace_back();
            } else {
                words.back() += c;
            }
        }
        std::string line;
        for (const std::size_t column : wanted) {
            line += words.at(column) + ",";
        }
        lines.push_back(line);
        at = end + 1;
    }
    return lines;
}

// A loop with a plugin's device, which the test ends with signals. Its output goes to a file.
class RunningLoop {
public:
    RunningLoop(const TempFolder& folder, const std::string& behaviour)
        : folder_(folder)
        , program_({"env", "XDG_STATE_HOME=" + folder.file("state"), MARSVIEW_CLI, "loop",
                    bundledMars(), "--device",
                    "plugin:" MARSVIEW_TEST_PLUGINS "/" + behaviour + ".so", "--seconds", "3600",
                    "--record", recorded()},
                   printed())
    {}

    std::string printed() const { return folder_.file("printed"); }
    std::string recorded() const { return folder_.file("recorded.csv"); }
    /// The number of marker files for `call`; a marker shows that a plugin call has not returned.
    std::size_t markers(const std::string& call = ".loading") const
    {
        std::error_code none;
        std::size_t count = 0;
        for (const auto& entry : std::filesystem::directory_iterator(
                 folder_.path() / "state" / "marsview" / "loading", none)) {
            count += entry.path().filename().string().find(call) != std::string::npos ? 1U : 0U;
        }
        return count;
    }
    /// False if the program ended first.
    bool waitUntil(const std::function<bool()>& is_so)
    {
        while (!is_so()) {
            if (program_.hasEnded()) {
                return false;
            }
            std::this_thread::yield();
        }
        return true;
    }
    /// The exit status; -1 if a signal ended it.
    int end(int signal)
    {
        program_.signal(signal);
        return program_.wait();
    }

private:
    const TempFolder& folder_;
    RunningProgram program_;
};

TEST(LoopCommand, RunsASimulatedHandAndReportsItsTiming)
{
    const nlohmann::json loop = looped({"--device", "sim:swipe=3,lift_s=0.2", "--seconds", "0.5"});
    ASSERT_FALSE(loop.is_null());
    EXPECT_GE(loop["ticks"], 500);
    EXPECT_GT(loop["in_contact"], 100);
    EXPECT_GE(loop["update_ns"]["count"], 500);
    EXPECT_GT(loop["update_ns"]["p50"], 0);
    EXPECT_GE(loop["update_ns"]["max"], loop["update_ns"]["p999"]);
    std::uint64_t sum = 0;
    for (const auto& bucket : loop["update_histogram_ns"]) {
        sum += bucket[1].get<std::uint64_t>();
    }
    EXPECT_EQ(sum, loop["update_ns"]["count"].get<std::uint64_t>());
    EXPECT_TRUE(loop["allocations"].is_null() || loop["allocations"] == 0);
    EXPECT_TRUE(loop["real_time_scheduling"] == true || loop["real_time_scheduling"].is_string());
    for (const char* name :
         {"lateness_ns", "missed_by_tick", "missed_by_waking", "skipped", "ticks_with_tile_misses",
          "minor_faults", "major_faults", "locked_memory"}) {
        EXPECT_TRUE(loop.contains(name)) << name;
    }
}

TEST(LoopCommand, TraceAndReplayReproduceItsRecordings)
{
    const TempFolder folder;
    const std::string first = folder.file("first.csv");
    const std::string again = folder.file("again.csv");
    const std::string traced = folder.file("traced.csv");
    const nlohmann::json loop = looped({"--device", "sim:swipe=5,lift_s=0.3,grab_s=0.5,seed=4",
                                        "--seconds", "1", "--record", first});
    ASSERT_GT(loop["recorded"], 500);
    EXPECT_EQ(loop["not_recorded"], 0);
    looped({"--device", "replay:" + first, "--seconds", "10", "--record", again});
    const std::vector<std::size_t> recorded{5, 6, 7, 8};
    const auto a = columnsOf(readFile(first), recorded);
    EXPECT_EQ(a, columnsOf(readFile(again), recorded));
    const ProgramOutput trace = runCli({"trace", bundledMars(), "--goals", first, "-o", traced});
    ASSERT_EQ(trace.exit_status, 0) << trace.err;
    EXPECT_EQ(a, columnsOf(readFile(traced), {3, 0, 1, 2}));
}

TEST(LoopCommand, TraceReproducesItsRecordingsOfTiledMaps)
{
    // From the first tick on, when only the coarsest tile is resident.
    const TempFolder folder;
    const std::string first = folder.file("first.csv");
    const std::string traced = folder.file("traced.csv");
    const auto run = [&](const std::vector<std::string>& arguments) {
        const ProgramOutput output = runCliWith(
            {"MARSVIEW_HELD_MB=0", "MARSVIEW_CACHE_DIR=" + folder.file("cache")}, arguments);
        EXPECT_EQ(output.exit_status, 0) << output.err;
        return output;
    };
    const ProgramOutput loop = run({"loop", bundledMars(), "--json", "--device", "sim:swipe=30",
                                    "--seconds", "1", "--record", first});
    EXPECT_GT(nlohmann::json::parse(loop.out)["samples_missed"], 0);
    const auto a = columnsOf(readFile(first), {5, 6, 7, 8});
    ASSERT_GT(a.size(), 500U);
    run({"trace", bundledMars(), "--goals", first, "-o", traced});
    EXPECT_EQ(a, columnsOf(readFile(traced), {3, 0, 1, 2}));

    // On another map this tile does not exist: the goals are traced over the map as it is, with a
    // message.
    const ProgramOutput other = run({"trace", bundledMountain(), "--goals", first, "-o", traced});
    EXPECT_THAT(other.err, HasSubstr("first.csv: was recorded on another map, one of "));
    EXPECT_THAT(other.err, HasSubstr(" samples of Mars"));
}

TEST(LoopCommand, ReadsATruncatedRecordingUpToItsEnd)
{
    const TempFolder folder;
    const std::string whole = folder.file("whole.csv");
    looped({"--device", "sim:swipe=5,lift_s=0.2", "--seconds", "0.5", "--record", whole});
    const std::string text = readFile(whole);
    const std::size_t lines = columnsOf(text, {0}).size();
    // As if the program had been killed, or the disk had been full.
    const std::string cut = folder.write("cut.csv", text.substr(0, text.size() - 3));
    const ProgramOutput traced = runCli({"trace", bundledMars(), "--goals", cut});
    EXPECT_EQ(traced.exit_status, 0) << traced.err;
    EXPECT_EQ(columnsOf(traced.out, {0}).size(), lines - 1);
    EXPECT_EQ(traced.err,
              "marsview-cli: " + cut + ": has an incomplete last line, which is skipped\n");
    const ProgramOutput replayed =
        runCli({"loop", bundledMars(), "--device", "replay:" + cut, "--seconds", "10"});
    EXPECT_EQ(replayed.exit_status, 0) << replayed.err;
    EXPECT_THAT(replayed.err, HasSubstr("has an incomplete last line"));
}

TEST(LoopCommand, ReportsUpdatesThatDifferFromTheRecording)
{
    const TempFolder folder;
    const std::string file = folder.file("touch.csv");
    looped({"--device", "sim:swipe=5,lift_s=0.2", "--seconds", "0.5", "--record", file});
    const auto trace = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments{"trace", bundledMars(), "--goals",
                                           file,    "--summary",   folder.file("summary.json")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramOutput output = runCli(arguments);
        EXPECT_EQ(output.exit_status, 0) << output.err;
        return output.err;
    };
    const auto differing = [&] {
        return nlohmann::json::parse(readFile(folder.file("summary.json")))
            .value("differing_updates", -1);
    };
    EXPECT_EQ(trace({}), "");
    EXPECT_EQ(differing(), 0);
    EXPECT_THAT(trace({"--unit", "ft"}), HasSubstr(" updates with different results now"));
    EXPECT_GT(differing(), 100);
    EXPECT_EQ(trace({"--model", "god-object"}), "") << "requested by the option";
    EXPECT_EQ(differing(), -1);
}

TEST(LoopCommand, RecordsADevicesReadings)
{
    const TempFolder folder;
    const std::string path = folder.file("device.csv");
    looped({"--device", "record:" + path + ",sim:speed=0.1", "--seconds", "0.2"});
    const std::string text = readFile(path);
    EXPECT_EQ(text.rfind("time_s,status,x,y,z,", 0), 0U);
    EXPECT_GE(columnsOf(text, {0}).size(), 200U);
}

TEST(LoopCommand, PrintsAHistogramForPeople)
{
    const ProgramOutput output =
        runCli({"loop", bundledMars(), "--device", "null:", "--seconds", "0.1"});
    EXPECT_EQ(output.exit_status, 0) << output.err;
    for (const char* word : {"update time", "up to", "lateness", "missed deadlines", "tile misses",
                             "page faults", "real-time scheduling"}) {
        EXPECT_NE(output.out.find(word), std::string::npos) << word;
    }
}

TEST(LoopCommand, FailsInOneLineIfTheDeviceFails)
{
    const TempFolder folder;
    const auto run = [&](const std::string& behaviour) {
        const std::string uri = "plugin:" MARSVIEW_TEST_PLUGINS "/" + behaviour + ".so";
        ProgramOutput output = runCliWith(
            {"XDG_STATE_HOME=" + folder.file("state"), "XDG_RUNTIME_DIR=" + folder.file("run")},
            {"loop", bundledMars(), "--device", uri, "--seconds", "0.5"});
        EXPECT_EQ(output.exit_status, 1) << behaviour;
        EXPECT_EQ(std::count(output.err.begin(), output.err.end(), '\n'), 1) << output.err;
        EXPECT_THAT(output.err, StartsWith("marsview-cli: " + uri + ": "));
        return output;
    };
    const ProgramOutput nan = run("says_nan");
    EXPECT_THAT(nan.err, AllOf(HasSubstr("was lost after 0.0 s: "), HasSubstr("not finite; ")));
    EXPECT_THAT(nan.out, HasSubstr("; last reason: device lost\n")) << "with a report";
    const ProgramOutput millimeters = run("says_millimetres");
    EXPECT_THAT(millimeters.err, HasSubstr("was lost after 0.0 s: its samples lie far outside"));
    const ProgramOutput lost = run("answers_nonsense");
    EXPECT_THAT(lost.err, HasSubstr("its plugin returned 4711, an unknown status; "));
    const ProgramOutput unready = run("says_unready");
    EXPECT_THAT(unready.err, HasSubstr("did not become ready within 0.6 s: its plugin reports that "
                                       "it is not ready, without a reason; "));
    EXPECT_THAT(unready.out, HasSubstr("force off: device unready 0.600 s; last reason: device "
                                       "unready\n"));
    const ProgramOutput stopped = run("fails_starting");
    EXPECT_THAT(stopped.err, HasSubstr("the loop did not start: "));
}

TEST(LoopCommand, TheEndOfItsTimeIsNotAFailure)
{
    const nlohmann::json loop = looped({"--device", "sim:swipe=3", "--seconds", "0.5"});
    ASSERT_FALSE(loop.is_null());
    EXPECT_GT(loop["in_contact"], 100) << "the test needs a force that can be switched off";
    EXPECT_FALSE(loop["force_off_s"].contains("device unready")) << loop["force_off_s"];
    EXPECT_NE(loop["last_reason"], "device unready");
}

TEST(LoopCommand, EndsInTimeOnADeviceTooSlowForItsRate)
{
    const TempFolder folder;
    const ProgramOutput output =
        runCliWith({"XDG_STATE_HOME=" + folder.file("state")},
                   {"loop", bundledMars(), "--json", "--seconds", "0.5", "--device",
                    "plugin:" MARSVIEW_TEST_PLUGINS "/is_slow.so"});
    EXPECT_EQ(output.exit_status, 0) << output.err;
    // A read takes five milliseconds, so all 500 ticks would take two and a half seconds.
    EXPECT_LT(nlohmann::json::parse(output.out)["ticks"], 400);
}

TEST(LoopCommand, EndsCleanlyOnTerminationSignals)
{
    for (const int signal : {SIGTERM, SIGHUP, SIGINT}) {
        SCOPED_TRACE(signal);
        const TempFolder folder;
        RunningLoop loop(folder, "is_good");
        ASSERT_TRUE(loop.waitUntil([&] { // some updates after the header line
            constexpr std::uintmax_t kBytesMin = 1000;
            std::error_code none;
            const std::uintmax_t bytes = std::filesystem::file_size(loop.recorded(), none);
            return !none && bytes > kBytesMin;
        })) << readFile(loop.printed());
        EXPECT_EQ(loop.end(signal), 0) << readFile(loop.printed());
        EXPECT_THAT(readFile(loop.printed()), HasSubstr("force off: "));
        EXPECT_EQ(loop.markers(), 0U);
    }
}

TEST(LoopCommand, BlamesNoPluginIfItIsTerminatedWhileOpeningADevice)
{
    const TempFolder folder;
    RunningLoop loop(folder, "hangs_opening");
    ASSERT_TRUE(loop.waitUntil([&] { return loop.markers(".open-") == 1; }));
    EXPECT_EQ(loop.end(SIGTERM), 1);
    EXPECT_THAT(readFile(loop.printed()), HasSubstr("did not return from being opened"));
    EXPECT_EQ(loop.markers(), 0U);
}

TEST(LoopCommand, ReportsARecordingOfAnotherMap)
{
    const TempFolder folder;
    const auto run = [&](const std::string& goals) {
        const std::string path = folder.write("goals.csv", "x,y,z\n" + goals);
        return runCli({"loop", bundledMars(), "--device", "replay:" + path, "--seconds", "1"});
    };
    const ProgramOutput none = run("1e9,0,0\n0,1e9,0\n");
    EXPECT_EQ(none.exit_status, 1);
    EXPECT_THAT(none.err, HasSubstr(": 2 of 2 goals are outside the map; use the map"));
    const ProgramOutput some = run("0,0,0\n0,1e9,0\n");
    EXPECT_EQ(some.exit_status, 0) << some.err;
    EXPECT_THAT(some.err,
                HasSubstr(": 1 of 2 goals are outside the map and are clamped to its edge"));
    EXPECT_EQ(run("0,0,0\n").err, "");
}

TEST(LoopCommand, DoesNotOverwriteTheReplayedFile)
{
    const TempFolder folder;
    const std::string goals = folder.write("goals.csv", "x,y,z\n0,0,0\n");
    const ProgramOutput output =
        runCli({"loop", bundledMars(), "--device", "replay:" + goals + "#loop", "--record", goals});
    EXPECT_EQ(output.exit_status, 1);
    EXPECT_THAT(output.err, HasSubstr("is an input file; choose another output file"));
    EXPECT_EQ(readFile(goals), "x,y,z\n0,0,0\n");
    // The map must not be overwritten either, through any option.
    const std::string map = folder.file("map.tif");
    std::filesystem::copy_file(bundledMars(), map);
    const std::string before = readFile(map);
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{"--device", "sim:", "--record", map},
          {"--device", "sim:", "--flight", map},
          {"--device", "sim:", "--plot", map},
          {"--device", "record:" + map + ",sim:"}}) {
        std::vector<std::string> arguments{"loop", map, "--seconds", "0.1"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramOutput refused = runCli(arguments);
        EXPECT_EQ(refused.exit_status, 1) << more.back();
        EXPECT_THAT(refused.err,
                    HasSubstr("is an input raster or a part of one; choose another output file"));
        EXPECT_TRUE(readFile(map) == before) << more.back();
    }
}

TEST(LoopCommand, PlotsForceAndHeightsOfAFlight)
{
    const TempFolder folder;
    const std::string flight = folder.file("f.csv");
    const std::string plot = folder.file("f.svg");
    const ProgramOutput output =
        runCli({"loop", bundledMars(), "--device", "sim:grab_s=0.5,press=0.4,twist=90", "--seconds",
                "1", "--flight", flight, "--plot", plot});
    ASSERT_EQ(output.exit_status, 0) << output.err;
    EXPECT_THAT(readFile(flight).substr(0, readFile(flight).find('\n')), EndsWith(",surface_z"));
    const std::string svg = readFile(plot);
    EXPECT_THAT(svg, StartsWith("<svg "));
    EXPECT_THAT(svg, EndsWith("</svg>\n"));
    for (const char* name : {"force on the hand, N", "upward", "height in the workspace, mm",
                             "surface below the hand", "time, s", "twist=90"}) {
        EXPECT_THAT(svg, HasSubstr(name));
    }
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

TEST(LoopCommand, ReportsARecordingWithOtherContactSettings)
{
    const TempFolder folder;
    const std::string goals = folder.write(
        "goals.csv", "x,y,z,map,part,model,radius_m,exaggeration\n0,0,0,1,1,god-object,9,2\n");
    const auto run = [&](const std::string& exaggeration) {
        return runCli({"loop", bundledMars(), "--device", "replay:" + goals, "--model",
                       "god-object", "--exaggeration", exaggeration});
    };
    EXPECT_EQ(run("2").err, "");
    const ProgramOutput other = run("3");
    EXPECT_EQ(other.exit_status, 0);
    EXPECT_THAT(other.err, HasSubstr(": was recorded with god-object at exaggeration 2, but the "
                                     "contact model is now god-object at exaggeration 3"));
}

TEST(LoopCommand, FailsIfTheRecordingFails)
{
    const ProgramOutput full =
        runCli({"loop", bundledMars(), "--device", "record:/dev/full,sim:", "--seconds", "0.2"});
    EXPECT_EQ(full.exit_status, 1);
    EXPECT_THAT(full.err, StartsWith("marsview-cli: record:/dev/full: cannot be written (No space "
                                     "left on device); free disk space"));
    for (const char* option : {"--record", "--flight"}) {
        const ProgramOutput other = runCli(
            {"loop", bundledMars(), "--device", "sim:", "--seconds", "0.2", option, "/proc/a.csv"});
        EXPECT_EQ(other.exit_status, 1);
        EXPECT_THAT(other.err, StartsWith("marsview-cli: /proc/a.csv: cannot be written (No "
                                          "such file or directory); choose another file"));
    }
}

TEST(LoopCommand, AcceptsAnyNumberOfSecondsForAReplay)
{
    const TempFolder folder;
    std::string goals = "x,y,z\n";
    for (int i = 0; i < 700; ++i) {
        goals += "0,0,1000\n";
    }
    const std::string path = folder.write("goals.csv", goals);
    for (const char* seconds : {"1e30", "1e308", "1e9"}) {
        const nlohmann::json loop = looped({"--device", "replay:" + path, "--seconds", seconds});
        ASSERT_FALSE(loop.is_null());
        EXPECT_GE(loop["ticks"], 600) << seconds;
    }
}

TEST(LoopCommand, NamesADeviceThatItCannotOpenAndTheReason)
{
    const auto refusal = [](const std::string& uri) {
        const ProgramOutput output =
            runCli({"loop", bundledMars(), "--device", uri, "--seconds", "0.1"});
        EXPECT_EQ(output.exit_status, 1) << uri;
        EXPECT_EQ(output.out, "");
        return output.err;
    };
    EXPECT_NE(refusal("replay:/nowhere.csv").find("cannot be read"), std::string::npos);
    EXPECT_NE(refusal("polhem:serial=none").find("is connected"), std::string::npos);
    EXPECT_EQ(runCli({"loop", bundledMars()}).exit_status, 2);
    const ProgramOutput unknown = runCli({"loop", bundledMars(), "--device", "repaly:x.csv"});
    EXPECT_EQ(unknown.exit_status, 2);
    EXPECT_THAT(unknown.err, HasSubstr("unknown device \"repaly:x.csv\""));
    EXPECT_THAT(unknown.err, HasSubstr("Did you mean \"replay\"?"));
    EXPECT_EQ(runCli({"loop", bundledMars(), "--device", "null:", "--seconds", "-1"}).exit_status,
              2);
}

TEST(LoopCommand, CountsAddressesThatNoDeviceCanHaveAsUsageErrors)
{
    const auto refusal = [](const std::string& uri) {
        const ProgramOutput output = runCli({"loop", "/nowhere.tif", "--device", uri});
        EXPECT_EQ(output.exit_status, 2) << uri;
        EXPECT_EQ(output.out, "");
        return output.err.substr(0, output.err.find('\n'));
    };
    EXPECT_EQ(refusal("null:x"),
              "marsview-cli: --device: null:x: this device takes no address; write null:");
    EXPECT_THAT(refusal("sim:wings=2"),
                HasSubstr("--device: sim:wings=2: unknown parameter \"wings\"; known ones are"));
    EXPECT_THAT(refusal("sim:swipe=far"), HasSubstr("swipe must be a number from 0 to"));
    EXPECT_THAT(refusal("replay:"), HasSubstr("needs a file of goals"));
    EXPECT_THAT(refusal("record:x.csv"), HasSubstr("needs a file and the URI of a device"));
    EXPECT_THAT(refusal("record:x.csv,null:x"), HasSubstr("null:x: this device takes no address"));
    EXPECT_THAT(refusal("forcedimension:first"), HasSubstr("is not the number of a device"));
    EXPECT_THAT(refusal("polhem:left"), HasSubstr("unknown part \"left\""));
}

// The recording of a simulated hand that strokes, pulls and zooms the body.
TEST(LoopCommand, OnTheBodyTraceRepeatsTheRecording)
{
    const TempFolder folder;
    const std::string recording = folder.file("body.csv");
    const nlohmann::json report =
        looped({"--scene", "body", "--device", "sim:grab_s=0.1,lift_s=0.15", "--across", "100",
                "--seconds", "0.4", "--record", recording});
    EXPECT_EQ(report.at("scene"), "body");
    EXPECT_GT(report.at("in_contact"), 30);
    const std::string summary = folder.file("summary.json");
    const ProgramOutput traced = runCli(
        {"trace", "--scene", "body", bundledMars(), "--goals", recording, "--summary", summary});
    ASSERT_EQ(traced.exit_status, 0) << traced.err;
    EXPECT_EQ(traced.err, "");
    const nlohmann::json again = nlohmann::json::parse(readFile(summary));
    EXPECT_GT(again.at("updates"), 300);
    EXPECT_EQ(again.at("differing_updates"), 0);
    EXPECT_EQ(runCli({"trace", bundledMars(), "--goals", recording}).exit_status, 1)
        << "its goals are not those of the plane";
}

TEST(LoopCommand, OnTheBodyItTouchesMapsOnTopOfEachOther)
{
    const TempFolder folder;
    const std::string lower = writeLevelMars(folder, "lower", 60, {98.0, 3.0, 0.05}, 0.0F);
    const std::string upper = writeLevelMars(folder, "upper", 61, {100.0, 1.0, 0.01}, 300.0F);
    const std::string recording = folder.file("pile.csv");
    const ProgramOutput output =
        runCli({"loop", upper, "--scene", "body", "--below", lower, "--feather", "20", "--device",
                "sim:swipe=5", "--seconds", "0.3", "--record", recording, "--json"});
    ASSERT_EQ(output.exit_status, 0) << output.err;
    EXPECT_GT(nlohmann::json::parse(output.out).at("in_contact"), 30);
    EXPECT_THAT(readFile(recording), HasSubstr("below/")) << "of both maps";
}

TEST(LoopCommand, OnTheBodyItReplaysGoalsOfTheBody)
{
    const TempFolder folder;
    std::string goals = "lon,lat,z\n";
    for (int i = 0; i < 200; ++i) {
        goals += fmt::format("{},{},-9000\n", 359.0 + 0.01 * i, 89.0 + 0.005 * i);
    }
    const std::string file = folder.write("goals.csv", goals);
    const std::string recording = folder.file("again.csv");
    looped({"--scene", "body", "--device", "replay:" + file, "--record", recording});
    const std::string traced = folder.file("traced.csv");
    ASSERT_EQ(runCli({"trace", "--scene", "body", bundledMars(), "--goals", file, "-o", traced})
                  .exit_status,
              0);
    EXPECT_EQ(columnsOf(readFile(recording), {5, 6, 7, 8}),
              columnsOf(readFile(traced), {3, 0, 1, 2}));
    const ProgramOutput flat =
        runCli({"loop", bundledMars(), "--device", "replay:" + file, "--seconds", "0.1"});
    EXPECT_EQ(flat.exit_status, 1);
    EXPECT_THAT(flat.err, HasSubstr("not the header \"x,y,z\""));
    EXPECT_EQ(runCli({"loop", bundledMars(), "--device", "null:", "--scene", "round"}).exit_status,
              2);
}

} // namespace
} // namespace marsview::test
