#include "ui/dialogs/coordinates_page.h"

#include "ui/text/body_text.h"
#include "ui/text/coordinate_text.h"
#include "ui/text/core_text.h"
#include "ui/widgets/coordinate_menu.h"

#include <QComboBox>
#include <QFormLayout>
#include <QGridLayout>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include <array>
#include <cstddef>

namespace marsview {
namespace {

enum class Notation { Decimal, Sexagesimal, Map };
constexpr std::array kNotations{Notation::Decimal, Notation::Sexagesimal, Notation::Map};

constexpr int kUsual = -1;

// West of the prime meridian, at a middle latitude: all formats differ.
constexpr Angle kExampleLongitude = Angle::degrees(-133.8);
constexpr Angle kExampleLatitude = Angle::degrees(18.65);

Notation notationOf(const CoordinateFormat& format)
{
    return format.system == PositionSystem::Map             ? Notation::Map
           : format.angles == AngleNotation::DecimalDegrees ? Notation::Decimal
                                                            : Notation::Sexagesimal;
}

AngleNotation anglesOf(Notation notation)
{
    return notation == Notation::Decimal ? AngleNotation::DecimalDegrees
                                         : AngleNotation::DegreesMinutesSeconds;
}

QString notationText(Notation notation)
{
    switch (notation) {
    case Notation::Decimal:
        return CoordinatesPage::tr("Decimal degrees");
    case Notation::Sexagesimal:
        return CoordinatesPage::tr("Degrees, minutes, seconds");
    case Notation::Map:
        return CoordinatesPage::tr("Map coordinates (CRS)");
    }
    return {};
}

} // namespace

CoordinatesPage::CoordinatesPage(QWidget* parent)
    : QWidget(parent)
    , notation_(new QComboBox(this))
    , longitudes_(new QComboBox(this))
    , body_(new QComboBox(this))
    , latitudes_(new QComboBox(this))
{
    notation_->setAccessibleName(tr("Coordinate format"));
    for (const Notation notation : kNotations) {
        notation_->addItem(notationText(notation), static_cast<int>(notation));
    }
    longitudes_->setAccessibleName(tr("Range of longitudes"));
    //: The range of longitudes that suits each body
    longitudes_->addItem(tr("Default for the body"), kUsual);
    for (const auto notation :
         {LongitudeNotation::East360, LongitudeNotation::EastWest180, LongitudeNotation::West360}) {
        longitudes_->addItem(longitudeNotationText(notation), static_cast<int>(notation));
    }
    body_->setAccessibleName(tr("Body whose kind of latitude is chosen"));
    body_->setObjectName(QStringLiteral("latitudeBody"));
    for (const Body& body : knownBodies()) {
        body_->addItem(bodyName(body), textFrom(body.name));
    }
    latitudes_->setAccessibleName(tr("Kind of latitude on the body"));
    latitudes_->setObjectName(QStringLiteral("latitudeKind"));
    auto* format_group = new QGroupBox(tr("Format"), this);
    auto* format = new QFormLayout(format_group);
    format->addRow(tr("&Coordinates"), notation_);
    format->addRow(tr("&Longitude"), longitudes_);
    auto* latitude_row = new QHBoxLayout;
    latitude_row->addWidget(body_);
    latitude_row->addWidget(latitudes_, 1);
    //: In front of a body and a kind of latitude
    auto* latitude_label = new QLabel(tr("L&atitude on"), this);
    latitude_label->setBuddy(body_);
    format->addRow(latitude_label, latitude_row);
    //: A group: one place in each format of coordinates
    auto* example_group = new QGroupBox(tr("Examples"), this);
    auto* examples = new QGridLayout(example_group);
    addExamples(*examples);
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(format_group);
    layout->addWidget(example_group);
    layout->addStretch(1);
    setBody(nullptr);
    fill({});

    const auto notify = [this] {
        showExamples();
        Q_EMIT changed();
    };
    connect(notation_, &QComboBox::currentIndexChanged, this, [this, notify] {
        const auto notation = static_cast<Notation>(notation_->currentData().toInt());
        format_.system =
            notation == Notation::Map ? PositionSystem::Map : PositionSystem::Geographic;
        if (notation != Notation::Map) {
            format_.angles = anglesOf(notation);
        }
        notify();
    });
    connect(longitudes_, &QComboBox::currentIndexChanged, this, [this, notify] {
        const int value = longitudes_->currentData().toInt();
        format_.longitudes =
            value == kUsual ? std::nullopt : std::optional(static_cast<LongitudeNotation>(value));
        notify();
    });
    connect(body_, &QComboBox::currentIndexChanged, this, [this] {
        showLatitudes();
        showExamples();
    });
    connect(latitudes_, &QComboBox::currentIndexChanged, this, [this, notify] {
        format_.setLatitudesOn(bodyNamed(body_->currentData().toString().toStdString()),
                               static_cast<LatitudeKind>(latitudes_->currentData().toInt()));
        notify();
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
    showExamples();
}

void CoordinatesPage::setBody(const Body* body)
{
    body_->setCurrentText(bodyName(body != nullptr ? body->name : "Mars"));
}

void CoordinatesPage::addExamples(QGridLayout& grid)
{
    for (std::size_t i = 0; i < kNotations.size(); ++i) {
        const QString name = notationText(kNotations[i]);
        examples_[i] = {.name = new QLabel(name, this), .text = new QLabel(this)};
        examples_[i].text->setAccessibleName(name);
        examples_[i].text->setObjectName(QStringLiteral("example%1").arg(i));
        examples_[i].text->setTextInteractionFlags(Qt::TextSelectableByMouse);
        const int row = static_cast<int>(i);
        grid.addWidget(examples_[i].name, row, 0);
        grid.addWidget(examples_[i].text, row, 1);
    }
    grid.setColumnStretch(1, 1);
    grid.setHorizontalSpacing(16);
}

void CoordinatesPage::showLatitudes()
{
    const QSignalBlocker blocker(latitudes_);
    const Body* body = bodyNamed(body_->currentData().toString().toStdString());
    RasterInfo info;
    info.body = body;
    latitudes_->clear();
    for (const LatitudeKind kind : {LatitudeKind::Planetocentric, LatitudeKind::Planetographic}) {
        QString name = latitudeKindName(kind, info);
        name[0] = name[0].toUpper();
        latitudes_->addItem(name, static_cast<int>(kind));
    }
    latitudes_->setCurrentIndex(latitudes_->findData(static_cast<int>(format_.latitudesOn(body))));
    const bool has_kinds = !body->ellipsoid.isSphere();
    latitudes_->setEnabled(has_kinds);
    latitudes_->setToolTip(has_kinds ? QString()
                                     : tr("All kinds of latitude are the same on a sphere"));
}

// A place that shows all differences: west of the meridian, at a middle latitude. The chosen
// notation stands out.
void CoordinatesPage::showExamples()
{
    RasterInfo info;
    info.body = bodyNamed(body_->currentData().toString().toStdString());
    info.crs = Crs::geographic(*info.body, info.body->ellipsoid);
    for (std::size_t i = 0; i < kNotations.size(); ++i) {
        const Notation notation = kNotations[i];
        const bool is_chosen = notation == notationOf(format_);
        for (QLabel* label : {examples_[i].name, examples_[i].text}) {
            QFont font = label->font();
            font.setBold(is_chosen);
            label->setFont(font);
        }
        if (notation == Notation::Map) {
            // Equirectangular, in meters.
            const double radius_m = info.body->ellipsoid.equatorial_m;
            examples_[i].text->setText(
                leftToRight(QStringLiteral("%1, %2 m")
                                .arg(numberText(radius_m * kExampleLongitude.radians(), 0),
                                     numberText(radius_m * kExampleLatitude.radians(), 0))));
            continue;
        }
        CoordinateFormat format = format_;
        format.system = PositionSystem::Geographic;
        format.angles = anglesOf(notation);
        const int digits = digitsFor(
            format.angles, Angle::degrees(notation == Notation::Decimal ? 0.01 : 1.0 / 3600.0));
        examples_[i].text->setText(geographicText(
            {.longitude = kExampleLongitude, .latitude = kExampleLatitude}, format, info, digits));
    }
}

} // namespace marsview
