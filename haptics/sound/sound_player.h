// Plays what a contact sounds like, through OpenAL.
#pragma once

#include "core/base/result.h"
#include "haptics/sound/contact_sound.h"

#include <memory>
#include <span>
#include <string>

namespace marsview {

/// Two loops, a noise and a tone, which OpenAL mixes and pans; they play from the beginning to the
/// end of this object, mostly silently. For one thread, which is not the servo's: a call takes
/// microseconds, but OpenAL may lock. Movable.
class SoundPlayer {
public:
    /// On the system's output. NotFound, with one sentence, where there is none or it is taken;
    /// finding that out may take a second, and libraries below may write to standard error.
    static Result<SoundPlayer> open();
    /// On none: what would be played is asked for by render(). `rate_hz` is 8000 to 192000.
    static Result<SoundPlayer> openLoopback(int rate_hz = 48000);

    /// Fades out, within some 50 ms.
    ~SoundPlayer();
    SoundPlayer(SoundPlayer&& other) noexcept;
    SoundPlayer& operator=(SoundPlayer&& other) noexcept;
    SoundPlayer(const SoundPlayer&) = delete;
    SoundPlayer& operator=(const SoundPlayer&) = delete;

    /// From now on, without clicks: volumes go over within the 10 to 50 ms that an output mixes at
    /// a time. Call it some sixty times a second. What is out of bounds is clamped, and what is no
    /// number is silent.
    void set(const SoundState& state);
    /// False for good once the output has been unplugged: open anew.
    bool isConnected() const;

    /// Of openLoopback() only: the next samples, left and right in turns, -1 to 1.
    void render(std::span<float> samples);

private:
    class Output;

    explicit SoundPlayer(std::unique_ptr<Output> output);

    std::unique_ptr<Output> output_;
};

} // namespace marsview
