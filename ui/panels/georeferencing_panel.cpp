#include "ui/panels/georeferencing_panel.h"

#include "core/geo/extent.h"
#include "core/session/dataset.h"
#include "ui/coordinate_text.h"
#include "ui/panels/caption.h"

#include <QComboBox>
#include <QFormLayout>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <QPushButton>
#include <QScrollArea>
#include <QStackedWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace marsview {
namespace {

// Digits enough to read, not to compute: nine tell a millimetre from 1000 km.
QString number(double value)
{
    return shortNumberText(value, 9);
}

// Digits enough to read the same double back, always with a point: for fields.
QString exactNumber(double value)
{
    return QString::fromStdString(fmt::format("{}", value));
}

// A number as the user writes it: with a point, or as the locale has it.
std::optional<double> parsed(const QString& text)
{
    bool is_number = false;
    const double plain = QLocale::c().toDouble(text, &is_number);
    if (is_number) {
        return plain;
    }
    const double local = QLocale().toDouble(text, &is_number);
    return is_number ? std::optional(local) : std::nullopt;
}

QString fromStd(std::string_view text)
{
    return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
}

QLabel* makeFact(QWidget* parent)
{
    auto* label = new QLabel(parent);
    label->setWordWrap(true);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
    return label;
}

// Scrolls what is too tall; what is too wide wraps.
QScrollArea* makeScrollArea(QWidget* parent)
{
    auto* scroll = new QScrollArea(parent);
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    return scroll;
}

// Text that is none of the numbers asked for.
struct NotANumber {
    QString text;
};

// Nothing where the field is left empty.
std::optional<double> valueOf(const QLineEdit& field)
{
    const QString text = field.text().trimmed();
    if (text.isEmpty()) {
        return std::nullopt;
    }
    const auto value = parsed(text);
    if (!value) {
        throw NotANumber{text};
    }
    return value;
}

} // namespace

GeoreferencingPanel::GeoreferencingPanel(QWidget* parent)
    : QWidget(parent)
    , pages_(new QStackedWidget(this))
{
    facts_page_ = makeFactsPage();
    fields_page_ = makeFieldsPage();
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(pages_);
    override_button_->setEnabled(false);
    fillFacts();
    fillFields();
}

QWidget* GeoreferencingPanel::makeFactsPage()
{
    QScrollArea* scroll = makeScrollArea(pages_);
    auto* content = new QWidget(scroll);
    auto* layout = new QVBoxLayout(content);
    facts_ = new QFormLayout;
    facts_->setLabelAlignment(Qt::AlignLeft | Qt::AlignTop);
    facts_->setHorizontalSpacing(12);
    facts_->setVerticalSpacing(0);
    facts_->setRowWrapPolicy(QFormLayout::WrapAllRows);
    layout->addLayout(facts_);
    notices_ = makeFact(content);
    notices_->setAccessibleName(tr("Notices about the map"));
    layout->addWidget(notices_);
    override_button_ = new QPushButton(tr("&Override…"), content);
    override_button_->setObjectName(QStringLiteral("override"));
    override_button_->setToolTip(
        tr("Tell the body, CRS and placement; nothing is written to the file"));
    connect(override_button_, &QPushButton::clicked, this, &GeoreferencingPanel::edit);
    layout->addWidget(override_button_, 0, Qt::AlignLeft);
    layout->addStretch(1);
    scroll->setWidget(content);
    pages_->addWidget(scroll);
    return scroll;
}

QWidget* GeoreferencingPanel::makeFieldsPage()
{
    QScrollArea* scroll = makeScrollArea(pages_);
    auto* content = new QWidget(scroll);
    auto* layout = new QVBoxLayout(content);
    auto* hint = makeFact(content);
    hint->setText(tr("Empty fields stay as the file has them. Nothing is written to the file."));
    layout->addWidget(hint);
    // The dock is narrow: names stand over their fields, and no field asks for width.
    auto* form = new QFormLayout;
    form->setRowWrapPolicy(QFormLayout::WrapAllRows);
    form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    const auto make_field = [content](const QString& name, const char* object_name) {
        auto* field = new QLineEdit(content);
        field->setAccessibleName(name);
        field->setObjectName(QLatin1String(object_name));
        field->setMinimumWidth(40);
        return field;
    };
    crs_ = make_field(tr("CRS"), "crs");
    crs_->setToolTip(
        tr("Anything that GDAL understands: EPSG:32610, IAU_2015:49910, a PROJ "
           "string, WKT"));
    form->addRow(tr("&CRS"), crs_);
    body_ = new QComboBox(content);
    body_->setAccessibleName(tr("Body"));
    body_->setObjectName(QStringLiteral("body"));
    body_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    body_->setMinimumContentsLength(6);
    body_->addItem(tr("As in the file"));
    for (const Body& body : knownBodies()) {
        body_->addItem(fromStd(body.name), fromStd(body.name));
    }
    form->addRow(tr("&Body"), body_);
    equatorial_ = make_field(tr("Equatorial radius in metres"), "equatorial");
    polar_ = make_field(tr("Polar radius in metres"), "polar");
    form->addRow(tr("&Equatorial radius (m)"), equatorial_);
    form->addRow(tr("&Polar radius (m)"), polar_);
    layout->addLayout(form);

    auto* terms_label = new QLabel(tr("Geotransform, outer corner of the first pixel:"), content);
    terms_label->setWordWrap(true);
    layout->addWidget(terms_label);
    auto* grid = new QGridLayout;
    const std::array names{tr("x"), tr("x per column"), tr("x per row"),
                           tr("y"), tr("y per column"), tr("y per row")};
    for (std::size_t i = 0; i < terms_.size(); ++i) {
        terms_[i] = make_field(names[i], "");
        terms_[i]->setObjectName(QStringLiteral("term%1").arg(i));
        auto* label = new QLabel(names[i], content);
        label->setBuddy(terms_[i]);
        const int column = static_cast<int>(i / 3);
        const int row = static_cast<int>(i % 3) * 2;
        grid->addWidget(label, row, column);
        grid->addWidget(terms_[i], row + 1, column);
    }
    layout->addLayout(grid);

    auto* heights = new QFormLayout;
    heights->setRowWrapPolicy(QFormLayout::WrapAllRows);
    heights->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    unit_ = new QComboBox(content);
    unit_->setAccessibleName(tr("Height unit"));
    unit_->setObjectName(QStringLiteral("unit"));
    unit_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    unit_->setMinimumContentsLength(6);
    unit_->addItem(tr("As in the file"));
    for (const char* unit : {"m", "km", "ft", "US survey ft"}) {
        unit_->addItem(QLatin1String(unit), QLatin1String(unit));
    }
    heights->addRow(tr("&Height unit"), unit_);
    nodata_ = make_field(tr("Nodata value"), "nodata");
    heights->addRow(tr("&Nodata"), nodata_);
    layout->addLayout(heights);

    problem_ = makeFact(content);
    problem_->setAccessibleName(tr("What cannot be applied"));
    QFont bold = problem_->font();
    bold.setBold(true);
    problem_->setFont(bold);
    layout->addWidget(problem_);

    auto* apply_button = new QPushButton(tr("&Apply"), content);
    apply_button->setObjectName(QStringLiteral("apply"));
    connect(apply_button, &QPushButton::clicked, this, &GeoreferencingPanel::apply);
    auto* reset_button = new QPushButton(tr("&Reset to File"), content);
    reset_button->setObjectName(QStringLiteral("reset"));
    connect(reset_button, &QPushButton::clicked, this,
            [this] { Q_EMIT overridesRequested(RasterOverrides{}); });
    auto* back_button = new QPushButton(tr("Bac&k"), content);
    back_button->setObjectName(QStringLiteral("close"));
    connect(back_button, &QPushButton::clicked, this,
            [this] { pages_->setCurrentWidget(facts_page_); });
    auto* buttons = new QGridLayout;
    buttons->addWidget(apply_button, 0, 0);
    buttons->addWidget(back_button, 0, 1);
    buttons->addWidget(reset_button, 1, 0, 1, 2);
    for (QPushButton* button : {apply_button, back_button}) {
        button->setMinimumWidth(0);
        button->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    }
    layout->addLayout(buttons);
    layout->addStretch(1);
    for (QLineEdit* field : content->findChildren<QLineEdit*>()) {
        connect(field, &QLineEdit::returnPressed, this, &GeoreferencingPanel::apply);
    }
    scroll->setWidget(content);
    pages_->addWidget(scroll);
    return scroll;
}

void GeoreferencingPanel::setDataset(const std::shared_ptr<const Dataset>& dataset)
{
    if (dataset == dataset_) {
        return;
    }
    dataset_ = dataset;
    pages_->setCurrentWidget(facts_page_); // what was applied shows in the facts
    override_button_->setEnabled(dataset_ != nullptr);
    fillFacts();
    fillFields();
}

void GeoreferencingPanel::edit()
{
    if (dataset_) {
        pages_->setCurrentWidget(fields_page_);
        crs_->setFocus();
    }
}

void GeoreferencingPanel::setHeightUnit(HeightUnit unit)
{
    unit_of_heights_ = unit;
    fillFacts();
}

void GeoreferencingPanel::fillFacts()
{
    while (facts_->rowCount() > 0) {
        facts_->removeRow(0);
    }
    notices_->clear();
    if (!dataset_) {
        notices_->setText(tr("No map is open."));
        notices_->show();
        return;
    }
    addPlaceFacts(*dataset_);
    addSampleFacts(*dataset_);
    QStringList lines;
    for (const std::string& notice : dataset_->info().notices) {
        lines.append(QStringLiteral("• ") + QString::fromStdString(notice));
    }
    notices_->setText(lines.join(QLatin1Char('\n')));
    notices_->setVisible(!lines.isEmpty());
}

// A name above its value: beside it, neither has room in a narrow panel.
void GeoreferencingPanel::addFact(const QString& name, const QString& value)
{
    QLabel* caption = makeCaption(name, this);
    caption->setContentsMargins(0, facts_->rowCount() == 0 ? 0 : 6, 0, 0);
    QLabel* fact = makeFact(this);
    fact->setText(value);
    fact->setAccessibleName(name);
    facts_->addRow(caption, fact);
}

void GeoreferencingPanel::addPlaceFacts(const Dataset& dataset)
{
    const RasterInfo& info = dataset.info();
    const Georeference georeference = georeferenceOf(info); // a preview's pixels are larger
    const QString unknown = tr("unknown");
    addFact(tr("Body"), info.body != nullptr ? fromStd(info.body->name) : unknown);
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
    addFact(tr("CRS"), info.crs ? (crs_name.isEmpty() ? tr("unnamed") : crs_name) : tr("none"));
    const GeoTransform& transform = georeference.transform();
    const bool is_geographic = info.crs && info.crs->kind() == CrsKind::Geographic;
    const QString unit =
        is_geographic ? QStringLiteral("°")
                      : QLatin1Char(' ') + (!info.crs ? tr("map units")
                                            : info.crs->unit() == 1.0
                                                ? QStringLiteral("m")
                                                : QString::fromStdString(info.crs->unitName()));
    const QString width = number(transform.pixelWidth());
    const QString height = number(transform.pixelHeight());
    const auto metres = [](double value) { return shortNumberText(value, 6); };
    QString pixel = width == height
                        //: The size of a pixel, and its unit with the space before it
                        ? tr("%1%2").arg(width, unit)
                        : tr("%1 × %2%3").arg(width, height, unit);
    const bool is_in_metres = info.crs && !is_geographic && info.crs->unit() == 1.0;
    if (!is_in_metres) {
        const QString in_metres = tr("%1 × %2 m")
                                      .arg(metres(georeference.pixelWidthMetres()),
                                           metres(georeference.pixelHeightMetres()));
        pixel += QLatin1Char('\n') + (info.crs ? in_metres : tr("%1, assumed").arg(in_metres));
    }
    addFact(tr("Pixel"), pixel);
    const MapExtent extent = mapExtent(georeference);
    if (!is_geographic) {
        //: The range of map coordinates: x from %1 to %2, y from %3 to %4
        addFact(tr("Extent"), tr("x %1 … %2\ny %3 … %4")
                                  .arg(number(extent.low.x), number(extent.high.x),
                                       number(extent.low.y), number(extent.high.y)));
    }
    const std::vector<CoordinateDisplay> displays = coordinateDisplays(info);
    if (const auto place = geographicExtent(georeference)) {
        // A thousandth of the shorter side, so that the noise of a projection is not told.
        const double side = std::min((place->east - place->west).degrees(),
                                     (place->north - place->south).degrees());
        const int decimals = decimalsFor(side / 100.0, 7);
        const auto longitude = [decimals](Angle angle) {
            return numberText(angle.degrees(), decimals);
        };
        const auto latitude = [&](Angle angle) {
            const bool is_graphic = displays.front() == CoordinateDisplay::Planetographic;
            return numberText(
                (is_graphic ? info.crs->ellipsoid()->planetographic(angle) : angle).degrees(),
                decimals);
        };
        //: Longitudes from %1 to %2 and latitudes from %3 to %4; %5 is the kind of latitude
        addFact(tr("Longitude, latitude"),
                tr("%1° … %2° E\n%3° … %4° N %5")
                    .arg(longitude(place->west), longitude(place->east), latitude(place->south),
                         latitude(place->north), displayName(displays.front(), info)));
    }
    const GeoTransform::Terms& t = transform.terms();
    addFact(tr("Geotransform"), info.transform ? tr("%1, %2, %3\n%4, %5, %6")
                                                     .arg(number(t[0]), number(t[1]), number(t[2]),
                                                          number(t[3]), number(t[4]), number(t[5]))
                                               : tr("none"));
}

void GeoreferencingPanel::addSampleFacts(const Dataset& dataset)
{
    const RasterInfo& info = dataset.info();
    //: %1 columns and %2 rows of samples, of type %3
    addFact(tr("Samples"), tr("%1 × %2, %3")
                               .arg(countText(info.columns), countText(info.rows),
                                    fromStd(sampleTypeName(info.type))));
    if (const auto& range = dataset.heightfield().range()) {
        addFact(tr("Heights"), heightRangeText(*range, unit_of_heights_));
    }
    const QString unit = QString::fromStdString(info.unit.name);
    addFact(tr("Height unit"), info.is_unit_declared ? unit : tr("%1, assumed").arg(unit));
    addFact(tr("Datum"), info.vertical_datum.empty() ? tr("unknown")
                                                     : QString::fromStdString(info.vertical_datum));
    addFact(tr("Nodata"), info.nodata ? number(*info.nodata) : tr("none"));
    addFact(tr("Driver"), QString::fromStdString(info.driver));
    if (!dataset.spec().overrides.isEmpty()) {
        addFact(tr("Source"), tr("overridden by you"));
    }
}

void GeoreferencingPanel::fillFields()
{
    showProblem({});
    const RasterOverrides overrides = dataset_ ? dataset_->spec().overrides : RasterOverrides{};
    const auto fill = [](QLineEdit* field, const std::optional<double>& value,
                         const std::optional<double>& in_file) {
        field->setText(value ? exactNumber(*value) : QString());
        field->setPlaceholderText(in_file ? exactNumber(*in_file) : QString());
    };
    const auto choose = [](QComboBox* box, const std::optional<std::string>& value) {
        const int index = value ? box->findData(QString::fromStdString(*value)) : 0;
        box->setCurrentIndex(std::max(0, index));
    };
    crs_->setText(QString::fromStdString(overrides.crs.value_or("")));
    crs_->setPlaceholderText(dataset_ && dataset_->fileInfo().crs
                                 ? QString::fromStdString(dataset_->fileInfo().crs->name())
                                 : QString());
    choose(body_, overrides.body);
    choose(unit_, overrides.vertical_unit);
    const auto radius = [](const std::optional<Ellipsoid>& e, double Ellipsoid::*which) {
        return e ? std::optional((*e).*which) : std::nullopt;
    };
    const std::optional<Ellipsoid> in_effect =
        dataset_ && dataset_->info().crs ? dataset_->info().crs->ellipsoid() : std::nullopt;
    fill(equatorial_, radius(overrides.ellipsoid, &Ellipsoid::equatorial_m),
         radius(in_effect, &Ellipsoid::equatorial_m));
    fill(polar_, radius(overrides.ellipsoid, &Ellipsoid::polar_m),
         radius(in_effect, &Ellipsoid::polar_m));
    const GeoTransform::Terms in_file =
        dataset_ ? dataset_->fileInfo().transform.value_or(GeoTransform{}).terms()
                 : GeoTransform{}.terms();
    for (std::size_t i = 0; i < terms_.size(); ++i) {
        fill(terms_[i],
             overrides.transform ? std::optional((*overrides.transform)[i]) : std::nullopt,
             in_file[i]);
    }
    fill(nodata_, overrides.nodata, dataset_ ? dataset_->fileInfo().nodata : std::nullopt);
}

// A radius left empty stays as the file has it; on a sphere, or where the file has none, one radius
// alone makes a sphere.
Ellipsoid GeoreferencingPanel::ellipsoidFrom(std::optional<double> equatorial_m,
                                             std::optional<double> polar_m) const
{
    const double only_m = equatorial_m ? *equatorial_m : *polar_m;
    Ellipsoid rest{.equatorial_m = only_m, .polar_m = only_m};
    if (const std::optional<Crs>& crs = dataset_->fileInfo().crs) {
        const std::optional<Ellipsoid> in_file = crs->ellipsoid();
        rest = in_file && !in_file->isSphere() ? *in_file : rest;
    }
    return {.equatorial_m = equatorial_m.value_or(rest.equatorial_m),
            .polar_m = polar_m.value_or(rest.polar_m)};
}

void GeoreferencingPanel::apply()
{
    if (!dataset_) {
        return;
    }
    RasterOverrides overrides;
    const QString crs = crs_->text().trimmed();
    if (!crs.isEmpty()) {
        overrides.crs = crs.toStdString();
    }
    if (body_->currentIndex() > 0) {
        overrides.body = body_->currentData().toString().toStdString();
    }
    if (unit_->currentIndex() > 0) {
        overrides.vertical_unit = unit_->currentData().toString().toStdString();
    }
    try {
        const auto equatorial = valueOf(*equatorial_);
        const auto polar = valueOf(*polar_);
        if (equatorial || polar) {
            overrides.ellipsoid = ellipsoidFrom(equatorial, polar);
        }
        GeoTransform::Terms terms = dataset_->fileInfo().transform.value_or(GeoTransform{}).terms();
        bool is_any_given = false;
        for (std::size_t i = 0; i < terms.size(); ++i) {
            if (const auto value = valueOf(*terms_[i])) {
                terms[i] = *value;
                is_any_given = true;
            }
        }
        if (is_any_given) {
            overrides.transform = terms;
        }
        overrides.nodata = valueOf(*nodata_);
    } catch (const NotANumber& problem) {
        showProblem(tr("\"%1\" is not a number.").arg(problem.text));
        return;
    }
    showProblem({});
    if (overrides != dataset_->spec().overrides) {
        Q_EMIT overridesRequested(overrides);
    }
}

void GeoreferencingPanel::showProblem(const QString& problem)
{
    problem_->setText(problem);
    problem_->setVisible(!problem.isEmpty());
}

} // namespace marsview
