// The layers of the session as Qt's views want them.
#pragma once

#include "core/session/session.h"
#include "core/view/color_ramp.h"
#include "ui/number_text.h"
#include "ui/panels/histogram_maker.h"

#include <QAbstractListModel>

#include <vector>

namespace marsview {

/// One row a layer, top first. Shows a session; asks for changes and never makes any.
class LayerModel final : public QAbstractListModel {
    Q_OBJECT

public:
    enum Role {
        SizeRole = Qt::UserRole, // "8,192 × 4,096"
        RangeRole,               // "−8,201 … 21,241 m"
        ReasonRole,              // why the layer is not shown; empty where it is, or is hidden
        NoteRole,                // that, or else that a preview is shown
        IsShownRole,
        IsActiveRole,
    };

    explicit LayerModel(QObject* parent = nullptr);

    void setSession(const Session& session);
    const Session& session() const noexcept { return session_; }
    void setHeightUnit(HeightUnit unit);

    LayerId idAt(const QModelIndex& index) const;
    QModelIndex indexOfLayer(LayerId id) const;
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
    const Layer& layerAt(const QModelIndex& index) const;
    QString reasonAt(const QModelIndex& index) const;

    Session session_;
    std::vector<LayerState> states_;
    HeightUnit unit_ = HeightUnit::Metres;
    HistogramMaker* histograms_ = nullptr;
};

} // namespace marsview
