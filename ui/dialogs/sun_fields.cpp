#include "ui/dialogs/sun_fields.h"

#include "core/geo/coordinate_entry.h"
#include "ui/text/coordinate_text.h"

#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QRegularExpression>
#include <QVBoxLayout>

#include <string>

namespace marsview {
namespace {

constexpr int kSunDecimals = 2; // of a degree
constexpr int kLatitudeWidth = 22;

const QRegularExpression& directions()
{
    static const QRegularExpression kDirections(QStringLiteral("[NSEWnsew]"));
    return kDirections;
}

enum class Axis { Latitude, Longitude };

// A coordinate alone: the other one is a stand-in, with a letter where this one has one, and on the
// same side of its number.
Result<WrittenPlace> coordinateFrom(const QString& typed, Axis axis, BareLongitude bare)
{
    const QString text = withPlainDirections(typed).trimmed();
    const bool is_latitude = axis == Axis::Latitude;
    QString other = QStringLiteral("0");
    if (text.contains(directions())) {
        const bool is_leading = directions().match(text.left(1)).hasMatch();
        const QString letter = is_latitude ? QStringLiteral("E") : QStringLiteral("N");
        other = is_leading ? letter + QStringLiteral(" 0") : QStringLiteral("0 ") + letter;
    }
    const QString both =
        (is_latitude ? text : other) + QStringLiteral("; ") + (is_latitude ? other : text);
    return placeFrom(both.toStdString(), bare);
}

// Both coordinates in one field, as they are copied from elsewhere.
std::optional<WrittenPlace> pairFrom(const QString& typed)
{
    const QString text = withPlainDirections(typed);
    if (text.count(directions()) != 2) {
        return std::nullopt;
    }
    const Result<WrittenPlace> place = placeFrom(text.toStdString());
    return place ? std::optional(*place) : std::nullopt;
}

} // namespace

SunFields::SunFields(QWidget* parent)
    : QWidget(parent)
    , latitude_(new QLineEdit(this))
    , longitude_(new QLineEdit(this))
    , problem_(new QLabel(this))
    , overhead_(new QPushButton(tr("&Sun Overhead at the Picture’s Center"), this))
{
    latitude_->setObjectName(QStringLiteral("subsolar latitude"));
    longitude_->setObjectName(QStringLiteral("subsolar longitude"));
    latitude_->setAccessibleName(tr("Latitude of the subsolar point"));
    longitude_->setAccessibleName(tr("Longitude of the subsolar point"));
    overhead_->setObjectName(QStringLiteral("sun overhead"));
    overhead_->setToolTip(tr("Light the place in the middle of the picture from straight above"));
    for (QLineEdit* field : {latitude_, longitude_}) {
        field->setMinimumWidth(field->fontMetrics().averageCharWidth() * kLatitudeWidth);
        connect(field, &QLineEdit::editingFinished, this, &SunFields::enter);
        connect(field, &QLineEdit::textEdited, problem_, &QLabel::hide);
    }
    problem_->setObjectName(QStringLiteral("subsolar problem"));
    problem_->setWordWrap(true);
    problem_->hide();
    auto* form = new QFormLayout;
    form->addRow(tr("L&atitude"), latitude_);
    form->addRow(tr("Lon&gitude"), longitude_);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    //: Above the fields for a latitude and a longitude
    layout->addWidget(new QLabel(tr("The sun is overhead at"), this));
    layout->addLayout(form);
    layout->addWidget(problem_);
    layout->addWidget(overhead_);
    connect(overhead_, &QPushButton::clicked, this, &SunFields::overheadRequested);
}

void SunFields::setCoordinateFormat(const CoordinateFormat& format)
{
    format_ = format;
    show();
}

void SunFields::setBody(const RasterInfo& info)
{
    info_ = info;
    show();
}

void SunFields::setPoint(const GeographicPoint& point)
{
    if (point != point_) { // what is being typed stays
        point_ = point;
        restore();
    }
}

void SunFields::restore()
{
    latitude_->setModified(false);
    longitude_->setModified(false);
    problem_->hide();
    show();
}

// Texts that are being edited stay.
void SunFields::show()
{
    const bool has_ellipsoid = info_.crs && info_.crs->ellipsoid();
    const LatitudeKind kind = format_.latitudesOn(info_.body);
    const bool is_graphic = has_ellipsoid && kind == LatitudeKind::Planetographic;
    const int digits = format_.angles == AngleNotation::DecimalDegrees ? kSunDecimals : 0;
    if (!latitude_->isModified()) {
        latitude_->setText(latitudeText(
            is_graphic ? info_.crs->ellipsoid()->planetographic(point_.latitude) : point_.latitude,
            format_, digits));
        latitude_->setCursorPosition(0);
    }
    if (!longitude_->isModified()) {
        longitude_->setText(longitudeText(point_.longitude, format_, info_.body, digits));
        longitude_->setCursorPosition(0);
    }
    const QString tip =
        tr("The sun is overhead at this place. Type degrees, or degrees, minutes "
           "and seconds.");
    longitude_->setToolTip(tip);
    latitude_->setToolTip(hasKindsOfLatitude(info_)
                              //: %1 is a kind of latitude, such as planetocentric
                              ? tr("The sun is overhead at this place. Type degrees, or degrees, "
                                   "minutes and seconds. The latitude is %1.")
                                    .arg(latitudeKindName(kind, info_))
                              : tip);
}

void SunFields::enter()
{
    if (!latitude_->isModified() && !longitude_->isModified()) {
        return;
    }
    const BareLongitude bare = format_.longitudesOn(info_.body) == LongitudeNotation::West360
                                   ? BareLongitude::West
                                   : BareLongitude::East;
    GeographicPoint point = point_;
    const auto set_latitude = [&](Angle written) {
        const bool is_graphic = info_.crs && info_.crs->ellipsoid() &&
                                format_.latitudesOn(info_.body) == LatitudeKind::Planetographic;
        point.latitude = is_graphic ? info_.crs->ellipsoid()->planetocentric(written) : written;
    };
    const auto refuse = [this](const QString& why) {
        problem_->setText(why);
        problem_->show();
    };
    for (QLineEdit* field : {latitude_, longitude_}) {
        if (!field->isModified()) {
            continue;
        }
        if (const auto both = pairFrom(field->text())) {
            set_latitude(both->latitude);
            point.longitude = both->longitude;
            continue;
        }
        const bool is_latitude = field == latitude_;
        const Result<WrittenPlace> place =
            coordinateFrom(field->text(), is_latitude ? Axis::Latitude : Axis::Longitude, bare);
        if (!place && place.error().code == ErrorCode::OutOfRange) {
            refuse(is_latitude ? tr("Latitudes range from 90° S to 90° N.")
                               : tr("Longitudes range from 360° W to 360° E."));
            return;
        }
        if (!place) {
            // Examples are the same in every language.
            refuse(
                is_latitude
                    //: %1 is an example
                    ? tr("This is not a latitude, such as %1.").arg(QStringLiteral("18.65\u00A0N"))
                    //: %1 is an example
                    : tr("This is not a longitude, such as %1.")
                          .arg(QStringLiteral("226.2\u00A0E")));
            return;
        }
        if (is_latitude) {
            set_latitude(place->latitude);
        } else {
            point.longitude = place->longitude;
        }
    }
    point_ = point;
    restore();
    Q_EMIT pointChosen(point);
}

} // namespace marsview
