// The status bar's account of the place under the pointer.
#pragma once

#include "core/terrain/ray_cast.h"
#include "ui/coordinate_text.h"

#include <QWidget>

#include <memory>
#include <optional>

class QActionGroup;
class QLabel;
class QToolButton;

namespace marsview {

class Dataset;

/// Shows a position, in the terms that the user picks, and the height there. Its parts keep their
/// width while numbers change.
class StatusReadout final : public QWidget {
    Q_OBJECT

public:
    explicit StatusReadout(QWidget* parent = nullptr);

    /// Null for none.
    void setDataset(const std::shared_ptr<const Dataset>& dataset);
    void setHit(const std::optional<RayHit>& hit);
    void setDisplay(CoordinateDisplay display);
    CoordinateDisplay display() const noexcept { return display_; }

    QString coordinateLabel() const;
    QString heightLabel() const;

private:
    void fillMenu();
    void refresh();

    std::shared_ptr<const Dataset> dataset_;
    std::optional<RayHit> hit_;
    CoordinateDisplay display_ = CoordinateDisplay::Map;
    QLabel* coordinate_ = nullptr;
    QToolButton* display_button_ = nullptr;
    QActionGroup* display_group_ = nullptr;
    QLabel* height_ = nullptr;
};

} // namespace marsview
