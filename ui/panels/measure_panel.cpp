#include "ui/panels/measure_panel.h"

#include "core/measure/statistics/profile_statistics.h"
#include "core/session/crater_count.h"
#include "core/session/measurement_features.h"
#include "core/session/measurement_tables.h"
#include "ui/controllers/measure_controller.h"
#include "ui/panels/attitudes_view.h"
#include "ui/panels/measure_list.h"
#include "ui/panels/save_chart_dialog.h"
#include "ui/plots/hypsometry_plot.h"
#include "ui/plots/profile_plot.h"
#include "ui/text/sentence.h"
#include "ui/widgets/caption.h"
#include "ui/widgets/elided_label.h"

#include <QAbstractButton>
#include <QClipboard>
#include <QComboBox>
#include <QEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QItemSelectionModel>
#include <QLabel>
#include <QPushButton>
#include <QSaveFile>
#include <QScrollArea>
#include <QScrollBar>
#include <QSplitter>
#include <QTableWidget>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <array>
#include <string>

namespace marsview {
namespace {

constexpr int kLines = 17;            // of text, that the panel is high to begin with
constexpr int kResultsWidthMax = 360; // a value stays near its label
// Of profiles besides the current one; readable on light and on dark.
constexpr std::array<QRgb, 5> kOtherCurves{0xFF3A86C8, 0xFF3F9E5A, 0xFF9B6BC9, 0xFFB8862B,
                                           0xFF7A8288};
constexpr std::array kScales{0.0, 1.0, 2.0, 5.0, 10.0, 20.0}; // 0: fills the plot

QString field(const QString& text)
{
    return QString::fromStdString(csvField(text.toStdString()));
}

// Scrolls to the sides; as high as its content needs.
class SidewaysScrollArea final : public QScrollArea {
public:
    explicit SidewaysScrollArea(QWidget* parent)
        : QScrollArea(parent)
    {
        setWidgetResizable(true);
        setFrameShape(QFrame::NoFrame);
        setFocusPolicy(Qt::NoFocus);
    }

    QSize minimumSizeHint() const override
    {
        const QSize content = widget()->minimumSizeHint();
        const int bar = content.width() > width() ? horizontalScrollBar()->sizeHint().height() : 0;
        return {QScrollArea::minimumSizeHint().width(), content.height() + bar};
    }

protected:
    void resizeEvent(QResizeEvent* event) override
    {
        QScrollArea::resizeEvent(event);
        updateGeometry();
    }
    bool eventFilter(QObject* watched, QEvent* event) override
    {
        if (watched == widget() && event->type() == QEvent::LayoutRequest) {
            updateGeometry();
        }
        return QScrollArea::eventFilter(watched, event);
    }
};

bool writeText(const QString& path, const std::string& text)
{
    QSaveFile file(path);
    return file.open(QIODevice::WriteOnly) &&
           file.write(text.data(), static_cast<qint64>(text.size())) >= 0 && file.commit();
}

} // namespace

// Labels and values. A label has several lines before it hides its value; a value that is longer
// than half of the table has lines too.
class MeasurePanel::ResultsTable final : public QTableWidget {
public:
    explicit ResultsTable(QWidget* parent)
        : QTableWidget(0, 2, parent)
    {
        horizontalHeader()->hide();
        verticalHeader()->hide();
        horizontalHeader()->setSectionResizeMode(0, QHeaderView::Fixed);
        horizontalHeader()->setSectionResizeMode(1, QHeaderView::Stretch);
        setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
        setEditTriggers(QAbstractItemView::NoEditTriggers);
        setSelectionBehavior(QAbstractItemView::SelectRows);
        setShowGrid(false);
    }

    void setRows(const std::vector<MeasureRow>& rows)
    {
        setRowCount(static_cast<int>(rows.size()));
        for (std::size_t i = 0; i < rows.size(); ++i) {
            setItem(static_cast<int>(i), 0, new QTableWidgetItem(rows[i].label));
            auto* value = new QTableWidgetItem(rows[i].value);
            value->setTextAlignment(Qt::AlignTrailing | Qt::AlignVCenter);
            setItem(static_cast<int>(i), 1, value);
        }
        fit();
    }

protected:
    void resizeEvent(QResizeEvent* event) override
    {
        QTableWidget::resizeEvent(event);
        fit();
    }

private:
    void fit()
    {
        const int room = viewport()->width();
        const int left = std::max(room - sizeHintForColumn(1), room / 2);
        setColumnWidth(0, std::min(sizeHintForColumn(0), left));
        resizeRowsToContents();
    }
};

MeasurePanel::MeasurePanel(MeasureController& controller, QWidget* parent)
    : QWidget(parent)
    , controller_(controller)
{
    makeList();
    makeResults();
    makeProfile();
    makeHypsometry();
    auto* splitter = new QSplitter(Qt::Horizontal, this);
    splitter->setObjectName(QStringLiteral("measureParts"));
    splitter->setChildrenCollapsible(false);
    splitter->addWidget(list_->parentWidget());
    splitter->addWidget(results_side_);
    splitter->addWidget(profile_side_);
    splitter->addWidget(hypsometry_side_);
    attitudes_ = new AttitudesView(controller_, this);
    connect(attitudes_, &AttitudesView::saved, this, &MeasurePanel::saved);
    connect(attitudes_, &AttitudesView::failed, this, &MeasurePanel::failed);
    splitter->addWidget(attitudes_);
    splitter->setStretchFactor(0, 3);
    splitter->setStretchFactor(1, 3);
    splitter->setStretchFactor(2, 5);
    splitter->setStretchFactor(3, 4);
    splitter->setStretchFactor(4, 3);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(6, 4, 6, 6);
    auto* scroll = new SidewaysScrollArea(this); // a small window is not widened
    scroll->setWidget(splitter);
    layout->addWidget(scroll, 1);
    hint_ = new QLabel(this);
    hint_->setObjectName(QStringLiteral("measureHint"));
    hint_->setForegroundRole(QPalette::PlaceholderText);
    // On a small screen it is cut rather than the window widened.
    hint_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    layout->addWidget(hint_);
    // Later: rows may be on their way.
    connect(list_->selectionModel(), &QItemSelectionModel::selectionChanged, this,
            &MeasurePanel::showProfile, Qt::QueuedConnection);
    connect(&controller_, &MeasureController::changed, this, &MeasurePanel::showItems);
    connect(&controller_, &MeasureController::kindChanged, this, &MeasurePanel::showResult);
    connect(&controller_, &MeasureController::toolChanged, this, &MeasurePanel::showResult);
    connect(&controller_, &MeasureController::measured, this, &MeasurePanel::showItems);
    connect(&controller_, &MeasureController::lineHovered, plot_, &ProfilePlot::setCursorAt);
    connect(plot_, &ProfilePlot::cursorMoved, &controller_, &MeasureController::setProfileCursor);
    connect(plot_, &ProfilePlot::stretchPicked, this, &MeasurePanel::showResult);
    showItems();
}

void MeasurePanel::makeList()
{
    auto* side = new QWidget(this);
    list_ = new MeasureList(controller_, side);
    auto* save = new QPushButton(tr("Save &Table…"), side);
    save->setToolTip(tr("Save all measurements with their results as CSV or GeoPackage"));
    save->setObjectName(QStringLiteral("saveMeasurements"));
    connect(save, &QPushButton::clicked, this, &MeasurePanel::saveTable);
    auto* layout = new QVBoxLayout(side);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(list_);
    layout->addWidget(save, 0, Qt::AlignLeading);
}

void MeasurePanel::makeResults()
{
    results_side_ = new QWidget(this);
    results_side_->setMaximumWidth(kResultsWidthMax);
    title_ = makeCaption({}, results_side_);
    title_->setWordWrap(true);
    title_->setTextFormat(Qt::PlainText); // names are the user's
    title_->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
    results_ = new ResultsTable(results_side_);
    results_->setObjectName(QStringLiteral("measureResults"));
    results_->setAccessibleName(tr("Results"));
    results_->findChild<QAbstractButton*>()->setAccessibleName(tr("Select all results"));
    results_->setMinimumWidth(220);
    note_ = new QLabel(results_side_);
    note_->setWordWrap(true);
    note_->setAlignment(Qt::AlignLeading | Qt::AlignTop);
    note_->setObjectName(QStringLiteral("measureNote"));
    copy_ = new QPushButton(tr("&Copy"), results_side_);
    copy_->setToolTip(tr("Copy the results as text"));
    connect(copy_, &QPushButton::clicked, this, &MeasurePanel::copyResults);
    remove_ = new QPushButton(tr("&Remove"), results_side_);
    remove_->setToolTip(tr("Remove this measurement; Undo brings it back"));
    connect(remove_, &QPushButton::clicked, this,
            [this] { controller_.remove(controller_.state().current); });
    auto* buttons = new QHBoxLayout;
    buttons->addWidget(copy_);
    buttons->addWidget(remove_);
    buttons->addStretch(1);
    auto* layout = new QVBoxLayout(results_side_);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(title_);
    layout->addWidget(results_, 1);
    layout->addWidget(note_);
    layout->addLayout(buttons);
}

void MeasurePanel::makeProfile()
{
    profile_side_ = new QWidget(this);
    plot_ = new ProfilePlot(profile_side_);
    scale_ = new QComboBox(profile_side_);
    scale_->setAccessibleName(tr("Vertical scale of the profile"));
    scale_->setToolTip(tr("How many times larger elevations are drawn than distances"));
    for (const double factor : kScales) {
        scale_->addItem(factor > 0.0 ? leftToRight(QStringLiteral("%1:1").arg(factor))
                                     //: The plot's vertical scale: as large as there is room
                                     : tr("Fit"));
    }
    connect(scale_, &QComboBox::activated, this, [this](int index) {
        const double factor = kScales.at(static_cast<std::size_t>(index));
        plot_->setExaggeration(factor > 0.0 ? std::optional(factor) : std::nullopt);
    });
    slope_ = new QToolButton(profile_side_);
    slope_->setText(tr("Slope"));
    slope_->setToolTip(tr("Show the slope along the profile"));
    slope_->setCheckable(true);
    connect(slope_, &QToolButton::toggled, plot_, &ProfilePlot::setSlopeShown);
    auto* save = new QPushButton(tr("Save Pro&file…"), profile_side_);
    save->setToolTip(tr("Save the profile as CSV, PNG, SVG or PDF"));
    save->setObjectName(QStringLiteral("saveProfile"));
    connect(save, &QPushButton::clicked, this, &MeasurePanel::saveProfile);
    stretch_note_ =
        new ElidedLabel(tr("Drag along the profile to measure a part of it."), profile_side_);
    stretch_note_->setForegroundRole(QPalette::PlaceholderText);
    stretch_note_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    auto* caption = makeCaption(tr("&Vertical scale"), profile_side_);
    caption->setBuddy(scale_);
    auto* line = new QHBoxLayout;
    line->addWidget(caption);
    line->addWidget(scale_);
    line->addWidget(slope_);
    line->addWidget(stretch_note_, 1);
    line->addWidget(save);
    auto* layout = new QVBoxLayout(profile_side_);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(plot_, 1);
    layout->addLayout(line);
}

void MeasurePanel::makeHypsometry()
{
    hypsometry_side_ = new QWidget(this);
    hypsometry_ = new HypsometryPlot(hypsometry_side_);
    auto* save = new QPushButton(tr("Save H&ypsometry…"), hypsometry_side_);
    save->setToolTip(tr("Save the area by classes of elevation as CSV, PNG, SVG or PDF"));
    save->setObjectName(QStringLiteral("saveHypsometry"));
    connect(save, &QPushButton::clicked, this, &MeasurePanel::saveHypsometry);
    auto* line = new QHBoxLayout;
    line->addStretch(1);
    line->addWidget(save);
    auto* layout = new QVBoxLayout(hypsometry_side_);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(hypsometry_, 1);
    layout->addLayout(line);
}

QSize MeasurePanel::sizeHint() const
{
    return {QWidget::sizeHint().width(), kLines * fontMetrics().lineSpacing()};
}

void MeasurePanel::setHeightUnit(HeightUnit unit)
{
    unit_ = unit;
    plot_->setHeightUnit(unit);
    hypsometry_->setHeightUnit(unit);
    list_->setHeightUnit(unit);
    showItems();
}

void MeasurePanel::setCoordinateFormat(const CoordinateFormat& format)
{
    format_ = format;
    showResult();
}

void MeasurePanel::showItems()
{
    list_->showItems();
    const MeasureItem* item = controller_.current();
    attitudes_->setVisible(item != nullptr && item->kind == MeasurementKind::Attitude);
    attitudes_->showItems();
    showProfile();
    showHypsometry();
    showResult();
}

void MeasurePanel::showResult()
{
    const MeasureItem* item = controller_.current();
    copy_->setEnabled(item != nullptr);
    remove_->setEnabled(item != nullptr);
    std::vector<MeasureRow> rows;
    QString note;
    QString hint;
    if (item == nullptr) {
        //: %1 is a kind of measurement, as in the Measure menu
        title_->setText(tr("New: %1").arg(measurementName(controller_.kind())));
        note = controller_.isToolChosen() ? firstStepText(controller_.kind())
                                          : tr("Press M, or choose what to measure.");
    } else {
        title_->setText(item->name);
        const MeasureOutcome& outcome = controller_.outcome(item->id);
        const std::size_t needed = verticesNeeded(item->kind);
        if (item->vertices.size() < needed) {
            const std::size_t missing = needed - item->vertices.size();
            note = missing == 1
                       ? tr("Click to place one more point; Backspace removes the last one.")
                       //: %1 is a number above 1
                       : tr("Click to place %1 more points; Backspace removes the last one.")
                             .arg(missing);
        } else if (outcome.result && !outcome.result->values) {
            note = asSentence(outcome.result->values.error().message);
        } else if (outcome.result) {
            const auto* profile = outcome.as<Profile>();
            if (profile != nullptr && plot_->stretch()) {
                Profile part = *profile;
                const DistanceRange range = *plot_->stretch();
                std::erase_if(part.points, [&](const ProfilePoint& point) {
                    return point.distance_m < range.begin_m || point.distance_m > range.end_m;
                });
                const MeasuredResolution& resolution = outcome.result->resolution;
                rows = measureRows({.map = {},
                                    .values = MeasuredValues(std::move(part)),
                                    .resolution = resolution},
                                   unit_);
                const auto length = [&resolution](double length_m) {
                    return measuredLengthText(length_m,
                                              MeasuredDigits(resolution).length(length_m));
                };
                title_->setText(tr("%1: from %2 to %3")
                                    .arg(item->name, length(range.begin_m), length(range.end_m)));
            } else {
                rows = measureRows(*outcome.result, unit_);
                addPoints(rows, *item, *outcome.result);
            }
            const auto* area = outcome.as<TerrainArea>();
            if (area != nullptr && !area->volume_above_m3) {
                note = tr("Without volumes: no plane fits so large or so empty a border.");
            }
            if (outcome.is_running) {
                note = tr("Approximate; every sample is being read…");
            } else if (outcome.result->is_approximate) {
                note = tr("Approximate: measured on a preview.");
            }
        } else if (outcome.is_running) {
            note = tr("Measuring…");
        }
        if (item->vertices.size() >= needed) {
            hint = isOneOfSeveralProfiles(*item)
                       ? tr("Drag a point to move it; drag the line to insert one. Select several "
                            "profiles in the list to draw them over each other.")
                       : nextStepText(*item);
        }
    }
    hint_->setText(hint);
    hint_->setToolTip(hint);
    results_->setRows(rows);
    results_->setVisible(!rows.empty()); // otherwise the note has its room
    note_->setText(note);
    note_->setVisible(!note.isEmpty());
}

// Short: a taller panel would move the map under the pointer.
QString MeasurePanel::firstStepText(MeasurementKind kind)
{
    switch (kind) {
    case MeasurementKind::Distance:
        return tr("Click points along a line; double-click to finish.");
    case MeasurementKind::Area:
        return tr("Click the corners of an area; double-click to finish.");
    case MeasurementKind::Profile:
        return tr("Click the ends and bends of a profile; double-click to finish.");
    case MeasurementKind::Attitude:
        return tr("Click three or more points of one rock layer; double-click to finish.");
    case MeasurementKind::Crater:
        return tr("Click three or more points on the rim; double-click to finish.");
    case MeasurementKind::Slope:
        return tr("Click a place to measure its slope.");
    }
    return {};
}

// What the mouse and the keys can do with a measurement that has all the points it needs.
QString MeasurePanel::nextStepText(const MeasureItem& item)
{
    if (!item.is_finished) {
        return tr(
            "Click to add a point, double-click to finish. Backspace removes the last point.");
    }
    return item.isLine() || item.isClosed()
               ? tr("Drag a point to move it; drag the line to insert one.")
               : tr("Drag a point to move it.");
}

bool MeasurePanel::isOneOfSeveralProfiles(const MeasureItem& item) const
{
    const auto& items = controller_.state().items;
    return item.kind == MeasurementKind::Profile && item.is_finished &&
           std::any_of(items.begin(), items.end(), [&](const MeasureItem& other) {
               return other.kind == item.kind && other.id != item.id;
           });
}

void MeasurePanel::addPoints(std::vector<MeasureRow>& rows,
                             const MeasureItem& item,
                             const MeasurementResult& result) const
{
    constexpr std::size_t kPointsMax = 200; // a long line has its points in the table's file
    const Layer* layer = controller_.layerOf(item);
    if (layer == nullptr) {
        return;
    }
    std::vector<MeasuredVertex> vertices = item.vertices;
    vertices.resize(std::min(vertices.size(), kPointsMax));
    for (auto& more : {centerRows(result, *layer->map, format_),
                       pointRows(measurePoints(vertices, result, *layer->map, format_, unit_))}) {
        rows.insert(rows.end(), more.begin(), more.end());
    }
}

void MeasurePanel::showProfile()
{
    const MeasureItem* item = controller_.current();
    const auto* profile = item != nullptr ? controller_.outcome(item->id).as<Profile>() : nullptr;
    profile_side_->setVisible(item != nullptr && item->kind == MeasurementKind::Profile &&
                              item->vertices.size() >= verticesNeeded(item->kind));
    if (profile == nullptr) {
        plot_->setCurves({});
        return;
    }
    const auto curve = [](const MeasureItem& of, const Profile& line, const QColor& color) {
        ProfileCurve shown{.name = of.name,
                           .color = color,
                           .distance_m = {},
                           .elevation_m = {},
                           .vertices_m = line.vertices_m,
                           .is_approximate = line.is_approximate};
        for (const ProfilePoint& point : line.points) {
            shown.distance_m.push_back(point.distance_m);
            shown.elevation_m.push_back(point.elevation_m);
        }
        return shown;
    };
    std::vector<ProfileCurve> curves{curve(*item, *profile, palette().color(QPalette::Highlight))};
    for (const std::uint32_t id : list_->selectedIds()) {
        const MeasureItem* other = id != item->id ? controller_.itemOf(id) : nullptr;
        const auto* line = other != nullptr ? controller_.outcome(id).as<Profile>() : nullptr;
        if (line != nullptr && curves.size() <= kOtherCurves.size()) {
            const QColor usual(kOtherCurves.at(curves.size() - 1));
            curves.push_back(curve(
                *other, *line,
                other->color ? QColor(other->color->red, other->color->green, other->color->blue)
                             : usual));
        }
    }
    plot_->setCurves(std::move(curves));
}

void MeasurePanel::showHypsometry()
{
    const MeasureItem* item = controller_.current();
    const auto* area = item != nullptr ? controller_.outcome(item->id).as<TerrainArea>() : nullptr;
    hypsometry_side_->setVisible(item != nullptr && item->kind == MeasurementKind::Area);
    hypsometry_->setHypsometry(area != nullptr ? area->hypsometry : Hypsometry{},
                               area != nullptr && area->is_approximate);
}

QString MeasurePanel::resultsText() const
{
    QString text = title_->text();
    for (int i = 0; i < results_->rowCount(); ++i) {
        text += QStringLiteral("\n%1\t%2")
                    .arg(results_->item(i, 0)->text(), results_->item(i, 1)->text());
    }
    return text;
}

void MeasurePanel::copyResults()
{
    QGuiApplication::clipboard()->setText(resultsText());
}

void MeasurePanel::saveProfile()
{
    askChartFile(*this, {.title = tr("Save Profile"), .name = tr("profile"), .folder = folder_},
                 [this](const QString& path) {
                     endSaving(tr("Cannot Save Profile"), path,
                               writeProfile(path) ? QString() : notWrittenText(path));
                 });
}

void MeasurePanel::endSaving(const QString& failure, const QString& path, const QString& problem)
{
    folder_ = QFileInfo(path).absolutePath();
    if (problem.isEmpty()) {
        Q_EMIT saved(path);
    } else {
        Q_EMIT failed(failure, problem);
    }
}

bool MeasurePanel::writeProfile(const QString& path)
{
    if (QFileInfo(path).suffix().toLower() != QStringLiteral("csv")) {
        return plot_->savePicture(path);
    }
    const auto profile = controller_.named(controller_.state().current);
    return profile && writeText(path, profileCsv(*profile));
}

void MeasurePanel::saveHypsometry()
{
    askChartFile(*this,
                 {.title = tr("Save Hypsometry"), .name = tr("hypsometry"), .folder = folder_},
                 [this](const QString& path) {
                     endSaving(tr("Cannot Save Hypsometry"), path,
                               writeHypsometry(path) ? QString() : notWrittenText(path));
                 });
}

bool MeasurePanel::writeHypsometry(const QString& path)
{
    if (QFileInfo(path).suffix().toLower() != QStringLiteral("csv")) {
        return hypsometry_->savePicture(path);
    }
    return writeText(path, hypsometryCsv(hypsometry_->classes()));
}

QString MeasurePanel::tableCsv() const
{
    QString text = QStringLiteral("name,kind,note,layer,time,results,points\n");
    for (const MeasureItem& item : controller_.state().items) {
        const Layer* layer = controller_.layerOf(item);
        const auto named = controller_.named(item.id);
        const QString results =
            named ? QString::fromStdString(marsview::resultsText(named->measurement)) : QString();
        const QString points = named ? QString::fromStdString(pointsText(*named)) : QString();
        const QStringList fields{
            field(item.name),
            field(measurementName(item.kind)),
            field(item.note),
            field(layer != nullptr ? QString::fromStdString(layer->name) : QString()),
            localTime(item.time).toString(Qt::ISODate),
            field(results),
            field(points)};
        text += fields.join(QLatin1Char(',')) + QLatin1Char('\n');
    }
    return text;
}

void MeasurePanel::saveTable()
{
    auto* dialog = new QFileDialog(this, tr("Save Measurements"), folder_);
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setNameFilters({tr("CSV table (*.csv)"), tr("GeoPackage (*.gpkg)"),
                            tr("Crater count with positions (*.scc)"),
                            tr("Crater diameters (*.diam)")});
    dialog->setDefaultSuffix(QStringLiteral("csv"));
    connect(dialog, &QFileDialog::filterSelected, dialog, [dialog](const QString& filter) {
        const qsizetype dot = filter.lastIndexOf(QLatin1Char('.'));
        const QString suffix = filter.mid(dot + 1).chopped(1);
        dialog->setDefaultSuffix(suffix);
        dialog->selectFile(tr("measurements") + QLatin1Char('.') + suffix);
    });
    dialog->selectFile(tr("measurements") + QStringLiteral(".csv"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& path) {
        endSaving(tr("Cannot Save Measurements"), path, writeTable(path));
    });
    dialog->open();
}

QString MeasurePanel::writeTable(const QString& path)
{
    const QString suffix = QFileInfo(path).suffix().toLower();
    if (suffix == QStringLiteral("gpkg")) {
        const Status written = writeMeasurements(controller_.named(), path.toStdString());
        return written ? QString() : QString::fromStdString(written.error().message);
    }
    std::string text;
    if (suffix == QStringLiteral("scc") || suffix == QStringLiteral("diam")) {
        const auto count = craterCount(controller_.named());
        if (!count) {
            return asSentence(QString::fromStdString(count.error().message));
        }
        text = suffix == QStringLiteral("scc") ? sccText(*count) : diamText(*count);
    } else {
        text = tableCsv().toStdString();
    }
    return writeText(path, text) ? QString() : notWrittenText(path);
}

} // namespace marsview
