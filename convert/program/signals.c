/* Signals that ask the program to stop: the job that is running is canceled and given some
 * time. */
#include <signal.h>
#include <sys/time.h>
#include <unistd.h>

#include "convert/program/cmd.h"

/* What the handler reads; it is set before the handler is installed. */
static weft_job *running_job;
static volatile sig_atomic_t caught;

int wf_cmd_signal(void) {
    return caught;
}

/* How long a job may take to stop. While it waits for a file that does not answer it cannot see
 * that it should. */
static const struct itimerval patience = {.it_value = {.tv_sec = 1, .tv_usec = 700000}};

static void give_up(int number) {
    (void)number;
    _exit(128 + caught);
}

/* The first signal asks the job to stop; a second one of any kind ends the program at once. */
static void on_signal(int number) {
    caught = number;
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    signal(SIGHUP, SIG_DFL);
    weft_job_cancel(running_job);
    setitimer(ITIMER_REAL, &patience, NULL);
}

/* A SIGHUP that is ignored (by nohup) stays so. A SIGINT that is ignored does not: shells
 * ignore it in what a script starts with '&', and such a job is to be stopped like any other.
 */
void wf_cmd_catch_signals(weft_job *job) {
    const struct sigaction action = {.sa_handler = on_signal, .sa_flags = SA_RESTART};
    struct sigaction old;
    running_job = job;
    signal(SIGALRM, give_up);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    if (!sigaction(SIGHUP, NULL, &old) && old.sa_handler != SIG_IGN)
        sigaction(SIGHUP, &action, NULL);
    if (caught) weft_job_cancel(job); /* between two jobs */
}

void wf_cmd_ignore_signals(void) {
    signal(SIGINT, SIG_IGN);
    signal(SIGTERM, SIG_IGN);
    signal(SIGHUP, SIG_IGN);
    signal(SIGALRM, SIG_IGN);
}
