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

    /// What is shown, from the largest to the smallest.
    enum class Form { Full, WithoutKeys, WithoutTitle, WithoutFlights, MoveZoomTouch };
    static constexpr std::array kForms{Form::Full, Form::WithoutKeys, Form::WithoutTitle,
                                       Form::WithoutFlights, Form::MoveZoomTouch};
    /// Changes the size hint.
    void setForm(Form form);

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
        QLabel* gesture = nullptr;
        QLabel* keys = nullptr; // null without
        QLabel* effect = nullptr;
        QLabel* mark = nullptr;
        bool is_done = false;
    };

    QLabel* title_ = nullptr;
    QLabel* invitation_ = nullptr; // to touch, where there is room for a sentence
    std::array<Line, 5> lines_;
    Form form_ = Form::Full;
};

} // namespace marsview
