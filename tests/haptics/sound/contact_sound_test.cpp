#include "haptics/sound/contact_sound.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace marsview::test {
namespace {

constexpr ContactFeel kStroke{.is_in_contact = true,
                              .force_n = 1.0,
                              .speed_m_per_s = 0.05,
                              .roughness_rad = 0.1,
                              .height_share = 0.5,
                              .across = 0.0};

ContactFeel anyStroke(Random& random)
{
    return {.is_in_contact = true,
            .force_n = random.uniform(0.0, 5.0),
            .speed_m_per_s = random.uniform(0.0, 0.5),
            .roughness_rad = random.uniform(0.0, 1.5),
            .height_share = random.uniform(-0.2, 1.2),
            .across = random.uniform(-1.2, 1.2)};
}

bool isWithinBounds(const SoundState& s)
{
    return s.noise_gain >= 0.0 && s.noise_gain <= kNoiseGainMax && s.noise_pitch >= 0.5 &&
           s.noise_pitch <= 2.0 && s.tone_gain >= 0.0 && s.tone_gain <= kToneGainMax &&
           s.tone_hz >= kToneHzMin && s.tone_hz <= kToneHzMax && s.pan >= -1.0 && s.pan <= 1.0;
}

TEST(ContactSound, IsSilentWithoutContactAndWithoutForce)
{
    ContactFeel free = kStroke;
    free.is_in_contact = false;
    EXPECT_EQ(contactSound(free), SoundState{});
    ContactFeel grazing = kStroke;
    grazing.force_n = 0.0;
    EXPECT_EQ(contactSound(grazing).noise_gain, 0.0);
    EXPECT_EQ(contactSound(grazing).tone_gain, 0.0);
    grazing.force_n = 1e-4; // a contact that has just started cannot click
    EXPECT_LT(contactSound(grazing).tone_gain + contactSound(grazing).noise_gain, 1e-3);
}

TEST(ContactSound, AtRestThereIsAToneAndNoHiss)
{
    ContactFeel rest = kStroke;
    rest.speed_m_per_s = 0.0;
    EXPECT_EQ(contactSound(rest).noise_gain, 0.0);
    // Computed by hand: 0.4 (1 - 1/e), and 2 (1 - 1/e) + 1/2 octaves above 110 Hz.
    EXPECT_NEAR(contactSound(rest).tone_gain, 0.252848, 1e-6);
    EXPECT_NEAR(contactSound(rest).tone_hz, 373.665, 1e-3);
}

TEST(ContactSound, GrowsWithTheQuantityItRepresents)
{
    Random random;
    for (int i = 0; i < 2000; ++i) {
        const ContactFeel feel = anyStroke(random);
        const SoundState was = contactSound(feel);
        ContactFeel more = feel;
        more.force_n += 0.1;
        EXPECT_GE(contactSound(more).noise_gain, was.noise_gain);
        EXPECT_GT(contactSound(more).tone_gain, was.tone_gain);
        EXPECT_GT(contactSound(more).tone_hz, was.tone_hz);
        EXPECT_EQ(contactSound(more).noise_pitch, was.noise_pitch);
        more = feel;
        more.speed_m_per_s += 0.01;
        EXPECT_GT(contactSound(more).noise_gain, was.noise_gain);
        EXPECT_GT(contactSound(more).noise_pitch, was.noise_pitch);
        EXPECT_EQ(contactSound(more).tone_gain, was.tone_gain);
        more = feel;
        more.roughness_rad += 0.05;
        EXPECT_GT(contactSound(more).noise_gain, was.noise_gain);
        EXPECT_GT(contactSound(more).noise_pitch, was.noise_pitch);
        EXPECT_EQ(contactSound(more).tone_hz, was.tone_hz);
        EXPECT_EQ(contactSound(more).tone_gain, was.tone_gain);
        more = feel;
        more.height_share += 0.01;
        EXPECT_GE(contactSound(more).tone_hz, was.tone_hz);
        EXPECT_EQ(contactSound(more).tone_gain, was.tone_gain) << "loudness shows only force";
        EXPECT_EQ(contactSound(more).noise_gain, was.noise_gain);
        if (feel.height_share > 0.0 && feel.height_share < 0.98) {
            EXPECT_GT(contactSound(more).tone_hz, was.tone_hz);
        }
        more = feel;
        more.across += 0.01;
        EXPECT_GE(contactSound(more).pan, was.pan);
    }
}

TEST(ContactSound, RisesTwoOctavesWithTheForceAndOneWithTheHeight)
{
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    ContactFeel feel = kStroke;
    feel.height_share = 0.0;
    feel.force_n = 0.0;
    EXPECT_DOUBLE_EQ(contactSound(feel).tone_hz, 110.0);
    feel.force_n = std::log(2.0); // half of the effect: one octave
    EXPECT_NEAR(contactSound(feel).tone_hz, 220.0, 1e-9);
    feel.height_share = 0.5; // and half of the other
    EXPECT_NEAR(contactSound(feel).tone_hz, 220.0 * std::sqrt(2.0), 1e-9);
    feel.height_share = 0.0;
    feel.force_n = kInfinity;
    EXPECT_NEAR(contactSound(feel).tone_hz, 440.0, 1e-9);
    feel.height_share = 1.0;
    EXPECT_NEAR(contactSound(feel).tone_hz, 880.0, 1e-9);
}

// The noise depends on the texture, at every force and speed: rough terrain hisses four times as
// loud as smooth terrain, and an octave higher.
TEST(ContactSound, HearsRoughGroundFromSmoothGround)
{
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Random random;
    for (int i = 0; i < 1000; ++i) {
        ContactFeel smooth = anyStroke(random);
        smooth.roughness_rad = 0.0;
        ContactFeel rough = smooth;
        rough.roughness_rad = kInfinity;
        EXPECT_NEAR(contactSound(rough).noise_gain, 4.0 * contactSound(smooth).noise_gain, 1e-12);
        EXPECT_NEAR(contactSound(rough).noise_pitch, 2.0 * contactSound(smooth).noise_pitch, 1e-12);
    }
}

TEST(ContactSound, NothingJumps)
{
    // Input steps of a thousandth change gains by less than a thousandth, too.
    Random random;
    for (int i = 0; i < 5000; ++i) {
        const ContactFeel feel = anyStroke(random);
        const SoundState was = contactSound(feel);
        const ContactFeel next{.is_in_contact = true,
                               .force_n = feel.force_n + 1e-3,
                               .speed_m_per_s = feel.speed_m_per_s + 5e-5,
                               .roughness_rad = feel.roughness_rad + 1.5e-4,
                               .height_share = feel.height_share + 1e-3,
                               .across = feel.across + 1e-3};
        const SoundState is = contactSound(next);
        EXPECT_NEAR(is.noise_gain, was.noise_gain, 2e-3);
        EXPECT_NEAR(is.tone_gain, was.tone_gain, 1e-3);
        EXPECT_NEAR(is.noise_pitch, was.noise_pitch, 3e-3);
        EXPECT_NEAR(is.tone_hz / was.tone_hz, 1.0, 3e-3);
        EXPECT_NEAR(is.pan, was.pan, 1.001e-3);
    }
}

TEST(ContactSound, StaysWithinItsBoundsForAnyInput)
{
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    constexpr double kHuge = std::numeric_limits<double>::max();
    const double odd[] = {-kInfinity, -kHuge, -1.0, 0.0, 1.0, kHuge, kInfinity};
    for (const double force : odd) {
        for (const double speed : odd) {
            for (const double other : odd) {
                const SoundState state = contactSound({.is_in_contact = true,
                                                       .force_n = force,
                                                       .speed_m_per_s = speed,
                                                       .roughness_rad = other,
                                                       .height_share = other,
                                                       .across = other});
                EXPECT_TRUE(isWithinBounds(state)) << force << " " << speed << " " << other;
            }
        }
    }
    Random random;
    for (int i = 0; i < 5000; ++i) {
        EXPECT_TRUE(isWithinBounds(contactSound(anyStroke(random))));
    }
}

TEST(ContactSound, InvalidNumbersAreSilent)
{
    for (double ContactFeel::*field :
         {&ContactFeel::force_n, &ContactFeel::speed_m_per_s, &ContactFeel::roughness_rad,
          &ContactFeel::height_share, &ContactFeel::across}) {
        ContactFeel feel = kStroke;
        feel.*field = std::numeric_limits<double>::quiet_NaN();
        EXPECT_EQ(contactSound(feel), SoundState{});
    }
}

} // namespace
} // namespace marsview::test
