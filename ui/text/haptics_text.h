// Texts for the state of a servo loop.
#pragma once

#include "haptics/interaction/mouse_stylus.h"
#include "haptics/loop/real_time_thread.h"
#include "haptics/loop/safety_limiter.h"

#include <QString>

#include <chrono>
#include <string>

namespace marsview {

enum class RecordingEnd;
struct ReplayFit;
struct SavedTicks;
struct TouchedGround;

/// The name that a driver gives its device, in the language of the window where it is ours.
QString deviceName(const std::string& name);
/// A sentence: why the force is off; empty if it is on.
QString letGoText(ForceOffReason reason);
/// What the hand is doing.
QString modeText(StylusMode mode, bool is_in_contact);
/// A sentence, and that all works without.
QString realTimeText(const RealTimeGrants& grants);
/// "touch.csv: 12,345 updates recorded", and why it ended if the user did not stop it.
QString recordedText(const QString& file, qulonglong updates, RecordingEnd end);
/// "flight.csv: 10,000 ticks of 10.0 s".
QString savedTicksText(const SavedTicks& saved);
/// Sentences: where a recording does not go with the maps that are open, or was touched in another
/// way than `ground` is; empty where all is the same.
QString replayText(const QString& file, const ReplayFit& fit, const TouchedGround& ground);
/// That a recording was replayed to its end.
QString replayEndText(const QString& file);
/// "0.45 N", to about the hundredth of the largest force, which a hand distinguishes.
QString forceText(double force_n, double force_n_max);
/// "12 µs", "3.4 ms"; two significant digits at least.
QString spanText(std::chrono::nanoseconds span);

} // namespace marsview
