// What every contact model answers.
#pragma once

#include "core/geo/frames.h"

#include <array>
#include <cstdint>

namespace marsview {

/// What of the surface the proxy rests on.
enum class ContactFeature : std::uint8_t { Free, Vertex, Edge, Face };

/// What one update cost.
struct ContactCounters {
    std::uint32_t vertices = 0;  // visited
    std::uint32_t faces = 0;     // walked: the goal was projected onto them
    std::uint32_t casts = 0;     // segments cast through free space
    std::uint32_t cells = 0;     // grid cells looked at by casts
    std::uint32_t far_edges = 0; // far-edge crossings
    std::uint32_t far_loops = 0; // far-edge crossings that the list ended as loops
    /// 1 where the bound on steps ended the update before a minimum was found. Then the proxy is
    /// on the surface and the next update goes on from there.
    std::uint32_t cut_short = 0;
    std::uint32_t refused = 0; // 1 where there is no aiming at the goal: the proxy stays
};

/// The end of one update.
struct ContactState {
    ScenePoint proxy;
    bool is_in_contact = false;
    ContactFeature feature = ContactFeature::Free;
    ContactCounters counters;
};

} // namespace marsview
