#include "core/feather/feathered_map.h"

#include "core/base/parallel.h"
#include "core/feather/feathered_tiles.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace marsview {
namespace {

constexpr double kBandShare = 0.6; // of the time

template <typename T>
void fillRow(const Heightfield& heightfield,
             const FeatherBand& band,
             std::size_t row,
             SampleGrid& samples)
{
    const SampleGrid& own = heightfield.samples();
    const ElevationScale& scale = heightfield.scale();
    const auto put = [to = samples.rowData(row)](std::size_t column, T raw) {
        std::memcpy(to + column * sizeof raw, &raw, sizeof raw);
    };
    for (std::size_t column = 0; column < own.columns(); ++column) {
        put(column, own.isVoid(column, row) ? std::numeric_limits<T>::quiet_NaN()
                                            : static_cast<T>(own.raw(column, row)));
    }
    constexpr std::size_t side = FeatherBand::kSide;
    for (std::size_t i = 0; i * side < own.columns(); ++i) {
        const FeatherBand::Square* square = band.square(i, row / side);
        if (square == nullptr) {
            continue;
        }
        const auto first = static_cast<std::uint16_t>(row % side * side);
        const auto begin = std::lower_bound(square->places.begin(), square->places.end(), first);
        for (auto place = begin; place != square->places.end() && *place / side == row % side;
             ++place) {
            const auto height_m = static_cast<double>(
                square->heights_m[static_cast<std::size_t>(place - square->places.begin())]);
            put(i * side + *place % side, static_cast<T>(rawOf(height_m, scale, samples.type())));
        }
    }
}

Result<SampleGrid> samplesWith(const Heightfield& heightfield, const FeatherBand& band)
{
    const SampleType type = floatTypeFor(heightfield.samples().type());
    Result<SampleGrid> samples =
        SampleGrid::create(type, heightfield.columns(), heightfield.rows());
    if (!samples) {
        return samples;
    }
    constexpr std::size_t kRowsAtOnce = 64;
    parallelRanges(heightfield.rows(), kRowsAtOnce, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row) {
            type == SampleType::Float32 ? fillRow<float>(heightfield, band, row, *samples)
                                        : fillRow<double>(heightfield, band, row, *samples);
        }
    });
    return samples;
}

Result<std::shared_ptr<const Map>>
inMemory(const Map& map, const FeatherBand& band, JobMonitor& monitor)
{
    const Heightfield& heightfield = map.heightfield();
    Result<SampleGrid> samples = samplesWith(heightfield, band);
    if (!samples) {
        return std::move(samples).error();
    }
    const SampleStatistics statistics = samples->applyRule({}, 0, samples->rows());
    return analyzeMap(
        {.spec = map.spec(),
         .file_info = map.fileInfo(),
         .info = map.info(),
         .statistics = statistics,
         .heightfield = Heightfield(std::make_shared<const SampleGrid>(std::move(*samples)),
                                    statistics, heightfield.scale()),
         .kind = map.kind()},
        monitor);
}

Result<std::shared_ptr<const Map>> inTiles(const Map& map, FeatherBand found, std::size_t cells)
{
    const Heightfield& heightfield = map.heightfield();
    const TiledRaster& raster = heightfield.tiles()->raster();
    const auto band = std::make_shared<const FeatherBand>(std::move(found));
    auto levels = std::make_shared<const MapLevels>(
        featheredLevels(*map.levels(), *band, cells, heightfield.scale()));
    auto tiles =
        TiledSamples::open(raster.with(featheredTiles(raster.source(), band, heightfield.scale())));
    if (!tiles) {
        return std::move(tiles).error();
    }
    const SampleStatistics statistics = levels->statistics;
    return tiledMap(
        {.spec = map.spec(),
         .file_info = map.fileInfo(),
         .info = map.info(),
         .statistics = statistics,
         .heightfield = Heightfield(std::move(tiles).value(), statistics, heightfield.scale()),
         .kind = map.kind()},
        std::move(levels));
}

} // namespace

Result<std::shared_ptr<const Map>> featheredMap(const BodyTerrain& map,
                                                std::span<const BodyTerrain> below,
                                                std::size_t cells,
                                                JobMonitor& monitor)
{
    const std::shared_ptr<const Map>& own = map.map();
    if (own->isPreview()) {
        return own;
    }
    const auto named = [&own](const Error& error) {
        return Error{error.code, fmt::format("{}: {}", own->spec().path, error.message)};
    };
    Result<FeatherBand> band = [&] {
        const JobPart finding(monitor, 0.0, kBandShare);
        return FeatherBand::build(map, below, cells, monitor);
    }();
    if (!band) {
        return named(band.error());
    }
    if (band->size() == 0) {
        return own;
    }
    const JobPart analyzing(monitor, kBandShare, 1.0);
    auto blended = own->heightfield().isTiled() ? inTiles(*own, std::move(*band), cells)
                                                : inMemory(*own, *band, monitor);
    return blended ? blended : Result<std::shared_ptr<const Map>>(named(blended.error()));
}

} // namespace marsview
