#include "ui/dialogs/interval_dialog.h"

#include "ui/widgets/elevation_box.h"

#include <QDialogButtonBox>
#include <QFormLayout>
#include <QVBoxLayout>

namespace marsview {
namespace {

constexpr double kIntervalMaxM = 100000.0;
constexpr int kDecimals = 3; // the smallest interval is a millimeter

} // namespace

IntervalDialog::IntervalDialog(const QString& title,
                               Automatic automatic,
                               double interval_m,
                               QWidget* parent)
    : QDialog(parent)
    , box_(new ElevationBox(this))
{
    setWindowTitle(title);
    const bool can_be_automatic = automatic == Automatic::Allowed;
    box_->setObjectName(QStringLiteral("interval"));
    box_->setDecimals(kDecimals);
    box_->setTrailingZeros(false);
    box_->setRange(can_be_automatic ? 0.0 : 1e-3, kIntervalMaxM);
    //: Meters, after a number
    box_->setSuffix(tr(" m"));
    box_->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
    if (can_be_automatic) {
        //: In place of a contour interval of 0: it follows the view
        box_->setSpecialValueText(tr("Automatic"));
        box_->setToolTip(tr("Enter 0 for an interval that follows the view"));
    }
    box_->setValue(interval_m);
    box_->selectAll();
    auto* form = new QFormLayout;
    form->addRow(tr("&Interval between contour lines"), box_);
    box_->setAccessibleName(tr("Interval between contour lines"));
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
    connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(this, &QDialog::accepted, this, [this] {
        box_->interpretText();
        Q_EMIT intervalChosen(box_->value());
    });
    auto* layout = new QVBoxLayout(this);
    layout->addLayout(form);
    layout->addWidget(buttons);
    layout->setSizeConstraint(QLayout::SetFixedSize);
}

} // namespace marsview
