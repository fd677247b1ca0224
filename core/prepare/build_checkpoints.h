// How a level file that was begun goes on after the program was killed.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/prepare/checkpoint_file.h"
#include "core/prepare/level_file_writer.h"
#include "core/prepare/tile_rows.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace marsview {

/// What is worked on, in this order.
enum class BuildStage : std::uint8_t { Survey, Means, Errors };

/// Where a build was when its last checkpoint was written.
struct BuildPlace {
    BuildStage stage = BuildStage::Survey;
    std::uint64_t row = 0;            // the first that is not done
    LevelFileWriter::Written written; // of the file
};

/// Checkpoints of one build: the file `path`. For one thread.
class BuildCheckpoints {
public:
    /// `subject` says what is built, and how: a checkpoint of anything else is not taken. One is
    /// saved after `interval`, later where saving takes long.
    BuildCheckpoints(std::string path, std::string subject, std::chrono::milliseconds interval);

    /// Where the last one is, and the state that was saved there. Nothing where there is none.
    struct Found {
        BuildPlace place;
        CheckpointReader state;
    };
    std::optional<Found> find() const;

    /// Works on rows [first, end) of a stage, and saves now and then what `save` puts. False from
    /// `save` leaves the checkpoint before.
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

    /// Whether the build can go on after it was stopped.
    bool hasCheckpoint() const noexcept { return is_there_; }
    /// The one that was found is good.
    void adopt() noexcept { is_there_ = true; }
    void remove();

private:
    void save(const Stage& stage, std::size_t row, LevelFileWriter& writer);

    std::string path_;
    std::string subject_;
    std::chrono::milliseconds interval_;
    std::chrono::steady_clock::duration last_save_{};
    bool is_there_ = false;
};

} // namespace marsview
