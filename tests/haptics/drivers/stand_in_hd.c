/* A stand-in for the vendor's libHD: its symbols, with a device that a test sets. Written from the
 * tables in haptics/drivers/openhaptics/README.md. The scheduler has its own thread, like the real
 * one, but runs only when a test requests it. */
#define _POSIX_C_SOURCE 200809L

#include "tests/haptics/drivers/stand_in_hd.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

typedef struct {
    unsigned errorCode;
    int internalErrorCode;
    unsigned hHD;
} HDErrorInfo;
typedef unsigned (*Callback)(void*);

#define EXPORT __attribute__((visibility("default")))
enum { kErrorsMax = 8, kCallbacksMax = 4 };

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t changed = PTHREAD_COND_INITIALIZER;
static StandInState state;
static unsigned errors[kErrorsMax];
static int error_count;
static struct {
    Callback callback;
    void* user;
    int is_there;
} callbacks[kCallbacksMax];
static pthread_t thread;
static int turns_wanted;
static int is_stopping;
static int is_in_frame;
static double frame_force[3];

static void reset(void)
{
    memset(&state, 0, sizeof state);
    state.inkwell_switch = 1;
    state.calibration = 0x5000;
    state.calibration_style = 4;
    state.input_dof = 6;
    state.stylus_axis[2] = 1.0; /* the neutral position: level, the tip away from the user */
    error_count = 0;
    turns_wanted = 0;
}

__attribute__((constructor)) static void onLoad(void)
{
    reset();
}

EXPORT StandInState* standInState(void)
{
    return &state;
}

EXPORT void standInReset(void)
{
    pthread_mutex_lock(&mutex);
    reset();
    pthread_mutex_unlock(&mutex);
}

EXPORT void standInRun(int turns)
{
    pthread_mutex_lock(&mutex);
    turns_wanted = turns;
    pthread_cond_broadcast(&changed);
    while (turns_wanted > 0 && state.scheduler_runs) {
        pthread_cond_wait(&changed, &mutex);
    }
    pthread_mutex_unlock(&mutex);
}

/* Two threads may misuse the library at the same time. */
static void noteMisuse(int is_one)
{
    __atomic_add_fetch(&state.misuses, is_one ? 1 : 0, __ATOMIC_RELAXED);
}

static void push(unsigned code)
{
    if (error_count < kErrorsMax) {
        errors[error_count++] = code;
    }
}

EXPORT HDErrorInfo hdGetError(void)
{
    HDErrorInfo info = {0, 0, 0};
    if (error_count > 0) {
        info.errorCode = errors[--error_count];
    }
    return info;
}

EXPORT unsigned hdInitDevice(const char* name)
{
    while (state.inits_that_hang) {
        pause();
    }
    snprintf(state.opened_name, sizeof state.opened_name, "%s", name ? name : "(default)");
    if (state.init_error != 0) {
        push(state.init_error);
        return 0xFFFFFFFFu;
    }
    state.open_devices += 1;
    return 7;
}

EXPORT void hdDisableDevice(unsigned device)
{
    if (device != 7 || state.scheduled > 0) {
        noteMisuse(1);
    }
    state.open_devices -= 1;
    state.enabled_force_output = 0;
    memset(state.force_n, 0, sizeof state.force_n);
}

EXPORT void hdMakeCurrentDevice(unsigned device)
{
    noteMisuse(device != 7);
}

EXPORT void hdBeginFrame(unsigned device)
{
    noteMisuse(device != 7 || is_in_frame);
    is_in_frame = 1;
    if (state.stall_ms > 0) {
        const struct timespec stall = {0, 1000000L * state.stall_ms};
        nanosleep(&stall, NULL);
    }
    memset(frame_force, 0, sizeof frame_force);
}

EXPORT void hdEndFrame(unsigned device)
{
    noteMisuse(device != 7 || !is_in_frame);
    is_in_frame = 0;
    state.frames += 1;
    if (state.frame_error != 0) {
        push(state.frame_error);
        if ((state.frame_error & 0xFF00u) == 0x0200u) {
            state.enabled_force_output = 0;
        }
    }
    memset(state.force_n, 0, sizeof state.force_n);
    if (state.enabled_force_output) {
        memcpy(state.force_n, frame_force, sizeof frame_force);
    }
}

EXPORT void hdEnable(unsigned what)
{
    state.enabled_force_output |= what == 0x4000u;
}

EXPORT void hdDisable(unsigned what)
{
    if (what == 0x4000u) {
        state.enabled_force_output = 0;
    }
}

EXPORT void hdGetBooleanv(unsigned what, unsigned char* values)
{
    if (what == 0x2002u) {
        *values = state.inkwell_switch;
    } else {
        push(0x0100u);
    }
}

EXPORT void hdGetIntegerv(unsigned what, int* values)
{
    switch (what) {
    case 0x2000u:
        *values = state.buttons;
        break;
    case 0x2553u:
        *values = state.input_dof;
        break;
    case 0x2555u:
        *values = (int)state.calibration_style;
        break;
    case 0x2600u:
        *values = 1000;
        break;
    default:
        push(0x0100u);
    }
}

/* Of a tip direction in their axes: x right, y up, z toward the user. */
static void gimbalAngles(double* values)
{
    const double* axis = state.stylus_axis;
    values[0] = atan2(-axis[0], axis[2]); /* the tip to the right: positive */
    values[1] = asin(axis[1]);            /* the tip down: positive */
    values[2] = state.stylus_clockwise_rad;
}

/* The shortest rotation of +z onto the axis, after a clockwise turn about +z; column-major. */
static void transform(double* m)
{
    const double* a = state.stylus_axis;
    const double c = cos(-state.stylus_clockwise_rad);
    const double s = sin(-state.stylus_clockwise_rad);
    const double k = 1.0 / (1.0 + a[2]);
    const double swing[3][3] = {{1.0 - k * a[0] * a[0], -k * a[0] * a[1], a[0]},
                                {-k * a[0] * a[1], 1.0 - k * a[1] * a[1], a[1]},
                                {-a[0], -a[1], a[2]}};
    for (int row = 0; row < 3; ++row) {
        m[row] = swing[row][0] * c + swing[row][1] * s;
        m[4 + row] = -swing[row][0] * s + swing[row][1] * c;
        m[8 + row] = swing[row][2];
        m[12 + row] = state.position_mm[row] - state.encoder_zero_mm[row];
        m[4 * row + 3] = 0.0;
    }
    m[15] = 1.0;
}

EXPORT void hdGetDoublev(unsigned what, double* values)
{
    const double box[6] = {-80.0, -60.0, -35.0, 81.0, 62.0, 36.0};
    const unsigned shift = state.numbers_are_shifted ? 1 : 0;
    if (what == 0x2050u) {
        for (int i = 0; i < 3; ++i) {
            values[i] = state.position_mm[i] - state.encoder_zero_mm[i];
        }
    } else if (what == 0x2052u) {
        transform(values);
    } else if (what == 0x2150u) {
        gimbalAngles(values);
    } else if (what == 0x2551u) {
        memcpy(values, box, sizeof box);
    } else if (state.numbers_are_insane && what >= 0x2602u && what <= 0x2605u) {
        *values = 1e300;
    } else if (what == 0x2602u + shift) {
        *values = 1.02;
    } else if (what == 0x2603u + shift) {
        *values = 3.3;
    } else if (what == 0x2604u + shift) {
        *values = 0.88;
    } else {
        push(0x0100u);
    }
}

EXPORT const char* hdGetString(unsigned what)
{
    return what == 0x2503u ? "3D Systems" : what == 0x2501u ? "Touch" : NULL;
}

EXPORT void hdSetDoublev(unsigned what, const double* values)
{
    if (what != 0x2700u || !is_in_frame) {
        noteMisuse(1);
        return;
    }
    memcpy(frame_force, values, sizeof frame_force);
}

EXPORT unsigned hdCheckCalibration(void)
{
    if (state.calibration != 0x5000u && state.calibration_style == 4u) {
        return state.inkwell_switch ? 0x5002u : 0x5001u;
    }
    return state.calibration;
}

EXPORT void hdUpdateCalibration(unsigned style)
{
    const int is_one = style == 1u || style == 2u || style == 4u;
    state.updated_style = style;
    noteMisuse(!is_one || (style & state.calibration_style) == 0);
    if (style == 1u) { /* the current pose becomes the neutral one, whatever it is */
        noteMisuse(state.scheduler_runs);
        memcpy(state.encoder_zero_mm, state.position_mm, sizeof state.position_mm);
        state.encoder_resets += 1;
        state.calibration = 0x5000u;
        return;
    }
    noteMisuse(!state.scheduler_runs);
    if (style == 2u || state.inkwell_switch == 0) {
        state.calibration = 0x5000u;
    }
}

EXPORT unsigned long hdScheduleAsynchronous(Callback callback, void* user, unsigned short priority)
{
    unsigned long handle = 0;
    pthread_mutex_lock(&mutex);
    noteMisuse(priority != 0xFFFF);
    while (handle < kCallbacksMax && callbacks[handle].is_there) {
        ++handle;
    }
    if (handle < kCallbacksMax) {
        callbacks[handle].callback = callback;
        callbacks[handle].user = user;
        callbacks[handle].is_there = 1;
        state.scheduled += 1;
    } else {
        push(0x0501u);
    }
    pthread_mutex_unlock(&mutex);
    return handle;
}

/* Does not wait for a running callback: the vendor's library may not wait either. */
EXPORT void hdUnschedule(unsigned long handle)
{
    pthread_mutex_lock(&mutex);
    noteMisuse(handle >= kCallbacksMax || !callbacks[handle].is_there);
    callbacks[handle].is_there = 0;
    state.scheduled -= 1;
    pthread_mutex_unlock(&mutex);
}

static void* runScheduler(void* nothing)
{
    pthread_mutex_lock(&mutex);
    while (!is_stopping) {
        if (turns_wanted == 0) {
            pthread_cond_wait(&changed, &mutex);
            continue;
        }
        for (int i = 0; i < kCallbacksMax; ++i) {
            if (callbacks[i].is_there) {
                const Callback callback = callbacks[i].callback;
                void* user = callbacks[i].user;
                pthread_mutex_unlock(&mutex);
                const unsigned answer = callback(user);
                pthread_mutex_lock(&mutex);
                if (answer == 0 && callbacks[i].is_there) {
                    callbacks[i].is_there = 0;
                    state.scheduled -= 1;
                }
            }
        }
        turns_wanted -= 1;
        pthread_cond_broadcast(&changed);
    }
    turns_wanted = 0;
    pthread_cond_broadcast(&changed);
    pthread_mutex_unlock(&mutex);
    return nothing;
}

EXPORT void hdStartScheduler(void)
{
    if (state.start_error != 0) {
        push(state.start_error);
        return;
    }
    noteMisuse(state.scheduler_runs);
    is_stopping = 0;
    state.scheduler_runs = 1;
    if (pthread_create(&thread, NULL, runScheduler, NULL) != 0) {
        push(0x0304u);
    }
}

EXPORT void hdStopScheduler(void)
{
    pthread_mutex_lock(&mutex);
    noteMisuse(!state.scheduler_runs);
    is_stopping = 1;
    pthread_cond_broadcast(&changed);
    pthread_mutex_unlock(&mutex);
    pthread_join(thread, NULL);
    pthread_mutex_lock(&mutex);
    state.scheduler_runs = 0;
    pthread_mutex_unlock(&mutex);
}

EXPORT void hdSetSchedulerRate(unsigned long hz)
{
    state.scheduler_hz = hz;
}
