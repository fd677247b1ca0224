// The list of keys and what the mouse does.
#pragma once

#include <QDialog>

namespace marsview {

class KeysDialog final : public QDialog {
    Q_OBJECT

public:
    /// Lists the keys of `actions`.
    explicit KeysDialog(const QList<QAction*>& actions, QWidget* parent = nullptr);
};

} // namespace marsview
