#include "ui/text/attitude_text.h"

#include "ui/text/measure_text.h"

#include <QCoreApplication>

#include <cmath>

namespace marsview {
namespace {

// The panel has the same texts.
QString attitudesTr(const char* text)
{
    return QCoreApplication::translate("marsview::AttitudesView", text);
}

} // namespace

QStringList orientationLines(const OrientationStatistics& statistics)
{
    const auto whole = [](double degrees) { return measuredAngleText(degrees, 0); };
    QStringList lines;
    lines << attitudesTr(QT_TRANSLATE_NOOP("marsview::AttitudesView", "Attitudes: %1"))
                 .arg(countText(statistics.count));
    //: Of planes: %1 is the strike, %2 the dip
    lines << attitudesTr(
                 QT_TRANSLATE_NOOP("marsview::AttitudesView", "Mean plane: strike %1, dip %2"))
                 .arg(whole(statistics.mean.strike_deg), whole(statistics.mean.dip_deg));
    //: Of planes: %1 is the trend, %2 the plunge
    lines << attitudesTr(
                 QT_TRANSLATE_NOOP("marsview::AttitudesView", "Mean pole: trend %1, plunge %2"))
                 .arg(whole(statistics.trend_deg), whole(statistics.plunge_deg));
    if (std::isfinite(statistics.kappa)) {
        //: Fisher's concentration of poles
        lines << attitudesTr(QT_TRANSLATE_NOOP("marsview::AttitudesView", "Fisher's κ: %1"))
                     .arg(significantNumberText(statistics.kappa, 3));
        //: %1 is the half angle of a cone
        lines << attitudesTr(QT_TRANSLATE_NOOP("marsview::AttitudesView", "95 % cone: %1"))
                     .arg(measuredAngleText(statistics.confidence_deg, 1));
    }
    return lines;
}

} // namespace marsview
