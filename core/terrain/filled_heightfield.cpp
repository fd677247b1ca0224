#include "core/terrain/filled_heightfield.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace marsview {
namespace {

std::uint64_t rawBits(const SampleGrid& samples, std::size_t column, std::size_t row)
{
    return samples.visit([&](auto view) {
        const auto raw = view(column, row);
        std::uint64_t bits = 0;
        std::memcpy(&bits, &raw, sizeof(raw));
        return bits;
    });
}

} // namespace

Result<FilledHeightfield> FilledHeightfield::build(const Heightfield& heightfield,
                                                   std::shared_ptr<const SurfaceAnalysis> analysis,
                                                   JobMonitor& monitor)
{
    MARSVIEW_CHECK(analysis != nullptr);
    FilledHeightfield filled(heightfield, std::move(analysis));
    if (heightfield.samples().hasVoids() && !filled.buildMaxima(monitor)) {
        return Error{ErrorCode::Canceled, "canceled"};
    }
    monitor.report(1.0);
    return filled;
}

float FilledHeightfield::fillAt(std::size_t column, std::size_t row) const noexcept
{
    return range_.clamped(analysis_->means.filled(column, row));
}

// A fill may be higher than the measured samples nearby, and a cast must not pass through it.
bool FilledHeightfield::buildMaxima(JobMonitor& monitor)
{
    const MinMaxPyramid& pyramid = analysis_->bounds;
    std::vector<float> maxima(pyramid.columns(0) * pyramid.rows(0));
    const std::size_t blocks = pyramid.columns(0);
    bool has_common_bits = true;
    for (std::size_t row = 0; row < pyramid.rows(0); ++row) {
        if (monitor.isCanceled()) {
            return false;
        }
        monitor.report(static_cast<double>(row) / static_cast<double>(pyramid.rows(0)));
        for (std::size_t column = 0; column < blocks; ++column) {
            const MinMaxPyramid::Bounds bounds = pyramid.bounds(0, column, row);
            float maximum =
                bounds.isEmpty() ? std::numeric_limits<float>::lowest() : bounds.maximum_m;
            constexpr std::size_t kBlock = MinMaxPyramid::kBlock;
            for (std::size_t r = row * kBlock; r <= std::min((row + 1) * kBlock, rows() - 1); ++r) {
                for (std::size_t c = column * kBlock;
                     c <= std::min((column + 1) * kBlock, columns() - 1); ++c) {
                    if (isVoid(c, r)) {
                        maximum = std::max(maximum, fillAt(c, r));
                        const std::uint64_t bits = rawBits(heightfield_.samples(), c, r);
                        has_common_bits = has_common_bits && void_bits_.value_or(bits) == bits;
                        void_bits_ = bits;
                    }
                }
            }
            maxima[row * blocks + column] = maximum;
        }
    }
    if (!has_common_bits) {
        void_bits_.reset();
    }
    maxima_ = maximaFrom(std::move(maxima), pyramid);
    return true;
}

std::vector<std::vector<float>> FilledHeightfield::maximaFrom(std::vector<float> blocks_m,
                                                              const MinMaxPyramid& pyramid)
{
    std::vector<std::vector<float>> maxima;
    maxima.push_back(std::move(blocks_m));
    for (std::size_t level = 1; level < pyramid.levelCount(); ++level) {
        const std::size_t width = pyramid.columns(level);
        const std::size_t finer_width = pyramid.columns(level - 1);
        const std::vector<float>& finer = maxima.back();
        std::vector<float> coarser(width * pyramid.rows(level),
                                   std::numeric_limits<float>::lowest());
        for (std::size_t row = 0; row < pyramid.rows(level - 1); ++row) {
            for (std::size_t column = 0; column < finer_width; ++column) {
                float& maximum = coarser[(row / 2) * width + column / 2];
                maximum = std::max(maximum, finer[row * finer_width + column]);
            }
        }
        maxima.push_back(std::move(coarser));
    }
    return maxima;
}

} // namespace marsview
