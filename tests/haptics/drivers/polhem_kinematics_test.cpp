#include "haptics/drivers/polhem/polhem_kinematics.h"
#include "haptics/drivers/polhem/polhem_parameters.h"
#include "tests/support/random.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>

namespace marsview::test {
namespace {

using std::numbers::pi;
using testing::HasSubstr;

std::string bundledFilePath()
{
    return (sourceRoot() / "resources/devices/polhem-v1.json").string();
}

PolhemParameters polhem()
{
    Result<PolhemParameters> p = readPolhemParameters(bundledFilePath());
    EXPECT_TRUE(p) << p.error().message;
    return *p;
}

void expectNear(const WorkspacePoint& a, const WorkspacePoint& b, double tolerance_m = 1e-12)
{
    EXPECT_NEAR(a.x, b.x, tolerance_m);
    EXPECT_NEAR(a.y, b.y, tolerance_m);
    EXPECT_NEAR(a.z, b.z, tolerance_m);
}

} // namespace

// Bodies of 58, 174 and 133 mm; the workspace origin is 140 mm in front of the axis, 100 mm up.
TEST(PolhemKinematics, PutsTheTipWhereTheBodiesLead)
{
    const PolhemParameters p = polhem();
    // Both bodies level, toward the user: 307 mm out, 58 mm up.
    expectNear(polhemPosition(p, {0.0, pi / 2, pi / 2}), {0.0, -0.167, -0.042});
    // The lower body upright, the upper one level, the base turned to the right.
    expectNear(polhemPosition(p, {pi / 2, 0.0, pi / 2}), {0.133, 0.140, 0.132});
    // Both upright: the upper one hangs down next to the lower one.
    expectNear(polhemPosition(p, {0.0, 0.0, 0.0}), {0.0, 0.140, -0.001});
}

TEST(PolhemKinematics, CountsEncodersThroughTheCapstans)
{
    const PolhemParameters p = polhem();
    // 2.5 turns of a 10 mm capstan on a body of 100 mm are a quarter of a turn.
    const PolhemPose home = polhemPose(p, p.home_encoders);
    EXPECT_NEAR(home.a, 0.0, 1e-15);
    EXPECT_NEAR(home.b, 0.0, 1e-15);
    EXPECT_NEAR(home.c, pi / 2, 1e-12);
    expectNear(polhemPosition(p, home), {0.0, 0.007, 0.132});
    // The base has 180 mm: 18 turns of the motor per turn, in the opposite direction.
    EXPECT_NEAR(polhemPose(p, {9000, 0, 0, 0, 0, 0}).a, -pi / 2, 1e-12);
    EXPECT_NEAR(polhemTwist(p, {0, 0, 0, 0, 0, 256}), -pi / 2, 1e-12);
}

TEST(PolhemKinematics, SendsCurrentsThatHoldAForce)
{
    const PolhemParameters p = polhem();
    const PolhemPose pose{0.0, 0.0, pi / 2}; // the upper body level, toward the user
    // 1 N down at 133 mm: 0.133 N·m, a tenth of it at the motor.
    const auto lift = polhemCurrents(p, pose, {0.0, 0.0, 1.0});
    EXPECT_NEAR(lift[0], 0.0, 1e-12);
    EXPECT_NEAR(lift[1], 0.0, 1e-12);
    EXPECT_NEAR(lift[2], -0.0133 / 0.0538, 1e-12);
    // 2 N to the right turn the base: 0.266 N·m, an eighteenth of it at the motor.
    const auto turn = polhemCurrents(p, pose, {2.0, 0.0, 0.0});
    EXPECT_NEAR(turn[0], -0.266 / 18.0 / 0.0538, 1e-12);
    EXPECT_NEAR(turn[1], 0.0, 1e-12);
    EXPECT_NEAR(turn[2], 0.0, 1e-12);
    // 1 N away from the user, with the lower body upright: 0.174 N·m against it.
    EXPECT_NEAR(polhemCurrents(p, pose, {0.0, 1.0, 0.0})[1], 0.0174 / 0.0538, 1e-12);
}

TEST(PolhemKinematics, DoesTheSameWorkAtTheTipAndAtTheBodies)
{
    const PolhemParameters p = polhem();
    Random random;
    const auto angle = [&] { return random.uniform(-2.0, 2.0); };
    const auto newton = [&] { return random.uniform(-5.0, 5.0); };
    constexpr double kStep = 1e-6;
    double worst = 0.0;
    for (int i = 0; i < 2000; ++i) {
        const std::array<double, 3> q{angle(), angle(), angle()};
        const Vec3 force{newton(), newton(), newton()};
        const auto torques = polhemTorques(p, {q[0], q[1], q[2]}, force);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            // Central differences of the position, which are independent of the Jacobian.
            std::array<double, 3> more = q;
            std::array<double, 3> less = q;
            more[axis] += kStep;
            less[axis] -= kStep;
            const Vec3 dx = polhemPosition(p, {more[0], more[1], more[2]}) -
                            polhemPosition(p, {less[0], less[1], less[2]});
            const double work_at_tip = dot(force, dx);
            const double work_at_body = torques[axis] * 2.0 * kStep;
            worst = std::max(worst, std::abs(work_at_tip - work_at_body) / (2.0 * kStep));
        }
    }
    std::printf("largest difference %.2g N·m\n", worst);
    EXPECT_LT(worst, 2e-9); // the error of the differences: 1e-16 m of rounding over 1e-6 rad, 5 N
}

TEST(PolhemKinematics, KeepsTheForcesDirectionWhereACurrentIsAtItsMaximum)
{
    const PolhemParameters p = polhem();
    Random random;
    const auto angle = [&] { return random.uniform(-2.0, 2.0); };
    const auto newton = [&] { return random.uniform(-500.0, 500.0); };
    for (int i = 0; i < 1000; ++i) {
        const PolhemPose pose{angle(), angle(), angle()};
        const Vec3 force{newton(), newton(), newton()};
        const auto currents = polhemCurrents(p, pose, force);
        const auto small = polhemCurrents(p, pose, force * 1e-5);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            ASSERT_LE(std::abs(currents[axis]), 2.0 * (1.0 + 1e-12));
            // The ratios are those of a force that needs no limit.
            EXPECT_NEAR(currents[axis] * small[(axis + 1) % 3],
                        currents[(axis + 1) % 3] * small[axis], 1e-12);
        }
    }
}

TEST(PolhemKinematics, SendsNoCurrentForAForceThatIsNone)
{
    const PolhemParameters p = polhem();
    for (const Vec3& force : {Vec3{std::nan(""), 0.0, 0.0}, Vec3{0.0, 0.0, INFINITY}}) {
        EXPECT_EQ(polhemCurrents(p, {0.1, 0.2, 0.3}, force), (std::array<double, 3>{}));
    }
}

TEST(PolhemParameters, AreThoseThatTheMakersPublished)
{
    const PolhemParameters p = polhem();
    EXPECT_EQ(p.name, "Polhem v1");
    EXPECT_EQ(p.force_n_peak, 5.0);
    EXPECT_EQ(p.stiffness_n_per_m_max, 800.0);
    const WorkspaceBox box = polhemWorkspace(p);
    EXPECT_NEAR(length(box.high - WorkspacePoint{}), 0.1, 1e-12); // its corners are on the sphere
    EXPECT_EQ(box.low.x, -box.high.x);
}

TEST(PolhemParameters, SayWhichNumberIsWrong)
{
    const TempFolder folder;
    const nlohmann::json good = nlohmann::json::parse(readFile(bundledFilePath()));
    const auto complaint = [&](const char* name, const nlohmann::json& value) {
        nlohmann::json json = good;
        if (value.is_discarded()) {
            json.erase(name);
        } else {
            json[name] = value;
        }
        const std::string file = folder.write("arm.json", json.dump());
        const auto p = readPolhemParameters(file);
        EXPECT_FALSE(p) << name;
        if (p) {
            return std::string();
        }
        EXPECT_TRUE(p.error().message.starts_with(file + ": ")) << p.error().message;
        return p.error().message.substr(file.size() + 2);
    };
    const nlohmann::json missing(nlohmann::json::value_t::discarded);
    EXPECT_EQ(complaint("current_a_max", missing), "\"current_a_max\" is missing");
    EXPECT_EQ(complaint("current_a_max", -1),
              "\"current_a_max\" holds -1, which is outside "
              "[0.01, 20]");
    EXPECT_EQ(complaint("body_length_m", {0.1, 0.2}),
              "\"body_length_m\" is not an array of 3 "
              "numbers");
    EXPECT_EQ(complaint("body_length_m", {0.1, "x", 0.2}),
              "\"body_length_m\" holds \"x\", which is not a number");
    EXPECT_EQ(complaint("angle_sign", {1, 0.5, 1}),
              "\"angle_sign\" holds values other than 1 "
              "and −1");
    EXPECT_THAT(complaint("home_encoders", {0, 0, 40000, 0, 0, 0}), HasSubstr("40000"));
    EXPECT_THAT(complaint("force_n_continuous", 6.0), HasSubstr("outside [0, 5]"));

    EXPECT_THAT(readPolhemParameters(folder.write("x.json", "{")).error().message,
                testing::EndsWith("x.json: is not a JSON object"));
    EXPECT_EQ(readPolhemParameters(folder.file("none.json")).error().code, ErrorCode::NotFound);
}

} // namespace marsview::test
