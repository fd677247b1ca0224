// How a layer looks in the list.
#pragma once

#include <QStyledItemDelegate>

namespace marsview {

class LayerModel;

/// Checkbox and name; size and range; the histogram in the colours of the ramp; and, where a layer
/// is not shown, why, or that it is a preview. For views of a LayerModel.
class LayerDelegate final : public QStyledItemDelegate {
    Q_OBJECT

public:
    explicit LayerDelegate(LayerModel& model, QObject* parent = nullptr);

    void paint(QPainter* painter,
               const QStyleOptionViewItem& option,
               const QModelIndex& index) const override;
    QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;
    void updateEditorGeometry(QWidget* editor,
                              const QStyleOptionViewItem& option,
                              const QModelIndex& index) const override;
    bool editorEvent(QEvent* event,
                     QAbstractItemModel* model,
                     const QStyleOptionViewItem& option,
                     const QModelIndex& index) override;

private:
    struct Places;
    Places placesOf(const QStyleOptionViewItem& option, const QModelIndex& index) const;
    void paintHistogram(QPainter& painter, const QRect& place, const QModelIndex& index) const;

    LayerModel& model_;
};

} // namespace marsview
