// Times your own intersection, and prints rays, answers and nanoseconds as CSV:
//   COMPILE
//   ./bench > answers.csv && rayscope grade answers.csv
// Its checks of itself go to standard error.
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

// ---- your routine: whether the ray p + t d meets the sphere, and if so both roots -------------------------------
// A routine that gives one root: set *t1 to *t0. The example is the textbook's.
static int intersect(const float p[3], const float d[3], const float c[3], float r, float *t0, float *t1) {
    const float o[3] = {p[0] - c[0], p[1] - c[1], p[2] - c[2]};
    const float A = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    const float B = 2.0f * (d[0] * o[0] + d[1] * o[1] + d[2] * o[2]);
    const float C = o[0] * o[0] + o[1] * o[1] + o[2] * o[2] - r * r;
    const float D = B * B - 4.0f * A * C;
    if (D < 0.0f) return 0;
    *t0 = (-B - sqrtf(D)) / (2.0f * A);
    *t1 = (-B + sqrtf(D)) / (2.0f * A);
    return 1;
}
// ---- end of your routine ------------------------------------------------------------------------------------------

enum { RAYS = 1 << 17, PRINTED = 4096, ROUNDS = 15 };
typedef struct { float p[3], d[3], c[3], r; } question;

static uint64_t state = 88172645463325252u;
// A number from -1 to below 1, of 24 bits: the same rays on every machine.
static float number(void) {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return (float)(int32_t)(state >> 40) * (1.0f / 8388608.0f) - 1.0f;
}
static double now(void) {
    struct timespec t;
    timespec_get(&t, TIME_UTC);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}
static int by_size(const void *x, const void *y) {
    const double a = *(const double *)x, b = *(const double *)y;
    return (a > b) - (a < b);
}
static volatile float sink;
// Nanoseconds a ray, the median of rounds; `times` calls a ray, 0 for the loop alone.
static double timed(const question *q, int times) {
    double rounds[ROUNDS];
    for (int i = 0; i < ROUNDS; i++) {
        const double start = now();
        float sum = 0;
        for (int k = 0; k < RAYS; k++) {
            float t0 = q[k].p[0], t1 = q[k].d[0];
            for (int again = 0; again < times; again++) {
                intersect(q[k].p, q[k].d, q[k].c, q[k].r, &t0, &t1);
                sum += t0 + t1;
            }
            sum += t0;
        }
        sink = sum;
        rounds[i] = (now() - start) / RAYS;
    }
    qsort(rounds, ROUNDS, sizeof rounds[0], by_size);
    return rounds[ROUNDS / 2];
}

int main(void) {
    question *q = (question *)malloc(RAYS * sizeof *q);
    if (!q) return 1;
    for (int k = 0; k < RAYS; k++) {
        q[k].r = 1.25f + 0.75f * number();
        for (int i = 0; i < 3; i++) {
            q[k].c[i] = 4.0f * number();
            q[k].p[i] = 8.0f * number();
            q[k].d[i] = q[k].c[i] + 0.8f * q[k].r * number() - q[k].p[i];
        }
    }
    const double empty = timed(q, 0), once = timed(q, 1), twice = timed(q, 2), ns = once - empty;
    fprintf(stderr, "the loop alone takes %.2f ns a ray, with the routine %.2f, with two calls %.2f\n", empty, once, twice);
    if (!(ns > 0) || twice - empty < 1.2 * ns) fprintf(stderr, "these times can't be trusted: two calls should take about twice as long\n");
    printf("ox,oy,oz,dx,dy,dz,cx,cy,cz,r,class,near,far,ns\n");
    for (int k = 0; k < PRINTED; k++) {
        float t0 = 0, t1 = 0;
        const int met = intersect(q[k].p, q[k].d, q[k].c, q[k].r, &t0, &t1);
        const float *v[3] = {q[k].p, q[k].d, q[k].c};
        for (int i = 0; i < 9; i++) printf("%.9g,", v[i / 3][i % 3]);
        printf("%.9g,", q[k].r);
        if (met) printf("hit,%.9g,%.9g,%.3f\n", t0, t1, ns);
        else printf("miss,,,%.3f\n", ns);
    }
    free(q);
    return 0;
}
