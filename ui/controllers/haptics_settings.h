// What the user has set about touching with a device.
#pragma once

#include <QString>

class QSettings;

namespace marsview {

struct HapticsSettings {
    double stiffness_n_per_m = 300.0; // wanted; the device may stand less
    double force_share = 1.0;         // of all forces, 0 to 1
    bool has_walls = true;
    QString device{}; // its URI, to be connected at the next start; empty for none

    bool operator==(const HapticsSettings&) const = default;
};

inline constexpr double kStiffnessMin = 10.0; // N/m, that can be set
inline constexpr double kStiffnessMax = 2000.0;

/// Defaults for whatever is missing or makes no sense.
HapticsSettings hapticsSettingsFrom(const QSettings& settings);
void save(const HapticsSettings& haptics, QSettings& settings);

} // namespace marsview
