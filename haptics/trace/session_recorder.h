// Records a servo loop to a file while the loop runs.
#pragma once

#include "core/base/result.h"
#include "haptics/loop/servo_loop.h"
#include "haptics/trace/goal_file.h"
#include "haptics/trace/trace_file.h"

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace marsview {

/// One line per contact update. The first three columns are those of a file of goals: `trace
/// --goals` gives the same proxies again, to the bit, and "replay:" aims at the same positions. The
/// last five describe the map and the contact model: `map` and `part` are numbers that the program
/// assigns, unique per map and per contact model. A session's file appends kGroundColumn and
/// kMotionColumn.
inline constexpr std::string_view kSessionColumns =
    "x,y,z,time_s,tick,contact,proxy_x,proxy_y,proxy_z,force_x_n,force_y_n,force_z_n,mode,reason,"
    "map,part,model,radius_m,exaggeration";

/// The same for goals of another kind: on the body, lon, lat and z.
std::string sessionColumns(GoalColumns goals);

/// One line including its line break; times are relative to `begin_ns`.
std::string sessionLine(const TickRecord& record, std::int64_t begin_ns);

/// A separate thread writes; the servo thread only passes records to it. Created and finished by
/// the thread that owns the loop, before the loop ends.
class SessionRecorder {
public:
    /// Starts recording. The loop must outlive the recorder. Unreadable if the file cannot be
    /// created.
    ///
    /// A contact model's result depends on all its earlier updates. So the first line has to be the
    /// first update of a model: for a running loop, rebuild the map, pass its serial as
    /// `first_serial`, and set() it after this call has returned; updates before its first one are
    /// skipped. Pass 0 for a loop that has not touched anything: everything is recorded.
    static Result<std::unique_ptr<SessionRecorder>> begin(ServoLoop& loop,
                                                          const std::string& path,
                                                          std::uint64_t first_serial = 0,
                                                          GoalColumns goals = GoalColumns::Map);
    ~SessionRecorder();
    SessionRecorder(const SessionRecorder&) = delete;
    SessionRecorder& operator=(const SessionRecorder&) = delete;

    /// Writes the remaining records and closes the file. Returns an error if writing failed, for
    /// example on a full disk, or if updates are missing because the disk was too slow.
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
    std::uint64_t first_serial_; // 0 once it has arrived
    bool is_finished_ = false;
    std::uint64_t updates_ = 0;
    std::uint64_t missing_before_ = 0; // before this recording
    std::int64_t begin_ns_ = 0;
    std::deque<GroundRecord> ground_records_; // taken, for updates that have not arrived yet
    std::string ground_;                      // for the next line
    std::jthread thread_;
};

/// The last of these ticks: all that touched the flat map, or all on the body.
std::vector<TickRecord> ofLastScene(std::vector<TickRecord> records);

/// Saves a flight recorder's ticks, all of one scene, in the same columns, plus the stylus position
/// and the duration of each tick. Goals are nan for ticks without a contact update.
Status saveFlight(const std::vector<TickRecord>& records, const std::string& path);
/// The same for the last ticks of one scene. Any thread except the servo thread; the loop may run
/// and is not disturbed. A window copies `flight.records()`, which takes a millisecond or two, and
/// saves the copy on another thread, so that the loop may end in the meantime.
Status saveFlight(const FlightRecorder& flight, const std::string& path);

} // namespace marsview
