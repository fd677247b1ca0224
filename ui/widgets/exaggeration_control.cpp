#include "ui/widgets/exaggeration_control.h"

#include "ui/text/number_text.h"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLineEdit>
#include <QLocale>
#include <QPainter>
#include <QScopedValueRollback>
#include <QSignalBlocker>
#include <QStyle>
#include <QStyleOptionSlider>
#include <QToolButton>
#include <QToolTip>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace marsview {
namespace {

constexpr int kStepsADecade = 6;
constexpr int kDecimals = 7; // of factors of maps in degrees without georeferencing
constexpr int kDigitsShown = 4;
constexpr double kTolerance = 1.001;
constexpr std::chrono::milliseconds kStepPause{600}; // later steps are another drag

// The slider's position for a factor, rounded down.
int positionOf(double exaggeration)
{
    auto steps = static_cast<int>(std::floor(kStepsADecade * std::log10(exaggeration))) - 2;
    while (steppedExaggeration(1.0, steps + 1) <= exaggeration * kTolerance) {
        ++steps;
    }
    return steps;
}

} // namespace

ExaggerationBox::ExaggerationBox(QWidget* parent)
    : QDoubleSpinBox(parent)
{
    //: Before a factor of vertical exaggeration
    setPrefix(tr("×"));
    setDecimals(kDecimals);
    setKeyboardTracking(false); // not every digit on the way
    setAccessibleName(tr("Vertical exaggeration factor"));
    setToolTip(tr("Vertical exaggeration: type a factor, or press + and − in the map"));
    setCorrectionMode(QAbstractSpinBox::CorrectToNearestValue);
    setFocusPolicy(Qt::StrongFocus); // not by the wheel
    connect(
        lineEdit(), &QLineEdit::returnPressed, this,
        [this] {
            // The tooltip with the range disappears when the focus moves.
            if (!std::exchange(is_corrected_, false)) {
                Q_EMIT entered();
            }
        },
        Qt::QueuedConnection); // the value has been read by then
}

void ExaggerationBox::stepBy(int steps)
{
    const QScopedValueRollback<bool> stepping(is_stepping_, true);
    setValue(steppedExaggeration(value(), steps));
}

QString ExaggerationBox::textFromValue(double value) const
{
    return shortNumberText(value, kDigitsShown);
}

double ExaggerationBox::valueFromText(const QString& text) const
{
    QString digits = text;
    digits.remove(prefix()).remove(QLatin1Char('x'));
    bool is_number = false;
    const double value = locale().toDouble(digits.trimmed(), &is_number);
    return is_number ? value : this->value();
}

QValidator::State ExaggerationBox::validate(QString& text, int& /*position*/) const
{
    QString digits = text;
    digits.remove(prefix()).remove(QLatin1Char('x'));
    if (digits.trimmed().isEmpty()) {
        return QValidator::Intermediate;
    }
    bool is_number = false;
    const double value = locale().toDouble(digits.trimmed(), &is_number);
    if (!is_number || !(value >= 0.0)) {
        return QValidator::Invalid;
    }
    return value >= minimum() && value <= maximum() ? QValidator::Acceptable
                                                    : QValidator::Intermediate;
}

// Numbers beyond the range are taken to its ends, which are shown.
void ExaggerationBox::fixup(QString& text) const
{
    QToolTip::showText(mapToGlobal(rect().bottomLeft()),
                       //: %1 and %2 are factors of vertical exaggeration
                       tr("Vertical exaggeration goes from ×%1 to ×%2.")
                           .arg(textFromValue(minimum()), textFromValue(maximum())));
    is_corrected_ = true;
    text = prefix() + textFromValue(std::clamp(valueFromText(text), minimum(), maximum()));
}

// With nothing typed there is nothing to undo in the box: the keys are those of the window.
bool ExaggerationBox::event(QEvent* event)
{
    if (event->type() == QEvent::ShortcutOverride) {
        const auto& press = static_cast<const QKeyEvent&>(*event);
        const bool is_undo = press.matches(QKeySequence::Undo) || press.matches(QKeySequence::Redo);
        if (is_undo && text() == prefix() + textFromValue(value())) {
            event->ignore();
            return true;
        }
    }
    return QDoubleSpinBox::event(event);
}

ExaggerationSlider::ExaggerationSlider(QWidget* parent)
    : QSlider(Qt::Horizontal, parent)
{
    setAccessibleName(tr("Vertical exaggeration"));
    setToolTip(tr("Vertical exaggeration (+ and −); the mark is at ×1"));
    setFocusPolicy(Qt::TabFocus);
    setPageStep(2);
    setMinimumWidth(70);
    setMaximumWidth(130);
}

void ExaggerationSlider::paintEvent(QPaintEvent* event)
{
    QStyleOptionSlider option;
    initStyleOption(&option);
    const QRect groove =
        style()->subControlRect(QStyle::CC_Slider, &option, QStyle::SC_SliderGroove, this);
    const QRect handle =
        style()->subControlRect(QStyle::CC_Slider, &option, QStyle::SC_SliderHandle, this);
    const int room = groove.width() - handle.width();
    const int x = groove.left() + handle.width() / 2 +
                  QStyle::sliderPositionFromValue(minimum(), maximum(), 0, room, option.upsideDown);
    QPainter painter(this);
    QColor color =
        palette().color(isEnabled() ? QPalette::Active : QPalette::Disabled, QPalette::WindowText);
    color.setAlphaF(0.7F);
    constexpr int kMarkHeight = 4;
    const int top = std::max(0, handle.top() - kMarkHeight - 1);
    painter.fillRect(QRect(x, top, 1, kMarkHeight), color);
    painter.fillRect(
        QRect(x, std::min(height() - kMarkHeight, handle.bottom() + 2), 1, kMarkHeight), color);
    painter.end();
    QSlider::paintEvent(event);
}

ExaggerationControl::ExaggerationControl(QWidget* parent)
    : QWidget(parent)
    , slider_(new ExaggerationSlider(this))
    , box_(new ExaggerationBox(this))
    , true_scale_(new QToolButton(this))
{
    setWhatsThis(
        tr("How many times elevations are exaggerated in the picture. Numbers, measurements and "
           "files are never exaggerated. 1:1 shows the true shape."));
    //: Button: no vertical exaggeration
    true_scale_->setText(tr("1:1"));
    true_scale_->setAccessibleName(tr("True scale (1:1)"));
    true_scale_->setToolTip(tr("True scale: no vertical exaggeration"));
    true_scale_->setAutoRaise(true);
    true_scale_->setCheckable(true); // while it is in use
    true_scale_->setFocusPolicy(Qt::TabFocus);
    true_scale_->setObjectName(QStringLiteral("trueScale"));
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(4, 0, 4, 0);
    layout->setSpacing(4);
    layout->addWidget(slider_);
    layout->addWidget(box_);
    layout->addWidget(true_scale_);
    setSizePolicy(QSizePolicy::Maximum, QSizePolicy::Preferred);
    setRange({});
    showExaggeration(1.0);
    connect(slider_, &QSlider::valueChanged, this, [this](int steps) {
        // Steps count from ×1, so a position means the same on every map.
        const double chosen = steppedExaggeration(1.0, steps);
        if (slider_->isSliderDown()) {
            Q_EMIT dragged(chosen);
        } else {
            step(chosen);
        }
    });
    step_pause_.setSingleShot(true);
    step_pause_.setInterval(kStepPause);
    connect(&step_pause_, &QTimer::timeout, this, &ExaggerationControl::dragEnded);
    connect(slider_, &QSlider::sliderPressed, &step_pause_, &QTimer::stop);
    connect(slider_, &QSlider::sliderPressed, this, &ExaggerationControl::dragEnded);
    connect(slider_, &QSlider::sliderReleased, this, &ExaggerationControl::dragEnded);
    connect(box_, &QDoubleSpinBox::valueChanged, this, [this](double chosen) {
        if (box_->isStepping()) {
            step(chosen);
        } else {
            Q_EMIT requested(chosen);
        }
    });
    connect(box_, &ExaggerationBox::entered, this, &ExaggerationControl::entered);
    connect(true_scale_, &QToolButton::clicked, this, [this] {
        true_scale_->setChecked(shown_ == 1.0); // until it is granted
        Q_EMIT requested(1.0);
    });
}

// Notches of the wheel and repeated keys belong together, as a drag does.
void ExaggerationControl::step(double exaggeration)
{
    if (!step_pause_.isActive()) {
        Q_EMIT dragEnded();
    }
    step_pause_.start();
    Q_EMIT dragged(exaggeration);
}

void ExaggerationControl::setRange(const ExaggerationRange& range)
{
    const QSignalBlocker slider_blocker(slider_);
    const QSignalBlocker box_blocker(box_);
    slider_->setRange(positionOf(range.least), positionOf(range.most));
    box_->setRange(std::min(range.least, shown_), std::max(range.most, shown_));
    showExaggeration(shown_);
}

void ExaggerationControl::showExaggeration(double exaggeration)
{
    shown_ = exaggeration;
    const QSignalBlocker slider_blocker(slider_);
    const QSignalBlocker box_blocker(box_);
    slider_->setValue(positionOf(exaggeration));
    box_->setRange(std::min(box_->minimum(), exaggeration),
                   std::max(box_->maximum(), exaggeration));
    box_->setValue(exaggeration);
    true_scale_->setChecked(exaggeration == 1.0);
}

} // namespace marsview
