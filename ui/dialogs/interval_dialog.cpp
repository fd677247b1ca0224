#include "ui/dialogs/interval_dialog.h"

#include "ui/text/number_text.h"
#include "ui/widgets/elevation_box.h"
#include "ui/widgets/form_field.h"

#include <QDialogButtonBox>
#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>

namespace marsview {
namespace {

constexpr double kIntervalMinM = 1e-3;
constexpr double kIntervalMaxM = 100000.0;
constexpr int kWidthMin = 240; // as wide as the title
constexpr int kDecimals = 3;   // the smallest interval is a millimeter

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
    box_->setMinimumWidth(kWidthMin);
    box_->setDecimals(kDecimals);
    box_->setTrailingZeros(false);
    box_->setRange(can_be_automatic ? 0.0 : kIntervalMinM, kIntervalMaxM);
    //: Meters, after a number
    box_->setSuffix(tr(" m"));
    box_->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
    box_->setCorrectionMode(QAbstractSpinBox::CorrectToPreviousValue);
    if (can_be_automatic) {
        //: In place of a contour interval of 0: it follows the view
        box_->setSpecialValueText(tr("Automatic"));
        box_->setToolTip(tr("Enter 0 for an interval that follows the view"));
    }
    box_->setValue(interval_m);
    box_->selectAll();
    auto* field = new FormField(tr("&Interval between contour lines"), box_, this);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
    connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(this, &QDialog::accepted, this, [this] {
        box_->interpretText();
        Q_EMIT intervalChosen(box_->value());
    });
    // Rather than another number in place of the one that was typed.
    const QString problem =
        (can_be_automatic ? tr("Enter an interval from %1 m to %2 m, or 0 for automatic.")
                          : tr("Enter an interval from %1 m to %2 m."))
            .arg(numberText(kIntervalMinM, kDecimals), numberText(kIntervalMaxM, 0));
    const auto check = [this, field, problem, ok = buttons->button(QDialogButtonBox::Ok)] {
        const bool is_possible = box_->hasAcceptableInput();
        field->setProblem(is_possible ? QString() : problem);
        ok->setEnabled(is_possible);
    };
    connect(box_->findChild<QLineEdit*>(), &QLineEdit::textChanged, this, check);
    connect(box_, &QDoubleSpinBox::editingFinished, this, check); // what was impossible is gone
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(field);
    layout->addWidget(buttons);
    layout->setSizeConstraint(QLayout::SetFixedSize);
}

} // namespace marsview
