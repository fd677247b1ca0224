#include "ui/commands/feature_picker.h"

#include "core/annotations/drawn_vertex.h"
#include "ui/commands/map_menu.h"
#include "ui/controllers/annotation_controller.h"
#include "ui/controllers/measure_controller.h"
#include "ui/controllers/vector_overlays.h"
#include "ui/dialogs/place_dialog.h"

#include <QLayout>
#include <QWidget>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace marsview {
namespace {

constexpr std::size_t kAttributesMax = 1000;

} // namespace

FeaturePicker::FeaturePicker(const Parts& parts, QObject* parent)
    : QObject(parent)
    , parts_(parts)
{
    connect(&parts_.overlays, &VectorOverlays::selectionLost, this, &FeaturePicker::closeCard);
}

PlaceDialog* FeaturePicker::card() const
{
    return card_;
}

bool FeaturePicker::hasFeature() const
{
    return parts_.overlays.selected().has_value();
}

// What is drawn on top comes first.
void FeaturePicker::pick(const MapMenu& menu, const QWidget& view, QPointF position)
{
    const bool is_drawn_item =
        parts_.measuring.selectAt(position) || parts_.annotating.selectAt(position);
    const std::optional<MenuPlace> place = is_drawn_item ? std::nullopt : menu.placeAt(position);
    if (!place || !pickFeature(*place, view.mapToGlobal(position).toPoint())) {
        clear();
    }
}

// Of several files, a point is easier to miss than a line, and a line than the inside of a polygon.
bool FeaturePicker::pickFeature(const MenuPlace& place, QPoint at)
{
    const auto vertex = vertexAt(place.map->georeference(), place.grid);
    if (!vertex) {
        return false;
    }
    const std::vector<VectorOverlays::Hit> hits =
        parts_.overlays.featuresAt(*vertex, kFeatureReachPoints * place.point_m, kAttributesMax);
    const auto hit = std::min_element(
        hits.begin(), hits.end(), [](const VectorOverlays::Hit& a, const VectorOverlays::Hit& b) {
            return a.shape < b.shape;
        });
    if (hit == hits.end()) {
        return false;
    }
    parts_.overlays.select(hit->feature);
    PlaceFacts facts;
    facts.facts.push_back({.name = tr("Vector file"), .value = hit->file});
    for (const auto& [name, value] : hit->attributes) {
        facts.facts.push_back({.name = name, .value = value});
    }
    showCard(facts, at);
    return true;
}

void FeaturePicker::showCard(const PlaceFacts& facts, QPoint at)
{
    const auto read = [facts] { return facts; };
    if (card_ && card_->isVisible()) { // it stays where the user has put it
        card_->setReader(read);
        card_->layout()->activate();
        if (card_->frameGeometry().contains(at)) { // it has become larger
            card_->showAt(at);
        }
        return;
    }
    closeCard();
    card_ = new PlaceDialog(read, PlaceDialog::Focus::Map, &parts_.window);
    card_->setAttribute(Qt::WA_DeleteOnClose);
    card_->setWindowTitle(tr("Feature"));
    connect(card_, &QDialog::finished, this, [this] { parts_.overlays.select(std::nullopt); });
    card_->showAt(at);
}

void FeaturePicker::closeCard()
{
    delete card_.data();
}

void FeaturePicker::clear()
{
    closeCard();
    parts_.overlays.select(std::nullopt);
}

} // namespace marsview
