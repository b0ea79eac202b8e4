/* SPDX-License-Identifier: MIT */
/* What tools/psx_run.py loads before pcsxr, so that it runs without a display and for a program. */
#include <signal.h>
#include <stdio.h>
#include <sys/prctl.h>

int XTestQueryExtension(void *display, int *event_base, int *error_base, int *major, int *minor);

/* A line is out when it is complete; who started this takes it along when it ends. */
__attribute__((constructor)) static void start(void)
{
    setvbuf(stdout, NULL, _IOLBF, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
}

/* pcsxr asks for it with the first frame, to keep a screen saver away: there is no screen. */
int XTestQueryExtension(void *display, int *event_base, int *error_base, int *major, int *minor)
{
    (void)display;
    (void)event_base;
    (void)error_base;
    (void)major;
    (void)minor;
    return 0;
}
