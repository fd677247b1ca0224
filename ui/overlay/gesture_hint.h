// The hint of the first minute: how to move over the map, and an invitation to touch it.
#pragma once

#include "ui/canvas/gestures.h"

#include <QWidget>

#include <array>

class QLabel;

namespace marsview {

/// Names the gestures on a plate over the map. Each that was made gets a check mark; when all were,
/// or its button is clicked, it asks to go.
class GestureHint final : public QWidget {
    Q_OBJECT

public:
    explicit GestureHint(QWidget* parent = nullptr);

    /// The gesture was made on the map.
    void markDone(MapAction action);
    bool isDone(MapAction action) const;

Q_SIGNALS:
    /// By its button, or as there is nothing left to name.
    void dismissed();

protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;

private:
    struct Line {
        MapAction action = MapAction::None;
        QLabel* mark = nullptr;
        bool is_done = false;
    };

    std::array<Line, 5> lines_;
};

} // namespace marsview
