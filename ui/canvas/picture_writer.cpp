#include "ui/canvas/picture_writer.h"

#include "core/files/picture_file.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <QImageWriter>
#include <QSaveFile>

#include <algorithm>
#include <array>
#include <cstring>

namespace marsview {
namespace {

constexpr int kJpegQuality = 92;

// Takes no more once the job is canceled, which ends the encoder that writes to it.
class CancellableFile final : public QIODevice {
public:
    CancellableFile(QSaveFile& file, const JobMonitor* monitor)
        : file_(file)
        , monitor_(monitor)
    {
        open(QIODevice::WriteOnly);
    }
    bool isCanceled() const { return monitor_ != nullptr && monitor_->isCanceled(); }

protected:
    qint64 readData(char* /*data*/, qint64 /*size_max*/) override { return -1; }
    qint64 writeData(const char* data, qint64 size) override
    {
        return isCanceled() ? -1 : file_.write(data, size);
    }

private:
    QSaveFile& file_;
    const JobMonitor* monitor_;
};

Status writeAsTiff(const QImage& image, const QString& file)
{
    const QImage rgb = image.convertToFormat(QImage::Format_RGB888);
    Picture picture{.width = rgb.width(), .height = rgb.height(), .rgb = {}};
    const auto line = static_cast<std::size_t>(rgb.width()) * 3;
    picture.rgb.resize(line * static_cast<std::size_t>(rgb.height()));
    for (int y = 0; y < rgb.height(); ++y) {
        std::memcpy(picture.rgb.data() + line * static_cast<std::size_t>(y), rgb.constScanLine(y),
                    line);
    }
    return writeTiff(picture, file.toStdString());
}

} // namespace

Status checkPictureName(const QString& file)
{
    constexpr std::array kEndings{"png", "jpg", "jpeg", "tif", "tiff"};
    const QString ending = QFileInfo(file).suffix().toLower();
    if (std::any_of(kEndings.begin(), kEndings.end(),
                    [&](const char* known) { return ending == QLatin1String(known); })) {
        return Done{};
    }
    return Error{ErrorCode::Unsupported,
                 //: %1 is a file
                 QCoreApplication::translate(
                     "PictureWriter",
                     "%1: unknown picture format; choose a name that ends in .png, .jpg or .tif")
                     .arg(file)
                     .toStdString()};
}

Status writePictureFile(const QImage& picture, const QString& file, const JobMonitor* monitor)
{
    const Error canceled{ErrorCode::Canceled, "canceled"};
    if (monitor != nullptr && monitor->isCanceled()) {
        return canceled;
    }
    if (const Status known = checkPictureName(file); !known) {
        return known.error();
    }
    const QString ending = QFileInfo(file).suffix().toLower();
    if (ending == QLatin1String("tif") || ending == QLatin1String("tiff")) {
        return writeAsTiff(picture, file);
    }
    const bool is_jpeg = ending == QLatin1String("jpg") || ending == QLatin1String("jpeg");
    QSaveFile out(file);
    const auto refusal = [&](const QString& why) {
        return Error{
            ErrorCode::Unreadable,
            //: %1 is a file, %2 the reason
            QCoreApplication::translate("PictureWriter",
                                        "%1: cannot write the picture (%2); choose another folder")
                .arg(file, why)
                .toStdString()};
    };
    if (!out.open(QIODevice::WriteOnly)) {
        return refusal(out.errorString());
    }
    CancellableFile device(out, monitor);
    QImageWriter writer(&device, is_jpeg ? "jpeg" : "png");
    if (is_jpeg) {
        writer.setQuality(kJpegQuality);
    }
    const bool is_written = writer.write(picture);
    if (device.isCanceled()) {
        return canceled;
    }
    if (!is_written || out.error() != QFileDevice::NoError) {
        return refusal(out.error() != QFileDevice::NoError ? out.errorString()
                                                           : writer.errorString());
    }
    return out.commit() ? Status(Done{}) : Status(refusal(out.errorString()));
}

} // namespace marsview
