// Plays contact sounds through OpenAL.
#pragma once

#include "core/base/result.h"
#include "haptics/sound/contact_sound.h"

#include <memory>
#include <span>
#include <string>

namespace marsview {

/// Two loops, noise and tone, which OpenAL mixes and pans; they play during the whole lifetime of
/// this object, mostly silently. For one thread other than the servo thread: a call takes
/// microseconds, but OpenAL may lock. Movable.
class SoundPlayer {
public:
    /// Opens the system's output. NotFound, with one sentence, if there is none or it is in use;
    /// that may take a second, and libraries below may write to standard error.
    static Result<SoundPlayer> open();
    /// Without an output device: render() returns the samples. `rate_hz` is 8000 to 192000.
    static Result<SoundPlayer> openLoopback(int rate_hz = 48000);

    /// Fades out within about 50 ms.
    ~SoundPlayer();
    SoundPlayer(SoundPlayer&& other) noexcept;
    SoundPlayer& operator=(SoundPlayer&& other) noexcept;
    SoundPlayer(const SoundPlayer&) = delete;
    SoundPlayer& operator=(const SoundPlayer&) = delete;

    /// Changes the sound without clicks: volumes are interpolated over one output block of 10 to 50
    /// ms. Call it about sixty times a second. Out-of-range values are clamped, and NaN is silent.
    void set(const SoundState& state);
    /// False permanently once the output has been unplugged: open a new player.
    bool isConnected() const;

    /// Only after openLoopback(): the next samples, left and right interleaved, -1 to 1.
    void render(std::span<float> samples);

private:
    class Output;

    explicit SoundPlayer(std::unique_ptr<Output> output);

    std::unique_ptr<Output> output_;
};

} // namespace marsview
