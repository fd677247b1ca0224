#include "core/base/job_monitor.h"
#include "core/body/body_mesh.h"
#include "core/contact/resident_heights.h"
#include "haptics/drivers/replay_driver.h"
#include "haptics/terrain/clipmap_streamer.h"
#include "haptics/trace/goal_file.h"
#include "haptics/trace/motion_text.h"
#include "haptics/trace/recorded_ground.h"
#include "haptics/trace/session_recorder.h"
#include "tests/haptics/loop/loop_fixture.h"
#include "tests/haptics/terrain/tiled_map.h"
#include "tests/support/fractal_terrain.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fcntl.h>
#include <limits>
#include <map>
#include <sstream>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

namespace marsview::test {
namespace {

// The model's result for a goal, as a recording contains it.
RecordedUpdate updateOf(ContactModel& model, const GoalFrame& frame, const TracePoint& goal)
{
    const ContactState state = model.update(frame.toScene(goal));
    const bool is_moved = state.is_in_contact || frame.isClamped(goal);
    return {.is_in_contact = state.is_in_contact,
            .proxy = is_moved ? frame.fromScene(state.proxy) : goal};
}

// Presses, pulls the map, lifts off, grabs the air, rises, sinks and twists, and presses again.
class GrabbingDevice final : public HapticDevice {
public:
    GrabbingDevice()
    {
        capabilities_ = desktopDevice();
        capabilities_.rate_hz = 5000.0;
    }
    const DeviceCapabilities& capabilities() const noexcept override { return capabilities_; }
    DeviceStatus read(DeviceSample& sample) noexcept override
    {
        const double t = 2e-4 * static_cast<double>(reads_++); // seconds
        const double phase = std::fmod(t, 1.0);
        const bool is_down = phase < 0.4;
        const bool is_grabbing = (phase > 0.1 && phase < 0.3) || (phase > 0.5 && phase < 0.9);
        const double z_m = is_down ? -0.006 : 0.02 + 0.01 * std::sin(20.0 * t);
        hand_.z += 0.01 * (z_m - hand_.z);
        hand_.x = 0.02 * std::sin(7.0 * t);
        hand_.y = 0.01 * std::cos(5.0 * t);
        sample = {.position = hand_, .time = std::chrono::steady_clock::now()};
        sample.twist_rad = std::sin(3.0 * t);
        sample.buttons = is_grabbing ? kGrabbingButtons : 0;
        return DeviceStatus::Fine;
    }
    DeviceStatus write(const Vec3& /*force_n*/) noexcept override { return DeviceStatus::Fine; }

private:
    std::uint64_t reads_ = 0;
    WorkspacePoint hand_{0.0, 0.0, 0.03};
    DeviceCapabilities capabilities_;
};

// The words of a recording's lines in some of its columns.
std::vector<std::vector<std::string>> columnsOf(const std::string& path,
                                                const std::vector<std::string>& names)
{
    std::istringstream text(readFile(path));
    std::vector<std::size_t> places;
    std::vector<std::vector<std::string>> lines;
    for (std::string line; std::getline(text, line);) {
        std::vector<std::string> words;
        std::istringstream rest(line + ",");
        for (std::string word; std::getline(rest, word, ',');) {
            words.push_back(word);
        }
        if (places.empty()) {
            for (const std::string& name : names) {
                places.push_back(static_cast<std::size_t>(
                    std::find(words.begin(), words.end(), name) - words.begin()));
            }
            continue;
        }
        std::vector<std::string>& kept = lines.emplace_back();
        for (const std::size_t place : places) {
            kept.push_back(words.at(place));
        }
    }
    return lines;
}

TEST(SessionRecorder, PansZoomsAndTurnsAreRecordedAndRepeatToTheBit)
{
    const TempFolder folder;
    const auto filled = filledTerrain(201, 201, bumps);
    std::vector<WorkspaceFrame> moved;
    const auto record = [&](std::unique_ptr<HapticDevice> device, const std::string& path,
                            std::uint64_t ticks) {
        ServoLoop loop(std::move(device), quick(ticks));
        auto recorder = SessionRecorder::begin(loop, path);
        ASSERT_TRUE(recorder);
        loop.set(settingsFor(makeServoMap(meterFrame(201, 201), filled, {})));
        waitFor(loop);
        loop.stop();
        ASSERT_TRUE((*recorder)->finish());
        EXPECT_EQ(loop.state().counts.not_recorded, 0U);
        moved.push_back(loop.state().seen_frame);
    };
    const std::vector<std::string> names{"x",         "y",         "z",       "contact",
                                         "proxy_x",   "proxy_y",   "proxy_z", "force_x_n",
                                         "force_y_n", "force_z_n", "mode",    "motion"};
    const std::string first = folder.file("first.csv");
    record(std::make_unique<GrabbingDevice>(), first, 8000);
    const auto lines = columnsOf(first, names);
    ASSERT_GE(lines.size(), 8000U);
    std::map<std::string, int> modes;
    bool has_turned = false;
    bool has_zoomed = false;
    for (const auto& line : lines) {
        ++modes[line[10]];
        if (const auto motion = parseMotion(line[11])) {
            has_turned = has_turned || std::abs(motion->turn_rad) > 1e-5;
            has_zoomed = has_zoomed || std::abs(motion->scale - 1.0) > 1e-5;
        }
    }
    EXPECT_GT(modes["pan"], 500);
    EXPECT_GT(modes["zoom"], 500);
    EXPECT_GT(modes["press"], 500);
    EXPECT_TRUE(has_turned);
    EXPECT_TRUE(has_zoomed);

    std::string last = first;
    for (const char* again : {"second.csv", "third.csv"}) {
        auto recording = readGoalRecording(*readGoalText(last), last);
        ASSERT_TRUE(recording) << recording.error().message;
        record(std::make_unique<ReplayDevice>(std::move(*recording)), folder.file(again), 0);
        const auto repeated = columnsOf(folder.file(again), names);
        ASSERT_EQ(repeated.size(), lines.size());
        for (std::size_t i = 0; i < lines.size(); ++i) {
            ASSERT_EQ(repeated[i], lines[i]) << i;
        }
        last = folder.file(again);
    }
    // What the camera follows has come to the same place.
    ASSERT_EQ(moved.size(), 3U);
    EXPECT_EQ(moved[1], moved[2]);
    EXPECT_NEAR(moved[1].scene_per_meter, moved[0].scene_per_meter, 1e-6);
    EXPECT_NEAR(length(moved[1].toScene({}) - moved[0].toScene({})), 0.0, 1e-6);
}

TEST(MotionText, OnABodyTheTurnIsAnAxis)
{
    const SceneMotion motion{.from = {1e6, -2.5, 3e-7},
                             .to = {1e6, -2.4, 0.1},
                             .scale = 1.0 / 3.0,
                             .body_turn_rad = Vec3{0.1, -1e-17, 2.0 / 3.0}};
    EXPECT_EQ(parseMotion(motionText(motion)), motion);
    EXPECT_FALSE(parseMotion("1 2 3 4 5 6 1 0 0")) << "nine numbers";
    EXPECT_FALSE(parseMotion("1 2 3 4 5 6 1 0 0 0 0"));
    EXPECT_FALSE(parseMotion("1 2 3 4 5 6 0 0 0 0")) << "no scale";
}

// A ball of 1000 km with hills, which has 50 mm in the workspace.
TEST(SessionRecorder, OnABodyPansZoomsAndTurnsRepeatToTheBitToo)
{
    const TempFolder folder;
    constexpr std::size_t kColumns = 240;
    constexpr std::size_t kRows = 120;
    const auto filled = filledTerrain(kColumns, kRows, [](std::size_t column, std::size_t row) {
        return 2000.0 + 500.0 * std::sin(static_cast<double>(column) * 0.7) *
                            std::cos(static_cast<double>(row) * 0.5);
    });
    const auto georeference = std::make_shared<const Georeference>(
        kColumns, kRows, GeoTransform::fromTerms({-180.0, 1.5, 0.0, 90.0, 0.0, -1.5}).value(),
        Crs::fromText("+proj=longlat +R=1000000 +no_defs").value());
    JobMonitor monitor;
    const auto mesh = BodyMesh::build(filled, *georeference, 1.0, monitor).value();
    std::vector<WorkspaceFrame> moved;
    const auto record = [&](std::unique_ptr<HapticDevice> device, const std::string& path,
                            std::uint64_t ticks) {
        ServoLoop loop(std::move(device), quick(ticks));
        auto recorder = SessionRecorder::begin(loop, path, 0, GoalColumns::Geographic);
        ASSERT_TRUE(recorder);
        LoopSettings settings = settingsFor(makeServoMap(georeference, mesh, {}));
        // Over 0° N, 0° E: up is along x, east along y.
        settings.frame = {.place = {1.002e6, 0.0, 0.0},
                          .scene_per_meter = 2e7,
                          .body_axes = Rotation{{0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}}};
        loop.set(settings);
        waitFor(loop);
        loop.stop();
        ASSERT_TRUE((*recorder)->finish());
        EXPECT_EQ(loop.state().counts.not_recorded, 0U);
        moved.push_back(loop.state().seen_frame);
    };
    const std::vector<std::string> names{"lon",       "lat",       "z",    "contact", "force_x_n",
                                         "force_y_n", "force_z_n", "mode", "motion"};
    const std::string first = folder.file("first.csv");
    record(std::make_unique<GrabbingDevice>(), first, 3500);
    const auto lines = columnsOf(first, names);
    ASSERT_GE(lines.size(), 3500U);
    double turned_rad = 0.0;
    bool has_zoomed = false;
    for (const auto& line : lines) {
        if (const auto motion = parseMotion(line[8])) {
            ASSERT_TRUE(motion->body_turn_rad);
            turned_rad += length(*motion->body_turn_rad);
            has_zoomed = has_zoomed || std::abs(motion->scale - 1.0) > 1e-5;
        }
    }
    EXPECT_GT(turned_rad, 0.1);
    EXPECT_TRUE(has_zoomed);
    auto recording = readGoalRecording(*readGoalText(first), first, GoalColumns::Geographic);
    ASSERT_TRUE(recording) << recording.error().message;
    const std::string second = folder.file("second.csv");
    record(std::make_unique<ReplayDevice>(std::move(*recording)), second, 0);
    const auto repeated = columnsOf(second, names);
    ASSERT_EQ(repeated.size(), lines.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
        ASSERT_EQ(repeated[i], lines[i]) << i;
    }
    ASSERT_EQ(moved.size(), 2U);
    EXPECT_NEAR(moved[1].scene_per_meter / moved[0].scene_per_meter, 1.0, 1e-9);
    EXPECT_NEAR(length(moved[1].toScene({}) - moved[0].toScene({})), 0.0, 1e-3);
}

TEST(SessionRecorder, ARecordingReplaysToTheSameProxiesToTheBit)
{
    const TempFolder folder;
    const std::string first = folder.file("first.csv");
    const std::string second = folder.file("second.csv");
    const auto filled = filledTerrain(201, 201, bumps);
    const auto record = [&](std::unique_ptr<HapticDevice> device, const std::string& path,
                            std::uint64_t ticks) {
        ServoLoop loop(std::move(device), quick(ticks));
        auto recorder = SessionRecorder::begin(loop, path);
        ASSERT_TRUE(recorder);
        loop.set(settingsFor(makeServoMap(meterFrame(201, 201), filled, {})));
        waitFor(loop);
        loop.stop();
        ASSERT_TRUE((*recorder)->finish());
        EXPECT_EQ(loop.state().counts.not_recorded, 0U);
        EXPECT_GT((*recorder)->updates(), 1000U);
    };
    record(simulated(), first, 5000);
    auto goals = readGoals(*readGoalText(first), first);
    ASSERT_TRUE(goals);
    record(std::make_unique<ReplayDevice>(*goals), second, 0);

    // Goals, contact and proxies: columns one to three and six to nine.
    const auto columns = [](const std::string& path) {
        std::vector<std::string> lines;
        const std::string text = readFile(path);
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t end = text.find('\n', at);
            std::string line;
            std::size_t begin = at;
            for (int column = 0; column < 9; ++column) {
                const std::size_t comma = text.find(',', begin);
                if (column < 3 || column > 4) {
                    line += text.substr(begin, comma - begin) + ",";
                }
                begin = comma + 1;
            }
            lines.push_back(line);
            at = end + 1;
        }
        return lines;
    };
    const auto a = columns(first);
    const auto b = columns(second);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        ASSERT_EQ(a[i], b[i]) << "line " << i + 1;
    }
}

TEST(SessionRecorder, ARecordingTellsWhatItWasTouchedWithWhereThatChanges)
{
    // Changes the model and the exaggeration during contact, and returns to an earlier model.
    const TempFolder folder;
    const std::string path = folder.file("session.csv");
    const auto filled = filledTerrain(201, 201, bumps);
    const auto made = [&](ContactModelKind kind, double exaggeration, double radius_m) {
        const GoalFrame frame(std::make_shared<const Georeference>(
                                  201, 201,
                                  GeoTransform::fromTerms({-0.5, 1.0, 0.0, 0.5, 0.0, -1.0}).value(),
                                  std::nullopt),
                              exaggeration);
        return makeServoMap(frame, filled, {.kind = kind, .contact = {.radius_m = radius_m}});
    };
    const std::vector maps{made(ContactModelKind::ContinuousWalk, 1.0, 1.0),
                           made(ContactModelKind::VirtualProxy, 1.0, 0.75),
                           made(ContactModelKind::GodObject, 2.5, 1.0)};
    {
        ServoLoop loop(simulated(), quick(0));
        auto recorder = SessionRecorder::begin(loop, path);
        ASSERT_TRUE(recorder);
        for (int i = 0; i < 8; ++i) {
            loop.set(settingsFor(maps[static_cast<std::size_t>(i) % maps.size()]));
            const std::uint64_t until = loop.state().tick + 500;
            while (loop.state().tick < until) {
                std::this_thread::yield();
            }
        }
        loop.stop();
        ASSERT_TRUE((*recorder)->finish());
        EXPECT_EQ(loop.state().counts.not_recorded, 0U);
    }
    const auto recording = readGoalRecording(readFile(path), path);
    ASSERT_TRUE(recording) << recording.error().message;
    ASSERT_EQ(recording->parts.size(), 8U);
    EXPECT_EQ(recording->parts[1].kind, ContactModelKind::VirtualProxy);
    EXPECT_EQ(recording->parts[1].radius_m, 0.75);
    EXPECT_EQ(recording->parts[2].exaggeration, 2.5);
    EXPECT_EQ(recording->parts[3].part, recording->parts[0].part);
    EXPECT_EQ(recording->parts[7].map, recording->parts[0].map);

    // Models rebuilt from the file give the same proxies, bit for bit.
    std::map<std::uint64_t, std::shared_ptr<ServoMap>> again;
    std::size_t in_contact = 0;
    for (std::size_t p = 0; p < recording->parts.size(); ++p) {
        const GoalPart& part = recording->parts[p];
        auto& map = again[part.part];
        map = map ? map : made(part.kind, part.exaggeration, part.radius_m);
        const std::size_t end = p + 1 < recording->parts.size() ? recording->parts[p + 1].first
                                                                : recording->goals.size();
        for (std::size_t i = part.first; i < end; ++i) {
            const RecordedUpdate now = updateOf(*map->model, map->frame, recording->goals[i]);
            ASSERT_EQ(now, recording->updates[i]) << "goal " << i << " of part " << p;
            in_contact += now.is_in_contact ? 1U : 0U;
        }
    }
    EXPECT_GT(in_contact, 500U);
}

TEST(SessionRecorder, ReportsMissingUpdates)
{
    const TempFolder folder;
    const std::string path = folder.file("session.csv");
    ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
    const int reader = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    ASSERT_GE(reader, 0);
    ServoLoop loop(simulated(), quick(0));
    loop.set(settingsFor(makeServoMap(meterFrame(201, 201), filledTerrain(201, 201, bumps), {})));
    auto recorder = SessionRecorder::begin(loop, path);
    ASSERT_TRUE(recorder) << recorder.error().message;
    // No reader: a disk that accepts no more data.
    while (loop.state().counts.not_recorded == 0) {
        std::this_thread::yield();
    }
    std::jthread drain([reader](const std::stop_token& stop) {
        std::array<char, 4096> some{};
        while (!stop.stop_requested()) {
            if (read(reader, some.data(), some.size()) <= 0) {
                std::this_thread::yield();
            }
        }
    });
    const Status finished = (*recorder)->finish();
    ASSERT_FALSE(finished);
    EXPECT_THAT(finished.error().message,
                testing::ContainsRegex(
                    path + ": [0-9]+ of [0-9]+ updates are missing because the disk was too slow"));
    drain.request_stop();
    drain.join();
    close(reader);
}

TEST(SessionRecorder, ARecordingThatBeginsInTheMiddleOfATouchKnowsAllOfItsModel)
{
    const TempFolder folder;
    const std::string path = folder.file("session.csv");
    const auto filled = filledTerrain(201, 201, bumps);
    const GoalFrame frame = meterFrame(201, 201);
    ServoLoop loop(std::make_unique<BuriedDevice>(), quick(0));
    loop.set(settingsFor(makeServoMap(frame, filled, {})));
    for (const ContactModelKind kind : kContactModelKinds) {
        SCOPED_TRACE(contactModelName(kind));
        const auto runOn = [&](std::uint64_t ticks) {
            const std::uint64_t until = loop.state().tick + ticks;
            while (loop.state().tick < until) {
                std::this_thread::yield();
            }
        };
        const ServoMapOptions options{.kind = kind, .contact = {.radius_m = 0.75}};
        loop.set(settingsFor(makeServoMap(frame, filled, options)));
        runOn(2000);
        ASSERT_TRUE(loop.state().contact.is_in_contact);
        const auto fresh = makeServoMap(frame, filled, options);
        auto recorder = SessionRecorder::begin(loop, path, fresh->serial);
        ASSERT_TRUE(recorder);
        runOn(100); // which are not in the file
        loop.set(settingsFor(fresh));
        runOn(2000);
        ASSERT_TRUE((*recorder)->finish());
        EXPECT_EQ(loop.state().counts.not_recorded, 0U);

        const auto recording = readGoalRecording(readFile(path), path);
        ASSERT_TRUE(recording) << recording.error().message;
        ASSERT_EQ(recording->parts.size(), 1U);
        EXPECT_EQ(recording->parts[0].part, fresh->serial);
        EXPECT_GE(recording->goals.size(), 2000U);
        const auto again = makeServoMap(frame, filled, options);
        for (std::size_t g = 0; g < recording->goals.size(); ++g) {
            ASSERT_EQ(updateOf(*again->model, frame, recording->goals[g]), recording->updates[g])
                << "goal " << g;
        }
    }
}

TEST(SessionRecorder, BeginsWithALaterModelWhereTheFirstIsNeverTouched)
{
    const TempFolder folder;
    const std::string path = folder.file("session.csv");
    const auto filled = filledTerrain(201, 201, bumps);
    const GoalFrame frame = meterFrame(201, 201);
    ServoLoop loop(std::make_unique<BuriedDevice>(), quick(0));
    loop.set(settingsFor(makeServoMap(frame, filled, {})));
    const auto fresh = makeServoMap(frame, filled, {});
    auto recorder = SessionRecorder::begin(loop, path, fresh->serial);
    ASSERT_TRUE(recorder);
    // Another model is selected before the device touches the terrain with this one.
    const auto chosen = makeServoMap(frame, filled, {.kind = ContactModelKind::GodObject});
    loop.set(settingsFor(chosen));
    const std::uint64_t until = loop.state().tick + 1000;
    while (loop.state().tick < until) {
        std::this_thread::yield();
    }
    ASSERT_TRUE((*recorder)->finish());
    EXPECT_GT((*recorder)->updates(), 500U);
    const auto recording = readGoalRecording(readFile(path), path);
    ASSERT_TRUE(recording) << recording.error().message;
    EXPECT_EQ(recording->parts.front().part, chosen->serial);
}

// Repeats the updates of a recording over a tiled map, with tiles that are read again.
std::vector<RecordedUpdate> updatesAgain(const GoalRecording& recording,
                                         const TiledMap& map,
                                         const std::shared_ptr<const Georeference>& georeference)
{
    const TileCache cache({.bytes_max = std::size_t{64} << 20, .loader_threads = 1});
    const auto ground = RecordedGround::make(TiledRaster(cache, map.source), map.heights).value();
    std::map<std::uint64_t, std::unique_ptr<MapContactModel>> models;
    std::vector<RecordedUpdate> updates;
    auto next_ground = recording.ground.begin();
    for (std::size_t p = 0; p < recording.parts.size(); ++p) {
        const GoalPart& part = recording.parts[p];
        const GoalFrame frame(georeference, part.ground->frame, part.exaggeration);
        auto& model = models[part.part];
        if (!model) {
            const TiledHeightfieldSurface surface(ground->terrain(), frame.frame(),
                                                  part.exaggeration);
            model = makeContactModel(part.kind, surface, {.radius_m = part.radius_m});
        }
        const std::size_t end =
            p + 1 < recording.parts.size() ? recording.parts[p + 1].first : recording.goals.size();
        for (std::size_t i = part.first; i < end; ++i) {
            for (; next_ground != recording.ground.end() && next_ground->goal <= i; ++next_ground) {
                for (const GroundRecord& record : next_ground->records) {
                    EXPECT_TRUE(ground->follow(record));
                    const auto* felt = std::get_if<GroundFelt>(&record);
                    if (felt != nullptr && models.contains(felt->changed_part)) {
                        models[felt->changed_part]->terrainChanged();
                    }
                }
            }
            updates.push_back(updateOf(*model, frame, recording.goals[i]));
        }
    }
    return updates;
}

TEST(SessionRecorder, ARecordingOverTilesThatComeWhileItIsMadeKnowsWhatWasFelt)
{
    constexpr std::size_t kColumns = 2100;
    constexpr std::size_t kRows = 1300; // the hand stays over the map
    const auto heights = fractalHeights(kColumns, kRows, 9);
    const TiledMap map = tiledMap(
        int16Terrain(kColumns, kRows, {.gain = 0.01}, [&](std::size_t column, std::size_t row) {
            return static_cast<double>(heights[row * kColumns + column]);
        }));
    const TempFolder folder;
    const std::string path = folder.file("session.csv");
    const auto georeference = std::make_shared<const Georeference>(
        kColumns, kRows, GeoTransform::fromTerms({-0.5, 1.0, 0.0, 0.5, 0.0, -1.0}).value(),
        std::nullopt);
    for (const ContactModelKind kind : kContactModelKinds) {
        SCOPED_TRACE(contactModelName(kind));
        const TileCache cold({.bytes_max = std::size_t{1} << 20, .loader_threads = 1});
        const auto streamer =
            ClipmapStreamer::create(TiledRaster(cold, map.source), map.heights).value();
        const auto terrain =
            std::make_shared<ServoTerrain>(streamer->exchange(), streamer->heights());
        streamer->start();
        ServoLoop loop(std::make_unique<BuriedDevice>(), quick(0));
        auto recorder = SessionRecorder::begin(loop, path);
        ASSERT_TRUE(recorder);
        // Changes the exaggeration while tiles arrive; the device crosses half of the map's width
        // per second.
        for (const double exaggeration : {1.0, 2.0, 1.5}) {
            LoopSettings settings =
                settingsFor(makeServoMap(GoalFrame(georeference, exaggeration), terrain,
                                         {.kind = kind, .contact = {.radius_m = 0.75}}));
            settings.frame.scene_per_meter = 20'000.0;
            loop.set(settings);
            const std::uint64_t until = loop.state().tick + 1500;
            while (loop.state().tick < until) {
                std::this_thread::yield();
            }
        }
        loop.stop();
        ASSERT_TRUE((*recorder)->finish());
        EXPECT_GT(loop.state().counts.samples_missed, 100U) << "the terrain was always resident";

        const auto recording = readGoalRecording(readFile(path), path);
        ASSERT_TRUE(recording) << recording.error().message;
        ASSERT_EQ(recording->parts.size(), 3U);
        ASSERT_GT(recording->ground.size(), 10U);
        const std::vector<RecordedUpdate> again = updatesAgain(*recording, map, georeference);
        ASSERT_EQ(again.size(), recording->updates.size());
        for (std::size_t g = 0; g < again.size(); ++g) {
            ASSERT_EQ(again[g], recording->updates[g]) << "goal " << g;
        }
    }
}

TEST(SessionRecorder, NamesTheFileThatItCannotWrite)
{
    ServoLoop loop(simulated(), quick(10));
    const auto recorder = SessionRecorder::begin(loop, "/nowhere/session.csv");
    ASSERT_FALSE(recorder);
    EXPECT_EQ(recorder.error().message,
              "/nowhere/session.csv: cannot be written (No such file or directory); choose another "
              "file in an existing, writable folder");
}

} // namespace
} // namespace marsview::test
