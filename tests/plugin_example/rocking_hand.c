/*
 * An example of a device plugin: a simulated hand that needs no hardware. It rocks back and forth,
 * and yields to forces as if on a soft spring. Copy the file and replace the arithmetic with calls
 * to your device.
 *
 *     cmake -B build && cmake --build build && cmake --install build
 *
 * or, without CMake,
 *
 *     cc -shared -fPIC $(pkg-config --cflags marsview-plugin) rocking_hand.c -lm -o rocking_hand.so
 *
 * and then: marsview-cli devices
 */
#define _POSIX_C_SOURCE 200809L

#include <marsview/plugin_abi.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

struct MarsviewDevice {
    int64_t began_ns;
    double force_n[3];
};

static int64_t steadyNs(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

static void enumerateDevices(MarsviewFound found, void* self)
{
    const MarsviewFoundDevice device = {"left", "Rocking hand", NULL};
    found(self, &device);
}

static MarsviewDevice* openDevice(const char* id, char* error, uint32_t error_bytes)
{
    MarsviewDevice* device;
    if (id[0] != '\0' && strcmp(id, "left") != 0) {
        snprintf(error, error_bytes, "unknown hand %s; available: left", id);
        return NULL;
    }
    device = calloc(1, sizeof *device);
    if (device == NULL) {
        snprintf(error, error_bytes, "out of memory");
        return NULL;
    }
    device->began_ns = steadyNs();
    return device;
}

static void closeDevice(MarsviewDevice* device)
{
    free(device);
}

static uint32_t describeDevice(MarsviewDevice* device, MarsviewCapabilities* capabilities)
{
    int axis;
    (void)device;
    for (axis = 0; axis < 3; ++axis) {
        capabilities->workspace_low_m[axis] = -0.1;
        capabilities->workspace_high_m[axis] = 0.1;
    }
    capabilities->force_n_peak = 4.0;
    capabilities->force_n_continuous = 1.0;
    capabilities->stiffness_n_per_m_max = 800.0;
    capabilities->rate_hz = 1000.0;
    capabilities->axes_in = 3;
    capabilities->axes_out = 3;
    capabilities->buttons = 1;
    snprintf(capabilities->name, sizeof capabilities->name, "Example: rocking hand");
    return MARSVIEW_FINE;
}

static uint32_t readDevice(MarsviewDevice* device, MarsviewSample* sample)
{
    const double give_m_per_n = 0.005;
    const double turns_per_s = 0.5;
    const int64_t now_ns = steadyNs();
    const double s = (double)(now_ns - device->began_ns) * 1e-9;
    sample->position_m[0] =
        0.05 * sin(6.283185307179586 * turns_per_s * s) + give_m_per_n * device->force_n[0];
    sample->position_m[1] = give_m_per_n * device->force_n[1];
    sample->position_m[2] = give_m_per_n * device->force_n[2];
    sample->time_ns = now_ns;
    return MARSVIEW_FINE;
}

static uint32_t writeDevice(MarsviewDevice* device, const double force_n[3])
{
    memcpy(device->force_n, force_n, sizeof device->force_n);
    return MARSVIEW_FINE;
}

const MarsviewPlugin* marsviewHapticPlugin(void)
{
    static const MarsviewPlugin plugin = {
        .abi_version = MARSVIEW_PLUGIN_ABI_VERSION,
        .plugin_bytes = sizeof(MarsviewPlugin),
        .capabilities_bytes = sizeof(MarsviewCapabilities),
        .sample_bytes = sizeof(MarsviewSample),
        .found_device_bytes = sizeof(MarsviewFoundDevice),
        .name = "Rocking hand, an example",
        .enumerate = enumerateDevices,
        .open = openDevice,
        .close = closeDevice,
        .capabilities = describeDevice,
        .read = readDevice,
        .write = writeDevice,
    };
    return &plugin;
}
