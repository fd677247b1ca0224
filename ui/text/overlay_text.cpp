#include "ui/text/overlay_text.h"

#include "core/base/round_numbers.h"
#include "ui/text/number_text.h"

#include <QCoreApplication>
#include <QLocale>

#include <array>
#include <cmath>

namespace marsview {
namespace {

constexpr std::array kWinds{QT_TRANSLATE_NOOP("OverlayText", "north"),
                            QT_TRANSLATE_NOOP("OverlayText", "north-north-east"),
                            QT_TRANSLATE_NOOP("OverlayText", "north-east"),
                            QT_TRANSLATE_NOOP("OverlayText", "east-north-east"),
                            QT_TRANSLATE_NOOP("OverlayText", "east"),
                            QT_TRANSLATE_NOOP("OverlayText", "east-south-east"),
                            QT_TRANSLATE_NOOP("OverlayText", "south-east"),
                            QT_TRANSLATE_NOOP("OverlayText", "south-south-east"),
                            QT_TRANSLATE_NOOP("OverlayText", "south"),
                            QT_TRANSLATE_NOOP("OverlayText", "south-south-west"),
                            QT_TRANSLATE_NOOP("OverlayText", "south-west"),
                            QT_TRANSLATE_NOOP("OverlayText", "west-south-west"),
                            QT_TRANSLATE_NOOP("OverlayText", "west"),
                            QT_TRANSLATE_NOOP("OverlayText", "west-north-west"),
                            QT_TRANSLATE_NOOP("OverlayText", "north-west"),
                            QT_TRANSLATE_NOOP("OverlayText", "north-north-west")};

} // namespace

QString numberText(double value, double step)
{
    const int decimals = step > 0.0 ? decimalsOf(roundNumberBelow(step)) : 0;
    const double half = 0.5 * std::pow(10.0, -decimals);
    return withMinusSigns(QLocale().toString(std::abs(value) < half ? 0.0 : value, 'f', decimals));
}

QString lengthText(double round_length_m)
{
    if (round_length_m >= 1000.0) {
        const double length_km = round_length_m / 1000.0;
        //: A length in kilometers
        return QCoreApplication::translate("OverlayText", "%1 km")
            .arg(numberText(length_km, length_km));
    }
    //: A length in meters
    return QCoreApplication::translate("OverlayText", "%1 m")
        .arg(numberText(round_length_m, round_length_m));
}

QString headingText(Angle heading)
{
    const double turned = std::fmod(heading.degrees(), 360.0);
    const int degrees = static_cast<int>(std::lround(turned < 0.0 ? turned + 360.0 : turned)) % 360;
    const auto wind = static_cast<std::size_t>(std::lround(degrees / 22.5)) % kWinds.size();
    //: A heading: %1 is degrees clockwise from north, %2 the same in words
    return QCoreApplication::translate("OverlayText", "%1° (%2)")
        .arg(QLocale().toString(degrees), QCoreApplication::translate("OverlayText", kWinds[wind]));
}

} // namespace marsview
