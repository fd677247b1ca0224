#include "ui/dialogs/coordinates_page.h"

#include "ui/text/coordinate_text.h"
#include "ui/widgets/coordinate_menu.h"

#include <QComboBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>

#include <algorithm>

namespace marsview {
namespace {

enum class Notation { Decimal, Sexagesimal, Map };

constexpr int kUsual = -1;

Notation notationOf(const CoordinateFormat& format)
{
    return format.system == PositionSystem::Map             ? Notation::Map
           : format.angles == AngleNotation::DecimalDegrees ? Notation::Decimal
                                                            : Notation::Sexagesimal;
}

QString bodyText(const Body& body)
{
    return QString::fromUtf8(body.name.data(), static_cast<qsizetype>(body.name.size()));
}

} // namespace

CoordinatesPage::CoordinatesPage(QWidget* parent)
    : QWidget(parent)
    , notation_(new QComboBox(this))
    , longitudes_(new QComboBox(this))
    , body_(new QComboBox(this))
    , latitudes_(new QComboBox(this))
    , example_(new QLabel(this))
{
    notation_->setAccessibleName(tr("Coordinate format"));
    notation_->addItem(tr("Decimal degrees"), static_cast<int>(Notation::Decimal));
    notation_->addItem(tr("Degrees, minutes, seconds"), static_cast<int>(Notation::Sexagesimal));
    notation_->addItem(tr("Map coordinates (CRS)"), static_cast<int>(Notation::Map));
    longitudes_->setAccessibleName(tr("Range of longitudes"));
    //: The range of longitudes that suits each body
    longitudes_->addItem(tr("As usual on the body"), kUsual);
    for (const auto notation :
         {LongitudeNotation::East360, LongitudeNotation::EastWest180, LongitudeNotation::West360}) {
        longitudes_->addItem(longitudeNotationText(notation), static_cast<int>(notation));
    }
    body_->setAccessibleName(tr("Body whose kind of latitude is chosen"));
    for (const Body& body : knownBodies()) {
        if (!body.ellipsoid.isSphere()) {
            body_->addItem(bodyText(body));
        }
    }
    body_->setCurrentText(QStringLiteral("Mars"));
    latitudes_->setAccessibleName(tr("Kind of latitude on the body"));
    example_->setAccessibleName(tr("Example of the coordinate format"));
    example_->setObjectName(QStringLiteral("coordinateExample"));
    auto* latitude_row = new QHBoxLayout;
    latitude_row->addWidget(body_);
    latitude_row->addWidget(latitudes_, 1);
    auto* form = new QFormLayout(this);
    form->addRow(tr("&Coordinates"), notation_);
    form->addRow(tr("&Longitude"), longitudes_);
    //: In front of a body and a kind of latitude
    auto* latitude_label = new QLabel(tr("L&atitude on"), this);
    latitude_label->setBuddy(body_);
    form->addRow(latitude_label, latitude_row);
    form->addRow(tr("Example"), example_);
    fill({});

    const auto tell = [this] {
        showExample();
        Q_EMIT changed();
    };
    connect(notation_, &QComboBox::currentIndexChanged, this, [this, tell] {
        const auto notation = static_cast<Notation>(notation_->currentData().toInt());
        format_.system =
            notation == Notation::Map ? PositionSystem::Map : PositionSystem::Geographic;
        if (notation != Notation::Map) {
            format_.angles = notation == Notation::Decimal ? AngleNotation::DecimalDegrees
                                                           : AngleNotation::DegreesMinutesSeconds;
        }
        tell();
    });
    connect(longitudes_, &QComboBox::currentIndexChanged, this, [this, tell] {
        const int value = longitudes_->currentData().toInt();
        format_.longitudes =
            value == kUsual ? std::nullopt : std::optional(static_cast<LongitudeNotation>(value));
        tell();
    });
    connect(body_, &QComboBox::currentIndexChanged, this, [this] {
        showLatitudes();
        showExample();
    });
    connect(latitudes_, &QComboBox::currentIndexChanged, this, [this, tell] {
        format_.setLatitudesOn(bodyNamed(body_->currentText().toStdString()),
                               static_cast<LatitudeKind>(latitudes_->currentData().toInt()));
        tell();
    });
}

void CoordinatesPage::fill(const CoordinateFormat& format)
{
    format_ = format;
    const QSignalBlocker notation_blocker(notation_);
    const QSignalBlocker longitudes_blocker(longitudes_);
    notation_->setCurrentIndex(notation_->findData(static_cast<int>(notationOf(format))));
    longitudes_->setCurrentIndex(
        longitudes_->findData(format.longitudes ? static_cast<int>(*format.longitudes) : kUsual));
    showLatitudes();
    showExample();
}

void CoordinatesPage::showLatitudes()
{
    const QSignalBlocker blocker(latitudes_);
    const Body* body = bodyNamed(body_->currentText().toStdString());
    RasterInfo info;
    info.body = body;
    latitudes_->clear();
    for (const LatitudeKind kind : {LatitudeKind::Planetocentric, LatitudeKind::Planetographic}) {
        QString name = latitudeKindName(kind, info);
        name[0] = name[0].toUpper();
        latitudes_->addItem(name, static_cast<int>(kind));
    }
    latitudes_->setCurrentIndex(latitudes_->findData(static_cast<int>(format_.latitudesOn(body))));
}

// A place that shows all differences: west of the meridian, at a middle latitude.
void CoordinatesPage::showExample()
{
    const Body* body = bodyNamed(body_->currentText().toStdString());
    if (body == nullptr || format_.system == PositionSystem::Map) {
        example_->setText(leftToRight(
            QStringLiteral("%1, %2 m").arg(numberText(562345.5, 1), numberText(5117890.0, 1))));
        return;
    }
    RasterInfo info;
    info.body = body;
    info.crs = Crs::geographic(*body, body->ellipsoid);
    const int digits = digitsFor(
        format_.angles,
        Angle::degrees(format_.angles == AngleNotation::DecimalDegrees ? 0.01 : 1.0 / 3600.0));
    example_->setText(
        geographicText({.longitude = Angle::degrees(-133.8), .latitude = Angle::degrees(18.65)},
                       format_, info, digits));
}

} // namespace marsview
