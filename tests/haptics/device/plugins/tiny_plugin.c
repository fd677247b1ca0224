/* A correct device plugin, except for the fault selected by the build: one TINY_… definition per
 * library, see tests/CMakeLists.txt. */
#define _POSIX_C_SOURCE 200809L

#if defined(TINY_IS_FIRST)
#include "tests/haptics/device/plugins/first_header/plugin_abi.h"
#else
#include "haptics/device/plugin_abi.h"
#endif

#include <pthread.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

struct MarsviewDevice {
    double force_n[3];
    double torque_nm[3];
    int is_calibrated;
    unsigned reads;
    pthread_t thread;
    atomic_int is_ticking;
    MarsviewTick tick;
    void* self;
};

/* How often `close` was called, for tests that look it up. */
MARSVIEW_PLUGIN_EXPORT atomic_int tiny_closed;

static void hang(void)
{
    for (;;) {
        pause();
    }
}

static void enumerateDevices(MarsviewFound found, void* self)
{
#if defined(TINY_HANGS_LISTING)
    hang();
#elif defined(TINY_CRASHES_LISTING)
    abort();
#elif defined(TINY_HAS_NONE)
    (void)found;
    (void)self;
#else
    const MarsviewFoundDevice first = {"", "Tiny", NULL};
    found(self, &first);
#if defined(TINY_HAS_TWO)
    const MarsviewFoundDevice second = {"b", "Tiny\nB", "its cover is open"};
    found(self, &second);
#endif
#endif
}

static MarsviewDevice* openDevice(const char* id, char* error, uint32_t error_bytes)
{
#if defined(TINY_HANGS_OPENING)
    hang();
#elif defined(TINY_CRASHES_OPENING)
    abort();
#elif defined(TINY_EXITS_OPENING)
    exit(3);
#elif defined(TINY_FAILS_OPENING)
    snprintf(error, error_bytes, "the cover\nis open");
    return NULL;
#endif
    if (id[0] != '\0') {
        snprintf(error, error_bytes, "there is no %s", id);
        return NULL;
    }
    return calloc(1, sizeof(MarsviewDevice));
}

static void closeDevice(MarsviewDevice* device)
{
#if defined(TINY_HANGS_CLOSING)
    hang();
#elif defined(TINY_CRASHES_CLOSING)
    abort();
#endif
    atomic_fetch_add(&tiny_closed, 1);
    free(device);
}

static uint32_t describeDevice(MarsviewDevice* device, MarsviewCapabilities* capabilities)
{
    (void)device;
    MarsviewCapabilities c = {
        .workspace_low_m = {-0.08, -0.06, -0.05},
        .workspace_high_m = {0.08, 0.06, 0.07},
        .force_n_peak = 3.3,
        .force_n_continuous = 0.9,
        .stiffness_n_per_m_max = 1500.0,
        .rate_hz = 1000.0,
        .axes_in = 6,
        .axes_out = 3,
        .buttons = 3,
        .flags = MARSVIEW_HAS_PRESENCE,
        .name = "Tiny One",
    };
#if defined(TINY_IS_NAN)
    c.stiffness_n_per_m_max = 0.0 / 0.0;
#elif defined(TINY_IS_EMPTY)
    c.workspace_high_m[1] = c.workspace_low_m[1];
#elif defined(TINY_IS_NEGATIVE)
    c.force_n_peak = -3.0;
#elif defined(TINY_OWNS_CLOCK) || defined(TINY_CRASHES_STARTING) || defined(TINY_FAILS_STARTING)
    c.flags |= MARSVIEW_OWNS_CLOCK;
#endif
#if defined(TINY_HAS_SIX_AXES)
    c.axes_out = 6;
    c.torque_nm_peak = 0.5;
#endif
    *capabilities = c;
    return MARSVIEW_FINE;
}

static uint32_t readDevice(MarsviewDevice* device, MarsviewSample* sample)
{
    device->reads += 1;
#if defined(TINY_IS_SLOW)
    const struct timespec five_ms = {.tv_nsec = 5000000};
    nanosleep(&five_ms, NULL);
#endif
    /* Returns the force written, so that a test can check it. */
    sample->position_m[0] = device->force_n[0] / 1000.0;
    sample->position_m[1] = device->force_n[1] / 1000.0;
    sample->position_m[2] = device->force_n[2] / 1000.0;
    sample->twist_rad = 0.25;
    sample->buttons = 4; /* not a grabbing button: the hand touches */
    sample->is_held = 1;
#if defined(TINY_HAS_SIX_AXES)
    /* The tip down, the stylus not turned; and a torque, so that a test can check it. */
    sample->orientation[0] = 0.70710678118654752;
    sample->orientation[1] = -0.70710678118654752;
    sample->twist_rad = device->torque_nm[0] + device->torque_nm[1] + device->torque_nm[2];
#endif
#if defined(TINY_SAYS_NAN)
    if (device->reads > 2) {
        sample->position_m[1] = 0.0 / 0.0;
    }
#elif defined(TINY_SAYS_MILLIMETRES)
    sample->position_m[0] = 70.0;
#elif defined(TINY_CRASHES_READING)
    abort();
#elif defined(TINY_HANGS_READING)
    hang();
#elif defined(TINY_SAYS_UNREADY) || defined(TINY_EXPLAINS) || defined(TINY_HANGS_EXPLAINING)
    return MARSVIEW_UNREADY;
#elif defined(TINY_IS_LOST)
    return MARSVIEW_LOST;
#elif defined(TINY_CALIBRATES) || defined(TINY_FAILS_CALIBRATING)
    return device->is_calibrated ? MARSVIEW_FINE : MARSVIEW_UNREADY;
#elif defined(TINY_ANSWERS_NONSENSE)
    return 4711;
#endif
    return MARSVIEW_FINE;
}

static uint32_t writeDevice(MarsviewDevice* device, const double force_n[3])
{
#if defined(TINY_CRASHES_WRITING)
    abort();
#endif
    memcpy(device->force_n, force_n, sizeof device->force_n);
    return MARSVIEW_FINE;
}

#if defined(TINY_EXPLAINS) || defined(TINY_IS_LOST) || defined(TINY_CALIBRATES) ||                 \
    defined(TINY_FAILS_CALIBRATING) || defined(TINY_HANGS_EXPLAINING)
/* How often `message` was called, for tests that look it up. */
MARSVIEW_PLUGIN_EXPORT atomic_int tiny_asked;

static void explain(MarsviewDevice* device, char* text, uint32_t text_bytes)
{
    (void)device;
    atomic_fetch_add(&tiny_asked, 1);
#if defined(TINY_HANGS_EXPLAINING)
    hang();
#elif defined(TINY_IS_LOST)
    snprintf(text, text_bytes, "its cable\nis out");
#elif defined(TINY_FAILS_CALIBRATING)
    snprintf(text, text_bytes, "is not in its home position");
#else
    snprintf(text, text_bytes, "is not calibrated; put the stylus into its holder");
#endif
}
#else
#define explain NULL
#endif

#if defined(TINY_CALIBRATES) || defined(TINY_FAILS_CALIBRATING)
static uint32_t calibrateDevice(MarsviewDevice* device)
{
#if defined(TINY_FAILS_CALIBRATING)
    return MARSVIEW_UNREADY;
#endif
    device->is_calibrated = 1;
    return MARSVIEW_FINE;
}
#else
#define calibrateDevice NULL
#endif

#if defined(TINY_HAS_SIX_AXES)
static uint32_t
writeWrench(MarsviewDevice* device, const double force_n[3], const double torque_nm[3])
{
    memcpy(device->torque_nm, torque_nm, sizeof device->torque_nm);
    device->torque_nm[0] += 0.5; /* shows that this function was called */
    memcpy(device->force_n, force_n, sizeof device->force_n);
    return MARSVIEW_FINE;
}
#else
#define writeWrench NULL
#endif

#if defined(TINY_OWNS_CLOCK)
static void* runClock(void* self)
{
    MarsviewDevice* device = self;
    while (atomic_load(&device->is_ticking)) {
        device->tick(device->self);
        const struct timespec period = {0, 1000000};
        nanosleep(&period, NULL);
    }
    return NULL;
}

static uint32_t startClock(MarsviewDevice* device, MarsviewTick tick, void* self)
{
    device->tick = tick;
    device->self = self;
    atomic_store(&device->is_ticking, 1);
    return pthread_create(&device->thread, NULL, runClock, device) == 0 ? MARSVIEW_FINE
                                                                        : MARSVIEW_LOST;
}

static void stopClock(MarsviewDevice* device)
{
    atomic_store(&device->is_ticking, 0);
    pthread_join(device->thread, NULL);
}
#elif defined(TINY_CRASHES_STARTING) || defined(TINY_FAILS_STARTING)
static uint32_t startClock(MarsviewDevice* device, MarsviewTick tick, void* self)
{
#if defined(TINY_CRASHES_STARTING)
    abort();
#endif
    return MARSVIEW_LOST;
}

static void stopClock(MarsviewDevice* device) {}
#else
#define startClock NULL
#define stopClock NULL
#endif

#if defined(TINY_CRASHES_LOADING)
__attribute__((constructor)) static void onLoad(void)
{
    abort();
}
#elif defined(TINY_HANGS_LOADING)
__attribute__((constructor)) static void onLoad(void)
{
    hang();
}
#endif

/* A later version of the interface, whose structs have grown at their ends. */
#if defined(TINY_IS_NEWER)
typedef struct NewerSample {
    MarsviewSample sample;
    double torque[30];
} NewerSample;
typedef struct NewerPlugin {
    MarsviewPlugin plugin;
    void (*blink)(MarsviewDevice* device);
} NewerPlugin;

static uint32_t readNewer(MarsviewDevice* device, MarsviewSample* sample)
{
    NewerSample newer = {.torque = {1.0}};
    newer.torque[29] = 2.0;
    const uint32_t status = readDevice(device, &newer.sample);
    memcpy(sample, &newer, sizeof newer);
    return status;
}
#define readDevice readNewer
#define SAMPLE_BYTES sizeof(NewerSample)
#define PLUGIN_BYTES sizeof(NewerPlugin)
#elif defined(TINY_HAS_SMALL_SAMPLES)
#define SAMPLE_BYTES 24
#define PLUGIN_BYTES sizeof(MarsviewPlugin)
#else
#define SAMPLE_BYTES sizeof(MarsviewSample)
#define PLUGIN_BYTES sizeof(MarsviewPlugin)
#endif

static const struct {
    MarsviewPlugin plugin;
    void (*blink)(MarsviewDevice* device);
} table = {{
#if defined(TINY_HAS_OTHER_VERSION)
               MARSVIEW_PLUGIN_ABI_VERSION + 1,
#else
               MARSVIEW_PLUGIN_ABI_VERSION,
#endif
#if defined(TINY_HAS_SMALL_TABLE)
               40,
#else
               PLUGIN_BYTES,
#endif
               sizeof(MarsviewCapabilities), SAMPLE_BYTES, sizeof(MarsviewFoundDevice), 0,
               "Tiny plugin", enumerateDevices, openDevice, closeDevice, describeDevice,
#if defined(TINY_LACKS_READ)
               NULL,
#else
               readDevice,
#endif
               writeDevice, startClock, stopClock
#if !defined(TINY_IS_FIRST)
               ,
               explain, calibrateDevice, writeWrench
#endif
           },
           NULL};

#if !defined(TINY_LACKS_SYMBOL)
const MarsviewPlugin* marsviewHapticPlugin(void)
{
    (void)hang;
    (void)readDevice;
#if defined(TINY_LACKS_TABLE)
    return NULL;
#else
    return &table.plugin;
#endif
}
#else
MARSVIEW_PLUGIN_EXPORT const void* somethingElse(void)
{
    (void)hang;
    return &table;
}
#endif
