// The panel for touching with a device.
#pragma once

#include "ui/controllers/haptics/haptics_controller.h"

#include <QDir>
#include <QWidget>

class QAction;
class QActionGroup;
class QBoxLayout;
class QCheckBox;
class QComboBox;
class QLabel;
class QListWidget;
class QProgressBar;
class QPushButton;
class QSlider;

namespace marsview {

class LimitSlider;
class LoopTimes;

/// Devices, forces, timing of the loop, and recordings. Shows the controller's state and requests
/// changes from it. Searches for devices while it is visible.
class HapticsPanel final : public QWidget {
    Q_OBJECT

public:
    /// `contact_models` has an action for each model, see WindowActions.
    HapticsPanel(HapticsController& controller,
                 QActionGroup& contact_models,
                 QWidget* parent = nullptr);

    QListWidget* list() const noexcept { return list_; }

public Q_SLOTS:
    /// Asks for a file.
    void chooseRecording();
    void chooseReplay();
    /// Of what happened until now.
    void chooseFlightRecord();

protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void makeDevices(QBoxLayout& layout);
    void makeStop(QBoxLayout& layout);
    void makeForce(QBoxLayout& layout);
    void makeSliders(QBoxLayout& layout);
    void makeRecording(QBoxLayout& layout);
    void showDevices();
    void fitList();
    void markConnected();
    void showConnection();
    void showConnectButton();
    void showChoice();
    void showSettings();
    void showStiffness();
    void showStopped();
    void showRecording();
    void showState(const LoopState& state);
    void showNoState();
    void toggleConnection();
    QString chosenUri() const;

    HapticsController& controller_;
    DeviceSession& device_;
    QActionGroup& model_actions_;
    QListWidget* list_ = nullptr;
    QPushButton* connect_ = nullptr;
    QLabel* status_ = nullptr;
    QPushButton* stop_ = nullptr;
    QProgressBar* force_ = nullptr;
    QLabel* reason_ = nullptr;
    LimitSlider* stiffness_ = nullptr;
    QLabel* stiffness_text_ = nullptr;
    QLabel* stiffness_limit_ = nullptr; // shown where the device stands less than was chosen
    QSlider* share_ = nullptr;
    QLabel* share_text_ = nullptr;
    QComboBox* models_ = nullptr;
    QCheckBox* walls_ = nullptr;
    LoopTimes* times_ = nullptr;
    QPushButton* record_ = nullptr;
    QProgressBar* replayed_ = nullptr;
    QPushButton* replay_ = nullptr;
    QPushButton* flight_ = nullptr;
    QPushButton* rest_ = nullptr; // shown for an arm that does not know where it is
    QLabel* recording_ = nullptr;

    QString folder_ = QDir::homePath(); // of the file that was saved or read last
    bool is_filling_ = false;
};

} // namespace marsview
