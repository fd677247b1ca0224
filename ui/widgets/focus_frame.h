// A frame around a widget that has the keyboard focus.
#pragma once

#include <QWidget>

namespace marsview {

/// Inside the edges of its parent, from when the parent gets the focus by a key until it loses it
/// or is clicked: people who use the mouse see where they work without it. Mouse events go through
/// it.
class FocusFrame final : public QWidget {
    Q_OBJECT

public:
    /// What it lies on: the picture of a map, whose colors it has to stand out from, or the plain
    /// ground of panels.
    enum class Ground { Picture, Panel };

    explicit FocusFrame(QWidget* parent, Ground ground = Ground::Picture);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    Ground ground_;
};

} // namespace marsview
