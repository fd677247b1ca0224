// Drawn items of any kind, for lists and marks of them.
#pragma once

#include "ui/drawing/drawn_item.h"

#include <QObject>
#include <QRectF>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace marsview {

/// GUI thread. Every change is a step of undo, except which item is the current one.
class DrawingBase : public QObject {
    Q_OBJECT

public:
    using QObject::QObject;

    /// What differs from the items that `known` is of, which becomes these. Null: there were none.
    /// Takes as long as what has changed.
    virtual DrawnChanges changesSince(std::shared_ptr<const void>& known) const = 0;
    /// 0: none.
    virtual std::uint32_t currentId() const = 0;
    /// Null if there is none.
    virtual const DrawnItem* itemOf(std::uint32_t id) const = 0;
    /// Where the name of an item belongs, in the view; empty if it is not in the picture.
    virtual std::optional<QPointF> namePlace(std::uint32_t id) const = 0;
    /// Whether clicks on the map place points.
    virtual bool isToolChosen() const = 0;
    virtual void select(std::uint32_t id) = 0;
    /// Selects the item whose vertex or line is near a position of the view. False if there is
    /// none.
    virtual bool selectAt(QPointF position) = 0;
    virtual void rename(std::uint32_t id, const QString& name) = 0;
    virtual void setNote(std::uint32_t id, const QString& note) = 0;
    /// Empty for the usual color.
    virtual void setColors(const std::vector<std::uint32_t>& ids,
                           const std::optional<Rgb8>& color) = 0;
    virtual void removeItems(const std::vector<std::uint32_t>& ids) = 0;
    /// Flies to where the whole item can be seen, and selects it.
    virtual void show(std::uint32_t id) = 0;

    /// Of the items that are shown, the current one's first. Of points that lie within a few points
    /// of the screen of each other, one. Valid until something changes.
    virtual const std::vector<DrawnHandle>& handles() const = 0;
    /// Of what handles() returns now. The same number as before if nothing that marks of the items
    /// depend on has changed.
    virtual std::uint64_t handlesRevision() const = 0;
    /// Boxes in the view that together cover the lines of the items, without the one to the
    /// pointer. Of very many lines, some.
    virtual std::vector<QRectF> lineBoxes() const = 0;

Q_SIGNALS:
    /// Items or the selection.
    void changed();
    /// The user has set the last point of an item.
    void placed(std::uint32_t id);
    /// What is on the screen may have moved: handles and labels.
    void moved();
    /// isToolChosen() may have changed.
    void toolChanged();
};

} // namespace marsview
