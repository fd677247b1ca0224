#include "core/prepare/build_checkpoints.h"

#include <cstdio>
#include <utility>

namespace marsview {

BuildCheckpoints::BuildCheckpoints(std::string path,
                                   std::string subject,
                                   std::chrono::milliseconds interval)
    : path_(std::move(path))
    , subject_(std::move(subject))
    , schedule_(interval)
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
        const Result<std::size_t> next = readers.eachRow(
            {.first = row, .end = stage.end, .until = schedule_.next()}, stage.work, monitor);
        if (!next) {
            return next.error();
        }
        row = *next;
        if (row < stage.end) {
            is_there_ = schedule_.run([&] { return save(stage, row, writer); }) || is_there_;
        }
    }
    return Done{};
}

// A failed checkpoint does not stop the build: writing the level file will report the cause.
bool BuildCheckpoints::save(const Stage& stage, std::size_t row, LevelFileWriter& writer)
{
    const std::optional<LevelFileWriter::Written> written = writer.flush();
    if (!written) {
        return false;
    }
    CheckpointWriter to(path_);
    to.putArray(subject_);
    to.put(static_cast<std::uint8_t>(stage.stage));
    to.put(std::uint64_t{row});
    to.put(written->bytes);
    to.put(written->checksum);
    return stage.save(to) && to.finish();
}

void BuildCheckpoints::remove()
{
    std::remove(path_.c_str());
    is_there_ = false;
}

} // namespace marsview
