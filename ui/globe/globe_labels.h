// Names of places on the globe.
#pragma once

#include "core/session/name_labels.h"
#include "ui/widgets/rimmed_label.h"

#include <QHash>
#include <QPixmap>
#include <QTimer>
#include <QWidget>

#include <memory>
#include <optional>
#include <vector>

namespace marsview {

class GlobeView;

/// Covers the globe and is transparent to the mouse. No label lies over another, over an overlay or
/// the stylus, or names what the terrain or the horizon hides.
class GlobeLabels final : public QWidget {
    Q_OBJECT

public:
    explicit GlobeLabels(GlobeView& globe);

    /// Null: none.
    void setNames(std::shared_ptr<const Gazetteer> names);
    void setNamesShown(bool is_shown);
    /// Widgets that labels keep clear of while they are visible.
    void setObstacles(std::vector<QWidget*> obstacles);

    struct Label {
        QString text;
        QRectF box; // in points of the screen
        LabelFont size = LabelFont::Small;
        std::optional<QPointF> point; // next to the label
    };
    const std::vector<Label>& labels() const noexcept { return labels_; }

protected:
    void paintEvent(QPaintEvent* event) override;
    void changeEvent(QEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void showScene();
    void showSight();
    void placeLabels();
    QRectF aroundStylus() const;
    const QPixmap& picture(const Label& label);

    GlobeView& globe_;
    std::shared_ptr<const Gazetteer> gazetteer_;
    std::unique_ptr<NameLabels> names_;          // on the terrain that is shown
    std::vector<std::weak_ptr<const Map>> maps_; // that it was made for
    std::vector<QWidget*> obstacles_;
    QTimer obstacles_timer_; // until all of them have moved
    bool are_names_shown_ = true;
    std::vector<Label> labels_;
    QHash<QString, QPixmap> pictures_; // of texts, by text and size
};

} // namespace marsview
