// Against OpenAL's loopback device: the output as numbers.
#include "haptics/sound/sound_loops.h"
#include "haptics/sound/sound_player.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace marsview::test {
namespace {

constexpr int kRateHz = 48000;
constexpr std::size_t kFrame = 800; // between two of sixty updates per second

struct Heard {
    std::vector<double> left;
    std::vector<double> right;
};

SoundPlayer player()
{
    return SoundPlayer::openLoopback(kRateHz).value();
}

// The given number of frames, a sixtieth of a second each.
Heard hear(SoundPlayer& player, int frames)
{
    Heard heard;
    std::vector<float> samples(2 * kFrame);
    for (int i = 0; i < frames; ++i) {
        player.render(samples);
        for (std::size_t s = 0; s < samples.size(); s += 2) {
            heard.left.push_back(static_cast<double>(samples[s]));
            heard.right.push_back(static_cast<double>(samples[s + 1]));
        }
    }
    return heard;
}

// The output after the volume ramps have ended.
Heard heardOf(const SoundState& state, int frames = 30)
{
    SoundPlayer playing = player();
    playing.set(state);
    hear(playing, 6);
    return hear(playing, frames);
}

double rms(const std::vector<double>& samples)
{
    double sum = 0.0;
    for (const double sample : samples) {
        sum += sample * sample;
    }
    return std::sqrt(sum / static_cast<double>(samples.size()));
}

double loudest(const std::vector<double>& samples)
{
    double most = 0.0;
    for (const double sample : samples) {
        most = std::max(most, std::abs(sample));
    }
    return most;
}

double steepest(const std::vector<double>& samples)
{
    double most = 0.0;
    for (std::size_t i = 1; i < samples.size(); ++i) {
        most = std::max(most, std::abs(samples[i] - samples[i - 1]));
    }
    return most;
}

// Upward zero crossings per second.
double pitchHz(const std::vector<double>& samples)
{
    std::size_t first = 0;
    std::size_t last = 0;
    int crossings = -1;
    for (std::size_t i = 1; i < samples.size(); ++i) {
        if (samples[i - 1] < 0.0 && samples[i] >= 0.0) {
            first = crossings < 0 ? i : first;
            last = i;
            ++crossings;
        }
    }
    return last > first ? crossings * double{kRateHz} / static_cast<double>(last - first) : 0.0;
}

TEST(SoundPlayer, IsSilentUntilItIsStarted)
{
    SoundPlayer playing = player();
    const Heard heard = hear(playing, 30);
    EXPECT_EQ(loudest(heard.left), 0.0);
    EXPECT_EQ(loudest(heard.right), 0.0);
}

TEST(SoundPlayer, IsSilentAgainWithinATenthOfASecond)
{
    SoundPlayer playing = player();
    playing.set({.noise_gain = 0.6, .tone_gain = 0.4});
    EXPECT_GT(rms(hear(playing, 30).left), 0.05);
    playing.set({});
    hear(playing, 6);
    EXPECT_EQ(loudest(hear(playing, 30).left), 0.0);
}

TEST(SoundPlayer, PlaysTheTone)
{
    for (const double tone_hz : {110.0, 220.0, 311.13, 880.0}) {
        const Heard heard = heardOf({.tone_gain = 0.4, .tone_hz = tone_hz}, 120);
        EXPECT_NEAR(pitchHz(heard.left) / tone_hz, 1.0, 2e-3);
        EXPECT_NEAR(pitchHz(heard.right) / tone_hz, 1.0, 2e-3);
        EXPECT_NEAR(rms(heard.left), rms(heard.right), 1e-6);
    }
}

TEST(SoundPlayer, IsTwiceAsLoudWithTwiceTheGain)
{
    const double half = rms(heardOf({.tone_gain = 0.2}).left);
    EXPECT_NEAR(rms(heardOf({.tone_gain = 0.4}).left) / half, 2.0, 1e-3);
    const double hiss = rms(heardOf({.noise_gain = 0.3}).left);
    EXPECT_NEAR(rms(heardOf({.noise_gain = 0.6}).left) / hiss, 2.0, 1e-3);
}

TEST(SoundPlayer, PlaysWhereThePlaceIs)
{
    for (const bool is_noise : {false, true}) {
        double before = std::numeric_limits<double>::infinity();
        for (const double pan : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
            const Heard heard = heardOf({.noise_gain = is_noise ? 0.6 : 0.0,
                                         .tone_gain = is_noise ? 0.0 : 0.4,
                                         .pan = pan});
            const double balance = rms(heard.left) / (rms(heard.right) + 1e-9);
            EXPECT_LT(balance, before) << pan;
            before = balance;
            if (pan == 0.0) {
                EXPECT_NEAR(balance, 1.0, 1e-3);
            }
            if (std::abs(pan) == 1.0) {
                EXPECT_GT(std::max(balance, 1.0 / balance), 4.0) << pan;
            }
        }
    }
}

TEST(SoundPlayer, TheNoiseIsBrighterWhenItIsFaster)
{
    double before = 0.0;
    for (const double pitch : {0.5, 1.0, 2.0}) {
        const double crossings_hz =
            pitchHz(heardOf({.noise_gain = 0.6, .noise_pitch = pitch}, 120).left);
        EXPECT_GT(crossings_hz, 1.3 * before);
        before = crossings_hz;
    }
}

TEST(SoundPlayer, NeverClicks)
{
    // However it is switched, moved and retuned, the signal is hardly steeper than the loudest,
    // highest tone on one side; a jump from the crest to zero would be five times as steep.
    const Heard loud = heardOf({.tone_gain = 0.4, .tone_hz = 880.0, .pan = 1.0});
    const double slope = steepest(loud.right);
    ASSERT_GT(loudest(loud.right), 5.0 * slope);
    SoundPlayer playing = player();
    double most = 0.0;
    double last = 0.0;
    for (int i = 0; i < 60; ++i) {
        playing.set({.tone_gain = i % 2 == 0 ? 0.4 : 0.0,
                     .tone_hz = i % 3 == 0 ? 880.0 : 440.0,
                     .pan = i % 4 < 2 ? -1.0 : 1.0});
        // Fractional frames, so that switching happens at all phases.
        std::vector<float> samples(2 * (kFrame + static_cast<std::size_t>(37 * i % 91)));
        playing.render(samples);
        for (std::size_t s = 1; s < samples.size(); s += 2) {
            const auto sample = static_cast<double>(samples[s]);
            most = std::max(most, std::abs(sample - last));
            last = sample;
        }
    }
    EXPECT_GT(most, 0.1 * slope); // the sound is on
    EXPECT_LT(most, 1.5 * slope);
}

TEST(SoundPlayer, TheLoudestIsNotClipped)
{
    const Heard heard = heardOf({.noise_gain = kNoiseGainMax,
                                 .noise_pitch = 2.0,
                                 .tone_gain = kToneGainMax,
                                 .tone_hz = 880.0,
                                 .pan = 1.0},
                                240);
    EXPECT_LT(loudest(heard.right), 1.0);
    EXPECT_LT(loudest(heard.left), 1.0);
}

TEST(SoundPlayer, ClampsValuesOutOfRangeAndIsSilentForInvalidOnes)
{
    constexpr double kHuge = std::numeric_limits<double>::max();
    const Heard loud = heardOf({.noise_gain = kHuge,
                                .noise_pitch = -kHuge,
                                .tone_gain = kHuge,
                                .tone_hz = kHuge,
                                .pan = kHuge});
    EXPECT_LT(loudest(loud.right), 1.0);
    EXPECT_GT(rms(loud.right), 0.05);
    for (double SoundState::*field :
         {&SoundState::noise_gain, &SoundState::noise_pitch, &SoundState::tone_gain,
          &SoundState::tone_hz, &SoundState::pan}) {
        SoundState state{.noise_gain = 0.6, .tone_gain = 0.4};
        state.*field = std::numeric_limits<double>::quiet_NaN();
        EXPECT_EQ(loudest(heardOf(state).left), 0.0);
    }
}

TEST(SoundPlayer, PlayersDoNotGetInEachOthersWay)
{
    SoundPlayer loud = player();
    SoundPlayer silent = player();
    loud.set({.tone_gain = 0.4});
    silent.set({});
    EXPECT_GT(rms(hear(loud, 30).left), 0.05);
    EXPECT_EQ(loudest(hear(silent, 30).left), 0.0);
    silent = std::move(loud);
    EXPECT_GT(rms(hear(silent, 30).left), 0.05);
    EXPECT_TRUE(silent.isConnected());
}

TEST(SoundPlayer, WithoutAnOutputReportsOneSentenceAndContinues)
{
    // If the machine has an output, it is opened and closed silently.
    const auto opened = SoundPlayer::open();
    if (!opened) {
        EXPECT_EQ(opened.error().code, ErrorCode::NotFound);
        EXPECT_TRUE(opened.error().message.starts_with("no audio output"));
        EXPECT_EQ(opened.error().message.find('\n'), std::string::npos);
    }
    EXPECT_TRUE(SoundPlayer::openLoopback());
}

TEST(SoundLoops, EndWhereTheyBegin)
{
    for (const std::vector<std::int16_t>& loop : {noiseLoop(), toneLoop()}) {
        int within = 0;
        double sum = 0.0;
        for (std::size_t i = 1; i < loop.size(); ++i) {
            within = std::max(within, std::abs(loop[i] - loop[i - 1]));
            sum += loop[i];
        }
        EXPECT_LE(std::abs(loop.front() - loop.back()), within);
        EXPECT_LT(std::abs(sum / static_cast<double>(loop.size())), 150.0); // no offset
    }
    // Whole periods of the tone: the sample after the last one would equal the first.
    const auto tone = toneLoop();
    EXPECT_EQ(tone.size() % 200, 0U);
    EXPECT_EQ(tone[0], tone[200]);
    EXPECT_DOUBLE_EQ(kLoopRateHz / 200.0, kLoopToneHz);
}

} // namespace
} // namespace marsview::test
