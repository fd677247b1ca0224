// Texts for the state of a servo loop.
#pragma once

#include "haptics/interaction/mouse_stylus.h"
#include "haptics/loop/real_time_thread.h"
#include "haptics/loop/safety_limiter.h"

#include <QString>

#include <chrono>
#include <cstddef>
#include <string>

namespace marsview {

enum class RecordingEnd;
struct ReplayFit;
struct SavedTicks;
struct TouchedGround;

/// The name of a device; those of the built-in devices are translated.
QString deviceName(const std::string& name);
/// A sentence: why the force is off; empty if it is on.
QString forceOffText(ForceOffReason reason);
/// What the hand is doing.
QString modeText(StylusMode mode, bool is_in_contact);
/// A sentence about real-time scheduling; touching works without it.
QString realTimeText(const RealTimeGrants& grants);
/// "touch.csv: 12,345 updates recorded", and why it ended if the user did not stop it.
QString recordedText(const QString& file, qulonglong updates, RecordingEnd end);
/// "flight.csv: 10,000 ticks of 10.0 s".
QString savedTicksText(const SavedTicks& saved);
/// The differences between a recording and the open maps or `ground`, a surface of `map_count`
/// maps, as sentences; empty if there are none.
QString replayText(const QString& file,
                   const ReplayFit& fit,
                   const TouchedGround& ground,
                   std::size_t map_count = 1);
/// That a recording was replayed to its end.
QString replayEndText(const QString& file);
/// "0.45 N", to about the hundredth of the largest force, which a hand distinguishes.
QString forceText(double force_n, double force_n_max);
/// "12 µs", "3.4 ms"; two significant digits at least.
QString spanText(std::chrono::nanoseconds span);

} // namespace marsview
