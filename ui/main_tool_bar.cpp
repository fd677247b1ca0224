#include "ui/main_tool_bar.h"

#include "core/view/exaggeration.h"
#include "ui/number_text.h"
#include "ui/window_actions.h"

#include <QAction>
#include <QActionGroup>
#include <QLabel>
#include <QMenu>
#include <QSlider>
#include <QToolButton>

namespace marsview {
namespace {

// The slider spans ×0.001, for degrees against metres, to ×100 in round steps of about 1.5.
constexpr int kSliderStepsDown = 18;
constexpr int kSliderStepsUp = 12;

constexpr int kToolIconSide = 20; // points

} // namespace

MainToolBar::MainToolBar(const WindowActions& actions, QWidget* parent)
    : QToolBar(tr("Main Toolbar"), parent)
    , slider_(new QSlider(Qt::Horizontal, this))
    , label_(new QLabel(this))
{
    setObjectName(QStringLiteral("mainToolBar"));
    setIconSize({kToolIconSide, kToolIconSide});
    setMovable(false);
    addAction(actions.open);
    addAction(actions.save_picture);
    addSeparator();
    addActions(actions.tools->actions());
    addSeparator();
    addAction(actions.home);
    addAction(actions.north);
    addSeparator();
    auto* caption = new QLabel(tr("Exaggeration"), this);
    caption->setContentsMargins(6, 0, 6, 0);
    addWidget(caption);
    slider_->setAccessibleName(tr("Vertical exaggeration"));
    slider_->setToolTip(tr("How much heights are stretched (+ and −)"));
    slider_->setRange(-kSliderStepsDown, kSliderStepsUp);
    slider_->setPageStep(2);
    slider_->setMinimumWidth(70);
    slider_->setMaximumWidth(150);
    addWidget(slider_);
    label_->setContentsMargins(6, 0, 6, 0);
    label_->setMinimumWidth(fontMetrics().horizontalAdvance(QStringLiteral("×0.0001")) + 12);
    addWidget(label_);
    addSeparator();
    const auto add_menu = [this](QMenu* menu, const QString& text, const QString& tip) {
        auto* button = new QToolButton(this);
        button->setText(text);
        button->setIcon(menu->icon());
        button->setToolTip(tip);
        button->setAccessibleName(tip);
        button->setMenu(menu);
        button->setPopupMode(QToolButton::InstantPopup);
        addWidget(button);
    };
    add_menu(actions.shading, tr("Shading"), tr("What the colours of the ground tell"));
    add_menu(actions.ramps, tr("Ramp"), tr("Colour ramp of the active layer"));
    actions.light->setIconText(tr("Light"));
    addAction(actions.light);
    light_button_ = widgetForAction(actions.light);
    light_button_->setAccessibleName(tr("Direction of the light"));
    // Qt leaves tool buttons out of the round of the Tab key.
    for (QToolButton* button : findChildren<QToolButton*>(QString(), Qt::FindDirectChildrenOnly)) {
        if (button->objectName() != QStringLiteral("qt_toolbar_ext_button")) {
            button->setFocusPolicy(Qt::TabFocus);
            const bool is_general = button->defaultAction() == actions.open ||
                                    button->defaultAction() == actions.save_picture ||
                                    button->defaultAction() == actions.home ||
                                    button->defaultAction() == actions.north;
            (is_general ? general_buttons_ : special_buttons_).append(button);
        } else {
            //: The button that opens what the toolbar has no room for
            button->setAccessibleName(tr("More Tools"));
        }
    }
    // Steps count from ×1, so a position means the same on every map.
    connect(slider_, &QSlider::valueChanged, this,
            [this](int steps) { Q_EMIT exaggerationRequested(steppedExaggeration(1.0, steps)); });
    showExaggeration(1.0);
    setExaggerationEnabled(false);
}

void MainToolBar::showExaggeration(double exaggeration)
{
    //: Vertical exaggeration: a factor
    label_->setText(tr("×%1").arg(shortNumberText(exaggeration, 3)));
    int steps = 0;
    while (steps < kSliderStepsUp && steppedExaggeration(1.0, steps + 1) <= exaggeration * 1.001) {
        ++steps;
    }
    while (steps > -kSliderStepsDown && steppedExaggeration(1.0, steps) > exaggeration * 1.001) {
        --steps;
    }
    const QSignalBlocker blocker(slider_);
    slider_->setValue(steps);
}

void MainToolBar::setExaggerationEnabled(bool is_enabled)
{
    slider_->setEnabled(is_enabled);
    label_->setEnabled(is_enabled);
}

void MainToolBar::resizeEvent(QResizeEvent* event)
{
    QToolBar::resizeEvent(event);
    fitTexts();
}

void MainToolBar::changeEvent(QEvent* event)
{
    QToolBar::changeEvent(event);
    if (event->type() == QEvent::FontChange || event->type() == QEvent::StyleChange) {
        fitTexts();
    }
}

// As many texts as there is room for, so that nothing moves into the menu at the end: on all
// buttons, on those whose icons are less known, or on none.
void MainToolBar::fitTexts()
{
    const auto set = [](const QList<QToolButton*>& buttons, Qt::ToolButtonStyle style) {
        for (QToolButton* button : buttons) {
            button->setToolButtonStyle(style);
        }
    };
    set(general_buttons_, Qt::ToolButtonTextBesideIcon);
    set(special_buttons_, Qt::ToolButtonTextBesideIcon);
    if (sizeHint().width() > width()) {
        set(general_buttons_, Qt::ToolButtonIconOnly);
    }
    if (sizeHint().width() > width()) {
        set(special_buttons_, Qt::ToolButtonIconOnly);
    }
}

const QWidget& MainToolBar::lightAnchor() const
{
    return light_button_->isVisible() ? *light_button_ : static_cast<const QWidget&>(*this);
}

} // namespace marsview
