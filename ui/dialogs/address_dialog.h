// Opening a map that lies on a server.
#pragma once

#include <QDialog>
#include <QStringList>

class QComboBox;
class QLabel;
class QPushButton;

namespace marsview {

/// The error in an address, as a sentence; empty if the address may be opened.
QString problemOfAddress(const QString& address);

/// Asks for an address and says what can be opened there.
class AddressDialog final : public QDialog {
    Q_OBJECT

public:
    /// `history` is offered to choose from, the last first.
    explicit AddressDialog(const QStringList& history, QWidget* parent = nullptr);

Q_SIGNALS:
    void addressChosen(const QString& address);

private:
    void check();
    void choose();

    QComboBox* field_ = nullptr;
    QLabel* answer_ = nullptr;
    QPushButton* open_button_ = nullptr;
};

} // namespace marsview
