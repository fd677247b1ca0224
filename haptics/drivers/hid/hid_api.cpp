#include "haptics/drivers/hid/hid_api.h"

#include <hidapi.h>

#include <cerrno>
#include <unistd.h>

namespace marsview {

const HidApi& systemHidApi()
{
    static const HidApi kApi{
        .enumerate = hid_enumerate, // which also calls hid_init
        .free_enumeration = hid_free_enumeration,
        .open_path = hid_open_path,
        .close = hid_close,
        .read_timeout = hid_read_timeout,
        .write = hid_write,
        .access_error = [](const char* path) { return access(path, R_OK | W_OK) == 0 ? 0 : errno; },
    };
    return kApi;
}

} // namespace marsview
