#include "app/gui/sample_map.h"

#include <QDir>
#include <QFileInfo>

namespace marsview {
namespace {

constexpr const char* kFile = "mars_mola_4ppd.tif";

} // namespace

QString sampleMapFor(const QString& program_folder)
{
    QDir folder(program_folder);
    const auto candidate = [&folder](const QString& path) {
        return QFileInfo(folder.filePath(path + QLatin1Char('/') + QLatin1String(kFile)));
    };
    const QFileInfo installed = candidate(QStringLiteral("../share/marsview/samples"));
    if (installed.isFile()) {
        return installed.canonicalFilePath();
    }
    do {
        const QFileInfo in_tree = candidate(QStringLiteral("resources/samples"));
        if (in_tree.isFile()) {
            return in_tree.canonicalFilePath();
        }
    } while (folder.cdUp());
    return {};
}

} // namespace marsview
