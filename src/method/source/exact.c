// exact: the first of its stages, in binary64, with the bound on its error.
// Compile with -ffp-contract=off (and link with -lm). What lies within the bound is not decided here: tangents, and what
// comes near one, need the later stages, which go on with more bits and end in whole numbers. The roots are those
// of binary64 rounded to binary32: right but where both ends of their own small error round apart.
#include <math.h>

// 1 for a secant, 0 for a miss, -1 where the sign of the discriminant is not certain.
int intersect(const float p[3], const float dir[3], const float cen[3], float rad, float *t0, float *t1) {
    const double u = 0x1p-53;
    const double o[3] = {(double)p[0] - cen[0], (double)p[1] - cen[1], (double)p[2] - cen[2]};
    const double d[3] = {dir[0], dir[1], dir[2]}, r = rad;
    const double a = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    const double kx = o[1] * d[2] - o[2] * d[1], ky = o[2] * d[0] - o[0] * d[2], kz = o[0] * d[1] - o[1] * d[0];
    const double reduced = a * (r * r) - (kx * kx + ky * ky + kz * kz); // D = A r² - |o × d|²
    const double length = fabs(o[0]) + fabs(o[1]) + fabs(o[2]);
    const double error = a * ((13.0 * u * r + 6.0 * u * length) * (r + 11.0 * u * length));
    if (reduced < -4.0 * error) return 0;
    if (!(reduced > 4.0 * error)) return -1;
    const double b = o[0] * d[0] + o[1] * d[1] + o[2] * d[2], s = sqrt(reduced);
    *t0 = (float)((-b - s) / a);
    *t1 = (float)((s - b) / a);
    return 1;
}
