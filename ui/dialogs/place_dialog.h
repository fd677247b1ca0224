// The card with the facts of a place.
#pragma once

#include "ui/text/place_facts.h"

#include <QDialog>
#include <QPoint>
#include <QTimer>

#include <functional>
#include <vector>

class QFormLayout;
class QScrollArea;

namespace marsview {

/// A small card that stays open next to the map. Its texts can be selected and copied.
class PlaceDialog final : public QDialog {
    Q_OBJECT

public:
    /// What keys are for once the card is shown.
    enum class Focus { Card, Map };

    /// `read` gives the facts, and is asked again while they are rough.
    PlaceDialog(std::function<PlaceFacts()> read, Focus focus, QWidget* parent = nullptr);

    /// Opens it next to a place of the screen.
    void showAt(QPoint place);
    /// Shows the facts of something else, where it is.
    void setReader(std::function<PlaceFacts()> read);
    /// All facts, one "name: value" a line.
    QString text() const;

private:
    void show(const PlaceFacts& place);
    void fitFacts();

    std::function<PlaceFacts()> read_;
    QScrollArea* scroll_ = nullptr;
    QFormLayout* form_ = nullptr;
    std::vector<PlaceFacts::Fact> facts_;
    QTimer timer_;
};

} // namespace marsview
