// Hands the latest of many values from one thread to another, without either ever waiting.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace marsview {

/// One writer, one reader, and three values: the one being written, the one being read, and the
/// latest that was published. What the reader did not get around to see is skipped. Both sides are
/// wait-free: an exchange of a byte.
///
/// The values stay where they are and are never copied: the reader's is its own until it takes the
/// next one, and only the writer overwrites, and thus frees, what the reader has left.
template <typename T>
class TripleBuffer {
public:
    TripleBuffer() = default;
    /// The values that reader and writer begin with.
    explicit TripleBuffer(const T& initial)
        : values_{initial, initial, initial}
    {}
    TripleBuffer(const TripleBuffer&) = delete;
    TripleBuffer& operator=(const TripleBuffer&) = delete;

    /// The writer's, to be filled; holds some value of before.
    T& back() noexcept { return values_[back_]; }
    /// The writer's: what is in back() is the latest from now on.
    void publish() noexcept
    {
        const auto mine = static_cast<std::uint8_t>(back_ | kIsNew);
        back_ = latest_.exchange(mine, std::memory_order_acq_rel) & kIndex;
    }
    /// The writer's: whether the reader has taken, or may be about to take, what was published.
    bool isTaken() const noexcept
    {
        return (latest_.load(std::memory_order_acquire) & kIsNew) == 0;
    }

    /// The reader's: goes on to the latest value. False where that is the one it has.
    bool take() noexcept
    {
        if ((latest_.load(std::memory_order_relaxed) & kIsNew) == 0) {
            return false;
        }
        front_ = latest_.exchange(front_, std::memory_order_acq_rel) & kIndex;
        return true;
    }
    /// The reader's; stays as it is until take() returns true.
    const T& front() const noexcept { return values_[front_]; }

private:
    static constexpr std::uint8_t kIndex = 3;
    static constexpr std::uint8_t kIsNew = 4;
    static constexpr std::size_t kCacheLine = 64; // lest the two sides' indices share one

    std::array<T, 3> values_{};
    alignas(kCacheLine) std::uint8_t back_ = 0;
    alignas(kCacheLine) std::atomic<std::uint8_t> latest_{1};
    alignas(kCacheLine) std::uint8_t front_ = 2;
};

} // namespace marsview
