#include "haptics/sound/sound_player.h"

#include "core/base/check.h"
#include "haptics/sound/sound_loops.h"

#include <AL/al.h>
#include <AL/alc.h>
#include <AL/alext.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string_view>
#include <thread>
#include <utility>

namespace marsview {
namespace {

// OpenAL extensions. Debian's library has all of them.
struct Extensions {
    PFNALCSETTHREADCONTEXTPROC set_context = nullptr;
    PFNALCGETTHREADCONTEXTPROC context = nullptr;
    LPALCLOOPBACKOPENDEVICESOFT open_loopback = nullptr;
    LPALCRENDERSAMPLESSOFT render = nullptr;
};

template <typename F>
void find(F& function, const char* name)
{
    // OpenAL returns functions this way.
    function = reinterpret_cast<F>(alcGetProcAddress(nullptr, name));
}

const Extensions& extensions()
{
    static const Extensions kFound = [] {
        Extensions found;
        if (alcIsExtensionPresent(nullptr, "ALC_EXT_thread_local_context") != ALC_FALSE) {
            find(found.set_context, "alcSetThreadContext");
            find(found.context, "alcGetThreadContext");
        }
        if (alcIsExtensionPresent(nullptr, "ALC_SOFT_loopback") != ALC_FALSE) {
            find(found.open_loopback, "alcLoopbackOpenDeviceSOFT");
            find(found.render, "alcRenderSamplesSOFT");
        }
        return found;
    }();
    return kFound;
}

// OpenAL's calls use the current context. Ours is current during a call, and only on its thread, so
// that players do not interfere with each other.
class Current {
public:
    explicit Current(ALCcontext* context)
    {
        const Extensions& found = extensions();
        MARSVIEW_CHECK(found.context != nullptr && found.set_context != nullptr); // open() checks
        before_ = found.context();
        found.set_context(context);
    }
    ~Current() { extensions().set_context(before_); }
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;

private:
    ALCcontext* before_ = nullptr;
};

float bounded(double value, double low, double high)
{
    return static_cast<float>(std::clamp(value, low, high));
}

} // namespace

class SoundPlayer::Output {
public:
    static Result<SoundPlayer> playerOn(ALCdevice* device, const ALCint* attributes);

    Output(ALCdevice* device, ALCcontext* context)
        : device_(device)
        , context_(context)
    {}
    ~Output();
    Output(const Output&) = delete;
    Output& operator=(const Output&) = delete;

    bool start();
    void set(const SoundState& wanted);
    bool isConnected() const;
    void render(std::span<float> samples);

private:
    static constexpr ALsizei kLoops = 2; // noise and tone

    ALCdevice* device_;
    ALCcontext* context_;
    std::array<ALuint, kLoops> buffers_{};
    std::array<ALuint, kLoops> sources_{};
    bool is_heard_ = false;
    bool is_loopback_ = false;
};

Result<SoundPlayer> SoundPlayer::Output::playerOn(ALCdevice* device, const ALCint* attributes)
{
    ALCcontext* context = alcCreateContext(device, attributes);
    if (context == nullptr) {
        alcCloseDevice(device);
        return Error{ErrorCode::Unsupported,
                     "the audio output cannot be used; choose another one in the "
                     "system's settings"};
    }
    auto output = std::make_unique<Output>(device, context);
    output->is_loopback_ = attributes != nullptr;
    if (!output->start()) {
        return Error{ErrorCode::Unsupported,
                     "the audio output cannot play loops; choose another one in the "
                     "system's settings"};
    }
    return SoundPlayer(std::move(output));
}

bool SoundPlayer::Output::start()
{
    const Current current(context_);
    alGenBuffers(kLoops, buffers_.data());
    alGenSources(kLoops, sources_.data());
    const std::array loops{noiseLoop(), toneLoop()};
    for (std::size_t i = 0; i < loops.size(); ++i) {
        alBufferData(buffers_[i], AL_FORMAT_MONO16, loops[i].data(),
                     static_cast<ALsizei>(loops[i].size() * sizeof(std::int16_t)), kLoopRateHz);
        alSourcei(sources_[i], AL_BUFFER, static_cast<ALint>(buffers_[i]));
        alSourcei(sources_[i], AL_LOOPING, AL_TRUE);
        alSourcei(sources_[i], AL_SOURCE_RELATIVE, AL_TRUE);
        alSourcef(sources_[i], AL_ROLLOFF_FACTOR, 0.0F); // direction only, no distance
        alSourcef(sources_[i], AL_GAIN, 0.0F);
    }
    alSourcePlayv(kLoops, sources_.data());
    return alGetError() == AL_NO_ERROR;
}

SoundPlayer::Output::~Output()
{
    if (is_heard_) {
        set({});
        if (!is_loopback_) {
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
    }
    {
        const Current current(context_);
        alSourceStopv(kLoops, sources_.data());
        alDeleteSources(kLoops, sources_.data());
        alDeleteBuffers(kLoops, buffers_.data());
    }
    alcDestroyContext(context_);
    alcCloseDevice(device_);
}

void SoundPlayer::Output::set(const SoundState& wanted)
{
    const bool is_number = std::isfinite(wanted.noise_gain) && std::isfinite(wanted.noise_pitch) &&
                           std::isfinite(wanted.tone_gain) && std::isfinite(wanted.tone_hz) &&
                           std::isfinite(wanted.pan);
    const SoundState state = is_number ? wanted : SoundState{};
    const float noise_gain = bounded(state.noise_gain, 0.0, kNoiseGainMax);
    const float tone_gain = bounded(state.tone_gain, 0.0, kToneGainMax);
    // On the half circle in front of the listener, who looks along -z.
    const float x = bounded(state.pan, -1.0, 1.0);
    const float z = -std::sqrt(std::max(0.0F, 1.0F - x * x));

    const Current current(context_);
    alcSuspendContext(context_); // so that all changes take effect together
    const auto [noise, tone] = sources_;
    alSourcef(noise, AL_GAIN, noise_gain);
    alSourcef(tone, AL_GAIN, tone_gain);
    // Silent loops keep their pitch: a change would be audible while they fade.
    if (noise_gain > 0.0F) {
        alSourcef(noise, AL_PITCH, bounded(state.noise_pitch, 0.5, 2.0));
    }
    if (tone_gain > 0.0F) {
        alSourcef(tone, AL_PITCH,
                  bounded(state.tone_hz, kToneHzMin, kToneHzMax) / static_cast<float>(kLoopToneHz));
    }
    if (noise_gain > 0.0F || tone_gain > 0.0F) {
        alSource3f(noise, AL_POSITION, x, 0.0F, z);
        alSource3f(tone, AL_POSITION, x, 0.0F, z);
    }
    alcProcessContext(context_);
    is_heard_ = noise_gain > 0.0F || tone_gain > 0.0F;
}

bool SoundPlayer::Output::isConnected() const
{
    if (alcIsExtensionPresent(device_, "ALC_EXT_disconnect") == ALC_FALSE) {
        return true;
    }
    ALCint is_connected = ALC_TRUE;
    alcGetIntegerv(device_, ALC_CONNECTED, 1, &is_connected);
    return is_connected != ALC_FALSE;
}

void SoundPlayer::Output::render(std::span<float> samples)
{
    const Extensions& found = extensions();
    MARSVIEW_CHECK(is_loopback_ && found.render != nullptr && samples.size() % 2 == 0);
    found.render(device_, samples.data(), static_cast<ALCsizei>(samples.size() / 2));
}

Result<SoundPlayer> SoundPlayer::open()
{
    if (extensions().set_context == nullptr) {
        return Error{ErrorCode::Unsupported,
                     "this OpenAL has no thread-local contexts; install OpenAL Soft"};
    }
    ALCdevice* device = alcOpenDevice(nullptr);
    // The device that OpenAL opens without an output.
    constexpr std::string_view kNowhere = "No Output";
    if (device != nullptr && alcIsExtensionPresent(nullptr, "ALC_ENUMERATE_ALL_EXT") != ALC_FALSE &&
        alcGetString(device, ALC_ALL_DEVICES_SPECIFIER) == kNowhere) {
        alcCloseDevice(device);
        device = nullptr;
    }
    if (device == nullptr) {
        return Error{ErrorCode::NotFound,
                     "no audio output can be opened; connect one, or close the program that "
                     "uses it, and switch sound on again"};
    }
    return Output::playerOn(device, nullptr);
}

Result<SoundPlayer> SoundPlayer::openLoopback(int rate_hz)
{
    MARSVIEW_CHECK(rate_hz >= 8000 && rate_hz <= 192000);
    if (extensions().set_context == nullptr || extensions().open_loopback == nullptr) {
        return Error{ErrorCode::Unsupported,
                     "this OpenAL cannot play into memory; install OpenAL Soft"};
    }
    ALCdevice* device = extensions().open_loopback(nullptr);
    if (device == nullptr) {
        return Error{ErrorCode::Unsupported, "OpenAL cannot play into memory"};
    }
    const std::array<ALCint, 9> attributes{ALC_FREQUENCY,
                                           rate_hz,
                                           ALC_FORMAT_CHANNELS_SOFT,
                                           ALC_STEREO_SOFT,
                                           ALC_FORMAT_TYPE_SOFT,
                                           ALC_FLOAT_SOFT,
                                           ALC_HRTF_SOFT,
                                           ALC_FALSE,
                                           0};
    return Output::playerOn(device, attributes.data());
}

SoundPlayer::SoundPlayer(std::unique_ptr<Output> output)
    : output_(std::move(output))
{}

SoundPlayer::~SoundPlayer() = default;
SoundPlayer::SoundPlayer(SoundPlayer&&) noexcept = default;
SoundPlayer& SoundPlayer::operator=(SoundPlayer&&) noexcept = default;

void SoundPlayer::set(const SoundState& state)
{
    output_->set(state);
}

bool SoundPlayer::isConnected() const
{
    return output_->isConnected();
}

void SoundPlayer::render(std::span<float> samples)
{
    output_->render(samples);
}

} // namespace marsview
