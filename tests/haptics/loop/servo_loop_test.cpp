#include "core/base/plain_number.h"
#include "haptics/drivers/replay_driver.h"
#include "haptics/drivers/sim_driver.h"
#include "haptics/loop/servo_loop.h"
#include "haptics/trace/goal_file.h"
#include "haptics/trace/session_recorder.h"
#include "tests/haptics/loop/tick_fixture.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <fcntl.h>
#include <fmt/format.h>
#include <map>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

namespace marsview::test {
namespace {

using namespace std::chrono_literals;

double bumps(std::size_t column, std::size_t row)
{
    return 3.0 * std::sin(0.3 * static_cast<double>(column)) +
           2.0 * std::cos(0.2 * static_cast<double>(row));
}

LoopSettings settingsFor(std::shared_ptr<ServoMap> map)
{
    LoopSettings settings;
    settings.map = std::move(map);
    settings.frame = {.place = {0.0, 0.0, 0.0}, .scene_per_metre = 1000.0};
    settings.frame_number = 1;
    return settings;
}

ServoLoopOptions quick(std::uint64_t ticks)
{
    ServoLoopOptions options;
    options.thread.locks_memory = false;
    options.thread.uncounted_turns = 0;
    options.ticks_max = ticks;
    return options;
}

std::unique_ptr<HapticDevice> simulated(double rate_hz = 5000.0)
{
    SimOptions options;
    options.rate_hz = rate_hz;
    options.lift_s = 0.1;
    options.grab_s = 0.3;
    return std::make_unique<SimDevice>(options);
}

void waitFor(const ServoLoop& loop)
{
    while (!loop.hasEnded()) {
        std::this_thread::yield();
    }
}

// What is written to a device that somebody else holds.
struct Writes {
    std::vector<Vec3> forces_n;
    std::vector<std::chrono::steady_clock::time_point> times; // when each was written
    std::atomic<int> reads{0};
};

class WatchedDevice final : public HapticDevice {
public:
    explicit WatchedDevice(Writes& writes)
        : writes_(writes)
        , capabilities_(desktopDevice())
    {
        writes_.forces_n.reserve(1'000'000);
        writes_.times.reserve(1'000'000);
    }
    const DeviceCapabilities& capabilities() const noexcept override { return capabilities_; }
    DeviceStatus read(DeviceSample& sample) noexcept override
    {
        ++writes_.reads;
        sample.position = {0.0, 0.0, -0.005};
        sample.time = std::chrono::steady_clock::now();
        return DeviceStatus::Fine;
    }
    DeviceStatus write(const Vec3& force_n) noexcept override
    {
        writes_.forces_n.push_back(force_n);
        writes_.times.push_back(std::chrono::steady_clock::now());
        return DeviceStatus::Fine;
    }

private:
    Writes& writes_;
    DeviceCapabilities capabilities_;
};

// A hand that goes round and round, always below the ground of bumps().
class BuriedDevice final : public HapticDevice {
public:
    BuriedDevice() { capabilities_.rate_hz = 5000.0; }
    const DeviceCapabilities& capabilities() const noexcept override { return capabilities_; }
    DeviceStatus read(DeviceSample& sample) noexcept override
    {
        turn_rad_ += 2e-3;
        sample.position = {0.04 * std::sin(turn_rad_), 0.03 * std::cos(1.7 * turn_rad_), -0.02};
        sample.time = std::chrono::steady_clock::now();
        return DeviceStatus::Fine;
    }
    DeviceStatus write(const Vec3& /*force_n*/) noexcept override { return DeviceStatus::Fine; }

private:
    double turn_rad_ = 0.0;
    DeviceCapabilities capabilities_ = desktopDevice();
};

TEST(ServoLoop, RunsOnlyWhileThereIsSomethingToFeel)
{
    Writes writes;
    ServoLoop loop(std::make_unique<WatchedDevice>(writes), quick(0));
    loop.set({});
    EXPECT_FALSE(loop.isRunning());
    EXPECT_EQ(writes.reads, 0);
    loop.set(settingsFor(servoMap(101, 101, bumps)));
    EXPECT_TRUE(loop.isRunning());
    while (writes.reads < 20) {
        std::this_thread::yield();
    }
    loop.set({});
    EXPECT_FALSE(loop.isRunning());
    const int reads = writes.reads;
    // Meanwhile another one makes twenty turns.
    Writes others;
    ServoLoop other(std::make_unique<WatchedDevice>(others), quick(20));
    other.set(settingsFor(servoMap(101, 101, bumps)));
    waitFor(other);
    EXPECT_EQ(writes.reads, reads);
    EXPECT_EQ(writes.forces_n.back(), Vec3{}); // and leaves the motors at rest
}

TEST(ServoLoop, FadesOutInsteadOfDroppingTheForce)
{
    Writes writes;
    {
        ServoLoop loop(std::make_unique<WatchedDevice>(writes), quick(0));
        loop.set(settingsFor(servoMap(101, 101, [](auto, auto) { return 0.0; })));
        while (loop.state().force_n.z < 1.0) {
            std::this_thread::yield();
        }
    }
    EXPECT_EQ(writes.forces_n.back(), Vec3{});
    for (std::size_t i = 1; i < writes.forces_n.size(); ++i) {
        const double change_n = length(writes.forces_n[i] - writes.forces_n[i - 1]);
        const std::chrono::duration<double> between = writes.times[i] - writes.times[i - 1];
        EXPECT_LE(change_n, 2000.0 * between.count() + 1e-9) << "write " << i;
    }
}

TEST(ServoLoop, TellsItsStateEventsAndStatistics)
{
    ServoLoop loop(simulated(), quick(5000));
    loop.set(settingsFor(servoMap(201, 201, bumps)));
    waitFor(loop);
    loop.stop();
    const LoopState state = loop.state();
    EXPECT_GE(state.tick, 5000U);
    EXPECT_EQ(state.force_n, Vec3{});
    EXPECT_GT(state.counts.in_contact, 500U);
    EXPECT_GE(loop.statistics().tick.count(), 5000U);
    bool has_held = false;
    bool has_changed = false;
    LoopEvent event;
    while (loop.nextEvent(event)) {
        has_held = has_held || event.kind == LoopEventKind::Holding;
        has_changed = has_changed || event.kind == LoopEventKind::ModeChanged;
    }
    EXPECT_TRUE(has_held);
    EXPECT_TRUE(has_changed);
    EXPECT_EQ(loop.flight().records().size(), std::min<std::size_t>(10'000, state.tick));
}

TEST(ServoLoop, TakesOtherSettingsWhileItRuns)
{
    ServoLoop loop(simulated(), quick(0));
    const auto filled = filledTerrain(201, 201, bumps);
    for (int i = 0; i < 60; ++i) {
        LoopSettings settings =
            settingsFor(makeServoMap(metreFrame(201, 201), filled,
                                     {.kind = kContactModelKinds[static_cast<std::size_t>(i) % 6],
                                      .contact = {.radius_m = 0.5},
                                      .map_id = static_cast<std::uint64_t>(i / 10)}));
        settings.frame_number = static_cast<std::uint64_t>(i / 5);
        settings.is_stopped = i % 7 == 0;
        loop.set(settings);
        const std::uint64_t until = loop.state().tick + 20;
        while (loop.state().tick < until) {
            (void)loop.statistics();
            (void)loop.flight().records();
            std::this_thread::yield();
        }
    }
    loop.stop();
    EXPECT_EQ(loop.state().force_n, Vec3{});
}

// A device with a thread of its own, as vendors' schedulers are.
class ClockDevice final : public HapticDevice {
public:
    ClockDevice()
        : capabilities_(desktopDevice())
    {
        capabilities_.owns_clock = true;
    }
    ~ClockDevice() override { stopClock(); }
    const DeviceCapabilities& capabilities() const noexcept override { return capabilities_; }
    DeviceStatus read(DeviceSample& sample) noexcept override
    {
        sample.position = {0.0, 0.0, -0.003};
        sample.time = std::chrono::steady_clock::now();
        return DeviceStatus::Fine;
    }
    DeviceStatus write(const Vec3& /*force_n*/) noexcept override { return DeviceStatus::Fine; }
    bool startClock(ClockTick tick, void* self) noexcept override
    {
        is_stopping_ = false;
        thread_ = std::thread([this, tick, self] {
            while (!is_stopping_) {
                tick(self, std::chrono::steady_clock::now());
                std::this_thread::sleep_for(200us);
            }
        });
        return true;
    }
    void stopClock() noexcept override
    {
        is_stopping_ = true;
        if (thread_.joinable()) {
            thread_.join();
        }
    }

private:
    DeviceCapabilities capabilities_;
    std::atomic<bool> is_stopping_{false};
    std::thread thread_;
};

TEST(ServoLoop, LetsADeviceThatOwnsTheClockCallTheTick)
{
    ServoLoop loop(std::make_unique<ClockDevice>(), quick(0));
    loop.set(settingsFor(servoMap(101, 101, [](auto, auto) { return 0.0; })));
    while (loop.state().force_n.z < 0.5) {
        std::this_thread::yield();
    }
    loop.stop();
    EXPECT_FALSE(loop.isRunning());
    EXPECT_GT(loop.statistics().tick.count(), 10U);
    EXPECT_NE(loop.grants().scheduling_refusal, "");
}

TEST(ServoLoop, ARecordingReplaysToTheSameProxiesToTheBit)
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
        loop.set(settingsFor(makeServoMap(metreFrame(201, 201), filled, {})));
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

    // Goals, contact and proxies: the first three columns, the sixth to the ninth.
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
    // Other models and exaggerations while the hand is on the ground, and one that comes back.
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
    const std::string text = readFile(path);
    const auto recording = readGoalRecording(text, path);
    ASSERT_TRUE(recording) << recording.error().message;
    ASSERT_EQ(recording->parts.size(), 8U);
    EXPECT_EQ(recording->parts[1].kind, ContactModelKind::VirtualProxy);
    EXPECT_EQ(recording->parts[1].radius_m, 0.75);
    EXPECT_EQ(recording->parts[2].exaggeration, 2.5);
    EXPECT_EQ(recording->parts[3].part, recording->parts[0].part);
    EXPECT_EQ(recording->parts[7].map, recording->parts[0].map);

    // Models made anew from what the file tells go the same ways, to the bit.
    std::map<std::uint64_t, std::shared_ptr<ServoMap>> again;
    std::size_t begin = text.find('\n') + 1;
    std::size_t in_contact = 0;
    for (std::size_t p = 0; p < recording->parts.size(); ++p) {
        const GoalPart& part = recording->parts[p];
        auto& map = again[part.part];
        map = map ? map : made(part.kind, part.exaggeration, part.radius_m);
        const std::size_t end = p + 1 < recording->parts.size() ? recording->parts[p + 1].first
                                                                : recording->goals.size();
        for (std::size_t i = part.first; i < end; ++i) {
            const TracePoint& goal = recording->goals[i];
            const ContactState state = map->model->update(map->frame.toScene(goal));
            const TracePoint proxy = state.is_in_contact || map->frame.isClamped(goal)
                                         ? map->frame.fromScene(state.proxy)
                                         : goal;
            const std::size_t line_end = text.find('\n', begin);
            const std::string line = text.substr(begin, line_end - begin);
            ASSERT_NE(line.find(fmt::format(",{},{},{},{},", state.is_in_contact ? 1 : 0,
                                            asText(proxy.x), asText(proxy.y), asText(proxy.z))),
                      std::string::npos)
                << "goal " << i << " of part " << p << ": " << line;
            begin = line_end + 1;
            in_contact += state.is_in_contact ? 1U : 0U;
        }
    }
    EXPECT_GT(in_contact, 500U);
}

TEST(SessionRecorder, SaysThatUpdatesAreMissing)
{
    const TempFolder folder;
    const std::string path = folder.file("session.csv");
    ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
    const int reader = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    ASSERT_GE(reader, 0);
    ServoLoop loop(simulated(), quick(0));
    loop.set(settingsFor(makeServoMap(metreFrame(201, 201), filledTerrain(201, 201, bumps), {})));
    auto recorder = SessionRecorder::begin(loop, path);
    ASSERT_TRUE(recorder) << recorder.error().message;
    // Nobody reads: a disk that takes nothing any more.
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
                    path + ": [0-9]+ of [0-9]+ updates are missing, as they could not be written"));
    drain.request_stop();
    drain.join();
    close(reader);
}

TEST(SessionRecorder, ARecordingThatBeginsInTheMiddleOfATouchKnowsAllOfItsModel)
{
    const TempFolder folder;
    const std::string path = folder.file("session.csv");
    const auto filled = filledTerrain(201, 201, bumps);
    const GoalFrame frame = metreFrame(201, 201);
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
        runOn(100); // of which the file has nothing
        loop.set(settingsFor(fresh));
        runOn(2000);
        ASSERT_TRUE((*recorder)->finish());
        EXPECT_EQ(loop.state().counts.not_recorded, 0U);

        const std::string text = readFile(path);
        const auto recording = readGoalRecording(text, path);
        ASSERT_TRUE(recording) << recording.error().message;
        ASSERT_EQ(recording->parts.size(), 1U);
        EXPECT_EQ(recording->parts[0].part, fresh->serial);
        EXPECT_GE(recording->goals.size(), 2000U);
        const auto again = makeServoMap(frame, filled, options);
        std::size_t begin = text.find('\n') + 1;
        for (const TracePoint& goal : recording->goals) {
            const ContactState state = again->model->update(frame.toScene(goal));
            const TracePoint proxy =
                state.is_in_contact || frame.isClamped(goal) ? frame.fromScene(state.proxy) : goal;
            const std::size_t end = text.find('\n', begin);
            const std::string line = text.substr(begin, end - begin);
            ASSERT_NE(line.find(fmt::format(",{},{},{},{},", state.is_in_contact ? 1 : 0,
                                            asText(proxy.x), asText(proxy.y), asText(proxy.z))),
                      std::string::npos)
                << line;
            begin = end + 1;
        }
    }
}

TEST(GoalFile, SaysWhichLineOfARecordingItCannotRead)
{
    const std::string header = "x,y,z,map,part,model,radius_m,exaggeration\n";
    const auto goals = readGoalRecording(header + "1,2,3,1,7,god-object,0.5,2\n", "a.csv");
    ASSERT_TRUE(goals);
    ASSERT_EQ(goals->parts.size(), 1U);
    EXPECT_EQ(goals->parts[0].kind, ContactModelKind::GodObject);
    EXPECT_TRUE(readGoalRecording("x,y,z\n1,2,3\n", "a.csv")->parts.empty());
    for (const char* line : {"1,2,3,1,7,god-objects,0.5,2", "1,2,3,1,7,god-object,0.5",
                             "1,2,3,1,7,god-object,0,2", "1,2,3,1,7,god-object,0.5,nan",
                             "1,2,3,-1,7,god-object,0.5,2", "1,2,3,1,,god-object,0.5,2"}) {
        const auto refused = readGoalRecording(header + line + "\n", "a.csv");
        ASSERT_FALSE(refused) << line;
        EXPECT_TRUE(refused.error().message.starts_with("a.csv: line 2 ")) << line;
    }
}

TEST(SessionRecorder, SaysWhereItCannotWrite)
{
    ServoLoop loop(simulated(), quick(10));
    const auto recorder = SessionRecorder::begin(loop, "/nowhere/session.csv");
    ASSERT_FALSE(recorder);
    EXPECT_EQ(recorder.error().message,
              "/nowhere/session.csv: cannot be written (No such file or directory); choose another "
              "file, in a folder that is there and may be written to");
}

} // namespace
} // namespace marsview::test
