// A small value that one thread writes and other threads read; the writer never waits.
#pragma once

#include "haptics/sync/prefetch.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <type_traits>

namespace marsview {

/// The writer is wait-free; a reader that overlaps a write retries. The value is stored in atomic
/// words: reading during a write is defined behavior, is detected, and the result is discarded.
/// Every word is stored with release and loaded with acquire, so that a reader that sees a word of
/// a write also sees, in its second check, the sequence number with which that write began (H.-J.
/// Boehm, Can seqlocks get along with programming language memory models?, MSPC 2012). Fences would
/// also work, but thread sanitizers do not support them.
template <typename T>
class SeqLock {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    explicit SeqLock(const T& initial = T{}) noexcept { write(initial); }
    SeqLock(const SeqLock&) = delete;
    SeqLock& operator=(const SeqLock&) = delete;

    /// One thread at a time.
    void write(const T& value) noexcept
    {
        std::array<Word, kWords> words{};
        std::memcpy(words.data(), &value, sizeof(T));
        const std::uint64_t number = number_.load(std::memory_order_relaxed);
        number_.store(number + 1, std::memory_order_relaxed); // odd: being written
        for (std::size_t i = 0; i < kWords; ++i) {
            words_[i].store(words[i], std::memory_order_release);
        }
        number_.store(number + 2, std::memory_order_release);
    }

    /// The writing thread: shortly before write().
    void prefetch() const noexcept { prefetchForWriting(this, sizeof *this); }

    /// Empty if a write overlapped the read. Any thread; wait-free.
    std::optional<T> tryRead() const noexcept
    {
        std::array<Word, kWords> words;
        const std::uint64_t number = number_.load(std::memory_order_acquire);
        for (std::size_t i = 0; i < kWords; ++i) {
            words[i] = words_[i].load(std::memory_order_acquire);
        }
        if (number % 2 != 0 || number_.load(std::memory_order_relaxed) != number) {
            return std::nullopt;
        }
        T value;
        std::memcpy(static_cast<void*>(&value), words.data(), sizeof(T));
        return value;
    }
    /// The latest complete value; retries while a write is in progress. Any thread that may wait.
    T read() const noexcept
    {
        while (true) {
            if (const auto value = tryRead()) {
                return *value;
            }
        }
    }

private:
    using Word = std::uint64_t;
    static constexpr std::size_t kWords = (sizeof(T) + sizeof(Word) - 1) / sizeof(Word);

    std::atomic<std::uint64_t> number_{0};
    std::array<std::atomic<Word>, kWords> words_{};
};

} // namespace marsview
