/* What a solve costs, from outside: `textbook` and `double` in C, on rays of the kind that `typical` is, made by a
   generator of its own. 2^17 different rays, then the first 2^11 again and again; nanoseconds a ray, median
   and quartiles of the passes. To be held beside `rayscope bench --family typical --method textbook,double`.
   gcc -O2 -fno-math-errno distinct.c -lm && ./a.out */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { DISTINCT = 1 << 17, FEW = 1 << 11, PASSES = 41 };

typedef struct { float o[3], d[3], c[3], r; } problem;
typedef struct { float near, far; int hits; } answer;

static uint64_t state = 88172645463325252u;
static double uniform(double least, double end) {
  state ^= state << 13, state ^= state >> 7, state ^= state << 17;
  return least + (end - least) * (double)(state >> 11) / 9007199254740992.0;
}

static double dot(const double *u, const double *v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; }

static void unit(double *v) {
  double n;
  do for (int i = 0; i < 3; i++) v[i] = uniform(-1, 1); while ((n = dot(v, v)) > 1 || n < 1e-3);
  for (int i = 0; i < 3; i++) v[i] /= sqrt(n);
}

/* A few radii away, aimed near the edge. */
static problem typical(void) {
  double forward[3], side[3], r = uniform(0.5, 2), distance = r * uniform(2, 12), miss = r * uniform(0, 1.5);
  unit(forward), unit(side);
  double along = dot(forward, side), n = 0, away = sqrt(distance * distance - miss * miss);
  for (int i = 0; i < 3; i++) side[i] -= along * forward[i], n += side[i] * side[i];
  problem p = { .r = (float)r };
  for (int i = 0; i < 3; i++) {
    double c = uniform(-10, 10);
    p.c[i] = (float)c, p.d[i] = (float)forward[i], p.o[i] = (float)(c + miss * side[i] / sqrt(n) - away * forward[i]);
  }
  return p;
}

#define O(i) (p->o[i] - p->c[i])
__attribute__((noinline)) static answer textbook(const problem *p) {
  float o[3] = { O(0), O(1), O(2) };
  const float *d = p->d;
  float a = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  float b = 2 * (d[0] * o[0] + d[1] * o[1] + d[2] * o[2]);
  float c = (o[0] * o[0] + o[1] * o[1] + o[2] * o[2]) - p->r * p->r;
  float discriminant = b * b - 4 * a * c;
  if (discriminant < 0) return (answer){ NAN, NAN, 0 };
  float root = sqrtf(discriminant);
  return (answer){ (-b - root) / (2 * a), (-b + root) / (2 * a), 1 };
}

__attribute__((noinline)) static answer lagrange(const problem *p) {
  double o[3] = { (double)p->o[0] - p->c[0], (double)p->o[1] - p->c[1], (double)p->o[2] - p->c[2] };
  double d[3] = { p->d[0], p->d[1], p->d[2] }, r2 = (double)p->r * p->r;
  double a = dot(d, d), b = dot(d, o), c = dot(o, o) - r2;
  double k[3] = { o[1] * d[2] - o[2] * d[1], o[2] * d[0] - o[0] * d[2], o[0] * d[1] - o[1] * d[0] };
  double reduced = a * r2 - dot(k, k);
  if (reduced < 0) return (answer){ NAN, NAN, 0 };
  double root = sqrt(reduced), q = -(b + (b < 0 ? -root : root));
  if (reduced == 0) return (answer){ (float)(q / a), (float)(q / a), 1 };
  return b < 0 ? (answer){ (float)(c / q), (float)(q / a), 1 } : (answer){ (float)(q / a), (float)(c / q), 1 };
}

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return t.tv_sec * 1e9 + t.tv_nsec;
}

static int ascending(const void *x, const void *y) {
  double a = *(const double *)x, b = *(const double *)y;
  return (a > b) - (a < b);
}

static problem problems[DISTINCT];
static answer answers[DISTINCT];

static void report(const char *name, answer (*solve)(const problem *), int count, int repeats) {
  double times[PASSES];
  for (int pass = -1; pass < PASSES; pass++) {
    double start = now();
    for (int again = 0; again < repeats; again++) {
      for (int i = 0; i < count; i++) answers[i] = solve(&problems[i]);
      __asm__ volatile("" : : "r"(answers) : "memory");
    }
    if (pass >= 0) times[pass] = (now() - start) / count / repeats;
  }
  qsort(times, PASSES, sizeof *times, ascending);
  printf("%-9s %6d rays  median %5.2f  min %5.2f  iqr %5.2f\n", name, count, times[PASSES / 2], times[0],
         times[3 * PASSES / 4] - times[PASSES / 4]);
}

int main(void) {
  int hits = 0;
  for (int i = 0; i < DISTINCT; i++) problems[i] = typical(), hits += textbook(&problems[i]).hits;
  printf("%.1f %% hit\n", 100.0 * hits / DISTINCT);
  report("textbook", textbook, DISTINCT, 1), report("double", lagrange, DISTINCT, 1);
  report("textbook", textbook, FEW, 64), report("double", lagrange, FEW, 64);
  return 0;
}
