#include "ui/controllers/preferences.h"

#include <QSettings>
#include <QString>

#include <algorithm>
#include <array>
#include <string_view>

namespace marsview {
namespace {

// Words, so that people may edit the file.
constexpr std::array kThemes{"system", "light", "dark"};
constexpr std::array kUnits{"m", "ft"};
constexpr std::array kSystems{"geographic", "map"};
constexpr std::array kAngles{"decimal", "dms"};
constexpr std::array kLongitudes{"east360", "eastWest180", "west360"};
constexpr std::array kLatitudes{"planetocentric", "planetographic"};
constexpr const char* kUnknownBody = "-";
constexpr std::array kFrameRates{20, 30, 60};

template <typename Enum, std::size_t kCount>
Enum enumFrom(const QVariant& value, const std::array<const char*, kCount>& words, Enum otherwise)
{
    for (std::size_t i = 0; i < kCount; ++i) {
        if (value.toString() == QLatin1String(words[i])) {
            return static_cast<Enum>(i);
        }
    }
    return otherwise;
}

QString themeKey()
{
    return QStringLiteral("preferences/theme");
}

QString reconnectsKey()
{
    return QStringLiteral("preferences/reconnectsDevice");
}

QString languageKey()
{
    return QStringLiteral("preferences/language");
}

QString unitKey()
{
    return QStringLiteral("preferences/heightUnit");
}

QString antialiasingKey()
{
    return QStringLiteral("preferences/antialiasing");
}

QString frameRateKey()
{
    return QStringLiteral("preferences/framesPerSecond");
}

QString contactModelKey()
{
    return QStringLiteral("preferences/contactModel");
}

QString tileMemoryKey()
{
    return QStringLiteral("preferences/tileMemoryMB");
}

QString mapFolderKey()
{
    return QStringLiteral("preferences/mapFolder");
}

QString mapFolderBoundKey()
{
    return QStringLiteral("preferences/mapFolderGB");
}

QString fetchedBoundKey()
{
    return QStringLiteral("preferences/fetchedGB");
}

QString systemKey()
{
    return QStringLiteral("preferences/coordinateSystem");
}

QString anglesKey()
{
    return QStringLiteral("preferences/angles");
}

QString longitudesKey()
{
    return QStringLiteral("preferences/longitudes");
}

// One key a body below it; an unknown body has "-".
QString latitudesKey()
{
    return QStringLiteral("preferences/latitudes");
}

CoordinateFormat coordinatesFrom(const QSettings& settings)
{
    const CoordinateFormat standard;
    CoordinateFormat format;
    format.system = enumFrom(settings.value(systemKey()), kSystems, standard.system);
    format.angles = enumFrom(settings.value(anglesKey()), kAngles, standard.angles);
    for (std::size_t i = 0; i < kLongitudes.size(); ++i) {
        if (settings.value(longitudesKey()).toString() == QLatin1String(kLongitudes[i])) {
            format.longitudes = static_cast<LongitudeNotation>(i);
        }
    }
    const QString prefix = latitudesKey() + QLatin1Char('/');
    for (const QString& key : settings.allKeys()) {
        if (key.startsWith(prefix)) {
            const QString name = key.mid(prefix.size());
            const Body* body = bodyNamed(name.toStdString());
            const LatitudeKind usual = format.latitudesOn(body);
            if (body != nullptr || name == QLatin1String(kUnknownBody)) {
                format.setLatitudesOn(body, enumFrom(settings.value(key), kLatitudes, usual));
            }
        }
    }
    return format;
}

void saveCoordinates(const CoordinateFormat& format, QSettings& settings)
{
    const auto word = [](const auto& words, auto value) {
        return QLatin1String(words[static_cast<std::size_t>(value)]);
    };
    settings.setValue(systemKey(), word(kSystems, format.system));
    settings.setValue(anglesKey(), word(kAngles, format.angles));
    settings.setValue(longitudesKey(), format.longitudes ? word(kLongitudes, *format.longitudes)
                                                         : QLatin1String("body"));
    settings.remove(latitudesKey());
    for (const auto& [body, kind] : format.latitudes) {
        const QString name =
            body.empty() ? QString::fromLatin1(kUnknownBody) : QString::fromStdString(body);
        settings.setValue(latitudesKey() + QLatin1Char('/') + name, word(kLatitudes, kind));
    }
}

std::uint64_t bytesOf(int gigabytes)
{
    return static_cast<std::uint64_t>(gigabytes) * 1'000'000'000;
}

} // namespace

Preferences preferencesFrom(const QSettings& settings)
{
    const Preferences standard;
    Preferences preferences;
    preferences.language = settings.value(languageKey()).toString();
    preferences.theme = enumFrom(settings.value(themeKey()), kThemes, standard.theme);
    preferences.height_unit = enumFrom(settings.value(unitKey()), kUnits, standard.height_unit);
    preferences.coordinates = coordinatesFrom(settings);
    preferences.has_antialiasing =
        settings.value(antialiasingKey(), standard.has_antialiasing).toBool();
    const int rate = settings.value(frameRateKey()).toInt();
    const bool is_offered =
        std::find(kFrameRates.begin(), kFrameRates.end(), rate) != kFrameRates.end();
    preferences.frames_per_s = is_offered ? rate : standard.frames_per_s;
    preferences.contact_model =
        contactModelKind(settings.value(contactModelKey()).toString().toStdString())
            .value_or(standard.contact_model);
    preferences.reconnects_device =
        settings.value(reconnectsKey(), standard.reconnects_device).toBool();
    const int tile_memory_mb = settings.value(tileMemoryKey()).toInt();
    preferences.tile_memory_mb =
        tile_memory_mb > 0 ? std::max(tile_memory_mb, kTileMemoryMbMin) : 0;
    preferences.map_folder = settings.value(mapFolderKey()).toString();
    preferences.map_folder_gb = std::max(0, settings.value(mapFolderBoundKey()).toInt());
    preferences.fetched_gb = std::max(0, settings.value(fetchedBoundKey()).toInt());
    return preferences;
}

MapResources resourcesFor(const MapResources& standard, const Preferences& preferences)
{
    MapResources resources = standard;
    if (!preferences.map_folder.isEmpty() && !qEnvironmentVariableIsSet("MARSVIEW_CACHE_DIR")) {
        resources.folder = preferences.map_folder.toStdString();
    }
    if (preferences.map_folder_gb > 0) {
        resources.folder_bytes_max = bytesOf(preferences.map_folder_gb);
    }
    return resources;
}

std::uint64_t fetchedBytesMax(const Preferences& preferences)
{
    return preferences.fetched_gb > 0 ? bytesOf(preferences.fetched_gb) : kFetchedBytesMax;
}

void save(const Preferences& preferences, QSettings& settings)
{
    settings.setValue(languageKey(), preferences.language);
    settings.setValue(themeKey(),
                      QLatin1String(kThemes[static_cast<std::size_t>(preferences.theme)]));
    settings.setValue(unitKey(),
                      QLatin1String(kUnits[static_cast<std::size_t>(preferences.height_unit)]));
    saveCoordinates(preferences.coordinates, settings);
    settings.setValue(antialiasingKey(), preferences.has_antialiasing);
    settings.setValue(frameRateKey(), preferences.frames_per_s);
    const std::string_view model = contactModelName(preferences.contact_model);
    settings.setValue(contactModelKey(),
                      QString::fromUtf8(model.data(), static_cast<qsizetype>(model.size())));
    settings.setValue(reconnectsKey(), preferences.reconnects_device);
    settings.setValue(tileMemoryKey(), preferences.tile_memory_mb);
    settings.setValue(mapFolderKey(), preferences.map_folder);
    settings.setValue(mapFolderBoundKey(), preferences.map_folder_gb);
    settings.setValue(fetchedBoundKey(), preferences.fetched_gb);
}

} // namespace marsview
