/* The strings by which a test pulls the stand-in for the vendor's library. */
#ifndef MARSVIEW_STAND_IN_HD_H
#define MARSVIEW_STAND_IN_HD_H

#ifdef __cplusplus
extern "C" {
#endif

/* All under `mutex` inside of the library: to be used between frames only. */
typedef struct StandInState {
    double position_mm[3];
    double gimbal_rad[3];
    int buttons;
    unsigned char inkwell_switch;
    unsigned calibration;
    unsigned calibration_style;
    unsigned updated_style;  /* what hdUpdateCalibration was asked for */
    unsigned init_error;     /* of the next hdInitDevice; 0: it works */
    unsigned start_error;    /* of the next hdStartScheduler */
    unsigned frame_error;    /* pushed by hdEndFrame until it is 0 again */
    int numbers_are_shifted; /* the numbering of other headers */
    int numbers_are_insane;
    int inits_that_hang;
    int stall_ms; /* how long hdBeginFrame takes */

    char opened_name[64]; /* what hdInitDevice was given; "(default)" for null */
    double force_n[3];    /* of the last whole frame */
    int open_devices;
    int scheduled;
    int scheduler_runs;
    unsigned long scheduler_hz;
    unsigned long frames;
    int misuses; /* calls that the library's manual forbids */
    unsigned enabled_force_output;
} StandInState;

/* The state to be read and written. */
typedef StandInState* (*StandInStateFunction)(void);
/* Lets the scheduler's thread do so many turns, and waits until they are done. */
typedef void (*StandInRunFunction)(int turns);
/* As it was when it was loaded. */
typedef void (*StandInResetFunction)(void);

#ifdef __cplusplus
}
#endif

#endif
