// Hands values from one thread to another, in order, without either ever waiting.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <type_traits>

namespace marsview {

/// One thread puts, one takes. What does not fit is not put, and said so. Memory is taken once,
/// when it is made. `Capacity` is a power of two.
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

    /// Where the values are kept, for whoever locks memory: bytes at data().
    const void* data() const noexcept { return values_.get(); }
    static constexpr std::size_t bytes() noexcept { return sizeof(std::array<T, Capacity>); }

    /// The putting thread's. False where the queue is full.
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
    /// The putting thread's: how many values can be put, at least.
    std::size_t room() const noexcept
    {
        return Capacity -
               (end_.load(std::memory_order_relaxed) - begin_.load(std::memory_order_acquire));
    }
    /// The taking thread's. False where it is empty.
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
    static constexpr std::size_t kCacheLine = 64; // lest the two sides' indices share one

    std::unique_ptr<std::array<T, Capacity>> values_;
    alignas(kCacheLine) std::atomic<std::size_t> begin_{0};
    alignas(kCacheLine) std::atomic<std::size_t> end_{0};
};

} // namespace marsview
