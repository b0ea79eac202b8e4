/* SPDX-License-Identifier: MIT */
/* A library that tools/psx_run.py loads before pcsxr, so that pcsxr runs without a display and under a program's control. */
#include <signal.h>
#include <stdio.h>
#include <sys/prctl.h>

int XTestQueryExtension(void *display, int *event_base, int *error_base, int *major, int *minor);

/* Write out each complete line; end together with the parent process. */
__attribute__((constructor)) static void start(void)
{
    setvbuf(stdout, NULL, _IOLBF, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
}

/* pcsxr calls this with the first frame, to stop a screen saver: there is no screen. */
int XTestQueryExtension(void *display, int *event_base, int *error_base, int *major, int *minor)
{
    (void)display;
    (void)event_base;
    (void)error_base;
    (void)major;
    (void)minor;
    return 0;
}
