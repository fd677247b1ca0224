// The context menu of the map.
#pragma once

#include "core/session/scene_surface.h"
#include "ui/text/place_facts.h"

#include <QObject>
#include <QPointer>

#include <functional>

class QMenu;

namespace marsview {

class PlaceDialog;
class TerrainView;

/// Opens at the position that the view requests, and acts on the place that was clicked. A child of
/// the view.
class MapMenu final : public QObject {
    Q_OBJECT

public:
    /// Facts of a place of the terrain; asked while the menu or a card is open.
    using Reader = std::function<PlaceFacts(const GroundPoint&)>;

    /// What begins at a place of the topmost map's grid.
    struct Beginnings {
        std::function<void(GridPoint)> measure;
        std::function<void(GridPoint)> annotate;
    };

    MapMenu(TerrainView& view, Reader read, Beginnings begin);

    /// The menu and the card that are open; null for none.
    QMenu* menu() const;
    PlaceDialog* card() const;

private:
    void open(QPointF position);
    void showCard(const GroundPoint& ground, QPoint at);

    TerrainView& view_;
    Reader read_;
    Beginnings begin_;
    QPointer<QMenu> menu_;
    QPointer<PlaceDialog> card_;
};

} // namespace marsview
