#include "core/sources/source_stamp.h"

#include "core/files/file_stamp.h"
#include "core/files/remote_raster.h"
#include "core/sources/source_files.h"

namespace marsview {

SourceStamp stampOf(const std::string& path)
{
    SourceStamp stamp;
    if (remoteNameFor(path)) {
        return stamp;
    }
    stamp.files = sourceFilesOf(path);
    if (stamp.files.empty()) {
        stamp.files.push_back(path);
    }
    stamp.text = stampTextOf(stamp.files);
    return stamp;
}

bool isUntouched(const SourceStamp& then)
{
    return stampTextOf(then.files) == then.text;
}

} // namespace marsview
