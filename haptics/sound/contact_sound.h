// What a contact sounds like.
#pragma once

namespace marsview {

/// A contact as an ear may tell it from another. Lengths and speeds are those of the hand, in its
/// workspace, so that a map sounds alike at every zoom.
struct ContactFeel {
    bool is_in_contact = false;
    double force_n = 0.0;       // that presses, or would on a device that can push
    double speed_m_per_s = 0.0; // of the proxy along the ground
    double roughness_rad = 0.0; // how much the ground's normal turns along the way
    double height_share = 0.0;  // of the ground: 0 the lowest of the map, 1 the highest
    double across = 0.0;        // -1 the left end of what the hand reaches, 1 the right end
};

/// What is to be heard: a tone for the force, and a hiss for the texture that is slid over.
struct SoundState {
    double noise_gain = 0.0;  // 0 to kNoiseGainMax
    double noise_pitch = 1.0; // how fast the noise is played: 0.5 to 2
    double tone_gain = 0.0;   // 0 to kToneGainMax
    double tone_hz = 220.0;   // kToneHzMin to kToneHzMax
    double pan = 0.0;         // -1 left to 1 right

    constexpr bool operator==(const SoundState&) const = default;
};

/// Both together are not clipped.
inline constexpr double kNoiseGainMax = 0.6;
inline constexpr double kToneGainMax = 0.4;
/// Three octaves, which small loudspeakers play and old ears hear: two of force, one of height.
inline constexpr double kToneHzMin = 110.0;
inline constexpr double kToneHzMax = 880.0;

/// Silent without contact, and nearly so where it begins: all gains rise from 0 with the force.
/// The harder the press, the higher and the louder the tone: its pitch rises by two octaves. The
/// rougher the ground and the faster the slide, the louder and the brighter the noise. The ground's
/// height moves the tone by one octave besides, since who cannot see the map has no other way to
/// tell a peak from a pit where both are pressed alike; which of them has changed is told by the
/// loudness, which follows the force alone. Continuous in all but is_in_contact, within the bounds
/// of SoundState for any input; silent where one is no number.
SoundState contactSound(const ContactFeel& feel) noexcept;

} // namespace marsview
