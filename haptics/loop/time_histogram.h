// A histogram of durations that does not allocate.
#pragma once

#include <array>
#include <bit>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace marsview {

/// Counts durations in buckets whose width is 1/32 of their value, from 1 ns to 18 minutes; values
/// outside that range are clamped. 9 KB; one thread at a time, including the servo thread.
class TimeHistogram {
public:
    using Span = std::chrono::nanoseconds;

    void record(Span span) noexcept
    {
        const auto ns = span.count() < 0 ? 0U : static_cast<std::uint64_t>(span.count());
        ++counts_[bucketOf(ns)];
        ++count_;
        addToSum(span.count() < 0 ? Span{0} : span);
        maximum_ = span > maximum_ ? span : maximum_;
    }
    void merge(const TimeHistogram& other) noexcept
    {
        for (std::size_t i = 0; i < counts_.size(); ++i) {
            counts_[i] += other.counts_[i];
        }
        count_ += other.count_;
        addToSum(other.sum_);
        maximum_ = other.maximum_ > maximum_ ? other.maximum_ : maximum_;
    }

    /// The durations recorded after `earlier`, a previous copy of this histogram. The maximum is
    /// that of a bucket.
    TimeHistogram since(const TimeHistogram& earlier) const noexcept
    {
        TimeHistogram result;
        for (std::size_t i = 0; i < counts_.size(); ++i) {
            result.counts_[i] = counts_[i] - earlier.counts_[i];
            if (result.counts_[i] > 0) {
                const Span end{static_cast<Span::rep>(endOf(i))};
                result.maximum_ = end < maximum_ ? end : maximum_;
            }
        }
        result.count_ = count_ - earlier.count_;
        result.sum_ = sum_ - earlier.sum_;
        return result;
    }

    std::uint64_t count() const noexcept { return count_; }
    /// Exact; 0 if nothing was recorded.
    Span maximum() const noexcept { return maximum_; }
    double meanNanoseconds() const noexcept
    {
        return count_ == 0 ? 0.0 : static_cast<double>(sum_.count()) / static_cast<double>(count_);
    }
    /// An upper bound for `share` of the durations, in [0, 1]: at most 1/32 above the longest of
    /// them, and never above the maximum.
    Span quantile(double share) const noexcept
    {
        const double wanted = share * static_cast<double>(count_);
        std::uint64_t below = 0;
        for (std::size_t i = 0; i < counts_.size(); ++i) {
            below += counts_[i];
            if (below > 0 && static_cast<double>(below) >= wanted) {
                const auto end = static_cast<Span::rep>(endOf(i));
                return Span{end} < maximum_ ? Span{end} : maximum_;
            }
        }
        return maximum_;
    }

    /// Calls `take(end, count)` for each bucket that is not empty, in order; `end` is the longest
    /// duration in the bucket.
    template <typename F>
    void visit(const F& take) const
    {
        for (std::size_t i = 0; i < counts_.size(); ++i) {
            if (counts_[i] > 0) {
                take(Span{static_cast<Span::rep>(endOf(i))}, counts_[i]);
            }
        }
    }

private:
    // Stays at the longest duration that can be represented.
    void addToSum(Span span) noexcept
    {
        sum_ = span > Span::max() - sum_ ? Span::max() : sum_ + span;
    }

    static constexpr unsigned kBits = 5; // of the mantissa
    static constexpr std::uint64_t kParts = 1U << kBits;
    static constexpr unsigned kExponentMax = 40;

    static constexpr std::size_t bucketOf(std::uint64_t ns) noexcept
    {
        if (ns < kParts) {
            return static_cast<std::size_t>(ns);
        }
        const auto exponent = static_cast<unsigned>(std::bit_width(ns)) - 1;
        if (exponent >= kExponentMax) {
            return kBuckets - 1;
        }
        const unsigned shift = exponent - kBits;
        return static_cast<std::size_t>((shift + 1) * kParts + ((ns >> shift) - kParts));
    }
    // The longest duration in a bucket.
    static constexpr std::uint64_t endOf(std::size_t bucket) noexcept
    {
        if (bucket < kParts) {
            return bucket;
        }
        const auto shift = static_cast<unsigned>(bucket / kParts) - 1;
        return ((kParts + bucket % kParts + 1) << shift) - 1;
    }

    static constexpr std::size_t kBuckets = (kExponentMax - kBits + 1) * kParts;

    std::array<std::uint64_t, kBuckets> counts_{};
    std::uint64_t count_ = 0;
    Span sum_{0};
    Span maximum_{0};
};

} // namespace marsview
