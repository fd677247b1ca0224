// Choosing preferences.
#pragma once

#include "ui/controllers/preferences.h"
#include "ui/dialogs/coordinates_page.h"
#include "ui/dialogs/large_maps_page.h"

#include <QDialog>

class QCheckBox;
class QComboBox;
class QLabel;
class QTabWidget;

namespace marsview {

/// Every choice takes effect at once; there is nothing to confirm. Preferences that are chosen
/// elsewhere (the contact model, in its menu) stay as they are.
class PreferencesDialog final : public QDialog {
    Q_OBJECT

public:
    PreferencesDialog(const Preferences& preferences,
                      const LargeMapDefaults& standard,
                      QWidget* parent = nullptr);

    QTabWidget* pages() const noexcept { return pages_; }
    /// The body of the current map; null if unknown. Choices for a body apply to it first.
    void setBody(const Body* body) { coordinates_->setBody(body); }

    Preferences preferences() const;

Q_SIGNALS:
    void preferencesChanged(const Preferences& preferences);

private:
    void fill(const Preferences& preferences);

    Preferences before_;
    QComboBox* language_ = nullptr;
    QLabel* restart_note_ = nullptr; // once another language is chosen
    QComboBox* theme_ = nullptr;
    QComboBox* height_unit_ = nullptr;
    QComboBox* frame_rate_ = nullptr;
    QCheckBox* reconnects_ = nullptr;
    QCheckBox* antialiasing_ = nullptr;
    CoordinatesPage* coordinates_ = nullptr;
    LargeMapsPage* large_maps_ = nullptr;
    QTabWidget* pages_ = nullptr;
};

} // namespace marsview
