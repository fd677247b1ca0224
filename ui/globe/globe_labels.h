// Names of places on the globe.
#pragma once

#include "core/session/name_labels.h"
#include "ui/widgets/labels_overlay.h"

#include <QRectF>

#include <memory>
#include <vector>

namespace marsview {

class GlobeView;

/// No label lies over another, over an overlay or the stylus, or names what the terrain or the
/// horizon hides.
class GlobeLabels final : public LabelsOverlay {
    Q_OBJECT

public:
    explicit GlobeLabels(GlobeView& globe);

    /// Null: none.
    void setNames(std::shared_ptr<const Gazetteer> names);
    void setNamesShown(bool is_shown);

    using Label = PlacedName;
    const std::vector<Label>& labels() const noexcept { return labels_; }

protected:
    void showSight() override;
    void paintEvent(QPaintEvent* event) override;

private:
    void showScene();
    QRectF aroundStylus() const;

    GlobeView& globe_;
    std::shared_ptr<const Gazetteer> gazetteer_;
    std::unique_ptr<NameLabels> names_;          // on the terrain that is shown
    std::vector<std::weak_ptr<const Map>> maps_; // that it was made for
    bool are_names_shown_ = true;
    std::vector<Label> labels_;
};

} // namespace marsview
