// The card with the facts of a place.
#pragma once

#include "ui/text/place_facts.h"

#include <QDialog>
#include <QTimer>

#include <functional>

class QFormLayout;

namespace marsview {

/// A small card that stays open next to the map. Its texts can be selected and copied.
class PlaceDialog final : public QDialog {
    Q_OBJECT

public:
    /// `read` gives the facts, and is asked again while they are rough.
    explicit PlaceDialog(std::function<PlaceFacts()> read, QWidget* parent = nullptr);

    /// All facts, one "name: value" a line.
    QString text() const;

private:
    void show(const PlaceFacts& place);

    std::function<PlaceFacts()> read_;
    QFormLayout* form_ = nullptr;
    std::vector<PlaceFacts::Fact> facts_;
    QTimer timer_;
};

} // namespace marsview
