#include "ui/text/place_name_text.h"

#include "ui/text/body_text.h"
#include "ui/text/number_text.h"

#include <QCoreApplication>

namespace marsview {
namespace {

QString translated(const char* text)
{
    return QCoreApplication::translate("PlaceName", text);
}

// Meters below a kilometer, tenths below ten kilometers, else whole kilometers.
QString sizeText(double diameter_m)
{
    constexpr double kMetersPerKilometer = 1000.0;
    if (diameter_m < kMetersPerKilometer) {
        return withUnit(numberText(diameter_m, 0), translated("m"));
    }
    const double diameter_km = diameter_m / kMetersPerKilometer;
    return withUnit(numberText(diameter_km, diameter_km < 10.0 ? 1 : 0), translated("km"));
}

} // namespace

QString placeKindText(PlaceKind kind)
{
    switch (kind) {
    case PlaceKind::Other:
        return {};
    case PlaceKind::LetteredCrater:
    case PlaceKind::Crater:
        return translated("crater");
    case PlaceKind::Canyon:
        return translated("canyon");
    case PlaceKind::Cape:
        return translated("cape");
    case PlaceKind::Chaos:
        return translated("chaotic terrain");
    case PlaceKind::CraterChain:
        return translated("crater chain");
    case PlaceKind::Dunes:
        return translated("dunes");
    case PlaceKind::Hollow:
        return translated("hollow");
    case PlaceKind::LandingSite:
        return translated("landing site");
    case PlaceKind::Mountain:
        return translated("mountain");
    case PlaceKind::Plain:
        return translated("plain");
    case PlaceKind::Plateau:
        return translated("plateau");
    case PlaceKind::Region:
        return translated("region");
    case PlaceKind::Ridge:
        return translated("ridge");
    case PlaceKind::Scarp:
        return translated("scarp");
    case PlaceKind::Sea:
        //: A dark plain of lava: Mare, Oceanus, Sinus, Lacus, Palus
        return translated("sea");
    case PlaceKind::Trough:
        return translated("trough");
    case PlaceKind::Valley:
        return translated("valley");
    case PlaceKind::Volcano:
        //: Patera: a crater with scalloped edges, mostly of a volcano
        return translated("patera");
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
    return kind.isEmpty() ? size : translated("%1, %2").arg(kind, size);
}

QString outsideMapText(const PlaceName& place)
{
    //: %1 is the name of a place
    return translated("%1 is outside the map.").arg(isolated(QString::fromStdString(place.name)));
}

QString noNamesText(const Body* body)
{
    const QString how = translated("Open a file of names with File › Open Names….");
    const QString why = body == nullptr ? translated("No names on an unknown body.")
                                        //: %1 is a body: "Venus", "the Earth"
                                        : translated("No names on %1.").arg(bodyInSentence(*body));
    return why + QLatin1Char('\n') + how;
}

QString notFoundText(const QString& text, const Gazetteer& names)
{
    const QString nearest = QString::fromStdString(names.nearest(text.trimmed().toStdString()));
    const Body* const body = names.body();
    const QString why = body != nullptr
                            //: %1 is a text that was typed, %2 a body
                            ? translated("No place on %2 is named “%1”.")
                                  .arg(isolated(text.trimmed()), bodyInSentence(*body))
                            : translated("No place is named “%1”.").arg(isolated(text.trimmed()));
    return nearest.isEmpty()
               ? why
               : why + QLatin1Char('\n') + translated("Did you mean “%1”?").arg(isolated(nearest));
}

} // namespace marsview
