// The context menu of the map.
#pragma once

#include "core/session/map.h"
#include "ui/text/place_facts.h"

#include <QObject>
#include <QPointF>
#include <QPointer>

#include <functional>
#include <memory>
#include <optional>

class QAction;
class QMenu;
class QWidget;

namespace marsview {

class PlaceDialog;

/// So far from a feature of a vector file it is meant, in points of the screen.
inline constexpr double kFeatureReachPoints = 6.0;

/// A place of the terrain in a view.
struct MenuPlace {
    std::shared_ptr<const Map> map; // that is seen there
    GridPoint grid;                 // of that map
    double point_m = 0.0;           // meters on the terrain in a point of the screen
};

/// Acts on the place that was clicked, on the flat map or the globe. A child of its view.
class MapMenu final : public QObject {
    Q_OBJECT

public:
    /// Facts of a place of the terrain; asked while the menu or a card is open.
    using Reader = std::function<PlaceFacts(const MenuPlace&)>;

    /// What the view has at its positions, and how its camera goes there.
    struct Source {
        std::function<std::optional<MenuPlace>(QPointF)> place_at;
        std::function<void(const MenuPlace&)> fly_here;
        std::function<void(const MenuPlace&)> center_here;
        std::function<bool(const std::shared_ptr<const Map>&)> is_shown;
    };
    /// What begins at a place.
    struct Beginnings {
        std::function<void(const MenuPlace&)> measure;
        std::function<void(const MenuPlace&)> annotate;
    };

    /// What is offered at every place.
    struct Extras {
        QAction* stretch_to_view = nullptr;
        std::function<bool()> has_pin; // at a place that was found
        std::function<void()> remove_pin;
    };

    MapMenu(QWidget& view, Source source, Reader read, Beginnings begin, Extras extras);

    /// Opens the menu of a position of the view.
    void open(QPointF position);
    /// The place at a position of the view, if there is terrain.
    std::optional<MenuPlace> placeAt(QPointF position) const { return source_.place_at(position); }

    /// The menu and the card that are open; null for none.
    QMenu* menu() const;
    PlaceDialog* card() const;

private:
    void showCard(const MenuPlace& place, QPoint at);

    QWidget& view_;
    Source source_;
    Reader read_;
    Beginnings begin_;
    Extras extras_;
    QPointer<QMenu> menu_;
    QPointer<PlaceDialog> card_;
};

} // namespace marsview
