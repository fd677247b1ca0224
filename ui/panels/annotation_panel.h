// The panel of the annotations.
#pragma once

#include <QWidget>

class QAction;
class QLabel;

namespace marsview {

class AnnotationController;
class AnnotationList;

/// Requests changes from the controller, and shows its state.
class AnnotationPanel final : public QWidget {
    Q_OBJECT

public:
    /// With buttons for the actions that import and export.
    AnnotationPanel(AnnotationController& controller,
                    QAction& import_file,
                    QAction& export_file,
                    QWidget* parent = nullptr);

    AnnotationList* list() const noexcept { return list_; }
    /// Low: most of the window is for the map.
    QSize sizeHint() const override;

private:
    void showState();

    AnnotationController& controller_;
    AnnotationList* list_ = nullptr;
    QLabel* hint_ = nullptr;
};

} // namespace marsview
