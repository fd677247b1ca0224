#include "ui/text/haptics_text.h"

#include "core/base/round_numbers.h"
#include "core/geo/body.h"
#include "haptics/trace/replay_check.h"
#include "ui/text/body_text.h"
#include "ui/text/contact_model_text.h"
#include "ui/text/number_text.h"
#include "ui/text/recording_report.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <QStringList>

#include <string>

namespace marsview {
namespace {

QString tr(const char* text)
{
    return QCoreApplication::translate("marsview", text);
}

QString bodyText(const Ellipsoid& ellipsoid)
{
    const Body* body = bodyOfRadius(ellipsoid.equatorial_m);
    return body != nullptr ? bodyName(*body) : tr("unknown body");
}

} // namespace

QString deviceName(const std::string& name)
{
    //: A device that is computed instead of built, to try touching without one
    return name == "Simulated hand" ? tr("Simulated hand") : QString::fromStdString(name);
}

QString forceOffText(ForceOffReason reason)
{
    switch (reason) {
    case ForceOffReason::None:
        return {};
    case ForceOffReason::EmergencyStop:
        return tr("Force off: emergency stop");
    case ForceOffReason::DeviceLost:
        return tr("Force off: device lost; plug it in again");
    case ForceOffReason::DeviceFinished:
        return tr("Force off: the recording has ended");
    case ForceOffReason::DeviceUnready:
        return tr("Force off: device not ready; calibrate it, or release its own emergency stop");
    case ForceOffReason::DeviceStale:
        return tr("Force off: the device responds too late");
    case ForceOffReason::DeviceImplausible:
        return tr("Force off: implausible device reading");
    case ForceOffReason::NotHeld:
        return tr("Force off: the stylus is not held");
    case ForceOffReason::MissedDeadline:
        return tr("Force off: deadlines missed; this computer is too busy");
    case ForceOffReason::LoopStalled:
        return tr("The device no longer answers; switch it off and connect it again");
    case ForceOffReason::TerrainStale:
        return tr("Force off: terrain data not loaded");
    case ForceOffReason::Fault:
        return tr("Force off: internal error (invalid force)");
    case ForceOffReason::NoTouch:
        return tr("Force off: no layer to touch");
    }
    return {};
}

QString modeText(StylusMode mode, bool is_in_contact)
{
    switch (mode) {
    case StylusMode::Hover:
    case StylusMode::Press:
        //: What the hand with a haptic device does
        return is_in_contact ? tr("Touching the terrain") : tr("Free motion");
    case StylusMode::Pan:
        return tr("Moving the map");
    case StylusMode::Zoom:
        return tr("Zooming the map");
    }
    return {};
}

QString realTimeText(const RealTimeGrants& grants)
{
    const QString scheduling = QString::fromStdString(grants.scheduling_refusal);
    const QString locking = QString::fromStdString(grants.locking_refusal);
    if (grants.hasScheduling() && grants.hasLocking()) {
        return tr("Real-time scheduling and locked memory granted.");
    }
    if (grants.hasScheduling()) {
        //: %1 is the system's reason
        return tr("Real-time scheduling granted, locked memory not granted (%1). Touch works "
                  "without it.")
            .arg(locking);
    }
    //: %1 is the system's reason
    return tr("Real-time scheduling not granted (%1). Touch works, less steadily while the "
              "computer "
              "is busy.")
        .arg(scheduling);
}

QString recordedText(const QString& file, qulonglong updates, RecordingEnd end)
{
    const QString name = QFileInfo(file).fileName();
    const QString count = countText(static_cast<std::size_t>(updates));
    //: %1 is a file, %2 a number
    return end == RecordingEnd::AsWanted
               ? tr("%1: %2 updates recorded").arg(name, count)
               : tr("%1: %2 updates recorded; stopped: layer changed or closed").arg(name, count);
}

QString savedTicksText(const SavedTicks& saved)
{
    //: %1 is a file, %2 a number, %3 a number of seconds
    return tr("%1: %2 ticks of %3 s")
        .arg(QFileInfo(saved.file).fileName(), countText(saved.count),
             numberText(saved.seconds, 1));
}

QString replayText(const QString& file,
                   const ReplayFit& fit,
                   const TouchedGround& ground,
                   std::size_t map_count)
{
    const QString name = QFileInfo(file).fileName();
    if (fit.isElsewhere()) {
        //: %1 is a file
        return tr("All goals of %1 are outside the map; open the map that it was recorded on")
            .arg(name);
    }
    QStringList sentences;
    if (fit.beside_count > 0) {
        //: %1 is a file, %2 and %3 are numbers
        sentences.append(tr("%1: %2 of %3 goals are outside the map and are clamped to its edge.")
                             .arg(name, countText(fit.beside_count), countText(fit.goal_count)));
    }
    if (fit.is_cut_short) {
        //: %1 is a file
        sentences.append(tr("The last line of %1 is incomplete and is skipped.").arg(name));
    }
    if (fit.other_map) {
        //: %1 is a file, %2 and %3 are numbers of samples, %4 is a planet or a moon
        sentences.append(tr("%1 was recorded on a map that is not open: %2 × %3 samples, %4.")
                             .arg(name, countText(fit.other_map->columns),
                                  countText(fit.other_map->rows),
                                  bodyText(fit.other_map->ellipsoid)));
    }
    if (const GoalPart* other = fit.otherThan(map_count); other != nullptr && !fit.other_map) {
        //: %1 is a file, %2 and %3 are numbers of layers
        sentences.append(tr("Layers touched as one surface in %1: %2 when it was recorded, %3 now.")
                             .arg(name, countText(1 + other->below.size()), countText(map_count)));
    }
    if (const GoalPart* other = fit.otherThan(ground)) {
        //: %1 is a file, %2 and %4 are contact models, %3 and %5 numbers
        sentences.append(
            tr("%1 was recorded with %2 at exaggeration %3; it is replayed with %4 at %5.")
                .arg(name, contactModelText(other->kind), shortNumberText(other->exaggeration, 4),
                     contactModelText(ground.kind), shortNumberText(ground.exaggeration, 4)));
    }
    return sentences.join(QLatin1Char(' '));
}

QString replayEndText(const QString& file)
{
    //: %1 is a file
    return tr("%1 was replayed to its end").arg(isolated(QFileInfo(file).fileName()));
}

QString forceText(double force_n, double force_n_max)
{
    constexpr double kDistinguished = 0.01; // of the largest
    const int decimals =
        force_n_max > 0.0 ? decimalsOf(roundNumberBelow(kDistinguished * force_n_max)) : 2;
    //: A force in newtons
    return leftToRight(tr("%1 N").arg(numberText(force_n, decimals)));
}

QString spanText(std::chrono::nanoseconds span)
{
    const double us = static_cast<double>(span.count()) / 1e3;
    const QString text = us < 999.5 ? tr("%1 µs").arg(numberText(us, us < 9.95 ? 1 : 0))
                                    : tr("%1 ms").arg(numberText(us / 1e3, us < 9950.0 ? 1 : 0));
    return leftToRight(text);
}

} // namespace marsview
