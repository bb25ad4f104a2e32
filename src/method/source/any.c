// Compile with -ffp-contract=off (and link with -lm), or the compiler fuses products into sums by itself.
#include <math.h>

typedef struct { NUM x, y, z; } vector;

static inline vector sub(vector u, vector v) { return (vector){u.x - v.x, u.y - v.y, u.z - v.z}; }
static inline vector scale(NUM k, vector v) { return (vector){k * v.x, k * v.y, k * v.z}; }
static inline vector across(vector u, vector v) {
    return (vector){u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}
static inline NUM dot(vector u, vector v) { return u.x * v.x + u.y * v.y + u.z * v.z; }
static inline NUM root(NUM x) { return sqrtSUFFIX(x); }
static inline NUM fused(NUM x, NUM y, NUM z) { return fmaSUFFIX(x, y, z); }
static inline NUM fused_dot(vector u, vector v) { return fused(u.z, v.z, fused(u.x, v.x, u.y * v.y)); }
static inline NUM choose(int first, NUM one, NUM other) { return first ? one : other; }

// Whether the line meets the sphere; if it does, the two roots.
int intersect(const float p[3], const float dir[3], const float cen[3], float rad, float *t0, float *t1) {
    const vector origin = {p[0], p[1], p[2]}, direction = {dir[0], dir[1], dir[2]}, center = {cen[0], cen[1], cen[2]};
    const NUM radius = rad;
