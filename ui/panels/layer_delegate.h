// How a layer looks in the list.
#pragma once

#include <QStyledItemDelegate>

namespace marsview {

class LayerModel;

/// Checkbox and name; size and range; the histogram in the colors of the ramp; that it is a
/// preview, or why the view cannot show the layer, with a button that shows it. The names of bodies
/// are headings. For views of a LayerModel.
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

    /// Where the button that shows a layer is; empty if there is none.
    QRect showButtonOf(const QStyleOptionViewItem& option, const QModelIndex& index) const;

private:
    struct Places;
    Places placesOf(const QStyleOptionViewItem& option, const QModelIndex& index) const;
    void paintHeader(QPainter& painter,
                     const QStyleOptionViewItem& option,
                     const QModelIndex& index) const;
    void paintShowButton(QPainter& painter,
                         const QStyleOptionViewItem& option,
                         const QRect& place) const;
    void paintHistogram(QPainter& painter, const QRect& place, const QModelIndex& index) const;

    LayerModel& model_;
};

} // namespace marsview
