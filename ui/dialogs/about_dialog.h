// The About dialog: version, license, libraries and graphics driver.
#pragma once

#include <QDialog>
#include <QString>

namespace marsview {

/// Version, libraries, graphics driver and licence.
class AboutDialog final : public QDialog {
    Q_OBJECT

public:
    /// `graphics` is the driver's name for itself.
    explicit AboutDialog(const QString& graphics, QWidget* parent = nullptr);
};

} // namespace marsview
