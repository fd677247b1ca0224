#include "core/prepare/checkpoints.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace marsview {
namespace {

// To be increased with every change of the fields, also of those that the jobs write.
constexpr std::uint32_t kVersion = 3;

constexpr int kWorkPerSave = 20;

// What every checkpoint begins with.
struct Head {
    std::string subject;
    JobPlace place;
};

void put(CheckpointWriter& to, const std::string& subject, const JobPlace& place)
{
    to.put(kVersion);
    to.putArray(subject);
    to.put(place.stage);
    to.put(place.rows);
    to.put(place.row_count);
    to.put(place.file_bytes);
}

std::optional<Head> headFrom(CheckpointReader& from)
{
    std::uint32_t version = 0;
    Head head;
    JobPlace& place = head.place;
    if (!from.get(version) || version != kVersion || !from.getAny(head.subject) ||
        !from.get(place.stage) || !from.get(place.rows) || !from.get(place.row_count) ||
        !from.get(place.file_bytes)) {
        return std::nullopt;
    }
    return head;
}

} // namespace

Checkpoints::Checkpoints(std::string path, std::string subject, std::chrono::milliseconds interval)
    : path_(std::move(path))
    , subject_(std::move(subject))
    , interval_(interval)
    , next_(Clock::now() + interval)
{}

std::optional<Checkpoints::Found> Checkpoints::find() const
{
    auto reader = CheckpointReader::open(path_);
    if (!reader) {
        return std::nullopt;
    }
    const std::optional<Head> head = headFrom(*reader);
    if (!head || head->subject != subject_) {
        return std::nullopt;
    }
    return Found{head->place, std::move(*reader)};
}

void Checkpoints::save(const std::function<std::optional<JobPlace>()>& reach,
                       const std::function<bool(CheckpointWriter& to)>& write)
{
    const Clock::time_point start = Clock::now();
    if (const std::optional<JobPlace> place = reach()) {
        CheckpointWriter to(path_);
        put(to, subject_, *place);
        is_there_ = (write(to) && to.finish()) || is_there_;
    }
    const Clock::time_point end = Clock::now();
    next_ = interval_.count() == 0
                ? end
                : end + std::max<Clock::duration>(interval_, kWorkPerSave * (end - start));
}

void Checkpoints::remove()
{
    std::remove(path_.c_str());
    std::remove(CheckpointWriter::unfinishedPath(path_).c_str());
    is_there_ = false;
}

std::optional<JobPlace> placeInCheckpoint(const std::string& path)
{
    auto reader = CheckpointReader::open(path);
    const std::optional<Head> head = reader ? headFrom(*reader) : std::nullopt;
    return head ? std::optional(head->place) : std::nullopt;
}

} // namespace marsview
