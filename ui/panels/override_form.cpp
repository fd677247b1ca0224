#include "ui/panels/override_form.h"

#include "core/session/map.h"
#include "ui/panels/crs_field.h"
#include "ui/text/body_text.h"
#include "ui/text/core_text.h"
#include "ui/text/number_text.h"
#include "ui/text/sentence.h"
#include "ui/widgets/form_field.h"
#include "ui/widgets/scroll_area.h"

#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>

#include <algorithm>
#include <chrono>
#include <fmt/format.h>

namespace marsview {
namespace {

constexpr std::chrono::milliseconds kCheckPause{400};

// Digits enough to read the same double back, always with a point.
QString exactNumber(double value)
{
    return QString::fromStdString(fmt::format("{}", value));
}

// A number as the user writes it: with a point, as the locale has it, and with either minus sign.
std::optional<double> numberFrom(QString text)
{
    text = text.trimmed().replace(QChar(0x2212), QLatin1Char('-'));
    bool is_number = false;
    const double plain = QLocale::c().toDouble(text, &is_number);
    if (is_number) {
        return plain;
    }
    const double local = QLocale().toDouble(text, &is_number);
    return is_number ? std::optional(local) : std::nullopt;
}

// The sentence for a field: without the path and the option before it.
QString withoutOption(const QString& problem, OverrideField field)
{
    for (qsizetype at = problem.indexOf(QStringLiteral(": ")); at >= 0;
         at = problem.indexOf(QStringLiteral(": "), at + 2)) {
        const QString rest = problem.mid(at + 2);
        if (refusedField({ErrorCode::Invalid, rest.toStdString()}) != field) {
            return asSentence(rest);
        }
    }
    return asSentence(problem);
}

QString searchHint()
{
    return OverrideForm::tr(
        "Type a name or a code to search, such as UTM 10N, Mars "
        "equirectangular or EPSG:32610. A PROJ string or WKT also works.");
}

QString notANumber(const QString& text)
{
    //: Below a field: %1 is the text entered
    return OverrideForm::tr("“%1” is not a number. Enter one such as −1737.4 or 1e-3.")
        .arg(text.trimmed());
}

} // namespace

OverrideForm::OverrideForm(QWidget* parent)
    : QWidget(parent)
{
    QScrollArea* scroll = makeScrollArea(this);
    scroll->setFocusPolicy(Qt::NoFocus); // its fields scroll into sight
    auto* fields = new QWidget(scroll);
    auto* layout = new QVBoxLayout(fields);
    layout->setSpacing(8);
    auto* intro = new QLabel(fields);
    intro->setWordWrap(true);
    intro->setText(tr("Leave blank to keep the file's value. The file itself is never changed."));
    layout->addWidget(intro);
    crs_ = new CrsField(this);
    crs_->setObjectName(QStringLiteral("crs"));
    auto* crs_field = new FormField(tr("&CRS"), crs_, this);
    fields_[OverrideField::Crs] = crs_field;
    all_fields_.append(crs_field);
    layout->addWidget(crs_field);
    connect(crs_, &CrsField::settled, this, &OverrideForm::checkCrs);
    connect(crs_, &QLineEdit::editingFinished, this, &OverrideForm::checkCrs);
    connect(crs_, &QLineEdit::textEdited, crs_field, [crs_field] { crs_field->setProblem({}); });
    body_ = addChoice(*layout, tr("&Body"), "body", OverrideField::Body);
    for (const Body& body : knownBodies()) {
        body_->addItem(bodyName(body), textFrom(body.name));
    }
    equatorial_ =
        addEdit(*layout, tr("&Equatorial radius (m)"), "equatorial", OverrideField::Radii);
    polar_ = addEdit(*layout, tr("&Polar radius (m)"), "polar");
    unit_ = addChoice(*layout, tr("Elevation &unit"), "unit", OverrideField::VerticalUnit);
    for (const char* unit : {"m", "km", "ft", "US survey ft"}) {
        unit_->addItem(QLatin1String(unit), QLatin1String(unit));
    }
    scale_ = addEdit(*layout, tr("&Scale"), "scale", OverrideField::Scale);
    scale_->setToolTip(tr("Elevation = sample × scale + offset, in the elevation unit"));
    offset_ = addEdit(*layout, tr("&Offset"), "offset", OverrideField::Offset);
    offset_->setToolTip(scale_->toolTip());
    datum_ = addEdit(*layout, tr("Vertical &datum"), "datum", OverrideField::VerticalDatum);
    nodata_ = addEdit(*layout, tr("&Nodata value"), "nodata", OverrideField::Nodata);
    addTransform(*layout);
    layout->addStretch(1);
    scroll->setWidget(fields);
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    outer->setSpacing(0);
    outer->addWidget(scroll, 1);
    addButtons(*outer);
    numbers_ = {equatorial_, polar_, scale_, offset_, nodata_};
    for (QLineEdit* term : terms_) {
        numbers_.append(term);
    }
    typing_timer_.setSingleShot(true);
    typing_timer_.setInterval(kCheckPause);
    connect(&typing_timer_, &QTimer::timeout, this, &OverrideForm::checkNumbers);
    for (QLineEdit* number : std::as_const(numbers_)) {
        connect(number, &QLineEdit::textEdited, this, [this, number](const QString& text) {
            if (text.trimmed().isEmpty() || numberFrom(text)) {
                fieldOf(number)->setProblem({});
            }
            typing_timer_.start();
        });
        connect(number, &QLineEdit::editingFinished, this, &OverrideForm::checkNumbers);
    }
    for (QLineEdit* edit : findChildren<QLineEdit*>()) {
        connect(edit, &QLineEdit::returnPressed, this, &OverrideForm::apply);
    }
    connect(datum_, &QLineEdit::textEdited, this, [this] { fieldOf(datum_)->setProblem({}); });
    for (QComboBox* choice : {body_, unit_}) {
        connect(choice, &QComboBox::activated, this,
                [this, choice] { fieldOf(choice)->setProblem({}); });
    }
    connect(body_, &QComboBox::currentIndexChanged, this, [this] {
        const Body* in_file = map_ ? map_->info().body : nullptr;
        const std::string chosen = body_->currentData().toString().toStdString();
        crs_->setBody(chosen.empty() ? in_file : bodyNamed(chosen));
    });
    fill();
}

// The dock is narrow: labels are above their fields, and no field requires a minimum width.
QLineEdit* OverrideForm::addEdit(QVBoxLayout& layout,
                                 const QString& name,
                                 const char* object_name,
                                 std::optional<OverrideField> field)
{
    auto* edit = new QLineEdit(this);
    edit->setObjectName(QLatin1String(object_name));
    edit->setMinimumWidth(40);
    auto* form_field = new FormField(name, edit, this);
    if (field) {
        fields_[*field] = form_field;
    }
    all_fields_.append(form_field);
    layout.addWidget(form_field);
    return edit;
}

QComboBox* OverrideForm::addChoice(QVBoxLayout& layout,
                                   const QString& name,
                                   const char* object_name,
                                   OverrideField field)
{
    auto* box = new QComboBox(this);
    box->setObjectName(QLatin1String(object_name));
    box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    box->setMinimumContentsLength(6);
    box->addItem(QString()); // the file's value, see fill()
    auto* form_field = new FormField(name, box, this);
    fields_[field] = form_field;
    all_fields_.append(form_field);
    layout.addWidget(form_field);
    return box;
}

void OverrideForm::addTransform(QVBoxLayout& layout)
{
    auto* content = new QWidget(this);
    content->setObjectName(QStringLiteral("transform"));
    auto* grid = new QGridLayout(content);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setVerticalSpacing(2);
    const std::array names{tr("x of the corner"), tr("x per column"), tr("x per row"),
                           tr("y of the corner"), tr("y per column"), tr("y per row")};
    for (std::size_t i = 0; i < terms_.size(); ++i) {
        terms_[i] = new QLineEdit(content);
        terms_[i]->setAccessibleName(names[i]);
        terms_[i]->setMinimumWidth(40);
        terms_[i]->setObjectName(QStringLiteral("term%1").arg(i));
        auto* label = new QLabel(names[i], content);
        label->setBuddy(terms_[i]);
        const int column = static_cast<int>(i / 3);
        const int row = static_cast<int>(i % 3) * 2;
        grid->addWidget(label, row, column);
        grid->addWidget(terms_[i], row + 1, column);
    }
    content->setFocusProxy(terms_[0]);
    auto* field =
        new FormField(tr("Geotransform, from the outer corner of the first pixel:"), content, this);
    fields_[OverrideField::Transform] = field;
    all_fields_.append(field);
    layout.addWidget(field);
}

void OverrideForm::addButtons(QVBoxLayout& layout)
{
    auto* apply_button = new QPushButton(tr("&Apply"), this);
    apply_button->setObjectName(QStringLiteral("apply"));
    connect(apply_button, &QPushButton::clicked, this, &OverrideForm::apply);
    auto* cancel_button = new QPushButton(tr("Cance&l"), this);
    cancel_button->setObjectName(QStringLiteral("close"));
    connect(cancel_button, &QPushButton::clicked, this, [this] {
        fill();
        Q_EMIT closed();
    });
    auto* reset_button = new QPushButton(tr("&Reset to File"), this);
    reset_button->setObjectName(QStringLiteral("reset"));
    reset_button->setToolTip(tr("Use the values of the file alone"));
    connect(reset_button, &QPushButton::clicked, this, [this] {
        if (map_ && map_->spec().overrides.isEmpty()) {
            fill();
            Q_EMIT closed();
        } else {
            Q_EMIT overridesRequested(RasterOverrides{});
        }
    });
    auto* rule = new QFrame(this);
    rule->setFrameShape(QFrame::HLine);
    rule->setFrameShadow(QFrame::Plain);
    rule->setForegroundRole(QPalette::Mid);
    layout.addWidget(rule);
    auto* buttons = new QGridLayout;
    buttons->setContentsMargins(9, 6, 9, 6);
    buttons->addWidget(apply_button, 0, 0);
    buttons->addWidget(cancel_button, 0, 1);
    buttons->addWidget(reset_button, 1, 0, 1, 2);
    for (QPushButton* button : {apply_button, cancel_button}) {
        button->setMinimumWidth(0);
        button->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    }
    layout.addLayout(buttons);
}

void OverrideForm::setMap(const std::shared_ptr<const Map>& map)
{
    const bool is_same = map_ && map && map_->spec() == map->spec();
    map_ = map;
    if (!is_same) {
        fill();
    }
}

void OverrideForm::focusFirstField()
{
    crs_->loadCatalogue();
    crs_->setFocus();
    crs_->selectAll(); // so that typing searches from the start
}

FormField* OverrideForm::fieldOf(const QWidget* editor) const
{
    for (FormField* field : all_fields_) {
        if (field->editor() == editor || field->editor()->isAncestorOf(editor)) {
            return field;
        }
    }
    return nullptr;
}

void OverrideForm::clearProblems()
{
    for (FormField* field : std::as_const(all_fields_)) {
        field->setProblem({});
    }
}

void OverrideForm::fill()
{
    clearProblems();
    fieldOf(crs_)->setHint(searchHint());
    const RasterOverrides overrides = map_ ? map_->spec().overrides : RasterOverrides{};
    const auto fill_number = [](QLineEdit* field, const std::optional<double>& value,
                                const std::optional<double>& in_file) {
        field->setText(value ? withMinusSigns(exactNumber(*value)) : QString());
        field->setPlaceholderText(in_file ? withMinusSigns(exactNumber(*in_file)) : QString());
    };
    const auto choose = [](QComboBox* box, const std::optional<std::string>& value,
                           std::string_view in_file) {
        //: The first entry of a list: the file's own value, and which it is
        box->setItemText(0, in_file.empty() ? tr("As in the file")
                                            : tr("As in the file: %1").arg(textFrom(in_file)));
        const int index = value ? box->findData(QString::fromStdString(*value)) : 0;
        box->setCurrentIndex(std::max(0, index));
    };
    const RasterInfo file = map_ ? map_->fileInfo() : RasterInfo{};
    crs_->setText(QString::fromStdString(overrides.crs.value_or("")));
    crs_->setPlaceholderText(file.crs ? QString::fromStdString(file.crs->name()) : QString());
    crs_->setCursorPosition(0);
    crs_->setBody(map_ ? map_->info().body : nullptr);
    choose(body_, overrides.body, file.body != nullptr ? file.body->name : std::string_view());
    choose(unit_, overrides.vertical_unit,
           file.is_unit_declared ? std::string_view(file.unit.name) : std::string_view());
    const auto radius = [](const std::optional<Ellipsoid>& e, double Ellipsoid::*which) {
        return e ? std::optional((*e).*which) : std::nullopt;
    };
    const std::optional<Ellipsoid> in_effect =
        map_ && map_->info().crs ? map_->info().crs->ellipsoid() : std::nullopt;
    fill_number(equatorial_, radius(overrides.ellipsoid, &Ellipsoid::equatorial_m),
                radius(in_effect, &Ellipsoid::equatorial_m));
    fill_number(polar_, radius(overrides.ellipsoid, &Ellipsoid::polar_m),
                radius(in_effect, &Ellipsoid::polar_m));
    const GeoTransform::Terms in_file = file.transform.value_or(GeoTransform{}).terms();
    for (std::size_t i = 0; i < terms_.size(); ++i) {
        fill_number(terms_[i],
                    overrides.transform ? std::optional((*overrides.transform)[i]) : std::nullopt,
                    in_file[i]);
    }
    fill_number(scale_, overrides.scale, file.scale);
    fill_number(offset_, overrides.offset, file.offset);
    datum_->setText(QString::fromStdString(overrides.vertical_datum.value_or("")));
    datum_->setPlaceholderText(QString::fromStdString(file.vertical_datum));
    fill_number(nodata_, overrides.nodata, file.nodata);
}

void OverrideForm::checkNumbers()
{
    for (QLineEdit* number : std::as_const(numbers_)) {
        const QString text = number->text();
        if (!text.trimmed().isEmpty() && !numberFrom(text)) {
            fieldOf(number)->setProblem(notANumber(text));
        }
    }
}

// While systems are listed that match, the text is a search and not yet a system.
void OverrideForm::checkCrs()
{
    FormField& field = *fieldOf(crs_);
    const QString text = crs_->text().trimmed();
    if (text.isEmpty()) {
        field.setProblem({});
        field.setHint(searchHint());
        return;
    }
    const Result<Crs> crs = Crs::fromText(text.toStdString());
    if (crs) {
        field.setProblem({});
        const Body* body = crs->body();
        const QString name = QString::fromStdString(crs->name());
        //: %1 is the name of a coordinate reference system, %2 the body it is on
        field.setHint(body != nullptr ? tr("%1, on %2").arg(name, bodyInSentence(*body)) : name);
        return;
    }
    field.setHint(searchHint());
    if (!crs_->hasFocus() || (crs_->isLoaded() && crs_->matches().isEmpty())) {
        field.setProblem(asSentence(crs.error().message));
    }
}

// A radius left empty stays as the file has it; on a sphere, or where the file has none, one radius
// alone makes a sphere.
Ellipsoid OverrideForm::ellipsoidFrom(std::optional<double> equatorial_m,
                                      std::optional<double> polar_m) const
{
    const double only_m = equatorial_m ? *equatorial_m : *polar_m;
    Ellipsoid rest{.equatorial_m = only_m, .polar_m = only_m};
    if (const std::optional<Crs>& crs = map_->fileInfo().crs) {
        const std::optional<Ellipsoid> in_file = crs->ellipsoid();
        rest = in_file && !in_file->isSphere() ? *in_file : rest;
    }
    return {.equatorial_m = equatorial_m.value_or(rest.equatorial_m),
            .polar_m = polar_m.value_or(rest.polar_m)};
}

// Nothing if some text is not a number; that is said below its field then.
std::optional<RasterOverrides> OverrideForm::entered()
{
    bool are_numbers = true;
    const auto number = [&](QLineEdit* edit) -> std::optional<double> {
        const QString text = edit->text().trimmed();
        if (text.isEmpty()) {
            return std::nullopt;
        }
        const auto value = numberFrom(text);
        if (!value) {
            fieldOf(edit)->setProblem(notANumber(text));
            if (are_numbers) {
                fieldOf(edit)->focusEditor();
                edit->setFocus();
            }
            are_numbers = false;
        }
        return value;
    };
    const auto text = [](const QString& entered_text) {
        const QString trimmed = entered_text.trimmed();
        return trimmed.isEmpty() ? std::nullopt : std::optional(trimmed.toStdString());
    };
    RasterOverrides overrides;
    overrides.crs = text(crs_->text());
    overrides.body = text(body_->currentData().toString());
    overrides.vertical_unit = text(unit_->currentData().toString());
    overrides.vertical_datum = text(datum_->text());
    const auto equatorial = number(equatorial_);
    const auto polar = number(polar_);
    if (equatorial || polar) {
        overrides.ellipsoid = ellipsoidFrom(equatorial, polar);
    }
    overrides.scale = number(scale_);
    overrides.offset = number(offset_);
    overrides.nodata = number(nodata_);
    GeoTransform::Terms terms = map_->fileInfo().transform.value_or(GeoTransform{}).terms();
    for (std::size_t i = 0; i < terms.size(); ++i) {
        if (const auto value = number(terms_[i])) {
            terms[i] = *value;
            overrides.transform = terms;
        }
    }
    if (overrides.transform) {
        overrides.transform = terms;
    }
    return are_numbers ? std::optional(overrides) : std::nullopt;
}

void OverrideForm::apply()
{
    if (!map_) {
        return;
    }
    clearProblems();
    checkCrs(); // so that all problems are shown together
    const std::optional<RasterOverrides> overrides = entered();
    if (!overrides) {
        return;
    }
    if (*overrides == map_->spec().overrides) {
        Q_EMIT closed();
        return;
    }
    if (const auto info = withOverrides(map_->fileInfo(), *overrides); !info) {
        showFailure(QString::fromStdString(info.error().message));
        return;
    }
    Q_EMIT overridesRequested(*overrides);
}

void OverrideForm::showFailure(const QString& problem)
{
    const std::optional<OverrideField> refused =
        refusedField({ErrorCode::Invalid, problem.toStdString()});
    // What reading the file again refuses, without naming a field, is about the samples.
    const OverrideField shown = refused.value_or(OverrideField::Nodata);
    FormField* field = fields_.at(shown);
    field->setProblem(refused ? withoutOption(problem, shown) : asSentence(problem));
    field->focusEditor();
}

} // namespace marsview
