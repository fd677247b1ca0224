// The result type of every contact model.
#pragma once

#include "core/geo/frames.h"

#include <array>
#include <cstdint>

namespace marsview {

/// The kind of surface feature that the proxy rests on.
enum class ContactFeature : std::uint8_t { Free, Vertex, Edge, Face };

/// The cost of one update.
struct ContactCounters {
    std::uint32_t vertices = 0;  // visited
    std::uint32_t faces = 0;     // walked: the goal was projected onto them
    std::uint32_t casts = 0;     // segments cast through free space
    std::uint32_t cells = 0;     // grid cells visited by casts
    std::uint32_t far_edges = 0; // far-edge crossings
    std::uint32_t far_loops = 0; // far-edge crossings that the list ended as loops
    /// 1 if the step limit ended the update before a minimum was found. The proxy is then on the
    /// surface and the next update continues from there.
    std::uint32_t cut_short = 0;
    std::uint32_t refused = 0; // 1 if the goal cannot be aimed at: the proxy stays
};

/// The state after one update.
struct ContactState {
    ScenePoint proxy;
    bool is_in_contact = false;
    ContactFeature feature = ContactFeature::Free;
    ContactCounters counters;
};

} // namespace marsview
