// The color stretch of the active layer: joins menu, dialog and session.
#pragma once

#include "core/view/color_stretch.h"
#include "ui/text/number_text.h"

#include <QObject>

namespace marsview {

class HistogramMaker;
class SessionController;
class StretchDialog;
struct WindowActions;

/// Lives in the GUI thread; `session`, `actions`, `map` and the parent outlive it.
class StretchControl final : public QObject {
    Q_OBJECT

public:
    /// The dialog opens in the corner of `map`.
    StretchControl(SessionController& session,
                   const WindowActions& actions,
                   const QWidget& map,
                   QWidget* parent);

    void setHeightUnit(HeightUnit unit);
    /// Opens the dialog, or brings it to the front.
    void open();
    StretchDialog* dialog() const noexcept { return dialog_; }

private:
    void choose(StretchKind kind);
    void show();
    bool isInScene() const; // the active layer

    SessionController& session_;
    const WindowActions& actions_;
    const QWidget& map_;
    bool is_placed_ = false;
    HistogramMaker* histograms_ = nullptr;
    StretchDialog* dialog_ = nullptr; // hidden while it is not used
};

} // namespace marsview
