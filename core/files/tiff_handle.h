// libtiff on shared open files.
#pragma once

#include "core/files/shared_file.h"

#include <memory>
#include <string>
#include <tiffio.h>

namespace marsview {

struct TiffCloser {
    void operator()(TIFF* file) const { TIFFClose(file); }
};
using TiffHandle = std::unique_ptr<TIFF, TiffCloser>;

/// A handle of its own on an open file, for one thread at a time. `options` has the handlers of
/// messages, which name `path`. Null if the file is not a TIFF that libtiff opens.
TiffHandle openTiff(std::shared_ptr<const SharedFile> file,
                    const std::string& path,
                    SharedFile::Access access,
                    TIFFOpenOptions* options);

} // namespace marsview
