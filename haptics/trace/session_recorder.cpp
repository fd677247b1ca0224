#include "haptics/trace/session_recorder.h"

#include "core/base/plain_number.h"
#include "haptics/trace/ground_text.h"
#include "haptics/trace/motion_text.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <limits>
#include <string_view>
#include <utility>

namespace marsview {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

} // namespace

std::string sessionColumns(GoalColumns goals)
{
    std::string columns(kSessionColumns);
    if (goals == GoalColumns::Geographic) {
        constexpr std::string_view kMapGoal = "x,y";
        columns.replace(0, kMapGoal.size(), "lon,lat");
    }
    return columns;
}

std::string sessionLine(const TickRecord& record, std::int64_t begin_ns)
{
    return fmt::format("{},{},{},{:.6f},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
                       asText(record.goal.x), asText(record.goal.y), asText(record.goal.z),
                       static_cast<double>(record.time_ns - begin_ns) * 1e-9, record.tick,
                       record.is_in_contact ? 1 : 0, asText(record.proxy.x), asText(record.proxy.y),
                       asText(record.proxy.z), asText(record.force_n.x), asText(record.force_n.y),
                       asText(record.force_n.z), stylusModeName(record.mode),
                       forceOffReasonName(record.reason), record.ground.map_id,
                       record.ground.serial, contactModelName(record.ground.kind),
                       asText(record.ground.radius_m), asText(record.ground.exaggeration));
}

Result<std::unique_ptr<SessionRecorder>> SessionRecorder::begin(ServoLoop& loop,
                                                                const std::string& path,
                                                                std::uint64_t first_serial,
                                                                GoalColumns goals)
{
    Result<TraceFile> file = TraceFile::begin(
        path, fmt::format("{},{},{}", sessionColumns(goals), kGroundColumn, kMotionColumn));
    if (!file) {
        return std::move(file).error();
    }
    return std::unique_ptr<SessionRecorder>(
        new SessionRecorder(loop, path, std::move(*file), first_serial));
}

SessionRecorder::SessionRecorder(ServoLoop& loop,
                                 std::string path,
                                 TraceFile file,
                                 std::uint64_t first_serial)
    : loop_(loop)
    , path_(std::move(path))
    , file_(std::move(file))
    , first_serial_(first_serial)
{
    // A tick that ran while an earlier recording ended may have left a record.
    TickRecord left;
    while (loop_.takeRecord(left)) {
    }
    GroundRecord ground_left;
    while (loop_.takeGroundRecord(ground_left)) {
    }
    missing_before_ = loop_.state().counts.not_recorded;
    loop_.keepRecords(true);
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

SessionRecorder::~SessionRecorder()
{
    (void)finish();
}

Status SessionRecorder::finish()
{
    if (is_finished_) {
        return Done{};
    }
    is_finished_ = true;
    loop_.keepRecords(false);
    thread_.request_stop();
    thread_.join();
    Status closed = file_.close();
    const std::uint64_t missing = loop_.state().counts.not_recorded - missing_before_;
    if (closed && missing > 0) {
        return Error{ErrorCode::Unreadable,
                     fmt::format("{}: {} of {} updates are missing because the disk was too slow; "
                                 "record again on a faster disk",
                                 path_, missing, missing + updates_)};
    }
    return closed;
}

void SessionRecorder::run(const std::stop_token& stop)
{
    constexpr std::chrono::milliseconds kLook{20};
    while (!stop.stop_requested()) {
        drain();
        std::this_thread::sleep_for(kLook);
    }
    drain();
}

void SessionRecorder::drain()
{
    takeGround();
    TickRecord record;
    while (loop_.takeRecord(record)) {
        addGround(record.ground_records);
        if (record.ground.serial < first_serial_) { // serial numbers only increase
            continue; // an update of a model with a history that is not in the file
        }
        first_serial_ = 0;
        if (updates_ == 0) {
            begin_ns_ = record.time_ns;
        }
        ++updates_;
        std::string line = sessionLine(record, begin_ns_);
        line.back() = ',';
        line += ground_ + ',';
        if (record.has_motion) {
            line += motionText(record.motion);
        }
        file_.write(line + '\n');
        ground_.clear();
    }
}

// Also called without new updates, for instance while the hand moves the map: the queue would fill
// up.
void SessionRecorder::takeGround()
{
    GroundRecord record;
    while (loop_.takeGroundRecord(record)) {
        ground_records_.push_back(record);
    }
}

// Collects the next `count` terrain records, including those of skipped updates.
void SessionRecorder::addGround(std::uint32_t count)
{
    if (ground_records_.size() < count) {
        takeGround();
    }
    for (std::uint32_t i = 0; i < count && !ground_records_.empty(); ++i) {
        ground_ += (ground_.empty() ? "" : " ") + groundText(ground_records_.front());
        ground_records_.pop_front();
    }
}

std::vector<TickRecord> ofLastScene(std::vector<TickRecord> records)
{
    const auto other =
        std::find_if(records.rbegin(), records.rend(), [&](const TickRecord& record) {
            return record.is_on_body != records.back().is_on_body;
        });
    records.erase(records.begin(), other.base());
    return records;
}

Status saveFlight(const FlightRecorder& flight, const std::string& path)
{
    return saveFlight(ofLastScene(flight.records()), path);
}

Status saveFlight(const std::vector<TickRecord>& records, const std::string& path)
{
    const bool is_on_body = !records.empty() && records.back().is_on_body;
    Result<TraceFile> file = TraceFile::begin(
        path, fmt::format("{},hand_x,hand_y,hand_z,tick_us,surface_z",
                          sessionColumns(is_on_body ? GoalColumns::Geographic : GoalColumns::Map)));
    if (!file) {
        return std::move(file).error();
    }
    for (const TickRecord& record : records) {
        TickRecord written = record;
        if (!written.has_goal) {
            written.goal = {kNone, kNone, kNone};
        }
        std::string line = sessionLine(written, records.front().time_ns);
        line.pop_back();
        file->write(fmt::format("{},{},{},{},{:.3f},{}\n", line, asText(record.hand.x),
                                asText(record.hand.y), asText(record.hand.z), record.tick_us,
                                asText(record.surface_z_m)));
    }
    return file->close();
}

} // namespace marsview
