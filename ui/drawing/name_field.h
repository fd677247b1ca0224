// The field in which an item that was just placed gets its name.
#pragma once

#include <QLineEdit>
#include <QPointer>

#include <cstdint>

namespace marsview {

class DrawingBase;

/// Opens over the view next to an item that was placed, with its name selected, and follows it.
/// Enter, a click elsewhere or the keys that move the map keep what was typed, as a step of undo;
/// Escape leaves the name as it was. GUI thread.
class NameField final : public QLineEdit {
    Q_OBJECT

public:
    /// A child of `view`, in which `drawing` draws.
    NameField(DrawingBase& drawing, QWidget& view);

    /// Of the item that is being named; 0 while the field is closed.
    std::uint32_t item() const noexcept { return item_; }
    /// Closes the field. The item gets the name that was typed, if it is one.
    void keep();

protected:
    bool event(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void openFor(std::uint32_t item);
    void follow();
    void close();

    QPointer<DrawingBase> drawing_;
    QWidget& view_;
    std::uint32_t item_ = 0;
};

} // namespace marsview
