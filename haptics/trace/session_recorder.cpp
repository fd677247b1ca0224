#include "haptics/trace/session_recorder.h"

#include "core/base/plain_number.h"

#include <array>
#include <chrono>
#include <fmt/format.h>

namespace marsview {
namespace {

std::string_view nameOf(StylusMode mode)
{
    constexpr std::array<std::string_view, 4> kNames{"hover", "press", "pan", "zoom"};
    return kNames[static_cast<std::size_t>(mode)];
}

Error cannotWrite(const std::string& path)
{
    return {ErrorCode::Unreadable, fmt::format("{}: cannot be written", path)};
}

bool write(std::FILE* file, std::string_view text)
{
    return std::fwrite(text.data(), 1, text.size(), file) == text.size();
}

} // namespace

std::string sessionLine(const TickRecord& record, std::int64_t begin_ns)
{
    return fmt::format("{},{},{},{:.6f},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
                       asText(record.goal.x), asText(record.goal.y), asText(record.goal.z),
                       static_cast<double>(record.time_ns - begin_ns) * 1e-9, record.tick,
                       record.is_in_contact ? 1 : 0, asText(record.proxy.x), asText(record.proxy.y),
                       asText(record.proxy.z), asText(record.force_n.x), asText(record.force_n.y),
                       asText(record.force_n.z), nameOf(record.mode),
                       letGoReasonName(record.reason), record.ground.map_id, record.ground.serial,
                       contactModelName(record.ground.kind), asText(record.ground.radius_m),
                       asText(record.ground.exaggeration));
}

Result<std::unique_ptr<SessionRecorder>> SessionRecorder::begin(ServoLoop& loop,
                                                                const std::string& path)
{
    std::FILE* file = std::fopen(path.c_str(), "wbe"); // NOLINT(cppcoreguidelines-owning-memory)
    if (file == nullptr) {
        return cannotWrite(path);
    }
    return std::unique_ptr<SessionRecorder>(new SessionRecorder(loop, path, file));
}

SessionRecorder::SessionRecorder(ServoLoop& loop, const std::string& path, std::FILE* file)
    : loop_(loop)
    , path_(path)
    , file_(file)
{
    has_failed_ = !write(file_, fmt::format("{}\n", kSessionColumns));
    // A tick that ran while an earlier recording ended may have left one.
    TickRecord left;
    while (loop_.takeRecord(left)) {
    }
    loop_.keepRecords(true);
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

SessionRecorder::~SessionRecorder()
{
    (void)finish();
}

Status SessionRecorder::finish()
{
    if (file_ == nullptr) {
        return Done{};
    }
    loop_.keepRecords(false);
    thread_.request_stop();
    thread_.join();
    has_failed_ = std::fclose(file_) != 0 || has_failed_;
    file_ = nullptr;
    return has_failed_ ? Status(cannotWrite(path_)) : Status(Done{});
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
    TickRecord record;
    while (loop_.takeRecord(record)) {
        if (updates_ == 0) {
            begin_ns_ = record.time_ns;
        }
        ++updates_;
        has_failed_ = has_failed_ || !write(file_, sessionLine(record, begin_ns_));
    }
}

Status saveFlight(const FlightRecorder& flight, const std::string& path)
{
    std::FILE* file = std::fopen(path.c_str(), "wbe"); // NOLINT(cppcoreguidelines-owning-memory)
    if (file == nullptr) {
        return cannotWrite(path);
    }
    bool is_fine = write(file, fmt::format("{},hand_x,hand_y,hand_z,tick_us\n", kSessionColumns));
    const std::vector<TickRecord> records = flight.records();
    for (const TickRecord& record : records) {
        std::string line = sessionLine(record, records.front().time_ns);
        line.pop_back();
        is_fine = is_fine && write(file, fmt::format("{},{},{},{},{:.3f}\n", line,
                                                     asText(record.hand.x), asText(record.hand.y),
                                                     asText(record.hand.z), record.tick_us));
    }
    is_fine = std::fclose(file) == 0 && is_fine;
    return is_fine ? Status(Done{}) : Status(cannotWrite(path));
}

} // namespace marsview
