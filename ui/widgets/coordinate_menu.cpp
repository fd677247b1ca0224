#include "ui/widgets/coordinate_menu.h"

#include "ui/text/body_text.h"
#include "ui/text/coordinate_text.h"
#include "ui/text/sentence.h"

#include <QActionGroup>
#include <QCoreApplication>
#include <QMenu>

namespace marsview {
namespace {

QString capitalized(QString text)
{
    if (!text.isEmpty()) {
        text[0] = text[0].toUpper();
    }
    return text;
}

} // namespace

QString longitudeNotationText(LongitudeNotation notation)
{
    switch (notation) {
    case LongitudeNotation::East360:
        //: A range of longitudes
        return QCoreApplication::translate("CoordinateMenu", "0° to 360° East");
    case LongitudeNotation::EastWest180:
        //: A range of longitudes
        return QCoreApplication::translate("CoordinateMenu", "180° West to 180° East");
    case LongitudeNotation::West360:
        break;
    }
    //: A range of longitudes
    return QCoreApplication::translate("CoordinateMenu", "0° to 360° West");
}

QString usualLongitudesText(const Body* body)
{
    if (body == nullptr) {
        //: The range of longitudes that suits the map's body
        return QCoreApplication::translate("CoordinateMenu", "Default for the Body");
    }
    const QString name = bodyName(*body);
    //: The range of longitudes that suits a body: %1 is its name, %2 the range
    return QCoreApplication::translate("CoordinateMenu", "Default for %1 (%2)")
        .arg(name, longitudeNotationText(CoordinateFormat{}.longitudesOn(body)));
}

void fillCoordinateMenu(QMenu& menu,
                        const CoordinateFormat& format,
                        const RasterInfo& info,
                        const std::function<void(const CoordinateFormat&)>& chosen)
{
    const bool has_longitudes = info.crs && info.crs->ellipsoid();
    const PositionSystem system = systemOn(format, info);
    const auto add_group = [&menu] {
        auto* group = new QActionGroup(&menu);
        return group;
    };
    const auto add = [&](QActionGroup* group, const QString& text, bool is_checked,
                         const CoordinateFormat& result) {
        QAction* action = menu.addAction(text);
        action->setCheckable(true);
        action->setChecked(is_checked);
        group->addAction(action);
        QObject::connect(action, &QAction::triggered, &menu, [chosen, result] { chosen(result); });
        return action;
    };

    QActionGroup* notations = add_group();
    const auto add_angles = [&](const QString& text, AngleNotation angles) {
        CoordinateFormat result = format;
        result.system = PositionSystem::Geographic;
        result.angles = angles;
        add(notations, text, system == PositionSystem::Geographic && format.angles == angles,
            result)
            ->setEnabled(has_longitudes);
    };
    add_angles(QCoreApplication::translate("CoordinateMenu", "&Decimal Degrees"),
               AngleNotation::DecimalDegrees);
    add_angles(QCoreApplication::translate("CoordinateMenu", "Degrees, &Minutes, Seconds"),
               AngleNotation::DegreesMinutesSeconds);
    CoordinateFormat map_format = format;
    map_format.system = PositionSystem::Map;
    //: %1 is the CRS
    const QString crs = withoutMnemonics(formatName(map_format, info));
    add(notations, QCoreApplication::translate("CoordinateMenu", "Ma&p Coordinates: %1").arg(crs),
        system == PositionSystem::Map, map_format);

    //: A part of a menu
    menu.addSection(QCoreApplication::translate("CoordinateMenu", "Longitude"));
    QActionGroup* longitudes = add_group();
    const auto add_longitudes = [&](const QString& text,
                                    std::optional<LongitudeNotation> notation) {
        CoordinateFormat result = format;
        result.longitudes = notation;
        add(longitudes, text, format.longitudes == notation, result);
    };
    add_longitudes(usualLongitudesText(info.body), std::nullopt);
    for (const auto notation :
         {LongitudeNotation::East360, LongitudeNotation::EastWest180, LongitudeNotation::West360}) {
        add_longitudes(longitudeNotationText(notation), notation);
    }
    longitudes->setEnabled(system == PositionSystem::Geographic);

    if (!hasKindsOfLatitude(info)) {
        return;
    }
    const QString body = info.body != nullptr
                             ? bodyName(*info.body)
                             : QCoreApplication::translate("CoordinateMenu", "This Body");
    //: A part of a menu; %1 is a body
    menu.addSection(QCoreApplication::translate("CoordinateMenu", "Latitude on %1").arg(body));
    QActionGroup* latitudes = add_group();
    for (const LatitudeKind kind : {LatitudeKind::Planetocentric, LatitudeKind::Planetographic}) {
        CoordinateFormat result = format;
        result.setLatitudesOn(info.body, kind);
        add(latitudes, capitalized(latitudeKindName(kind, info)),
            format.latitudesOn(info.body) == kind, result);
    }
    latitudes->setEnabled(system == PositionSystem::Geographic);
}

} // namespace marsview
