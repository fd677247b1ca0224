// The toolbar: what is used all the time.
#pragma once

#include <QList>
#include <QToolBar>

class QLabel;
class QSlider;
class QToolButton;

namespace marsview {

struct WindowActions;

class MainToolBar final : public QToolBar {
    Q_OBJECT

public:
    explicit MainToolBar(const WindowActions& actions, QWidget* parent = nullptr);

    void showExaggeration(double exaggeration);
    void setExaggerationEnabled(bool is_enabled);
    /// The button of the light, or the toolbar where it has no room for it.
    const QWidget& lightAnchor() const;

protected:
    void resizeEvent(QResizeEvent* event) override;
    void changeEvent(QEvent* event) override;

Q_SIGNALS:
    void exaggerationRequested(double exaggeration);

private:
    void fitTexts();

    /// Those without a text first, where there is no room for all texts.
    QList<QToolButton*> general_buttons_;
    QList<QToolButton*> special_buttons_; // tools and menus
    QSlider* slider_ = nullptr;
    QLabel* label_ = nullptr;
    QWidget* light_button_ = nullptr;
};

} // namespace marsview
