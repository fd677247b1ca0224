// Keeps the last seconds of a loop for later diagnosis.
#pragma once

#include "haptics/loop/loop_state.h"
#include "haptics/sync/page_lock.h"
#include "haptics/sync/seq_lock.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace marsview {

/// A preallocated ring of ticks. The servo thread adds without waiting; any other thread reads, and
/// skips ticks that are overwritten during the read.
class FlightRecorder {
public:
    explicit FlightRecorder(std::size_t ticks = 10'000)
        // One more than is kept, for the tick being written.
        : ring_(std::make_unique<SeqLock<TickRecord>[]>(ticks + 1)) // NOLINT(*-avoid-c-arrays)
        , size_(ticks)
    {}

    /// The storage.
    MemoryRange memory() const noexcept { return {ring_.get(), (size_ + 1) * sizeof(ring_[0])}; }

    /// Servo thread only.
    void add(const TickRecord& record) noexcept
    {
        const std::uint64_t number = count_.load(std::memory_order_relaxed);
        ring_[number % (size_ + 1)].write(record);
        count_.store(number + 1, std::memory_order_release);
    }

    /// Servo thread: shortly before add().
    void prefetchNext() const noexcept
    {
        ring_[count_.load(std::memory_order_relaxed) % (size_ + 1)].prefetch();
    }

    bool isEmpty() const noexcept { return count_.load(std::memory_order_acquire) == 0; }

    /// Any other thread. The oldest tick comes first. After a pause of the loop, tick numbers
    /// restart at 1.
    std::vector<TickRecord> records() const
    {
        const std::uint64_t end = count_.load(std::memory_order_acquire);
        const std::uint64_t begin = end > size_ ? end - size_ : 0;
        std::vector<TickRecord> result;
        result.reserve(static_cast<std::size_t>(end - begin));
        for (std::uint64_t i = begin; i < end; ++i) {
            const auto record = ring_[i % (size_ + 1)].tryRead();
            // After this many more ticks, a newer tick is being written to the same entry.
            if (record && count_.load(std::memory_order_acquire) < i + size_ + 1) {
                result.push_back(*record);
            }
        }
        return result;
    }

private:
    std::unique_ptr<SeqLock<TickRecord>[]> ring_; // NOLINT(modernize-avoid-c-arrays)
    std::size_t size_;
    std::atomic<std::uint64_t> count_{0};
};

} // namespace marsview
