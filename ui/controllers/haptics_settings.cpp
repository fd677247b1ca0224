#include "ui/controllers/haptics_settings.h"

#include <QSettings>

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

QString stiffnessKey()
{
    return QStringLiteral("haptics/stiffness");
}

QString forceKey()
{
    return QStringLiteral("haptics/forceShare");
}

QString wallsKey()
{
    return QStringLiteral("haptics/walls");
}

QString deviceKey()
{
    return QStringLiteral("haptics/device");
}

double numberFrom(const QVariant& value, double low, double high, double otherwise)
{
    bool is_number = false;
    const double number = value.toDouble(&is_number);
    return is_number && std::isfinite(number) ? std::clamp(number, low, high) : otherwise;
}

} // namespace

HapticsSettings hapticsSettingsFrom(const QSettings& settings)
{
    HapticsSettings haptics;
    haptics.stiffness_n_per_m = numberFrom(settings.value(stiffnessKey()), kStiffnessMin,
                                           kStiffnessMax, haptics.stiffness_n_per_m);
    haptics.force_share = numberFrom(settings.value(forceKey()), 0.0, 1.0, haptics.force_share);
    haptics.has_walls = settings.value(wallsKey(), haptics.has_walls).toBool();
    haptics.device = settings.value(deviceKey()).toString();
    return haptics;
}

void save(const HapticsSettings& haptics, QSettings& settings)
{
    settings.setValue(stiffnessKey(), haptics.stiffness_n_per_m);
    settings.setValue(forceKey(), haptics.force_share);
    settings.setValue(wallsKey(), haptics.has_walls);
    settings.setValue(deviceKey(), haptics.device);
}

} // namespace marsview
