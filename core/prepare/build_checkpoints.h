// Checkpoints for resuming the build of a level file after the program was killed.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/prepare/checkpoint_file.h"
#include "core/prepare/checkpoint_schedule.h"
#include "core/prepare/level_file_writer.h"
#include "core/prepare/tile_rows.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace marsview {

/// The stages of a build, in this order.
enum class BuildStage : std::uint8_t { Survey, Means, Errors };

/// The position of a build at its last checkpoint.
struct BuildPlace {
    BuildStage stage = BuildStage::Survey;
    std::uint64_t row = 0;            // the first row that is not done
    LevelFileWriter::Written written; // of the file
};

/// Checkpoints of one build: the file `path`. For one thread.
class BuildCheckpoints {
public:
    /// `subject` identifies the build and its settings: checkpoints with another subject are
    /// ignored. Saves a checkpoint after each `interval`, or later if saving takes long.
    BuildCheckpoints(std::string path, std::string subject, std::chrono::milliseconds interval);

    /// The position and the saved state of the last checkpoint. Empty if there is none.
    struct Found {
        BuildPlace place;
        CheckpointReader state;
    };
    std::optional<Found> find() const;

    /// Processes rows [first, end) of a stage and regularly saves the state written by `save`. If
    /// `save` returns false, the previous checkpoint is kept.
    struct Stage {
        BuildStage stage = BuildStage::Survey;
        std::size_t first = 0;
        std::size_t end = 0;
        TileReaders::Work work;
        std::function<bool(CheckpointWriter& to)> save;
    };
    Status run(const Stage& stage,
               TileReaders& readers,
               LevelFileWriter& writer,
               const JobMonitor& monitor);

    /// Whether the build can be resumed.
    bool hasCheckpoint() const noexcept { return is_there_; }
    /// Accepts the checkpoint that was found.
    void adopt() noexcept { is_there_ = true; }
    void remove();

private:
    bool save(const Stage& stage, std::size_t row, LevelFileWriter& writer);

    std::string path_;
    std::string subject_;
    CheckpointSchedule schedule_;
    bool is_there_ = false;
};

} // namespace marsview
