#include "ui/commands/map_menu.h"

#include "ui/dialogs/place_dialog.h"
#include "ui/widgets/icons.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QMenu>
#include <QWidget>

#include <memory>
#include <utility>

namespace marsview {

MapMenu::MapMenu(QWidget& view, Source source, Reader read, Beginnings begin, Extras extras)
    : QObject(&view)
    , view_(view)
    , source_(std::move(source))
    , read_(std::move(read))
    , begin_(std::move(begin))
    , extras_(std::move(extras))
{}

QMenu* MapMenu::menu() const
{
    return menu_;
}

PlaceDialog* MapMenu::card() const
{
    return card_;
}

void MapMenu::open(QPointF position)
{
    delete menu_.data();
    menu_ = new QMenu(&view_);
    menu_->setAttribute(Qt::WA_DeleteOnClose);
    menu_->setAccessibleName(tr("Place on the map"));
    const std::optional<MenuPlace> ground = source_.place_at(position);
    const PlaceFacts place = ground ? read_(*ground) : PlaceFacts{};
    const auto add = [&](const QString& text, const char* icon, bool is_possible, auto action) {
        QAction* entry = menu_->addAction(lineIcon(QString::fromLatin1(icon)), text);
        entry->setEnabled(is_possible);
        connect(entry, &QAction::triggered, this, action);
    };
    const auto copy = [](const QString& text) { QGuiApplication::clipboard()->setText(text); };
    add(tr("&Copy Coordinates"), "copy", !place.coordinates.isEmpty(),
        [copy, text = place.plain_coordinates] { copy(text); });
    add(tr("Copy &Elevation"), "copy", !place.elevation.isEmpty(),
        [copy, text = place.elevation] { copy(text); });
    menu_->addSeparator();
    add(tr("&Fly Here"), "fly", ground.has_value(), [this, ground] { source_.fly_here(*ground); });
    add(tr("Ce&nter Here"), "center", ground.has_value(),
        [this, ground] { source_.center_here(*ground); });
    menu_->addSeparator();
    add(tr("Measure &Distance from Here"), "measure", ground.has_value(),
        [this, ground] { begin_.measure(*ground); });
    add(tr("&Add Annotation Here"), "annotate", ground.has_value(),
        [this, ground] { begin_.annotate(*ground); });
    menu_->addSeparator();
    const QPoint at = view_.mapToGlobal(position).toPoint();
    add(tr("&What Is Here…"), "identify", ground.has_value(),
        [this, ground, at] { showCard(*ground, at); });
    if (ground) {
        menu_->addSeparator();
        menu_->addAction(extras_.stretch_to_view);
    }
    if (extras_.has_pin()) {
        add(tr("&Remove Pin"), "remove", true, extras_.remove_pin);
    }
    menu_->popup(at);
}

void MapMenu::showCard(const MenuPlace& place, QPoint at)
{
    delete card_.data();
    // The map of the place may go while the card is open.
    const std::weak_ptr<const Map> map = place.map;
    const auto last = std::make_shared<PlaceFacts>(read_(place));
    card_ = new PlaceDialog(
        [this, map, grid = place.grid, point_m = place.point_m, last] {
            const auto shown = map.lock();
            if (shown && source_.is_shown(shown)) {
                *last = read_({.map = shown, .grid = grid, .point_m = point_m});
            } else {
                last->is_rough = false; // nothing finer will arrive
            }
            return *last;
        },
        PlaceDialog::Focus::Card, view_.window());
    card_->setAttribute(Qt::WA_DeleteOnClose);
    card_->showAt(at);
}

} // namespace marsview
