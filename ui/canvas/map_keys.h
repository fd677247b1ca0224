// Lets the map's single keys work while a list next to it has the keyboard focus.
#pragma once

#include <QObject>

class QWidget;

namespace marsview {

/// Filters the key presses of lists, whose search for rows by letters would take them: a plain
/// character that is the shortcut of one of the map's actions triggers that action.
class MapKeys final : public QObject {
    Q_OBJECT

public:
    /// `map` outlives this.
    MapKeys(const QWidget& map, QObject* parent);

    void addTo(QWidget& list);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    const QWidget& map_;
};

} // namespace marsview
