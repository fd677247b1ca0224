// A message to the user about a map, the picture or a device, with actions that can solve it.
#pragma once

#include <QList>
#include <QString>

#include <functional>

namespace marsview {

/// A button of a notice. `run` is called in the GUI thread.
struct NoticeAction {
    QString text;
    std::function<void()> run;
};

struct Notice {
    /// Identifies the notice from one update to the next; unique among all notices.
    QString id;
    /// One or more sentences.
    QString text;
    /// One becomes a button, several become a button with a menu.
    QList<NoticeAction> actions{};
    /// On the button of several actions.
    QString menu_text{};
    /// Shows where the notice comes from. Empty if there is nothing more to see.
    std::function<void()> show_details{};
};

} // namespace marsview
