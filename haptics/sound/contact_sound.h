// Maps a contact to sound.
#pragma once

namespace marsview {

/// The audible properties of a contact. Lengths and speeds are in the workspace, so that a map
/// sounds the same at every zoom.
struct ContactFeel {
    bool is_in_contact = false;
    double force_n = 0.0;       // pressing force; also computed for devices without force output
    double speed_m_per_s = 0.0; // of the proxy along the surface
    double roughness_rad = 0.0; // change of the surface normal along the path
    double height_share = 0.0;  // of the surface: 0 the lowest of the map, 1 the highest
    double across = 0.0;        // -1 left end of the reach, 1 right end
};

/// The sound to play: a tone for the force, and noise for the texture under a slide.
struct SoundState {
    double noise_gain = 0.0;  // 0 to kNoiseGainMax
    double noise_pitch = 1.0; // playback speed of the noise: 0.5 to 2
    double tone_gain = 0.0;   // 0 to kToneGainMax
    double tone_hz = 220.0;   // kToneHzMin to kToneHzMax
    double pan = 0.0;         // -1 left to 1 right

    constexpr bool operator==(const SoundState&) const = default;
};

/// The sum of both gains does not clip.
inline constexpr double kNoiseGainMax = 0.6;
inline constexpr double kToneGainMax = 0.4;
/// Three octaves, within the range of small loudspeakers and of older listeners: two for the force,
/// one for the height.
inline constexpr double kToneHzMin = 110.0;
inline constexpr double kToneHzMax = 880.0;

/// Silent without contact, and nearly so where contact begins: all gains rise from 0 with the
/// force. Higher force raises the tone's pitch, by up to two octaves, and its loudness. Roughness
/// and speed raise the loudness and the brightness of the noise. The surface height shifts the tone
/// by one octave in addition, since a listener who cannot see the map cannot otherwise distinguish
/// a peak from a pit pressed with the same force; the loudness, which depends only on the force,
/// shows which of the two has changed. Continuous in all inputs except is_in_contact, within the
/// bounds of SoundState for any input; silent if an input is NaN.
SoundState contactSound(const ContactFeel& feel) noexcept;

} // namespace marsview
