// Writing pictures into files.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"

#include <QImage>
#include <QString>

namespace marsview {

/// Unsupported where the ending of the name is none of those of writePictureFile().
Status checkPictureName(const QString& file);

/// Writes PNG, JPEG or TIFF, as the name ends: .png, .jpg, .jpeg, .tif or .tiff. A file of that
/// name is replaced only by a whole picture. Unsupported for another ending, Unreadable where the
/// file cannot be written; the sentence says what to do. Canceled, and nothing replaced, where
/// `monitor`, which may be null, is canceled before PNG and JPEG are complete, or TIFF is begun.
/// Any thread.
Status
writePictureFile(const QImage& picture, const QString& file, const JobMonitor* monitor = nullptr);

} // namespace marsview
