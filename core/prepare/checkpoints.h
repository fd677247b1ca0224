// Resuming a long job after the program was killed.
#pragma once

#include "core/prepare/checkpoint_file.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace marsview {

/// How far a job has come.
struct JobPlace {
    std::uint8_t stage = 0;       // in the order of the job
    std::uint64_t rows = 0;       // of tiles, complete in this stage
    std::uint64_t row_count = 0;  // of tiles, in this stage
    std::uint64_t file_bytes = 0; // of the unfinished file, on the disk

    bool operator==(const JobPlace&) const = default;
};

/// The checkpoint of one job in the file `path`: its place and what it needs to go on from there. A
/// new checkpoint replaces the previous one atomically. For one thread.
///
///     Checkpoints checkpoints(path, subject, interval);
///     if (auto found = checkpoints.find(); found && restore(found->state)) {
///         checkpoints.adopt();
///         row = found->place.rows;
///     }
///     for (; row < row_count; ++row) {
///         if (checkpoints.isDue()) {
///             checkpoints.save([&] { … return place; }, [&](CheckpointWriter& to) { … });
///         }
///         …
///     }
class Checkpoints {
public:
    using Clock = std::chrono::steady_clock;

    /// `subject` identifies the job with its source and settings: a checkpoint with another subject
    /// is not found. A checkpoint is due after each `interval`, or later if saving one takes more
    /// than a twentieth of the time; with an interval of zero it is always due.
    Checkpoints(std::string path, std::string subject, std::chrono::milliseconds interval);

    struct Found {
        JobPlace place;
        CheckpointReader state; // what the job wrote
    };
    /// Empty if there is no checkpoint of this job, or if it is damaged.
    std::optional<Found> find() const;

    Clock::time_point next() const noexcept { return next_; }
    bool isDue() const { return Clock::now() >= next_; }

    /// Replaces the checkpoint; it is on the disk when the function returns. `reach` puts the work
    /// so far on the disk and returns its place, or nothing if it cannot; `write` writes the state
    /// and returns whether it is complete. Without success the previous checkpoint stays: the job
    /// goes on, and writing its file will report the cause.
    void save(const std::function<std::optional<JobPlace>()>& reach,
              const std::function<bool(CheckpointWriter& to)>& write);

    /// Whether the job can be resumed.
    bool hasCheckpoint() const noexcept { return is_there_; }
    /// Accepts the checkpoint that was found.
    void adopt() noexcept { is_there_ = true; }
    void remove();

private:
    std::string path_;
    std::string subject_;
    std::chrono::milliseconds interval_;
    Clock::time_point next_;
    bool is_there_ = false;
};

/// The place of any job, such as one that another program runs. Empty if there is no checkpoint, or
/// if it is damaged.
std::optional<JobPlace> placeInCheckpoint(const std::string& path);

} // namespace marsview
