// Clicks on features of vector files, on measurements and on annotations.
#pragma once

#include "ui/text/place_facts.h"

#include <QObject>
#include <QPoint>
#include <QPointF>
#include <QPointer>

namespace marsview {

class AnnotationController;
class MapMenu;
class MeasureController;
class PlaceDialog;
class VectorOverlays;
struct MenuPlace;

/// Selects the clicked item. A feature of a vector file is drawn with a border, and a card next to
/// it shows its attributes. A click on something else, Esc and closing the card clear the
/// selection. GUI thread; must not outlive its parts.
class FeaturePicker final : public QObject {
    Q_OBJECT

public:
    struct Parts {
        QWidget& window;
        MeasureController& measuring;
        AnnotationController& annotating;
        VectorOverlays& overlays;
    };

    explicit FeaturePicker(const Parts& parts, QObject* parent = nullptr);

    /// A position of a view was clicked, whose places are those of its menu.
    void pick(const MapMenu& menu, const QWidget& view, QPointF position);
    /// Whether a feature of a vector file is selected.
    bool hasFeature() const;
    void clear();
    /// The card that is open; null for none.
    PlaceDialog* card() const;

private:
    bool pickFeature(const MenuPlace& place, QPoint at);
    void showCard(const PlaceFacts& facts, QPoint at);
    void closeCard();

    Parts parts_;
    QPointer<PlaceDialog> card_;
};

} // namespace marsview
