// What is told of recordings and diagnostic logs once they are written.
#pragma once

#include <QString>

#include <cstddef>

namespace marsview {

/// Why a recording came to its end: a file holds what was touched of one map.
enum class RecordingEnd { AsWanted, WithItsMap };

/// A flight record that has been written.
struct SavedTicks {
    QString file;
    std::size_t count = 0;
    double seconds = 0.0; // that they cover, without pauses between them
};

} // namespace marsview
