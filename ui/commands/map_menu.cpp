#include "ui/commands/map_menu.h"

#include "ui/canvas/terrain_view.h"
#include "ui/dialogs/place_dialog.h"
#include "ui/widgets/icons.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QMenu>
#include <QScreen>

#include <algorithm>
#include <memory>
#include <utility>

namespace marsview {

MapMenu::MapMenu(TerrainView& view, Reader read, Beginnings begin)
    : QObject(&view)
    , view_(view)
    , read_(std::move(read))
    , begin_(std::move(begin))
{
    connect(&view, &TerrainView::menuRequested, this, &MapMenu::open);
}

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
    const std::optional<GroundPoint> ground = view_.groundUnder(position);
    const auto hit = view_.surfaceAt(position);
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
    add(tr("&Fly Here"), "fly", hit.has_value(), [this, hit] { view_.flyNearer(*hit); });
    add(tr("Ce&nter Here"), "center", hit.has_value(),
        [this, hit] { view_.flyTo(hit->grid, 0.0); });
    menu_->addSeparator();
    add(tr("Measure &Distance from Here"), "measure", hit.has_value(),
        [this, hit] { begin_.measure(hit->grid); });
    add(tr("&Add Annotation Here"), "annotate", hit.has_value(),
        [this, hit] { begin_.annotate(hit->grid); });
    menu_->addSeparator();
    const QPoint at = view_.mapToGlobal(position).toPoint();
    add(tr("&What Is Here…"), "identify", ground.has_value(),
        [this, ground, at] { showCard(*ground, at); });
    menu_->popup(at);
}

void MapMenu::showCard(const GroundPoint& ground, QPoint at)
{
    delete card_.data();
    // The map of the place may go while the card is open.
    const std::weak_ptr<const Map> map = view_.ground().maps()[ground.index].map;
    const auto last = std::make_shared<PlaceFacts>(read_(ground));
    card_ = new PlaceDialog(
        [this, map, ground, last] {
            const auto& maps = view_.ground().maps();
            if (ground.index < maps.size() && maps[ground.index].map == map.lock()) {
                *last = read_(ground);
            } else {
                last->is_rough = false; // nothing finer will arrive
            }
            return *last;
        },
        view_.window());
    card_->setAttribute(Qt::WA_DeleteOnClose);
    card_->QWidget::show();
    // Beside the place, on the screen that it is on.
    const QRect screen = view_.screen()->availableGeometry();
    QRect card(at + QPoint(12, 12), card_->frameGeometry().size());
    card.moveRight(std::min(card.right(), screen.right()));
    card.moveBottom(std::min(card.bottom(), screen.bottom()));
    card_->move(card.topLeft());
}

} // namespace marsview
