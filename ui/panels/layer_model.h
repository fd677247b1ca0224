// The layers of the session for Qt's views.
#pragma once

#include "core/session/layer_groups.h"
#include "core/session/session.h"
#include "core/view/color_ramp.h"
#include "ui/controllers/histogram_maker.h"
#include "ui/controllers/unplaced_layer.h"
#include "ui/text/number_text.h"

#include <QAbstractListModel>

#include <vector>

namespace marsview {

/// One row for each layer, top first; with layers on several bodies they are grouped, each group
/// below a row with the name of its body. Shows a session; asks for changes and never makes any.
///
/// A layer is checked if it is in the picture, unchecked if the user hides it, and partially
/// checked if it is visible for the user but the view cannot show it, alone or together with the
/// present layers.
class LayerModel final : public QAbstractListModel {
    Q_OBJECT

public:
    enum Role {
        SizeRole = Qt::UserRole, // "8,192 × 4,096"
        RangeRole,               // "−8,201 … 21,241 m"
        ReasonRole,              // why the view cannot show the layer; empty otherwise
        CanShowRole,             // with a reason: the view can show it instead of other layers
        NoteRole,                // that, or else that a preview is shown
        IsShownRole,
        IsActiveRole,
        IsHeaderRole, // the row is the name of a body
    };

    explicit LayerModel(QObject* parent = nullptr);

    void setSession(const Session& session);
    const Session& session() const noexcept { return session_; }
    void setHeightUnit(HeightUnit unit);
    /// The picture has all layers of one body, whatever their CRS.
    void setSceneOfBody(bool is_of_body);
    /// Those of the layers in that picture that it cannot show.
    void setUnplaced(std::vector<UnplacedLayer> layers);

    /// None for the name of a body.
    LayerId idAt(const QModelIndex& index) const;
    bool isHeader(const QModelIndex& index) const;
    QModelIndex indexOfLayer(LayerId id) const;
    // Of rows that are layers.

    /// Null while it is being counted.
    std::shared_ptr<const HeightHistogram> histogramAt(const QModelIndex& index) const;
    const ColorRamp& rampAt(const QModelIndex& index) const;

    int rowCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role) const override;
    bool setData(const QModelIndex& index, const QVariant& value, int role) override;
    Qt::ItemFlags flags(const QModelIndex& index) const override;
    Qt::DropActions supportedDropActions() const override { return Qt::MoveAction; }
    QStringList mimeTypes() const override;
    QMimeData* mimeData(const QModelIndexList& indexes) const override;
    /// Layers are moved within their group only.
    bool canDropMimeData(const QMimeData* data,
                         Qt::DropAction action,
                         int row,
                         int column,
                         const QModelIndex& parent) const override;
    bool dropMimeData(const QMimeData* data,
                      Qt::DropAction action,
                      int row,
                      int column,
                      const QModelIndex& parent) override;

Q_SIGNALS:
    void visibilityRequested(LayerId id, bool is_visible);
    void nameRequested(LayerId id, const QString& name);
    /// `index` counts in the order that results.
    void moveRequested(LayerId id, std::size_t index);

private:
    // A layer, or the name of a body above its layers.
    struct Row {
        bool is_header = false;
        std::size_t layer = 0; // index into the session; of a header, that of its topmost layer
        bool operator==(const Row&) const = default;
    };

    static std::vector<Row> rowsOf(const Session& session);
    const Layer& layerAt(const QModelIndex& index) const;
    LayerState stateAt(const QModelIndex& index) const;
    const UnplacedLayer* unplacedAt(const QModelIndex& index) const;
    QString reasonAt(const QModelIndex& index) const;
    QString toolTipAt(const QModelIndex& index) const;
    QString visibilityAt(const QModelIndex& index) const;
    QVariant headerRowData(const QModelIndex& index, int role) const;
    std::optional<std::size_t> dropIndex(const QMimeData* data, int row) const;

    Session session_;
    std::vector<Row> rows_;
    std::vector<LayerState> states_;
    bool is_scene_of_body_ = false;
    std::vector<UnplacedLayer> unplaced_;
    HeightUnit unit_ = HeightUnit::Meters;
    HistogramMaker* histograms_ = nullptr;
};

} // namespace marsview
