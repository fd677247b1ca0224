#include "ui/text/place_name_text.h"

#include "ui/text/body_text.h"
#include "ui/text/number_text.h"

#include <QCoreApplication>

namespace marsview {
namespace {

// Meters below a kilometer, tenths below ten kilometers, else whole kilometers.
QString sizeText(double diameter_m)
{
    constexpr double kMetersPerKilometer = 1000.0;
    if (diameter_m < kMetersPerKilometer) {
        return withUnit(numberText(diameter_m, 0), QCoreApplication::translate("PlaceName", "m"));
    }
    const double diameter_km = diameter_m / kMetersPerKilometer;
    return withUnit(numberText(diameter_km, diameter_km < 10.0 ? 1 : 0),
                    QCoreApplication::translate("PlaceName", "km"));
}

} // namespace

QString placeKindText(PlaceKind kind)
{
    switch (kind) {
    case PlaceKind::Other:
        return {};
    case PlaceKind::LetteredCrater:
    case PlaceKind::Crater:
        return QCoreApplication::translate("PlaceName", "crater");
    case PlaceKind::Canyon:
        return QCoreApplication::translate("PlaceName", "canyon");
    case PlaceKind::Cape:
        return QCoreApplication::translate("PlaceName", "cape");
    case PlaceKind::Chaos:
        return QCoreApplication::translate("PlaceName", "chaotic terrain");
    case PlaceKind::CraterChain:
        return QCoreApplication::translate("PlaceName", "crater chain");
    case PlaceKind::Dunes:
        return QCoreApplication::translate("PlaceName", "dunes");
    case PlaceKind::Hollow:
        return QCoreApplication::translate("PlaceName", "hollow");
    case PlaceKind::LandingSite:
        return QCoreApplication::translate("PlaceName", "landing site");
    case PlaceKind::Mountain:
        return QCoreApplication::translate("PlaceName", "mountain");
    case PlaceKind::Plain:
        return QCoreApplication::translate("PlaceName", "plain");
    case PlaceKind::Plateau:
        return QCoreApplication::translate("PlaceName", "plateau");
    case PlaceKind::Region:
        return QCoreApplication::translate("PlaceName", "region");
    case PlaceKind::Ridge:
        return QCoreApplication::translate("PlaceName", "ridge");
    case PlaceKind::Scarp:
        return QCoreApplication::translate("PlaceName", "scarp");
    case PlaceKind::Sea:
        //: A dark plain of lava: Mare, Oceanus, Sinus, Lacus, Palus
        return QCoreApplication::translate("PlaceName", "sea");
    case PlaceKind::Trough:
        return QCoreApplication::translate("PlaceName", "trough");
    case PlaceKind::Valley:
        return QCoreApplication::translate("PlaceName", "valley");
    case PlaceKind::Volcano:
        //: Patera: a crater with scalloped edges, mostly of a volcano
        return QCoreApplication::translate("PlaceName", "patera");
    }
    return {};
}

QString placeDetailText(const PlaceName& place)
{
    const QString kind = placeKindText(place.kind);
    if (!(place.diameter_m > 0.0)) {
        return kind;
    }
    const QString size = sizeText(place.diameter_m);
    //: What a place is, and its diameter
    return kind.isEmpty() ? size
                          : QCoreApplication::translate("PlaceName", "%1, %2").arg(kind, size);
}

QString outsideMapText(const PlaceName& place)
{
    //: %1 is the name of a place
    return QCoreApplication::translate("PlaceName", "%1 is outside the map.")
        .arg(isolated(QString::fromStdString(place.name)));
}

QString noNamesText(const Body* body)
{
    const QString how =
        QCoreApplication::translate("PlaceName", "Open a file of names with File › Open Names…");
    const QString why =
        body == nullptr ? QCoreApplication::translate("PlaceName", "No names on an unknown body.")
                        //: %1 is a body: "Venus", "the Earth"
                        : QCoreApplication::translate("PlaceName", "No names on %1.")
                              .arg(bodyInSentence(*body));
    return why + QLatin1Char('\n') + how;
}

QString notFoundText(const QString& text, const Gazetteer& names)
{
    const QString nearest = QString::fromStdString(names.nearest(text.trimmed().toStdString()));
    const Body* const body = names.body();
    const QString why =
        body != nullptr
            //: %1 is a text that was typed, %2 a body
            ? QCoreApplication::translate("PlaceName", "No place on %2 is named “%1”.")
                  .arg(isolated(text.trimmed()), bodyInSentence(*body))
            : QCoreApplication::translate("PlaceName", "No place is named “%1”.")
                  .arg(isolated(text.trimmed()));
    return nearest.isEmpty() ? why
                             : why + QLatin1Char('\n') +
                                   QCoreApplication::translate("PlaceName", "Did you mean “%1”?")
                                       .arg(isolated(nearest));
}

} // namespace marsview
