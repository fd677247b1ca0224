/*
 * How a haptic device joins MarsView from outside: the one public header. C99 and C++11.
 *
 * A plugin is a shared library with one exported function, marsviewHapticPlugin, which returns a
 * table of functions. Put it into ~/.local/share/marsview/plugins, into lib/marsview/plugins of the
 * program's installation, or anywhere with MARSVIEW_PLUGIN_PATH or "plugin:/path/of/it.so".
 *
 * Units and axes. Metres, newtons, radians, nanoseconds. x right, y away from the user, z up. A
 * plugin converts its own device's units and axes to these.
 *
 * Growing. Structs grow at their end only. A table says how large its structs were when the plugin
 * was compiled; the program hands over at least that much room, zeroed, and takes what is missing
 * as zero. So plugins keep working with newer programs, and their authors need not check sizes.
 *
 * Threads. All calls for one device come one at a time. `open`, `capabilities` and `close` may take
 * a second or two and come from any thread. `read` and `write` come from the thread of the servo
 * loop, every millisecond: they take microseconds, and neither wait, allocate nor lock. A device
 * whose transport blocks needs a thread of its own, and answers with the newest value. While no
 * tick runs, `write` may come from another thread as well, with zero, to bring the motors to rest.
 *
 * Safety. A force stays on until the next `write`, so a plugin or its device has to take it away by
 * itself when no `write` has come for 20 ms: the program cannot while `read` or `write` hangs, nor
 * once it has crashed. A tick that takes longer than its period, or comes 10 ms late, makes the
 * program let go. A plugin that hangs in `read`, `write`, `stop_clock` or `close` is left alone after
 * a second or two, with its device, until the program ends.
 *
 * The program drops a plugin, with the reason shown to the user, that is of another version, that
 * lacks a function, that states an impossible device, that takes too long to open, or whose samples
 * are not finite, far outside the workspace, or jump.
 */
#ifndef MARSVIEW_PLUGIN_ABI_H
#define MARSVIEW_PLUGIN_ABI_H

#include <stdint.h>

/* NOLINTBEGIN(modernize-use-using): C has no other way */

#ifdef __cplusplus
extern "C" {
#endif

/* Changes only when plugins have to be compiled anew. */
#define MARSVIEW_PLUGIN_ABI_VERSION 1u

/* The exported function. */
#define MARSVIEW_PLUGIN_SYMBOL "marsviewHapticPlugin"
#define MARSVIEW_PLUGIN_EXPORT __attribute__((visibility("default")))

/* The plugin's own: the program holds pointers to it and never looks inside. */
typedef struct MarsviewDevice MarsviewDevice;

/* What `read`, `write` and others answer. */
#define MARSVIEW_FINE 0u
#define MARSVIEW_UNREADY 1u  /* not usable now (not calibrated, emergency stop); may recover */
#define MARSVIEW_LOST 2u     /* unplugged or dead; never recovers, is closed and opened anew */
#define MARSVIEW_FINISHED 3u /* a replayed recording has ended */

/* Bits of MarsviewCapabilities.flags. */
#define MARSVIEW_OWNS_CLOCK 1u   /* the device calls a tick from a thread of its own */
#define MARSVIEW_HAS_PRESENCE 2u /* it tells by is_held whether somebody holds it */

/* What a device says of itself; constant while it is open. */
typedef struct MarsviewCapabilities {
    double workspace_low_m[3]; /* corners of the box that the hand reaches */
    double workspace_high_m[3];
    double force_n_peak;          /* for moments; 0: it feels, but cannot push */
    double force_n_continuous;    /* without getting hot; 0: not stated, taken as the peak */
    double stiffness_n_per_m_max; /* of a stable wall, at rate_hz; 0: not stated, taken as 300 */
    double rate_hz;               /* of its samples: 200 to 10000 */
    uint32_t axes_in;             /* 3: position; 6: orientation as well */
    uint32_t axes_out;            /* of force: 0 to 6 */
    uint32_t buttons;             /* 0 to 32 */
    uint32_t flags;
    char name[64]; /* for people: maker and model; UTF-8 */
} MarsviewCapabilities;

typedef struct MarsviewSample {
    double position_m[3];
    double twist_rad; /* of the stylus about its axis; 0 where axes_in is 3 */
    /* CLOCK_MONOTONIC when it was measured; 0 means just now. The force goes to zero where that is
     * more than 15 ms ago or ahead, as it is with another clock. */
    int64_t time_ns;
    uint32_t buttons; /* bit 0: the stylus button */
    uint32_t is_held; /* 0 in the inkwell; looked at with MARSVIEW_HAS_PRESENCE only */
} MarsviewSample;

/* A device that could be opened, or why it cannot. */
typedef struct MarsviewFoundDevice {
    const char* id;     /* what `open` takes; no line breaks */
    const char* name;   /* for people */
    const char* reason; /* null or "" where it can be opened; otherwise one sentence */
} MarsviewFoundDevice;

/* The program's: to be called once per device during `enumerate`; it copies what it is given. */
typedef void (*MarsviewFound)(void* self, const MarsviewFoundDevice* device);

/* The program's: to be called once per period between start_clock and stop_clock. */
typedef void (*MarsviewTick)(void* self);

typedef struct MarsviewPlugin {
    uint32_t abi_version;        /* MARSVIEW_PLUGIN_ABI_VERSION; stands first in every version */
    uint32_t plugin_bytes;       /* sizeof(MarsviewPlugin) */
    uint32_t capabilities_bytes; /* sizeof(MarsviewCapabilities) */
    uint32_t sample_bytes;       /* sizeof(MarsviewSample) */
    uint32_t found_device_bytes; /* sizeof(MarsviewFoundDevice) */
    uint32_t reserved;           /* 0 */
    const char* name;            /* of the plugin, for people */

    /* Tells of all devices that are there now. */
    void (*enumerate)(MarsviewFound found, void* self);

    /* The device with this id, or the first one where id is "". Null where that fails, with one
     * sentence in `error`, which has room for error_bytes with the ending 0. */
    MarsviewDevice* (*open)(const char* id, char* error, uint32_t error_bytes);

    /* Leaves the motors without force. */
    void (*close)(MarsviewDevice* device);

    /* Fills in what the device is; MARSVIEW_FINE, or it is closed again. */
    uint32_t (*capabilities)(MarsviewDevice* device, MarsviewCapabilities* capabilities);

    /* The newest sample. */
    uint32_t (*read)(MarsviewDevice* device, MarsviewSample* sample);

    /* The force on the hand from now on. Where the answer is not MARSVIEW_FINE the motors have to be
     * without force. */
    uint32_t (*write)(MarsviewDevice* device, const double force_n[3]);

    /* Both null unless the device owns the clock. start_clock answers MARSVIEW_FINE, and from then
     * on the device calls tick(self) once per period on its own thread; the tick calls `read` and
     * `write`. No tick runs or begins after stop_clock has returned. */
    uint32_t (*start_clock)(MarsviewDevice* device, MarsviewTick tick, void* self);
    void (*stop_clock)(MarsviewDevice* device);
} MarsviewPlugin;

/* What a plugin exports. The table lives as long as the program. */
MARSVIEW_PLUGIN_EXPORT const MarsviewPlugin* marsviewHapticPlugin(void);

/* NOLINTEND(modernize-use-using) */

#ifdef __cplusplus
}
#endif

#endif
