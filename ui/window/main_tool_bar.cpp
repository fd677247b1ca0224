#include "ui/window/main_tool_bar.h"

#include "ui/widgets/exaggeration_control.h"
#include "ui/window/window_actions.h"

#include <QAction>
#include <QActionGroup>
#include <QCursor>
#include <QEvent>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QToolButton>

namespace marsview {
namespace {

constexpr int kToolIconSide = 20; // points
constexpr int kSearchCharacters = 24;

} // namespace

MainToolBar::MainToolBar(const WindowActions& actions, QWidget* parent)
    : QToolBar(tr("Main Toolbar"), parent)
    , exaggeration_(new ExaggerationControl(this))
{
    setObjectName(QStringLiteral("mainToolBar"));
    setIconSize({kToolIconSide, kToolIconSide});
    setMovable(false);
    addAction(actions.open);
    addAction(actions.save_picture);
    addSeparator();
    addActions(actions.tools->actions());
    addKinds(actions, Tool::Measure, *actions.measure_kinds, tr("What to measure"));
    addKinds(actions, Tool::Annotate, *actions.annotation_shapes, tr("What to draw"));
    addSeparator();
    addAction(actions.home);
    addAction(actions.north);
    addSeparator();
    auto* caption = new QLabel(tr("Exaggeration"), this);
    caption->setContentsMargins(6, 0, 6, 0);
    caption_ = addWidget(caption);
    addWidget(exaggeration_);
    addSeparator();
    const auto add_menu = [this](QMenu* menu, const QString& text, const QString& tip,
                                 const QString& explanation) {
        auto* button = new QToolButton(this);
        button->setText(text);
        button->setIcon(menu->icon());
        button->setToolTip(tip);
        button->setAccessibleName(tip);
        button->setWhatsThis(explanation);
        button->setMenu(menu);
        button->setPopupMode(QToolButton::InstantPopup);
        // While the menu is open the button does not see that the pointer leaves it.
        connect(menu, &QMenu::aboutToHide, button, [button] {
            button->setAttribute(Qt::WA_UnderMouse,
                                 button->rect().contains(button->mapFromGlobal(QCursor::pos())));
            button->update();
        });
        addWidget(button);
    };
    add_menu(actions.shading, tr("Shading"), tr("What the terrain colors represent"),
             tr("Chooses what the colors of the terrain represent: elevations with or without "
                "shading, the light alone, or slopes. Contour lines can be added."));
    //: On a button: color ramps
    add_menu(actions.ramps, tr("Colors"), tr("Color ramp of the active layer"),
             tr("Chooses the color ramp of the active layer. The legend shows which color stands "
                "for which elevation."));
    //: On a button: over which elevations the color ramp is spread
    add_menu(actions.stretches, tr("Stretch"), tr("Color stretch of the active layer"),
             tr("Chooses the range over which the color ramp of the active layer is spread: the "
                "whole range, most elevations, those in the picture, or limits of your own."));
    actions.light->setIconText(tr("Light"));
    addAction(actions.light);
    light_button_ = widgetForAction(actions.light);
    light_button_->setAccessibleName(tr("Direction of the light"));
    addSeparator();
    search_ = new QLineEdit(this);
    search_->setObjectName(QStringLiteral("nameSearch"));
    search_->setPlaceholderText(tr("Find a name"));
    search_->setToolTip(tr("Type the name of a place, for example a mountain or a crater"));
    search_->setAccessibleName(tr("Find a name"));
    search_->addAction(actions.find_name->icon(), QLineEdit::LeadingPosition);
    search_->setClearButtonEnabled(true);
    search_->setFixedWidth(search_->fontMetrics().averageCharWidth() * kSearchCharacters);
    search_->installEventFilter(this);
    search_->setWhatsThis(
        tr("Finds places of the body in the picture by their names. Type some letters, choose a "
           "name from the list or press Return, and the map flies there."));
    addWidget(search_);
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
    connect(exaggeration_, &ExaggerationControl::requested, this,
            &MainToolBar::exaggerationRequested);
    connect(exaggeration_, &ExaggerationControl::dragged, this, &MainToolBar::exaggerationDragged);
    connect(exaggeration_, &ExaggerationControl::dragEnded, this, &MainToolBar::dragEnded);
    connect(exaggeration_, &ExaggerationControl::entered, this, &MainToolBar::entryCompleted);
    exaggeration_->setEnabled(false);
}

// A menu beside the tool's button. Choosing a kind chooses the tool, too.
void MainToolBar::addKinds(const WindowActions& actions,
                           Tool tool,
                           const QActionGroup& kinds,
                           const QString& name)
{
    for (QAction* action : actions.tools->actions()) {
        auto* button = action->data().toInt() == static_cast<int>(tool)
                           ? qobject_cast<QToolButton*>(widgetForAction(action))
                           : nullptr;
        if (button != nullptr) {
            auto* menu = new QMenu(button);
            menu->setAccessibleName(name);
            menu->addActions(kinds.actions());
            button->setMenu(menu);
            button->setPopupMode(QToolButton::MenuButtonPopup);
        }
    }
}

void MainToolBar::showExaggeration(double exaggeration)
{
    exaggeration_->showExaggeration(exaggeration);
}

void MainToolBar::setExaggerationRange(const ExaggerationRange& range)
{
    exaggeration_->setRange(range);
}

void MainToolBar::setExaggerationEnabled(bool is_enabled)
{
    exaggeration_->setEnabled(is_enabled);
}

// A field without anything to undo leaves the keys to the window.
bool MainToolBar::eventFilter(QObject* watched, QEvent* event)
{
    if (watched == search_ && event->type() == QEvent::ShortcutOverride) {
        const auto& press = static_cast<const QKeyEvent&>(*event);
        if ((press.matches(QKeySequence::Undo) && !search_->isUndoAvailable()) ||
            (press.matches(QKeySequence::Redo) && !search_->isRedoAvailable())) {
            event->ignore();
            return true;
        }
    }
    return QToolBar::eventFilter(watched, event);
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

// As many texts as there is room for, so that little moves into the menu at the end: on all
// buttons, on those whose icons are less known, or on none. The field for names moves first.
void MainToolBar::fitTexts()
{
    const auto set = [](const QList<QToolButton*>& buttons, Qt::ToolButtonStyle style) {
        for (QToolButton* button : buttons) {
            button->setToolButtonStyle(style);
        }
    };
    caption_->setVisible(true);
    set(general_buttons_, Qt::ToolButtonTextBesideIcon);
    set(special_buttons_, Qt::ToolButtonTextBesideIcon);
    if (sizeHint().width() > width()) {
        set(general_buttons_, Qt::ToolButtonIconOnly);
    }
    if (sizeHint().width() > width()) {
        set(special_buttons_, Qt::ToolButtonIconOnly);
    }
    if (sizeHint().width() > width()) {
        caption_->setVisible(false);
    }
}

const QWidget& MainToolBar::lightAnchor() const
{
    return light_button_->isVisible() ? *light_button_ : static_cast<const QWidget&>(*this);
}

} // namespace marsview
