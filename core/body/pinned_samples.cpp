#include "core/body/pinned_samples.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace marsview {

PinnedSamples::PinnedSamples(std::size_t columns, std::span<const Sample> samples)
    : columns_(columns)
    , size_(samples.size())
{
    if (!samples.empty()) {
        first_column_ = first_row_ = std::numeric_limits<std::size_t>::max();
    }
    for (const Sample& sample : samples) {
        first_column_ = std::min<std::size_t>(first_column_, sample.column);
        last_column_ = std::max<std::size_t>(last_column_, sample.column);
        first_row_ = std::min<std::size_t>(first_row_, sample.row);
        last_row_ = std::max<std::size_t>(last_row_, sample.row);
    }
    // At most half full, and less if a search would look at too many places.
    constexpr unsigned kBits = 64;
    for (auto bits = static_cast<unsigned>(std::bit_width(2 * samples.size() + 1));; ++bits) {
        shift_ = kBits - bits;
        places_.assign((std::size_t{1} << bits) + kRunMax, {});
        if (fill(samples)) {
            return;
        }
    }
}

bool PinnedSamples::fill(std::span<const Sample> samples)
{
    for (const Sample& sample : samples) {
        const std::uint64_t key = sample.row * columns_ + sample.column;
        std::size_t at = placeOf(key);
        const std::size_t end = at + kRunMax - 1; // an empty place is left before it
        while (places_[at].key != kNone) {
            if (++at == end) {
                return false;
            }
        }
        places_[at] = {key, sample.height_m};
    }
    // A search ends at an empty place.
    std::size_t run = 0;
    return std::all_of(places_.begin(), places_.end(), [&run](const Place& place) {
        run = place.key == kNone ? 0 : run + 1;
        return run < kRunMax;
    });
}

} // namespace marsview
