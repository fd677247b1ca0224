// The list of saved views, with their pictures.
#pragma once

#include "core/session/saved_view.h"

#include <QHash>
#include <QPixmap>
#include <QWidget>

#include <vector>

class QAction;
class QListWidget;
class QListWidgetItem;
class QStackedLayout;

namespace marsview {

/// What can be done with saved views; the same actions are in the menu.
struct SavedViewActions {
    QAction* save = nullptr;
    QAction* go_to = nullptr;
    QAction* update = nullptr;
    QAction* rename = nullptr;
    QAction* move_up = nullptr;
    QAction* move_down = nullptr;
    QAction* remove = nullptr;
    QAction* fly_through = nullptr;
};

/// Shows views in their order. Asks for changes; never makes any.
class SavedViewsPanel final : public QWidget {
    Q_OBJECT

public:
    explicit SavedViewsPanel(QWidget* parent = nullptr);

    /// Puts buttons and the context menu in place. Called once.
    void setActions(const SavedViewActions& actions);
    void setViews(const std::vector<SavedView>& views);
    void setThumbnail(ViewId id, const QPixmap& picture);
    /// Under its name in the list, and read aloud with it.
    void setDescription(ViewId id, const QString& text);

    /// ViewId::None without views.
    ViewId current() const;
    void select(ViewId id);
    /// Lets the user type a new name.
    void editName(ViewId id);

    QListWidget* list() const noexcept { return list_; }

Q_SIGNALS:
    void goRequested(ViewId id);
    void nameRequested(ViewId id, const QString& name);
    void moveRequested(ViewId id, std::size_t index);
    void currentChanged();
    /// Whether anyone can see the panel.
    void shown(bool is_shown);

protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;

private:
    QListWidgetItem* itemOf(ViewId id) const;

    QListWidget* list_ = nullptr;
    QWidget* empty_ = nullptr;
    QStackedLayout* pages_ = nullptr;
    QLayout* foot_ = nullptr;
    bool is_filling_ = false;
};

} // namespace marsview
