// Going to a place by its coordinate.
#pragma once

#include "core/base/result.h"
#include "core/session/dataset.h"
#include "ui/coordinate_text.h"

#include <QDialog>
#include <QTimer>

#include <memory>
#include <optional>

class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace marsview {

/// What was asked for last, to begin with the next time.
struct GoToEntry {
    /// Nothing for what is usual on the map, whichever that is: what is planetocentric on Mars must
    /// not become geocentric on the Earth.
    std::optional<CoordinateDisplay> display;
    QString text;
};

/// The place on the map's grid that a text names; the error says what is wrong with it, and where
/// the map lies if it names a place elsewhere.
Result<GridPoint>
placeOnMap(const Dataset& dataset, CoordinateDisplay display, const QString& text);

/// Says while the user types how the text is understood, or what is wrong with it.
class GoToDialog final : public QDialog {
    Q_OBJECT

public:
    GoToDialog(std::shared_ptr<const Dataset> dataset,
               const GoToEntry& last,
               QWidget* parent = nullptr);

    GoToEntry entry() const;

Q_SIGNALS:
    void placeChosen(GridPoint grid);

private:
    CoordinateDisplay display() const;
    void check();
    void go();

    std::shared_ptr<const Dataset> dataset_;
    QTimer arrival_timer_;       // runs while the height of the place is being read
    QLineEdit* field_ = nullptr; // first: what is created first has the focus first
    QComboBox* kind_ = nullptr;
    QLabel* answer_ = nullptr;
    QPushButton* go_button_ = nullptr;
};

} // namespace marsview
