// Messages about recordings and diagnostic logs once they are written.
#pragma once

#include <QString>

#include <cstddef>

namespace marsview {

/// Why a recording ended: a file records the touch on one map only.
enum class RecordingEnd { AsWanted, WithItsMap };

/// A diagnostic log that has been written.
struct SavedTicks {
    QString file;
    std::size_t count = 0;
    double seconds = 0.0; // that they cover, without pauses between them
};

} // namespace marsview
