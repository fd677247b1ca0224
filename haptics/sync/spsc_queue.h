// Passes values from one thread to another, in order; neither thread waits.
#pragma once

#include "haptics/sync/prefetch.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <type_traits>

namespace marsview {

/// One producer thread, one consumer thread. A value that does not fit is not stored, and put()
/// returns false. Memory is allocated only in the constructor. `Capacity` is a power of two.
template <typename T, std::size_t Capacity>
class SpscQueue {
    static_assert(std::is_trivially_copyable_v<T>);
    static_assert(Capacity > 0 && (Capacity & (Capacity - 1)) == 0);

public:
    SpscQueue()
        : values_(std::make_unique<std::array<T, Capacity>>())
    {}
    SpscQueue(const SpscQueue&) = delete;
    SpscQueue& operator=(const SpscQueue&) = delete;

    /// The storage, for callers that lock memory: `bytes` at data().
    const void* data() const noexcept { return values_.get(); }
    static constexpr std::size_t bytes() noexcept { return sizeof(std::array<T, Capacity>); }

    /// Producer thread. False if the queue is full.
    bool put(const T& value) noexcept
    {
        const std::size_t end = end_.load(std::memory_order_relaxed);
        if (end - begin_.load(std::memory_order_acquire) == Capacity) {
            return false;
        }
        (*values_)[end % Capacity] = value;
        end_.store(end + 1, std::memory_order_release);
        return true;
    }
    /// Producer thread: shortly before put().
    void prefetchNext() const noexcept
    {
        const std::size_t end = end_.load(std::memory_order_relaxed);
        prefetchForWriting(&(*values_)[end % Capacity], sizeof(T));
    }
    /// Producer thread: a lower bound of the number of values that can be put.
    std::size_t room() const noexcept
    {
        return Capacity -
               (end_.load(std::memory_order_relaxed) - begin_.load(std::memory_order_acquire));
    }
    /// Consumer thread. False if the queue is empty.
    bool take(T& value) noexcept
    {
        const std::size_t begin = begin_.load(std::memory_order_relaxed);
        if (begin == end_.load(std::memory_order_acquire)) {
            return false;
        }
        value = (*values_)[begin % Capacity];
        begin_.store(begin + 1, std::memory_order_release);
        return true;
    }

private:
    static constexpr std::size_t kCacheLine = 64; // keeps the two sides' indices on separate lines

    std::unique_ptr<std::array<T, Capacity>> values_;
    alignas(kCacheLine) std::atomic<std::size_t> begin_{0};
    alignas(kCacheLine) std::atomic<std::size_t> end_{0};
};

} // namespace marsview
