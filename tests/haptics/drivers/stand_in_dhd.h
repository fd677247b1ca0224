/* The controls of the stand-in for Force Dimension's library. */
#ifndef MARSVIEW_STAND_IN_DHD_H
#define MARSVIEW_STAND_IN_DHD_H

#ifdef __cplusplus
extern "C" {
#endif

/* What the device is and does. Access only through standInDhdGet and standInDhdSet. */
typedef struct StandInDhd {
    int devices; /* connected */
    int type;    /* dhdGetSystemType */
    int has_wrist;
    int has_active_gripper;
    double max_force_n;    /* dhdGetMaxForce; negative: no limit */
    double position_m[3];  /* x toward the user, y right, z up */
    double frame[3][3];    /* of the wrist, in the same axes */
    int is_pressed[2];     /* the buttons */
    int needs_calibration; /* RESET mode */
    int is_braking;        /* BRAKE mode: the force button was pressed, or it moved too fast */
    int is_unplugged;      /* every call fails */
    int fails_opening;
    int hangs_counting;

    double force_n[3]; /* on the hand: zero unless in FORCE mode */
    int is_force_enabled;
    int is_emulating_button;
    int opened;
    int closed;
    unsigned long forces; /* calls of dhdSetForce */
    unsigned long reads;  /* calls that read the position */
    int misuses;          /* calls with a device that is not open */
} StandInDhd;

typedef void (*StandInDhdGetFunction)(StandInDhd* state);
typedef void (*StandInDhdSetFunction)(const StandInDhd* state);

#ifdef __cplusplus
}
#endif

#endif
