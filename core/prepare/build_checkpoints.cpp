#include "core/prepare/build_checkpoints.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace marsview {
namespace {

using Clock = std::chrono::steady_clock;

// The work between checkpoints takes at least this many times as long as saving one.
constexpr int kWorkPerSave = 20;

} // namespace

BuildCheckpoints::BuildCheckpoints(std::string path,
                                   std::string subject,
                                   std::chrono::milliseconds interval)
    : path_(std::move(path))
    , subject_(std::move(subject))
    , interval_(interval)
{}

std::optional<BuildCheckpoints::Found> BuildCheckpoints::find() const
{
    auto reader = CheckpointReader::open(path_);
    if (!reader) {
        return std::nullopt;
    }
    std::string subject;
    std::uint8_t stage = 0;
    BuildPlace place;
    if (!reader->getAny(subject) || subject != subject_ || !reader->get(stage) ||
        stage > static_cast<std::uint8_t>(BuildStage::Errors) || !reader->get(place.row) ||
        !reader->get(place.written.bytes) || !reader->get(place.written.checksum)) {
        return std::nullopt;
    }
    place.stage = static_cast<BuildStage>(stage);
    return Found{place, std::move(*reader)};
}

Status BuildCheckpoints::run(const Stage& stage,
                             TileReaders& readers,
                             LevelFileWriter& writer,
                             const JobMonitor& monitor)
{
    std::size_t row = stage.first;
    while (row < stage.end) {
        const Result<std::size_t> next =
            readers.eachRow({.first = row, .end = stage.end, .until = Clock::now() + interval_},
                            stage.work, monitor);
        if (!next) {
            return next.error();
        }
        row = *next;
        if (row < stage.end) {
            const Clock::time_point start = Clock::now();
            save(stage, row, writer);
            last_save_ = Clock::now() - start;
        }
    }
    return Done{};
}

// A failed checkpoint does not stop the build: writing the level file will report the cause.
void BuildCheckpoints::save(const Stage& stage, std::size_t row, LevelFileWriter& writer)
{
    const std::optional<LevelFileWriter::Written> written = writer.flush();
    if (!written) {
        return;
    }
    CheckpointWriter to(path_);
    to.putArray(subject_);
    to.put(static_cast<std::uint8_t>(stage.stage));
    to.put(std::uint64_t{row});
    to.put(written->bytes);
    to.put(written->checksum);
    if (stage.save(to) && to.finish()) {
        is_there_ = true;
    }
}

void BuildCheckpoints::remove()
{
    std::remove(path_.c_str());
    is_there_ = false;
}

} // namespace marsview
