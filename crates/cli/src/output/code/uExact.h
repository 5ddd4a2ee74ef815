@REMARKS@#ifndef DALEMBERT_UEXACT_H
#define DALEMBERT_UEXACT_H
#include <math.h>
#include <stddef.h>

static const double uExact_table[@COUNT@][4] = {
@ROWS@};

// P and P' at s.
static inline void uExact_wave(double s, double *value, double *rate) {
    size_t from = 0, to = @COUNT@;
    while (to - from > 1) {
        const size_t middle = (from + to) / 2;
        if (uExact_table[middle][0] <= s) from = middle; else to = middle;
    }
    const double *row = uExact_table[from];
    const double tau = s - row[0];
    *value = row[1] + (row[2] + row[3] * tau / 2) * tau;
    *rate = row[2] + row[3] * tau;
}

// The displacement (d = 0), the strain (d = 1) or the velocity (d = 2) at x and t; NAN outside.
static inline double uExact(double x, double t, int d) {
    const double @CONSTANTS@, SIGN = @SIGN@, NEAR = @NEAR@;
    double up, rise, down, fall;
    if (!(x >= 0 && x <= LENGTH * NEAR && t >= 0 && t <= END * NEAR) || d < 0 || d > 2) return NAN;
    uExact_wave(t - x / WAVE_SPEED, &up, &rise);
    uExact_wave(t + x / WAVE_SPEED - ROUND_TRIP, &down, &fall);
    if (d == 0) return (up + SIGN * down) / 2 + A + (B + D * x) * x;
    if (d == 1) return (SIGN * fall - rise) / (2 * WAVE_SPEED) + B + 2 * D * x;
    return (rise + SIGN * fall) / 2;
}

#endif
