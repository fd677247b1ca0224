// Data exchanged between the servo thread and the streamer of its window.
#pragma once

#include "haptics/sync/seq_lock.h"
#include "haptics/sync/triple_buffer.h"
#include "haptics/terrain/clipmap.h"
#include "haptics/terrain/hand_motion.h"

#include <atomic>
#include <cstdint>
#include <memory>

namespace marsview {

struct ClipmapExchange {
    explicit ClipmapExchange(const std::shared_ptr<const Clipmap>& window)
        : windows(window)
    {}

    SeqLock<HandMotion> motion;                           // the servo writes
    TripleBuffer<std::shared_ptr<const Clipmap>> windows; // the servo reads
    /// The streamer's last round, ns of the steady clock; 0: never. If it stops, the servo's window
    /// may be outdated.
    std::atomic<std::int64_t> fed_ns{0};
};

} // namespace marsview
