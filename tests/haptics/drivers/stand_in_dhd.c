/* A stand-in for Force Dimension's libdhd: its symbols, with one device that a test sets. Written
 * from haptics/drivers/forcedimension/README.md. */
#define _POSIX_C_SOURCE 200809L

#include "tests/haptics/drivers/stand_in_dhd.h"

#include <pthread.h>
#include <stdbool.h>
#include <string.h>
#include <unistd.h>

#define EXPORT __attribute__((visibility("default")))
enum { kStatuses = 17, kTimeGuard = 1 };

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static StandInDhd state;
static const char* last_error = "no error";

EXPORT void standInDhdGet(StandInDhd* copy)
{
    pthread_mutex_lock(&mutex);
    *copy = state;
    pthread_mutex_unlock(&mutex);
}

EXPORT void standInDhdSet(const StandInDhd* copy)
{
    pthread_mutex_lock(&mutex);
    state = *copy;
    pthread_mutex_unlock(&mutex);
}

/* Locks unless the call fails. */
static int enter(char id)
{
    pthread_mutex_lock(&mutex);
    if (id != 0 || state.opened == state.closed) {
        state.misuses += 1;
        last_error = "invalid device";
    } else if (state.is_unplugged) {
        last_error = "communication error";
    } else {
        return 1;
    }
    pthread_mutex_unlock(&mutex);
    return 0;
}

static int leave(int result)
{
    pthread_mutex_unlock(&mutex);
    return result;
}

EXPORT const char* dhdErrorGetLastStr(void)
{
    return last_error;
}

EXPORT int dhdGetDeviceCount(void)
{
    for (;;) {
        StandInDhd copy;
        standInDhdGet(&copy);
        if (!copy.hangs_counting) {
            return copy.devices;
        }
        pause();
    }
}

EXPORT int dhdOpenID(char id)
{
    pthread_mutex_lock(&mutex);
    if (id != 0 || state.devices < 1 || state.fails_opening) {
        last_error = "no device found";
        return leave(-1);
    }
    state.opened += 1;
    return leave(0);
}

EXPORT int dhdClose(char id)
{
    pthread_mutex_lock(&mutex);
    state.misuses += id != 0 || state.opened == state.closed;
    state.closed += 1;
    state.is_force_enabled = 0;
    memset(state.force_n, 0, sizeof state.force_n);
    return leave(0);
}

/* Brakes. */
EXPORT int dhdStop(char id)
{
    if (!enter(id)) {
        return -1;
    }
    state.is_force_enabled = 0;
    memset(state.force_n, 0, sizeof state.force_n);
    return leave(0);
}

EXPORT int dhdGetSystemType(char id)
{
    return enter(id) ? leave(state.type) : -1;
}

EXPORT const char* dhdGetSystemName(char id)
{
    (void)id;
    return "Stand-in";
}

EXPORT double dhdGetMaxForce(char id)
{
    if (!enter(id)) {
        return -1.0;
    }
    const double force_n = state.max_force_n;
    leave(0);
    return force_n;
}

EXPORT bool dhdHasWrist(char id)
{
    return enter(id) && leave(state.has_wrist);
}

EXPORT bool dhdHasActiveGripper(char id)
{
    return enter(id) && leave(state.has_active_gripper);
}

EXPORT int dhdEmulateButton(unsigned char value, char id)
{
    if (!enter(id)) {
        return -1;
    }
    state.is_emulating_button = value;
    return leave(0);
}

EXPORT int dhdGetStatus(int* status, char id)
{
    if (!enter(id)) {
        return -1;
    }
    memset(status, 0, sizeof(int) * kStatuses);
    const int is_forcing = state.is_force_enabled && !state.needs_calibration && !state.is_braking;
    status[0] = 1;
    status[1] = 1;
    status[2] = 1;
    status[3] = state.needs_calibration;
    status[5] = is_forcing;
    status[6] = !is_forcing && !state.needs_calibration;
    return leave(0);
}

EXPORT int dhdEnableForce(unsigned char value, char id)
{
    if (!enter(id)) {
        return -1;
    }
    state.is_force_enabled = value && !state.needs_calibration;
    return leave(0);
}

EXPORT int dhdGetPosition(double* x, double* y, double* z, char id)
{
    if (!enter(id)) {
        return -1;
    }
    state.reads += 1;
    *x = state.position_m[0];
    *y = state.position_m[1];
    *z = state.position_m[2];
    return leave(state.reads % 2 == 0 ? kTimeGuard : 0);
}

EXPORT int
dhdGetPositionAndOrientationFrame(double* x, double* y, double* z, double (*frame)[3], char id)
{
    const int result = dhdGetPosition(x, y, z, id);
    if (result < 0 || !enter(id)) {
        return -1;
    }
    memcpy(frame, state.frame, sizeof state.frame);
    return leave(result);
}

EXPORT int dhdGetButton(int index, char id)
{
    if (!enter(id)) {
        return -1;
    }
    const int has_button = !state.has_active_gripper || state.is_emulating_button;
    return leave(index >= 0 && index < 2 && has_button ? state.is_pressed[index] : 0);
}

EXPORT int dhdSetForce(double x, double y, double z, char id)
{
    if (!enter(id)) {
        return -1;
    }
    const int is_forcing = state.is_force_enabled && !state.needs_calibration && !state.is_braking;
    state.forces += 1;
    state.force_n[0] = is_forcing ? x : 0.0;
    state.force_n[1] = is_forcing ? y : 0.0;
    state.force_n[2] = is_forcing ? z : 0.0;
    return leave(0);
}
