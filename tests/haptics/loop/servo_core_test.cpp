#include "haptics/loop/servo_core.h"
#include "tests/haptics/loop/tick_fixture.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace marsview::test {
namespace {

using std::chrono::steady_clock;

// What a device answers next, and what was last written to it.
struct Script {
    WorkspacePoint hand{0.0, 0.0, 0.02};
    DeviceStatus status = DeviceStatus::Fine;
    Vec3 written_n{};
};

class ScriptedDevice final : public HapticDevice {
public:
    explicit ScriptedDevice(std::shared_ptr<Script> script)
        : script_(std::move(script))
    {}
    const DeviceCapabilities& capabilities() const noexcept override { return capabilities_; }
    DeviceStatus read(DeviceSample& sample) noexcept override
    {
        sample.position = script_->hand;
        sample.time = steady_clock::now();
        return script_->status;
    }
    DeviceStatus write(const Vec3& force_n) noexcept override
    {
        script_->written_n = force_n;
        return DeviceStatus::Fine;
    }

private:
    std::shared_ptr<Script> script_;
    DeviceCapabilities capabilities_ = desktopDevice();
};

// Turns by hand, without threads. The terrain is a level plane in the middle of the workspace.
struct TurnedCore {
    std::shared_ptr<Script> script = std::make_shared<Script>();
    ServoCore core;
    LoopSettings settings{};

    explicit TurnedCore(const ServoCoreOptions& options)
        : core(std::make_unique<ScriptedDevice>(script), options)
    {
        core.begin();
        settings.map = servoMap(201, 201, [](std::size_t, std::size_t) { return 0.0; });
        settings.frame = {.scene_per_meter = 1000.0};
        settings.frame_number = 1;
        core.settings().back() = settings;
        core.settings().publish();
    }
    LoopOutcome turn() { return core.turn(steady_clock::now(), false); }
};

TEST(ServoCore, CountsWhatItPublishes)
{
    constexpr std::uint64_t kTurns = 300;
    constexpr std::uint64_t kUncounted = 10;
    ServoCoreOptions options;
    options.uncounted_turns = kUncounted;
    options.ticks_max = kTurns;
    TurnedCore rig(options);
    EXPECT_FALSE(rig.core.isStalled());
    LoopCounts expected;
    std::uint64_t disturbed = 0; // turns in which a busy machine was too slow
    for (std::uint64_t i = 1; i <= kTurns; ++i) {
        EXPECT_FALSE(rig.core.hasEnded());
        const bool is_pressing = i > 50 && i <= 250;
        rig.script->hand = {0.0, 0.0, is_pressing ? -0.002 : 0.004};
        rig.script->status = i > 200 && i <= 220 ? DeviceStatus::Unready : DeviceStatus::Fine;
        EXPECT_EQ(rig.turn(), i < kTurns ? LoopOutcome::Continue : LoopOutcome::Stop) << i;
        const LoopState state = rig.core.state();
        EXPECT_EQ(state.tick, i);
        const bool is_fine = rig.script->status == DeviceStatus::Fine;
        const bool is_undisturbed = is_fine && state.reason == ForceOffReason::None;
        if (is_undisturbed) {
            EXPECT_EQ(state.contact.is_in_contact, is_pressing) << i;
        }
        if (i > kUncounted) {
            ++expected.ticks;
            expected.in_contact += is_undisturbed && is_pressing ? 1U : 0U;
            disturbed += is_fine && !is_undisturbed ? 1U : 0U;
            expected.read_errors += is_fine ? 0U : 1U;
            expected.force_off += state.reason != ForceOffReason::None ? 1U : 0U;
        }
        EXPECT_EQ(state.counts.ticks, i > kUncounted ? expected.ticks : i);
    }
    EXPECT_TRUE(rig.core.hasEnded());
    const LoopCounts counts = rig.core.state().counts;
    EXPECT_GE(counts.in_contact, expected.in_contact);
    EXPECT_LE(counts.in_contact, expected.in_contact + disturbed);
    EXPECT_LE(counts.in_contact, 180U);
    EXPECT_GE(counts.in_contact + disturbed, 180U);
    EXPECT_EQ(counts.read_errors, 20U);
    EXPECT_GE(counts.force_off, 20U);
    EXPECT_EQ(counts.force_off, expected.force_off);
    EXPECT_EQ(counts.cut_short, 0U);
    EXPECT_EQ(counts.samples_missed, 0U);
    EXPECT_EQ(counts.ticks_with_misses, 0U);
    EXPECT_EQ(counts.not_recorded, 0U);
}

// Section 4.2 of the paper: to grab empty space and ratchet up or down moves the surface towards or
// away from the camera. While the surface is covered, nothing updates the contact, and the next
// record has all of the motion: x in the scene becomes to + (x - from) * scale.
TEST(ServoCore, MotionsBetweenTwoUpdatesAreRecordedAsOne)
{
    ServoCoreOptions options;
    TurnedCore rig(options);
    rig.core.keepRecords(true);
    LoopSettings settings = rig.settings;
    const auto turn = [&](bool is_covered, bool is_grabbing) {
        settings.is_covered = is_covered;
        settings.is_grabbing = is_grabbing;
        rig.core.settings().back() = settings;
        rig.core.settings().publish();
        rig.turn();
        std::vector<TickRecord> records;
        for (TickRecord record; rig.core.records().take(record);) {
            records.push_back(record);
        }
        return records;
    };
    turn(false, false);
    for (const double stroke_m : {2e-4, -3e-4}) {
        turn(false, false);
        ASSERT_EQ(turn(false, false).size(), 1U);
        const WorkspaceFrame before = rig.core.state().seen_frame;
        int motions = 0;
        for (int i = 0; i < 20; ++i) {
            const WorkspaceFrame last = rig.core.state().seen_frame;
            rig.script->hand.z += stroke_m;
            EXPECT_TRUE(turn(true, i > 0).empty());
            motions += rig.core.state().seen_frame == last ? 0 : 1;
        }
        EXPECT_GT(motions, 10);
        const std::vector<TickRecord> records = turn(false, false);
        ASSERT_FALSE(records.empty());
        ASSERT_TRUE(records.front().has_motion);
        const SceneMotion& motion = records.front().motion;
        const WorkspaceFrame& after = rig.core.state().seen_frame;
        for (const WorkspacePoint& at : {WorkspacePoint{}, WorkspacePoint{0.05, -0.03, 0.02}}) {
            const ScenePoint moved = motion.to + (before.toScene(at) - motion.from) * motion.scale;
            EXPECT_NEAR(length(moved - after.toScene(at)), 0.0, 1e-9);
        }
        EXPECT_EQ(motion.scale > 1.0, stroke_m < 0.0) << "lifted, the surface comes nearer";
        EXPECT_FALSE(turn(false, false).front().has_motion);
    }
}

} // namespace
} // namespace marsview::test
