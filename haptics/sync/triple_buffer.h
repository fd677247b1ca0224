// Passes the latest of many values from one thread to another; neither thread waits.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace marsview {

/// One writer, one reader, and three values: the one being written, the one being read, and the
/// latest published one. Values that the reader did not take are skipped. Both sides are wait-free:
/// an exchange of one byte.
///
/// The values are never moved or copied: the reader keeps its value until it takes the next one,
/// and only the writer overwrites, and thus frees, a value that the reader has released.
template <typename T>
class TripleBuffer {
public:
    TripleBuffer() = default;
    /// The initial value for reader and writer.
    explicit TripleBuffer(const T& initial)
        : values_{initial, initial, initial}
    {}
    TripleBuffer(const TripleBuffer&) = delete;
    TripleBuffer& operator=(const TripleBuffer&) = delete;

    /// Writer: the value to fill in; it holds an older value.
    T& back() noexcept { return values_[back_]; }
    /// Writer: makes back() the latest value.
    void publish() noexcept
    {
        const auto mine = static_cast<std::uint8_t>(back_ | kIsNew);
        back_ = latest_.exchange(mine, std::memory_order_acq_rel) & kIndex;
    }
    /// Writer: whether the reader has taken, or may be about to take, the published value.
    bool isTaken() const noexcept
    {
        return (latest_.load(std::memory_order_acquire) & kIsNew) == 0;
    }

    /// Reader: switches to the latest value. False if it already has it.
    bool take() noexcept
    {
        if ((latest_.load(std::memory_order_relaxed) & kIsNew) == 0) {
            return false;
        }
        front_ = latest_.exchange(front_, std::memory_order_acq_rel) & kIndex;
        return true;
    }
    /// Reader: unchanged until take() returns true.
    const T& front() const noexcept { return values_[front_]; }

private:
    static constexpr std::uint8_t kIndex = 3;
    static constexpr std::uint8_t kIsNew = 4;
    static constexpr std::size_t kCacheLine = 64; // keeps the two sides' indices on separate lines

    std::array<T, 3> values_{};
    alignas(kCacheLine) std::uint8_t back_ = 0;
    alignas(kCacheLine) std::atomic<std::uint8_t> latest_{1};
    alignas(kCacheLine) std::uint8_t front_ = 2;
};

} // namespace marsview
