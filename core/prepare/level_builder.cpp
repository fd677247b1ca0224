// Two passes over the tiles of level 0. The first finds everything except errors, and stores the
// data of other tiles that the second needs: the first row of each row of tiles, and every 64th
// sample of every 64th row, which are the vertices of levels coarser than a block. The second
// compares every sample with every level, tile by tile; the tile to the right is read ahead for its
// first column.

#include "core/prepare/level_builder.h"

#include "core/base/check.h"
#include "core/prepare/checkpoints.h"
#include "core/prepare/disk_room.h"
#include "core/prepare/level_errors.h"
#include "core/prepare/level_file_writer.h"
#include "core/prepare/level_survey.h"
#include "core/prepare/tile_rows.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fmt/format.h>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace marsview {
namespace {

// Measured fractions of the total time.
constexpr double kSurveyShare = 0.3;
constexpr double kErrorsShare = 0.67;

std::vector<std::uint64_t> indexOf(const std::vector<FilePart>& parts)
{
    std::vector<std::uint64_t> rows;
    for (const FilePart& part : parts) {
        rows.push_back(part.offset);
    }
    for (const FilePart& part : parts) {
        rows.push_back(part.bytes);
    }
    for (const FilePart& part : parts) {
        rows.push_back(part.checksum);
    }
    return rows;
}

// Identifies a build, so that it can be resumed only with the same source and settings.
std::string subjectOf(const LevelBuild& build)
{
    const LevelFileHeader header{.key = build.key,
                                 .layout = build.source->layout(),
                                 .statistics = {},
                                 .scale = build.scale,
                                 .planes = {}};
    constexpr int kStateVersion = 2; // of checkpoints
    return fmt::format("level file {}, state {}, at most {} means\n{}", kLevelFileVersion,
                       kStateVersion, build.mean_blocks_max, writtenHeader(header));
}

// In this order.
enum class BuildStage : std::uint8_t { Survey, Means, Errors };

// These blocks may be larger than those of the survey.
BlockGrid blocksOf(const LevelSurvey& survey, std::size_t block_samples)
{
    BlockGrid blocks = survey.blocks;
    for (BlockExtent extent = survey.kept; extent.block_samples < block_samples;
         extent = extent.coarser()) {
        blocks = reduced(blocks, extent);
    }
    return blocks;
}

// A complete build of a level file.
class LevelFileBuild {
public:
    LevelFileBuild(const LevelBuild& build, JobMonitor& monitor)
        : build_(build)
        , layout_(build.source->layout())
        , monitor_(monitor)
        , means_path_(build.path + ".part.means")
        , checkpoints_(build.path + ".part.checkpoint", subjectOf(build), build.checkpoint_interval)
        , readers_(*build.source, levelThreads(layout_, build.memory_bytes_max))
    {}

    Status run()
    {
        Status done = make();
        // Other causes of failure may be temporary, but a changed raster never matches again.
        const bool can_go_on =
            !done && checkpoints_.hasCheckpoint() && done.error().code != ErrorCode::Invalid;
        if (can_go_on) {
            writer_->keep();
        } else if (writer_) {
            checkpoints_.remove();
            std::remove(means_path_.c_str());
        }
        return done;
    }

private:
    Status make()
    {
        if (auto begun = begin(); !begun) {
            return begun;
        }
        monitor_.beginStage(0.0, kSurveyShare);
        const auto save_survey = [this](CheckpointWriter& to) { return survey_->save(to); };
        if (stage_ == BuildStage::Survey) {
            Status surveyed =
                run({.end = layout_.tileRows(TileKind::Samples, 0),
                     .work = [this](TileReader& reader,
                                    std::size_t row) { return survey_->surveyRow(reader, row); },
                     .save = save_survey});
            if (!surveyed) {
                return surveyed;
            }
            enter(BuildStage::Means);
        }
        if (stage_ == BuildStage::Means) {
            Status surveyed = run(
                {.end = survey_->meanRowCount(),
                 .work = [this](TileReader& reader,
                                std::size_t row) { return survey_->surveyMeanRow(reader, row); },
                 .save = save_survey});
            if (!surveyed) {
                return surveyed;
            }
            enter(BuildStage::Errors);
        }
        const LevelSurvey& survey = survey_->finish();
        monitor_.beginStage(kSurveyShare, kSurveyShare + kErrorsShare);
        LevelErrorPass errors(*build_.source, build_.scale, survey, writer_.get(), monitor_);
        if (auto begun = errors.begin(); !begun) {
            return begun;
        }
        if (row_ > 0 && !errors.restore(*state_)) {
            return damaged(build_.path, "cannot be resumed");
        }
        state_.reset();
        Status measured =
            run({.end = layout_.tileRows(TileKind::Samples, 0),
                 .work = [&errors](TileReader& reader,
                                   std::size_t row) { return errors.measureRow(reader, row); },
                 .save =
                     [this, &errors](CheckpointWriter& to) {
                         const bool is_safe = survey_->save(to);
                         errors.save(to);
                         return is_safe;
                     }});
        if (!measured) {
            return measured;
        }
        monitor_.beginStage(kSurveyShare + kErrorsShare, 1.0);
        return finishLevelFile({.key = build_.key,
                                .layout = layout_,
                                .scale = build_.scale,
                                .mean_blocks_max = build_.mean_blocks_max,
                                .confirm = build_.confirm},
                               survey, errors, *writer_, monitor_);
    }

    // Resumes an interrupted build, or starts a new one.
    Status begin()
    {
        if (auto found = checkpoints_.find()) {
            LevelFileWriter::Written written{.bytes = found->place.file_bytes};
            auto writer = found->place.stage <= static_cast<std::uint8_t>(BuildStage::Errors) &&
                                  found->state.get(written.checksum)
                              ? LevelFileWriter::resume(build_.path, written)
                              : damaged(build_.path, "cannot be resumed");
            if (writer) {
                writer_ = std::move(writer).value();
                makeSurvey();
                if (survey_->restore(found->state)) {
                    stage_ = static_cast<BuildStage>(found->place.stage);
                    row_ = static_cast<std::size_t>(found->place.rows);
                    state_ = std::move(found->state);
                    checkpoints_.adopt();
                    return Done{};
                }
                writer_.reset();
            }
        }
        auto created = LevelFileWriter::create(build_.path);
        if (!created) {
            return std::move(created).error();
        }
        writer_ = std::move(created).value();
        checkpoints_.remove();
        if (Status room = checkRoom(
                {.path = build_.path, .bytes = levelFileBytesMax(layout_, build_.mean_blocks_max)});
            !room) {
            return room;
        }
        makeSurvey();
        return survey_->begin();
    }

    void enter(BuildStage stage)
    {
        stage_ = stage;
        row_ = 0;
    }

    // What is left of a stage.
    struct Rows {
        std::size_t end = 0;
        TileReaders::Work work;
        std::function<bool(CheckpointWriter& to)> save;
    };

    // Works on the rows, and saves checkpoints between them.
    Status run(const Rows& rows)
    {
        while (row_ < rows.end) {
            const Result<std::size_t> next =
                readers_.eachRow({.first = row_, .end = rows.end, .until = checkpoints_.next()},
                                 rows.work, monitor_);
            if (!next) {
                return next.error();
            }
            row_ = *next;
            if (row_ < rows.end) {
                saveRows(rows);
            }
        }
        return Done{};
    }

    void saveRows(const Rows& rows)
    {
        std::optional<LevelFileWriter::Written> written;
        checkpoints_.save(
            [&]() -> std::optional<JobPlace> {
                written = writer_->flush();
                if (!written) {
                    return std::nullopt;
                }
                return JobPlace{.stage = static_cast<std::uint8_t>(stage_),
                                .rows = row_,
                                .row_count = rows.end,
                                .file_bytes = written->bytes};
            },
            [&](CheckpointWriter& to) {
                to.put(written->checksum);
                return rows.save(to);
            });
    }

    void makeSurvey()
    {
        survey_.emplace(SurveyOptions{.source = build_.source,
                                      .scale = build_.scale,
                                      .means_path = means_path_,
                                      .mean_blocks_max = build_.mean_blocks_max},
                        writer_.get(), monitor_);
    }

    const LevelBuild& build_;
    TileLayout layout_;
    JobMonitor& monitor_;
    std::string means_path_;
    Checkpoints checkpoints_;
    TileReaders readers_;
    std::unique_ptr<LevelFileWriter> writer_;
    std::optional<LevelSurveyPass> survey_;
    BuildStage stage_ = BuildStage::Survey;
    std::size_t row_ = 0;                   // the first one of the stage that is not done
    std::optional<CheckpointReader> state_; // of the second pass, if it was started
};

} // namespace

Status finishLevelFile(const LevelFileOf& file,
                       const LevelSurvey& survey,
                       LevelErrorPass& pass,
                       LevelFileWriter& writer,
                       JobMonitor& monitor)
{
    LevelFileHeader header{.key = file.key,
                           .layout = file.layout,
                           .statistics = survey.statistics,
                           .scale = file.scale,
                           .block_samples =
                               finestBlocks(file.layout, file.mean_blocks_max).block_samples,
                           .fill_tiles = pass.tileFills().size(),
                           .coarse_tiles = pass.coarseFills().size(),
                           .planes = {}};
    header.layout.has_voids = header.hasVoids();
    const LevelErrors found = pass.finish();
    const BlockGrid blocks = blocksOf(survey, header.block_samples);
    const std::vector<std::uint64_t> samples_index = indexOf(survey.samples_index);
    const std::vector<std::uint64_t> fills_index = pass.tileFills().index();
    const std::vector<std::uint64_t> coarse_index = pass.coarseFills().index();
    std::vector<LevelFileWriter::Array> arrays{{"ranges", survey.ranges.bytes()}};
    const auto add = [&arrays](std::string name, const auto& values) {
        arrays.push_back({std::move(name), std::as_bytes(std::span(values))});
    };
    for (std::size_t level = 1; level < found.errors.levelCount(); ++level) {
        add(fmt::format("errors {}", level), found.errors.nodeErrors()[level].errors_m);
    }
    add("means", blocks.means_m);
    if (header.hasVoids()) {
        add("shares", blocks.shares);
        add("fills", found.fills_m);
    }
    add("checksums", std::as_const(*survey.checksums).values());
    add("samples index", samples_index);
    add("fills index", fills_index);
    add("coarse index", coarse_index);
    if (auto finished = writer.finish(std::move(header), arrays, {monitor, file.confirm});
        !finished) {
        return finished;
    }
    monitor.report(1.0);
    return Done{};
}

std::size_t
levelThreads(const TileLayout& layout, std::size_t memory_bytes_max, std::size_t band_bytes_max)
{
    // The memory of a thread in addition to shared memory: two tiles, two float copies of one, its
    // part of the incomplete bands of nested levels, and, if there are voids, rows of fine means.
    constexpr std::size_t kSamples = (kTileSide + 1) * (kTileSide + 1);
    const std::size_t thread_bytes =
        kSamples * (2 * sampleBytes(layout.type) + 8) +
        std::min(band_bytes_max, layout.columns / 8 * kTileSide * sampleBytes(layout.type)) +
        layout.columns * sizeof(float) * (layout.has_voids ? 7 : 1);
    return std::max<std::size_t>(1, memory_bytes_max / 2 / thread_bytes);
}

std::uint64_t levelFileBytesMax(const TileLayout& layout, std::size_t mean_blocks_max)
{
    const std::uint64_t tiles =
        layout.tileColumns(TileKind::Samples, 0) * layout.tileRows(TileKind::Samples, 0);
    const std::size_t kept_tiles = keptTileCount(layout);
    LevelFileHeader header{.key = {},
                           .layout = layout,
                           .statistics = {},
                           .scale = {},
                           .block_samples = finestBlocks(layout, mean_blocks_max).block_samples,
                           .fill_tiles = layout.has_voids ? tiles : 0,
                           .coarse_tiles = layout.has_voids ? kept_tiles : 0,
                           .planes = {}};
    header.statistics.void_count = layout.has_voids ? 1 : 0;
    std::uint64_t planes = 0;
    for (const LevelPlane& plane : planesOf(header)) {
        planes += plane.shape.bytes();
    }
    std::uint64_t kept_samples = 0;
    for (std::size_t level = LevelFile::kFirstLevel; level <= layout.topLevel(); ++level) {
        kept_samples +=
            layout.columnsAt(TileKind::Samples, level) * layout.rowsAt(TileKind::Samples, level);
    }
    // Packing does not enlarge noise. Checkpoints contain the measured data, twice while the next
    // one is written, and the first row of each row of tiles.
    const std::uint64_t sample_bytes = sampleBytes(layout.type);
    std::uint64_t bytes = kept_samples * sample_bytes + 3 * planes +
                          2 * layout.columns * layout.tileRows(TileKind::Samples, 0) * sample_bytes;
    if (layout.has_voids) {
        constexpr std::uint64_t kFillSide = kTileSide / BlockMeans::kBlock + 2;
        bytes += kept_samples / 8 + (kept_samples + tiles * kFillSide * kFillSide) * sizeof(float);
        for (BlockExtent fine{layout.columns, layout.rows, BlockMeans::kBlock};
             fine.block_samples < header.block_samples; fine = fine.coarser()) {
            bytes += fine.blockColumns() * fine.blockRows() * sizeof(float);
        }
    }
    return bytes;
}

Status buildLevelFile(const LevelBuild& build, JobMonitor& monitor)
{
    MARSVIEW_CHECK(build.source != nullptr);
    return LevelFileBuild(build, monitor).run();
}

} // namespace marsview
