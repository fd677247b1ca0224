// The toolbar with the most frequent actions.
#pragma once

#include "core/view/exaggeration.h"
#include "ui/canvas/tool.h"

#include <QList>
#include <QToolBar>

class QActionGroup;
class QLineEdit;
class QToolButton;

namespace marsview {

class ExaggerationControl;
struct WindowActions;

class MainToolBar final : public QToolBar {
    Q_OBJECT

public:
    explicit MainToolBar(const WindowActions& actions, QWidget* parent = nullptr);

    void showExaggeration(double exaggeration);
    void setExaggerationRange(const ExaggerationRange& range);
    void setExaggerationEnabled(bool is_enabled);
    /// The name search. It moves to the overflow menu of the toolbar where there is no room.
    QLineEdit& searchField() const noexcept { return *search_; }
    /// The button of the light, or the toolbar if that button is hidden for lack of space.
    const QWidget& lightAnchor() const;

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void changeEvent(QEvent* event) override;

Q_SIGNALS:
    void exaggerationRequested(double exaggeration);
    /// As exaggerationRequested(), while the slider is dragged.
    void exaggerationDragged(double exaggeration);
    /// A drag of the slider begins or has ended.
    void dragEnded();
    /// A field has been completed: the map gets the keyboard focus.
    void entryCompleted();

private:
    void addKinds(const WindowActions& actions,
                  Tool tool,
                  const QActionGroup& kinds,
                  const QString& name);
    void fitTexts();

    /// These lose their texts first if the toolbar is too narrow.
    QList<QToolButton*> general_buttons_;
    QList<QToolButton*> special_buttons_; // tools and menus
    QAction* caption_ = nullptr;          // of the exaggeration
    ExaggerationControl* exaggeration_ = nullptr;
    QWidget* light_button_ = nullptr;
    QLineEdit* search_ = nullptr;
};

} // namespace marsview
