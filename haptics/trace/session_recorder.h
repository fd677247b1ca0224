// Writes what a servo loop does into a file, as long as it lasts.
#pragma once

#include "core/base/result.h"
#include "haptics/loop/servo_loop.h"
#include "haptics/trace/trace_file.h"

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace marsview {

/// A line a contact update. The first three columns are those of a file of goals: `trace --goals`
/// gives the same proxies again, to the bit, and "replay:" aims at the same places. The last five
/// tell what they were aimed at with: `map` and `part` are numbers of the program's, another map
/// and another contact model having another one. A session's file has kGroundColumn behind them.
inline constexpr std::string_view kSessionColumns =
    "x,y,z,time_s,tick,contact,proxy_x,proxy_y,proxy_z,force_x_n,force_y_n,force_z_n,mode,reason,"
    "map,part,model,radius_m,exaggeration";

/// One line with its end; times count from `begin_ns`.
std::string sessionLine(const TickRecord& record, std::int64_t begin_ns);

/// A thread of its own writes; the servo thread only hands over. Made and finished by the thread
/// that owns the loop, before the loop ends.
class SessionRecorder {
public:
    /// Begins. The loop outlives the recorder. Unreadable where the file cannot be made.
    ///
    /// A contact model's answer depends on all that it was asked before. So the first line has to
    /// be the first update of a model: of a loop that runs, make the map anew, name its serial as
    /// `first_serial`, and set() it once this has returned; what comes before its first update is
    /// left out. 0 is for a loop that has not touched anything: all of it is recorded.
    static Result<std::unique_ptr<SessionRecorder>>
    begin(ServoLoop& loop, const std::string& path, std::uint64_t first_serial = 0);
    ~SessionRecorder();
    SessionRecorder(const SessionRecorder&) = delete;
    SessionRecorder& operator=(const SessionRecorder&) = delete;

    /// Writes what there is and closes the file. Says where that failed, as on a full disk, and
    /// where updates are missing because the disk was too slow for them.
    Status finish();
    std::uint64_t updates() const noexcept { return updates_; } // after finish()

private:
    SessionRecorder(ServoLoop& loop, std::string path, TraceFile file, std::uint64_t first_serial);
    void run(const std::stop_token& stop);
    void drain();
    void takeGround();
    void addGround(std::uint32_t count);

    ServoLoop& loop_;
    std::string path_;
    TraceFile file_;
    std::uint64_t first_serial_; // 0 from when it has come
    bool is_finished_ = false;
    std::uint64_t updates_ = 0;
    std::uint64_t missing_before_ = 0; // in recordings before this
    std::int64_t begin_ns_ = 0;
    std::deque<GroundRecord> ground_records_; // taken, of updates that are still to come
    std::string ground_;                      // of the next line
    std::jthread thread_;
};

/// Ticks of a flight recorder, in the same columns but with the hand's place and the time that each
/// tick took. Goals are nan where the contact model was not asked.
Status saveFlight(const std::vector<TickRecord>& records, const std::string& path);
/// Any thread but the servo's; the loop may run on, and is not disturbed. A window keeps
/// `flight.records()`, which takes a millisecond or two, and writes on another thread: then the
/// loop may be gone as well.
Status saveFlight(const FlightRecorder& flight, const std::string& path);

} // namespace marsview
