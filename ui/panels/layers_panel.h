// The panel that lists the layers.
#pragma once

#include "core/session/session.h"
#include "ui/text/number_text.h"

#include <QWidget>

class QAction;
class QComboBox;
class QLabel;
class QListView;
class QSpinBox;
class QStackedLayout;
class QTimer;

namespace marsview {

class LayerModel;
class VectorFileList;

/// What can be done with the active layer; the same actions are in the menus.
struct LayerActions {
    QAction* open = nullptr;
    QAction* remove = nullptr;
    QAction* move_up = nullptr;
    QAction* move_down = nullptr;
    QAction* finest_first = nullptr; // of all layers
    QAction* rename = nullptr;
    QAction* go_to = nullptr;
    QAction* prepare = nullptr; // of a preview
};

/// A list that shows the session, and below it that of the vector files. Asks for changes; never
/// makes any.
class LayersPanel final : public QWidget {
    Q_OBJECT

public:
    explicit LayersPanel(const LayerActions& actions, QWidget* parent = nullptr);

    /// `can_feather`: the active layer's edges can be blended into layers below it.
    void setSession(const Session& session, bool can_feather);
    void setHeightUnit(HeightUnit unit);
    /// Lets the user type a new name for the active layer.
    void editName();

    QListView* list() const noexcept { return list_; }
    LayerModel* model() const noexcept { return model_; }
    VectorFileList* vectorFiles() const noexcept { return vector_files_; }

Q_SIGNALS:
    void activationRequested(LayerId id);
    void visibilityRequested(LayerId id, bool is_visible);
    void nameRequested(LayerId id, const QString& name);
    void moveRequested(LayerId id, std::size_t index);
    /// Empty for the ramp that suits the body.
    void rampRequested(LayerId id, const QString& ramp);
    /// Once a number of cells has been set for a moment.
    void featherRequested(LayerId id, std::size_t cells);

private:
    void showActive();
    void requestFeather();
    QString emptyText() const;

    LayerModel* model_ = nullptr;
    QListView* list_ = nullptr;
    VectorFileList* vector_files_ = nullptr;
    QLabel* empty_ = nullptr;
    QComboBox* ramps_ = nullptr;
    QLabel* feather_label_ = nullptr;
    QSpinBox* feather_ = nullptr;
    QTimer* feather_timer_ = nullptr; // runs while its number changes
    QStackedLayout* pages_ = nullptr;
    QString open_key_; // of the action
    bool is_filling_ = false;
};

} // namespace marsview
