/* The controls of the stand-in for the vendor's library. */
#ifndef MARSVIEW_STAND_IN_HD_H
#define MARSVIEW_STAND_IN_HD_H

#ifdef __cplusplus
extern "C" {
#endif

/* Where the device physically is, and what its library did. The library reports it as the tables in
 * haptics/drivers/openhaptics/README.md state. Protected by `mutex` inside the library: access only
 * between frames. */
typedef struct StandInState {
    double position_mm[3];
    double stylus_axis[3];       /* unit vector from the tip to the back end, in their axes */
    double stylus_clockwise_rad; /* seen from the back end, from the neutral position on */
    int buttons;
    unsigned char inkwell_switch; /* 0: the stylus is in the inkwell */
    unsigned calibration;         /* 0x5000, or what is missing */
    unsigned calibration_style;   /* bits: 1 encoder reset, 2 auto, 4 inkwell */
    int input_dof;
    double encoder_zero_mm[3]; /* where the encoders were reset */
    int encoder_resets;
    unsigned updated_style;  /* the style requested from hdUpdateCalibration */
    unsigned init_error;     /* of the next hdInitDevice; 0: success */
    unsigned start_error;    /* of the next hdStartScheduler */
    unsigned frame_error;    /* reported by hdEndFrame until it is 0 again */
    int numbers_are_shifted; /* the numbering in other headers */
    int numbers_are_insane;
    int inits_that_hang;
    int stall_ms; /* the duration of hdBeginFrame */

    char opened_name[64]; /* the argument of hdInitDevice; "(default)" for null */
    double force_n[3];    /* of the last complete frame */
    int open_devices;
    int scheduled;
    int scheduler_runs;
    unsigned long scheduler_hz;
    unsigned long frames;
    int misuses; /* calls that the library's manual forbids */
    unsigned enabled_force_output;
} StandInState;

/* The state, for reading and writing. */
typedef StandInState* (*StandInStateFunction)(void);
/* Runs the given number of scheduler turns and waits until they are done. */
typedef void (*StandInRunFunction)(int turns);
/* Resets the state to that after loading. */
typedef void (*StandInResetFunction)(void);

#ifdef __cplusplus
}
#endif

#endif
