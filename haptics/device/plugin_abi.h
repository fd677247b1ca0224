/*
 * The interface for haptic device plugins: the only public header. C99 and C++11.
 *
 * A plugin is a shared library with one exported function, marsviewHapticPlugin, which returns a
 * table of functions. Put it into ~/.local/share/marsview/plugins, into lib/marsview/plugins of the
 * program's installation, or anywhere with MARSVIEW_PLUGIN_PATH or "plugin:/path/of/it.so".
 *
 * Units and axes. Meters, newtons, radians, nanoseconds. The workspace frame is right-handed: x
 * right, y away from the user, z up, as seen by a user in front of the device. A plugin converts
 * its device's units and axes to these.
 *
 * Orientation. The reference orientation of a stylus is level, with the tip away from the user (+y)
 * and the back end toward the user (-y). `orientation` is the rotation from there to the present
 * orientation, in the workspace frame; rotations are positive by the right-hand rule. `twist_rad`
 * is the turn of the stylus about its own axis, positive counter-clockwise seen from its back end:
 * with the tip down, seen from above. While the stylus grabs, the map turns in the same sense.
 * Vendors differ: the third gimbal angle of OpenHaptics, for example, is positive clockwise.
 *
 * Compatibility. New fields are added only at the end of a struct. A table states how large its
 * structs were when the plugin was compiled; the program passes at least that much zeroed memory
 * and treats missing fields as zero. So plugins keep working with newer programs, and their authors
 * need not check sizes.
 *
 * Threads. Calls for one device never overlap, except for `message`. `open`, `capabilities` and
 * `close` may take a second or two and may be called from any thread. `read` and `write` are called
 * by the servo thread every millisecond: they take microseconds, and do not wait, allocate or lock.
 * A device whose transport blocks needs its own thread and returns the latest value. While no tick
 * runs, another thread may also call `write`, with zero, to bring the motors to rest. `message` is
 * called by another thread than `read` and `write`, possibly while they run, but never after
 * `close` was called.
 *
 * Safety. A force stays on until the next `write`, so the plugin or the device itself must turn it
 * off if no `write` has arrived for 20 ms: the program cannot do so while `read` or `write` hangs,
 * nor after a crash. If a tick takes longer than its period, or starts 10 ms late, the program
 * turns the force off. If a plugin hangs in `read`, `write`, `stop_clock` or `close`, the program
 * abandons it and its device after a second or two, until the program ends.
 *
 * The program rejects a plugin, and shows the user the reason, if it has another version, lacks a
 * function, states an implausible device, takes too long to open, or delivers samples that are not
 * finite, far outside the workspace, or that jump.
 */
#ifndef MARSVIEW_PLUGIN_ABI_H
#define MARSVIEW_PLUGIN_ABI_H

#include <stdint.h>

/* NOLINTBEGIN(modernize-use-using): C has no alias declarations */

#ifdef __cplusplus
extern "C" {
#endif

/* Changes only when plugins have to be recompiled. */
#define MARSVIEW_PLUGIN_ABI_VERSION 1u

/* The exported function. */
#define MARSVIEW_PLUGIN_SYMBOL "marsviewHapticPlugin"
#define MARSVIEW_PLUGIN_EXPORT __attribute__((visibility("default")))

/* Owned by the plugin: the program holds pointers to it and never looks inside. */
typedef struct MarsviewDevice MarsviewDevice;

/* Results of `read`, `write` and others. */
#define MARSVIEW_FINE 0u
#define MARSVIEW_UNREADY 1u  /* not usable now (not calibrated, emergency stop); may recover */
#define MARSVIEW_LOST 2u     /* unplugged or dead; never recovers, must be opened again */
#define MARSVIEW_FINISHED 3u /* a replayed recording has ended */

/* Bits of MarsviewCapabilities.flags. */
#define MARSVIEW_OWNS_CLOCK 1u   /* the device calls a tick from its own thread */
#define MARSVIEW_HAS_PRESENCE 2u /* is_held reports whether the stylus is held */

/* What a device reports about itself; constant while it is open. */
typedef struct MarsviewCapabilities {
    double workspace_low_m[3]; /* corners of the end effector's reach */
    double workspace_high_m[3];
    double force_n_peak;          /* short-term; 0: no force output */
    double force_n_continuous;    /* without overheating; 0: not stated, the peak is used */
    double stiffness_n_per_m_max; /* of a stable wall, at rate_hz; 0: not stated, 300 is used */
    double rate_hz;               /* sample rate: 200 to 10000 */
    uint32_t axes_in;             /* 3: position; 6: orientation as well */
    uint32_t axes_out;            /* of force: 0 to 6 */
    uint32_t buttons;             /* 0 to 32 */
    uint32_t flags;
    char name[64];         /* for people: maker and model; UTF-8 */
    double torque_nm_peak; /* short-term, about any axis; 0: no torque output */
} MarsviewCapabilities;

typedef struct MarsviewSample {
    double position_m[3];
    double twist_rad; /* see Orientation above; from any reference; 0 if axes_in is 3 */
    /* CLOCK_MONOTONIC time of the measurement; 0 means now. The force goes to zero if the time is
     * more than 15 ms in the past or in the future, as happens with another clock. */
    int64_t time_ns;
    /* Bits 0 and 1: the first and the second button of the stylus; either grabs. */
    uint32_t buttons;
    uint32_t is_held; /* 0 in the inkwell; used only with MARSVIEW_HAS_PRESENCE */
    /* Unit quaternion w, x, y, z; see Orientation above. All zero: not measured. */
    double orientation[4];
} MarsviewSample;

/* A device that can be opened, or the reason why it cannot. */
typedef struct MarsviewFoundDevice {
    const char* id;     /* the argument of `open`; no line breaks */
    const char* name;   /* for people */
    const char* reason; /* null or "" if it can be opened; otherwise one sentence */
} MarsviewFoundDevice;

/* Provided by the program: call it once per device during `enumerate`; it copies its arguments. */
typedef void (*MarsviewFound)(void* self, const MarsviewFoundDevice* device);

/* Provided by the program: call it once per period between start_clock and stop_clock. */
typedef void (*MarsviewTick)(void* self);

typedef struct MarsviewPlugin {
    uint32_t abi_version;        /* MARSVIEW_PLUGIN_ABI_VERSION; first in every version */
    uint32_t plugin_bytes;       /* sizeof(MarsviewPlugin) */
    uint32_t capabilities_bytes; /* sizeof(MarsviewCapabilities) */
    uint32_t sample_bytes;       /* sizeof(MarsviewSample) */
    uint32_t found_device_bytes; /* sizeof(MarsviewFoundDevice) */
    uint32_t reserved;           /* 0 */
    const char* name;            /* of the plugin, for people */

    /* Reports all devices that are connected now. */
    void (*enumerate)(MarsviewFound found, void* self);

    /* Opens the device with this id, or the first one if id is "". On failure returns null and puts
     * one sentence into `error`, which has room for error_bytes including the terminating 0. */
    MarsviewDevice* (*open)(const char* id, char* error, uint32_t error_bytes);

    /* Leaves the motors without force. */
    void (*close)(MarsviewDevice* device);

    /* Fills in the capabilities; the device is closed again unless the result is MARSVIEW_FINE. */
    uint32_t (*capabilities)(MarsviewDevice* device, MarsviewCapabilities* capabilities);

    /* The newest sample. */
    uint32_t (*read)(MarsviewDevice* device, MarsviewSample* sample);

    /* Sets the force on the hand until the next call. If the result is not MARSVIEW_FINE, the
     * motors must be without force. */
    uint32_t (*write)(MarsviewDevice* device, const double force_n[3]);

    /* Both null unless the device owns the clock. After start_clock has returned MARSVIEW_FINE, the
     * device calls tick(self) once per period on its own thread; the tick calls `read` and `write`.
     * After stop_clock has returned, no tick runs or begins. */
    uint32_t (*start_clock)(MarsviewDevice* device, MarsviewTick tick, void* self);
    void (*stop_clock)(MarsviewDevice* device);

    /* The following may be null. */

    /* Why the last result was MARSVIEW_UNREADY or MARSVIEW_LOST and what to do about it, as one
     * sentence in UTF-8 that follows the device's name and a colon: "is not calibrated; put the
     * stylus into its holder". `text` has room for text_bytes including the terminating 0 and is
     * empty when passed. At most a few calls a second. */
    void (*message)(MarsviewDevice* device, char* text, uint32_t text_bytes);

    /* The user states that the device is held in its home position: calibrates it there. Called
     * after `open` and before the first `read`; the device is closed again unless the result is
     * MARSVIEW_FINE. A device whose plugin has this function is offered to the user for calibration
     * while `read` returns MARSVIEW_UNREADY; `message` describes the home position. */
    uint32_t (*calibrate)(MarsviewDevice* device);

    /* Replaces `write` where it is present: force and torque together, in the workspace frame. The
     * torque is zero at present, since the terrain is touched with a point. */
    uint32_t (*write_wrench)(MarsviewDevice* device,
                             const double force_n[3],
                             const double torque_nm[3]);
} MarsviewPlugin;

/* The exported function. The table must stay valid as long as the program runs. */
MARSVIEW_PLUGIN_EXPORT const MarsviewPlugin* marsviewHapticPlugin(void);

/* NOLINTEND(modernize-use-using) */

#ifdef __cplusplus
}
#endif

#endif
