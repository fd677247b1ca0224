#include "ui/panels/georeferencing_panel.h"

#include "core/geo/extent.h"
#include "core/session/map.h"
#include "ui/panels/override_form.h"
#include "ui/text/body_text.h"
#include "ui/text/coordinate_text.h"
#include "ui/text/core_text.h"
#include "ui/text/sentence.h"
#include "ui/widgets/caption.h"
#include "ui/widgets/elided_label.h"
#include "ui/widgets/scroll_area.h"

#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <QScrollArea>
#include <QStackedWidget>
#include <QStyle>
#include <QVBoxLayout>
#include <QVariantAnimation>

#include <algorithm>
#include <cmath>
#include <utility>

namespace marsview {
namespace {

// For display only: nine digits resolve a millimeter in 1000 km.
QString number(double value)
{
    return shortNumberText(value, 9);
}

// One that may be wider than the panel, where no line can break: PROJ's names of methods.
bool hasLongWord(const QString& text)
{
    constexpr qsizetype kLettersMax = 24;
    const QStringList words = text.split(QLatin1Char(' '));
    return std::any_of(words.begin(), words.end(),
                       [](const QString& word) { return word.size() > kLettersMax; });
}

QLabel* makeFact(QWidget* parent)
{
    auto* label = new QLabel(parent);
    label->setWordWrap(true);
    // By the layout: a number alone has no direction.
    label->setAlignment(QStyle::visualAlignment(label->layoutDirection(), Qt::AlignLeft) |
                        Qt::AlignAbsolute | Qt::AlignVCenter);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
    return label;
}

QStringList overriddenNames(const RasterOverrides& overrides)
{
    QStringList names;
    const auto add = [&names](bool is_set, const QString& name) {
        if (is_set) {
            names.append(name);
        }
    };
    add(overrides.crs.has_value(), GeoreferencingPanel::tr("CRS"));
    add(overrides.body.has_value(), GeoreferencingPanel::tr("body"));
    add(overrides.ellipsoid.has_value(), GeoreferencingPanel::tr("radii"));
    add(overrides.transform.has_value(), GeoreferencingPanel::tr("geotransform"));
    add(overrides.vertical_unit.has_value(), GeoreferencingPanel::tr("elevation unit"));
    add(overrides.scale.has_value(), GeoreferencingPanel::tr("scale"));
    add(overrides.offset.has_value(), GeoreferencingPanel::tr("offset"));
    add(overrides.vertical_datum.has_value(), GeoreferencingPanel::tr("vertical datum"));
    add(overrides.nodata.has_value(), GeoreferencingPanel::tr("nodata"));
    return names;
}

} // namespace

GeoreferencingPanel::GeoreferencingPanel(QWidget* parent)
    : QWidget(parent)
    , pages_(new QStackedWidget(this))
{
    makeFactsPage();
    makeForm();
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(pages_);
    override_button_->setEnabled(false);
    fillFacts();
}

void GeoreferencingPanel::makeFactsPage()
{
    facts_page_ = makeScrollArea(pages_);
    QScrollArea* scroll = facts_page_;
    auto* content = new QWidget(scroll);
    auto* layout = new QVBoxLayout(content);
    facts_ = new QVBoxLayout;
    facts_->setSpacing(0);
    // What is unusual is seen without scrolling.
    notices_ = new QVBoxLayout;
    notices_->setContentsMargins(0, 0, 0, 6);
    layout->addLayout(notices_);
    layout->addLayout(facts_);
    override_button_ = new QPushButton(tr("Set &Body, CRS…"), content);
    override_button_->setObjectName(QStringLiteral("override"));
    override_button_->setToolTip(
        tr("Set what the file lacks or states wrongly; the file itself is never changed"));
    connect(override_button_, &QPushButton::clicked, this, &GeoreferencingPanel::edit);
    layout->addWidget(override_button_, 0, Qt::AlignLeft);
    layout->addStretch(1);
    scroll->setWidget(content);
    pages_->addWidget(scroll);
}

void GeoreferencingPanel::makeForm()
{
    form_ = new OverrideForm(pages_);
    connect(form_, &OverrideForm::overridesRequested, this,
            &GeoreferencingPanel::overridesRequested);
    connect(form_, &OverrideForm::closed, this, [this] {
        pages_->setCurrentWidget(facts_page_);
        override_button_->setFocus();
    });
    pages_->addWidget(form_);
}

void GeoreferencingPanel::setMap(const std::shared_ptr<const Map>& map, bool is_nodata_assumed)
{
    const bool was_assumed = std::exchange(is_nodata_assumed_, is_nodata_assumed);
    if (map == map_) {
        if (is_nodata_assumed != was_assumed) {
            fillFacts();
        }
        return;
    }
    // A preview that is replaced by its map closes no form.
    const bool is_same = map_ && map && map_->spec() == map->spec();
    map_ = map;
    form_->setMap(map);
    override_button_->setEnabled(map_ != nullptr);
    fillFacts();
    if (!is_same) {
        pages_->setCurrentWidget(facts_page_); // shows the applied overrides
    }
}

void GeoreferencingPanel::edit()
{
    if (map_) {
        pages_->setCurrentWidget(form_);
        form_->focusFirstField();
    }
}

void GeoreferencingPanel::showNotice(const QString& notice, NoticeFocus focus)
{
    pages_->setCurrentWidget(facts_page_);
    const QString text = QStringLiteral("• ") + asSentence(notice);
    for (int i = 0; i < notices_->count(); ++i) {
        auto* label = qobject_cast<QLabel*>(notices_->itemAt(i)->widget());
        if (label != nullptr && label->text() == text) {
            if (focus == NoticeFocus::Take) {
                label->setFocus(Qt::OtherFocusReason);
            }
            // Queued: a panel that was closed has no layout yet.
            QMetaObject::invokeMethod(
                label, [this, label] { facts_page_->ensureWidgetVisible(label); },
                Qt::QueuedConnection);
            flash(*label);
        }
    }
}

// A tint of the accent color that fades away.
void GeoreferencingPanel::flash(QLabel& label)
{
    constexpr int kDuration = 1600; // ms
    label.setAutoFillBackground(true);
    auto* animation = new QVariantAnimation(&label);
    animation->setDuration(kDuration);
    animation->setStartValue(0.6);
    animation->setEndValue(0.0);
    connect(animation, &QVariantAnimation::valueChanged, &label, [&label, this](const QVariant& v) {
        QPalette colors = palette();
        QColor accent = colors.color(QPalette::Highlight);
        accent.setAlphaF(static_cast<float>(v.toDouble()));
        colors.setColor(QPalette::Window, accent);
        label.setPalette(colors);
    });
    connect(animation, &QVariantAnimation::finished, &label, [&label] {
        label.setAutoFillBackground(false);
        label.setPalette(QPalette());
    });
    animation->start(QAbstractAnimation::DeleteWhenStopped);
}

void GeoreferencingPanel::showFailure(const QString& problem)
{
    edit();
    form_->showFailure(problem);
}

void GeoreferencingPanel::setHeightUnit(HeightUnit unit)
{
    unit_of_heights_ = unit;
    fillFacts();
}

void GeoreferencingPanel::setCoordinateFormat(const CoordinateFormat& format)
{
    if (format != coordinates_) {
        coordinates_ = format;
        fillFacts();
    }
}

void GeoreferencingPanel::fillFacts()
{
    while (QLayoutItem* item = facts_->takeAt(0)) {
        delete item->widget();
        delete item;
    }
    while (QLayoutItem* item = notices_->takeAt(0)) {
        item->widget()->deleteLater();
        delete item;
    }
    if (!map_) {
        addNotice(tr("No layer is open."));
        return;
    }
    addPlaceFacts(*map_);
    addSampleFacts(*map_);
    for (const std::string& notice : map_->info().notices) {
        addNotice(QStringLiteral("• ") + asSentence(notice));
    }
}

void GeoreferencingPanel::addNotice(const QString& text)
{
    QLabel* label = makeFact(facts_page_);
    label->setObjectName(QStringLiteral("notice"));
    label->setText(text);
    label->setAccessibleName(text);
    label->setContentsMargins(4, 3, 4, 3);
    notices_->addWidget(label);
}

// Above its value because a narrow panel cannot fit them in one line.
void GeoreferencingPanel::addCaption(const QString& name)
{
    QLabel* caption = makeCaption(name, this);
    caption->setContentsMargins(0, facts_->isEmpty() ? 0 : 6, 0, 0);
    facts_->addWidget(caption);
}

QLabel* GeoreferencingPanel::addFact(const QString& name, const QString& value)
{
    addCaption(name);
    QLabel* fact = makeFact(this);
    QStringList lines = value.split(QLatin1Char('\n'));
    std::transform(lines.begin(), lines.end(), lines.begin(), isolated);
    fact->setText(lines.join(QLatin1Char('\n')));
    fact->setAccessibleName(name);
    facts_->addWidget(fact);
    return fact;
}

// A value that may be longer than the panel is wide: on one line, to be read whole in its tool tip.
void GeoreferencingPanel::addLongFact(const QString& name, const QString& value)
{
    addCaption(name);
    auto* fact = new ElidedLabel(value, this);
    fact->setAccessibleName(name);
    facts_->addWidget(fact);
}

void GeoreferencingPanel::addPlaceFacts(const Map& map)
{
    const RasterInfo& info = map.info();
    const Georeference georeference = georeferenceOf(info); // a preview's pixels are larger
    const QString unknown = tr("unknown");
    addLongFact(tr("File"), QString::fromStdString(map.spec().path));
    addFact(tr("Body"), info.body != nullptr ? bodyName(*info.body) : unknown);
    if (info.crs && info.crs->ellipsoid()) {
        const Ellipsoid& e = *info.crs->ellipsoid();
        //: Radii of an ellipsoid
        addFact(
            tr("Radii"),
            e.isSphere()
                ? tr("%1 m, sphere").arg(number(e.equatorial_m))
                //: Radii: %1 equatorial, %2 polar
                : tr("%1 m equatorial\n%2 m polar").arg(number(e.equatorial_m), number(e.polar_m)));
    } else {
        addFact(tr("Radii"), unknown);
    }
    const QString crs_name = info.crs ? QString::fromStdString(info.crs->name()) : QString();
    if (hasLongWord(crs_name)) {
        addLongFact(tr("CRS"), crs_name);
    } else {
        addFact(tr("CRS"), info.crs ? (crs_name.isEmpty() ? tr("unnamed") : crs_name) : tr("none"));
    }
    if (info.crs) {
        addLongFact(tr("CRS definition (WKT)"), QString::fromStdString(info.crs->wkt()));
    }
    const GeoTransform& transform = georeference.transform();
    const bool is_geographic = info.crs && info.crs->kind() == CrsKind::Geographic;
    const QString unit =
        is_geographic ? QStringLiteral("°")
                      : QLatin1Char(' ') + (!info.crs ? tr("map units")
                                            : info.crs->unit() == 1.0
                                                ? QStringLiteral("m")
                                                : QString::fromStdString(info.crs->unitName()));
    const auto size = [is_geographic, &unit](double value) {
        return is_geographic ? pixelAngleText(value) : number(value) + unit;
    };
    const QString width = size(transform.pixelWidth());
    const QString height = size(transform.pixelHeight());
    const auto meters = [](double value) { return shortNumberText(value, 6); };
    //: The width and height of a pixel
    QString pixel = width == height ? width : tr("%1 × %2").arg(width, height);
    const bool is_in_meters = info.crs && !is_geographic && info.crs->unit() == 1.0;
    if (!is_in_meters) {
        const QString in_meters = tr("%1 × %2 m")
                                      .arg(meters(georeference.pixelWidthMeters()),
                                           meters(georeference.pixelHeightMeters()));
        pixel += QLatin1Char('\n') + (info.crs ? in_meters : tr("%1, assumed").arg(in_meters));
    }
    QLabel* const fact = addFact(tr("Pixel size"), pixel);
    if (is_geographic) {
        constexpr int kExactDigits = 12;
        fact->setToolTip(leftToRight(
            //: The exact width and height of a pixel in degrees
            tr("%1° × %2°")
                .arg(shortNumberText(transform.pixelWidth(), kExactDigits),
                     shortNumberText(transform.pixelHeight(), kExactDigits))));
    }
    const MapExtent extent = mapExtent(georeference);
    if (!is_geographic) {
        const auto range = [](double low, double high) {
            //: A range of map coordinates
            return leftToRight(tr("%1 – %2").arg(number(low), number(high)));
        };
        //: The ranges of map coordinates
        addFact(tr("Extent"),
                tr("x %1\ny %2")
                    .arg(range(extent.low.x, extent.high.x), range(extent.low.y, extent.high.y)));
    }
    if (const auto place = geographicExtent(georeference)) {
        const ExtentText text = extentText(*place, coordinates_, info);
        //: The kind of latitude in brackets
        addFact(
            tr("Latitude (%1)").arg(latitudeKindName(coordinates_.latitudesOn(info.body), info)),
            text.latitudes);
        addFact(tr("Longitude"), text.longitudes);
    }
    const GeoTransform::Terms& t = transform.terms();
    addFact(tr("Geotransform"), info.transform ? tr("%1, %2, %3\n%4, %5, %6")
                                                     .arg(number(t[0]), number(t[1]), number(t[2]),
                                                          number(t[3]), number(t[4]), number(t[5]))
                                               : tr("none"));
}

void GeoreferencingPanel::addSampleFacts(const Map& map)
{
    const RasterInfo& info = map.info();
    //: %1 columns and %2 rows of samples, of type %3
    addFact(tr("Samples"), tr("%1 × %2, %3")
                               .arg(countText(info.columns), countText(info.rows),
                                    textFrom(sampleTypeName(info.type))));
    if (const auto& range = map.heightfield().range()) {
        addFact(tr("Elevations"), heightRangeText(*range, unit_of_heights_));
    }
    const QString unit = QString::fromStdString(info.unit.name);
    addFact(tr("Elevation unit"), info.is_unit_declared ? unit : tr("%1, assumed").arg(unit));
    const QString datum = datumText(info);
    addFact(tr("Vertical datum"), datum.isEmpty() ? tr("unknown") : datum);
    if (info.scale != 1.0 || info.offset != 0.0) {
        //: How elevations follow from samples: %1 is the factor, %2 the offset, %3 their unit
        addFact(tr("Scale, offset"),
                tr("%1, %2 %3").arg(number(info.scale), number(info.offset), unit));
    }
    const QString nodata = info.nodata ? sampleText(*info.nodata) : tr("none");
    addFact(tr("Nodata"), is_nodata_assumed_ ? tr("%1, assumed").arg(nodata) : nodata);
    addFact(tr("Format"), QString::fromStdString(info.driver));
    RasterOverrides set_by_user = map.spec().overrides;
    if (is_nodata_assumed_) {
        set_by_user.nodata.reset();
    }
    const QStringList changed = overriddenNames(set_by_user);
    if (!changed.isEmpty()) {
        addFact(tr("Set by you"), QLocale().createSeparatedList(changed));
    }
}

} // namespace marsview
