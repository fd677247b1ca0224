// Choosing preferences.
#pragma once

#include "ui/preferences.h"

#include <QDialog>

class QCheckBox;
class QComboBox;

namespace marsview {

/// Every choice takes effect at once; there is nothing to confirm. Preferences that are chosen
/// elsewhere (the contact model, in its menu) stay as they are.
class PreferencesDialog final : public QDialog {
    Q_OBJECT

public:
    explicit PreferencesDialog(const Preferences& preferences, QWidget* parent = nullptr);

    Preferences preferences() const;

Q_SIGNALS:
    void preferencesChanged(const Preferences& preferences);

private:
    void fill(const Preferences& preferences);

    Preferences before_;
    QComboBox* theme_ = nullptr;
    QComboBox* height_unit_ = nullptr;
    QComboBox* frame_rate_ = nullptr;
    QCheckBox* antialiasing_ = nullptr;
};

} // namespace marsview
