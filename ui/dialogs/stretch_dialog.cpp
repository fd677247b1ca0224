#include "ui/dialogs/stretch_dialog.h"

#include "core/base/round_numbers.h"
#include "ui/dialogs/stretch_plot.h"
#include "ui/widgets/elevation_box.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QListView>
#include <QPushButton>
#include <QSignalBlocker>
#include <QStandardItemModel>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace marsview {
namespace {

constexpr double kCutStep = 0.5; // percent
constexpr double kSteps = 100.0; // of the arrow keys over the whole range, about

double inMeters(double value, HeightUnit unit)
{
    return value / inUnit(1.0, unit);
}

} // namespace

StretchDialog::StretchDialog(QWidget* parent)
    : QDialog(parent)
    , plot_(new StretchPlot(this))
    , kind_(new QComboBox(this))
    , cut_(new QDoubleSpinBox(this))
    , low_(new ElevationBox(this))
    , high_(new ElevationBox(this))
    , to_view_(new QPushButton(tr("&Current View"), this))
    , note_(new QLabel(this))
{
    setObjectName(QStringLiteral("stretch"));
    const auto add_kind = [this](const QString& text, StretchKind kind) {
        kind_->addItem(text, static_cast<int>(kind));
    };
    //: A color stretch
    add_kind(tr("Automatic"), StretchKind::Automatic);
    //: A color stretch
    add_kind(tr("Full range"), StretchKind::Full);
    //: A color stretch
    add_kind(tr("Percentile"), StretchKind::Percentile);
    //: A color stretch
    add_kind(tr("Minimum and maximum"), StretchKind::Fixed);
    kind_->setAccessibleName(tr("Color stretch"));
    kind_->setObjectName(QStringLiteral("kind"));
    cut_->setRange(0.0, kStretchCutMax);
    cut_->setDecimals(2);
    cut_->setSingleStep(kCutStep);
    //: Percent, after a number
    cut_->setSuffix(tr(" %"));
    cut_->setKeyboardTracking(false);
    cut_->setAccessibleName(tr("Percentage cut off at either end"));
    cut_->setObjectName(QStringLiteral("cut"));
    low_->setAccessibleName(tr("Minimum elevation"));
    low_->setObjectName(QStringLiteral("low"));
    high_->setAccessibleName(tr("Maximum elevation"));
    high_->setObjectName(QStringLiteral("high"));
    to_view_->setToolTip(tr("Use the elevations that the picture shows now"));
    to_view_->setObjectName(QStringLiteral("toView"));
    to_view_->setAutoDefault(false);
    note_->setWordWrap(true);
    note_->setObjectName(QStringLiteral("note"));

    form_ = new QFormLayout;
    form_->addRow(tr("&Stretch"), kind_);
    form_->addRow(tr("Cut at &either end"), cut_);
    form_->addRow(tr("M&inimum"), low_);
    form_->addRow(tr("M&aximum"), high_);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    buttons->addButton(to_view_, QDialogButtonBox::ActionRole);
    buttons->button(QDialogButtonBox::Close)->setAutoDefault(false); // Enter ends typing
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(plot_, 1);
    layout->addLayout(form_);
    layout->addWidget(note_);
    layout->addWidget(buttons);

    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(kind_, &QComboBox::activated, this, &StretchDialog::requestKind);
    connect(cut_, &QDoubleSpinBox::valueChanged, this, [this](double percent) {
        ColorStretch stretch = content_.stretch;
        stretch.kind = StretchKind::Percentile;
        stretch.cut_percent = percent;
        Q_EMIT stretchRequested(stretch);
    });
    connect(low_, &QDoubleSpinBox::valueChanged, this, &StretchDialog::requestEnds);
    connect(high_, &QDoubleSpinBox::valueChanged, this, &StretchDialog::requestEnds);
    connect(to_view_, &QPushButton::clicked, this, &StretchDialog::stretchToViewRequested);
    connect(plot_, &StretchPlot::endsDragged, this, &StretchDialog::drag);
    connect(plot_, &StretchPlot::dragEnded, this, &StretchDialog::dragEnded);
    fill();
}

void StretchDialog::setContent(const StretchContent& content)
{
    content_ = content;
    fill();
}

void StretchDialog::setHeightUnit(HeightUnit unit)
{
    unit_ = unit;
    fill();
}

void StretchDialog::edit(StretchKind kind)
{
    if (kind == StretchKind::Percentile) {
        cut_->setFocus();
        cut_->selectAll();
    } else if (kind == StretchKind::Fixed) {
        low_->setFocus();
        low_->selectAll();
    }
}

void StretchDialog::fill()
{
    const bool is_any = !content_.layer.isEmpty();
    setWindowTitle(is_any
                       //: Title of a window; %1 is a layer
                       ? tr("Color Stretch — %1").arg(content_.layer)
                       : tr("Color Stretch"));
    const bool is_slope = content_.slopes.has_value();
    plot_->setAccessibleName(is_slope ? tr("Histogram of slopes") : tr("Histogram of elevations"));
    form_->setRowVisible(cut_, !is_slope);
    to_view_->setVisible(!is_slope);
    for (QWidget* part : std::initializer_list<QWidget*>{plot_, kind_, low_, high_}) {
        part->setEnabled(is_any);
    }
    cut_->setEnabled(is_any && content_.stretch.kind == StretchKind::Percentile);
    to_view_->setEnabled(content_.is_in_picture);
    // Slopes have no histogram from which a range or percentiles could be taken.
    auto* list = qobject_cast<QListView*>(kind_->view());
    for (const StretchKind kind : {StretchKind::Full, StretchKind::Percentile}) {
        const int row = kind_->findData(static_cast<int>(kind));
        list->setRowHidden(row, is_slope);
        // Keys and the wheel pass over disabled entries, not over hidden ones.
        qobject_cast<QStandardItemModel*>(kind_->model())->item(row)->setEnabled(!is_slope);
    }
    const StretchKind kind = !is_slope                    ? content_.stretch.kind
                             : content_.are_slopes_chosen ? StretchKind::Fixed
                                                          : StretchKind::Automatic;
    const QSignalBlocker kind_blocker(kind_);
    kind_->setCurrentIndex(kind_->findData(static_cast<int>(kind)));
    is_slope ? fillSlopes() : fillHeights();
    if (is_slope != was_slope_) { // fields come or go; the plot keeps its height
        was_slope_ = is_slope;
        layout()->activate();
        resize(width(), sizeHint().height());
    }
}

void StretchDialog::drag(double low, double high)
{
    if (content_.slopes) {
        Q_EMIT slopesDragged({.minimum = Angle::degrees(low), .maximum = Angle::degrees(high)});
        return;
    }
    ColorStretch stretch = fixedStretch(low, high);
    stretch.cut_percent = content_.stretch.cut_percent;
    Q_EMIT stretchDragged(stretch);
}

void StretchDialog::fillSlopes()
{
    const PlotRange stretched{.low = content_.slopes->minimum.degrees(),
                              .high = content_.slopes->maximum.degrees()};
    const double steepest = content_.slope_histogram.maximum.degrees();
    const auto degrees = [](double value) {
        return leftToRight(numberText(value, decimalsFor(value / 10.0, 2)) + QStringLiteral("°"));
    };
    plot_->setContent({.counts = content_.slope_histogram.counts,
                       .counted = {.low = 0.0, .high = steepest},
                       .all = {.low = 0.0, .high = std::max(steepest, stretched.high)},
                       .stretched = stretched,
                       .tinted = stretched,
                       .ramp = content_.ramp,
                       .low_text = degrees(0.0),
                       .high_text = degrees(std::max(steepest, stretched.high))});
    for (ElevationBox* box : {low_, high_}) {
        const QSignalBlocker blocker(box);
        box->setSuffix(QStringLiteral("°"));
        box->setRange(0.0, 90.0);
        box->setDecimals(2);
        box->setSingleStep(1.0);
    }
    low_->setAccessibleName(tr("Minimum slope"));
    high_->setAccessibleName(tr("Maximum slope"));
    const QSignalBlocker low_blocker(low_);
    const QSignalBlocker high_blocker(high_);
    low_->setValue(stretched.low);
    high_->setValue(stretched.high);
    note_->setText(tr("Slopes averaged over the map's overview; single samples may be steeper."));
}

void StretchDialog::fillHeights()
{
    const auto plotted = [](const HeightRange& range) {
        return PlotRange{.low = range.minimum_m, .high = range.maximum_m};
    };
    const double low = inUnit(content_.stretched.minimum_m, unit_);
    const double high = inUnit(content_.stretched.maximum_m, unit_);
    const double extent = std::max(
        inUnit(content_.all.maximum_m, unit_) - inUnit(content_.all.minimum_m, unit_), high - low);
    const auto height_text = [&](double height_m) {
        return leftToRight(
            withUnit(numberText(inUnit(height_m, unit_), decimalsFor(extent / 100.0, 2)),
                     unitSymbol(unit_)));
    };
    plot_->setContent(
        {.counts = content_.histogram ? content_.histogram->counts : std::vector<std::uint64_t>{},
         .counted = plotted(content_.all),
         .all = plotted(content_.all),
         .stretched = plotted(content_.stretched),
         .tinted =
             plotted(content_.ramp != nullptr ? tintedRange(*content_.ramp, content_.stretched)
                                              : content_.stretched),
         .ramp = content_.ramp,
         .low_text = height_text(content_.all.minimum_m),
         .high_text = height_text(content_.all.maximum_m)});
    const QSignalBlocker cut_blocker(cut_);
    cut_->setValue(content_.stretch.cut_percent);
    low_->setAccessibleName(tr("Minimum elevation"));
    high_->setAccessibleName(tr("Maximum elevation"));
    for (ElevationBox* box : {low_, high_}) {
        const QSignalBlocker blocker(box);
        box->setElevationRange();
        box->setSuffix(QStringLiteral(" ") + unitSymbol(unit_));
        box->setDecimals(extent > 0.0 ? decimalsFor(extent / 100.0, 3) : 1);
        box->setSingleStep(extent > 0.0 ? roundNumberBelow(extent / kSteps) : 1.0);
        box->setValue(box == low_ ? low : high);
    }
    QString note;
    if (!content_.layer.isEmpty() && !(content_.all.maximum_m > content_.all.minimum_m)) {
        note = tr("All samples have the same elevation.");
    } else if (content_.ramp != nullptr && content_.ramp->is_centered_on_datum) {
        const HeightRange tinted = tintedRange(*content_.ramp, content_.stretched);
        //: %1 is a range of elevations
        note = tr("This ramp is symmetric about 0: its ends are %1.")
                   .arg(heightRangeText(tinted, unit_));
    }
    note_->setText(note);
}

void StretchDialog::requestKind()
{
    ColorStretch stretch = content_.stretch;
    stretch.kind = static_cast<StretchKind>(kind_->currentData().toInt());
    if (content_.slopes) {
        Q_EMIT slopesRequested(stretch.kind == StretchKind::Fixed ? content_.slopes : std::nullopt);
        edit(stretch.kind);
        return;
    }
    if (stretch.kind == StretchKind::Fixed) {
        if (!isStretchRange(content_.stretched.minimum_m, content_.stretched.maximum_m)) {
            fill(); // no valid range to begin with
            return;
        }
        stretch.low = content_.stretched.minimum_m;
        stretch.high = content_.stretched.maximum_m;
    }
    Q_EMIT stretchRequested(stretch);
    edit(stretch.kind);
}

// An end that the user did not type keeps its full precision.
void StretchDialog::requestEnds()
{
    if (content_.slopes) {
        requestSlopes();
        return;
    }
    const auto end = [this](const ElevationBox& box, double now_m) {
        const double half_digit = 0.5 * std::pow(10.0, -box.decimals()) * (1.0 + 1e-6);
        return std::abs(box.value() - inUnit(now_m, unit_)) <= half_digit
                   ? now_m
                   : inMeters(box.value(), unit_);
    };
    const double low_m = end(*low_, content_.stretched.minimum_m);
    const double high_m = end(*high_, content_.stretched.maximum_m);
    if (!isStretchRange(low_m, high_m)) {
        note_->setText(tr("The minimum must be below the maximum."));
        return;
    }
    ColorStretch stretch = fixedStretch(low_m, high_m);
    stretch.cut_percent = content_.stretch.cut_percent;
    Q_EMIT stretchRequested(stretch);
}

void StretchDialog::requestSlopes()
{
    if (!isStretchRange(low_->value(), high_->value())) {
        note_->setText(tr("The minimum must be below the maximum."));
        return;
    }
    Q_EMIT slopesRequested(SlopeRange{.minimum = Angle::degrees(low_->value()),
                                      .maximum = Angle::degrees(high_->value())});
}

} // namespace marsview
